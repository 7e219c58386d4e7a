"""Files of logs: cut off, damaged, long, from spreadsheets and from MATLAB."""

import codecs
import datetime
import hashlib
import sys
import tracemalloc

import h5py
import numpy as np
import openpyxl
import pytest
import scipy.io

from ballscrew.files.torque_logs import reading
from support.log_texts import EXPECTED, HEADINGS, ROWS, in_display_units, lines_of

# -- files that are bad ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", "is empty · give a table"),
        ("\n \n# nothing\n", "is empty · give a table"),
        (b"\x00\x01\x02" * 99, "is neither text nor a spreadsheet · save it as CSV"),
        (b"\x00" * 99, "is empty · give a table"),
        (b"PK\x03\x04 no zip", "is no spreadsheet that can be read"),
        (b"MATLAB 5.0 MAT-file and junk", "is no file of MATLAB that can be read"),
        (b"MATLAB 7.3 MAT-file and junk", "is no file of MATLAB that can be read"),
        ("a,b\n1,2\n", 'has no heading that is known ("a", "b") · begin with a row like: axial_load [N], '),
        (HEADINGS, "log.csv: has no rows below its headings · give one row for each measurement"),
        (HEADINGS + "\n,,,,\n", "log.csv: has no rows below its headings"),
    ],
)  # fmt: skip
def test_faults_of_a_file(text, expected, read):
    (line,) = lines_of(read, text)
    assert expected in line


def test_temperatures_in_degrees_under_a_heading_in_kelvin(read):
    text = "torque [N m],speed [rpm],load [N],temperature [K]\n" + "1,100,1000,31.5\n" * 3
    (line,) = lines_of(read, text)
    assert line == (
        'log.csv column "temperature [K]": must be in kelvin (31.5) · write [degC] in its heading if these are °C'
    )
    assert read(text.replace("31.5", "304.65")).temperature == pytest.approx(304.65)


def test_files_that_are_not_there(tmp_path):
    assert "none.csv: does not exist · give the path" in lines_of(reading.read, tmp_path / "none.csv")[0]
    assert "cannot be read (Is a directory)" in lines_of(reading.read, tmp_path)[0]
    assert "cannot be read" in lines_of(reading.read, "a\0b")[0]


@pytest.mark.parametrize("end", ["3,100", "3,100,1000", "3,100,1000,0.", "3,100,1000,-", "3,10", "3,100,1000,1e"])
def test_a_last_row_that_is_cut_off(end, read):
    log = read(HEADINGS + ROWS + end)
    assert in_display_units(log.cleaned()) == EXPECTED
    assert sum(log.cleaned().left_out.values()) == 1
    # the same in the middle of a file is a fault or a gap
    if end.endswith("1e"):
        assert "row 5" in lines_of(read, HEADINGS + ROWS + end + "\n")[0]


def test_a_last_row_without_an_end_is_a_row(read):
    assert in_display_units(read(HEADINGS + ROWS.rstrip())) == EXPECTED


def test_empty_bytes_at_the_end_of_a_file(read):
    """A machine that is switched off leaves them behind."""
    log = read(HEADINGS + ROWS + "\0" * 3000)
    assert in_display_units(log) == EXPECTED
    assert log.notes == ("the file ends with 3000 empty bytes, which are left out",)
    long = HEADINGS + ROWS * 60_000
    log = read(long + "3,100" + "\0" * 3000)
    assert len(log) == 180_000
    assert log.left_out == {"the file ends within the row": 1}
    (line,) = lines_of(read, long + "\0" * 3000 + "1,2,3")
    assert line == f"log.csv from byte {len(long)}: is no text · the file is damaged: cut it off there"


def test_quotes_that_do_not_end(read):
    assert "cannot be split into cells" in lines_of(read, '"n [rpm]",F [N],M [N m]\n1,2,"3\n')[0]
    log = read("n [rpm],F [N],M [N m],note\n1,2,3,\n" * 1 + "1,2,3,\n" * 6000 + '1,2,3,"pipe\n1,2,3,\n')
    assert len(log) == 6003


# -- long files -----------------------------------------------------------------------------------


def long_text(rows):
    time = np.arange(rows) * 0.001
    speed = np.round(1000 * np.sin(time), 2)
    lines = [
        f"{t:.3f},{n},{1000 + k % 700},{0.5 * np.sign(n):.4f},{30 + k % 9}"
        for k, (t, n) in enumerate(zip(time, speed, strict=True))
    ]
    return HEADINGS + "\n".join(lines) + "\n"


