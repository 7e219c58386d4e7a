"""The static page in a browser, from files and from a plain web server, without anything of ballscrew behind it."""

from __future__ import annotations

import functools
import http.server
import threading
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page

from ballscrew.compiler.kernels import kernel
from ballscrew.faces.site import site

#: A row, and nuts with a preload, rigid and elastic: what differs in the page.
MODELS = ("reference",)
NUTS = ("row", "double", "double+elastic")
#: The sub-path at which the page lies: it knows no address but those beside it.
PATH = "tools/screws/"


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
        return self

    def rest(self, milliseconds: int = 400) -> Visit:
        self.page.evaluate("(time) => new Promise((done) => setTimeout(done, time))", milliseconds)
        return self

    def slide(self, path: str, value: float) -> dict[str, Any]:
        """Move a slider to a number in the unit it is shown in; what the page says of itself at once."""
        return self.page.evaluate(
            """([path, value]) => {
              const slider = document.querySelector(`input[type=range][name="${path}"]`);
              slider.value = String(value);
              slider.dispatchEvent(new Event("input", { bubbles: true }));
              return structuredClone(window.ballscrew);
            }""",
            [path, value],
        )

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
