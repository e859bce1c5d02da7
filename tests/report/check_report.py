#!/usr/bin/env python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Opens reports in headless Chromium and uses them as a person would.

    check_report.py PROGRAM SAMPLES PICTURES

No message on the console, no request but for the file itself, a view that shows something, a row
that chooses its beam, a search, layers, both themes, and hostile names that stay text.  Screenshots
go to PICTURES.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
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


def report(program: Path, mesh: Path, folder: Path, *options: str) -> Path:
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
            html = report(program, samples / f"{sample}.obj", folder, "--stock-length", "6000")
            check(html.stat().st_size < 5e6, f"{sample}: {html.stat().st_size / 1e6:.1f} MB")
            page, faults = opened(browser, html)
            use(page, sample, pictures)
            check(not faults, f"{sample}: no complaint {faults[:3]}")
            page.close()
        html = report(program, hostile(samples, folder), folder)
        page, faults = opened(browser, html)
        check(page.locator("img[src=x]").count() == 0, "hostile: the name makes no element")
        check(not faults, f"hostile: no complaint {faults[:3]}")
        browser.close()


if __name__ == "__main__":
    main()
