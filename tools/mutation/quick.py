"""The tests that an edit can break, as many as a minute holds: ``make quick [SINCE=commit] [SECONDS=45]``.

Git says which functions have changed since a commit, the last one unless told; a map in ``out/quick`` says which tests
run them. Tests that changed themselves come first, then those in files named after a changed module, for half of the
budget, and those that run least beside the changed functions, one of each file in turn, until their measured times fill
it. What is left out is counted and said.

``make quick-map`` measures the map, in some twenty minutes. It holds functions by their names, so that it stays of use
while they move and change; tests and functions that are newer than the map are not in it.
"""

from __future__ import annotations

import argparse
import ast
import functools
import gzip
import json
import os
import shutil
import subprocess
import sys
import time
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import reach
from reach import ROOT, SOURCE

WORK = ROOT / "out" / "quick"
MAP = WORK / "map.json.gz"
#: Code that runs when its module is imported.
MODULE = "<module>"
#: Tests that are in no map, as they start processes, servers and browsers, or take minutes for one room.
UNMEASURED = tuple(
    f"tests/{name}" for name in ("compiler/kernels", "docs", "engine/sweeps", "exports", "faces/page", "faces/web")
)
#: Share of the budget that tests named after a changed module may fill before others have their turn.
OF_NAMED = 0.5
#: Processes that run tests, and seconds that each takes to start.
WORKERS = min(os.cpu_count() or 1, 4)
PYTEST = ("-q", "-p", "no:randomly", "--no-header")


class Reach(NamedTuple):
    """Which tests run which function."""

    tests: Sequence[str]
    seconds: Sequence[float]
    #: Places in ``tests`` by function, as ``physics/equations/film.py:minimum_film_thickness``.
    functions: Mapping[str, Sequence[int]]


class Choice(NamedTuple):
    """Tests to run, and how many more run what has changed."""

    tests: Sequence[str]
    seconds: float
    left: int
    seconds_left: float


# -- what has changed -------------------------------------------------------------------------------


def changed_lines(since: str) -> dict[str, set[int]]:
    """Lines of today's files that differ from a commit; of a deletion, the line above it."""
    diff = git("diff", "--unified=0", "--no-renames", since, "--", "src", "tests")
    lines: dict[str, set[int]] = defaultdict(set)
    file = ""
    for line in diff.splitlines():
        if line.startswith("+++ "):
            file = line.removeprefix("+++ ").removeprefix("b/")
        elif line.startswith("@@") and file != os.devnull:
            start, _, count = line.split("+")[1].split(" ")[0].partition(",")
            lines[file].update(range(int(start), int(start) + max(int(count or 1), 1)))
    for file in git("ls-files", "--others", "--exclude-standard", "src", "tests").splitlines():
        lines[file].add(0)
    return dict(lines)


def git(*arguments: str) -> str:
    """Output of a command of git."""
    return subprocess.run(("git", *arguments), cwd=ROOT, check=True, capture_output=True, text=True).stdout


def functions_of(text: str) -> list[str]:
    """The name of the function that each line stands in, the first line at place 1; ``<module>`` where in none."""
    names = [MODULE] * (text.count("\n") + 2)

    def name(nodes: Iterable[ast.stmt], outer: str) -> None:
        for node in nodes:
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
                full = f"{outer}{node.name}"
                if not isinstance(node, ast.ClassDef):
                    first = node.body[0].lineno
                    last = node.end_lineno or first
                    names[first : last + 1] = [full] * (last + 1 - first)
                name(node.body, f"{full}.")

    name(ast.parse(text).body, "")
    return names


def changed_functions(lines: Mapping[str, set[int]]) -> set[str]:
    """Functions with changed lines; all of a module where what runs at its import has changed, or its data."""
    changed: set[str] = set()
    for file, numbers in lines.items():
        if not file.startswith("src/ballscrew/"):
            continue
        path = file.removeprefix("src/ballscrew/")
        if not file.endswith(".py"):
            readers = git("grep", "--name-only", "--fixed-strings", Path(file).name, "--", "src/ballscrew/*.py")
            changed |= {f"{reader.removeprefix('src/ballscrew/')}:{MODULE}" for reader in readers.splitlines()}
        elif (ROOT / file).is_file():
            names = functions_of((ROOT / file).read_text(encoding="utf-8"))
            changed |= {f"{path}:{names[min(number, len(names) - 1)]}" for number in numbers}
    return changed


# -- which tests ------------------------------------------------------------------------------------


def chosen(known: Reach, changed: Iterable[str], tests: Sequence[str], budget: float) -> Choice:
    """Tests within a budget of seconds: changed ones, those named after what changed, then those that run least else.

    Of each file in turn.
    """
    of_module = defaultdict(set)
    runs = [0] * len(known.tests)
    for function, indices in known.functions.items():
        of_module[function.partition(":")[0]].update(indices)
        for index in indices:
            runs[index] += 1
    candidates: set[int] = set()
    for function in changed:
        path, _, name = function.partition(":")
        candidates.update(of_module[path] if name == MODULE else known.functions.get(function, of_module[path]))
    # the files of changed tests are run whole
    candidates -= {index for index in candidates if known.tests[index].partition("::")[0] in tests}
    by_file: dict[str, list[int]] = defaultdict(list)
    for index in sorted(candidates, key=lambda index: (runs[index], known.seconds[index])):
        by_file[known.tests[index].partition("::")[0]].append(index)
    seconds = sum(s for test, s in zip(known.tests, known.seconds, strict=True) if test.partition("::")[0] in tests)
    ids: list[int] = []
    named = [by_file[file] for file in by_file if is_named_after(file, changed)]
    for share, lists in ((OF_NAMED, named), (1.0, list(by_file.values()))):
        for index in in_turn(lists):
            if index not in ids and seconds + known.seconds[index] <= share * budget:
                seconds += known.seconds[index]
                ids.append(index)
    left = candidates.difference(ids)
    return Choice(
        [*tests, *(known.tests[index] for index in ids)], seconds, len(left), sum(known.seconds[i] for i in left)
    )


