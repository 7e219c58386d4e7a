"""The way of a value through the program: the modules that a reader of it goes through, counted by profiling.

A *stop* is a module of ballscrew whose functions take the value as an argument or return it: by itself, under its name,
or in lists, tuples, tables and arrays; calls and returns that follow each other in one module are one stop. *Back*
counts the stops at modules that the value was in before. Values within other objects are not looked for: there they are
kept, and nobody has to follow them. Nor are those in the buffers of kernels, whose memory is used again.

- ``set, as text``: ``ballscrew run CASE --set operation.axial_load="4.3217 kN"``, until the text is a number.
- ``set, as number``: the same load in newton, until it is printed.
- ``sweep``: a preload that is varied by ``bs.sweep``.
- ``fit``: the torque of a row of a log, from the text in the file to the score of the fit.

With ``--page`` one key in the page, in a browser, until all of it is drawn: its requests, the cases that the server
builds for them, and the modules of JavaScript whose functions are called on the way, in their order. Modules that write
words and elements (``LEAVES``) are not counted there: each line on the page goes through them. A loop counts once.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import math
import re
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from types import FrameType, MappingProxyType
from typing import Any, NamedTuple

import numpy as np

import ballscrew as bs
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from ballscrew.faces.cli.main import app

ROOT = Path(__file__).parents[1]
SOURCE = f"{ROOT / 'src' / 'ballscrew'}/"
PAGE = ROOT / "src" / "ballscrew" / "faces" / "web" / "page"
CASE, LOG = ROOT / "examples" / "olaru2005.toml", ROOT / "examples" / "rig_log.csv"
#: Parts of a function that are read with it.
WITHIN = ("<genexpr>", "<listcomp>", "<dictcomp>", "<setcomp>", "<lambda>", "<module>")
#: Items of a list or a table in which a value is looked for, and tables within tables.
MOST_ITEMS, DEEPEST = 5_000, 6
#: Modules that hand arrays around which hold old numbers until they are written to.
BUFFERS = ("compiler/kernels/", "engine/evaluation/evaluation.py")
#: Values that occur nowhere else.
LOAD_TEXT, LOAD = "4.3217 kN", 4321.7
PRELOAD = 4326.123
#: Torque of a row of the log, as it is written there.
TORQUE = "11.7581"

Test = Callable[[Any], bool]


class Walk(NamedTuple):
    """The modules on the way of a value in their order, and how often each function was called, and with the value."""

    stops: Sequence[str]
    calls: Counter[str]
    carrying: Counter[str]

    @property
    def back(self) -> int:
        """The number of stops at modules that come before."""
        return len(self.stops) - len(set(self.stops))


def is_number(value: float) -> Test:
    """A test for a number, also within an array."""

    def test(found: Any) -> bool:
        if isinstance(found, np.ndarray):
            return found.dtype.kind == "f" and bool(np.any(np.isclose(found, value, rtol=1e-12, atol=0)))
        return isinstance(found, float | int) and math.isclose(found, value, rel_tol=1e-12)

    return test


def is_text(part: str) -> Test:
    """A test for a text with this part."""
    return lambda found: isinstance(found, str) and part in found


def either(*tests: Test) -> Test:
    """A test that any of these passes."""
    return lambda found: any(test(found) for test in tests)


def holds(value: Any, test: Test, depth: int = DEEPEST) -> bool:
    """Test a value and what is in it, if it is a list, a tuple or a table."""
    if test(value):
        return True
    if depth == 0:
        return False
    inside: Iterable[Any] = ()
    if isinstance(value, dict | MappingProxyType):
        inside = [*value, *value.values()]
    elif isinstance(value, list | tuple | set | frozenset):
        inside = value
    else:
        return False
    return len(value) <= MOST_ITEMS and any(holds(one, test, depth - 1) for one in inside)


def walk(work: Callable[[], Any], test: Test) -> Walk:
    """The way of a value through some work."""
    stops: list[str] = []
    calls: Counter[str] = Counter()
    carrying: Counter[str] = Counter()

    def profile(frame: FrameType, event: str, result: Any) -> None:
        code = frame.f_code
        if event not in ("call", "return") or not code.co_filename.startswith(SOURCE) or code.co_name in WITHIN:
            return
        module = code.co_filename.removeprefix(SOURCE)
        function = f"{module}: {code.co_qualname}"
        if event == "call":
            calls[function] += 1
            given = code.co_argcount + code.co_kwonlyargcount + bool(code.co_flags & 4) + bool(code.co_flags & 8)
            values = [frame.f_locals.get(name) for name in code.co_varnames[:given]]
        else:
            values = [result]
        if module.startswith(BUFFERS) or not any(holds(value, test) for value in values):
            return
        if event == "call":
            carrying[function] += 1
        if stops[-1:] != [module]:
            stops.append(module)

    sys.setprofile(profile)
    try:
        work()
    finally:
        sys.setprofile(None)
    return Walk(stops, calls, carrying)


# -- the walks in Python ----------------------------------------------------------------------------


def command(*arguments: str) -> Callable[[], None]:
    """A command whose output nobody reads."""

    def run() -> None:
        with contextlib.redirect_stdout(io.StringIO()):
            app([*arguments], standalone_mode=False)

    return run


def swept() -> None:
    """A preload varied by a sweep."""
    bs.sweep(
        bs.FrictionModel.reference(), SCREW, OIL, nut=bs.DoubleNut(preload=1000.0), axial_load=[100.0, 2000.0],
        screw_speed=[10.0, 60.0], **{"nut.preload": [2000.0, PRELOAD]},  # pyright: ignore[reportArgumentType]  (not a name in Python)
    )  # fmt: skip


def walks() -> dict[str, tuple[Callable[[], None], Test]]:
    """The walks by name: what is run, and the value in it."""
    setting = command("run", str(CASE), "--set", f'operation.axial_load="{LOAD_TEXT}"')
    fitting = command("fit", str(LOG), "--case", str(ROOT / "examples" / "rig.toml"))
    return {
        "set, as text": (setting, is_text(LOAD_TEXT)),
        "set, as number": (setting, is_number(LOAD)),
        "sweep": (swept, either(is_number(PRELOAD), lambda found: isinstance(found, str) and found == "nut.preload")),
        "fit": (fitting, either(is_text(TORQUE), is_number(float(TORQUE)))),
    }


# -- one key on the page ----------------------------------------------------------------------------

#: Modules of the page that write words, numbers and elements.
LEAVES = ("dom.js", "messages.js", "plot.js", "schema.js", "symbols.js", "units.js")
#: The head of a function or a method up to its parameters, and what is put at the beginning of its body.
FUNCTION = re.compile(r"^ *(?:(?:export )?(?:async )?function\*? \w+|(?:async )?#?\w+)\(", re.MULTILINE)
MARK = 'globalThis.walk?.push("{}");'
#: Stops of a loop at most.
LONGEST_LOOP = 8
DESIGNS = {"one design": "#A=paper&band=0", "two designs": "#A=paper&B=hiwin-40-20k4&band=0"}


def without_loops(stops: Sequence[str]) -> list[str]:
    """Stops of which those that repeat the ones just before them are left out: a loop is read once."""
    found: list[str] = []
    for stop in stops:
        found.append(stop)
        for length in range(1, LONGEST_LOOP + 1):
            if found[-length:] == found[-2 * length : -length]:
                del found[-length:]
    return found


def marked(source: str, module: str) -> str:
    """A module of JavaScript that notes each call of its functions."""
    found, last = [], 0
    for head in FUNCTION.finditer(source):
        place, depth = head.end(), 1
        while depth:  # to the end of the parameters
            depth += {"(": 1, ")": -1}.get(source[place], 0)
            place += 1
        if not source.startswith(" {", place):
            continue  # a call
        body = place + 2
        found += [source[last:body], MARK.format(module)]
        last = body
    return "".join([*found, source[last:]])


@contextlib.contextmanager
def counting_server(builds: Path) -> Iterator[str]:
    """The address of a server that writes a line into a file for each case that it builds."""
    command = [sys.executable, __file__, "--serve", str(builds)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, encoding="utf-8") as process:
        assert process.stdout is not None
        found = re.search(r"http://\S+", process.stdout.readline())
        assert found
        try:
            yield found[0]
        finally:
            process.terminate()


def serve(builds: Path) -> None:
    """Serve the page, and count the cases that are built."""
    from ballscrew.cases.case_files import case_file

    build = case_file.build

    def counted(*arguments: Any, **options: Any) -> Any:
        with builds.open("a") as file:
            file.write("built\n")
        return build(*arguments, **options)

    case_file.build = counted
    app(["serve", "--port", "0"], standalone_mode=False)


def page() -> None:
    """Print what one key on the page takes."""
    from playwright.sync_api import Route, sync_playwright

    from page import chromium

    def note(route: Route) -> None:
        module = route.request.url.rpartition("/page/")[2]
        route.fulfill(response=(answer := route.fetch()), body=marked(answer.text(), module))

    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        builds = Path(folder) / "builds"
        with counting_server(builds) as address:
            browser = playwright.chromium.launch(executable_path=chromium(), args=["--no-sandbox"])
            for name, fragment in DESIGNS.items():
                shown = browser.new_page(viewport={"width": 1360, "height": 1500})
                shown.route("**/page/**/*.js", note)
                shown.goto(f"{address}/{fragment}")
                shown.wait_for_selector("html[data-ready]")
                shown.wait_for_selector('#results[aria-busy="false"]')
                shown.wait_for_timeout(2000)
                asked: list[str] = []
                shown.on("request", lambda one, asked=asked: asked.append(one.url))
                builds.write_text("")
                shown.evaluate("globalThis.walk = []")
                shown.focus("#f-operation-axial_load")
                shown.keyboard.press("ArrowUp")
                shown.wait_for_timeout(100)
                shown.wait_for_selector('#results[aria-busy="false"]')
                shown.wait_for_timeout(2000)
                stops = without_loops([one for one in shown.evaluate("globalThis.walk") if one not in LEAVES])
                back = len(stops) - len(set(stops))
                addresses = [one.partition("/api/v1/")[2] for one in asked if "/api/v1/" in one]
                print(f"a key, {name}: {len(addresses)} requests ({', '.join(addresses)})")
                print(f"    {len(builds.read_text().split())} cases built")
                print(f"    {len(stops)} stops, {back} back, in {len(set(stops))} modules of JavaScript;", end=" ")
                print(f"main.js is entered {stops.count('main.js')} times")
                print("      " + " ".join(stops))
                shown.close()
            browser.close()


#: Functions whose calls are printed with a walk.
TELLING: dict[str, Sequence[str]] = {
    "set, as text": ("units.py: parse", "uncertain_value.py: _by_pattern", "case_file.py: build"),
    "set, as number": ("fault_of", "without_unit"),
    "sweep": ("Configuration.inputs", "outputs.py: inputs_of", "fields_of", "Configuration.changed"),
    "fit": ("Configuration.inputs", "inputs_of", "case_file.py: build"),
}


def main() -> None:
    """Print the walks."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--stops", action="store_true", help="print the modules in their order, too")

    parser.add_argument("--page", action="store_true", help="one key on the page, too; needs chromium")
    parser.add_argument("--serve", type=Path, help=argparse.SUPPRESS)
    asked = parser.parse_args()
    if asked.serve:
        serve(asked.serve)
        return
    for name, (work, test) in walks().items():
        work()  # what is imported and kept by the first one is no part of the way
        found = walk(work, test)
        called = {key: n for part in TELLING[name] for key, n in found.calls.items() if key.endswith(part)}
        with_value = {key: found.carrying[key] for key in called}
        print(f"{name}: {len(found.stops)} stops, {found.back} back, in {len(set(found.stops))} modules")
        print("".join(f"    {n} × {key}, {with_value[key]} with the value\n" for key, n in called.items()), end="")
        if asked.stops:
            print("".join(f"      {stop}\n" for stop in found.stops), end="")
    if asked.page:
        page()


if __name__ == "__main__":
    main()
