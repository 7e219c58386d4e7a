"""Damaged stores of sweeps: checked, resumed, and compared with an undamaged one.

Finished stores and stores with 12 of 21 blocks: every kind of file removed, cut, emptied, extended, flipped, zeroed,
exchanged, replaced by a folder or a link; locks, other plans, formats, models and folders; files of a sibling store in
their places, as a partial copy leaves them. Then `bs.verify`, and the same sweep again.

*Wrong*: a store with changed files that `bs.verify` calls good; numbers after the sweep, or read from it, that are not
those of the undamaged store.
"""

from __future__ import annotations

import contextlib
import dataclasses
import functools
import json
import logging
import os
import shutil
import socket
from collections.abc import Callable
from pathlib import Path

import numpy as np
import xarray as xr
from benchmarks.hostile import workers
from benchmarks.hostile.tally import Outcome

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.engine.sweeps.store import UnfinishedSweepError
from ballscrew.engine.sweeps.store_plan import read_sealed, sealed
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from support.stores import MODEL, SMALL, files

SECONDS = 300.0

OWN = ".ballscrew"
#: Points of 12 of the 21 blocks.
UNFINISHED = 12 * 9

# -- damage of one file ---------------------------------------------------------------------------


def _flipped(path: Path) -> None:
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 0x10
    path.write_bytes(content)


def _exchanged(path: Path) -> None:
    """With another file of the store, of the same folder if there is one, of the nearest size."""
    others = sorted(other for other in path.parent.parent.rglob("*") if other.is_file() and other != path)
    other = min(others, key=lambda other: abs(other.stat().st_size - path.stat().st_size))
    content = path.read_bytes()
    path.write_bytes(other.read_bytes())
    other.write_bytes(content)


def _moved_and_linked(path: Path, keep: bool = True) -> None:
    """Elsewhere with a link in its place; the file is gone unless it is to be kept."""
    there = workers.folder() / f"elsewhere-{path.parent.name}"
    path.rename(there)
    path.symlink_to(there)
    if not keep:
        there.unlink()


