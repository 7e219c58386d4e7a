"""The page in a browser, from files and from a plain web server, without anything of ballscrew behind it."""

from __future__ import annotations

import functools
import http.server
import threading
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page

from ballscrew.compiler.kernels import kernel
from ballscrew.faces.page import site

#: A row, and nuts with a preload, rigid and elastic: what differs in the page.
MODELS = ("reference",)
NUTS = ("row", "double", "double+elastic")
#: The sub-path at which the page lies: it knows no address but those beside it.
PATH = "tools/screws/"


#: Everything that was asked for is computed, and shown.
RESTS = """() => {
  const results = document.getElementById("results");
  return results.getAttribute("aria-busy") === "false" && !results.classList.contains("moving");
}"""
OPEN_ALL = "for (const one of document.querySelectorAll('form details')) one.open = true"


class Plain(http.server.SimpleHTTPRequestHandler):
    """A server of files alone."""

    extensions_map = {  # noqa: RUF012  (as that of its base)
        **http.server.SimpleHTTPRequestHandler.extensions_map, ".wasm": "application/wasm", ".js": "text/javascript",
    }  # fmt: skip

    def log_message(self, *_: object) -> None:
        """Nothing is said."""


@pytest.fixture(scope="session")
def folder(tmp_path_factory) -> Path:
    """The page as a folder below a root."""
    if not kernel.available():
        pytest.skip('needs a compiler: pip install "ballscrew[fast]"')
    root = tmp_path_factory.mktemp("site")
    site.write(root / PATH, site.site(MODELS, NUTS))
    return root


@pytest.fixture(scope="session")
def address(folder):
    """The page at a plain web server, below a path."""
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Plain, directory=folder))
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    yield f"http://127.0.0.1:{server.server_port}/{PATH}"
    server.shutdown()
    server.server_close()


class Visit:
    """Somebody at the page, what they see, and what it asked for."""

    def __init__(self, page: Page, address: str) -> None:
        self.page = page
        self.address = address
        self.requests: list[str] = []
        self.complaints: list[str] = []
        page.on("request", lambda request: self.requests.append(request.url))
        page.on(
            "console", lambda line: self.complaints.append(line.text) if line.type in ("error", "warning") else None
        )
        page.on("pageerror", lambda error: self.complaints.append(str(error)))

    def open(self, fragment: str = "") -> Visit:
        self.page.goto(f"{self.address}{fragment}")
        self.page.wait_for_selector("html[data-ready]")
        return self.rest()

    def rest(self) -> Visit:
        """Until the page has computed what it was asked for."""
        self.page.wait_for_function(RESTS)
        return self

    def slide(self, path: str, value: float) -> dict[str, Any]:
        """Move a slider to a number in the unit it is shown in; what the page says of itself then."""
        self.page.evaluate(
            """([path, value]) => {
              const slider = document.querySelector(`input[type=range][name="${path}"]`);
              slider.min = String(Math.min(slider.min, value));
              slider.max = String(Math.max(slider.max, value));
              slider.value = String(value);
              slider.dispatchEvent(new Event("input", { bubbles: true }));
              slider.dispatchEvent(new Event("change", { bubbles: true }));
            }""",
            [path, value],
        )
        return self.rest().state()

    def type(self, path: str, text: str) -> None:
        """Type a text into a field."""
        self.page.evaluate(OPEN_ALL)
        self.page.locator(f"#f-{path.replace('.', '-')}").fill(text)
        self.rest()

    def state(self) -> dict[str, Any]:
        """What the page says of itself."""
        return self.page.evaluate("window.ballscrew")


@pytest.fixture
def visit(browser, request):
    """Visitors of the page; afterwards nothing was complained of, and nothing was asked from elsewhere."""
    visits: list[Visit] = []
    contexts: list[Any] = []

    def one(*, width: int = 1440, height: int = 900, scheme: str = "light", at: str = "") -> Visit:
        at = at or request.getfixturevalue("address")
        size = {"width": width, "height": height}
        contexts.append(browser.new_context(viewport=size, color_scheme=scheme, locale="en-GB"))
        page = contexts[-1].new_page()
        page.set_default_timeout(60_000)
        visits.append(Visit(page, at))
        return visits[-1]

    yield one
    for context in contexts:
        context.close()
    complaints = [line for found in visits for line in found.complaints]
    outside = [
        line
        for found in visits
        for line in found.requests
        if not line.startswith((found.address, "data:", "blob:", "file:"))
    ]
    assert (complaints, outside) == ([], [])
