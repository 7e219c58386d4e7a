"""Write screenshots of the web page, with a server and without: ``make screenshots``."""

from __future__ import annotations

import io
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image
from playwright.sync_api import Browser, sync_playwright

sys.path.append(str(Path(__file__).parents[1] / "benchmarks"))
from page import chromium
from serve import server

ROOT = Path(__file__).parents[1]
IMAGES = ROOT / "docs" / "images"
DOUBLE = "rexroth-40x10x6-6-double"
LARGEST = 300_000  # bytes of a picture
#: The page without a server, and the case that it shows.
STATIC, STATIC_SIZE = f"A={DOUBLE}", {"width": 1360, "height": 860}
COMMAND = [sys.executable, "-m", "ballscrew.faces.cli"]

DESKTOP = {"width": 1440, "height": 900}

#: Tall enough that all charts of a card are near the viewport, and drawn.
TALL = {"width": 1360, "height": 6000}
#: Pixels of a card that a picture shows, from its top.
HIGHEST = 2000
OF_CARDS = {
    "app_duty.png": ("duty", "#A=vertical-axis&band=0&view=duty"),
    "app_warm_up.png": ("warm-up", "#A=warm-up&band=0&view=heat&rest=1&heat=band"),
}


def save(name: str, png: bytes) -> None:
    """Write a picture with a palette: drawings need few colours."""
    path = IMAGES / name
    Image.open(io.BytesIO(png)).convert("RGB").quantize(128, dither=Image.Dither.NONE).save(path, optimize=True)
    size = path.stat().st_size
    print(f"{path.relative_to(ROOT)}: {size / 1000:.0f} kB")
    if size > LARGEST:
        sys.exit(f"{name} is larger than {LARGEST / 1000:.0f} kB")


def of_page(browser: Browser, address: str) -> None:
    """Screenshot of the web page."""
    page = browser.new_page(color_scheme="light", viewport=DESKTOP)
    page.goto(f"{address}/#A=paper")
    page.wait_for_selector("html[data-ready]")
    page.wait_for_selector('#results[aria-busy="false"]')
    page.wait_for_selector("#band-words >> text=95 %")
    page.wait_for_selector("#torque-chart .plot[data-drawn]")
    page.wait_for_timeout(500)
    save("app_light.png", page.screenshot())
    page.close()


def of_cards(browser: Browser, address: str) -> None:
    """Screenshots of cards of the web page with their answers."""
    for name, (card, fragment) in OF_CARDS.items():
        page = browser.new_page(viewport=TALL, device_scale_factor=0.75)
        page.goto(f"{address}/{fragment}")
        page.wait_for_selector(f"#{card} .card-result[aria-busy=false]")
        for chart in page.locator(f"#{card} .chart:visible").all():  # drawn when it is seen
            chart.scroll_into_view_if_needed()
            chart.locator(".plot[data-drawn]").wait_for()
        page.wait_for_timeout(2000)
        box = page.locator(f"section[aria-labelledby={card}-title]").bounding_box()
        assert box
        page.evaluate("scrollTo(0, 0)")
        save(name, page.screenshot(clip={**box, "height": min(box["height"], HIGHEST)}))
        page.close()


def of_static_page(browser: Browser) -> None:
    """Screenshot of the page without a server."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "page.html"
        kinds = ["--model", "reference", "--nut", "row", "--nut", "double", "--nut", "double+elastic"]
        subprocess.run([*COMMAND, "site", file, "--single", *kinds], check=True, capture_output=True)
        page = browser.new_page(color_scheme="light", viewport=STATIC_SIZE)
        page.goto(f"{file.as_uri()}#{STATIC}")
        page.wait_for_selector("html[data-ready]")
        page.locator("#numbers .interval", has_text=" to ").first.wait_for()
        page.wait_for_timeout(1000)
        save("static_page.png", page.screenshot())
        page.close()


def main() -> None:
    """Write all pictures."""
    IMAGES.mkdir(exist_ok=True)
    with server() as (_, address), sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium(), args=["--no-sandbox"])
        for pictures in (of_page, of_cards):
            pictures(browser, address)
        of_static_page(browser)
        browser.close()


if __name__ == "__main__":
    main()
