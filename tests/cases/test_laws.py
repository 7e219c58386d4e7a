"""Laws by name in a case file: each of them, with and without coefficients, and what is refused."""

import copy
import dataclasses
import json
import math
import re
import tomllib

import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.descriptions import inputs
from ballscrew.cases.schema import case_schema
from ballscrew.engine.evaluation.comparison import same_law
from ballscrew.physics.friction.model import LAWS, presets
from ballscrew.physics.laws import ball_chain, friction, rolling
from ballscrew.physics.solvers.ellipse_slip import ellipse_slip
from ballscrew.physics.solvers.slip import curvature_slip

EVERY_LAW = [(slot, name) for slot, known in LAWS.items() for name in known]
WITH_COEFFICIENTS = [(slot, name) for slot, name in EVERY_LAW if case_schema.coefficients_of(slot, name)]


@pytest.fixture
def tables(example):
    return tomllib.loads(example.read_text(encoding="utf-8"))


def model_of(tables, /, **model):
    changed = copy.deepcopy(tables)
    changed["model"] = {"name": "reference", **model}
    return case_file.build(changed).model


def faults_of(tables, /, **model):
    with pytest.raises(InputError) as caught:
        model_of(tables, **model)
    return caught.value.lines()


def torque(case):
    point = {name: getattr(case.operation, name) for name in ("axial_load", "screw_speed")}
    return float(case.model(case.screw, case.lubricant, **point).screw_torque)


@pytest.mark.parametrize("slot", LAWS)
def test_laws_of_all_models_have_names(slot):
    for model in presets().values():
        assert case_schema.name_of_law(slot, getattr(model, slot)) in LAWS[slot]


def test_every_slot_with_a_choice_is_there():
    slots = {field.name for field in dataclasses.fields(bs.FrictionModel)} - set(
        case_schema.fields_of(bs.FrictionModel)
    )
    assert set(LAWS) == slots - {"name", "contact_load"}


@pytest.mark.parametrize(("slot", "name"), EVERY_LAW)
def test_each_law_by_name(slot, name, tables):
    """A name is the law with its own coefficients, alone or as ``law`` of a table, and it works."""
    law, known = getattr(model_of(tables, **{slot: name}), slot), LAWS[slot][name]
    assert law is known or (type(law) is known and vars(law) == vars(known()))
    assert type(getattr(model_of(tables, **{slot: {"law": name}}), slot)) is type(law)
    assert case_schema.name_of_law(slot, law) == name
    tables["model"] = {"name": "reference", slot: name}
    assert math.isfinite(torque(case_file.build(tables)))


@pytest.mark.parametrize(("slot", "name"), WITH_COEFFICIENTS)
def test_each_coefficient(slot, name, tables):
    """All coefficients of a law can be set, in their units, and come back with the inputs."""
    known = case_schema.coefficients_of(slot, name)
    defaults = LAWS[slot][name]()
    values = {field: 0.9 * getattr(defaults, field) for field in known}
    written = {f: values[f] if known[f].unit == "1" else f"{values[f]} {known[f].unit}" for f in known}
    law = getattr(model_of(tables, **{slot: {"law": name, **written}}), slot)
    assert vars(law) == pytest.approx(values)
    tables["model"] = {"name": "reference", slot: {"law": name, **written}}
    shown = inputs(case_file.build(tables))["model"][slot]
    assert shown.pop("law") == name
    assert shown == pytest.approx(values)


@pytest.mark.parametrize("name", presets())
def test_a_coefficient_alone_belongs_to_the_law_of_the_model(name, tables):
    tables["model"] = {"name": name, "friction": {"boundary_friction_coefficient": 0.15}, "film": {}}
    model = case_file.build(tables).model
    present = presets()[name]
    assert type(model.friction) is type(present.friction)
    assert model.friction.boundary_friction_coefficient == 0.15
    assert model.friction.decay == present.friction.decay
    assert same_law(model.film, present.film)
    assert model.label == f"{name}, changed: friction"


def test_a_name_brings_its_own_coefficients(tables):
    tables["model"] = {"name": "olaru2005", "film": "hamrock-dowson"}
    assert case_file.build(tables).model.film.speed_exponent == 0.68
    model = model_of(tables, friction={"law": "load-sharing", "decay": 1.9})
    assert model.friction.decay == 1.9
    assert model.friction.boundary_friction_coefficient == friction.LoadSharing().boundary_friction_coefficient


def test_all_in_one(tables):
    model = model_of(
        tables,
        inlet={"inlet_film_ratio": 3},
        full_film="eyring",
        rolling="houpert",
        elastic_resistance={"law": "hysteresis", "loss_factor": 0.01},
        ball_force={"law": "proportional"},
        slip="curvature",
        pure_rolling_offset=0.3,
    )
    assert model.inlet.inlet_film_ratio == 3
    assert isinstance(model.full_film, friction.EyringTraction)
    assert model.rolling is rolling.houpert_rolling
    assert model.elastic_resistance.loss_factor == 0.01
    assert isinstance(model.ball_force, ball_chain.ProportionalBallForce)
    assert model.slip is curvature_slip
    assert model.pure_rolling_offset == 0.3


