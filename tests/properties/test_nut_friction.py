"""Laws of physics that the friction of a whole nut obeys: its balls add up, and so do its losses."""

import dataclasses
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.physics.components.nut import Bodies, Deviations, DoubleNut, OffsetLeadNut, OversizeBallNut, SingleNut
from ballscrew.physics.friction.balls import MECHANISMS, ball_friction, idle_ball_friction
from ballscrew.physics.friction.model import LAWS, nut_friction
from ballscrew.physics.friction.validity import NUT_REASONS
from ballscrew.physics.laws.friction import LoadSharing
from ballscrew.physics.laws.nut_losses import Recirculation, Seals
from ballscrew.physics.solvers.load_distribution import ball_loads
from support.nut_cases import KINDS, nut_case
from support.screws import screw
from support.strategies import MODELS, RPM, constant_friction, reference, with_ball_force, without_losses_of_rolling

OIL = bs.Lubricant(viscosity=0.1, pressure_viscosity_coefficient=2e-8)
PRELOADED = {"double": DoubleNut(1500.0, 0.01), "offset": OffsetLeadNut(1500.0), "oversize": OversizeBallNut(1500.0)}
#: As balls that differ or are preloaded have it, too.
SINGLE = SingleNut(angle_under_load=True)
NUTS = {"single": SINGLE, **PRELOADED}
LOADS = np.array([0.0, 50.0, 1500.0, 4000.0, 9000.0])
SPEED = 500 * RPM
#: Sums over balls in another order.
RELATIVE = 1e-12


SCREW = screw()


def friction(nut, load, speed=SPEED, *, model=reference, part=SCREW, oil=OIL, **more):
    screw = dataclasses.replace(part, nut=dataclasses.replace(nut, **more))
    return model(screw, oil, axial_load=load, screw_speed=speed)


# -- the balls add up ------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["reference", "corrected", "olaru2005"])
@pytest.mark.parametrize("load", [100.0, 1500.0, 12000.0])
def test_a_single_nut_is_the_model_at_the_angle_under_load(name, load):
    """Nothing else differs: balls alike on rigid bodies have the contact load F/(z sin α cos φ) of that angle."""
    model = MODELS[name]
    r = friction(SINGLE, load, model=model)
    part = dataclasses.replace(SCREW, contact_angle=float(r.loads.forward_angle[0]))
    # olaru2005 has no helix in its contact load
    axial = load / math.cos(SCREW.lead_angle) if name == "olaru2005" else load
    alone = model(part, OIL, axial_load=axial, screw_speed=SPEED)
    assert r.screw_torque == pytest.approx(alone.screw_torque, rel=RELATIVE)
    assert r.nut_torque == pytest.approx(alone.nut_torque, rel=RELATIVE)
    assert {key: r.contributions[key] for key in alone.contributions} == pytest.approx(
        dict(alone.contributions), rel=RELATIVE, abs=1e-15
    )
    assert bool(r.valid) == bool(alone.valid)


def test_the_angle_under_load_is_all_that_differs_from_the_model():
    """Small loads leave the angle alone: the difference of the torques goes as that of the angles, to zero."""
    loads = 10.0 ** np.arange(0, 4)
    nut, alone = friction(SINGLE, loads), reference(SCREW, OIL, axial_load=loads, screw_speed=SPEED)
    turned = np.abs(nut.loads.forward_angle[:, 0] - SCREW.contact_angle)
    assert np.all(np.diff(turned) > 0)
    # spin, load and radii all go with functions of the angle whose slopes by it are of the order of one
    assert np.all(np.abs(nut.screw_torque / alone.screw_torque - 1) < 3 * turned)


@pytest.mark.parametrize("kind", ["double", "offset"])
@pytest.mark.parametrize("force", [1.0, 700.0, 5000.0])
def test_without_load_a_double_nut_is_two_halves_under_the_preload(kind, force):
    r, half = friction(type(PRELOADED[kind])(force), 0.0), friction(SINGLE, force)
    assert r.screw_torque == pytest.approx(2 * half.screw_torque, rel=1e-9)
    assert r.nut_torque == pytest.approx(2 * half.nut_torque, rel=1e-9)
    assert np.isnan(r.efficiency)
    assert np.isnan(r.back_driving_efficiency)


