"""Nuts whose balls differ, recorded and compiled, against the model itself on NumPy arrays (properties)."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
import xarray as xr

import ballscrew as bs
from ballscrew.engine.evaluation import by_ball
from ballscrew.engine.evaluation.by_ball import ENOUGH_TO_RECORD
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.engine.evaluation.recordings import KNOWN, Structures
from ballscrew.physics.friction.loaded_balls import loads_of
from support.structures import forget_structures

OIL = bs.Lubricant.from_grade("ISO VG 100", 313.15)
OLARU, REFERENCE = bs.FrictionModel.olaru2005(), bs.FrictionModel.reference()
BODIES, OPPOSITE = bs.Bodies(), bs.Bodies(same_side=False)
SCATTER = bs.Scatter(1e-6, 1e-6, 3)
NUTS = {
    "double": bs.DoubleNut(preload=4326.0, bodies=BODIES),
    "held on opposite sides, scattered": bs.DoubleNut(preload=4326.0, bodies=OPPOSITE, deviations=SCATTER),
    "scattered": bs.DoubleNut(preload=4326.0, deviations=SCATTER),
    "single with seals": bs.SingleNut(bodies=BODIES, losses={"seals": bs.Seals(seal_torque=0.2)}),
    "oversize": bs.OversizeBallNut(preload=2000.0, bodies=BODIES, deviations=SCATTER),
}
#: Loads of both signs, without load, and past lift-off; speeds of both signs, and rest.
LOADS = np.array([0.0, -0.0, 3e3, -3e3, 12e3, -20e3, 60e3, -60e3, 1.0, 5e3, 7.0, 2e3])
SPEEDS = np.array([10.0, 10.0, 50.0, -50.0, 100.0, -3.0, 30.0, 20.0, 0.0, 0.0, 5.0, -100.0])
POINTS = {"axial_load": xr.DataArray(LOADS, dims="point"), "screw_speed": xr.DataArray(SPEEDS, dims="point")}
#: Differences of large numbers: rounding is seen against the largest value of all points.
DIFFERENCES = frozenset({"deflection", "residual", "remaining_preload"})


def screw_with(nut: bs.Nut, balls: int = 12) -> bs.BallScrew:
    screw = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=nut)
    return dataclasses.replace(screw, loaded_balls=balls)


def plan_of(nut, model=OLARU, outputs=None, points=POINTS):
    return Plan.of(Configuration(model, screw_with(nut), OIL), outputs, points)


def filled(plan, engine, **how):
    evaluation = Evaluation.of(plan, engine)
    results = evaluation.empty(plan.total)
    evaluation.fill(results, slice(0, plan.total), **how)
    return results


def assert_same(found, expected):
    """To 1e-12, masks and what is not finite exactly."""
    for name, values in expected.items():
        finite = np.isfinite(values)
        assert np.array_equal(found[name][~finite], values[~finite], equal_nan=True), name
        size = np.abs(values[finite])
        if name in DIFFERENCES:
            size = np.maximum(size, 1.0 if name == "residual" else np.max(size, initial=0.0))
        assert np.all(np.abs(1.0 * found[name][finite] - values[finite]) <= 1e-12 * size), name


@pytest.mark.slow
@pytest.mark.compiles
@pytest.mark.parametrize("engine", ["numpy", "compiled"])
@pytest.mark.parametrize("kind", [kind for kind, nut in NUTS.items() if nut.contacts_per_ball == 2])
def test_all_outputs_are_those_of_the_model(kind, engine):
    plan = plan_of(NUTS[kind], outputs=list(known_outputs(NUTS[kind])))
    found = filled(plan, engine)
    assert Evaluation.of(plan, engine).engine == engine
    assert_same(found, filled(plan, "model"))


@pytest.mark.compiles
@pytest.mark.parametrize(
    ("kind", "engine"),
    [("double", "numpy"), *(pytest.param(*both, marks=pytest.mark.long) for both in (("double", "compiled"),
     ("oversize", "numpy"), ("oversize", "compiled")))],
)  # fmt: skip
def test_the_reference_model_is_recorded(kind, engine):
    """Of balls with four contacts that takes seconds, and compiling it takes longer."""
    plan = plan_of(NUTS[kind], REFERENCE)
    assert_same(filled(plan, engine), filled(plan, "model"))


@pytest.mark.compiles
@pytest.mark.parametrize("kind", ["double", "scattered"])
@pytest.mark.parametrize("engine", ["numpy", "compiled"])
def test_any_blocks_and_threads_give_the_same_bits(kind, engine):
    plan = plan_of(NUTS[kind])
    whole = filled(plan, engine, threads=1)
    for how in ({"block_size": 1}, {"block_size": 5, "threads": 3}):
        for name, values in filled(plan, engine, **how).items():
            assert np.array_equal(values, whole[name], equal_nan=True), (name, how)


@pytest.mark.compiles
def test_numbers_that_vary_are_those_of_the_parts():
    """Preload, viscosity, temperature and an exponent of a law, of a grid."""
    points = {
        "axial_load": [3e3, -8e3],
        "screw_speed": 40.0,
        "nut.preload": [500.0, 4000.0],
        "temperature": [300.0, 330.0],
        "film.speed_exponent": [0.66, 0.68],
    }
    plan = plan_of(NUTS["double"], points=points)
    assert_same(filled(plan, "compiled"), filled(plan, "model"))


@pytest.mark.compiles
@pytest.mark.parametrize("kind", NUTS)
def test_the_kernel_of_the_chain_takes_the_same_steps(kind):
    """Loads of all balls; one point alone has the bits that it has among others."""
    screw = screw_with(NUTS[kind])
    expected, found = loads_of(screw, LOADS), loads_of(screw, LOADS, compiled=True)
    for flanks in (("forward_load", "backward_load"), ("forward_angle", "backward_angle")):
        # a balance is judged by the forces at work: of a flank that is nearly relieved, less is known
        size = np.max(np.abs([getattr(expected, name) for name in flanks]), axis=(0, -1))[:, None]
        for name in flanks:
            assert np.all(np.abs(getattr(found, name) - getattr(expected, name)) <= 1e-12 * size), name
            alone = getattr(loads_of(screw, LOADS[4], compiled=True), name)
            assert np.array_equal(alone, getattr(found, name)[4])
    assert np.allclose(found.rigidity, expected.rigidity, rtol=1e-12, atol=0)
    assert np.array_equal(found.converged, expected.converged)


@pytest.mark.parametrize(("swelling", "slower"), [(False, "chain_balance"), (True, "widened_balance")])
def test_a_chain_that_needs_part_of_a_step_is_left_to_numpy(monkeypatch, swelling, slower):
    """Here all chains are."""
    from ballscrew.physics.solvers import compiled_chain

    nut, slow = dataclasses.replace(NUTS["double"], bodies=bs.Bodies(swelling=swelling)), []
    screw, balance = screw_with(nut), getattr(compiled_chain, slower)
    monkeypatch.setattr(compiled_chain, "STEPS", 1)
    monkeypatch.setattr(compiled_chain, slower, lambda *given: slow.append(1) or balance(*given))
    found = loads_of(screw, LOADS, compiled=True)
    assert slow
    assert np.allclose(found.forward_load, loads_of(screw, LOADS).forward_load, rtol=1e-12, atol=1e-9)


def test_an_unknown_law_is_left_to_the_model_with_the_reason():
    def sorted_rolling(*given, **named):
        found = OLARU.rolling(*given, **named)
        np.sort(np.asarray(found[0]))
        return found

    model = dataclasses.replace(OLARU, rolling=sorted_rolling)
    found = bs.sweep(model, screw_with(NUTS["double"]), OIL, engine="numpy", outputs=["screw_torque"], **POINTS)
    assert "the model itself" in found.engine_reason
    with pytest.raises(bs.InputError, match="cannot be had"):
        bs.sweep(model, screw_with(NUTS["double"]), OIL, engine="compiled", outputs=["screw_torque"], **POINTS)


def test_little_work_is_left_to_the_model_until_it_adds_up():
    nut = dataclasses.replace(NUTS["double"], losses={"pads": bs.Seals(seal_torque=0.1)})
    points = {"axial_load": xr.DataArray(np.full(1000, 2e3), dims="point"), "screw_speed": 40.0}
    reasons: list[str] = []
    for step in range(2 * ENOUGH_TO_RECORD // (1000 * 24)):  # other numbers each time
        changed = dataclasses.replace(nut, preload=1000.0 + step, bodies=bs.Bodies(screw_diameter=0.03 + 1e-4 * step))
        oil = bs.Lubricant.from_grade("ISO VG 46", 300.0 + step)
        subject = Configuration(OLARU, dataclasses.replace(screw_with(changed), lead=0.01 + 1e-4 * step), oil)
        reasons.append(Evaluation.of(Plan.of(subject, ["screw_torque"], points)).reason)
    assert "too short to record" in reasons[0]
    assert "the model itself" not in reasons[-1]


@pytest.mark.compiles
def test_an_evaluator_is_compiled():
    evaluate = bs.evaluator(
        OLARU,
        screw_with(NUTS["double"]),
        OIL,
        inputs=["axial_load", "screw_speed", "preload"],
        outputs=["screw_torque", "valid"],
    )
    assert evaluate.engine == "compiled"
    screw = screw_with(dataclasses.replace(NUTS["double"], preload=3000.0))
    expected = OLARU(screw, OIL, axial_load=LOADS, screw_speed=SPEEDS)
    found = evaluate(LOADS, SPEEDS, 3000.0)
    assert np.allclose(found["screw_torque"], expected.screw_torque, rtol=1e-12, atol=0)
    assert np.array_equal(found["valid"], expected.valid)
    assert evaluate(3e3, 50.0, 3000.0)["screw_torque"] == found["screw_torque"][2]
    assert np.isnan(evaluate(3e3, 50.0, -1.0)["screw_torque"])


@pytest.mark.compiles
def test_a_store_goes_on(tmp_path):
    def stopped(finished: int, total: int) -> None:
        if finished < total:
            raise KeyboardInterrupt

    given = {"outputs": ["screw_torque"], "block_size": 4, "axial_load": LOADS[2:10], "screw_speed": [40.0]}
    screw, place = screw_with(NUTS["double"]), tmp_path / "map.zarr"
    with pytest.raises(KeyboardInterrupt):
        bs.sweep(OLARU, screw, OIL, to=place, engine="compiled", threads=1, done=stopped, **given)
    found = bs.sweep(OLARU, screw, OIL, to=place, engine="compiled", **given)
    expected = bs.sweep(OLARU, screw, OIL, engine="compiled", **given)
    assert np.array_equal(found.screw_torque.values, expected.screw_torque.values)
    with pytest.raises(bs.InputError):
        bs.sweep(OLARU, screw_with(NUTS["double"], balls=13), OIL, to=place, engine="compiled", **given)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["double", "oversize"])
def test_sizes_that_vary_at_one_preload(kind):
    """A size of the screw varies and the preload does not: the nut without load is another at each point."""
    sizes = xr.DataArray(np.linspace(9e-3, 12e-3, LOADS.size), dims="point")
    outputs = ["screw_torque", "rigidity", "remaining_preload"]
    plan = plan_of(NUTS[kind], OLARU, outputs, {**POINTS, "lead": sizes})
    assert_same(filled(plan, "compiled"), filled(plan, "numpy"))


@pytest.mark.compiles
def test_of_what_goes_to_a_file_no_bit_depends_on_the_kernels_that_are_kept(monkeypatch, tmp_path):
    """Neither on what this process has compiled, nor on what was asked of it before."""
    forget_structures(monkeypatch, tmp_path)
    monkeypatch.setattr(by_ball, "_structures", Structures())
    plan = plan_of(NUTS["scattered"])
    found = []
    for _ in range(2):
        evaluation = Evaluation.of(plan, recorded=True)
        results = evaluation.empty(plan.total)
        evaluation.fill(results, slice(0, plan.total))
        found.append(
            (evaluation.attributes, evaluation.fingerprint, {name: v.tobytes() for name, v in results.items()})
        )
        assert Evaluation.of(plan, "compiled").engine == "compiled"
        assert Evaluation.of(plan, shared=True).reason == KNOWN
    assert found[0] == found[1]
