"""A plugin of pytest: what is run in each test, its fixtures included, counts for the function of the test.

What a fixture runs that several tests share counts for all of them, not for the first alone.
Lines of Python are counted by coverage, those of commands in their processes (``sitecustomize.py``), functions of the
page's JavaScript by the browser.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import time
from collections import defaultdict
from collections.abc import Generator, Mapping, Sequence
from pathlib import Path
from typing import Any

import coverage
import pytest

from ballscrew.faces.page import bundle

_SECONDS: dict[str, float] = defaultdict(float)
#: Tests of each fixture that they share.
_SHARED: dict[str, set[str]] = defaultdict(set)
#: What lines count for: a test, and the fixtures that are being made.
_CONTEXTS: list[str] = []
#: Tests by file below ``src/ballscrew`` and line.
_SCRIPTS: dict[str, dict[int, set[str]]] = defaultdict(lambda: defaultdict(set))
#: Pages that were opened, with their counters.
_COUNTERS: list[tuple[Any, Any]] = []
_ADDRESS = re.compile(r"/page-[0-9a-f]{16}\.js$")
_ROOM = "faces/page"
#: Where a module begins in the script of the page: its lines are those of its file.
_MODULE = re.compile(r'ofModule\["(.+)"\] = \(\(\) => \{$')


def pytest_configure() -> None:
    """Count in each page that a test opens."""
    if "SCRIPTS_REACHED" not in os.environ:
        return
    from playwright.sync_api import BrowserContext

    opened = BrowserContext.new_page

    def counted(context: BrowserContext) -> Any:
        page = opened(context)
        counter = context.new_cdp_session(page)
        counter.send("Profiler.enable")
        counter.send("Profiler.startPreciseCoverage", {"callCount": True, "detailed": True})
        _COUNTERS.append((page, counter))
        return page

    BrowserContext.new_page = counted  # type: ignore[method-assign]  (a plugin of measurements)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Generator[None, object, object]:
    """Count lines for the test; for each of its parameters only where the environment has ``EACH_PARAMETER``."""
    with _counted(_test(item)):
        return (yield)


@pytest.hookimpl(wrapper=True)
def pytest_fixture_setup(
    fixturedef: pytest.FixtureDef[Any], request: pytest.FixtureRequest
) -> Generator[None, object, object]:
    """Count lines of a fixture that is made once for several tests."""
    if fixturedef.scope == "function":
        return (yield)
    name = f"fixture {fixturedef.argname} of {fixturedef.baseid}"
    for item in request.session.items:
        if fixturedef.argname in getattr(item, "fixturenames", ()) and item.nodeid.startswith(fixturedef.baseid):
            _SHARED[name].add(_test(item))
    with _counted(name):
        return (yield)


@contextlib.contextmanager
def _counted(name: str) -> Generator[None]:
    """Count lines and seconds for a name, and afterwards for the one before."""
    measured = coverage.Coverage.current()
    before, started = _CONTEXTS[-1:], time.perf_counter()
    _CONTEXTS.append(name)
    os.environ["COUNTS_FOR"] = name  # for the commands that a test starts
    if measured is not None:
        measured.switch_context(name)
    try:
        yield
    finally:
        _CONTEXTS.pop()
        os.environ["COUNTS_FOR"] = "".join(before)
        seconds = time.perf_counter() - started
        _SECONDS[name] += seconds
        for other in before:
            _SECONDS[other] -= seconds
        if measured is not None:
            measured.switch_context("".join(before))


def _test(item: pytest.Item) -> str:
    return item.nodeid if "EACH_PARAMETER" in os.environ else item.nodeid.partition("[")[0]


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Generator[None, object, object]:
    """Count functions of scripts, and the parts of them that were run, while the page is open."""
    try:
        return (yield)
    finally:
        for page, counter in _COUNTERS:
            if not page.is_closed():
                _add(counter, _test(item))


def _add(counter: Any, test: str) -> None:
    lines = bundle.script().split("\n")
    for script in counter.send("Profiler.takePreciseCoverage")["result"]:
        if not _ADDRESS.search(script["url"]):
            continue
        ranges = [part for function in script["functions"] for part in function["ranges"]]
        found = reached("\n".join(lines), ranges)
        name, first = "", 0
        for place, text in enumerate(lines, start=1):
            if module := _MODULE.match(text):
                name, first = module[1], place
            elif name and place in found:
                _SCRIPTS[f"{_ROOM}/{name}"][place - first].add(test)


def reached(text: str, ranges: Sequence[Mapping[str, int]]) -> set[int]:
    """Lines of a script that were run, by ranges as the browser counts them: outer ones, then those within them.

    The lines on which a range begins and ends also have something of what is around it, such as a condition.
    """
    found: set[int] = set()
    for part in sorted(ranges, key=lambda one: (one["startOffset"], -one["endOffset"])):
        first, last = (text.count("\n", 0, part[f"{end}Offset"]) + 1 for end in ("start", "end"))
        if part["count"]:
            found.update(range(first, last + 1))
        else:
            found.difference_update(range(first + 1, last))
    return found


def pytest_sessionfinish() -> None:
    """Write what each test takes, and which lines of scripts it reaches."""
    measured = {"seconds": _SECONDS, "shared": {name: sorted(tests) for name, tests in _SHARED.items()}}
    Path(os.environ["SECONDS_OF_TESTS"]).write_text(json.dumps(measured), encoding="utf-8")
    if "SCRIPTS_REACHED" in os.environ:
        found = {name: {line: sorted(tests) for line, tests in each.items()} for name, each in _SCRIPTS.items()}
        Path(os.environ["SCRIPTS_REACHED"]).write_text(json.dumps(found), encoding="utf-8")
