# SPDX-License-Identifier: MIT OR Apache-2.0
"""A report in use: mouse, keys and fingers in its view, its tables, both themes, print."""

from __future__ import annotations

from pathlib import Path

from browser import check, frame, shot, texts
from playwright.sync_api import Browser, Page

#: Colour of the pin that marks the place of a finding.
PIN = [255, 61, 0]

#: The pixel in the middle of the view.
MIDDLE = """() => {
    const view = document.querySelector('#view canvas');
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [view.width, view.height];
    const flat = copy.getContext('2d');
    flat.drawImage(view, 0, 0);
    return [...flat.getImageData(view.width / 2, view.height / 2, 1, 1).data].slice(0, 3);
}"""


def use(page: Page, name: str, pictures: Path, peer: str) -> None:
    """Everything there is to click and to type.

    * ``peer``: name of the skeleton that is compared
    """
    plain = shot(page)
    check(len(plain) > 8000, f"{name}: the view shows something ({len(plain)} bytes)")
    rows(page, name, plain)
    view(page, name)
    layers(page, name)
    colours(page, name)
    findings(page, name)
    centeredness(page, name, peer)
    page.screenshot(path=pictures / f"{name}.png")
    themes_and_print(page, name, pictures)


def rows(page: Page, name: str, plain: bytes) -> None:
    """The table of beams: choosing, searching, sorting, copying."""
    row = page.locator("tr[data-beam]").first
    row.click()
    check(row.get_attribute("aria-selected") == "true", f"{name}: a row chooses its beam")
    check(page.locator("#label").is_visible(), f"{name}: the beam is named over the view")
    check(shot(page) != plain, f"{name}: the chosen beam stands out")
    page.locator("#view").press("Escape")
    check(not page.locator("#label").is_visible(), f"{name}: Escape lets it go")
    page.locator("tr[data-beam]").nth(1).press("Enter")
    check("B002" in page.locator("#label").inner_text(), f"{name}: Enter chooses a row")
    page.locator("#view").press("Escape")

    heads = page.locator("#beam-table th")
    for column in range(heads.count()):
        is_number = heads.nth(column).get_attribute("data-sort") == "number"
        for direction in (1, -1):
            heads.nth(column).click()
            cells = [line[column] for line in texts(page, "#beam-table tbody tr")]
            if is_number:
                values = [
                    direction * (float(c) if c[0].isdigit() else float("-inf")) for c in cells
                ]
                check(values == sorted(values), f"{name}: column {column} sorts {direction:+d}")
    marks = [line[0] for line in texts(page, "#beam-table tbody tr")]
    heads.first.click()
    check(texts(page, "#beam-table tbody tr")[0][0] == "B001", f"{name}: {len(marks)} marks sort")

    page.locator("#search").fill("B001")
    found = page.locator("tr[data-beam]:visible")
    check(found.count() == 1, f"{name}: the search leaves one beam")
    page.evaluate("navigator.clipboard.writeText = (text) => { window.copied = text; }")
    page.locator("#copy").click()
    page.wait_for_function("window.copied")
    copied = [line.split("\t") for line in page.evaluate("window.copied").splitlines()]
    check(
        copied[1:] == texts(page, "tr[data-beam]:not([hidden])"), f"{name}: what is shown is copied"
    )
    page.locator("#search").fill("")


def view(page: Page, name: str) -> None:
    """Keys and mouse in the view."""
    host = page.locator("#view")
    for key in ("ArrowLeft", "ArrowUp", "+", "-", "f"):
        before = shot(page)
        host.press(key)
        check(shot(page) != before, f"{name}: the view obeys {key}")
    before = shot(page)
    host.press("Control+ArrowLeft")
    check(shot(page) == before, f"{name}: with Ctrl a key is the browser's")
    for look in ("front", "top", "side", "isometric"):
        before = shot(page)
        page.locator(f"[data-look={look}]").click()
        check(shot(page) != before, f"{name}: {look}")
    box = frame(host)
    middle = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    before = shot(page)
    page.mouse.move(*middle)
    page.mouse.down()
    page.mouse.move(middle[0] + 90, middle[1] + 20, steps=4)
    page.mouse.up()
    check(shot(page) != before, f"{name}: a drag turns the view")
    check(not page.locator("#label").is_visible(), f"{name}: a drag chooses nothing")
    page.locator("[data-look=isometric]").click()


