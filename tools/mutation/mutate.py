"""A sample of one-line changes, each run against the tests of its room: ``make mutate [SAMPLE=n] [SEED=s]``.

First the tests of each room are run once, to see which lines each of them reaches. Then each change is made in a copy
of the source, and the tests that reach its line run until one fails. A change that no test notices *survives*: it needs
a test with a truth of its own, or an entry in ``equivalent.toml`` that says why no result can tell the two apart.

Nothing is written into the working tree: copies and measurements lie in ``out/mutation``.
"""

from __future__ import annotations

import argparse
import concurrent.futures
import hashlib
import json
import os
import queue
import random
import shutil
import sys
import time
import tomllib
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import reach
from changes import Change, changes_of
from reach import HERE, ROOT, SOURCE
from warm_process import run_pytest

WORK = ROOT / "out" / "mutation"
#: A run of tests that takes so many times as long as they do, and so many seconds more, has noticed the change.
LONGER, SECONDS_MORE = 4.0, 60.0
#: The tests of both tiers: what ``make test`` leaves to ``make test-slow`` answers for its lines, too.
PYTEST = ("-n0", "-q", "-p", "no:randomly", "-m", "not long")


class Room(NamedTuple):
    """Files that are changed, and the tests that answer for them."""

    source: tuple[str, ...]
    tests: tuple[str, ...]


ROOMS = {
    "axis": Room(
        ("axis/duty_cycle", "questions/duty", "questions/axis"),
        ("axis", "cases/test_duty_case.py", "cases/test_starvation.py", "golden",
         "properties/test_duty.py", "questions/duty", "questions/axis"),
    ),
    "heat": Room(
        ("axis/thermal", "questions/warm_up"),
        ("axis/thermal", "cases/test_starvation.py", "questions/warm_up", "golden"),
    ),
    "supports": Room(("axis/supports",), ("axis/supports", "questions/axis", "golden")),
    "motion": Room(
        ("axis/motion",),
        ("axis/motion", "axis/duty_cycle/test_duty.py", "cases/test_duty_case.py", "cases/test_slips_of_units.py",
         "cases/test_trajectory_file.py"),
    ),
    "exports": Room(("exports", "questions/hand_over"), ("exports", "golden")),
    "selection": Room(("questions/select",), ("questions/select", "golden")),
    "optimisation": Room(("questions/optimise",), ("questions/optimise",)),
    "service": Room(
        ("evidence/service", "questions/service", "questions/condition"),
        ("evidence/service", "questions/service", "questions/condition"),
    ),
    "calibration": Room(("evidence/calibration",), ("evidence/calibration", "golden")),
    "sizing": Room(("physics/sizing",), ("physics/sizing", "questions/check", "properties/test_life.py")),
    "cases": Room(("cases",), ("cases",)),
    # the tests in a browser
    "page": Room(
        ("faces/page",),
        ("faces/page/test_site_page.py",
         *(f"faces/web/{file.name}" for file in sorted((ROOT / "tests" / "faces" / "web").glob("test_page*.py")))),
    ),
}  # fmt: skip


class Reached(NamedTuple):
    """The tests that reach each line, and how long each of them takes."""

    #: Tests, and fixtures that several tests share, by file below ``src/ballscrew`` and line.
    tests: Mapping[str, Mapping[int, Sequence[str]]]
    seconds: Mapping[str, float]
    #: The tests of each fixture.
    shared: Mapping[str, Sequence[str]]

    def of(self, change: Change) -> tuple[list[str], float]:
        """The tests that can notice a change, the quickest first, and their seconds.

        Of a line that is run while the module is imported, all tests of the files that have tests of the module: to
        read a constant runs no line of it.
        """
        lines = self.tests.get(change.file, {})
        # a statement of several lines is not counted on each of them
        found = {test for line in range(change.statement, change.line + 1) for test in lines.get(line, ())}
        if not found:
            named = {test for one in lines.values() for each in one for test in self.shared.get(each, (each,))}
            files = {test.partition("::")[0] for test in named}
            found = {test for test in self.seconds if test.partition("::")[0] in files}
        seconds = sum(self.seconds.get(one, 0.0) for one in found)
        tests = {test for one in found for test in self.shared.get(one, (one,))}
        return sorted(tests, key=self._seconds_alone), seconds

    def _seconds_alone(self, test: str) -> float:
        """Seconds of a test with its fixtures: that which starts commands takes longest."""
        fixtures = (name for name, tests in self.shared.items() if test in tests)
        return sum(self.seconds.get(one, 0.0) for one in (test, *fixtures))