FAULTS = {
    "wrong name": ({"rolling": "houprt"}, 'model.rolling: unknown law (houprt) · did you mean "houpert"?'),
    "wrong name in a table": ({"friction": {"law": "balance"}}, "model.friction.law: unknown law (balance) · "),
    "a number": (
        {"friction": 3},
        'model.friction: must be the name of a law, or a table (3) · write friction = "zhou-hoeprich" or ',
    ),
    "a list": ({"slip": ["line"]}, "model.slip: must be the name of a law, or a table (['line'])"),
    "true": ({"frame": True}, "model.frame: must be the name of a law, or a table (True)"),
    "no text": ({"friction": {"law": 3}}, "model.friction.law: unknown law (3) · known: zhou-hoeprich"),
    "coefficient of another law": (
        {"friction": {"law": "balan", "decay": 1.9}},
        'model.friction.decay: no coefficient of the law "balan" · it belongs to friction.law = "zhou-hoeprich" or '
        '"load-sharing" or "run-in"; balan has boundary_friction_coefficient, full_film_friction_coefficient',
    ),
    "misspelt coefficient": (
        {"friction": {"decai": 1.9}},
        'model.friction.decai: no coefficient of the law "run-in" · did you mean "decay"? run-in has ',
    ),
    "law without coefficients": (
        {"hertz": {"k": 3}},
        'model.hertz.k: no coefficient of the law "exact" · exact has no coefficients',
    ),
    "no film, no coefficient": (
        {"full_film": {"eyring_stress": "4 MPa"}},
        'no coefficient of the law "none" · it belongs to full_film.law = "eyring"; none has no coefficients',
    ),
    "out of bounds": ({"friction": {"decay": -1}}, "model.friction.decay: must not be negative (-1)"),
    "no unit": (
        {"friction": {"law": "greenwood-tripp", "asperity_radius": 10}},
        'model.friction.asperity_radius: needs a unit (10) · write "10 um"',
    ),
    "offset with spin": ({"pure_rolling_offset": 0.34}, "model.pure_rolling_offset: can only be imposed where"),
    "unknown slot": ({"frictoin": "balan"}, 'model.frictoin: unknown key · did you mean "friction"?'),
}  # fmt: skip


@pytest.mark.parametrize("name", FAULTS)
def test_faults(name, tables):
    model, expected = FAULTS[name]
    lines = faults_of(tables, **model)
    assert len(lines) == 1
    assert lines[0].startswith(expected) or expected in lines[0], lines


def test_all_faults_at_once(tables):
    lines = faults_of(tables, name="referenc", rolling="houprt", friction={"law": "balan", "decay": 1}, slip=3)
    assert len(lines) == 4
    tables["lubricant"]["viscosity"] = "1 N"
    assert len(faults_of(tables, rolling="houprt")) == 2


def test_the_papers_offset_goes_with_its_slip_law(tables):
    tables["model"] = {"name": "olaru2005", "slip": "ellipse"}
    model = case_file.build(tables).model
    assert model.slip is ellipse_slip
    assert model.pure_rolling_offset is None
    assert model.label == "olaru2005, changed: slip, pure_rolling_offset"
    tables["model"]["pure_rolling_offset"] = 0.34
    with pytest.raises(InputError, match=r"pure_rolling_offset: can only be imposed"):
        case_file.build(tables)


# -- on the command line --------------------------------------------------------------------------


def model_inputs(process):
    assert process.returncode == 0, process.stderr
    return json.loads(process.stdout)["inputs"]["model"]


def test_a_coefficient_for_a_law_that_the_file_names(example, tmp_path, ballscrew):
    case = tmp_path / "case.toml"
    case.write_text(example.read_text(encoding="utf-8") + '\nfriction = "balan"\n', encoding="utf-8")
    found = model_inputs(
        ballscrew("run", case, "--json", "--set", "model.friction.full_film_friction_coefficient=0.05")
    )
    assert found["friction"]["law"] == "balan"
    assert found["friction"]["full_film_friction_coefficient"] == 0.05


# -- JSON Schema ----------------------------------------------------------------------------------


def accepts(rule, value):
    """As much of JSON Schema as the schema of a slot uses."""
    if "anyOf" in rule:
        return any(accepts(inner, value) for inner in rule["anyOf"])
    if "const" in rule:
        return value == rule["const"]
    if "enum" in rule:
        return value in rule["enum"]
    if rule["type"] == "object":
        known = rule["properties"]
        return isinstance(value, dict) and all(k in known and accepts(known[k], v) for k, v in value.items())
    kinds = {"string": str, "number": (int, float), "integer": int}
    if not isinstance(value, kinds[rule["type"]]):
        return False
    if rule["type"] == "string":
        return re.search(rule.get("pattern", ""), value) is not None
    return rule.get("minimum", -math.inf) <= value if rule["type"] == "number" else True


@pytest.fixture(scope="module")
def slots():
    document = json.loads(json.dumps(case_schema.json_schema()))
    properties = document["$defs"]["Model"]["properties"]
    assert set(LAWS) < set(properties)
    return properties


def test_schema_names_the_default_model(slots):
    assert slots["name"]["default"] == "reference"
    assert slots["name"]["enum"] == [*presets(), "constant-efficiency"]


@pytest.mark.parametrize(("slot", "name"), EVERY_LAW)
def test_schema_knows_every_law_and_coefficient(slot, name, slots):
    rule, known = slots[slot], case_schema.coefficients_of(slot, name)
    written = {f: 0.5 if q.unit == "1" else f"1 {q.shown_in}" for f, q in known.items()}
    assert accepts(rule, name)
    assert accepts(rule, {"law": name, **written})
    assert accepts(rule, written)
    assert not accepts(rule, {"law": name, "nonsense": 1})
    assert not accepts(rule, "nonsense")
    assert not accepts(rule, 3)


def test_schema_refuses_what_the_file_refuses(slots):
    assert not accepts(slots["friction"], {"law": "balan", "decay": 1.9})
    assert not accepts(slots["friction"], {"decay": -1})
    assert accepts(slots["friction"], {"decay": 1.9})
