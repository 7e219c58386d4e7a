"""A sweep on disk: a Zarr store that is filled block by block, and goes on where it was stopped.

Files are written here and, by Zarr, in :mod:`~ballscrew.engine.sweeps.store_zarr`, and only inside the store::

    map.zarr/zarr.json              last of all, by a rename: a store without it is not finished
    map.zarr/screw_torque/c/0/1     a chunk: the results of one block, one output
    map.zarr/.ballscrew/plan.json   what the store holds, with its digest
    map.zarr/.ballscrew/layout.json sizes and checksums of metadata and coordinates, with a digest
    map.zarr/.ballscrew/blocks.csv  sizes and checksums (CRC-32) of the chunks of all blocks
    map.zarr/.ballscrew/blocks/12   the row of one block; there once its chunks are, until all are
    map.zarr/.ballscrew/lock        while somebody writes

All checksums are bound to the plan by its digest, so that files of another store do not pass for those of this one.

Every file is written under another name, brought to the disk, and renamed. What is damaged is found by
sizes and checksums (:mod:`~ballscrew.engine.sweeps.store_check`) and written again.
"""

from __future__ import annotations

import contextlib
import dataclasses
import errno
import functools
import importlib.util
import itertools
import logging
import os
import shutil
import socket
import uuid
from collections.abc import Collection, Generator, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.engine.evaluation.evaluation import Engine, Evaluation
from ballscrew.engine.evaluation.plan import Plan
from ballscrew.engine.sweeps.store_check import LAYOUT, ROOT, Contents, Damage, file_in_place_of_a_folder, stored_plan
from ballscrew.engine.sweeps.store_plan import (
    OTHER,
    WHERE,
    Blocks,
    Content,
    description_of,
    differences,
    refuse_unsafe,
    row,
    sealed,
)

#: Suffixes that mean a file, not the folder of a store.
_FILES = (".csv", ".xlsx", ".nc", ".json", ".toml")
#: At most so many damaged files are named in a message.
_NAMED_AT_MOST = 3
#: A disk that is full, for all or for this user.
FULL = {errno.ENOSPC, errno.EDQUOT}

_log = logging.getLogger(__name__)


class UnfinishedSweepError(OSError):
    """A full disk or a lost cluster; finished blocks stay, and the same sweep continues from there."""

    def __str__(self) -> str:
        return str(self.args[-1])


