"""Files that are much larger than they look, or than they need be, read by the commands under a limit of memory.

Logs, traces and catalogues of which a few kilobytes unpack to gigabytes (XLSX, MATLAB 5, MATLAB 7.3), CSV of 100,000
columns, of one line or one cell of 100 MB and of 10,000,000 rows; by `fit`, `duty --trace` and `catalogue list --rows`.

*Wrong*: more than 3 GB of memory; more than 150 s of processor.
"""

from __future__ import annotations

import gzip
import io
import os
import resource
import subprocess
import sys
import time
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path

from benchmarks.hostile import ROOT, workers
from benchmarks.hostile.tally import Outcome, Tally

SECONDS = 600.0
#: Bytes of memory that a command may take, and seconds of processor.
MOST_MEMORY, MOST_SECONDS = 3 << 30, 150.0

_HEADING = b"speed [rpm],axial load [N],torque [N m]\n"


def _columns(path: Path) -> None:
    names = [b"speed [rpm]", b"axial load [N]", b"torque [N m]", *[b"c%d" % i for i in range(100_000)]]
    row = b",".join([b"100", b"1000", b"0.5", *[b"1"] * 100_000])
    path.write_bytes(b"\n".join([b",".join(names), *[row] * 20]))


def _rows(path: Path) -> None:
    some = [b"%d,%d,%.4f\n" % (50 + i % 900, 500 + i % 3000, 0.4 + i % 7 / 100) for i in range(100_000)]
    with path.open("wb") as file:
        file.write(_HEADING)
        for _ in range(100):
            file.writelines(some)


def _line(path: Path) -> None:
    path.write_bytes(_HEADING + b"1," * 50_000_000)


def _cell(path: Path) -> None:
    path.write_bytes(_HEADING + b'100,1000,"' + b"9" * 100_000_000 + b'"\n')


def _workbook(path: Path, part: str, before: str, repeated: str, times: int) -> None:
    """A small workbook of which one part has a text 1,000 times ``times`` times more, behind the text ``before``."""
    import xlsxwriter

    small = io.BytesIO()
    with xlsxwriter.Workbook(small) as book:
        sheet = book.add_worksheet()
        sheet.write_row(0, 0, ("speed [rpm]", "axial load [N]", "torque [N m]"))
        sheet.write_row(1, 0, (100, 1000, 0.5))
    with zipfile.ZipFile(small) as old, zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as new:
        for name in old.namelist():
            first, mark, last = old.read(name).partition(before.encode() if name == part else b"\0")
            with new.open(name, "w", force_zip64=True) as file:
                file.write(first + mark)
                for _ in range(times if mark else 0):
                    file.write(1000 * repeated.encode())
                file.write(last)


def _many_cells(path: Path) -> None:
    row = "<row><c><v>100</v></c><c><v>1000</v></c><c><v>0.5</v></c></row>"
    _workbook(path, "xl/worksheets/sheet1.xml", "<sheetData>", row, 20_000)


def _many_texts(path: Path) -> None:
    _workbook(path, "xl/sharedStrings.xml", "</si>", "<si><t>aaaaaaaaaaaaaaaa</t></si>", 40_000)


def _far_cell(path: Path) -> None:
    import openpyxl

    book = openpyxl.Workbook()
    book.active["A1"], book.active["XFD1048576"] = "speed [rpm]", 1
    book.save(path)


def _mat_head() -> bytes:
    return b"MATLAB 5.0 MAT-file".ljust(124, b" ") + b"\x00\x01IM"


def _element(kind: int, content: bytes, pretended: int | None = None) -> bytes:
    size = len(content) if pretended is None else pretended
    return kind.to_bytes(4, "little") + size.to_bytes(4, "little") + content + bytes(-len(content) % 8)


def _matrix(rows: int, head: bool = False) -> bytes:
    parts = _element(6, bytes([6, 0, 0, 0, 0, 0, 0, 0])) + _element(
        5, rows.to_bytes(4, "little") + (1).to_bytes(4, "little")
    )
    parts += _element(1, b"torque_Nm")
    return parts if head else parts + _element(9, bytes(8 * rows))


