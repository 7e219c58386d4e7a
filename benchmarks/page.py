"""How long the page takes: to its first chart, and from a key to its numbers, its first chart, and all of it.

Each time ends when the browser has painted. The first chart is timed in a browser that has never seen the page and that
no program drives meanwhile.
"""

from __future__ import annotations

import os
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time
import urllib.request

from playwright.sync_api import Page, sync_playwright

from harness import asked
from serve import server

CASES = {
    "the paper's screw": "#A=paper",
    "a double nut": "#A=rexroth-40x10x6-6-double",
    "an elastic double nut": "#A=rexroth-40x10x6-6-double&A.bodies.same_side=true",
}
SIZE = (1360, 1500)  # the first chart is in it
#: Seconds that a browser has to calm down after its start, and the page to be drawn.
CALM, DRAWN = 3.0, 5.0
#: What is on the screen: numbers and curves of the module in the browser, then those of the server.
MEASURES = {
    "moved": "numbers of the module",
    "moved_curves": "its curves",
    "numbers": "numbers of the server",
    "chart": "first chart",
    "all": "all",
}
BROWSERS = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")


def chromium() -> str:
    """The browser."""
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if found is None:
        sys.exit("needs chromium: apt-get install chromium")
    return found


def first_chart(address: str, fragment: str) -> float:
    """Seconds from navigation to the first chart on the screen."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        size = "--window-size={},{}".format(*SIZE)
        options = ["--headless", "--no-sandbox", "--remote-debugging-port=0", f"--user-data-dir={profile}", size]
        process = subprocess.Popen(
            [chromium(), *options, "about:blank"], stderr=subprocess.PIPE, encoding="utf-8", start_new_session=True
        )
        assert process.stderr is not None
        port = next(found[1] for line in process.stderr if (found := re.search(r"127\.0\.0\.1:(\d+)/devtools", line)))
        time.sleep(CALM)
        asked = urllib.request.Request(f"http://127.0.0.1:{port}/json/new?{address}/{fragment}", method="PUT")
        urllib.request.urlopen(asked).close()
        time.sleep(DRAWN)
        try:
            with sync_playwright() as playwright:
                browser = playwright.chromium.connect_over_cdp(f"http://127.0.0.1:{port}")
                pages = [page for context in browser.contexts for page in context.pages if page.url.startswith(address)]
                return ends(pages[0], "chart")[0]
        finally:
            os.killpg(process.pid, signal.SIGTERM)  # the browser may be a script that starts it
            process.wait()
            process.stderr.close()


def ends(page: Page, name: str) -> list[float]:
    """When something was on the screen, in seconds after the navigation."""
    script = f"performance.getEntriesByName('{name}').map((one) => (one.startTime + one.duration) / 1000)"
    return page.evaluate(script)


def updates(page: Page, address: str, fragment: str, keys: int) -> dict[str, list[float]]:
    """Milliseconds from a key to what it changes."""
    page.goto(f"{address}/{fragment}")
    page.wait_for_selector("html[data-ready]")
    page.wait_for_selector('#results[aria-busy="false"]')
    page.focus("#f-operation-axial_load")
    for count in range(keys + 5):  # the first ones warm up
        if count == 5:
            page.evaluate("performance.clearMeasures()")
        page.keyboard.press("ArrowUp")
        page.wait_for_timeout(50)
        page.wait_for_selector('#results[aria-busy="false"]')
        page.wait_for_timeout(300)
    script = "(name) => performance.getEntriesByName(name).map((one) => one.duration)"
    return {words: times for name, words in MEASURES.items() if (times := page.evaluate(script, name))}


def main() -> None:
    """Print a table."""
    options = asked(__doc__, loads=5, keys=25)
    print(f"{os.cpu_count()} processors, load {os.getloadavg()[0]:.1f} before; medians, and the worst in brackets")
    with server() as (_, address):
        for name, fragment in CASES.items():
            loads = [first_chart(address, fragment) for _ in range(options.loads)]
            print(f"{name}: first chart after {statistics.median(loads):.2f} s ({max(loads):.2f} s)")
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=chromium(), args=["--no-sandbox"])
            page = browser.new_page(viewport={"width": SIZE[0], "height": SIZE[1]})
            for name, fragment in CASES.items():
                found = updates(page, address, fragment, options.keys)
                shown = (
                    f"{part} {statistics.median(times):.0f} ms ({max(times):.0f})" for part, times in found.items()
                )
                print(f"{name}: from a key to {', '.join(shown)}")
            browser.close()


if __name__ == "__main__":
    main()
