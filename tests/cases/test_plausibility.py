"""Plausibility: what no ball screw has is computed with a warning, in Python, in files and in tables alike."""

import dataclasses
import math
import tomllib
import warnings

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.basis import units
from ballscrew.basis.quantities import fields_of, quantities_of
from ballscrew.basis.usual_ranges import IMPLAUSIBLE
from ballscrew.cases.case_files import case_file
from ballscrew.physics.components.oil_grades import grades
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import presets
from ballscrew.physics.friction.validity import implausible, named_parts
from ballscrew.physics.laws.rolling import Hysteresis
from ballscrew.physics.sizing.catalogue import catalogue
from ballscrew.questions.validate import compute
from support.commands import ROOT

SCREW = catalogue()["rexroth-40x10x6-6-double"].screw()
OIL = bs.Lubricant.from_grade("ISO VG 100")
MODEL = bs.FrictionModel.reference()
POINT = {"axial_load": 5e3, "screw_speed": 60.0}
FRICTION = MODEL.friction

with warnings.catch_warnings(action="ignore", category=bs.ImplausibleInput):  # it is what the tests ask about
    OF_206_PASCALS = bs.Material(206.0)
#: Inputs that were computed without a word: name of the input, and how to give it.
STRANGE = {
    "screw.pitch_circle_diameter": {"screw": {"pitch_circle_diameter": 40.0}},
    "screw.nut_roughness": {"screw": {"nut_roughness": 0.3}},
    "lubricant.viscosity": {"oil": {"viscosity": 1e-9}},
    "model.friction.boundary_friction_coefficient": {
        "model": {"friction": dataclasses.replace(FRICTION, boundary_friction_coefficient=12.0)}
    },
    "model.ball_friction_coefficient": {"model": {"ball_friction_coefficient": 10.0}},
    "screw.contact_angle": {"screw": {"contact_angle": math.radians(89.9)}},
    "screw.screw_conformity": {"screw": {"screw_conformity": 1.0}},
    "lubricant.thermal_conductivity": {"oil": {"thermal_conductivity": 140.0}},
    "screw.lead_angle": {"screw": {"lead": 0.254}},
    "screw.ball_material.young_modulus": {"screw": {"ball_material": OF_206_PASCALS}},
    "screw.loaded_turns": {"screw": {"loaded_balls": 1900}},
    "operation.screw_speed": {"point": {"screw_speed": 6e4}},
}


def friction(screw=(), oil=(), model=(), point=(), nut=None):
    parts = [dataclasses.replace(part, **dict(new)) for part, new in ((MODEL, model), (SCREW, screw), (OIL, oil))]
    if nut is not None:
        parts[1] = dataclasses.replace(parts[1], nut=nut)
    return parts[0](*parts[1:], **POINT | dict(point))


def subjects(records):
    return [record.subject for record in records if record.id == IMPLAUSIBLE]


@pytest.mark.implausible
@pytest.mark.parametrize("name", STRANGE)
def test_what_no_screw_has_is_named(name):
    r = friction(**STRANGE[name])
    assert name in subjects(r.warning_records)
    record = next(record for record in r.warning_records if record.subject == name)
    section, _, field = name.rpartition(".")
    quantity = next(
        quantities_of(type(part))[field]
        for place, part in r.parts.items()
        if place == section and field in quantities_of(type(part))
    )
    low, high = quantity.info.usual
    assert record.limit == (high if record.value > high else low)
    assert not low <= record.value <= high
    warning = next(text for text in r.warnings if quantity.info.meaning in text)
    assert warning.startswith("implausible: ")
    assert units.shown(record.value, quantity) in warning
    assert units.shown(high, quantity) in warning


def test_nothing_is_said_of_a_usual_screw():
    assert friction().warnings == []
    assert friction(nut=bs.DoubleNut(3000.0)).warnings == []


