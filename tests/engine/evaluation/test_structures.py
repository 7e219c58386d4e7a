"""Recordings of which all numbers are inputs, against the model itself at the same numbers (properties)."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.compiler.tracing.tape import CannotRecordError
from ballscrew.engine.evaluation.outputs import OPERATION, known_outputs
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.evaluation.structures import (
    inputs_of_structure,
    numbers_alone,
    outputs_of_structure,
    recorded_structure,
    structure_key,
)

OIL = bs.Lubricant.from_grade("ISO VG 100", 313.15)
SEALS = {"seals": bs.Seals(seal_torque=0.2)}
ROW = "rexroth-40x10x6-6-double"
NUTS = {
    "single": bs.SingleNut(),
    "single with seals": bs.SingleNut(losses=SEALS),
    "double": bs.DoubleNut(preload=4326.0, losses=SEALS),
    "offset lead": bs.OffsetLeadNut(preload=4326.0),
    "oversize": bs.OversizeBallNut(preload=2000.0),
}
MODELS = {
    "olaru2005": bs.FrictionModel.olaru2005,
    "corrected": bs.FrictionModel.corrected,
    "reference": bs.FrictionModel.reference,
}
CASES = [(nut, model) for nut in NUTS for model in MODELS if nut != "oversize" or model == "reference"]
#: Differences of large numbers, which are seen against the largest value of all points.
DIFFERENCES = frozenset({"deflection", "remaining_preload", "lift_off_load", "residual"})


def case_of(nut, model):
    screw = bs.catalogue()[ROW].screw(nut=NUTS[nut])
    return Configuration(MODELS[model](), screw, OIL)


def points_of(subject, names, count=64, seed=4):
    """All numbers varied by 10 %, loads and speeds in four quadrants, and zeros of both."""
    random = np.random.default_rng(seed)
    found = {
        name: float(subject.value_of(name)) * random.uniform(0.9, 1.1, count) for name in names if name not in OPERATION
    }
    for name in {"loaded_balls", "starts"} & found.keys():
        found[name] = np.round(found[name])
    found["axial_load"] = random.uniform(-20e3, 20e3, count)
    found["screw_speed"] = random.uniform(-100.0, 100.0, count)
    found["axial_load"][:4] = 0.0, -0.0, 0.0, 3e3
    found["screw_speed"][:4] = 10.0, 10.0, 0.0, 0.0
    return {name: found[name] for name in names}


def assert_same(found, expected):
    """To 1e-12, of differences and of parts of the torque by the largest of all points; truths and NaN exactly."""
    torque = np.nanmax(np.abs(expected["screw_torque"]))
    for name, values in expected.items():
        values = np.broadcast_to(values, found[name].shape)
        assert np.array_equal(np.isfinite(found[name]), np.isfinite(values)), name
        finite = np.isfinite(values)
        if found[name].dtype == bool:
            assert np.array_equal(found[name], values), name
            continue
        assert np.array_equal(found[name][~finite], values[~finite], equal_nan=True), name
        size = np.abs(values[finite])
        if name in DIFFERENCES:
            size = np.maximum(size, np.max(size, initial=0.0))
        if name.startswith("contribution_") or name.endswith("_torque"):
            size = np.maximum(size, torque)
        assert np.all(np.abs(found[name][finite] - values[finite]) <= 1e-12 * size), name


def played(program, points, wanted):
    count = len(points["axial_load"])
    found = {name: np.empty(count, dtype=output.dtype) for name, output in wanted.items()}
    with np.errstate(all="ignore"):
        program.interpreter.run(list(points.values()), found)
    return found


def by_model(subject, points, wanted):
    with np.errstate(all="ignore"):
        result = subject.at(points)
        return {name: np.asarray(output.read(result)) for name, output in wanted.items()}


@pytest.mark.parametrize(("nut", "model"), CASES)
@pytest.mark.implausible
def test_one_recording_serves_all_numbers(nut, model):
    subject = case_of(nut, model)
    names, wanted = inputs_of_structure(subject), outputs_of_structure(subject, ["screw_torque"])
    points = points_of(subject, names)
    program = recorded_structure(numbers_alone(subject), wanted, names)
    assert_same(played(program, points, wanted), by_model(numbers_alone(subject), points, wanted))


def test_numbers_are_inputs_and_materials_among_them():
    names = inputs_of_structure(case_of("double", "reference"))
    assert names[:2] == OPERATION
    assert {"preload", "losses.seals.seal_torque", "viscosity", "lead", "nut_material.poisson_ratio"} <= set(names)
    assert len(set(names)) == len(names)
    assert "temperature" not in names  # which sets the viscosity, an input itself


@pytest.mark.parametrize("nut", ["single with seals", "double", "oversize"])
def test_other_numbers_have_the_same_structure(nut):
    subject = case_of(nut, "reference")
    names = inputs_of_structure(subject)
    at = points_of(subject, names, 8)
    other = subject.changed({name: values[-1] for name, values in at.items() if name not in OPERATION})
    outputs = tuple(known_outputs(subject.nut))
    assert inputs_of_structure(other) == names
    assert structure_key(other, outputs, names) == structure_key(subject, outputs, names)


def test_what_is_no_number_is_another_structure():
    subject = case_of("double", "reference")
    found = {structure_key(subject, ("screw_torque",), inputs_of_structure(subject))}
    nuts = [bs.DoubleNut(preload=4326.0), bs.OffsetLeadNut(preload=4326.0, losses=SEALS)]
    nuts += [
        bs.DoubleNut(preload=4326.0, losses=SEALS, bodies=bs.Bodies()),
        bs.SingleNut(losses=SEALS, spacer_balls=True),
    ]
    others = [dataclasses.replace(subject, screw=dataclasses.replace(subject.screw, nut=nut)) for nut in nuts]
    others += [dataclasses.replace(subject, model=bs.FrictionModel.corrected())]
    found |= {structure_key(other, ("screw_torque",), inputs_of_structure(other)) for other in others}
    assert len(found) == 1 + len(others)


def test_an_exponent_is_a_constant_unless_it_varies():
    subject = case_of("single", "olaru2005")
    exponents = [name for name in subject.inputs if name.endswith("exponent")]
    if not exponents:
        pytest.skip("the model has no exponent among its inputs")
    names = inputs_of_structure(subject)
    assert not set(exponents) & set(names)
    assert exponents[0] in inputs_of_structure(subject, exponents[:1])
    changed = subject.changed({exponents[0]: 1.1 * subject.value_of(exponents[0])})
    assert structure_key(changed, (), names) != structure_key(subject, (), names)


def test_a_law_from_outside_has_no_key():
    model = dataclasses.replace(bs.FrictionModel.reference(), friction=lambda *_: 0.1)
    subject = dataclasses.replace(case_of("single", "reference"), model=model)
    assert structure_key(subject, (), inputs_of_structure(subject)) is None


def test_a_nut_whose_balls_differ_and_that_was_set_at_rest_has_none():
    nut = bs.DoubleNut(preload=4326.0, bodies=bs.Bodies(), set_at_rest=True)
    subject = Configuration(bs.FrictionModel.reference(), bs.catalogue()[ROW].screw(nut=nut), OIL)
    with pytest.raises(CannotRecordError, match="set at rest"):
        recorded_structure(subject, outputs_of_structure(subject, ["screw_torque"]), inputs_of_structure(subject))
