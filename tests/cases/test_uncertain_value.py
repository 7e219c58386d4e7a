"""Distributions in a case file: what may be written, what it means, and what is refused."""

import dataclasses
import math
import re

import pytest

import ballscrew as bs
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.case_files import case_file, uncertain_inputs
from ballscrew.cases.schema import case_schema
from ballscrew.engine.uncertainty.distributions import LogNormal, Normal, Triangular, Uniform
from ballscrew.engine.uncertainty.uncertain_value import UncertainValue, describe_distribution, parse_uncertain
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.laws.friction import LoadSharing

SCREW, OIL = fields_of(bs.BallScrew), fields_of(bs.Lubricant)
Z = 1.959963984540054
RPM = math.pi / 30


def normal(mean, half_width):
    return mean, Normal(mean, half_width / Z)


MEANT = [
    ("0.54 ± 0.01", SCREW["screw_conformity"], normal(0.54, 0.01)),
    ("0.54±0.01", SCREW["screw_conformity"], normal(0.54, 0.01)),
    ("0.54 +- 0.01", SCREW["screw_conformity"], normal(0.54, 0.01)),
    ("0.54 +/- 0.01", SCREW["screw_conformity"], normal(0.54, 0.01)),
    ("0.54 ± 2 %", SCREW["screw_conformity"], normal(0.54, 0.0108)),
    ("40 mm ± 0.1 mm", SCREW["pitch_circle_diameter"], normal(0.040, 1e-4)),
    ("40 ± 0.1 mm", SCREW["pitch_circle_diameter"], normal(0.040, 1e-4)),
    ("40 mm ± 100 um", SCREW["pitch_circle_diameter"], normal(0.040, 1e-4)),
    ("40 mm ± 0.1", SCREW["pitch_circle_diameter"], normal(0.040, 1e-4)),
    ("(40 ± 0.1) mm", SCREW["pitch_circle_diameter"], normal(0.040, 1e-4)),
    ("0.1 Pa s ± 20 %", OIL["viscosity"], normal(0.1, 0.02)),
    ("2.2e-8 ± 0.5e-8 1/Pa", OIL["pressure_viscosity_coefficient"], normal(2.2e-8, 0.5e-8)),
    ("40 degC ± 5 K", TEMPERATURE, normal(313.15, 5.0)),
    ("40 ± 5 degC", TEMPERATURE, normal(313.15, 5.0)),
    ("40 °C ± 5", TEMPERATURE, normal(313.15, 5.0)),
    ("313.15 ± 5 K", TEMPERATURE, normal(313.15, 5.0)),
    ("104 ± 9 degF", TEMPERATURE, normal(313.15, 5.0)),
    ("uniform(0.52, 0.56)", SCREW["screw_conformity"], (0.54, Uniform(0.52, 0.56))),
    ("Uniform (500, 700) rpm", fields_of(OperatingState)["screw_speed"], (600 * RPM, Uniform(500 * RPM, 700 * RPM))),
    ("uniform(500 rpm, 700 rpm)", fields_of(OperatingState)["screw_speed"], (600 * RPM, Uniform(500 * RPM, 700 * RPM))),
    ("uniform(20, 60 degC)", TEMPERATURE, (313.15, Uniform(293.15, 333.15))),
    ("normal(40 mm, 0.1 mm)", SCREW["pitch_circle_diameter"], (0.040, Normal(0.040, 1e-4))),
    ("normal(40, 0.1) mm", SCREW["pitch_circle_diameter"], (0.040, Normal(0.040, 1e-4))),
    ("normal(40 degC, 3 K)", TEMPERATURE, (313.15, Normal(313.15, 3.0))),
    ("normal(0.1 Pa s, 10 %)", OIL["viscosity"], (0.1, Normal(0.1, 0.01))),
    ("lognormal(0.12, 1.3)", fields_of(LoadSharing)["boundary_friction_coefficient"], (0.12, LogNormal(0.12, 1.3))),
    ("log-normal(0.1 Pa s, 1.3)", OIL["viscosity"], (0.1, LogNormal(0.1, 1.3))),
    ("triangular(35, 45, 55) deg", SCREW["contact_angle"],
     (math.pi / 4, Triangular(*(math.radians(x) for x in (35, 45, 55))))),
    ("40 mm js6", SCREW["pitch_circle_diameter"], (0.040, Uniform(0.040 - 8e-6, 0.040 + 8e-6))),
    ("40 mm IT7", SCREW["pitch_circle_diameter"], (0.040, Uniform(0.040 - 12.5e-6, 0.040 + 12.5e-6))),
    ("3.175 mm G10", SCREW["ball_diameter"], (3.175e-3, Uniform(3.175e-3 - 0.25e-6, 3.175e-3 + 0.25e-6))),
    ("5 mm class 5", SCREW["lead"], (5e-3, Uniform(5e-3 * (1 - 23e-6 / 0.3), 5e-3 * (1 + 23e-6 / 0.3)))),
    ("5 mm P3", SCREW["lead"], (5e-3, Uniform(5e-3 * (1 - 12e-6 / 0.3), 5e-3 * (1 + 12e-6 / 0.3)))),
]  # fmt: skip