def test_of_arrays_the_element_farthest_out():
    r = friction(screw={"pitch_circle_diameter": np.array([0.04, 4.0, 40.0])})
    record = next(r for r in r.warning_records if r.subject == "screw.pitch_circle_diameter")
    assert (record.value, record.unit) == (40.0, "m")


@pytest.mark.implausible
def test_a_whole_nut_has_its_own_parts():
    r = friction(nut=bs.DoubleNut(3e8, spacing=20.0))
    assert {"nut.preload", "nut.spacing"} <= set(subjects(r.warning_records))
    assert subjects(friction(oil={"viscosity": 1e-9}, nut=bs.SingleNut()).warning_records) == ["lubricant.viscosity"]


def test_datasets_state_it():
    dataset = bs.sweep(MODEL, SCREW, OIL, lead=[0.01, 0.254], nut_roughness=0.3, **POINT)
    assert dataset.attrs["warnings"].count("implausible: ") == 2
    assert "lead angle" in dataset.attrs["warnings"]
    assert "warnings" not in bs.sweep(MODEL, SCREW, OIL, **POINT).attrs
    samples = bs.monte_carlo(
        MODEL, SCREW, OIL, distributions={"viscosity": bs.Uniform(1e-9, 2e-9)}, samples=16, **POINT
    )
    assert samples.attrs["warnings"].startswith("implausible: dynamic viscosity")


#: Families whose number of thread starts is not printed: their lead is of two or more.
STARTS_NOT_PRINTED = ("thk-wgf", "thk-wtf", "thk-cnf")


def test_no_catalogue_row_is_implausible():
    for row in catalogue().values():
        if row.refusal:
            continue
        parts = named_parts(MODEL, row.screw(), OIL)
        expected = [["screw.groove_pitch"], []] if row.name.startswith(STARTS_NOT_PRINTED) else [[]]
        assert subjects(implausible(parts)) in expected, row.name


@pytest.mark.slow
def test_no_validation_row_is_implausible():
    for entries, _ in compute.evaluate(compute.request(model="corrected")):
        for point in (point for entry in entries for point in entry.points):
            assert subjects(point.warnings) == [], point.name


@pytest.mark.parametrize("path", sorted((ROOT / "examples").glob("*.toml")), ids=lambda path: path.name)
def test_no_example_is_implausible(path):
    assert case_file.load(path).implausible() == []


def test_no_default_and_no_preset_is_implausible():
    for model in presets().values():
        assert subjects(implausible(named_parts(model, SCREW, OIL))) == []
    for grade in grades():
        for temperature in (253.15, 423.15):
            oil = bs.Lubricant.from_grade(grade, temperature)
            assert subjects(implausible(named_parts(MODEL, SCREW, oil))) == []


def test_the_usual_range_lies_within_the_bounds():
    for part in (BallScrew, bs.Lubricant, bs.Material, OperatingState, Hysteresis, bs.DoubleNut, type(FRICTION)):
        for quantity in fields_of(part).values():
            low, high = quantity.info.usual or (0.0, 1.0)
            bounds = [quantity.info.above, quantity.info.at_least, quantity.info.below, quantity.info.at_most]
            floors, ceilings = ([b for b in pair if b is not None] for pair in (bounds[:2], bounds[2:]))
            assert low < high
            assert all(low >= floor for floor in floors)
            assert all(high <= ceiling for ceiling in ceilings)


CASE = (ROOT / "examples" / "feed_drive.toml").read_text(encoding="utf-8")


@pytest.fixture
def strange_case(tmp_path):
    case = tomllib.loads(CASE)
    assert case["screw"]["lead"] == "10 mm"
    path = tmp_path / "case.toml"
    path.write_text(CASE.replace('lead = "10 mm"', 'lead = "10 in"'), encoding="utf-8")
    return path


def test_a_sweep_on_the_command_line(ballscrew, strange_case):
    found = ballscrew("sweep", strange_case, "--vary", "axial_load=1, 2 kN")
    assert "warning  implausible: lead angle" in found.stderr
