"""Headings and cells as loggers and spreadsheets leave them."""

import numpy as np
import pytest

from ballscrew.files.torque_logs.torque_log import TorqueLog
from support.log_texts import HEADINGS, ROWS, in_display_units, lines_of


@pytest.mark.parametrize(
    "heading", ["Temp. Mutter [°C]", "Temperatur Mutter (°C)", "Mutter-Temp. [degC]", "Temp. Öl [°C]", "temp nut [°C]"]
)
def test_a_temperature_beside_its_place(heading, read):
    log = read(HEADINGS.replace("temperature [degC]", heading) + ROWS)
    assert log.temperature == pytest.approx([303.15, 303.65, 304.15])


def test_a_temperature_that_is_not_known_is_asked_for(read):
    log = read(HEADINGS.replace("temperature [degC]", "Fühler 3 [°C]") + ROWS)
    assert log.temperature is None
    assert 'if "Fühler 3 [°C]" is the temperature of the oil, give --column temperature="Fühler 3 [°C]"' in log.notes
    log = read(HEADINGS.replace("temperature [degC]", "Fühler 3 [°C]") + ROWS, columns={"temperature": "Fühler 3"})
    assert log.temperature == pytest.approx([303.15, 303.65, 304.15])


@pytest.mark.parametrize("error", ["#WERT!", "#VALUE!", "#N/A", "#NV", "#DIV/0!", "#NAME?", "#BEZUG!", "#ÜBERLAUF!"])
def test_errors_of_a_spreadsheet_are_left_out_and_counted(error, read):
    rows = ROWS + f"3,{error},1000,0.5,30\n{error},100,1000,{error},30\n4,105,1000,0.5,30\n"
    log = read(HEADINGS + rows)
    assert f"3 cells hold errors of a spreadsheet ({error}): they count as missing" in log.notes
    clean = log.cleaned()
    assert isinstance(clean, TorqueLog)
    assert clean.left_out == {"a value is missing or impossible": 2}
    assert [row[0] for row in in_display_units(clean)] == [100, 110, -120, 105]


@pytest.mark.parametrize(
    ("row", "words"),
    [
        ("3,100,1000,9.9e37,30", 'row 5, column "friction torque [N m]": must be at most 1e+06 N m (9.9e+37)'),
        ("3,100,-1e300,0.5,30", 'row 5, column "axial load [N]": must be at least -1e+12 N (-1e+300)'),
        ("3,1e300,1000,0.5,30", 'row 5, column "speed [rpm]": must be at most'),
        ("1e300,100,1000,0.5,30", 'row 5, column "time [s]": must be at most 1e+18 s (1e+300)'),
    ],
)
def test_a_number_that_no_machine_has_is_a_fault(row, words, read):
    text = HEADINGS + ROWS + f"{row}\n4,105,1000,0.5,30\n"
    (line,) = lines_of(read, text)
    assert words in line
    assert line.endswith("check the number and its unit")
    log = read(text, keep_going=True)
    assert [round(speed) for speed, *_ in in_display_units(log)] == [100, 110, -120, 105]
    assert log.left_out == {"a value cannot be read": 1}


def test_an_impossible_number_of_an_array_is_left_out_and_counted():
    log = TorqueLog.of(
        {"axial_load": np.full(5, 1e3), "screw_speed": [9.0, 10, 11, 12, 13], "torque": [0.5, 0.5, 1e300, 0.6, 0.5]}
    )
    assert log.cleaned().left_out == {"a value is missing or impossible": 1}
