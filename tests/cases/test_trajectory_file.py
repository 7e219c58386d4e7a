"""Files of recorded motions: headings as people write them, and faults with their row and remedy."""

import re

import numpy as np
import pytest

from ballscrew.axis.motion.trajectory_file import read_trajectory
from ballscrew.basis.errors import InputError

TIME = np.arange(60) * 0.01
POSITION = 0.1 * (1 - np.cos(2 * np.pi * TIME))


def rows():
    return [[f"{t:.2f}", f"{1e3 * x:.6f}"] for t, x in zip(TIME, POSITION, strict=True)]


@pytest.fixture
def written(tmp_path):
    """A file of headings and rows."""

    def write(cells=None, headings="time [s],position [mm]", separator=","):
        path = tmp_path / "run.csv"
        lines = [headings, *(separator.join(row) for row in (rows() if cells is None else cells))]
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return path

    return write


def refused(path):
    with pytest.raises(InputError) as found:
        read_trajectory(path)
    return str(found.value)


@pytest.mark.parametrize(
    "headings", ["time [s],position [mm]", "t (s),x (mm)", "Zeit [s],Istposition [mm]", "time_s,pos_mm"]
)
def test_headings(written, headings):
    found = read_trajectory(written(headings=headings))
    assert found.time == pytest.approx(TIME, abs=1e-12)
    assert found.position == pytest.approx(POSITION, abs=1e-9)
    assert found.source == "run.csv"


def test_german_numbers_with_force_and_temperature(written):
    cells = [[*(cell.replace(".", ",") for cell in row), "1,5", "40"] for row in rows()]
    found = read_trajectory(written(cells, "Zeit [s];Weg [mm];Kraft [kN];Temperatur [°C]", ";"))
    assert found.position == pytest.approx(POSITION, abs=1e-9)
    assert found.force == pytest.approx(1500.0)
    assert found.temperature == pytest.approx(313.15)


def test_a_speed_in_place_of_a_position(written):
    cells = [[row[0], "6"] for row in rows()]
    found = read_trajectory(written(cells, "time [s],v [m/min]"))
    assert found.position is None
    assert found.speed == pytest.approx(0.1)


def changed(**changes):
    cells = rows()
    for place, row in changes.items():
        cells[int(place.removeprefix("row"))] = row
    return cells


@pytest.mark.parametrize(
    ("cells", "line"),
    [
        (changed(row20=["0.01", "1"]),
         "run.csv row 22: time runs back (0.01 s after 0.19 s) · sort the rows, or cut the record there"),
        ([*rows()[:20], *rows()[50:]],
         "run.csv row 22: comes after a gap (0.31 s, usually 0.01 s) · cut the record there, "
         "or fill in the rows that are missing"),
        (changed(row20=["0.20", ""]), "run.csv row 22: has no position · fill it in, or cut it out"),
        (changed(row20=["0.20", "abc"]),
         'run.csv row 22, column "position [mm]": is not a number (abc) · write a number in mm'),
        ([*rows()[:30], *([t, f"{float(x) / 1e3:.9f}"] for t, x in rows()[30:])],
         "run.csv row 32: has another unit than the rows above (1/953.9 of the one before) · write all in one unit"),
        (rows()[:2], "run.csv: has too few rows below its headings · give one for each sample"),
    ],
    ids=["back", "gap", "missing", "word", "unit", "few"],
)  # fmt: skip
def test_faults_name_the_row(written, cells, line):
    assert refused(written(cells)) == line


@pytest.mark.parametrize("factor", [1000.0, 25.4, 60.0, 10.0, 100.0, 1 / 25.4, 1 / 60])
def test_units_that_are_mixed_up_are_known_by_their_ratio(written, factor):
    """Metres, inches, minutes and centimetres among other rows: the position hardly changes at the end of a stroke."""
    cells = [*rows()[:50], *([t, f"{float(x) * factor:.9f}"] for t, x in rows()[50:])]
    said = re.fullmatch(
        r"run.csv row 52: has another unit than the rows above \((1/)?([\d.]+) .*", refused(written(cells))
    )
    assert float(said[2]) == pytest.approx(max(factor, 1 / factor), rel=5e-3)
    assert bool(said[1]) == (factor < 1)


@pytest.mark.parametrize("factor", [1.5, 7.0, 51.0, 2000.0])
def test_a_jump_by_no_ratio_of_units_is_no_fault(written, factor):
    cells = [*rows()[:50], *([t, f"{float(x) * factor:.9f}"] for t, x in rows()[50:])]
    assert read_trajectory(written(cells)).position[-1] == pytest.approx(factor * POSITION[-1], rel=1e-4)


def test_more_rows_than_are_taken(written, monkeypatch):
    monkeypatch.setattr("ballscrew.axis.motion.trajectory_file.MOST_ROWS", 60)
    assert read_trajectory(written()).time.size == 60
    monkeypatch.setattr("ballscrew.axis.motion.trajectory_file.MOST_ROWS", 59)
    assert refused(written()) == "run.csv: has more than 59 rows · cut it to a few cycles"


def test_faults_of_headings(written):
    assert 'run.csv column "position": needs a unit · write "position [mm]"' in refused(
        written(headings="time [s],position")
    )
    assert "neither a column" in refused(written([[row[0]] for row in rows()], "time [s]"))
    assert 'has no column "time [s]"' in refused(written(headings="clock,position [mm]"))


def test_a_file_that_is_not_there(tmp_path):
    assert "none.csv: does not exist" in refused(tmp_path / "none.csv")
