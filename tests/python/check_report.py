"""Opens reports in a headless browser and does what a reader does: time, menu, cut, mouse, keys.

    python check_report.py [--shots FOLDER] REPORT.html ...

Asserts that each page opens within three seconds (longer where the processor is shared) without a word on the console or a request to anywhere, is smaller than 15 MB,
and that the picture of the vessel changes when it should. Ends with 1 where something is wrong. Wants Chromium on the path.
"""

import argparse
import io
import os
import pathlib
import shutil
import sys
import time

from PIL import Image, ImageChops
from playwright.sync_api import sync_playwright

MOST_BYTES = 15_000_000
MOST_SECONDS = 3.0
# A graphics card drawn by the processor: there is none where tests run.
FLAGS = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-sandbox"]


def patience():
    """Seconds a page may take: more where other programs have the processor too, which here also stands in for a graphics card."""
    return MOST_SECONDS * max(1.0, os.getloadavg()[0] / os.cpu_count())


class Page:
    """A report that is open, with what went wrong so far."""

    def __init__(self, browser, path, shots, **options):
        self.path = path
        self.shots = shots
        self.faults = []
        self.page = browser.new_page(**options)
        self.page.on("console", lambda message: self.fault(f"console: {message.type}: {message.text}"))
        self.page.on("pageerror", lambda error: self.fault(f"script: {error}"))
        self.page.on("request", self.asked)
        began = time.monotonic()
        self.page.goto(path.resolve().as_uri())
        if self.page.locator("#viewer-root").count():
            self.page.wait_for_selector("#viewer-root:not([hidden])", timeout=10_000)
        self.settle()
        self.seconds = time.monotonic() - began

    def fault(self, text):
        self.faults.append(f"{self.path}: {text}")

    def check(self, holds, text):
        if not holds:
            self.fault(text)

    def asked(self, request):
        if not request.url.startswith(("file:", "data:")):
            self.fault(f"asks for {request.url}")

    def settle(self):
        """Waits until what was asked for is drawn."""
        self.page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 30))))")

    def picture(self, name=None):
        self.settle()
        image = Image.open(io.BytesIO(self.page.locator(".viewer-stage").screenshot())).convert("RGB")
        self.save(image, name)
        return image

    def save(self, image, name):
        if self.shots and name:
            image.save(self.shots / f"{self.path.parent.name}-{name}.png")

    def whole(self, name):
        self.settle()
        self.save(Image.open(io.BytesIO(self.page.screenshot(full_page=True))), name)

    def text(self, name):
        return self.page.locator(f"#viewer-{name}").inner_text()

    def set_range(self, name, value):
        self.page.locator(f"#viewer-{name}").evaluate(
            "(input, value) => { input.value = value; input.dispatchEvent(new Event('input')); }", str(value)
        )

    def middle(self):
        box = self.page.locator("#viewer-canvas").bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def difference(one, other):
    """Part of the pixels that differ visibly."""
    if one.size != other.size:
        return 1.0
    grey = ImageChops.difference(one, other).convert("L").histogram()
    return sum(grey[12:]) / (one.width * one.height)


def colours(image):
    """Part of the pixels that are coloured at all: neither paper nor grey."""
    saturation = image.convert("HSV").getchannel("S").histogram()
    return sum(saturation[90:]) / (image.width * image.height)


def changes(page, before, name, what, least=0.001):
    after = page.picture(name)
    page.check(difference(before, after) > least, f"the picture stays as it was after {what}")
    return after


def fields(page):
    """Every entry of the menu is drawn and differs from the others."""
    menu = page.page.locator("#viewer-field")
    values = menu.locator("option").evaluate_all("(options) => options.map((option) => option.value)")
    first = page.picture("start")
    page.check(colours(first) > 0.02, "the first picture has no colours")
    seen = [first]
    for k, value in enumerate(values[1:], 1):
        menu.select_option(value)
        picture = page.picture(f"field{k}")
        page.check(all(difference(picture, other) > 0.001 for other in seen), f"entry {k} of the menu looks like another")
        seen.append(picture)
    menu.select_option(values[0])
    page.check(difference(page.picture(), first) < 0.001, "the first entry of the menu does not come back")
    return values, first


