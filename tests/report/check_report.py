#!/usr/bin/env python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Opens reports in headless Chromium and uses them as a person would.

    PYTHONPATH=benches check_report.py PROGRAM SAMPLES PICTURES

No message on the console, no request but for the file itself, a view that shows something and
obeys mouse, keys and fingers, tables that sort, search and copy, the cut list as in its files, both
themes, print, weight and opening time, and hostile names that stay text.  Screenshots go to
PICTURES.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from pathlib import Path

from browser import FLAGS, check, opened, report
from cut_list import cut_list
from finer import read_obj, split, write_ply
from interaction import touch, use
from playwright.sync_api import Browser, sync_playwright

HOSTILE = "<img src=x onerror=alert(1)>"


def finer(mesh: Path, folder: Path) -> Path:
    """The mesh of an OBJ file with every triangle cut into four."""
    fine = folder / f"{mesh.stem}_fine.ply"
    write_ply(fine, split(read_obj(mesh)))
    return fine


#: Seconds within which a report of 50,000 triangles shows its 3D view, at the best of some tries.
PATIENCE = 2.0


def large(browser: Browser, program: Path, samples: Path, folder: Path) -> None:
    """Weight and opening time of large reports; a view of fewer triangles says so."""
    html = report(program, finer(samples / "cantilever.obj", folder), folder)
    size = html.stat().st_size / 1e6
    check(size < 5, f"46,912 triangles: {size:.1f} MB")
    best = min(opening(browser, html) for _ in range(5))
    check(best < PATIENCE, f"46,912 triangles: open in {best:.1f} s")
    html = report(program, finer(samples / "quadpod.obj", folder), folder)
    page, faults = opened(browser, html)
    shown = page.get_by_text("thinned surface of").text_content() or ""
    check("126,744" in shown and not faults, f"more than 100,000 triangles: {shown}")
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
        check(
            picture.stat().st_size < 1e6, f"{picture.name}: {picture.stat().st_size / 1e3:.0f} kB"
        )


def hostile(samples: Path, folder: Path) -> Path:
    """A mesh with a name that would be a script."""
    mesh = folder / "hostile.obj"
    text = (samples / "single_bar.obj").read_text()
    mesh.write_text(text.replace("g non_design", f"g non_design {HOSTILE}"))
    return mesh


def main() -> None:
    """Runs all checks, and ends at the first that fails."""
    program, samples, pictures = (Path(a).resolve() for a in sys.argv[1:4])
    pictures.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as name, sync_playwright() as playwright:
        folder = Path(name)
        browser = playwright.chromium.launch(executable_path="/usr/bin/chromium", args=FLAGS)
        for sample in ["cantilever", "four_fixings", "quadpod"]:
            mesh = samples / f"{sample}.obj"
            peer, listed = folder / f"{sample}.cg", folder / f"{sample}.json"
            subprocess.run(
                [program, "skeleton", mesh, "-o", peer, "-q", "--orientation", "global"], check=True
            )
            options = ("--stock-length", "400", "--max-profiles", "2", "--compare", peer)
            report(program, mesh, folder, *options, "--cut-list", listed)
            html = report(program, mesh, folder, *options)
            check(html.stat().st_size < 5e6, f"{sample}: {html.stat().st_size / 1e6:.1f} MB")
            page, faults = opened(browser, html)
            cut_list(page, sample, html.with_suffix(".csv"), listed)
            use(page, sample, pictures, peer.name)
            check(not faults, f"{sample}: no complaint {faults[:3]}")
            page.close()
        touch(browser, folder / "cantilever.html", pictures)
        large(browser, program, samples, folder)
        vector_pictures(program, samples, folder)
        html = report(program, hostile(samples, folder), folder)
        page, faults = opened(browser, html)
        check(page.locator("img[src=x]").count() == 0, "hostile: the name makes no element")
        check(not faults, f"hostile: no complaint {faults[:3]}")
        hint = page.locator("#cut-list").get_by_text("--stock-length").count()
        check(
            hint == 1 and page.locator(".bar").count() == 0, "no stock length: the page tells of it"
        )
        browser.close()


if __name__ == "__main__":
    main()
