"""A server of its own for each file of tests: a real process, asked over a real socket."""

from __future__ import annotations

import asyncio
import concurrent.futures
import contextlib
import json
import os
import re
import signal
import tempfile
import threading
import tomllib
from collections.abc import Callable, Coroutine, Iterator, Sequence
from pathlib import Path
from typing import Any, Literal

import httpx
import psutil
import pytest
from playwright.sync_api import ConsoleMessage, Error, Page, Request

from ballscrew.faces.web.request_queue import RequestQueue
from ballscrew.faces.web.server import application
from support.commands import ROOT, Commands

#: A warning of NumPy in the server is a defect: nobody would see it.
ERRORS = ["RuntimeWarning"]
#: Seconds of one request: longer than any takes, also on a busy machine.
TIME_LIMIT = 600


class Server:
    """``ballscrew serve`` in a process."""

    def __init__(
        self,
        commands: Commands,
        *arguments: str,
        environment: dict[str, str] | None = None,
        module: str = "ballscrew.faces.cli",
        errors: Sequence[str] = ERRORS,
    ) -> None:
        self.errors = tempfile.TemporaryFile("w+", encoding="utf-8")  # noqa: SIM115  (a pipe would fill up)
        reading, writing = os.pipe()
        self._output = os.fdopen(reading, encoding="utf-8")
        with Path(os.devnull).open() as nothing:
            self.process = commands.start(
                ["serve", "--port", "0", "--time-limit", str(TIME_LIMIT), *arguments],
                folder=Path.cwd(),
                streams=[nothing.fileno(), writing, self.errors.fileno()],
                environment=environment,
                module=module,
                errors=errors,
            )
        os.close(writing)
        self.first_line = self._output.readline()
        found = re.search(r"http://\S+", self.first_line)
        assert found, self.said()
        self.address = found[0]
        self.client = httpx.Client(base_url=self.address, timeout=TIME_LIMIT, trust_env=False)

    @property
    def port(self) -> int:
        return int(self.address.rpartition(":")[2])

    @property
    def memory(self) -> float:
        """What it has of the memory, MB."""
        return psutil.Process(self.process.pid).memory_info().rss / 2**20

    @property
    def processor_time(self) -> float:
        """Seconds that it has computed, on all processors."""
        times = psutil.Process(self.process.pid).cpu_times()
        return times.user + times.system

    def post(self, address: str, body: object, **more: object) -> httpx.Response:
        content = body if isinstance(body, bytes) else json.dumps(body).encode()
        headers = {"Content-Type": "application/json", **more.pop("headers", {})}
        return self.client.post(f"/api/v1/{address}", content=content, headers=headers, **more)

    def get(self, address: str, **more: object) -> httpx.Response:
        return self.client.get(f"/api/v1/{address}", **more)

    def end(self) -> tuple[int, str]:
        """End it as Ctrl-C does: its exit code and what it said of errors."""
        self.client.close()
        self.process.send_signal(signal.SIGINT)
        code = self.process.wait(300)
        said = self.said()
        self.errors.close()
        self._output.close()
        return code, said

    def said(self) -> str:
        """What it has written of errors."""
        self.errors.seek(0)
        return self.errors.read()


def run_scene(scene: Coroutine[Any, Any, Any]) -> Any:
    """Run in a thread of its own: an open browser keeps a loop running in the main thread of this process."""
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, asyncio.wait_for(scene, TIME_LIMIT)).result()