@pytest.mark.parametrize("kind", ["double", "offset"])
@pytest.mark.parametrize("load", [0.5, 1.0, 2.0])
def test_a_loaded_double_nut_is_two_single_nuts(kind, load):
    """One carries the load and what is left of the preload, the other what is left."""
    nut = PRELOADED[kind]
    r = friction(nut, load * nut.preload)
    left = r.loads.remaining_preload
    halves = [friction(SINGLE, force) for force in (load * nut.preload + left, left)]
    assert r.screw_torque == pytest.approx(sum(half.screw_torque for half in halves), rel=1e-8)


@pytest.mark.parametrize("kind", KINDS)
def test_balls_one_by_one_are_all_of_a_kind(kind):
    few, many = friction(NUTS[kind], LOADS), friction(NUTS[kind], LOADS, deviations=Deviations())
    assert many.loads.forward_load.shape == (5, 120 if kind in {"double", "offset"} else 60)
    assert many.screw_torque == pytest.approx(few.screw_torque, rel=1e-9, abs=1e-12)
    for name in MECHANISMS:
        assert many.contributions[name] == pytest.approx(few.contributions[name], rel=1e-8, abs=1e-9), name


@pytest.mark.parametrize("kind", ["single", "double"])
def test_twice_the_balls_with_twice_the_load_have_twice_the_torque(kind):
    """Invariant 5: additive in balls at fixed load and ball-to-ball force."""
    model = with_ball_force(reference, 0.02)
    one = friction(NUTS[kind], LOADS, model=model)
    twice = dataclasses.replace(NUTS[kind], preload=3000.0) if kind == "double" else NUTS[kind]
    other = friction(twice, 2 * LOADS, model=model, part=screw(loaded_balls=120))
    assert other.screw_torque == pytest.approx(2 * one.screw_torque, rel=1e-9, abs=1e-12)


def test_unequal_balls_sum_ball_by_ball():
    deviations = Deviations.scattered(60, seed=3, ball_diameter=5e-7, lead=1e-6)
    r = friction(SINGLE, 3000.0, deviations=deviations, bodies=Bodies.of(SCREW))
    by_ball = dataclasses.replace(reference, contact_load=lambda axial_load, *_: axial_load)
    total = 0.0
    for load, angle in zip(r.loads.forward_load, r.loads.forward_angle, strict=True):
        part = screw(loaded_balls=1, contact_angle=float(angle) if load > 0 else math.pi / 4)
        total += by_ball(part, OIL, axial_load=float(load), screw_speed=SPEED).screw_torque
    assert r.screw_torque == pytest.approx(total, rel=1e-9)
    assert np.ptp(r.loads.forward_load) > 0.1 * np.mean(r.loads.forward_load)


# -- torques and their parts -----------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("ball_force", [0.0, 0.05])
def test_torques_on_screw_and_nut(kind, ball_force):
    """Invariant 1: M_S − M_N is what the balls that carry load push each other along with, and the parts sum to M_S."""
    model = with_ball_force(reference, ball_force)
    r = friction(NUTS[kind], np.array([50.0, 1500.0, 9000.0]), model=model)
    assert tuple(r.contributions) == tuple(MECHANISMS)
    assert sum(r.contributions.values()) == pytest.approx(r.screw_torque, rel=RELATIVE)
    carrying = np.sum(r.loads.balls * (r.loads.forward_load + r.loads.backward_load > 0), axis=-1)
    pushed = carrying * ball_force * model.frame(SCREW).path_radius
    assert np.all(r.validity["skid"])
    assert r.screw_torque - r.nut_torque == pytest.approx(pushed, rel=1e-8, abs=1e-10)
    assert r.friction_power == pytest.approx(r.screw_torque * SPEED, rel=RELATIVE)