def is_named_after(file: str, changed: Iterable[str]) -> bool:
    """Test whether a file of tests has the name of a module that has changed, perhaps with that of its room."""
    paths = [Path(function.partition(":")[0]) for function in changed]
    names = {name for path in paths for name in (path.stem, f"{path.parent.name}_{path.stem}")}
    return Path(file).stem.removeprefix("test_") in names


def in_turn(lists: Sequence[Sequence[int]]) -> Iterator[int]:
    """The first of each list, then the second of each, and so on."""
    for place in range(max(map(len, lists), default=0)):
        yield from (each[place] for each in lists if place < len(each))


def read_map() -> Reach:
    """The map as it was measured last."""
    if not MAP.is_file():
        raise SystemExit("There is no map of tests yet: `make quick-map` measures it once, in some twenty minutes.")
    with gzip.open(MAP, "rt", encoding="utf-8") as file:
        return Reach(**json.load(file))


def run(since: str, budget: float, list_only: bool) -> int:
    """Choose tests, say which, and run them; the exit code of pytest."""
    lines = changed_lines(since)
    tests = [file for file in lines if file.startswith("tests/") and Path(file).name.startswith("test_")]
    tests = [file for file in tests if (ROOT / file).is_file()]
    changed = changed_functions(lines)
    choice = chosen(read_map(), changed, tests, budget * WORKERS)
    print(f"{len(changed)} functions have changed since {since}, {len(tests)} files of tests")
    print(
        f"{len(choice.tests)} chosen, {choice.seconds:.0f} s of processor; {choice.left} left out, "
        f"{choice.seconds_left:.0f} s",
        flush=True,
    )
    scripts = [file for file in lines if file.endswith((".js", ".css", ".html"))]
    if scripts:
        print("Scripts of the page are not in the map: make js, pytest tests/faces/web/test_page*.py", flush=True)
    if list_only or not choice.tests:
        print("\n".join(choice.tests))
        return 0
    arguments = WORK / "arguments.txt"
    arguments.write_text("\n".join(choice.tests), encoding="utf-8")
    workers = str(WORKERS) if choice.seconds > 5 else "0"
    command = [sys.executable, "-m", "pytest", "-n", workers, *PYTEST, f"@{arguments}"]
    return subprocess.run(command, cwd=ROOT, check=False).returncode


# -- the map ----------------------------------------------------------------------------------------


def measure(folders: Sequence[str], processes: int) -> None:
    """Run all tests that have a map, or those in some folders, in so many processes, and write what they run."""
    shutil.rmtree(WORK, ignore_errors=True)
    files = sorted(file.relative_to(ROOT).as_posix() for file in (ROOT / "tests").rglob("test_*.py"))
    files = [file for file in files if file.startswith(tuple(folders)) and not file.startswith(UNMEASURED)]
    started = time.monotonic()
    options = ("-n0", *PYTEST, "--tb=line")
    shards = [
        reach.started(WORK / f"shard{number}", f"{SOURCE}/*", [*options, *files[number::processes]], EACH_PARAMETER="1")
        for number in range(processes)
    ]
    for process in shards:
        if process.wait() > 1:  # a test that fails is no reason to have no map
            raise SystemExit("The tests could not be run: see out/quick/shard*/pytest.txt")
    found = joined([WORK / f"shard{number}" for number in range(processes)])
    with gzip.open(MAP, "wt", encoding="utf-8") as file:
        json.dump(found._asdict(), file)
    minutes = (time.monotonic() - started) / 60
    print(f"{len(found.tests)} tests run {len(found.functions)} functions; measured in {minutes:.0f} min")


def joined(folders: Iterable[Path]) -> Reach:
    """What the processes have noted, as one map."""
    seconds: dict[str, float] = {}
    functions: dict[str, set[str]] = defaultdict(set)
    for folder in folders:
        noted = reach.seconds(folder)
        shared = noted["shared"]
        seconds |= {test: s for test, s in noted["seconds"].items() if test not in shared}
        for path, context, lines in reach.executed(folder):
            names = names_in(path)
            tests = shared.get(context, (context,))
            for name in {names[line] for line in lines if line < len(names)}:
                functions[f"{path}:{name}"].update(tests)
    tests = sorted(seconds)
    place = {test: index for index, test in enumerate(tests)}
    by_function = {name: sorted(place[test] for test in reached) for name, reached in functions.items()}
    return Reach(tests, [round(seconds[test], 4) for test in tests], by_function)


@functools.cache
def names_in(path: str) -> list[str]:
    """The functions by line of a file below ``src/ballscrew``, read once."""
    return functions_of((SOURCE / path).read_text(encoding="utf-8"))


def main() -> None:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--since", default="HEAD", help="the commit that the edit began from")
    parser.add_argument("--seconds", type=float, default=40.0, help="budget of the tests, without their start")
    parser.add_argument("--list", action="store_true", help="list the tests, and run nothing")
    parser.add_argument(
        "--measure", nargs="*", metavar="FOLDER", help="measure the map anew, of all tests or of folders"
    )
    parser.add_argument("--processes", type=int, default=WORKERS, help="that measure the map")
    options = parser.parse_args()
    if options.measure is not None:
        measure(options.measure or ["tests/"], options.processes)
    else:
        sys.exit(run(options.since, options.seconds, options.list))


if __name__ == "__main__":
    main()
