# SPDX-License-Identifier: MIT OR Apache-2.0
"""What the checks of the report share: runs of the program, pages, pictures of them."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from playwright.sync_api import Browser, Page

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


def check(good: bool, what: str) -> None:
    """Says what holds; ends the run where it does not."""
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
        lambda m: (
            m.type in ("error", "warning")
            and not any(word in m.text for word in own)
            and faults.append(m.text)
        ),
    )
    page.on("pageerror", lambda e: faults.append(str(e)))
    page.on("dialog", lambda d: (faults.append(f"dialog {d.message}"), d.dismiss()))
    page.on(
        "request", lambda r: r.url.startswith(("file:", "blob:", "data:")) or faults.append(r.url)
    )
    page.goto(html.as_uri())
    page.wait_for_selector("#view canvas")
    return page, faults


def shot(page: Page) -> bytes:
    """The view as it is once it has come to rest."""
    page.wait_for_timeout(300)
    return page.locator("#view").screenshot()


def texts(page: Page, selector: str) -> list[list[str]]:
    """The cells of the rows of a table."""
    return page.locator(selector).evaluate_all(
        "rows => rows.map(r => [...r.cells].map(c => c.textContent))"
    )