@pytest.mark.parametrize("kind", KINDS)
def test_losses_have_their_own_names_and_touch_nothing_else(kind):
    losses = {"seals": Seals(seal_torque=0.2), "recirculation": Recirculation(return_force=3.0, returns=2)}
    bare, more = friction(NUTS[kind], LOADS), friction(NUTS[kind], LOADS, losses=losses)
    assert tuple(more.contributions) == (*MECHANISMS, "seals", "recirculation")
    for name in MECHANISMS:
        assert np.array_equal(more.contributions[name], bare.contributions[name]), name
    lost = more.contributions["seals"] + more.contributions["recirculation"]
    assert more.contributions["seals"] == pytest.approx(0.2)
    assert np.all(lost > 0.2)
    assert more.screw_torque == pytest.approx(bare.screw_torque + lost, rel=RELATIVE)
    assert more.nut_torque == pytest.approx(bare.nut_torque + lost, rel=RELATIVE)
    assert np.all(more.efficiency[1:] < bare.efficiency[1:])


def test_efficiencies_belong_to_the_drive_torque():
    r = friction(DoubleNut(1500.0), LOADS)
    ideal = LOADS * SCREW.lead / (2 * math.pi)
    assert r.ideal_torque == pytest.approx(ideal, rel=RELATIVE)
    assert r.drive_torque == pytest.approx(ideal + r.screw_torque, rel=RELATIVE)
    assert np.isnan(r.efficiency[0])
    assert r.efficiency[1:] == pytest.approx((ideal / r.drive_torque)[1:], rel=RELATIVE)
    assert r.back_driving_efficiency[1:] == pytest.approx(2 - 1 / r.efficiency[1:], rel=RELATIVE)
    assert r.largest_contact_load == pytest.approx(r.loads.forward_load[:, 0], rel=RELATIVE)


# -- four contacts ---------------------------------------------------------------------------------


@pytest.mark.parametrize("factor", [1.0001, 1.5, 3.0])
def test_beyond_lift_off_oversize_balls_roll_on_two_contacts(factor):
    """The single nut at the same contact load and angle; strips the same, unfinished steps apart: 0.2 %."""
    nut = PRELOADED["oversize"]
    load = factor * float(friction(nut, 0.0).loads.lift_off_load)
    r = friction(nut, load)
    assert r.loads.remaining_preload == 0
    excess = Deviations(ball_diameter=interference(nut.preload))
    single = friction(SINGLE, load, deviations=excess)
    assert r.loads.forward_angle[0] == pytest.approx(single.loads.forward_angle[0], rel=1e-9)
    assert r.screw_torque == pytest.approx(single.screw_torque, rel=2e-3)
    assert r.nut_torque == pytest.approx(single.nut_torque, rel=2e-3)


def interference(force):
    """By how much balls are too big that carry a preload: the approach of a single nut at a constant angle."""
    x = ball_loads(SCREW, SingleNut(), force, constant_contact_angle=True).deflection
    return float(x) * math.sin(SCREW.contact_angle) * math.cos(SCREW.lead_angle)


def random_screw(rng):
    """A screw in the range of catalogues and somewhat beyond; None where its balls have no room."""
    d_m = 10 ** rng.uniform(-2.1, -0.9)
    d_w = d_m * rng.uniform(0.08, 0.17)
    try:
        return bs.BallScrew(
            pitch_circle_diameter=d_m,
            lead=d_w * rng.uniform(1.3, 3),
            ball_diameter=d_w,
            loaded_balls=int(rng.integers(20, 150)),
            contact_angle=math.radians(rng.uniform(30, 60)),
            screw_conformity=rng.uniform(0.505, 0.56),
            nut_conformity=rng.uniform(0.505, 0.56),
        )
    except InputError:
        return None


