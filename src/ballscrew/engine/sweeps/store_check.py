"""Check of a store against its sizes and checksums, without the model that filled it."""

from __future__ import annotations

import contextlib
import dataclasses
import functools
import itertools
import os
import stat
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, Self

from ballscrew.basis.errors import Fault, InputError
from ballscrew.engine.sweeps.store_plan import (
    BYTES,
    FALSE,
    FORMAT,
    OTHER,
    OWN,
    WHERE,
    Blocks,
    Content,
    cells_of,
    checksum,
    is_plan,
    read_sealed,
    row,
    unreadable,
)

#: The metadata of the dataset, and of each variable.
ROOT = "zarr.json"
#: The table of metadata and coordinates.
LAYOUT = "layout.json"
#: Files that are read at a time.
READERS = 4
#: Blocks that wait for a reader.
BATCH = 1000
_FOREIGN = "is there and is not the store of a sweep"
#: The remedy for a store that turns out to be damaged as it is read.
AGAIN = "run the same sweep once more with --verify (verify=True in Python), which computes again what is damaged"
#: Remedies for what is not to be filled but only checked.
_A_STORE, _A_COPY = "give the folder of a store", "take a copy of the store, or sweep again under another name"


@dataclasses.dataclass(frozen=True)
class Damage:
    """A file of a store that is not as it was written; with the number of its block where it holds results."""

    path: str
    problem: str
    block: int | None = None

    def __str__(self) -> str:
        return f"{self.path} {self.problem}"


@dataclasses.dataclass(frozen=True)
class Verification:
    """The result of :func:`verify`."""

    path: Path
    #: The number of blocks of the sweep, and of those that are finished.
    blocks: int
    finished: int
    #: The files that are not as they were written.
    damaged: tuple[Damage, ...]
    #: True after the sweep has ended in order: only then the store can be opened.
    is_complete: bool

    @property
    def holds(self) -> bool:
        """Return whether the store is complete and nothing is damaged."""
        return self.is_complete and self.finished == self.blocks and not self.damaged


def verify(store: str | os.PathLike[str]) -> Verification:
    """Read all files of the store of a sweep and compare size and CRC-32 with those noted when they were written.

    Returns a :class:`Verification` of the folder ``store``. Nothing is changed: the sweep that filled the store
    computes damaged blocks again (``bs.sweep(…, to=…, verify=True)``, ``ballscrew sweep … --verify``). CRC-32 finds
    damage by accident, not a change on purpose.

    Raises :class:`~ballscrew.basis.errors.InputError` for a folder that is not the store of a sweep, whose plan is
    damaged, or whose checksums cannot be read.
    """
    contents = contents_of(Path(store).absolute())
    rows = contents.rows()
    damaged = (*contents.damaged_layout(checksums=True), *contents.damaged_blocks(rows, checksums=True))
    return Verification(contents.path, contents.blocks.count, len(rows), damaged, contents.is_complete)


def contents_of(path: Path) -> Contents:
    """The files of the store in a folder, by its plan.

    Raises :class:`~ballscrew.basis.errors.InputError` where there is none, of a damaged plan, and of another version.
    """
    document = stored_plan(path, foreign=_A_STORE, damaged=_A_COPY)
    if document is None:
        raise InputError(Fault(WHERE, "is not the store of a sweep", str(path), _A_STORE))
    if document["format"] != FORMAT:
        remedy = f"sweep again under another name: a store of format {FORMAT} has checksums bound to its plan"
        raise InputError(Fault(WHERE, "is a store of another version", f"{path}: format {document['format']}", remedy))
    return Contents.planned(path, document)


