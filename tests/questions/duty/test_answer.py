"""The answer of a duty: declared once, and the same on every face."""

import pytest

from ballscrew.basis.output.sheet import Table
from ballscrew.cases.case_files import case_file
from ballscrew.questions.duty import compute, parts
from ballscrew.questions.duty.compute import IF_ANY, NUMBERS
from ballscrew.questions.duty.sheet import sheet
from ballscrew.questions.shared import declared
from support.commands import ROOT

EXAMPLES = ROOT / "examples"


def report_of(*settings, example="vertical_axis.toml"):
    tables = case_file.override(case_file.read(EXAMPLES / example), list(settings))
    return compute.duty(case_file.build(tables, None, EXAMPLES, moves=True))


@pytest.fixture(scope="module")
def report():
    return report_of()


def test_a_sheet_leaves_out_what_there_is_none_of(report):
    """The cycle ends where it began: of what is stored only rounding is left. Its guides rub with their seals alone."""
    tables = {block.name: [row[0] for row in block.rows] for block in sheet(report).of_kind(Table)}
    none = {name for name in IF_ANY if abs(report.numbers[name]) < 1e-6}
    assert none == {"energy_stored"}
    meanings = {name: quantity.info.meaning for name, quantity in NUMBERS.items()}
    assert tables["cycle"] == [meaning for name, meaning in meanings.items() if name not in none]
    (causes,) = (rows for rows in tables.values() if "gravity" in rows)
    assert {"gravity", "process", "guide seals", "sum"} <= set(causes)
    assert not {"guides", "transmission"} & set(causes)
    phases = report.phases
    assert tables["phases"] == [phase.name for phase in phases]
    assert sum(phase.duration for phase in phases) == pytest.approx(report.numbers["cycle_time"])
    given = report.numbers["energy_drawn"] - report.numbers["energy_returned"]
    assert sum(phase.energy for phase in phases) == pytest.approx(given)


def test_numbers_of_a_full_bath_are_those_of_the_flooded_cycle():
    report = report_of("lubricant.temperature=-5 degC")
    flooded = report.duty.flooded
    assert report.full_bath.energy_lost == pytest.approx(flooded.energy_lost, rel=1e-12)
    assert report.full_bath.torque_peak == pytest.approx(flooded.torque_peak, rel=1e-12)
    assert report.full_bath.energy_lost > 2 * report.numbers["energy_lost"]


@pytest.mark.parametrize(("kind", "unit"), [(parts.PositionSmoothing, "m"), (parts.SpeedSmoothing, "m/s")])
def test_the_noise_of_a_recorded_motion_has_the_unit_of_what_was_recorded(kind, unit):
    found = kind(100, 3, 1e-6, 0.1, 2.0)
    assert declared.units(found) == {"noise": unit, "acceleration_noise": "m/s^2", "torque_rms_unsmoothed": "N m"}
    assert list(declared.document(found)) == [
        "samples",
        "half_width",
        "noise",
        "acceleration_noise",
        "torque_rms_unsmoothed",
    ]