@pytest.mark.slow
def test_lift_off_is_no_jump():
    """The torque is continuous where the ball leaves a flank pair, on both sides of it and where both are valid.

    Its slope grows without bound there, as the rolling force of the relieved contacts goes with a small power of their
    load: at a millionth of the load to either side 0.1 % is left.
    """
    rng, jumps = np.random.default_rng(4), []
    while len(jumps) < 40:
        part, oil = random_screw(rng), bs.Lubricant(viscosity=10 ** rng.uniform(-2, -0.5))
        nut, speed = OversizeBallNut(10 ** rng.uniform(0, 4.3)), 10 ** rng.uniform(-2, 2.5)
        if part is None:
            continue
        lift = float(ball_loads(part, nut, 0.0).lift_off_load)
        found = friction(nut, lift * np.array([1 - 1e-6, 1 + 1e-6]), speed, part=part, oil=oil)
        if np.all(found.valid):
            below, above = found.screw_torque
            jumps.append(below / above - 1)
    assert np.max(np.abs(jumps)) < 2e-3


def test_four_contacts_cost_more_than_two(seed_screw, seed_oil):
    """Invariant 24: slip at a preload of 500 N with a friction of 0.11 everywhere, 0.016 N m against 0.186 N m.

    Both from a contact integral without a change of the contact angle, to three digits.
    """
    model = dataclasses.replace(without_losses_of_rolling(reference), friction=constant_friction(0.11))
    two, four = (
        friction(nut(500.0), 0.0, model=model, part=seed_screw, oil=seed_oil) for nut in (DoubleNut, OversizeBallNut)
    )
    assert two.screw_torque == pytest.approx(0.016, rel=0.05)
    assert four.screw_torque == pytest.approx(0.186, rel=0.05)


@pytest.mark.parametrize("name", ["corrected", "olaru2005"])
def test_models_without_spin_know_no_four_contacts(name):
    with pytest.raises(InputError, match=r"model.slip: knows no balls with four contacts.*reference"):
        friction(PRELOADED["oversize"], 100.0, model=MODELS[name])
    assert friction(PRELOADED["double"], 100.0, model=MODELS[name]).screw_torque > 0


# -- arrays ----------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("more", [{}, {"bodies": Bodies.of(SCREW)}])
@pytest.mark.parametrize("kind", KINDS)
def test_an_array_is_a_row_of_numbers(kind, more):
    speeds = np.array([0.0, 50.0, 500.0, 3000.0])[:, None] * RPM
    whole = friction(NUTS[kind], LOADS, speeds, **more)
    assert whole.screw_torque.shape == (4, 5)
    for i, j in np.ndindex(4, 5):
        one = friction(NUTS[kind], float(LOADS[j]), float(speeds[i, 0]), **more)
        assert np.ndim(one.screw_torque) == 0
        assert one.screw_torque == pytest.approx(whole.screw_torque[i, j], rel=1e-9, abs=1e-12)
        assert one.nut_torque == pytest.approx(whole.nut_torque[i, j], rel=1e-9, abs=1e-12)
        assert {key: bool(mask) for key, mask in one.validity.items()} == {
            key: bool(np.broadcast_to(mask, (4, 5))[i, j]) for key, mask in whole.validity.items()
        }


@pytest.mark.parametrize("kind", KINDS)
def test_oils_laws_and_screws_may_be_arrays(kind):
    """The ball axis stays the last one, whatever else is an array."""
    viscosity, share = np.array([0.02, 0.1, 0.4]), np.array([0.08, 0.11, 0.14])
    model = dataclasses.replace(reference, friction=LoadSharing(boundary_friction_coefficient=share))
    angle = np.radians([40.0, 45.0, 50.0])
    whole = friction(
        NUTS[kind], 2000.0, model=model, oil=bs.Lubricant(viscosity, 2e-8), part=screw(contact_angle=angle)
    )
    assert whole.screw_torque.shape == (3,)
    for i in range(3):
        law = LoadSharing(boundary_friction_coefficient=float(share[i]))
        one = friction(
            NUTS[kind],
            2000.0,
            model=dataclasses.replace(reference, friction=law),
            oil=bs.Lubricant(float(viscosity[i]), 2e-8),
            part=screw(contact_angle=float(angle[i])),
        )
        assert whole.screw_torque[i] == pytest.approx(one.screw_torque, rel=1e-9)


