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
from support.structures import CASES, OIL, ROW, SEALS, assert_same, by_model, case_of, points_of


def played(program, points, wanted):
    count = len(points["axial_load"])
    found = {name: np.empty(count, dtype=output.dtype) for name, output in wanted.items()}
    with np.errstate(all="ignore"):
        program.interpreter.run(list(points.values()), found)
    return found


@pytest.mark.slow
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
    subject = case_of("single", "reference")
    exponents = [name for name in subject.inputs if name.endswith("exponent")]
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