def ask_and_leave(
    address: str,
    case: dict[str, Any],
    left: threading.Event,
    stopped: threading.Event,
    heard: Callable[[dict[str, Any]], None] = lambda message: None,
) -> None:
    """Ask the application as a server does, leave when an event says so, and wait until the work has stopped."""
    path = f"/api/v1/{address}"
    scope = {
        "type": "http", "asgi": {"version": "3.0"}, "http_version": "1.1", "method": "POST", "scheme": "http",
        "path": path, "raw_path": path.encode(), "query_string": b"", "root_path": "",
        "headers": [(b"host", b"localhost"), (b"content-type", b"application/json")],
    }  # fmt: skip
    messages = [{"type": "http.request", "body": json.dumps({"case": case}).encode(), "more_body": False}]

    async def receive() -> dict[str, Any]:
        if messages:
            return messages.pop()
        await asyncio.to_thread(left.wait, TIME_LIMIT)
        return {"type": "http.disconnect"}

    async def send(message: dict[str, Any]) -> None:
        heard(message)

    async def scene() -> None:
        asked = application(requests=RequestQueue(time_limit=TIME_LIMIT))
        await asyncio.wait_for(asked(scope, receive, send), TIME_LIMIT / 2)
        assert await asyncio.to_thread(stopped.wait, TIME_LIMIT / 2)

    run_scene(scene())


@contextlib.contextmanager
def asking(**options: Any) -> Iterator[httpx.Client]:
    """Asks the application itself, which is made with these options: a server takes a second to start."""
    testclient = pytest.importorskip("starlette.testclient", reason="needs httpx, of the extra test")
    with testclient.TestClient(
        application(**options), base_url="http://localhost", raise_server_exceptions=False
    ) as client:
        yield client


#: Files whose tests are all left out by these words: to make them while they are collected takes each worker seconds.
MADE_WHILE_COLLECTED = {"test_fields_of_a_case.py": "not long", "test_schema_of_the_api.py": "not slow and not long"}


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Leave a file out before its tests are made."""
    words = MADE_WHILE_COLLECTED.get(collection_path.name)
    return (words is not None and words in config.getoption("markexpr")) or None


@pytest.fixture(scope="module")
def server(commands):
    found = Server(commands)
    yield found
    code, errors = found.end()
    assert (code, errors) == (0, "")  # no request left a traceback


@pytest.fixture
def start(commands):
    """Start a server with options; it is ended whatever happens."""
    started: list[Server] = []

    def one(*arguments, **options):
        started.append(Server(commands, *arguments, **options))
        return started[-1]

    yield one
    for server in started:
        if not server.errors.closed:  # by the test
            server.end()


@pytest.fixture
def paper():
    """The paper's screw as tables, new for each test."""
    return tomllib.loads((ROOT / "examples" / "olaru2005.toml").read_text(encoding="utf-8"))


@pytest.fixture
def elastic():
    """A double nut whose balls are computed one by one."""
    return tomllib.loads((ROOT / "examples" / "catalogue_screw.toml").read_text(encoding="utf-8"))


# -- the page in a browser --------------------------------------------------------------------------

#: In the page: what it shows is waited for from now on, before it knows that it has to compute.
BUSY = "document.querySelector('#results').setAttribute('aria-busy', 'true')"
_VIEW = re.compile(r"&view=[^&]*")


#: The jobs of a page that is left end by themselves; nobody who comes after it asks for them.
FORGET_JOBS = """() => {
  try {
    for (const key of Object.keys(sessionStorage)) {
      if (key.startsWith("ballscrew.job.")) sessionStorage.removeItem(key);
    }
  } catch {} // a page of no address has none
}"""


