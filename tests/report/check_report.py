#!/usr/bin/env python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Opens reports in headless Chromium and uses them as a person would.

    check_report.py PROGRAM SAMPLES PICTURES

No message on the console, no request but for the file itself, a view that shows something, a row
that chooses its beam, a search, layers, both themes, and hostile names that stay text.  Screenshots
go to PICTURES.
"""

from __future__ import annotations

import csv
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from playwright.sync_api import Browser, Page, sync_playwright

#: Software rendering, and nothing that looks for a network.
FLAGS = [
    "--no-sandbox",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
]

HOSTILE = "<img src=x onerror=alert(1)>"


def check(good: bool, what: str) -> None:
    if not good:
        sys.exit(f"failed: {what}")
    print("ok:", what)


def report(program: Path, mesh: Path, folder: Path, *options: str | Path) -> Path:
    """Writes the report of a mesh."""
    html = folder / f"{mesh.stem}.html"
    step = folder / f"{mesh.stem}.step"
    command = [program, "reconstruct", mesh, "-o", step, "--report", html, "-q", *options]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return html


def opened(browser: Browser, html: Path) -> tuple[Page, list[str]]:
    """The page of a report, and what it complained of."""
    page = browser.new_page(viewport={"width": 1300, "height": 1000})
    faults: list[str] = []
    # The software renderer warns of its own slowness when pixels are read back.
    own = ("GPU stall", "GL Driver")
    page.on(
        "console",
        lambda m: m.type in ("error", "warning")
        and not any(word in m.text for word in own)
        and faults.append(m.text),
    )
    page.on("pageerror", lambda e: faults.append(str(e)))
    page.on("dialog", lambda d: (faults.append(f"dialog {d.message}"), d.dismiss()))
    page.on("request", lambda r: r.url.startswith(("file:", "blob:", "data:")) or faults.append(r.url))
    page.goto(html.as_uri())
    page.wait_for_selector("#view canvas")
    return page, faults


def shot(page: Page) -> bytes:
    page.wait_for_timeout(300)
    return page.locator("#view").screenshot()


def use(page: Page, name: str, pictures: Path) -> None:
    plain = shot(page)
    check(len(plain) > 8000, f"{name}: the view shows something ({len(plain)} bytes)")
    row = page.locator("tr[data-beam]").first
    row.click()
    check(row.get_attribute("aria-selected") == "true", f"{name}: a row chooses its beam")
    check(page.locator("#label").is_visible(), f"{name}: the beam is named over the view")
    check(shot(page) != plain, f"{name}: the chosen beam stands out")
    page.locator("#search").fill("B001")
    shown = page.locator("tr[data-beam]:visible").count()
    check(shown == 1, f"{name}: the search leaves one beam")
    page.locator("#search").fill("")
    before = shot(page)
    page.locator("#controls input[type=checkbox]").first.uncheck()
    check(shot(page) != before, f"{name}: a layer can be switched off")
    page.screenshot(path=pictures / f"{name}.png")
    page.locator("#theme").click()
    page.screenshot(path=pictures / f"{name}_other_theme.png", full_page=True)


#: Columns of the cut list in the order of the page; quotes before what looks like a formula aside.
COLUMNS = """piece mark quantity profile standard length_mm axis_length_mm angle_1_deg angle_2_deg
    twist_deg unit_mass_kg mass_kg unit_surface_m2""".split()


def texts(page: Page, selector: str) -> list[list[str]]:
    """The cells of the rows of a table."""
    return page.locator(selector).evaluate_all("rows => rows.map(r => [...r.cells].map(c => c.textContent))")


def cut_list(page: Page, name: str, table: Path, listed: Path) -> None:
    """The cut list of the page against the files, and every bar against its stock."""
    with table.open(newline="") as file:
        lines = list(csv.reader(file))
    ends = [i for i, line in enumerate(lines) if not any(line)]
    pieces = [dict(zip(lines[0], line)) for line in lines[1 : ends[0]]]
    wanted = [[piece[column].removeprefix("'") for column in COLUMNS] for piece in pieces]
    check(texts(page, "#pieces tbody tr") == wanted, f"{name}: {len(wanted)} pieces as in the CSV")
    totals = [[line[k] for k in (3, 5, 2, 7, 14, 15)] for line in lines[ends[0] + 2 : ends[1]]]
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
                    kind: part.classList[0], piece: part.dataset.piece, length: Number(part.dataset.length),
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
        good &= sum(p["length"] for p in shown) + stock["kerf_mm"] * (len(shown) - 1) <= stock["length_mm"]
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


def subdivided(mesh: Path, folder: Path) -> Path:
    """The mesh of an OBJ file with every triangle cut into four."""
    points: list[list[float]] = []
    lines: list[str] = []
    middles: dict[tuple[int, int], int] = {}

    def middle(a: int, b: int) -> int:
        side = (min(a, b), max(a, b))
        if side not in middles:
            points.append([(x + y) / 2 for x, y in zip(points[a - 1], points[b - 1])])
            middles[side] = len(points)
        return middles[side]

    for line in mesh.read_text().splitlines():
        kind, _, rest = line.partition(" ")
        if kind == "v":
            points.append([float(x) for x in rest.split()[:3]])
        elif kind == "f":
            a, b, c = (int(corner.split("/")[0]) for corner in rest.split())
            p, q, r = middle(a, b), middle(b, c), middle(c, a)
            lines += [f"f {i} {j} {k}" for i, j, k in ((a, p, r), (p, b, q), (r, q, c), (p, q, r))]
        else:
            lines.append(line)
    fine = folder / f"{mesh.stem}_fine.obj"
    fine.write_text("\n".join([*(f"v {x} {y} {z}" for x, y, z in points), *lines]) + "\n")
    return fine


#: Seconds within which a report of 50,000 triangles shows its 3D view, at the best of some tries.
PATIENCE = 2.0


def large(browser: Browser, program: Path, samples: Path, folder: Path) -> None:
    """Weight and opening time of large reports; a view of fewer triangles says so."""
    html = report(program, subdivided(samples / "cantilever.obj", folder), folder)
    size = html.stat().st_size / 1e6
    check(size < 5, f"46,912 triangles: {size:.1f} MB")
    best = min(opening(browser, html) for _ in range(5))
    check(best < PATIENCE, f"46,912 triangles: open in {best:.1f} s")
    html = report(program, subdivided(samples / "quadpod.obj", folder), folder)
    page, faults = opened(browser, html)
    shown = page.get_by_text("thinned surface of").text_content() or ""
    check("126744" in shown and not faults, f"more than 100,000 triangles: {shown}")
    page.close()


def opening(browser: Browser, html: Path) -> float:
    """Seconds until the 3D view of a report is drawn."""
    page = browser.new_page()
    begin = time.monotonic()
    page.goto(html.as_uri())
    page.wait_for_selector("html[data-drawn]")
    seconds = time.monotonic() - begin
    page.close()
    return seconds


def vector_pictures(program: Path, samples: Path, folder: Path) -> None:
    """Pictures as shapes are no heavier than those as pixels."""
    for mesh in sorted(samples.glob("*.obj")):
        picture = folder / f"{mesh.stem}.svg"
        report(program, mesh, folder, "--picture", picture)
        check(picture.stat().st_size < 1e6, f"{picture.name}: {picture.stat().st_size / 1e3:.0f} kB")


def hostile(samples: Path, folder: Path) -> Path:
    """A mesh with a name that would be a script."""
    mesh = folder / "hostile.obj"
    text = (samples / "single_bar.obj").read_text()
    mesh.write_text(text.replace("g non_design", f"g non_design {HOSTILE}"))
    return mesh


def main() -> None:
    program, samples, pictures = (Path(a).resolve() for a in sys.argv[1:4])
    pictures.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as name, sync_playwright() as playwright:
        folder = Path(name)
        browser = playwright.chromium.launch(executable_path="/usr/bin/chromium", args=FLAGS)
        for sample in ["cantilever", "quadpod"]:
            mesh = samples / f"{sample}.obj"
            stock = ("--stock-length", "400", "--max-profiles", "2")
            listed = folder / f"{sample}.json"
            report(program, mesh, folder, *stock, "--cut-list", listed)
            html = report(program, mesh, folder, *stock)
            check(html.stat().st_size < 5e6, f"{sample}: {html.stat().st_size / 1e6:.1f} MB")
            page, faults = opened(browser, html)
            cut_list(page, sample, html.with_suffix(".csv"), listed)
            use(page, sample, pictures)
            check(not faults, f"{sample}: no complaint {faults[:3]}")
            page.close()
        large(browser, program, samples, folder)
        vector_pictures(program, samples, folder)
        html = report(program, hostile(samples, folder), folder)
        page, faults = opened(browser, html)
        check(page.locator("img[src=x]").count() == 0, "hostile: the name makes no element")
        check(not faults, f"hostile: no complaint {faults[:3]}")
        hint = page.locator("#cut-list").get_by_text("--stock-length").count()
        check(hint == 1 and page.locator(".bar").count() == 0, "no stock length: the page tells of it")
        browser.close()


if __name__ == "__main__":
    main()
