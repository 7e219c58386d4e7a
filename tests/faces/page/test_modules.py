"""The modules of the static page give the numbers of the model: node runs them, with the script of the page."""

import tomllib

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.cases.case_files import case_file
from ballscrew.cases.screw_tables.catalogue import case_text
from ballscrew.engine.evaluation.outputs import OPERATION, known_outputs
from ballscrew.engine.evaluation.structures import structure_key
from ballscrew.exports.wasm_modules import BALL, NUT_DIAMETER, KeptModule, module_of, module_of_oils, outputs_of
from ballscrew.faces.page import kinds, modules
from ballscrew.physics.sizing.catalogue import catalogue, printed_rows
from support.modules_in_node import Modules, start_of

pytestmark = [pytest.mark.slow, pytest.mark.implausible]

#: Structures of the tests: rigid, elastic and four contacts, of both ends of the models.
RIGID = (
    ("reference", "row"), ("reference", "double"), ("reference", "oversize-balls"), ("olaru2005", "double"),
)  # fmt: skip
ELASTIC = (("reference", "double+elastic"),)
POINTS = {"rigid": 2000, "elastic": 120}
#: Numbers that are not varied: whole ones.
WHOLE = ("starts", "loaded_balls")
#: Where the sum of torques cancels, a part is judged against the torque; differences of lengths and forces lose digits.
LOOSE = {"deflection": 1e-9, "remaining_preload": 1e-9, "backward_load": 1e-9}
AT_POINT = {"axial_load": 3000.0, "screw_speed": 50.0}


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    return Modules(tmp_path_factory.mktemp("modules"), [*RIGID, *ELASTIC])


def points_of(subject, count, seed=1):
    """All numbers within a tenth of their values, loads and speeds of both signs and none."""
    rng = np.random.default_rng(seed)
    found = {}
    for name in modules.inputs_of_module(subject):
        usual = AT_POINT[name] if name in AT_POINT else float(subject.value_of(name))
        found[name] = np.full(count, usual) if name in WHOLE else usual * (1 + 0.1 * rng.uniform(-1, 1, count))
    for name in OPERATION:
        found[name] *= rng.choice([-1.0, 0.0, 1.0], count, p=[0.45, 0.1, 0.45])
    return found


def compare(subject, points, found):
    result = subject.at({name: values[0] if name in WHOLE else values for name, values in points.items()})
    known = outputs_of(subject.nut)
    count = len(points["axial_load"])
    torque = np.abs(np.broadcast_to(result.screw_torque, count))
    assert {"screw_torque", "efficiency", "valid", "contribution_spin"} <= found.keys() == known.keys()
    for name, values in found.items():
        expected = np.broadcast_to(np.asarray(known[name].read(result), dtype=float), count)
        assert np.array_equal(np.isnan(expected), np.isnan(values)), name
        if known[name].dtype is bool:
            assert np.array_equal(expected, values), name
            continue
        if name in BALL and subject.nut.one_by_one:  # without load the most loaded ball is one of many
            values, expected = (np.where(points["axial_load"] == 0, 0.0, each) for each in (values, expected))
        if name == "residual":  # what is left of a balance is rounding
            assert np.nanmax(values) < 1e-9
            continue
        size = torque if name.startswith("contribution_") else np.abs(expected)
        # metres, where without load there are none, and a share of powers that are equal
        floor = {"deflection": 1e-18, "power_imbalance": 1e-12}.get(name, 0.0)
        with np.errstate(invalid="ignore"):
            near = (values == expected) | (np.abs(values - expected) <= LOOSE.get(name, 1e-12) * size + floor)
        assert np.all(near | np.isnan(expected)), (name, np.nanmax(np.abs(values - expected)))


@pytest.mark.parametrize("structure", RIGID, ids="/".join)
def test_a_module_gives_the_numbers_of_the_model(built, structure):
    subject = start_of(structure)
    points = points_of(subject, POINTS["rigid"])
    compare(subject, points, built.evaluate(structure, points))