def over_time(page, first):
    slider = page.page.locator("#viewer-frame")
    if not slider.is_visible():
        return
    last = int(slider.get_attribute("max"))
    clock = page.text("clock")
    page.set_range("frame", last // 2)
    page.check(page.text("clock") != clock, "the clock does not follow the slider")
    charts = page.page.locator("svg[data-time]").count()
    page.check(page.page.locator("svg .now").count() == charts, "a chart does not show the time")
    changes(page, first, "time", "the slider was moved")
    page.set_range("frame", last)
    page.page.locator("#viewer-play").click()
    page.page.wait_for_timeout(700)
    page.page.locator("#viewer-play").click()
    page.check(page.text("clock") != clock, "nothing plays")
    page.set_range("frame", last)
    page.check(difference(page.picture(), first) < 0.001, "the last time does not come back")


def by_hand(page, first):
    mouse, (x, y) = page.page.mouse, page.middle()
    page.page.locator("#viewer-canvas").scroll_into_view_if_needed()
    x, y = page.middle()

    def drag(dx, dy, button="left"):
        mouse.move(x, y)
        mouse.down(button=button)
        mouse.move(x + dx / 2, y + dy / 2, steps=3)
        mouse.move(x + dx, y + dy, steps=3)
        mouse.up(button=button)

    drag(160, 60)
    turned = changes(page, first, "turned", "a drag")
    drag(80, 0, "right")
    moved = changes(page, turned, None, "a drag with the right button")
    mouse.wheel(0, -400)
    changes(page, moved, "zoomed", "the wheel")
    mouse.dblclick(x, y)
    mouse.move(x, 2)
    page.check(difference(page.picture(), first) < 0.001, "a double click does not reset the view")
    page.set_range("cut", 60)
    changes(page, first, "cut", "the cut was moved")
    page.page.reload()
    page.settle()
    canvas = page.page.locator("#viewer-canvas")
    canvas.scroll_into_view_if_needed()
    before = page.picture()
    canvas.focus()
    for key in ["ArrowLeft", "ArrowUp", "Shift+ArrowRight", "+"]:
        page.page.keyboard.press(key)
        before = changes(page, before, None, f"the key {key}")
    page.page.keyboard.press("Home")
    page.check(difference(page.picture(), before) > 0.001, "Home does nothing")
    for view in ["back", "side", "end", "front"]:
        page.page.locator(f"[data-view={view}]").click()
        before = changes(page, before, view, f"the view {view}")


def probe(page):
    """Looks for the vessel along the middle of the picture, reads a value off it and keeps it."""
    box = page.page.locator("#viewer-canvas").bounding_box()
    label = page.page.locator("#viewer-probe")
    for k in range(1, 40):
        x, y = box["x"] + box["width"] * k / 40, box["y"] + box["height"] * (0.3 + 0.4 * (k % 7) / 6)
        page.page.mouse.move(x, y)
        page.settle()
        if label.is_visible():
            break
    page.check(label.is_visible(), "no value is told anywhere along the picture")
    page.page.mouse.down()
    page.page.mouse.up()
    page.picture("mark")
    page.check("mm" in page.text("mark-text"), "a click keeps no place")
    page.page.keyboard.press("Escape")
    page.settle()
    page.check(not page.page.locator("#viewer-mark").is_visible(), "Escape does not forget the place")


def opened(browser, path, shots):
    """The page, opened anew where that took long: other programs may have the processor."""
    for attempt in range(3):
        page = Page(browser, path, shots, viewport={"width": 1280, "height": 900})
        if page.seconds < patience() or attempt == 2:
            return page
        page.page.close()


def check(browser, path, shots):
    page = opened(browser, path, shots)
    size = path.stat().st_size
    page.check(size < MOST_BYTES, f"{size} bytes are too many")
    page.check(page.seconds < patience(), f"opens in {page.seconds:.2f} s, more than {patience():.1f} s")
    page.whole("page")
    if page.page.locator("#viewer-root").count():
        values, first = fields(page)
        over_time(page, first)
        by_hand(page, first)
        probe(page)
        print(f"{path}: {size / 1e6:.2f} MB, open in {page.seconds:.2f} s, {len(values)} entries in the menu")
    else:
        page.fault("there is nothing to turn")
    page.page.close()

    narrow = Page(browser, path, shots, viewport={"width": 390, "height": 844}, color_scheme="dark", has_touch=True)
    narrow.check(
        narrow.page.evaluate("document.documentElement.scrollWidth <= innerWidth"), "a narrow page is wider than its window"
    )
    narrow.whole("narrow-dark")
    narrow.page.close()

    plain = Page.__new__(Page)
    plain.path, plain.shots, plain.faults = path, shots, []
    context = browser.new_context(java_script_enabled=False)
    bare = context.new_page()
    bare.goto(path.resolve().as_uri())
    plain.check(bare.locator("#viewer-missing").is_visible(), "without scripts nothing says what is missing")
    plain.check(not bare.locator("#viewer-root").is_visible(), "without scripts an empty picture stands there")
    context.close()
    return page.faults + narrow.faults + plain.faults


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--shots", type=pathlib.Path, help="folder for pictures of what was seen")
    parser.add_argument("reports", nargs="+", type=pathlib.Path)
    arguments = parser.parse_args()
    if arguments.shots:
        arguments.shots.mkdir(parents=True, exist_ok=True)
    chromium = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if chromium is None:
        sys.exit("there is no Chromium on the path")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=FLAGS)
        # What follows is the time of a page, not that of the browser's start.
        browser.new_page().close()
        faults = [fault for path in arguments.reports for fault in check(browser, path, arguments.shots)]
        browser.close()
    print("\n".join(faults))
    print(f"{len(arguments.reports)} reports, {len(faults)} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
