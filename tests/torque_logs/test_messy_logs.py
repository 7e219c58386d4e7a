"""Headings and cells as loggers and spreadsheets leave them."""

import pytest

from ballscrew.torque_logs.torque_log import TorqueLog
from support.log_texts import HEADINGS, ROWS, in_display_units


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
    assert clean.left_out == {"a value is missing": 2}
    assert [row[0] for row in in_display_units(clean)] == [100, 110, -120, 105]