def _packed_mat(path: Path) -> None:
    rows = 250_000_000
    parts = _matrix(rows, head=True)
    packer = zlib.compressobj(9)
    total = len(parts) + 8 + 8 * rows
    packed = io.BytesIO()
    packed.write(packer.compress((14).to_bytes(4, "little") + total.to_bytes(4, "little") + parts))
    packed.write(packer.compress((9).to_bytes(4, "little") + (8 * rows).to_bytes(4, "little")))
    for _ in range(200):
        packed.write(packer.compress(bytes(8 * rows // 200)))
    packed.write(packer.flush())
    path.write_bytes(_mat_head() + _element(15, packed.getvalue()))


def _pretended_mat(path: Path) -> None:
    parts = _matrix(500_000_000, head=True) + _element(9, bytes(64), pretended=4_000_000_000)
    path.write_bytes(_mat_head() + _element(14, parts, pretended=4_100_000_000))


def _packed_mat73(path: Path) -> None:
    import h5py

    with h5py.File(path, "w", userblock_size=512) as file:
        for name in ("speed_rpm", "axial_load_N", "torque_Nm"):
            file.create_dataset(name, shape=(1, 2_000_000_000), dtype="f8", chunks=(1, 1_000_000), compression="gzip")
    with path.open("r+b") as raw:
        raw.write(b"MATLAB 7.3 MAT-file".ljust(512, b" "))


def _gzip_as_csv(path: Path) -> None:
    with gzip.open(path, "wb", compresslevel=9) as file:
        for _ in range(1000):
            file.write(bytes(1_000_000))


FILES: dict[str, tuple[str, Callable[[Path], None]]] = {
    "100,000 columns": ("csv", _columns),
    "10,000,000 rows": ("csv", _rows),
    "one line": ("csv", _line),
    "one cell": ("csv", _cell),
    "packed zeros": ("csv", _gzip_as_csv),
    "many cells": ("xlsx", _many_cells),
    "many texts": ("xlsx", _many_texts),
    "a far cell": ("xlsx", _far_cell),
    "a packed matrix": ("mat", _packed_mat),
    "a pretended size": ("mat", _pretended_mat),
    "a packed array": ("mat", _packed_mat73),
}
COMMANDS: dict[str, list[str]] = {
    "fit": ["fit", "{file}", "--case", "rig.toml", "--free", "boundary_friction_coefficient"],
    "duty": ["duty", "vertical_axis.toml", "--trace", "{file}"],
    "catalogue": ["catalogue", "list", "--rows", "{file}"],
}
KINDS = [(name, command) for name in FILES for command in COMMANDS]
COUNT = len(KINDS)


def run(tally: Tally, seed: int) -> None:
    """Try all files, one after the other: each command may take all the memory that is allowed."""
    import tempfile

    with tempfile.TemporaryDirectory() as place:
        workers.use(place)
        for number in range(tally.wanted):
            if not tally.left:
                break
            tally.add(attempt(seed, number, 1))


def _limited() -> None:
    """No command may take the memory of the machine; what it may is measured."""
    resource.setrlimit(resource.RLIMIT_AS, (4 * MOST_MEMORY, 4 * MOST_MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (int(2 * MOST_SECONDS), int(2 * MOST_SECONDS) + 5))


def attempt(_: int, number: int, __: int) -> Outcome:
    """One file, by one command."""
    order = number * 7 % COUNT  # a few of them are of all sorts
    name, command = KINDS[order]
    kind, make = FILES[name]
    path = workers.folder() / f"large.{kind}"
    make(path)
    words = [word.format(file=path) for word in COMMANDS[command]]
    said = workers.folder() / "said.txt"
    with said.open("wb") as errors:
        process = subprocess.Popen(
            [sys.executable, "-m", "ballscrew.faces.cli", *words],
            cwd=ROOT / "examples",
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=errors,
            preexec_fn=_limited,
        )
        begun = time.monotonic()
        _, status, used = os.wait4(process.pid, 0)
    process.returncode = code = os.waitstatus_to_exitcode(status)
    text = said.read_text(encoding="utf-8", errors="replace")
    path.unlink()
    seconds, memory = used.ru_utime + used.ru_stime, used.ru_maxrss * 1024
    wrong = workers.faults_of_command(code, text)
    if memory > MOST_MEMORY:
        wrong.append(f"{memory / 1e9:.1f} GB")
    if seconds > MOST_SECONDS:
        wrong.append(f"{seconds:.0f} s of processor in {time.monotonic() - begun:.0f} s")
    if wrong:
        return Outcome(wrong=[f"{name}, {command}: {'; '.join(wrong)}"])
    return Outcome(answered=int(code == 0), refused=int(code != 0))