@dataclasses.dataclass(frozen=True, eq=False)
class Store(Contents):
    """The files of a sweep, as they are filled. It can be sent to other processes that see the same files."""

    plan: Plan
    #: The document that identifies the store.
    description: Mapping[str, Any]

    @classmethod
    def of(
        cls,
        path: str | os.PathLike[str],
        plan: Plan,
        *,
        engine: Engine | None = None,
        block_size: int | None = None,
        attributes: Mapping[str, Any] | None = None,
        trust: bool = False,
    ) -> tuple[Store, Evaluation]:
        """The store of a plan, new or begun, and its evaluation; nothing is written yet.

        A store that was begun keeps its engine. ``attributes`` go to the dataset with those of the plan.
        Raises :class:`~ballscrew.basis.errors.InputError` if something else lies there, and says what; for a link in
        the store; and for a store of another user, unless ``trust``.
        """
        folder = _checked(path, plan)
        refuse_unsafe(folder, trust=trust)
        stored = stored_plan(folder)
        chosen = engine or (None if stored is None else stored.get("engine"))
        try:
            # recorded however little it is, so that who goes on with it by the same engine has the same formulas
            evaluation = Evaluation.of(plan, chosen, recorded=True)
        except InputError as error:
            if engine is None and chosen is not None:
                begun = Fault(WHERE, f"was begun with the engine {chosen}", str(folder), OTHER)
                raise InputError(begun, *error.faults) from None
            raise
        if stored is not None and evaluation.identity.unknown:
            problem = "cannot be gone on with, as it cannot be known whether the model is the same"
            remedy = f"choose another name, or remove {folder}"
            raise InputError(Fault(WHERE, problem, evaluation.identity.unknown, remedy))
        blocks = Blocks.of(plan, block_size)
        engine_of = evaluation.attributes
        if stored is not None:  # the reason for the choice when the store was begun
            engine_of |= {n: v for n, v in stored.get("attributes", {}).items() if n == "engine_reason"}
        all_attributes = {**plan.attributes, **engine_of, **(attributes or {})}
        document = description_of(plan, blocks, all_attributes, engine=evaluation.engine, identity=evaluation.identity)
        store = cls.planned(folder, document, plan=plan, description=document)
        store.check_plan(stored)
        return store, evaluation

    def check_from_worker(self) -> None:
        """Raise :class:`~ballscrew.basis.errors.InputError` where this process does not see the store that was
        begun.
        """
        _checked(self.path, self.plan)
        try:
            seen = stored_plan(self.path) == self.description
        except InputError:
            seen = False
        if not seen:
            host = f"{self.path} on {socket.gethostname()}"
            raise InputError(Fault(WHERE, "is not seen by a worker", host, "give a folder that all nodes share"))

    def check_plan(self, stored: Mapping[str, Any] | None) -> None:
        """Raise :class:`~ballscrew.basis.errors.InputError` if another sweep is there, and say how it differs."""
        remedy = f"choose another name, or remove {self.path}"
        differing = [] if stored is None else differences(stored, self.description)
        raise_if_any([Fault(WHERE, "holds another sweep", words, remedy) for words in differing])

    @property
    def variables(self) -> list[str]:
        """The outputs in the store; what is varied is there as a coordinate."""
        return [name for name in self.plan.wanted if name not in self.plan.axes]

    def finished(self) -> Collection[int]:
        """The numbers of the finished blocks; those without a valid row are left out."""
        return self.rows().keys()

    # -- from begin to end ------------------------------------------------------------------------

    def begin(self) -> bool:
        """Prepare the folder for blocks; remove what a killed process left behind. Return whether the store is new."""
        stored = stored_plan(self.path)
        self.check_plan(stored)
        shutil.rmtree(self.own / "temporary", ignore_errors=True)
        (self.own / "temporary").mkdir(exist_ok=True)
        if stored is None:
            self._put(self.own / "plan.json", [sealed("plan", self.description)])
        return stored is None

    def pending(self, *, new: bool) -> list[int]:
        """The numbers of the blocks that are not finished, damaged ones among them, as the log tells.

        Damaged metadata are written again.
        """
        rows = self.rows()
        of_blocks, others = self.damaged_blocks(rows, checksums=True), self.damaged_layout(checksums=True)
        if self.is_complete and (of_blocks or others):
            (self.path / ROOT).replace(_free(self.own / ROOT))  # nobody shall open it until it is repaired
        if others:
            if not new and (rows or (self.own / LAYOUT).exists()):  # else a process was killed as it began
                _log.warning("%s: written again: %s", self.path, _named(others))
            self._lay_out()
        bad = {damage.block for damage in of_blocks if damage.block is not None}
        if bad:
            blocks = f"{len(bad)} block{'s are' if len(bad) > 1 else ' is'}"
            _log.warning("%s: %s computed again: %s", self.path, blocks, _named(of_blocks))
        (self.own / "blocks").mkdir(exist_ok=True)
        return [number for number in range(self.blocks.count) if number not in rows or number in bad]

    def _lay_out(self) -> None:
        """All metadata and coordinates, in place; the root's aside, until the store is complete."""
        from ballscrew.engine.sweeps.store_zarr import lay_out

        new = self.own / "temporary" / "new"
        shutil.rmtree(new, ignore_errors=True)
        layout = lay_out(new, self.plan, self.blocks, self.variables, self.description["attributes"], self.digest)
        for member in sorted(path for path in new.iterdir() if path.is_dir()):
            place = self.path / member.name
            if member.name in self.variables:  # chunks that are there stay
                place.mkdir(exist_ok=True)
                (member / ROOT).replace(_free(place / ROOT))
            else:
                shutil.rmtree(place, ignore_errors=True)
                member.replace(place)
        (new / ROOT).replace(_free(self.own / ROOT))
        self._put(self.own / LAYOUT, [sealed("layout", layout)])

    def finish(self) -> None:
        """One file of checksums, then the root's metadata: now the store can be opened."""
        if not self.is_complete:
            rows = self.rows()
            table = (rows[number] for number in range(self.blocks.count))
            self._put(self.own / "blocks.csv", itertools.chain([row(self.digest, self.heading)], table))
            (self.own / ROOT).replace(self.path / ROOT)
        self.clear()
        shutil.rmtree(self.own / "blocks", ignore_errors=True)

    def clear(self) -> None:
        """Remove temporary files."""
        shutil.rmtree(self.own / "temporary", ignore_errors=True)

    @property
    def is_tidy(self) -> bool:
        """Return whether no temporary file of the filling is left."""
        return {path.name for path in self.own.iterdir()} == {"plan.json", LAYOUT, "blocks.csv"}

    @property
    def is_intact(self) -> bool:
        """Return whether the store is complete, and all files are there in their sizes."""
        if not (self.is_complete and self.is_tidy) or self.damaged_layout(checksums=False):
            return False
        return not self.damaged_blocks(self.rows(), checksums=False)

    # -- blocks -----------------------------------------------------------------------------------

    def write(self, number: int, name: str, values: np.ndarray) -> Content:
        """Write the results of a block, one output; size and checksum. Values are those of the flattened block."""
        from ballscrew.engine.sweeps.store_zarr import chunk_of

        key = self.key(number, name)
        chunk = chunk_of(self._metadata[name], self.blocks, number, values)
        if chunk is None:
            _free(self.path / key).unlink(missing_ok=True)
        else:
            self._put(self.path / key, [chunk])
        return Content.of(self.digest, key, b"" if chunk is None else chunk)

    def commit(self, number: int, results: Mapping[str, np.ndarray], chunks: Mapping[str, Content]) -> None:
        """Mark a block as finished, after all its outputs are written."""
        written = itertools.chain.from_iterable((chunks[name].checksum, chunks[name].bytes) for name in self.columns)
        false = [results[name].size - np.count_nonzero(results[name]) for name in self.truths]
        self._put(self.own / "blocks" / str(number), [row(self.digest, [number, *written, *false])])

    @functools.cached_property
    def _metadata(self) -> dict[str, Any]:
        """The metadata of each output from which Zarr makes a chunk."""
        from ballscrew.engine.sweeps.store_zarr import metadata_of

        return {name: metadata_of(self.path / name) for name in self.variables}

    def _put(self, path: Path, content: Iterable[Any]) -> None:
        """Write a file that is complete and synced to disk before it gets its name."""
        temporary = self.own / "temporary" / uuid.uuid4().hex
        try:
            with temporary.open("xb") as file:  # "x" follows no link, nor does a rename
                file.writelines(content)
                file.flush()
                os.fsync(file.fileno())
            try:
                temporary.replace(_free(path))
            except FileNotFoundError:
                path.parent.mkdir(parents=True, exist_ok=True)
                temporary.replace(path)
        except BaseException:
            temporary.unlink(missing_ok=True)
            raise

    # -- reading ----------------------------------------------------------------------------------

    def opened(self) -> xr.Dataset:
        """The dataset of a complete store; values are read, and compared with their checksums, when asked for."""
        from ballscrew.engine.sweeps import store_zarr

        return store_zarr.opened(self.path)[self.variables]


