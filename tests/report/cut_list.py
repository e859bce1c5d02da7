# SPDX-License-Identifier: MIT OR Apache-2.0
"""The cut list of a report, held against the files of the same run."""

from __future__ import annotations

import csv
import json
from pathlib import Path

from browser import check, texts
from playwright.sync_api import Page

#: Columns of the cut list in the order of the page.
COLUMNS = [
    "piece",
    "mark",
    "quantity",
    "profile",
    "standard",
    "length_mm",
    "axis_length_mm",
    "angle_1_deg",
    "angle_2_deg",
    "saddle_1_mm",
    "saddle_2_mm",
    "twist_deg",
    "unit_mass_kg",
    "mass_kg",
    "unit_surface_m2",
]


def cut_list(page: Page, name: str, table: Path, listed: Path) -> None:
    """The cut list of the page against the files, and every bar against its stock."""
    with table.open(newline="") as file:
        lines = list(csv.reader(file))
    ends = [i for i, line in enumerate(lines) if not any(line)]
    pieces = [dict(zip(lines[0], line)) for line in lines[1 : ends[0]]]
    wanted = [[piece[column].removeprefix("'") for column in COLUMNS] for piece in pieces]
    check(texts(page, "#pieces tbody tr") == wanted, f"{name}: {len(wanted)} pieces as in the CSV")
    totals = [[line[k] for k in (3, 5, 2, 7, 18, 19)] for line in lines[ends[0] + 2 : ends[1]]]
    totals[-1][0] = "all"
    check(texts(page, "#totals :is(tbody, tfoot) tr") == totals, f"{name}: totals as in the CSV")

    nesting = json.loads(listed.read_text())["nesting"]
    stock = nesting["stock"]
    drawn = page.locator(".bar").evaluate_all(
        """bars => bars.map(bar => {
            const whole = bar.getBoundingClientRect();
            return [...bar.querySelectorAll('.piece, .kerf, .offcut')].map(part => {
                const box = (part.querySelector('rect') ?? part).getBoundingClientRect();
                return {
                    kind: part.classList[0],
                    piece: part.dataset.piece,
                    length: Number(part.dataset.length),
                    text: part.querySelector('text')?.textContent,
                    from: (box.left - whole.left) / whole.width, width: box.width / whole.width,
                };
            }).sort((a, b) => a.from - b.from);
        })"""
    )
    check(len(drawn) == len(nesting["bars"]), f"{name}: {len(drawn)} bars as in the JSON")
    for bar, parts in zip(nesting["bars"], drawn):
        shown = [p for p in parts if p["kind"] == "piece"]
        good = [p["piece"] for p in shown] == bar["pieces"]
        good &= [p["length"] for p in shown] == bar["lengths_mm"]
        good &= all(p["text"] == f"{p['piece']} {p['length']:.12g}" for p in shown)
        good &= all(abs(p["width"] - p["length"] / stock["length_mm"]) < 2e-3 for p in shown)
        good &= (
            sum(p["length"] for p in shown) + stock["kerf_mm"] * (len(shown) - 1)
            <= stock["length_mm"]
        )
        good &= all(a["from"] + a["width"] < b["from"] + 2e-3 for a, b in zip(parts, parts[1:]))
        good &= parts[-1]["from"] + parts[-1]["width"] < 1.002
        if not good:
            check(False, f"{name}: a bar is drawn as it is cut: {bar} {parts}")
    waste = page.locator("#waste").text_content()
    check([waste] == [line[1] for line in lines if line[0] == "waste"], f"{name}: waste {waste}")

    together = max(pieces, key=lambda p: int(p["quantity"]))
    marks = set(together["mark"].split())
    page.locator(f"tr[data-piece={together['piece']}]").click()
    chosen = texts(page, "tr[data-beam][aria-selected=true]")
    check({row[0] for row in chosen} == marks, f"{name}: a piece chooses its {len(marks)} beam(s)")
    places = page.locator(f".piece[data-piece={together['piece']}][aria-selected=true]").count()
    nested = sum(bar["pieces"].count(together["piece"]) for bar in nesting["bars"])
    check(places == nested, f"{name}: and its {nested} place(s) on the bars")
    page.locator("#view").press("Escape")
