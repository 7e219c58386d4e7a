"""What benchmarks share: arguments, times in turn, limits, and how all of it is told."""

from __future__ import annotations

import argparse
import json
import resource
import statistics
import sys
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
#: What is asked for of figures: their bound, and whether it is a lower one.
Limits = Mapping[str, tuple[float, bool]]
# the contact integral and the scripts that run node are those of the tests
sys.path.append(str(ROOT / "tests"))


def asked(words: str, **options: Any) -> argparse.Namespace:
    """The arguments of a benchmark by their defaults, and ``--json``.

    False makes a flag, a list the choices of an option that may be repeated, a type an option without a default.
    """
    parser = argparse.ArgumentParser(description=words, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, default in {"json": False, **options}.items():
        flag = f"--{name.replace('_', '-')}"
        if default is False:
            parser.add_argument(flag, action="store_true")
        elif isinstance(default, list):
            parser.add_argument(flag, choices=default, action="append", help="may be repeated (default: all)")
        elif isinstance(default, type):
            parser.add_argument(flag, type=default)
        else:
            kind = (lambda text: int(float(text))) if isinstance(default, int) else type(default)
            parser.add_argument(flag, type=kind, default=default, help="(default: %(default)s)")
    return parser.parse_args()


def seconds(work: Callable[[], Any]) -> float:
    """Time of one call, s; the first has what is done once in it."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def in_turn(
    work: Mapping[str, Callable[[], Any]], rounds: int, timed: Callable[[Callable[[], Any]], float] = seconds
) -> dict[str, list[float]]:
    """Times of several calls, all in turn and round after round: what else the machine does falls on all alike."""
    times: dict[str, list[float]] = {name: [] for name in work}
    for _ in range(rounds):
        for name, call in work.items():
            times[name].append(timed(call))
    return times


def ratio(times: Mapping[str, list[float]], above: str, below: str) -> float:
    """The median over the rounds of one time over another of the same round."""
    return statistics.median(one / other for one, other in zip(times[above], times[below], strict=True))


def megabytes(usage: Any = None) -> float:
    """Largest memory of this process so far, or of one that has ended, MB."""
    most = (usage or resource.getrusage(resource.RUSAGE_SELF)).ru_maxrss
    return most / (1e6 if sys.platform == "darwin" else 1e3)


def told(figures: Mapping[str, Any], as_json: bool, limits: Limits | None = None, indent: str = "") -> None:
    """Print figures, those of a case below its name, with what is asked for; or all as one JSON object."""
    if as_json:
        bounds = {name: {"at_least" if lower else "at_most": bound} for name, (bound, lower) in (limits or {}).items()}
        print(json.dumps({**figures, **({"limits": bounds} if limits else {})}, indent=1))
        return
    for name, value in figures.items():
        if isinstance(value, Mapping):
            print(f"{indent}{name}")
            told(value, False, limits, f"{indent}  ")
            continue
        bound = ""
        if limits and name in limits:
            limit, lower = limits[name]
            met = value >= limit if lower else value <= limit
            bound = f"  required: {'at least' if lower else 'at most'} {limit:g}  {'met' if met else 'MISSED'}"
        shown = f"{value:.4g}" if isinstance(value, float) else str(value)
        print(f"{indent}{name.replace('_', ' '):34} {shown:>12}{bound}", flush=True)


def study(words: str, table: Callable[[], str], page: str) -> None:
    """Print the table of a study, Markdown; ``--write`` also stores it in ``docs``."""
    options, text = asked(words, write=False), table()
    print(text, end="")
    if options.write:
        (ROOT / "docs" / page).write_text(text, encoding="utf-8")
