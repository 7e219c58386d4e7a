"""Every command's JSON on the examples, of two trees, compared number by number.

    python benchmarks/documents.py --program OTHER/.venv/bin/ballscrew --to before.json
    python benchmarks/documents.py --before before.json

Keys that the tree before had and this one lacks are lost, those that it lacked are new; of numbers the largest relative
difference of each command is printed. A command that both refuse in the same words is equal.
"""

from __future__ import annotations

import concurrent.futures
import json
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from harness import ROOT, asked

EXAMPLES = ROOT / "examples"
#: What is asked of each case file; a case without the tables that a command needs is refused.
OF_CASES = (
    "run", "check", "compare", "duty", "axis", "warm-up", "reversal", "sweep", "cite", "run --band --samples 64",
    "run --self-heating", "hand-over --to table --out OUT", "compensation --to sinumerik --out OUT/table",
)  # fmt: skip
OTHERS = (
    "ripple service.toml", "ripple service.toml --fault all", "sweep feed_drive.toml --band --samples 64",
    "sensitivity olaru2005.toml --samples 32", "duty vertical_axis.toml --band --samples 32",
    "warm-up warm_up.toml --band --samples 16", "compensation warm_up.toml --to isg --out OUT/table",
    *(f"hand-over olaru2005.toml --to {target} --out OUT" for target in ("c", "linuxcnc", "step7")),
    "run olaru2005.toml --rows own_screws.csv", "check catalogue_screw.toml --rows screws.csv", "check --all",
    "check hiwin-40-20k4", "compare olaru2005.toml feed_drive.toml", "select needs/feed_axis.toml",
    "select needs/vertical_axis.toml", "optimise needs/feed_axis.toml --population 8 --generations 2 --members 2",
    "fit rig_log.csv --case rig.toml", "fit axis_log.csv --case axis.toml --test axis_test.csv",
    "fit axis_log.csv --case axis.toml --steady", "service nut_new.csv nut_worn.csv --case service.toml",
    "condition nut_over_years.csv --case service.toml", "validate", "validate --summary", "catalogue list",
    "catalogue show hiwin-40-20k4", "oils list", "card check torque_cards", "list grades", "list laws", "list models",
    "list inputs olaru2005.toml", "list outputs feed_drive.toml", "schema", "schema --need", "card schema",
)  # fmt: skip
#: Commands that print JSON, or a text, without being told.
WITHOUT_FLAG = ("schema", "card schema", "cite")
#: The version is of the program; sentences stand as ``text`` since their templates went (decision 9).
NOT_COMPARED = ("version", "message", "messages", "source_message", "display")


class Difference(NamedTuple):
    """What differs between two documents of a command: places, and the largest relative difference of a number."""

    lost: list[str]
    new: list[str]
    changed: list[str]
    largest: float


def main() -> None:
    """Write the documents of a tree, or compare them with those before."""
    options = asked(__doc__, program=f"{ROOT}/.venv/bin/ballscrew", to="", before="", only="", processes=2)
    commands = [command for command in (*_of_cases(), *OTHERS) if options.only in command]
    with concurrent.futures.ThreadPoolExecutor(options.processes) as pool:
        documents = dict(
            zip(commands, pool.map(lambda command: document(command, options.program), commands), strict=True)
        )
    if options.to:
        Path(options.to).write_text(json.dumps(documents), encoding="utf-8")
    if options.before:
        before = json.loads(Path(options.before).read_text(encoding="utf-8"))
        show({command: compared(before[command], documents[command]) for command in commands if command in before})


def _of_cases() -> Iterator[str]:
    for case in sorted(EXAMPLES.rglob("*.toml")):
        if case.parent.name not in ("needs", "torque_cards"):
            for words in OF_CASES:
                command, *flags = words.split()
                yield " ".join([command, case.relative_to(EXAMPLES).as_posix(), *flags])


def document(command: str, program: str) -> Any:
    """What a command prints: JSON, or the lines of its refusal."""
    with tempfile.TemporaryDirectory() as folder:
        words = [str(EXAMPLES / word) if (EXAMPLES / word).exists() else word for word in command.split()]
        words = [word.replace("OUT", folder) for word in words]
        flags = [] if command.startswith(WITHOUT_FLAG) else ["--json"]
        ended = subprocess.run([program, *words, *flags], capture_output=True, text=True, check=False, cwd=EXAMPLES)
        printed = (ended.stdout or ended.stderr).replace(folder, "OUT").replace(str(EXAMPLES), "")
    try:
        return json.loads(printed)
    except json.JSONDecodeError:
        return printed.splitlines()


def compared(before: Any, after: Any) -> Difference:
    """What differs between two documents."""
    old, new = dict(leaves(before)), dict(leaves(after))
    largest, changed = 0.0, list[str]()
    for place in sorted(old.keys() & new.keys()):
        one, other = old[place], new[place]
        if isinstance(one, float) and isinstance(other, float):
            largest = max(largest, abs(other - one) / max(abs(one), sys.float_info.min))
        elif one != other:
            changed.append(f"{place}: {one} → {other}")
    return Difference(sorted(old.keys() - new.keys()), sorted(new.keys() - old.keys()), changed, largest)


def leaves(value: Any, place: str = "") -> Iterator[tuple[str, str | float]]:
    """Texts and numbers of a document by their places; an empty part, a truth value and null count as texts."""
    if isinstance(value, Mapping) and value:
        for name, part in value.items():
            if name not in NOT_COMPARED:
                yield from leaves(part, f"{place}.{name}")
    elif isinstance(value, list) and value:
        for name, part in zip(_names(value), value, strict=True):
            yield from leaves(part, f"{place}.{name}")
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield place, float(value)
    else:
        yield place, str(value)


def _names(parts: list[Any]) -> list[Any]:
    """What tells the parts of a list apart: their names, so that one more moves no other, or else their places."""
    names = [part.get("name", part.get("id")) if isinstance(part, Mapping) else None for part in parts]
    return names if None not in names and len(set(names)) == len(names) else [*range(len(parts))]


def show(differences: Mapping[str, Difference]) -> None:
    """Print what differs, and all in one line."""
    for command, difference in differences.items():
        if difference.largest:
            print(f"{command}: largest difference {difference.largest:.1e}")
        for kind, places in zip(("lost", "new", "changed"), difference[:3], strict=True):
            for place in places[:5]:
                print(f"{command}: {kind} {place}")
            if len(places) > 5:
                print(f"{command}: {kind} {len(places) - 5} more")
    lost = sum(len(difference.lost) for difference in differences.values())
    largest = max(difference.largest for difference in differences.values())
    print(f"{len(differences)} commands, {lost} keys lost, largest difference {largest:.1e}")


if __name__ == "__main__":
    main()
