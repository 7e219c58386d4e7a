"""The speed of the nut in place of that of the screw: one turn is one lead."""

import math

import pytest

from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.cases.schema.case_schema import json_schema
from ballscrew.engine.uncertainty.distributions import Normal
from ballscrew.engine.uncertainty.uncertain_value import NORMAL_95
from ballscrew.questions.run.compute import run
from ballscrew.questions.sweep import table
from ballscrew.questions.sweep.compute import plan, sweep

RPM = 2 * math.pi / 60


def built(speed, lead="10 mm"):
    return case_file.build(
        {
            "screw": {"catalogue": "rexroth-40x10x6-6-double", "lead": lead},
            "lubricant": {"grade": "ISO VG 100", "temperature": "40 degC"},
            "operation": {"axial_load": "2 kN", "screw_speed": speed},
        }
    )


@pytest.mark.parametrize(
    ("speed", "rpm"),
    [
        ("12 m/min", 1200), ("100 mm/s", 600), ("-1,5 m/min", -150), ("50 in/min", 127), ("2400 rpm", 2400),
        ("600 r/min", 600),
    ],
)  # fmt: skip
def test_a_speed_goes_by_its_unit(speed, rpm):
    assert float(built(speed).operation.screw_speed) == pytest.approx(rpm * RPM)


def test_it_follows_the_lead_and_so_does_its_spread():
    case = built("12 ± 1 m/min", lead="20 mm")
    assert float(case.operation.screw_speed) == pytest.approx(600 * RPM)
    spread = case.origins.uncertain["screw_speed"]
    assert isinstance(spread, Normal)
    assert (spread.mean, spread.deviation) == pytest.approx((600 * RPM, 50 * RPM / NORMAL_95))


@pytest.mark.parametrize("speed", ["12 m/min ± 5 %", "12 m/min +/- 5 %", "12 m/min ± 0,6 m/min", "(12 ± 0.6) m/min"])
def test_its_spread_may_be_written_after_its_unit(speed):
    spread = built(speed, lead="20 mm").origins.uncertain["screw_speed"]
    assert isinstance(spread, Normal)
    assert (spread.mean, spread.deviation) == pytest.approx((600 * RPM, 30 * RPM / NORMAL_95))


@pytest.mark.parametrize(
    ("speed", "problem"),
    [("12 m", "wrong unit"), ("12 Nm/s", "unknown unit"), ("x m/min", "is not a number with a unit")],
)
def test_what_is_no_speed_is_said_once(speed, problem):
    with pytest.raises(InputError) as found:
        built(speed)
    assert [(fault.where, fault.parts[0]) for fault in found.value.faults] == [("operation.screw_speed", problem)]


def test_a_sweep_over_the_lead_keeps_it(tmp_path):
    case = built("12 m/min", lead="20 mm")
    planned = plan(case, ["lead=20, 40 mm"], ["screw_torque"], None)
    swept = sweep(case, planned)
    alone = [float(run(built("12 m/min", lead=lead)).friction.screw_torque) for lead in ("20 mm", "40 mm")]
    assert swept.screw_torque.to_numpy() == pytest.approx(alone, rel=1e-9)
    assert swept.screw_speed.to_numpy() / RPM == pytest.approx([600, 300])
    table.write(swept, planned, tmp_path / "sweep.xlsx")  # a file of a speed for each lead
    turning = built("600 rpm", lead="20 mm")
    assert sweep(turning, plan(turning, ["lead=20, 40 mm"], [], None)).screw_speed / RPM == pytest.approx(600)


def test_a_faulty_lead_is_the_only_fault():
    with pytest.raises(InputError) as found:
        built("12 m/min", lead="-5 mm")
    assert [fault.where for fault in found.value.faults] == ["screw.lead"]


def test_the_schema_says_so():
    operation = json_schema()["$defs"]["Operation"]
    assert operation["properties"]["screw_speed"]["x-through-lead"] == "m/s"
    assert operation["properties"]["screw_speed"]["x-si-unit"] == "rad/s"
    assert operation["required"] == ["axial_load", "screw_speed"]