@pytest.mark.slow
def test_pieces_make_no_difference(read):
    text = long_text(20_000)
    whole = read(text)
    for chunk in (997, 20_000):
        found = read(text, chunk=chunk)
        for name, values in whole.columns.items():
            np.testing.assert_array_equal(getattr(found, name), values)
    thinned = [read(text, held=3000, chunk=chunk) for chunk in (500, 4000, 50_000)]
    for log in thinned:
        assert len(log) == 3000
        assert log.rows == 20_000
        assert log.left_out == {"thinned": 17_000}
        np.testing.assert_array_equal(log.torque, whole.torque[log.line - 2])
        np.testing.assert_array_equal(log.line, thinned[0].line)
        np.testing.assert_array_equal(log.motion.slope, thinned[0].motion.slope)
        assert log.cleaned().line.tolist() == thinned[0].cleaned().line.tolist()


@pytest.mark.slow
def test_memory_does_not_grow_with_the_rows(read, tmp_path):
    peaks = []
    for rows in (60_000, 240_000):
        path = tmp_path / f"{rows}.csv"
        path.write_text(
            long_text(60_000) + long_text(60_000).partition("\n")[2] * (rows // 60_000 - 1), encoding="utf-8"
        )
        tracemalloc.start()
        try:
            assert reading.read(path, held=5000, chunk=5000).rows == rows
            peaks.append(tracemalloc.get_traced_memory()[1])
        finally:
            tracemalloc.stop()
    assert peaks[1] < 1.1 * peaks[0]


def test_progress_and_hash(read):
    text, told = long_text(20_000), []
    log = read(text, done=lambda read, size: told.append((read, size)), chunk=5000)
    size = len(text.encode())
    assert told[-1] == (size, size)
    assert all(total == size for _, total in told)
    assert [read for read, _ in told] == sorted(read for read, _ in told)
    assert log.source[1] == hashlib.sha256(text.encode()).hexdigest()


# -- spreadsheets and MATLAB ----------------------------------------------------------------------


def test_a_spreadsheet(tmp_path):
    path = tmp_path / "log.xlsx"
    book = openpyxl.Workbook()
    sheet = book.active
    sheet.append(["Test 5"])
    sheet.append(["time", "n [rpm]", "F", "Reibmoment", "T"])
    sheet.append([None, None, "kN", "Nm", "°C"])
    begin = datetime.datetime(2024, 5, 1, 12)
    sheet.append([begin, 100, 1, 0.5, 30])
    sheet.append([begin + datetime.timedelta(seconds=1), 110, 1.1, "600 N mm", 30.5])
    sheet.append([begin + datetime.timedelta(seconds=2), -120, 1.2, -0.7, 31])
    sheet.append([begin + datetime.timedelta(seconds=3), 1, None, 1, 1])
    book.save(path)
    log = reading.read(path, {"temperature": "T"})
    assert in_display_units(log.cleaned()) == EXPECTED
    assert log.time == pytest.approx([0, 1, 2, 3], abs=1e-5)
    assert log.line.tolist() == [4, 5, 6, 7]
    assert log.source == ("log.xlsx", hashlib.sha256(path.read_bytes()).hexdigest())
    sheet.append([None, True, 1, 1, 1])
    book.save(path)
    (line,) = lines_of(reading.read, path, {"temperature": "T"})
    assert line.startswith('log.xlsx row 8, column "n [rpm]": is not a number (True)')


@pytest.mark.parametrize("above", [[], [[0, 100, 1000, 0.5, 30]]])
def test_a_spreadsheet_without_rows_below_its_headings(above, tmp_path):
    path = tmp_path / "log.xlsx"
    book = openpyxl.Workbook()
    for row in [*above, HEADINGS.strip().split(",")]:
        book.active.append(row)
    book.save(path)
    assert lines_of(reading.read, path) == [
        "log.xlsx: has no rows below its headings · give one row for each measurement"
    ]


def test_times_of_a_spreadsheet(tmp_path):
    path = tmp_path / "log.xlsx"
    book = openpyxl.Workbook()
    book.active.append(["Uhrzeit", "n [rpm]", "F [N]", "M [N m]"])
    for second in range(3):
        book.active.append([datetime.time(12, 0, second), 1, 2, 3])
    book.save(path)
    assert reading.read(path).time == pytest.approx([0, 1, 2], abs=1e-5)


COLUMNS_OF_MATLAB = {
    "t_s": np.arange(3.0), "speed_rpm": np.array([100.0, 110, -120]), "axial_load_N": np.array([1000, 1100, 1200]),
    "friction_torque_N_m": np.array([0.5, 0.6, -0.7]), "T_oil_degC": np.array([30, 30.5, 31]),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("struct", [False, True])
@pytest.mark.parametrize("shape", [(-1,), (-1, 1), (1, -1)])
def test_a_file_of_matlab(tmp_path, struct, shape):
    path = tmp_path / "log.mat"
    columns = {name: values.reshape(shape) for name, values in COLUMNS_OF_MATLAB.items()}
    scipy.io.savemat(path, {"log": columns} if struct else {**columns, "note": "a test"})
    log = reading.read(path)
    assert in_display_units(log) == EXPECTED
    assert log.time.tolist() == [0, 1, 2]
    assert log.line.tolist() == [1, 2, 3]
    assert log.source[1] == hashlib.sha256(path.read_bytes()).hexdigest()


def save_new(path, columns, struct=False):
    """As MATLAB saves files since version 7.3: HDF5 behind a header of its own."""
    with h5py.File(path, "w", userblock_size=512) as file:
        group = file.create_group("log") if struct else file
        for name, values in columns.items():
            group[name] = np.asarray(values).reshape(1, -1)
        file.create_group("#refs#")
        if not struct:
            file["note"] = np.frombuffer(b"a test", np.uint8).astype(np.uint16).reshape(1, -1)
            file["note"].attrs["MATLAB_class"] = np.bytes_("char")
    with path.open("r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file".ljust(128))


@pytest.mark.parametrize("struct", [False, True])
def test_a_newer_file_of_matlab(tmp_path, struct):
    path = tmp_path / "log.mat"
    save_new(path, COLUMNS_OF_MATLAB, struct)
    assert in_display_units(reading.read(path)) == EXPECTED


def test_a_damaged_file_of_matlab_does_not_end_the_program(tmp_path):
    """One wrong byte, the type of the elements of a cell array: SciPy's reader crashes (SIGSEGV)."""
    path = tmp_path / "log.mat"
    scipy.io.savemat(path, {"t": np.arange(3.0), "x": [1, 2, 3], "c": np.array(["ab", "c"], dtype=object)})
    data = bytearray(path.read_bytes())
    data[384] = 14
    path.write_bytes(data)
    (line,) = lines_of(reading.read, path)
    assert line.startswith(f"{path}: is no file of MATLAB that can be read (")
    assert line.endswith("save the columns as arrays of one length, or one struct of them, with save(..., '-v7')")


@pytest.mark.slow
def test_faults_of_files_of_matlab(tmp_path, monkeypatch):
    path = tmp_path / "log.mat"
    scipy.io.savemat(path, {**COLUMNS_OF_MATLAB, "speed_rpm": np.arange(4.0)})
    assert lines_of(reading.read, path)[0].startswith("log.mat: has columns of different lengths (t_s 3, speed_rpm 4,")
    scipy.io.savemat(path, {"a": "text"})
    assert "has no columns of numbers (a) · save the columns as arrays of one length" in lines_of(reading.read, path)[0]
    unitless = {name.removesuffix("_N"): values for name, values in COLUMNS_OF_MATLAB.items()}
    scipy.io.savemat(path, unitless)
    assert lines_of(reading.read, path) == [
        'log.mat column "axial_load": needs a unit · write "axial_load [N]", or give --column '
        'axial_load="axial_load [N]"'
    ]
    assert in_display_units(reading.read(path, {"axial_load": "axial_load [N]"})) == EXPECTED
    save_new(path, COLUMNS_OF_MATLAB)
    monkeypatch.setitem(sys.modules, "h5py", None)
    assert lines_of(reading.read, path) == [
        f"{path}: needs h5py · pip install \"ballscrew[data]\", or save it with save(..., '-v7')"
    ]


def test_text_with_a_mark_at_its_beginning(read):
    assert in_display_units(read(codecs.BOM_UTF8 + (HEADINGS + ROWS).encode())) == EXPECTED


def test_a_log_can_be_fitted_to(read):
    """From the file to rows of steady motion."""
    clean = read(long_text(30_000), chunk=4000).cleaned(most=5000)
    assert clean.is_clean
    assert len(clean) == 5000
    assert sum(clean.left_out.values()) == 25_000
    assert clean.source[0] == "log.csv"