def _free(path: Path) -> Path:
    """The path of a file that is written or removed; an empty folder in its place is removed, another one refused."""
    if path.is_dir() and not path.is_symlink():
        try:
            path.rmdir()
        except OSError:
            fault = Fault(
                WHERE, "has a folder in place of a file", str(path), "remove the folder and run the same again"
            )
            raise InputError(fault) from None
    return path


def _checked(path: str | os.PathLike[str], plan: Plan) -> Path:
    """The folder of a store; faults in what was given for it."""
    if importlib.util.find_spec("zarr") is None:
        raise InputError(Fault(WHERE, "needs zarr", str(path), 'pip install "ballscrew[data]"'))
    if Path(path).suffix.lower() in _FILES:
        raise InputError(Fault(WHERE, "is a folder, not a file", str(path), "end it with .zarr"))
    if "://" in str(path):
        raise InputError(Fault(WHERE, "is not in a file system", str(path), "give the path of a folder"))
    if all(name in plan.axes for name in plan.wanted):
        raise InputError(Fault("sweep.outputs", "are what is varied", ", ".join(plan.wanted), "ask for another one"))
    return Path(path).absolute()


@contextlib.contextmanager
def stopping_cleanly(store: Store) -> Generator[None]:
    """Remove temporary files when the work stops, and report how many blocks are finished.

    A full disk or a lost cluster raises :class:`UnfinishedSweepError`; an interrupt carries the text as a note. A file
    in place of a folder raises :class:`~ballscrew.basis.errors.InputError`: it may be one of the user, and is not
    removed.
    """
    try:
        yield
    except OSError as error:
        if isinstance(error, FileExistsError | NotADirectoryError):
            _refuse_file(store, error)
        remedy = "make room and run the same again" if error.errno in FULL else "run the same again"
        why = error.strerror or str(error) or type(error).__name__
        raise UnfinishedSweepError(error.errno, _stopped(store, f" ({why})", remedy)) from error
    except KeyboardInterrupt as error:
        error.add_note(_stopped(store, "", "run the same again"))
        raise
    finally:
        store.clear()


def _refuse_file(store: Store, error: OSError) -> None:
    """Raise for a file in the place of a folder, which the same sweep would meet again."""
    for name in (error.filename, error.filename2):
        file = None if name is None else file_in_place_of_a_folder(Path(os.fsdecode(name)), store.path)
        if file is not None and not file.is_relative_to(store.own / "temporary"):
            remedy = "remove the file and run the same again"
            raise InputError(Fault(WHERE, "has a file in place of a folder", str(file), remedy)) from None


def _named(damaged: Sequence[Damage]) -> str:
    """The first of the damaged files, and how many more there are."""
    more = len(damaged) - _NAMED_AT_MOST
    return ", ".join(map(str, damaged[:_NAMED_AT_MOST])) + (f" and {more} more" if more > 0 else "")


def _stopped(store: Store, why: str, remedy: str) -> str:
    count = store.blocks.count
    finished = f"{count if store.is_complete else len(store.finished())} of {count} blocks are finished"
    return f"{store.path}: stopped{why}, {finished} · {remedy} to go on"
