"""Tables with a row for each test: headings, dates, units, both directions; and what is refused by its row."""

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.files.torque_logs.torque_series import read

HOUR, DAY = 3600.0, 86400.0


def table(tmp_path, text):
    path = tmp_path / "table.csv"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_german_table_with_dates(tmp_path):
    text = "Datum;Reibmoment [Ncm];Temperatur [°C];Drehzahl [1/min]\n31.01.2024;41,5;20;100\n29.02.2024;40,9;22,5;100\n"
    found = read(table(tmp_path, text))
    assert found.torque == pytest.approx([0.415, 0.409])
    assert found.temperature == pytest.approx([293.15, 295.65])
    assert found.screw_speed == pytest.approx([100 * np.pi / 30] * 2)
    assert found.time == pytest.approx([0, 29 * DAY])
    assert (found.per, found.labels) == ("s", ("31.01.2024", "29.02.2024"))
    assert found.source is not None


def test_hours_both_directions_and_a_nut(tmp_path):
    text = "hours,nut,torque up [N m],torque down [N m]\n0,A1,0.5,-0.3\n35,A1,0.48,-0.28\n"
    found = read(table(tmp_path, text))
    assert found.torque == pytest.approx([0.4, 0.38])
    assert found.time == pytest.approx([0, 35 * HOUR])
    assert found.labels == ("0 hours", "35 hours")
    assert found.nuts == ["A1", "A1"]


def test_a_heading_by_hand_numbers_and_cells_with_units(tmp_path):
    text = "test,upper,lower\n1,0.41 N m,0.5 N m\n2,405 N mm,0.5 N m\n"
    found = read(table(tmp_path, text), {"torque": "upper"})
    assert found.torque == pytest.approx([0.41, 0.405])
    assert found.per == "test"
    assert any("columns not used" in note for note in found.notes)


def test_missing_temperatures_are_nan(tmp_path):
    found = read(table(tmp_path, "test,torque [N m],temperature [degC]\n1,0.4,20\n2,0.4,\n"))
    assert np.isnan(found.temperature).tolist() == [False, True]


def test_faulty_rows_are_left_out_on_request(tmp_path):
    path = table(tmp_path, "test,torque [N m]\n1,0.4\n2,broken\n3,0.41\n")
    with pytest.raises(bs.InputError, match=r'table\.csv row 3, column "torque \[N m\]"'):
        read(path)
    found = read(path, keep_going=True)
    assert found.torque == pytest.approx([0.4, 0.41])
    assert any("1 of 3 rows left out" in note for note in found.notes)


REFUSED = {
    "back": ("date,torque [N m]\n2024-05-01,0.4\n2024-04-01,0.4\n", "table.csv row 3, time: runs back from 2024-05-01"),
    "no date": ("date,torque [N m]\n2024-05-01,0.4\nspring,0.4\n", 'table.csv row 3, column "date": is no date'),
    "unit": ("test,torque [N m]\n1,0.41\n2,0.4\n3,405\n", "table.csv row 4, torque: is 1000 times the tests before"),
    "nuts": ("test,nut,torque [N m]\n1,A,0.4\n2,B,0.4\n", "table.csv row 3, nut: is another than A (B)"),
    "sign": ("test,torque [N m]\n1,0.4\n2,-0.4\n", "torque"),
    "no unit": ("test,torque\n1,0.4\n2,0.4\n", "needs a unit"),
    "log": ("test,torque [N m],speed [rpm]\n1,0.4,100\n2,0.4,-100\n", "speed"),
    "both": ("test,torque [N m],up [N m],down [N m]\n1,0.4,0.4,0.4\n", "table.csv: has two kinds of torques"),
    "no time": ("test,torque [N m]\n1,0.4\n,0.4\n", 'column "test": is empty'),
}


@pytest.mark.parametrize(("text", "words"), REFUSED.values(), ids=REFUSED)
def test_refused_by_its_row(tmp_path, text, words):
    with pytest.raises(bs.InputError) as error:
        read(table(tmp_path, text))
    assert words in str(error.value)


def test_an_unknown_column_by_hand_is_refused(tmp_path):
    with pytest.raises(bs.InputError, match="--column drag: unknown column"):
        read(table(tmp_path, "test,torque [N m]\n1,0.4\n"), {"drag": "torque"})
