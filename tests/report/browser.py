# SPDX-License-Identifier: MIT OR Apache-2.0
"""What the checks of the report share: runs of the program, pages, pictures of them."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from playwright.sync_api import (
    Browser,
    ConsoleMessage,
    Dialog,
    FloatRect,
    Locator,
    Page,
    Request,
)

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

    def said(message: ConsoleMessage) -> None:
        is_own = any(word in message.text for word in own)
        if message.type in ("error", "warning") and not is_own:
            faults.append(message.text)

    def asked(dialog: Dialog) -> None:
        faults.append(f"dialog {dialog.message}")
        dialog.dismiss()

    def fetched(request: Request) -> None:
        if not request.url.startswith(("file:", "blob:", "data:")):
            faults.append(request.url)

    page.on("console", said)
    page.on("pageerror", lambda error: faults.append(str(error)))
    page.on("dialog", asked)
    page.on("request", fetched)
    page.goto(html.as_uri())
    page.wait_for_selector("#view canvas")
    return page, faults


def shot(page: Page) -> bytes:
    """The view as it is once it has come to rest."""
    page.wait_for_timeout(300)
    return page.locator("#view").screenshot()


def texts(page: Page, selector: str) -> list[list[str]]:
    """The cells of the rows of a table."""
    cells: list[list[str]] = page.locator(selector).evaluate_all(
        "rows => rows.map(r => [...r.cells].map(c => c.textContent))"
    )
    return cells


def frame(element: Locator) -> FloatRect:
    """Where an element is on the page."""
    box = element.bounding_box()
    if box is None:
        sys.exit(f"failed: {element} is not to be seen")
    return box
