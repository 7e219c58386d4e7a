"""A sweep on disk: a Zarr store that is filled block by block, and goes on where it was stopped.

The only module of this room that writes files, and only inside the store::

    map.zarr/zarr.json              last of all, by a rename: a store without it is not finished
    map.zarr/screw_torque/c/0/1     a chunk: the results of one block, one output
    map.zarr/.ballscrew/plan.json   what the store holds, with its digest
    map.zarr/.ballscrew/blocks.csv  checksums (CRC-32 of the numbers) of all blocks
    map.zarr/.ballscrew/blocks/12   the row of one block; there once its chunks are, until all are
    map.zarr/.ballscrew/lock        while somebody writes

Every file is written under another name, brought to the disk, and renamed.
"""

from __future__ import annotations

import contextlib
import dataclasses
import errno
import functools
import importlib.util
import itertools
import json
import os
import shutil
import socket
import uuid
import warnings
from collections.abc import Generator, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ballscrew.errors import (
    Fault,
    InputError,
    raise_if_any,
)
from ballscrew.evaluation.evaluation import Engine, Evaluation
from ballscrew.evaluation.outputs import attributes_of
from ballscrew.evaluation.plan import Plan
from ballscrew.sweeps.store_plan import Blocks, canonical_json, checksum, description_of, differences
from ballscrew.sweeps.store_rows import FALSE, OTHER, OWN, WHERE, crc, row

#: LZ4 with the bytes of equal weight side by side: a map of seven outputs takes 0.72 of its bytes, and
#: a disk slower than a processor compresses has the less to do. Zstandard saves 0.02 more at most and
#: takes up to twice as long; on numbers as they are it saves half as much
#: (``benchmarks/out_of_core.py --codecs``).
COMPRESSION: Mapping[str, Any] = {"cname": "lz4", "clevel": 1, "shuffle": "shuffle"}
#: Suffixes that mean a file, not the folder of a store.
_FILES = (".csv", ".xlsx", ".nc", ".json", ".toml")
_ROOT = "zarr.json"
_FOREIGN = "is there and is not the store of a sweep"
#: A disk that is full, for all or for this user.
FULL = {errno.ENOSPC, errno.EDQUOT}


class UnfinishedSweepError(OSError):
    """A full disk or a lost cluster; finished blocks stay, and the same sweep continues from there."""

    def __str__(self) -> str:
        return str(self.args[-1])