class Outcome(NamedTuple):
    """What became of a change: ``killed``, ``survived``, ``equivalent``, or ``not reached`` by any test."""

    room: str
    change: Change
    what: str
    #: The test that noticed it, or why it is equivalent.
    words: str = ""


def main() -> None:
    """Sample, run, and print what survived."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--sample", type=int, default=400, help="number of changes over all rooms")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--rooms", nargs="*", choices=[*ROOMS], default=[*ROOMS], help="all of them by default")
    parser.add_argument("--only", default="", help="only changes whose key has this text in it")
    parser.add_argument("--list", action="store_true", help="list the sample, and run nothing")
    parser.add_argument("--check", action="store_true", help="exit 1 where a change survives")
    asked = parser.parse_args()
    sample = sampled(asked.rooms, asked.sample, asked.seed, asked.only)
    if asked.list:
        for room, change in sample:
            print(f"{room}: {change.key}  (line {change.line})")
        return
    outcomes = run(sample)
    print(table(outcomes))
    left = [one for one in outcomes if one.what in ("survived", "not reached")]
    for one in left:
        print(f"{one.what}, {one.room}: {one.change.key}  (line {one.change.line})")
    (WORK / "survivors.txt").write_text("".join(f"{one.change.key}\n" for one in left), encoding="utf-8")
    count = Counter(one.what for one in outcomes)
    survived = count["survived"] + count["not reached"]
    print(f"mutants {len(outcomes)}, killed {count['killed']}, survived {survived}, equivalent {count['equivalent']}")
    if asked.check and left:
        raise SystemExit(1)


def sampled(rooms: Iterable[str], count: int, seed: int, only: str) -> list[tuple[str, Change]]:
    """A sample by the names of the changes: what is written elsewhere in the source leaves it as it is."""
    every = [(room, change) for room in rooms for change in changes_in(room) if only in change.key]
    return sorted(every, key=lambda one: hashlib.sha256(f"{seed} {one[1].key}".encode()).digest())[:count]


def changes_in(room: str) -> list[Change]:
    """All changes of the files of a room."""
    named = [(file, file.relative_to(SOURCE).as_posix()) for file in files_of(room)]
    return [change for file, name in named for change in changes_of(file, name)]


def files_of(room: str) -> list[Path]:
    """The files of a room."""
    kind = "*.js" if room == "page" else "*.py"
    return [file for folder in ROOMS[room].source for file in sorted((SOURCE / folder).rglob(kind))]


# -- running ----------------------------------------------------------------------------------------


def run(sample: Sequence[tuple[str, Change]]) -> list[Outcome]:
    """Run each change: as many at a time as there are processors, each in a copy of its own."""
    WORK.mkdir(parents=True, exist_ok=True)
    reached = {room: reached_in(room) for room in sorted({room for room, _ in sample})}
    equivalent = equivalents()
    copies: queue.Queue[Path] = queue.Queue()
    count = os.cpu_count() or 1
    for number in range(count):
        copies.put(copied(number))
    outcomes = []

    def judged(room: str, change: Change) -> Outcome:
        if change.key in equivalent:
            return Outcome(room, change, "equivalent", equivalent[change.key])
        tests, seconds = reached[room].of(change)
        if not tests:
            return Outcome(room, change, "not reached")
        copy = copies.get()
        try:
            test = noticed(change, tests, copy, seconds)
        finally:
            copies.put(copy)
        return Outcome(room, change, "survived" if test is None else "killed", test or "")

    started = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(count) as pool:
        for done in concurrent.futures.as_completed([pool.submit(judged, *one) for one in sample]):
            outcome = done.result()
            outcomes.append(outcome)
            seconds = time.monotonic() - started
            words = f"{outcome.what}: {outcome.change.key}  {outcome.words}"
            print(f"[{len(outcomes)}/{len(sample)}, {seconds:.0f} s] {words}", file=sys.stderr, flush=True)
    return outcomes


def copied(number: int) -> Path:
    """A copy of the source, in which a change is made."""
    copy = WORK / f"copy{number}"
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(ROOT / "src", copy, ignore=shutil.ignore_patterns("__pycache__"))
    return copy


def noticed(change: Change, tests: Sequence[str], copy: Path, seconds: float) -> str | None:
    """The test that fails with a change; None where all pass."""
    file = copy / "ballscrew" / change.file
    original = file.read_text(encoding="utf-8")
    file.write_text(change.apply(original), encoding="utf-8")
    stamp = file.stat().st_mtime + random.Random(change.key).randrange(10_000, 1_000_000)
    os.utime(file, (stamp, stamp))  # a file of the same length and second would be run as it was compiled before
    options = (*PYTEST, "-x", "--assert=plain", "-p", "no:cacheprovider", "--no-header", "--tb=no", "-rfE")
    try:
        ended = run_pytest((*options, *tests), copy, LONGER * seconds + SECONDS_MORE)
    finally:
        file.write_text(original, encoding="utf-8")
        os.utime(file, (stamp + 1, stamp + 1))
    if ended.code == 0:
        return None
    if ended.code is None:
        return "takes too long"
    lines = [line for line in ended.printed.splitlines() if line.startswith(("FAILED", "ERROR"))]
    return lines[0] if lines else "the tests do not start"


# -- which test reaches which line ------------------------------------------------------------------


def reached_in(room: str) -> Reached:
    """The tests of each line of a room: measured once for its sources and tests as they are, and what tests share."""
    paths = [ROOT / "tests" / test for test in ROOMS[room].tests]
    digest = hashlib.sha256(repr(PYTEST).encode())
    tests = [*paths, ROOT / "tests" / "support", *sorted((ROOT / "tests").rglob("conftest.py"))]
    for file in (
        HERE / "contexts.py",
        HERE / "reach.py",
        HERE / "sitecustomize.py",
        *files_of(room),
        *(one for path in tests for one in sorted(path.rglob("*.py") if path.is_dir() else [path])),
    ):
        digest.update(file.read_bytes())
    kept = WORK / f"{room}-{digest.hexdigest()[:16]}.json"
    if not kept.is_file():
        kept.write_text(json.dumps(measured(room, paths)), encoding="utf-8")
    found = json.loads(kept.read_text(encoding="utf-8"))
    lines = {name: {int(line): tests for line, tests in each.items()} for name, each in found["tests"].items()}
    return Reached(lines, found["seconds"], found["shared"])


def measured(room: str, paths: Sequence[Path]) -> dict[str, object]:
    """Run the tests of a room, and note the lines that each of them reaches."""
    print(f"{room}: which test reaches which line", file=sys.stderr, flush=True)
    include = ",".join(str(SOURCE / folder / "*") for folder in ROOMS[room].source)
    folder, scripts = WORK / f"{room}.reach", WORK / "scripts.json"
    counted = {"SCRIPTS_REACHED": str(scripts)} if room == "page" else {}  # the browser counts those of the page
    arguments = [*PYTEST, "--tb=short", *map(str, paths)]
    if reach.started(folder, str(HERE) if room == "page" else include, arguments, **counted).wait():
        said = (folder / "pytest.txt").read_text(encoding="utf-8")[-5000:]
        raise SystemExit(f"The tests of {room} fail without any change:\n{said}")
    if room == "page":
        return {"tests": json.loads(scripts.read_text(encoding="utf-8")), **reach.seconds(folder)}
    tests: dict[str, dict[int, set[str]]] = defaultdict(lambda: defaultdict(set))
    for name, context, lines in reach.executed(folder):
        for line in lines:
            tests[name][line].add(context)
    by_line = {name: {line: sorted(found) for line, found in each.items()} for name, each in tests.items()}
    return {"tests": by_line, **reach.seconds(folder)}


def equivalents() -> dict[str, str]:
    """Changes that no result can tell from the original, and why."""
    return tomllib.loads((HERE / "equivalent.toml").read_text(encoding="utf-8"))


def table(outcomes: Sequence[Outcome]) -> str:
    """The outcomes by room."""
    count = Counter((one.room, one.what) for one in outcomes)
    kinds = ("killed", "survived", "not reached", "equivalent")
    lines = [f"{'room':14}{''.join(f'{kind:>13}' for kind in kinds)}"]
    lines += [
        f"{room:14}{''.join(f'{count[room, kind]:13}' for kind in kinds)}"
        for room in ROOMS
        if any(k[0] == room for k in count)
    ]
    return "\n".join(lines)


if __name__ == "__main__":
    main()
