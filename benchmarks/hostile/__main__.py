"""The hostile run: all sections in turn, each for a bounded time, and the table of ``docs/reliability.md``.

Ends with exit code 1 if anything is wrong. ``--scale 0.01`` tries a hundredth of everything.
"""

from __future__ import annotations

import argparse
import datetime
import faulthandler
import functools
import importlib
import inspect
import os
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from types import ModuleType

from benchmarks.hostile import ROOT, workers
from benchmarks.hostile.tally import Tally

from ballscrew.basis.version import __version__

NAMES = (
    "screws", "nuts", "exports", "cases", "logs", "traces", "large_files", "stores", "places", "requests", "users",
)  # fmt: skip
SECTIONS: dict[str, ModuleType] = {name: importlib.import_module(f"benchmarks.hostile.{name}") for name in NAMES}
PAGE = ROOT / "docs" / "reliability.md"
BEGIN, END = "<!-- hostile run: begin -->", "<!-- hostile run: end -->"
#: Lines on what is wrong, and how many different ones of a section are printed.
WRONG = ROOT / "out" / "hostile"
MOST_LINES = 30


def section(name: str, scale: float, seed: int) -> tuple[Tally, float]:
    """One section: its counts, and the seconds that it took."""
    module = SECTIONS[name]
    tally = Tally(name, max(2, round(module.COUNT * scale)), module.SECONDS)
    run = getattr(module, "run", None) or functools.partial(workers.run, module.attempt, size=sizes(module))
    run(tally, seed)
    seconds = tally.seconds
    tally.say()
    WRONG.mkdir(parents=True, exist_ok=True)
    (WRONG / f"{name}.txt").write_text("".join(f"{line}\n" for line in tally.counts.wrong), encoding="utf-8")
    for line, number in list(Counter(tally.counts.wrong).items())[:MOST_LINES]:
        print(f"WRONG {name}: {line}" + (f" ({number} times)" if number > 1 else ""), flush=True)
    return tally, seconds


def sizes(module: ModuleType) -> int:
    """Inputs of an attempt."""
    return getattr(module, "SIZE", 1)


def repeat(module: ModuleType, seed: int, number: int) -> None:
    """One attempt of a section, in this process: a defect in it can be looked at."""
    with tempfile.TemporaryDirectory() as place:
        workers.prepare(place)
        faulthandler.dump_traceback_later(workers.MOST_SECONDS, exit=True)
        print(module.attempt(seed, number, sizes(module)))


def table(found: Sequence[tuple[Tally, float]], heading: str) -> str:
    """The part of the page that a run writes."""
    head = "| section | tried | seconds | answered | refused or flagged | wrong |\n|---|---|---|---|---|---|"
    lines = [heading, "", head, *(row(tally, seconds) for tally, seconds in found)]
    lines += ["", "| section | what is tried | wrong, beside what is wrong everywhere |", "|---|---|---|"]
    lines += [described(tally.name) for tally, _ in found]
    for tally, _ in found:
        lines += ["", *tally.notes] if tally.notes else []
    return "\n".join(lines) + "\n"


def row(tally: Tally, seconds: float) -> str:
    """The row of a section."""
    counts = tally.counts
    tried = f"{counts.tried:,}" + (f" of {tally.wanted:,}" if counts.tried < tally.wanted else "")
    numbers = f"{counts.answered:,} | {counts.refused:,} | {len(counts.wrong):,}"
    return f"| {tally.name} | {tried} | {seconds:.0f} | {numbers} |"


def described(name: str) -> str:
    """What a section tries, and what is wrong in it, by the docstring of its module."""
    _, tried, wrong = (" ".join(part.split()) for part in inspect.getdoc(SECTIONS[name]).split("\n\n"))
    return f"| {name} | {tried} | {wrong.removeprefix('*Wrong*: ')} |"


def main() -> None:
    """Run what is asked for, and write the page if it was all."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.hostile", description=__doc__.splitlines()[0])
    parser.add_argument("sections", nargs="*", metavar="SECTION", help=f"of {', '.join(SECTIONS)} (default: all)")
    parser.add_argument("--scale", type=float, default=1.0, help="share of all numbers (default %(default)s)")
    parser.add_argument("--seed", type=int, default=2005, help="of all random input (default %(default)s)")
    parser.add_argument("--page", type=Path, default=PAGE, help="the page to write the table into")
    parser.add_argument("--attempt", type=int, help="repeat one attempt of one section in this process")
    options = parser.parse_args()
    if unknown := [name for name in options.sections if name not in SECTIONS]:
        parser.error(f"unknown: {', '.join(unknown)}")
    if options.attempt is not None:
        repeat(SECTIONS[options.sections[0]], options.seed, options.attempt)
        return
    begun = time.monotonic()
    print(f"seed {options.seed}, scale {options.scale:g}")
    found = [section(name, options.scale, options.seed) for name in options.sections or SECTIONS]
    minutes, rest = divmod(round(time.monotonic() - begun), 60)
    heading = (
        f"ballscrew {__version__}, {datetime.date.today().isoformat()}, seed {options.seed}, scale {options.scale:g}, "
        f"{os.cpu_count()} processors, {minutes} min {rest} s."
    )
    block = table(found, heading)
    print(block)
    if not options.sections:
        page = options.page.read_text(encoding="utf-8")
        page = f"{page.split(BEGIN)[0]}{BEGIN}\n{block}{END}{page.split(END)[1]}"
        options.page.write_text(page, encoding="utf-8")
    sys.exit(any(tally.counts.wrong for tally, _ in found))


if __name__ == "__main__":
    main()