@dataclasses.dataclass(frozen=True, eq=False)
class Store:
    """The folder of a sweep. It can be sent to other processes that see the same files."""

    path: Path
    plan: Plan
    blocks: Blocks
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
    ) -> tuple[Store, Evaluation]:
        """The store of a plan, new or begun, and its evaluation; nothing is written yet.

        A store that was begun keeps its engine. ``attributes`` go to the dataset with those of the plan.
        Raises :class:`~ballscrew.errors.InputError` if something else lies there, and says what.
        """
        folder = _checked(path, plan)
        stored = _stored(folder)
        chosen = engine or (None if stored is None else stored["engine"])
        try:
            evaluation = Evaluation.of(plan, chosen)
        except InputError as error:
            if engine is None and chosen is not None:
                begun = Fault(WHERE, f"was begun with the engine {chosen}", str(folder), OTHER)
                raise InputError(begun, *error.faults) from None
            raise
        blocks = Blocks.of(plan, block_size)
        engine_of = evaluation.attributes
        if stored is not None:  # the reason for the choice when the store was begun
            engine_of |= {n: v for n, v in stored["attributes"].items() if n == "engine_reason"}
        all_attributes = {**plan.attributes, **engine_of, **(attributes or {})}
        document = description_of(
            plan, blocks, all_attributes, engine=evaluation.engine, fingerprint=evaluation.fingerprint
        )
        store = cls(folder, plan, blocks, document)
        store.check(stored)
        return store, evaluation

    def check_from_worker(self) -> None:
        """Raise :class:`~ballscrew.errors.InputError` where this process does not see the store that was begun."""
        _checked(self.path, self.plan)
        try:
            seen = _stored(self.path) == self.description
        except InputError:
            seen = False
        if not seen:
            host = f"{self.path} on {socket.gethostname()}"
            raise InputError(Fault(WHERE, "is not seen by a worker", host, "give a folder that all nodes share"))

    def check(self, stored: Mapping[str, Any] | None) -> None:
        """Raise :class:`~ballscrew.errors.InputError` if another sweep is there, and say how it differs."""
        remedy = f"choose another name, or remove {self.path}"
        differing = [] if stored is None else differences(stored, self.description)
        raise_if_any([Fault(WHERE, "holds another sweep", words, remedy) for words in differing])

    @property
    def own(self) -> Path:
        """The folder with the plan and the checksums."""
        return self.path / OWN

    @property
    def variables(self) -> list[str]:
        """The outputs in the store; what is varied is there as a coordinate."""
        return [name for name in self.plan.wanted if name not in self.plan.axes]

    @property
    def is_complete(self) -> bool:
        """Return whether all blocks are finished and the store can be opened."""
        return (self.path / _ROOT).exists()

    def finished(self) -> set[int]:
        """The numbers of the finished blocks of a store that is not complete; an incomplete marker is ignored."""
        found: set[int] = set()
        with contextlib.suppress(FileNotFoundError):
            for path in (self.own / "blocks").iterdir():
                number = int(path.name) if path.name.isdecimal() else -1
                if 0 <= number < self.blocks.count and self._marks(path, number):
                    found.add(number)
        return found

    def _marks(self, path: Path, number: int) -> bool:
        cells = path.read_text(encoding="utf-8", errors="replace").strip().split(",")
        return cells[0] == str(number) and len(cells) == 1 + len(self.variables) + len(self._truths)

    # -- from begin to end ------------------------------------------------------------------------

    def begin(self) -> None:
        """Prepare the folder for blocks; remove what a killed process left behind."""
        self.check(_stored(self.path))
        shutil.rmtree(self.own / "temporary", ignore_errors=True)
        (self.own / "temporary").mkdir(exist_ok=True)
        if _stored(self.path) is None:
            self._put(
                self.own / "plan.json", [canonical_json({"plan": self.description, "sha256": self.digest}).encode()]
            )
        if not (self.own / _ROOT).exists() and not self.is_complete:
            self._lay_out()
        (self.own / "blocks").mkdir(exist_ok=True)

    def _lay_out(self) -> None:
        """All metadata and coordinates, in place; the root's aside, until the store is complete."""
        import zarr
        from zarr.codecs import BloscCodec

        new = self.own / "temporary" / "new"
        with warnings.catch_warnings():
            # labels that are text have no settled type in Zarr 3 yet; they are read back by the same library
            warnings.filterwarnings("ignore", message=".*does not have a Zarr V3 specification")
            coordinates = xr.Dataset(coords=self.plan.coordinates(), attrs=dict(self.description["attributes"]))
            coordinates.to_zarr(new, zarr_format=3, consolidated=False)
        aside = [str(name) for name in coordinates.coords if name not in coordinates.dims]
        for name in self.variables:
            output = self.plan.wanted[name]
            attributes: dict[str, Any] = {**attributes_of(output.quantity)}
            if aside:
                attributes["coordinates"] = " ".join(aside)
            zarr.create_array(
                new,
                name=name,
                shape=self.blocks.shape,
                chunks=self.blocks.chunk,
                dtype=np.dtype(output.dtype),
                compressors=BloscCodec(**COMPRESSION) if self.blocks.shape else None,
                fill_value=np.dtype(output.dtype).type(np.nan if output.dtype is float else False),
                dimension_names=list(self.plan.sizes),
                attributes=attributes,
            )
        root = json.loads((new / _ROOT).read_text(encoding="utf-8"))
        root["attributes"].pop("coordinates", None)  # each variable names its own
        members = sorted(path.name for path in new.iterdir() if path.is_dir())
        # with the metadata of all members in one place nobody need list the folder
        metadata = {name: json.loads((new / name / _ROOT).read_text(encoding="utf-8")) for name in members}
        root["consolidated_metadata"] = {"kind": "inline", "must_understand": False, "metadata": metadata}
        for name in members:
            shutil.rmtree(self.path / name, ignore_errors=True)  # of a process killed at this very place
            (new / name).replace(self.path / name)
        self._put(self.own / _ROOT, [json.dumps(root, indent=2, ensure_ascii=False, sort_keys=True).encode()])

    def finish(self) -> None:
        """One file of checksums, then the root's metadata: now the store can be opened."""
        if not self.is_complete:
            rows = (self.own / "blocks" / str(number) for number in range(self.blocks.count))
            self._put(self.own / "blocks.csv", itertools.chain([self._heading], (row.read_bytes() for row in rows)))
            (self.own / _ROOT).replace(self.path / _ROOT)
        self.clear()
        shutil.rmtree(self.own / "blocks", ignore_errors=True)

    def clear(self) -> None:
        """Remove temporary files."""
        shutil.rmtree(self.own / "temporary", ignore_errors=True)

    @property
    def is_tidy(self) -> bool:
        """Return whether no temporary file of the filling is left."""
        return {path.name for path in self.own.iterdir()} == {"plan.json", "blocks.csv"}

    @functools.cached_property
    def digest(self) -> str:
        """The digest of the document."""
        return checksum(self.description)

    # -- blocks -----------------------------------------------------------------------------------

    def write(self, number: int, name: str, values: np.ndarray) -> str:
        """Write the results of a block, one output; their checksum. Values are those of the flattened block."""
        import zarr
        from zarr.storage import MemoryStore

        held = {_ROOT: self._metadata[name]}  # Zarr makes the chunk in memory; how it gets to the disk is ours
        region = self.blocks.region(number)
        array: Any = zarr.open_array(MemoryStore(held), mode="r+")
        array[region if region else ...] = values.reshape([part.stop - part.start for part in region])
        for key, chunk in held.items():
            if key != _ROOT:  # a chunk of nothing but the fill value has no file
                self._put(self.path / name / key, [chunk.as_numpy_array()])
        return crc(values)

    def commit(self, number: int, results: Mapping[str, np.ndarray], checksums: Sequence[str]) -> None:
        """Mark a block as finished, after all its outputs are written."""
        false = [results[name].size - np.count_nonzero(results[name]) for name in self._truths]
        self._put(self.own / "blocks" / str(number), [row([number, *checksums, *false])])

    @property
    def _heading(self) -> bytes:
        return row(["block", *self.variables, *(f"{name}{FALSE}" for name in self._truths)])

    @property
    def _truths(self) -> list[str]:
        return [name for name in self.variables if self.plan.wanted[name].dtype is bool]

    @functools.cached_property
    def _metadata(self) -> dict[str, Any]:
        """The metadata of each output from which Zarr makes a chunk."""
        from zarr.core.buffer import default_buffer_prototype

        buffer = default_buffer_prototype().buffer
        return {name: buffer.from_bytes((self.path / name / _ROOT).read_bytes()) for name in self.variables}

    def _put(self, path: Path, content: Iterable[Any]) -> None:
        """Write a file that is complete and synced to disk before it gets its name."""
        temporary = self.own / "temporary" / uuid.uuid4().hex
        try:
            with temporary.open("xb") as file:
                file.writelines(content)
                file.flush()
                os.fsync(file.fileno())
            try:
                temporary.replace(path)
            except FileNotFoundError:
                path.parent.mkdir(parents=True, exist_ok=True)
                temporary.replace(path)
        except BaseException:
            temporary.unlink(missing_ok=True)
            raise

    # -- reading ----------------------------------------------------------------------------------

    def opened(self) -> xr.Dataset:
        """The dataset of a complete store; values are read when they are asked for."""
        return xr.open_zarr(self.path, chunks=None, consolidated=True)[self.variables]


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