def layers(page: Page, name: str) -> None:
    """Every layer that shows something can be switched off and on."""
    empty = {"outside"}
    for box in page.locator("input[data-layer]:visible").all():
        layer = box.get_attribute("data-layer")
        before = shot(page)
        box.click()
        changed = shot(page) != before
        box.click()
        check(changed or layer in empty, f"{name}: layer {layer}")


def colours(page: Page, name: str) -> None:
    """Every quantity paints the beams and has a legend."""
    for kind in ("offset", "area", "deviation", "error", "profile"):
        before = shot(page)
        page.locator("#colour").select_option(kind)
        legend = page.locator("#legend").inner_text().splitlines()
        check(shot(page) != before and len(legend) > 0, f"{name}: coloured by {kind}: {legend[:2]}")


def findings(page: Page, name: str) -> None:
    """A click on a finding flies to its place."""
    places = page.locator("[data-finding]")
    for i in range(min(places.count(), 3)):
        places.nth(i).click()
        shot(page)
        found = page.evaluate(MIDDLE)
        check(found == PIN, f"{name}: the place of finding {i + 1} is in the middle {found}")
    page.locator("[data-look=isometric]").click()


def centeredness(page: Page, name: str, peer: str) -> None:
    """Our figures beside those of the peer."""
    heads = texts(page, "#centeredness thead tr")[0]
    check(heads == ["", "beamwright", peer], f"{name}: skeletons side by side {heads[1:]}")
    lines = {line[0]: line[1:] for line in texts(page, "#centeredness tbody tr")}
    figures = lines["E_center, eq. (2.2)"]
    check(all(float(x) > 0 for x in figures), f"{name}: E_center {figures}")


def themes_and_print(page: Page, name: str, pictures: Path) -> None:
    """Light and dark, print in light whatever is on the screen."""
    ground = "getComputedStyle(document.body).backgroundColor"
    page.locator("#theme").click()
    check(page.evaluate(ground) == "rgb(20, 24, 31)", f"{name}: dark")
    page.screenshot(path=pictures / f"{name}_dark.png", full_page=True)
    page.emulate_media(media="print")
    check(page.evaluate(ground) == "rgb(255, 255, 255)", f"{name}: printed on white")
    check(not page.locator("#controls").is_visible(), f"{name}: no controls on paper")
    page.emulate_media(media="screen")
    page.pdf(path=pictures / f"{name}.pdf", format="A4")
    check(page.evaluate(ground) == "rgb(20, 24, 31)", f"{name}: dark again after print")
    page.locator("#theme").click()


def touch(browser: Browser, html: Path, pictures: Path) -> None:
    """Fingers on the small screen of a telephone."""
    context = browser.new_context(
        has_touch=True, is_mobile=True, viewport={"width": 390, "height": 800}
    )
    page = context.new_page()
    page.goto(html.as_uri())
    page.wait_for_selector("html[data-drawn]")
    page.screenshot(path=pictures / "telephone.png")
    fits = page.evaluate("document.documentElement.scrollWidth") <= 390
    check(fits, "telephone: the page is as wide as the screen")
    box = frame(page.locator("#view"))
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    session = context.new_cdp_session(page)

    def move(what: str, path: list[list[tuple[float, float]]]) -> None:
        before = shot(page)
        kinds = ["touchStart", *["touchMove"] * (len(path) - 1)]
        for kind, fingers in zip(kinds, path):
            at = [{"x": u, "y": v} for u, v in fingers]
            session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": at})
        session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
        check(shot(page) != before, f"telephone: {what}")
        check(not page.locator("#label").is_visible(), f"telephone: {what}, choosing nothing")

    move("one finger turns", [[(x + 8 * i, y + 3 * i)] for i in range(8)])
    move("two fingers zoom", [[(x - 20 - 6 * i, y), (x + 20 + 6 * i, y)] for i in range(8)])
    page.locator("[data-look=isometric]").tap()
    for part in range(1, 10):
        page.touchscreen.tap(box["x"] + box["width"] * part / 10, y)
        page.wait_for_timeout(50)
        if page.locator("#label").is_visible():
            break
    check(page.locator("#label").is_visible(), "telephone: a tap chooses a beam")
    context.close()