@pytest.mark.parametrize(("text", "quantity", "meant"), MEANT, ids=[text for text, *_ in MEANT])
def test_what_is_written(text, quantity, meant):
    central, distribution = meant
    found = parse_uncertain(text, quantity)
    assert isinstance(found, UncertainValue), found
    assert found.central == pytest.approx(central, rel=1e-12)
    assert type(found.distribution) is type(distribution)
    given = {field.name: getattr(distribution, field.name) for field in dataclasses.fields(distribution)}
    for name in [name for name in given if math.isfinite(given[name])]:
        assert getattr(found.distribution, name) == pytest.approx(given[name], rel=1e-9), name


@pytest.mark.parametrize("text", ["0.54 ± 0", "0.54 +- 0.0", "0.54 ± 0 %"])
def test_plus_minus_nothing_is_exact(text):
    assert parse_uncertain(text, SCREW["screw_conformity"]) == UncertainValue(0.54, None, text)


@pytest.mark.parametrize(
    ("text", "name"), [("40 mm", "pitch_circle_diameter"), (0.54, "screw_conformity"), ("nonsense", "lead"),
                       ("2e-3 m", "lead"), (True, "lead"), (["40 mm"], "lead")]
)  # fmt: skip
def test_no_distribution(text, name):
    assert parse_uncertain(text, SCREW[name]) is None


def test_tails_are_cut_at_the_bounds():
    found = parse_uncertain("0.51 ± 0.02", SCREW["screw_conformity"]).distribution
    assert found.low == math.nextafter(0.5, 1)
    assert found.high == math.inf


REFUSED = [
    ("screw.screw_conformity=0.54 ± -0.01", "screw.screw_conformity: must have a number of 0 or more behind ±"),
    ("screw.screw_conformity=0.54 ± x", "screw.screw_conformity: is not a number (0.54 ± x)"),
    ("screw.screw_conformity=0.54 ± 0.01 mm", "screw.screw_conformity: takes no unit (0.54 ± 0.01 mm)"),
    ("screw.screw_conformity=0.5 ± 0.01", "screw.screw_conformity: must be above 0.5 (0.5 ± 0.01)"),
    ("screw.screw_conformity=0.5 ± 0.1 ± 0.1", "screw.screw_conformity: has more than one ±"),
    ("screw.lead=5 ± 1", "screw.lead: needs a unit (5 ± 1)"),
    ("screw.lead=5 mm ± 1 N", "screw.lead: wrong unit (5 mm ± 1 N)"),
    ("screw.lead=uniform(-5, 5 mm)", "screw.lead: must be positive (uniform(-5, 5 mm))"),
    ("screw.lead=uniform(5, 4 mm)", "screw.lead: high of the uniform distribution must be above low"),
    ("screw.lead=uniform(5 mm)", "screw.lead: must have 2 numbers in its brackets (uniform(5 mm)) · write uniform(low"),
    ("screw.lead=gauss(5 mm, 1 mm)", "screw.lead: unknown distribution (gauss(5 mm, 1 mm))"),
    ("screw.lead=lognormal(5 mm, 0.9)", "screw.lead: factor of the log-normal distribution must be above 1"),
    ("screw.lead=lognormal(5 mm, 2 mm)", "screw.lead: is not a plain number where it needs one"),
    ("screw.lead=5 mm class 4", "screw.lead: unknown lead class (5 mm class 4) · known: 0, 1, 3, 5, 7, 10"),
    ("screw.lead=5 mm h6", "screw.lead: unknown tolerance class (5 mm h6)"),
    ("screw.lead=5 mm js4", "screw.lead: has no standard tolerance (5 mm js4)"),
    ("screw.ball_diameter=3.175 mm G11", "screw.ball_diameter: unknown ball grade (3.175 mm G11)"),
    ("screw.loaded_balls=56 ± 1", "screw.loaded_balls: is a whole number, which has no distribution (56 ± 1)"),
    ("screw.starts=1 ± 0.5", "screw.starts: is a whole number, which has no distribution"),
    ("screw.ball_material.young_modulus=206 GPa ± 5 GPa", "screw.ball_material.young_modulus: takes no distribution"),
    ("screw.dynamic_load_rating=50 kN ± 1 kN", "screw.dynamic_load_rating: takes no distribution"),
    ("deviations.lead=1 um ± 0.1 um", "deviations.lead: takes no distribution"),
    ("lubricant.viscosity=0.1 Pa s ± 20 blobs", "lubricant.viscosity: unknown unit (0.1 Pa s ± 20 blobs)"),
    ("model.friction.decay=1.4 ± 1 mm", "model.friction.decay: takes no unit"),
]