@pytest.mark.parametrize("structure", ELASTIC, ids="/".join)
def test_a_module_gives_the_numbers_of_elastic_nuts(built, structure):
    subject = start_of(structure)
    points = points_of(subject, POINTS["elastic"])
    compare(subject, points, built.evaluate(structure, points, {NUT_DIAMETER: None}))


def test_a_curve_over_the_speed_solves_the_balls_once_and_is_that_of_the_model(built):
    structure = ELASTIC[0]
    subject = start_of(structure)
    one = {name: float(subject.value_of(name)) for name in modules.inputs_of_module(subject) if name not in OPERATION}
    one |= {"axial_load": 4000.0, NUT_DIAMETER: 0.07}
    points = {"screw_speed": np.linspace(-60.0, 60.0, 31)}
    found = built.evaluate(structure, points, one)
    nut = bs.DoubleNut(
        preload=one["preload"], bodies=bs.Bodies(nut_outer_diameter=0.07), losses=subject.screw.nut.losses
    )
    screw = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=nut)
    result = subject.model(screw, subject.lubricant, axial_load=4000.0, screw_speed=points["screw_speed"])
    for name in ("screw_torque", "deflection", "rigidity", "remaining_preload"):
        expected = np.broadcast_to(known_outputs(screw.nut)[name].read(result), 31)
        assert found[name] == pytest.approx(expected, rel=1e-9 if name in LOOSE else 1e-12), name


@pytest.mark.parametrize("structure", [("olaru2005", "row"), ("olaru2005", "double+elastic")], ids="/".join)
def test_two_builds_are_equal_and_a_kept_one_is_the_same(structure, tmp_path, monkeypatch):
    monkeypatch.setenv("BALLSCREW_CACHE", str(tmp_path))
    made = modules.module_of_structure(*structure)
    assert made == KeptModule.of(module_of(start_of(structure), varying=modules.varying_of(start_of(structure))))
    assert made == modules.module_of_structure(*structure)  # from the disk
    monkeypatch.setattr(modules, "module_of", None)  # not made again
    assert made == modules.module_of_structure(*structure)


def test_the_module_of_the_oils_is_the_same_bytes():
    assert module_of_oils() == module_of_oils()


@pytest.mark.parametrize("kind", kinds.KINDS)
def test_every_start_has_the_structure_that_its_module_was_made_of(kind):
    """One module serves all screws: what is no input is the same in all of them."""
    for model in kinds.MODELS:
        if (model, kind) not in kinds.structures():
            continue
        keys = set()
        for start in (kinds.PAPER, *list(kinds.start_tables())[::7]):
            subject = start_of((model, kind), start)
            names = modules.inputs_of_module(subject)
            outputs = known_outputs(subject.nut)
            keys.add(structure_key(subject, tuple(outputs), names))
        assert len(keys) == 1


def test_a_row_starts_as_the_case_that_catalogue_show_writes():
    """The served page starts from that case: one part number, one torque."""
    for name, row in ((row.name, row) for row in printed_rows()):
        case = tomllib.loads(case_text(row))
        begun = kinds.Kind(case.get("nut", {}).get("type", ""), elastic="bodies" in case)
        kind = next(one for one, known in kinds.KINDS.items() if known == begun)
        torques = [torque_of(one) for one in (kinds.tables_of(name, kinds.MODELS[0], kind), case)]
        assert torques[0] == pytest.approx(torques[1], rel=1e-12), name


def torque_of(tables):
    case = case_file.build(tables, rows=catalogue())
    point = {name: getattr(case.operation, name) for name in OPERATION}
    return float(case.model(case.screw, case.lubricant, **point).screw_torque)


def test_the_oils_follow_their_temperature(built):
    temperatures = np.linspace(283.15, 363.15, 9)
    for grade in ("ISO VG 32", "ISO VG 100", "FVA 3"):
        found = built.oil(grade, temperatures)
        for place, temperature in enumerate(temperatures):
            oil = bs.Lubricant.from_grade(grade, temperature)
            for name, values in found.items():
                assert values[place] == pytest.approx(float(getattr(oil, name)), rel=1e-13), name