def _stored(folder: Path) -> dict[str, Any] | None:
    """The document of the store in a folder; None where there is no store yet.

    Raises :class:`~ballscrew.errors.InputError` where something else is: it is not touched.
    """
    path = folder / OWN / "plan.json"
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        # without a plan there may be what a process left that was killed as it began
        if not folder.exists() or not {path.name for path in folder.iterdir()} - {OWN}:
            return None
        raise InputError(Fault(WHERE, _FOREIGN, str(folder), "choose another name")) from None
    except NotADirectoryError:
        if not folder.exists():
            return None  # it is above that there is none, as making the folder will say
        raise InputError(Fault(WHERE, _FOREIGN, str(folder), "choose another name")) from None
    except (OSError, ValueError) as error:
        raise InputError(Fault(WHERE, "cannot be read", f"{path}: {error}", OTHER)) from None
    with contextlib.suppress(ValueError, KeyError, TypeError):
        kept = json.loads(text)
        if checksum(kept["plan"]) == kept["sha256"]:
            return kept["plan"]
    raise InputError(Fault(WHERE, "has a damaged plan", str(path), OTHER))


@contextlib.contextmanager
def stopping_cleanly(store: Store) -> Generator[None]:
    """Remove temporary files when the work stops, and report how many blocks are finished.

    A full disk or a lost cluster raises :class:`UnfinishedSweepError`; an interrupt carries the text as a note.
    """
    try:
        yield
    except OSError as error:
        remedy = "make room and run the same again" if error.errno in FULL else "run the same again"
        why = error.strerror or str(error) or type(error).__name__
        raise UnfinishedSweepError(error.errno, _stopped(store, f" ({why})", remedy)) from error
    except KeyboardInterrupt as error:
        error.add_note(_stopped(store, "", "run the same again"))
        raise
    finally:
        store.clear()


def _stopped(store: Store, why: str, remedy: str) -> str:
    count = store.blocks.count
    finished = f"{count if store.is_complete else len(store.finished())} of {count} blocks are finished"
    return f"{store.path}: stopped{why}, {finished} · {remedy} to go on"
