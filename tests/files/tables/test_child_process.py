"""Work in a process of its own, and files that end the process that reads them."""

import io
import os
import signal
import struct
import time
import zipfile

import pytest
import xlsxwriter

from ballscrew.basis import child_process
from ballscrew.basis.child_process import ChildError
from ballscrew.files.tables import sheets, workbooks
from support.log_texts import lines_of

limits = pytest.mark.skipif(os.name == "nt", reason="needs limits of POSIX")


def test_results_and_errors_come_back():
    assert child_process.call(divmod, 7, 2) == (3, 1)
    with pytest.raises(ChildError, match="modulo by zero"):
        child_process.call(divmod, 7, 0)


@limits
@pytest.mark.parametrize(
    ("call", "words"),
    [
        ((bytearray, 4 << 30), "needs more than 1 GiB of memory"),
        ((signal.raise_signal, signal.SIGSEGV), "crashes its reader: SIGSEGV"),
        ((os.abort,), "crashes its reader: SIGABRT"),
        ((os._exit, 3), "crashes its reader: exit code 3"),
    ],
)
def test_limits_and_crashes_are_said(call, words):
    with pytest.raises(ChildError, match=words):
        child_process.call(*call, memory=1 << 30)


def test_time_is_limited():
    with pytest.raises(ChildError, match=r"takes longer than 0\.2 s"):
        child_process.call(time.sleep, 600, seconds=0.2)


@pytest.mark.slow
@limits
@pytest.mark.parametrize(
    ("cells", "reason"),
    [
        (["XFD1048576"], "it has a cell in row 1048576, column 16384: 17,179,869,184 cells, 20,000,000 at most"),
        (["A1", "XFD1048576"], "needs more than 2 GiB of memory"),
    ],
)
def test_a_cell_far_out_does_not_end_the_program(cells, reason, tmp_path):
    """All cells between these two would take 549 GB, for which the reader asks."""
    path = tmp_path / "far.xlsx"
    with xlsxwriter.Workbook(path) as book:
        sheet = book.add_worksheet()
        for cell in cells:
            sheet.write(cell, 1)
    (line,) = lines_of(sheets.records, path, bool)
    remedy = "save the table alone, without cells far from it and without a password, as XLSX or CSV"
    assert line == f"{path}: is no spreadsheet that can be read ({reason}) · {remedy}"


def test_an_archive_that_unpacks_to_too_much_is_refused():
    """By what its directory says, before anything is unpacked; what the directory hides meets the limit of memory."""
    packed = io.BytesIO()
    with xlsxwriter.Workbook(packed) as book:
        book.add_worksheet().write("A1", 1)
    data = bytearray(packed.getvalue())
    with zipfile.ZipFile(packed) as archive:
        begin = archive.start_dir
    struct.pack_into("<L", data, begin + 24, 3 << 30)  # the unpacked size of the first part
    with pytest.raises(ValueError, match=r"it unpacks to 3\.0 GiB, 1 GiB at most"):
        workbooks.rows_of(bytes(data))