@pytest.mark.parametrize(("setting", "expected"), REFUSED, ids=[setting for setting, _ in REFUSED])
def test_faults(setting, expected, example):
    with pytest.raises(InputError, match=re.escape(expected)) as caught:
        case_file.load(example, [setting])
    assert len(caught.value.faults) == 1


def test_a_case_keeps_central_values_and_distributions(example):
    settings = [
        "screw.screw_conformity=0.515 ± 0.005",
        "operation.axial_load=uniform(3, 5 kN)",
        "model.friction.decay=lognormal(1.42, 1.2)",
        "model.ball_to_ball_force=0.02 N ± 50 %",
        "screw.nut_conformity=0.515 ± 0",
    ]
    case = case_file.load(example, settings)
    assert case.screw.screw_conformity == 0.515
    assert case.operation.axial_load == 4000
    assert case.model.friction.decay == 1.42
    assert set(case.origins.uncertain) == {"screw_conformity", "axial_load", "friction.decay", "ball_to_ball_force"}
    assert case.origins.exact == {"nut_conformity"}
    everything = uncertain_inputs.all_of(case)
    assert "nut_conformity" not in everything
    assert everything["friction.decay"].given
    assert everything["friction.exponent"].source == "judgement"
    assert set(uncertain_inputs.all_of(case, only_given=True)) == set(case.origins.uncertain)


def test_a_temperature_beside_a_grade(example):
    oil = ["lubricant.temperature=40 degC ± 5 K"]
    drive = example.with_name("feed_drive.toml")
    case = case_file.load(drive, oil)
    assert case.origins.uncertain == {"temperature": Normal(313.15, 5 / Z)}
    assert "viscosity" not in uncertain_inputs.all_of(case)
    exact = case_file.load(drive, ["lubricant.temperature=40 degC ± 0 K"])
    assert uncertain_inputs.all_of(exact)["viscosity"].source == "ISO3448"
    with pytest.raises(InputError, match=r"lubricant.temperature: must be at least -20 degC"):
        case_file.load(drive, ["lubricant.temperature=-30 ± 5 degC"])


def test_a_named_calibration_brings_its_errors(example):
    case = case_file.load(example, ["model.calibration=rexroth-2006"], model="reference")
    found = uncertain_inputs.all_of(case, only_given=True)
    assert set(found) == {"friction.boundary_friction_coefficient", "ball_force.share_of_load"}
    assert {one.source for one in found.values()} == {"rexroth-2006"}
    assert "ball_to_ball_force" not in uncertain_inputs.all_of(case)


def test_a_case_without_distributions_has_none(example):
    case = case_file.load(example)
    assert case.origins.uncertain == {}
    assert case.origins.exact == frozenset()


def test_words():
    conformity, lead = SCREW["screw_conformity"], SCREW["lead"]
    assert describe_distribution(Normal(0.54, 0.01 / Z), conformity) == "0.54 ± 0.01"
    assert describe_distribution(Uniform(0.52, 0.56), conformity) == "0.52 to 0.56, uniform"
    assert describe_distribution(Uniform(9.9992e-3, 10.0008e-3), lead) == "9.9992 mm to 10.0008 mm, uniform"
    assert describe_distribution(Triangular(0.52, 0.53, 0.56), conformity) == "0.52 to 0.56, triangular about 0.53"
    assert describe_distribution(Normal(313.15, 5 / Z), TEMPERATURE) == "40 degC ± 5 K"
    assert (
        describe_distribution(LogNormal(0.1, math.exp(math.log(2) / Z)), conformity) == "0.05 to 0.2 (95 %), log-normal"
    )


def test_the_schema_allows_them():
    properties = case_schema.json_schema()["$defs"]["Screw"]["properties"]
    number, text = properties["screw_conformity"]["anyOf"]
    assert number["exclusiveMinimum"] == 0.5
    for written in ("0.54 ± 0.01", "0.54 +/- 0.01", "0.54 +- 2 %", "uniform(0.52, 0.56)"):
        assert re.search(text["pattern"], written)
        assert not isinstance(parse_uncertain(written, SCREW["screw_conformity"]), Fault | None)
    assert not re.search(text["pattern"], "0.54")
    assert properties["loaded_balls"]["type"] == "integer"
    assert properties["lead"]["type"] == "string"