# -- where to trust --------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
def test_reasons(kind):
    r = friction(NUTS[kind], LOADS)
    assert set(r.validity) == set(NUT_REASONS)
    assert all(np.shape(np.broadcast_to(mask, LOADS.shape)) == LOADS.shape for mask in r.validity.values())


@pytest.mark.parametrize("kind", ["double", "offset", "oversize"])
def test_flanks_that_carry_nothing_do_not_spoil_the_rest(kind):
    """Far beyond lift-off the other flanks have no load, no film and no say."""
    r = friction(PRELOADED[kind], 9000.0)
    assert r.loads.remaining_preload == 0
    assert np.all(r.valid), r.warnings
    assert r.warnings == []


@pytest.mark.parametrize("kind", KINDS)
def test_a_light_load_at_high_speed_skids(kind):
    nut = NUTS[kind] if kind == "single" else dataclasses.replace(NUTS[kind], preload=0.05)
    r = friction(nut, 0.05, 5000 * RPM)
    assert not r.validity["skid"]
    assert not r.valid
    assert any(warning.startswith("skid") for warning in r.warnings)


@pytest.mark.parametrize("kind", KINDS)
def test_nothing_is_missing_in_the_range_of_machines(kind):
    """0 to 50 kN, preloads to 20 kN, 0 to 5000 rpm: a number everywhere, and no torque that drives."""
    preloads = np.array([0.0, 1e-3, 1.0, 300.0, 5000.0, 20e3])[:, None, None]
    loads = np.array([0.0, 1e-3, 1.0, 100.0, 3000.0, 20e3, 50e3])[:, None]
    speeds = np.array([0.0, 1e-3, 1.0, 100.0, 1000.0, 5000.0]) * RPM
    nut = SINGLE if kind == "single" else type(NUTS[kind])(preloads)
    r = friction(nut, loads + 0 * preloads, speeds)
    assert r.screw_torque.shape == (6, 7, 6)
    for torque in (r.screw_torque, r.nut_torque, r.efficiency[:, 1:], *r.contributions.values()):
        assert np.all(np.isfinite(torque))
    assert np.all(r.screw_torque >= 0)
    assert np.all((r.efficiency[:, 1:] >= 0) & (r.efficiency[:, 1:] < 1))
    assert np.all(np.isnan(r.efficiency[:, 0]))
    for mask in r.validity.values():
        assert mask.dtype == bool
    # without speed nothing rolls on a film
    assert np.all(r.contributions["hydrodynamic_rolling"][..., 0] == 0)


@pytest.mark.parametrize("kind", KINDS)
def test_any_screw_under_any_load(kind):
    """Two thousand random nuts up to the static rating: finite, and where valid the screw has to be driven."""
    case = nut_case(kind, 2000, 77, elastic=False)
    rng = np.random.default_rng(5)
    oil = bs.Lubricant(np.exp(rng.uniform(math.log(0.005), 0, 2000)), 2e-8)
    speed = rng.uniform(0, 5000, 2000) * RPM
    r = friction(case.nut, case.load, speed, part=case.screw, oil=oil)
    assert np.all(np.isfinite(r.screw_torque))
    assert np.all(r.screw_torque >= 0)
    assert np.mean(r.valid) > 0.25
    assert np.all(r.screw_torque[r.valid & (case.load > 0)] > 0)


def test_no_load_and_no_preload_is_no_torque():
    for nut in (SINGLE, DoubleNut(0.0), OversizeBallNut(0.0)):
        r = friction(nut, 0.0)
        assert r.screw_torque == pytest.approx(0.0, abs=1e-9)
        assert np.isnan(r.efficiency)