class Visit:
    """Somebody at the page: what they see, and what went wrong behind it."""

    def __init__(self, page: Page, address: str) -> None:
        self.page = page
        self.address = address
        self.requests: list[str] = []
        self.complaints: list[str] = []
        #: Complaints that belong to what is tested: that of the browser about an answer of this status.
        self.expected: tuple[str, ...] = ()
        #: By how much what it shows has moved while it was loaded.
        self.shift = 0.0
        self._unanswered = 0
        self._listeners = {
            "request": self._asked,
            "requestfinished": self._answered,
            "requestfailed": self._answered,
            "console": self._heard,
            "pageerror": self._failed,
        }
        for event, listener in self._listeners.items():
            page.on(event, listener)

    def leave(self) -> None:
        """The page is for somebody else: with what it asks for, as without this visitor."""
        self.page.unroute_all()
        self.page.evaluate(FORGET_JOBS)
        self.page.goto("about:blank")
        for event, listener in self._listeners.items():
            self.page.remove_listener(event, listener)

    def _asked(self, request: Request) -> None:
        self.requests.append(request.url)
        self._unanswered += 1

    def _answered(self, _request: Request) -> None:
        self._unanswered -= 1

    def _heard(self, message: ConsoleMessage) -> None:
        if message.type in ("error", "warning"):
            self.complaints.append(f"{message.type}: {message.text} ({message.location['url']})")

    def _failed(self, error: Error) -> None:
        self.complaints.append(str(error))

    def open(self, fragment: str = "#band=0") -> Visit:
        """Open the page, without the band that comes by itself where no test is about it."""
        self.page.goto(f"{self.address}/{fragment}")
        self.page.wait_for_selector("html[data-ready]")
        return self.settle()

    def lead(self, fragment: str) -> Visit:
        """Lead the open page to another case, which is not loaded again."""
        if not self.page.url.endswith(fragment):
            before, after = (_VIEW.sub("", one) for one in ("#" + self.page.url.partition("#")[2], fragment))
            is_look = before == after  # another view of the same case asks for nothing
            self.page.evaluate(f"{'' if is_look else BUSY}; location.hash = {json.dumps(fragment)}")
            if is_look:
                self.page.wait_for_function("(fragment) => location.hash === fragment", arg=fragment)
        return self.settle()

    def go(self, view: str) -> Visit:
        """Go to a view by its tab, and to a part of it, ``nut.film``."""
        name, _, part = view.partition(".")
        self.page.locator(f'#views [data-view="{name}"]').click()
        if part:
            self.page.locator(f'[data-anchor="{view}"]').first.scroll_into_view_if_needed()
        return self

    def see(self, selector: str) -> Visit:
        """Go to the view in which something stands, and to its place there."""
        section = (
            "one.closest('[data-anchor]')?.dataset.anchor ?? one.closest('[data-in]')?.dataset.in.split(' ').at(-1)"
        )
        part = self.page.locator(selector).first.evaluate(f"(one) => one.checkVisibility() ? '' : {section}")
        if part:
            self.go(part)
        else:
            self.page.locator(selector).first.scroll_into_view_if_needed()
        return self

    def settle(self) -> Visit:
        """Wait until all that was asked for is shown."""
        self.page.wait_for_selector('#results[aria-busy="false"]')
        return self

    def rest(self, milliseconds: int) -> Visit:
        """Wait in the page itself: its timers that are due before have run then, however slow the machine is."""
        self.page.evaluate("(time) => new Promise((done) => setTimeout(done, time))", milliseconds)
        return self

    def quiet(self) -> Visit:
        """Wait until everything is answered and the page asks for nothing more by itself."""
        asked = -1
        while self._unanswered or asked != len(self.requests):
            asked = len(self.requests)
            self.rest(500)
        return self

    def type(self, field: str, text: str) -> Visit:
        """Type into a field, ``operation.axial_load``, with its section open."""
        self.reveal(field)
        self.page.locator(self.id(field)).fill(text)
        return self.settle()

    def choose(self, field: str, value: str) -> Visit:
        self.reveal(field)
        self.page.locator(self.id(field)).select_option(value)
        return self.settle()

    def unit(self, field: str, unit: str) -> Visit:
        self.reveal(field)
        self.page.locator(self.id(field).replace("#f-", "#u-")).select_option(unit)
        return self.settle()

    def reveal(self, field: str) -> None:
        opened = "e => { for (let d = e.closest('details'); d; d = d.parentElement.closest('details')) d.open = true }"
        self.page.locator(self.id(field)).evaluate(opened)

    @staticmethod
    def id(field: str) -> str:
        return f"#f-{field.replace('.', '-')}"

    def values(self) -> dict[str, str]:
        """What every field shows."""
        fields = "[...document.querySelectorAll('#form input')]"
        return self.page.evaluate(f"Object.fromEntries({fields}.map((one) => [one.id, one.value]))")

    def value(self, field: str) -> str:
        return self.page.locator(self.id(field)).input_value()

    def text(self, selector: str) -> str:
        """Text as it is read: a blank before a unit does not break a line."""
        return self.page.locator(selector).inner_text().replace("\u00a0", " ")

    def numbers(self) -> dict[str, Any]:
        """Every exact number of the answer on the page: results, contacts, parts of the torque by their words."""
        return self.page.evaluate(
            """() => {
              const exact = (one) => one.value === "" ? null : Number(one.value);
              const all = (where, name) => Object.fromEntries(
                [...document.querySelectorAll(`${where} data`)].map((one) => [name(one), exact(one)]));
              const own = (one) => one.dataset.name, beside = (one) => one.closest("li").children[1].textContent;
              return {
                results: all("#numbers", own), screw: all("#contacts td:nth-child(2)", own),
                nut: all("#contacts td:nth-child(3)", own), parts: all("#torque-chart .legend", beside),
              };
            }"""
        )

    def download(self, selector: str) -> bytes:
        """What a button gives, wherever it stands; the view stays."""
        before = self.page.locator("body").get_attribute("data-seen-view")
        self.see(selector)
        try:
            return self._download(selector)
        finally:
            self.go(before)

    def _download(self, selector: str) -> bytes:
        with self.page.expect_download() as found:
            self.page.locator(selector).click()
        return Path(found.value.path()).read_bytes()

    def outside(self) -> list[str]:
        """Requests to anything but the server."""
        own = (f"{self.address}/", f"blob:{self.address}/", "data:")
        return [one for one in self.requests if not one.startswith(own)]

    def posts(self) -> int:
        return sum("/api/v1/" in one for one in self.requests)