#: Damage of one file.
ON_A_FILE: dict[str, Callable[[Path], object]] = {
    "removed": lambda path: path.unlink(),
    "cut": lambda path: os.truncate(path, path.stat().st_size // 2),
    "emptied": lambda path: os.truncate(path, 0),
    "extended": lambda path: path.write_bytes(path.read_bytes() + b"\0more"),
    "flipped": _flipped,
    "zeroed": lambda path: path.write_bytes(bytes(path.stat().st_size)),  # as a file system may after a loss of power
    "exchanged": _exchanged,
    "a folder": lambda path: (path.unlink(), path.mkdir()),
    "a link": _moved_and_linked,
    "a link to nothing": functools.partial(_moved_and_linked, keep=False),
}

#: Kinds of files, by the paths in a finished and in an unfinished store.
FILES = {
    "chunk": ("efficiency/c/2/1/0", "efficiency/c/2/1/0"),
    "coordinate": ("axial_load/c/0", "axial_load/c/0"),
    "metadata of an output": ("efficiency/zarr.json", "efficiency/zarr.json"),
    "metadata of a coordinate": ("viscosity/zarr.json", "viscosity/zarr.json"),
    "metadata of the store": ("zarr.json", f"{OWN}/zarr.json"),
    "layout": (f"{OWN}/layout.json", f"{OWN}/layout.json"),
    "table of blocks": (f"{OWN}/blocks.csv", f"{OWN}/blocks/7"),
    "plan": (f"{OWN}/plan.json", f"{OWN}/plan.json"),
}

# -- damage of the store --------------------------------------------------------------------------


def _another_plan(**changes: object) -> Callable[[Path], None]:
    """The plan with other entries, without those that are None, and a digest that fits."""

    def damage(store: Path) -> None:
        path = store / OWN / "plan.json"
        plan = (read_sealed("plan", path.read_text(encoding="utf-8")) or {}) | changes
        path.write_bytes(sealed("plan", {name: value for name, value in plan.items() if value is not None}))

    return damage


def _of_another_sweep(model: bs.FrictionModel, **changes: object) -> Callable[[Path], None]:
    def damage(store: Path) -> None:
        shutil.rmtree(store)
        bs.sweep(model, SCREW, OIL, to=store, **(SMALL | changes))

    return damage


def _lock(text: str) -> Callable[[Path], None]:
    return lambda store: (store / OWN / "lock").write_text(text, encoding="utf-8") and None


def _linked_lock(store: Path) -> None:
    (store.parent / "target").write_text("thesis", encoding="utf-8")
    (store / OWN / "lock").symlink_to(store.parent / "target")


def _folder_for_lock(store: Path) -> None:
    (store / OWN / "lock").mkdir()


def _without(name: str) -> Callable[[Path], None]:
    return lambda store: shutil.rmtree(store / name)


def _linked(name: str) -> Callable[[Path], None]:
    def damage(store: Path) -> None:
        (store / name).rename(store.parent / "moved")
        (store / name).symlink_to(store.parent / "moved")

    return damage


def _exchanged_outputs(store: Path) -> None:
    (store / "efficiency").rename(store / "aside")
    (store / "screw_torque").rename(store / "efficiency")
    (store / "aside").rename(store / "screw_torque")


def _older_chunk(store: Path) -> None:
    """A chunk of another output in the place of one, of the same kind of number."""
    shutil.copy(store / "screw_torque/c/2/1/0", store / "efficiency/c/2/1/0")


def _changed_number(store: Path) -> None:
    """Metadata of an output with another fill value."""
    path = store / "efficiency" / "zarr.json"
    document = json.loads(path.read_text(encoding="utf-8"))
    path.write_text(json.dumps(document | {"fill_value": 1.0}), encoding="utf-8")


def _a_file_for_an_output(store: Path) -> None:
    shutil.rmtree(store / "efficiency")
    (store / "efficiency").write_text("no folder", encoding="utf-8")


def _all_chunks(store: Path) -> None:
    for path in store.glob("*/c/*/*/*"):
        path.unlink()


def _copied(*patterns: str, share: float = 1.0, seed: int = 0) -> Callable[[Path], None]:
    """Files of the store of a sibling sweep, of the same grid with other values, over those of this one.

    Only a ``share`` of them, chosen at random, as a copy leaves that was stopped.
    """

    def damage(store: Path) -> None:
        finished = (store / "zarr.json").exists()
        sibling = workers.folder() / "undamaged" / f"sibling {'finished' if finished else 'unfinished'}"
        random = np.random.default_rng(seed)
        own = f"{OWN}/plan.json"
        found = {path.relative_to(sibling).as_posix() for pattern in patterns for path in sibling.glob(pattern)}
        for name in sorted(found - {own}):
            if (sibling / name).is_file() and random.random() < share:
                (store / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(sibling / name, store / name)

    return damage


def _temporary(store: Path) -> None:
    (store / OWN / "temporary").mkdir(exist_ok=True)
    (store / OWN / "temporary" / "left").write_bytes(b"half a chunk")


DEAD = 2**22 - 1
#: Damage of the whole; True where ``bs.verify`` may call the store good: its files are as they were written.
ON_THE_STORE: dict[str, tuple[Callable[[Path], None], bool]] = {
    "lock of a dead process": (_lock(json.dumps({"process": DEAD, "host": socket.gethostname()})), True),
    "lock of another host": (_lock(json.dumps({"process": 1, "host": "elsewhere"})), True),
    "lock of nobody": (_lock(""), True),
    "lock with text": (_lock("thesis"), True),
    "lock with a list": (_lock("[1, 2]"), True),
    "lock that is a link": (_linked_lock, True),
    "lock that is a folder": (_folder_for_lock, True),
    "temporary file": (_temporary, True),
    "another model's store": (_of_another_sweep(bs.FrictionModel.corrected()), True),
    "another grid's store": (_of_another_sweep(MODEL, viscosity=[0.05, 0.1, 0.31]), True),
    "format 1": (_another_plan(format=1), False),
    "format 99": (_another_plan(format=99), False),
    "format of text": (_another_plan(format="2"), False),
    "no format": (_another_plan(format=None), False),
    "other formulas": (_another_plan(formulas="0" * 64), True),
    "another shape": (_another_plan(shape=[7, 9, 4]), False),
    "another chunk": (_another_plan(chunks=[7, 9, 3]), False),
    "no outputs": (_another_plan(outputs={}), False),
    "no own folder": (_without(OWN), False),
    "no folder of an output": (_without("efficiency"), False),
    "no folder of a coordinate": (_without("axial_load"), False),
    "a linked output": (_linked("efficiency"), True),
    "a linked own folder": (_linked(OWN), True),
    "exchanged outputs": (_exchanged_outputs, False),
    "a chunk of another output": (_older_chunk, False),
    "another fill value": (_changed_number, False),
    "a file for an output": (_a_file_for_an_output, False),
    "no chunks": (_all_chunks, False),
    "a sibling's chunk": (_copied("efficiency/c/2/1/0"), False),
    "a sibling's chunks": (_copied("*/c/*/*/*"), False),
    "a sibling's table of blocks": (_copied(f"{OWN}/blocks.csv", f"{OWN}/blocks/*"), False),
    "a sibling's chunks and table of blocks": (_copied("*/c/*/*/*", f"{OWN}/blocks.csv", f"{OWN}/blocks/*"), False),
    "a sibling's output and table of blocks": (
        _copied("efficiency/c/*/*/*", f"{OWN}/blocks.csv", f"{OWN}/blocks/*"),
        False,
    ),
    "a sibling's coordinates": (_copied("viscosity/c/0"), False),
    "a sibling's coordinates and layout": (_copied("viscosity/c/0", "zarr.json", f"{OWN}/layout.json"), False),
    "all of a sibling but its plan": (_copied("**/*"), False),
    **{
        f"{share:.0%} of a sibling's files, {seed}": (_copied("**/*", share=share, seed=seed), False)
        for share in (0.1, 0.5, 0.9)
        for seed in range(5)
    },
}


@dataclasses.dataclass(frozen=True)
class Kind:
    """A kind of damage of a finished or an unfinished store."""

    name: str
    damage: Callable[[Path], None]
    finished: bool
    #: ``bs.verify`` may call the store good.
    is_good: bool = False


def kinds() -> list[Kind]:
    """All kinds, on both stores; always in the same mixed order, so that a few of them are of all sorts."""
    found: list[Kind] = []
    for finished in (True, False):
        for of_file, (whole, begun) in FILES.items():
            name = whole if finished else begun
            for done, act in ON_A_FILE.items():
                found.append(Kind(f"{of_file} {done}", lambda store, act=act, name=name: act(store / name), finished))
        found += [Kind(words, damage, finished, good) for words, (damage, good) in ON_THE_STORE.items()]
    order = np.random.default_rng(0).permutation(len(found))
    return [found[i] for i in order]


COUNT = len(kinds())


@functools.cache
def undamaged() -> tuple[Path, xr.Dataset]:
    """A finished and an unfinished store, and the numbers that they should have; and those of a sibling."""
    folder = workers.folder() / "undamaged"
    folder.mkdir()

    def stop(finished: int, _: int) -> None:
        if finished >= UNFINISHED:
            raise KeyboardInterrupt

    for prefix, changed in (("sibling ", {"viscosity": [0.05, 0.2, 0.4]}), ("", {})):
        asked = {**SMALL, **changed}
        numbers = bs.sweep(MODEL, SCREW, OIL, to=folder / f"{prefix}finished", **asked).load()
        with contextlib.suppress(KeyboardInterrupt):
            bs.sweep(MODEL, SCREW, OIL, to=folder / f"{prefix}unfinished", done=stop, **asked)
    return folder, numbers


def attempt(_: int, number: int, __: int) -> Outcome:
    """One kind of damage."""
    logging.getLogger("ballscrew").setLevel(logging.CRITICAL)
    kind = kinds()[number]
    folder, numbers = undamaged()
    place = workers.folder() / str(number)
    store = Path(shutil.copytree(folder / ("finished" if kind.finished else "unfinished"), place / "map.zarr"))
    before, good = files(store), bs.verify(store)
    kind.damage(store)
    words = f"{kind.name}, {'finished' if kind.finished else 'unfinished'}"
    wrong: list[str] = []
    refused = False
    try:
        found = bs.verify(store)
        is_good = not found.damaged and (found.finished, found.blocks) == (good.finished, good.blocks)
        if is_good and not kind.is_good and files(store) != before:
            wrong.append("verify calls it good")
    except InputError:
        pass
    except Exception as error:
        wrong.append(f"verify: {workers.last_line(error)}")
    if kind.finished:
        unchecked = Path(shutil.copytree(store, place / "unchecked.zarr", symlinks=True))
        try:
            if not bs.sweep(MODEL, SCREW, OIL, to=unchecked, **SMALL).load().identical(numbers):
                wrong.append("other numbers without verify")
        except (InputError, UnfinishedSweepError):
            pass
        except Exception as error:
            wrong.append(f"sweep without verify: {workers.last_line(error)}")
    try:
        opened = bs.sweep(MODEL, SCREW, OIL, to=store, **SMALL, **({"verify": True} if kind.finished else {}))
        if not opened.load().identical(numbers):
            wrong.append("other numbers after the sweep")
        elif not bs.verify(store).holds:
            wrong.append("damaged after the sweep")
    except (InputError, UnfinishedSweepError):
        refused = True
    except Exception as error:
        wrong.append(f"sweep: {workers.last_line(error)}")
    shutil.rmtree(place)
    if wrong:
        return Outcome(wrong=[f"{words}: {'; '.join(wrong)}"])
    return Outcome(answered=int(not refused), refused=int(refused))