def stored_plan(folder: Path, *, foreign: str = "choose another name", damaged: str = OTHER) -> dict[str, Any] | None:
    """The document of the store in a folder; None where there is no store yet.

    Raises :class:`~ballscrew.basis.errors.InputError` where something else is, with the remedy ``foreign``, and for a
    plan that is ``damaged``: it is not touched.
    """
    path = folder / OWN / "plan.json"
    try:
        try:
            text = path.read_text(encoding="utf-8")
        except (FileNotFoundError, NotADirectoryError):
            _refuse_without_plan(folder, foreign, damaged)
            return None
    except InputError:
        raise
    except (OSError, ValueError) as error:
        raise unreadable(path, error, damaged) from None
    document = read_sealed("plan", text)
    if document is None or not is_plan(document):
        raise InputError(Fault(WHERE, "has a damaged plan", str(path), damaged))
    return document


def _refuse_without_plan(folder: Path, foreign: str, damaged: str) -> None:
    """Raise for a folder that has something else than a plan in it.

    Nothing may be there, or what a process left that was killed as it began.
    """
    if not folder.exists():
        return  # perhaps it is above that there is none, as making the folder will say
    if not folder.is_dir():
        raise InputError(Fault(WHERE, _FOREIGN, str(folder), foreign))
    if (folder / OWN).is_file():
        raise InputError(Fault(WHERE, "has a file in place of a folder", str(folder / OWN), damaged))
    names = {path.name for path in folder.iterdir()}
    if OWN in names and names != {OWN}:
        raise InputError(Fault(WHERE, "has lost its plan", str(folder / OWN / "plan.json"), damaged))
    if names - {OWN}:
        raise InputError(Fault(WHERE, _FOREIGN, str(folder), foreign))


def file_in_place_of_a_folder(path: Path, store: Path) -> Path | None:
    """The file on the way to a folder in a store, or in its place."""
    way = [folder for folder in (path, *path.parents) if folder.is_relative_to(store)]
    return next((folder for folder in reversed(way) if folder.is_file()), None)