@pytest.fixture(scope="session")
def pages(browser) -> list[Page]:
    """Pages that nobody is at: to open a new one takes a second."""
    return []


def new_page(browser) -> Page:
    """A page that waits as long as a slow machine with other work takes."""
    page = browser.new_context().new_page()
    page.set_default_timeout(180_000)
    return page


@pytest.fixture(scope="module")
def opened(browser, server, request):
    """A page that stays open, where its module says: its address leads on. Refusals are what is looked at."""
    page = new_page(browser)
    page.set_viewport_size({"width": 1360, "height": 900})
    page.add_init_script(getattr(request.module, "AT_FIRST", ""))
    here = Visit(page, server.address).open(request.module.START)
    if "band=0" not in request.module.START:
        page.wait_for_selector("#band-words >> text=95 %")
    here.shift = page.evaluate("window.shift ?? 0")  # before anybody leads it on
    yield here
    here.leave()
    page.context.close()
    assert not [line for line in here.complaints if "status of 422" not in line and "status of 429" not in line]
    assert here.outside() == []


@pytest.fixture
def go(opened):
    """Lead the page to another case without loading it again."""
    return opened.lead


@pytest.fixture
def visit(browser, pages, server):
    """Visitors of the page; afterwards nothing was complained of, and nothing was asked from elsewhere."""
    visits: list[Visit] = []

    def one(
        address: str = server.address,
        *,
        width: int = 1360,
        height: int = 900,
        scheme: Literal["dark", "light"] = "light",
        motion: Literal["no-preference", "reduce"] = "no-preference",
        expected: tuple[str, ...] = (),
    ) -> Visit:
        page = pages.pop() if pages else new_page(browser)
        page.set_viewport_size({"width": width, "height": height})
        page.emulate_media(media="screen", color_scheme=scheme, reduced_motion=motion)
        visits.append(Visit(page, address))
        visits[-1].expected = expected
        return visits[-1]

    yield one
    for found in visits:
        found.leave()
        pages.append(found.page)
    complaints = [
        line for found in visits for line in found.complaints if not any(words in line for words in found.expected)
    ]
    outside = [line for found in visits for line in found.outside()]
    assert (complaints, outside) == ([], [])


@pytest.fixture
def ballscrew(commands, tmp_path):
    """Run a command that ends by itself."""

    def command(*arguments):
        return commands.run(arguments, folder=tmp_path, errors=ERRORS)

    return command