@pytest.mark.parametrize("bad", ["axial_load", "screw_speed"])
@pytest.mark.parametrize("kind", NUTS)
def test_what_has_no_meaning_is_nan_in_everything_derived(kind, bad):
    # what is no number is not refused in an array
    some = np.array([np.nan, 1.0])
    r = friction(NUTS[kind], 2000.0 * some) if bad == "axial_load" else friction(NUTS[kind], 2000.0, SPEED * some)
    derived = (
        "screw_torque", "nut_torque", "drive_torque", "efficiency", "back_driving_efficiency", "holding_torque",
        "friction_power",
    )  # fmt: skip
    for values in (*(getattr(r, name) for name in derived), *r.contributions.values()):
        assert np.isnan(values[0])
        assert np.isfinite(values[1])
    assert list(r.valid) == [False, True]


def test_an_impossible_number_in_an_array_is_no_warning():
    """Of NumPy, which are errors in tests: the number is reported by the validity."""
    part = dataclasses.replace(SCREW, screw_conformity=np.array([0.5, 0.54]))
    assert friction(OffsetLeadNut(1500.0), 1000.0, part=part).valid.tolist() == [False, True]


def test_plain_numbers_that_overflow_are_refused():
    part = dataclasses.replace(SCREW, ball_roughness=1e200)
    with pytest.raises(InputError, match="too large or too small"):
        reference(part, OIL, axial_load=1e3, screw_speed=SPEED)


# -- as it was called ------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", NUTS)
def test_the_former_call_is_the_model_with_a_warning(kind):
    """Of a single nut that whose contact angle follows its load, which it had."""
    parts = {"losses": {"seals": Seals(seal_torque=0.2)}}
    if kind == "double":
        parts |= {"bodies": Bodies(), "deviations": Deviations.scattered(120, seed=1, ball_diameter=1e-7)}
    nut = SingleNut() if kind == "single" else NUTS[kind]
    with pytest.warns(DeprecationWarning, match="nut_friction is deprecated: a ball screw has its nut"):
        former = nut_friction(reference, SCREW, nut, OIL, axial_load=LOADS, screw_speed=SPEED, **parts)
    found = friction(NUTS[kind], LOADS, **parts)
    for name in ("screw_torque", "nut_torque", "drive_torque", "efficiency", "valid"):
        assert np.array_equal(getattr(former, name), getattr(found, name), equal_nan=name == "efficiency"), name
    assert tuple(former.contributions) == (*MECHANISMS, "seals")
    assert former.ball_screw.nut == dataclasses.replace(NUTS[kind], **parts)


IDLE_SLOTS = ("slip", "ball_force", "ball_chain", "race_torques", "frame", "friction")


@pytest.mark.parametrize("name", ["olaru2005", "corrected", "reference"])
@pytest.mark.parametrize(("slot", "law"), [(slot, law) for slot in IDLE_SLOTS for law in LAWS[slot]])
def test_a_ball_that_is_lifted_off_has_the_friction_of_one_without_load(name, slot, law):
    """The limit that the sum uses past lift-off is what the laws give without load."""
    made = LAWS[slot][law]
    changes = {slot: made() if isinstance(made, type) else made}
    model = dataclasses.replace(MODELS[name], **changes, **({"pure_rolling_offset": None} if slot == "slip" else {}))
    frame, imposed = model.laws.frame(SCREW), model.imposed_ball_force(SCREW)
    with np.errstate(all="ignore"):  # no load, no film
        limit = ball_friction(model, SCREW, OIL, frame, np.float64(0.0), SPEED, imposed)
    idle = idle_ball_friction(model, SCREW, frame, SPEED, imposed)
    assert idle.screw_torque == pytest.approx(limit.screw_torque, rel=1e-12, abs=1e-18)
    assert idle.nut_torque == pytest.approx(limit.nut_torque, rel=1e-12, abs=1e-18)
    assert dict(idle.contributions) == pytest.approx(dict(limit.contributions), rel=1e-12, abs=1e-18)