@dataclasses.dataclass(frozen=True)
class Contents:
    """The files that a store has by its plan."""

    path: Path
    blocks: Blocks
    #: The outputs, in the order of the table of blocks, and those that are truth values.
    columns: tuple[str, ...]
    truths: tuple[str, ...]
    #: The digest of the plan, to which all checksums are bound.
    digest: str

    @classmethod
    def planned(cls, path: Path, document: Mapping[str, Any], **more: Any) -> Self:
        """The files of a store with this document; ``more`` are further fields."""
        outputs = {name: kind for name, kind in sorted(document["outputs"].items()) if name not in document["axes"]}
        truths = tuple(name for name, kind in outputs.items() if kind == "bool")
        blocks = Blocks(tuple(document["shape"]), tuple(document["chunks"]))
        return cls(path, blocks, tuple(outputs), truths, checksum(document), **more)

    @property
    def own(self) -> Path:
        """The folder with the plan and the checksums."""
        return self.path / OWN

    @property
    def is_complete(self) -> bool:
        """Return whether the store can be opened as a dataset."""
        return os.path.lexists(self.path / ROOT)

    @property
    def heading(self) -> tuple[str, ...]:
        """The headings of the table of blocks."""
        columns = itertools.chain.from_iterable((name, f"{name}{BYTES}") for name in self.columns)
        return ("block", *columns, *(f"{name}{FALSE}" for name in self.truths))

    def key(self, number: int, name: str) -> str:
        """The path of a chunk in the store."""
        return f"{name}/{self.blocks.key(number)}"

    def rows(self) -> dict[int, bytes]:
        """The rows of the finished blocks; damaged ones are left out.

        Raises :class:`~ballscrew.basis.errors.InputError` where nobody may read them: they may all be good.
        """
        rows: dict[int, bytes] = {}
        table = self.own / "blocks.csv"
        missing = FileNotFoundError, NotADirectoryError, IsADirectoryError
        try:
            with contextlib.suppress(*missing), table.open("rb") as file:
                next(file, None)
                self._add(rows, file)
        except OSError as error:
            raise unreadable(table, error) from None
        for entry in self._entries():
            if entry.is_file(follow_symlinks=False):
                with contextlib.suppress(OSError):  # ``_unread_rows`` says which
                    self._add(rows, [Path(entry.path).read_bytes()], entry.name)
        return rows

    def _entries(self) -> Iterator[os.DirEntry[str]]:
        """The entries of the folder with the rows of single blocks."""
        folder = self.own / "blocks"
        try:
            with contextlib.suppress(FileNotFoundError, NotADirectoryError), os.scandir(folder) as entries:
                yield from entries
        except OSError as error:
            raise unreadable(folder, error) from None

    def _unread_rows(self, rows: Mapping[int, bytes]) -> list[Damage]:
        """The blocks with a folder or a link in place of the file of their row, or with one that cannot be read."""
        is_blocked = not self.is_complete and (self.own / "blocks").is_file()
        damaged = [Damage(f"{OWN}/blocks", "is a file and no folder")] if is_blocked else []
        for entry in self._entries():
            number = int(entry.name) if entry.name.isdecimal() else self.blocks.count
            if number < self.blocks.count and number not in rows and (problem := _unread(entry)):
                damaged.append(Damage(f"{OWN}/blocks/{entry.name}", problem, number))
        return damaged

    def _add(self, rows: dict[int, bytes], lines: Any, name: str | None = None) -> None:
        for line in lines:
            cells = cells_of(self.digest, line)
            if cells is None or len(cells) != len(self.heading) or name not in (None, cells[0]):
                continue
            if 0 <= int(cells[0]) < self.blocks.count:
                rows[int(cells[0])] = line

    def damaged_blocks(self, rows: Mapping[int, bytes], *, checksums: bool) -> list[Damage]:
        """The chunks of finished blocks that are not as they were written.

        Of a complete store also the blocks without a valid row.
        """

        def of_block(number: int) -> list[Damage]:
            cells = self.cells(rows[number])
            damaged: list[Damage] = []
            for name in self.columns:
                key = self.key(number, name)
                noted = Content(int(cells[f"{name}{BYTES}"]), cells[name])
                if problem := self._problem(self.path / key, key, noted, checksums=checksums):
                    damaged.append(Damage(key, problem, number))
            return damaged

        numbers, damaged = list(rows), self._unread_rows(rows)
        with ThreadPoolExecutor(READERS) as pool:
            for first in range(0, len(numbers), BATCH):  # a store may have millions
                damaged += itertools.chain.from_iterable(pool.map(of_block, numbers[first : first + BATCH]))
        if self.is_complete:
            missing = (number for number in range(self.blocks.count) if number not in rows)
            damaged += [Damage(f"{OWN}/blocks.csv", f"has no valid row of block {n}", n) for n in missing]
        return damaged

    def _has_whole_table(self) -> bool:
        """Return whether the table of blocks has its heading and as many rows as there are blocks, all valid."""
        with contextlib.suppress(OSError), (self.own / "blocks.csv").open("rb") as file:
            is_headed = next(file, b"") == row(self.digest, self.heading)
            return (
                is_headed and [cells_of(self.digest, line) is not None for line in file] == [True] * self.blocks.count
            )
        return False

    def _layout(self) -> dict[str, Content] | None:
        """Sizes and checksums of metadata and coordinates; None where their table is damaged."""
        document = read_sealed("layout", (self.own / LAYOUT).read_text(encoding="utf-8"))
        return None if document is None else {key: Content(*noted) for key, noted in document.items()}

    def damaged_layout(self, *, checksums: bool) -> list[Damage]:
        """The metadata and coordinates that are not as they were written."""
        try:
            layout = self._layout()
        except FileNotFoundError:
            return [Damage(f"{OWN}/{LAYOUT}", "is missing")]
        except PermissionError as error:
            return [Damage(f"{OWN}/{LAYOUT}", f"cannot be read: {error.strerror}")]
        except (OSError, ValueError, TypeError):
            layout = None
        if layout is None:
            return [Damage(f"{OWN}/{LAYOUT}", "is damaged")]
        damaged: list[Damage] = []
        if self.is_complete and not self._has_whole_table():
            damaged.append(Damage(f"{OWN}/blocks.csv", "is damaged"))
        for key, noted in layout.items():
            path = self.own / ROOT if key == ROOT and not self.is_complete else self.path / key
            # metadata are small; coordinates may be as long as an axis
            problem = self._problem(path, key, noted, checksums=checksums or path.name == ROOT)
            if problem:
                damaged.append(Damage(key, problem))
        return damaged

    def _problem(self, path: Path, key: str, noted: Content, *, checksums: bool) -> str:
        """Problem of a file; a chunk of nothing but the fill value has no bytes and no file."""
        try:
            state = path.lstat()
            if not stat.S_ISREG(state.st_mode):
                return "is not a file"
            if state.st_size != noted.bytes:
                return f"has {state.st_size} bytes, not {noted.bytes}"
            return (
                "has another checksum" if checksums and Content.of(self.digest, key, path.read_bytes()) != noted else ""
            )
        except NotADirectoryError:
            store = path.parents[key.count("/")]
            file = file_in_place_of_a_folder(path.parent, store)
            return "is missing" + (
                "" if file is None else f": {file.relative_to(store).as_posix()} is a file and no folder"
            )
        except FileNotFoundError:
            return "is missing" if noted.bytes else ""
        except OSError as error:
            return f"cannot be read: {error.strerror or error}"

    def cells(self, line: bytes) -> dict[str, str]:
        """The cells of a valid row by their headings."""
        return dict(zip(self.heading, cells_of(self.digest, line) or (), strict=True))

    def check(self, key: str, content: Any) -> None:
        """Raise :class:`~ballscrew.basis.errors.InputError` for a file that is not as it was written; None is no file.

        It is raised, too, where the checksums cannot be read.
        """
        noted = self._noted_of(key)
        if noted is None or Content.of(self.digest, key, b"" if content is None else content) == noted:
            return
        problem = "is missing" if content is None else "is damaged, or of another sweep"
        raise InputError(Fault(WHERE, f"has a file that {problem}", str(self.path / key), AGAIN))

    @functools.cached_property
    def _noted(self) -> tuple[Mapping[str, Content], Mapping[int, bytes]]:
        """Sizes and checksums of metadata and coordinates, and the rows of blocks, read once."""
        layout = None
        with contextlib.suppress(OSError, ValueError, TypeError):
            layout = self._layout()
        if layout is None:
            raise _unreadable_checksums(str(self.own / LAYOUT))
        return layout, self.rows()

    def _noted_of(self, key: str) -> Content | None:
        """Size and checksum of a file as it was written; None of what the store does not have."""
        layout, rows = self._noted
        name, _, place = key.partition("/")
        number = self.blocks.number(place)
        if key in layout or name not in self.columns or number is None:
            return layout.get(key)
        if number not in rows:
            raise _unreadable_checksums(f"{self.own}: no valid row of block {number}")
        cells = self.cells(rows[number])
        return Content(int(cells[f"{name}{BYTES}"]), cells[name])


def _unreadable_checksums(where: str) -> InputError:
    return InputError(Fault(WHERE, "has checksums that cannot be read", where, AGAIN))


def _unread(entry: os.DirEntry[str]) -> str:
    """Problem of the file of a row; none where it was read."""
    if not entry.is_file(follow_symlinks=False):
        return "is not a file"
    try:
        Path(entry.path).read_bytes()
    except OSError as error:
        return f"cannot be read: {error.strerror or error}"
    return ""


def count_false(path: Path) -> dict[str, tuple[int, int]]:
    """Number of false points of each truth value of a complete store that has some, and the first block with one."""
    contents = contents_of(path)
    rows, counts = contents.rows(), dict[str, tuple[int, int]]()
    if len(rows) < contents.blocks.count:
        raise _unreadable_checksums(f"{contents.own / 'blocks.csv'}: a damaged row")
    for number in range(contents.blocks.count):
        cells = contents.cells(rows[number])
        for name in contents.truths:
            if count := int(cells[f"{name}{FALSE}"]):
                before, first = counts.get(name, (0, number))
                counts[name] = before + count, first
    return counts
