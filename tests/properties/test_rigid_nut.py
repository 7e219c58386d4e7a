"""Nuts between rigid bodies: balance and mirror images on ten thousand random nuts, recordings, and derivatives."""

import dataclasses
import functools
import itertools
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.compiler.tracing.gradient import partials
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.tape import Tape
from ballscrew.evidence.papers.olaru2005.case import SCREW
from ballscrew.physics.components.nut import Bodies, Deviations, DoubleNut, OffsetLeadNut, OversizeBallNut, SingleNut
from ballscrew.physics.equations import rigidity
from ballscrew.physics.solvers.load_distribution import ball_loads, pair_load_deflection
from support.nut_cases import KINDS, nut_case

#: Random nuts of a kind.
NUTS = 5000
STEEL = bs.Material(young_modulus=2.06e11, poisson_ratio=0.3)
#: Kinds whose balls are in two halves.
HALVES = ("double", "offset")
#: Nuts that are no other nut when they are mirrored: kind, elastic or not, scatter or not, load at the same side.
MIRRORED = [
    (kind, elastic, scatter, same_side)
    for kind, elastic, scatter, same_side in itertools.product(KINDS, *[(False, True)] * 3)
    if (elastic or scatter) and not (kind in HALVES and elastic and same_side)
]
OF_KIND = ("forward_load", "backward_load", "forward_angle", "backward_angle")
OF_NUT = ("deflection", "rigidity", "remaining_preload", "lift_off_load")
SWAPPED = {
    name: name.replace("forward", "x").replace("backward", "forward").replace("x", "backward") for name in OF_KIND
}


def nut_of(kind, preload):
    return {"single": SingleNut, "oversize": OversizeBallNut, "double": DoubleNut, "offset": OffsetLeadNut}[kind](
        **({} if kind == "single" else {"preload": preload})
    )


def random_screw(size, rng, steepest=89.5, shallowest=0.5):
    """Screws beyond what is sold: contact angles from nearly none to nearly 90°, grooves almost as close as balls."""
    d_m = rng.uniform(0.008, 0.125, size)
    return bs.BallScrew(
        pitch_circle_diameter=d_m,
        lead=d_m * rng.uniform(0.25, 1, size),
        ball_diameter=d_m * rng.uniform(0.06, 0.2, size),
        loaded_balls=rng.integers(1, 300, size).astype(float),
        contact_angle=np.radians(rng.uniform(shallowest, steepest, size)),
        screw_conformity=rng.uniform(0.5005, 0.7, size),
        nut_conformity=rng.uniform(0.5005, 0.7, size),
        ball_material=STEEL,
        screw_material=STEEL,
        nut_material=STEEL,
    )


def random_loads(screw, kind, rng, constant=False):
    """Preloads over nine orders, and loads: none, up to a million preloads, and within 1e-12 of lift-off."""
    size = screw.contact_angle.size
    # twice the static rating of any screw
    most = 1.5e8 * screw.ball_diameter**2 * screw.loaded_balls * np.sin(screw.contact_angle)
    preload = most * 10 ** rng.uniform(-9, -0.7, size) * (rng.random(size) > 0.05)
    lift = ball_loads(screw, nut_of(kind, preload), 0.0, constant_contact_angle=constant).lift_off_load
    loads = [
        0 * preload,
        preload * 10 ** rng.uniform(-6, 6, size),
        most * 10 ** rng.uniform(-9, 0, size),
        lift * (1 + rng.choice([-1, 1], size) * 10 ** rng.uniform(-12, -1, size)),
    ]
    return preload, np.choose(rng.integers(0, 4, size), loads) * rng.choice([-1.0, 1.0], size)


@pytest.fixture(scope="module", params=[(kind, constant) for kind in KINDS for constant in (False, True)], ids=str)
def drawn(request):
    kind, constant = request.param
    rng = np.random.default_rng(KINDS.index(kind))
    screw = random_screw(NUTS, rng)
    preload, load = random_loads(screw, kind, rng, constant)
    nut = nut_of(kind, preload)
    return screw, nut, load, constant, ball_loads(screw, nut, load, constant_contact_angle=constant)


def preload_of(nut, load):
    return np.broadcast_to(getattr(nut, "preload", 0.0), load.shape)


# -- balance ---------------------------------------------------------------------------------------


def test_balls_balance_the_load_to_rounding(drawn):
    """Σ Q sin α cos φ is the load, and what is left on the flanks that it relieves the remaining preload."""
    screw, nut, load, _, r = drawn
    c_phi, forces = np.cos(screw.lead_angle), np.abs(load) + preload_of(nut, load)
    forward, backward = (
        sum(kind.balls * getattr(kind, f"{side}_load") * np.sin(getattr(kind, f"{side}_angle")) for kind in r.kinds)
        * c_phi
        for side in ("forward", "backward")
    )
    assert np.all(np.abs(forward - backward - load) <= 2e-14 * forces)
    assert np.all(np.abs(r.remaining_preload - np.where(load < 0, forward, backward)) <= 2e-14 * forces)
    assert np.max(r.residual) <= 1e-13
    assert np.all((r.forward_load >= 0) & (r.backward_load >= 0))
    assert np.all(np.isfinite(r.deflection) & np.isfinite(r.rigidity) & np.isfinite(r.lift_off_load))


def test_every_flank_carries_what_its_displacement_makes_of_it(drawn):
    """The displacement of both bodies, K δ^1.5 there, and the angle there."""
    screw, nut, load, constant, r = drawn
    alpha, c_phi = screw.contact_angle, np.cos(screw.lead_angle)
    A = rigidity.groove_centre_distance(screw.screw_conformity, screw.nut_conformity, screw.ball_diameter)
    K, a = pair_load_deflection(screw), np.sin(alpha)
    offset, excess, preload = 0.0, 0.0, preload_of(nut, load)
    if isinstance(nut, OversizeBallNut):
        excess = (preload / (screw.loaded_balls * K * a * c_phi)) ** (2 / 3)
    elif not isinstance(nut, SingleNut):
        rest = ball_loads(screw, nut, 0.0, constant_contact_angle=constant)
        share, angle = rest.kinds[0].forward_load, rest.kinds[0].forward_angle
        offset = (share / K) ** (2 / 3) / a if constant else A * np.cos(alpha) * (np.tan(angle) - np.tan(alpha))
        # tan(angle) - tan(alpha) cancels under light preloads
        offset = np.where((share / K) ** (2 / 3) < 1e-6 * A * a**2, (share / K) ** (2 / 3) / a, offset)
    size = K * np.maximum((np.abs(load) + preload) / (screw.loaded_balls * K * a * c_phi), 1e-300)
    for side, way in (("forward", 1.0), ("backward", -1.0)):
        carried = sum(getattr(kind, f"{side}_load") for kind in r.kinds)
        turned = sum(getattr(kind, f"{side}_angle") for kind in r.kinds)
        xi = way * r.deflection * c_phi + offset
        if constant:
            sine, delta = a, xi * a + excess
        else:
            s = rigidity.loaded_centre_distance(A, alpha, xi)
            sine = rigidity.loaded_contact_sine(A, alpha, xi, s)
            delta = rigidity.ball_approach(A, alpha, xi, s, excess)
        if isinstance(nut, SingleNut):
            touches = (way * load > 0) & (delta > 0)
        else:
            touches = (delta > 0) & (sine > 0)
            assert np.allclose(turned, np.arcsin(sine), rtol=0, atol=2e-6)
        expected = rigidity.hertz_load(K, np.where(touches, delta, 0.0))
        assert np.max(np.abs(carried - expected) / size) <= 1e-5


@pytest.mark.slow
def test_balls_one_by_one_agree(drawn):
    """The search within brackets, which solves for each ball, on some of the nuts."""
    screw, nut, load, constant, r = drawn
    rng = np.random.default_rng(1)
    for i in rng.choice(NUTS, 40, replace=False):
        values = {name: float(value[i]) for name, value in vars(screw).items() if np.ndim(value)}
        one = dataclasses.replace(screw, **{**values, "loaded_balls": int(values["loaded_balls"])})
        single = nut if isinstance(nut, SingleNut) else dataclasses.replace(nut, preload=float(nut.preload[i]))
        by_ball = ball_loads(one, single, load[i], deviations=Deviations(), constant_contact_angle=constant)
        share = np.max([r.forward_load[i], r.backward_load[i]])
        for name in ("forward_load", "backward_load"):
            # the first and the last ball stand for the halves
            ends = getattr(by_ball, name)[[0, -1]][: len(r.kinds)]
            assert np.max(np.abs(getattr(r, name)[i] - ends)) <= 1e-12 * share
        forces = abs(load[i]) + preload_of(nut, load)[i]
        assert abs(r.remaining_preload[i] - by_ball.remaining_preload) <= 1e-12 * forces
        assert abs(r.lift_off_load[i] - by_ball.lift_off_load) <= 1e-9 * forces + 1e-12
        if forces > 0:
            assert r.rigidity[i] == pytest.approx(by_ball.rigidity, rel=1e-9)


# -- mirror images ---------------------------------------------------------------------------------


def test_the_other_sign_is_the_mirror_image_to_the_last_bit(drawn):
    screw, nut, load, constant, r = drawn
    if isinstance(nut, SingleNut):  # nothing says which flank no load presses on
        r = ball_loads(screw, nut, load := np.where(load == 0, 1.0, load), constant_contact_angle=constant)
    mirrored = ball_loads(screw, nut, -load, constant_contact_angle=constant)
    for kind, other in zip(r.kinds, mirrored.kinds[::-1], strict=True):
        for name, swapped in SWAPPED.items():
            assert np.array_equal(getattr(kind, name) + 0 * load, getattr(other, swapped) + 0 * load), name
    assert np.array_equal(r.deflection, -mirrored.deflection)
    for name in ("rigidity", "remaining_preload", "lift_off_load", "residual"):
        assert np.array_equal(getattr(r, name), getattr(mirrored, name)), name


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "elastic", "scatter", "same_side"), MIRRORED)
def test_a_nut_mirrored_as_a_whole_carries_the_other_load_alike(kind, elastic, scatter, same_side):
    """Errors of the lead change their sign.

    The halves of a double nut change places, so that its balls are read from the other end: alike where the load enters
    at both ends, and screw and nut are equally stiff, or where bodies are rigid.
    """
    halves = kind in HALVES
    case = nut_case(kind, 60, 21, elastic=elastic, scatter=scatter, same_side=same_side, balls=13)
    bodies, deviations = case.bodies, case.deviations
    if bodies is not None and halves:
        tube = np.sqrt(bodies.screw_diameter**2 + bodies.nut_inner_diameter**2)
        bodies = dataclasses.replace(bodies, nut_outer_diameter=tube)
    order = slice(None, None, -1 if halves else 1)
    other = deviations and Deviations(deviations.ball_diameter[order], -deviations.lead[order])
    r = ball_loads(case.screw, case.nut, case.load, bodies=bodies, deviations=deviations)
    m = ball_loads(case.screw, case.nut, -case.load, bodies=bodies, deviations=other)
    assert np.all(r.converged & m.converged)
    here = case.load > 0 if kind == "single" else case.load + case.preload > 0
    forces = (case.load + case.preload)[here]
    share = np.max(np.maximum(r.forward_load, r.backward_load), axis=-1, keepdims=True)[here]
    for name in ("forward_load", "backward_load"):
        there = getattr(m, SWAPPED[name])[..., order]
        assert np.max(np.abs(getattr(r, name) - there)[here] / share) <= 1e-10, name
    reach = np.abs(r.deflection[here]) + forces / r.rigidity[here]
    assert np.max(np.abs(r.deflection + m.deflection)[here] / reach) <= 1e-10
    assert np.max(np.abs(r.remaining_preload - m.remaining_preload)[here] / forces) <= 1e-10
    # that of the side on which the load is
    lift, other = r.lift_off_load[case.load > 0], m.lift_off_load[case.load > 0]
    assert np.max(np.abs(lift - other) / (np.abs(lift) + case.load[case.load > 0])) <= 1e-10
    assert m.rigidity[here] == pytest.approx(r.rigidity[here], rel=1e-8)


@pytest.mark.parametrize("kind", KINDS)
def test_loads_of_both_signs_in_one_array_are_those_one_at_a_time(kind):
    """On elastic bodies with scatter: the solver never confuses neighbours."""
    case = nut_case(kind, 40, 22, elastic=True, scatter=True, balls=9)
    load = case.load * np.where(np.arange(40) % 2, -1.0, 1.0)
    r = ball_loads(case.screw, case.nut, load, bodies=case.bodies, deviations=case.deviations)
    for sign, rows in ((1, slice(0, None, 2)), (-1, slice(1, None, 2))):
        alone = ball_loads(case.screw, case.nut, sign * case.load, bodies=case.bodies, deviations=case.deviations)
        size = np.max(r.forward_load + r.backward_load, axis=-1, keepdims=True)[rows] + 1e-9
        for name in ("forward_load", "backward_load"):
            assert np.max(np.abs(getattr(r, name) - getattr(alone, name))[rows] / size) <= 1e-10


@pytest.mark.parametrize("kind", ["oversize", "double"])
@pytest.mark.parametrize("sign", [-1, 1])
@pytest.mark.parametrize("scatter", [False, True])
def test_either_sign_lifts_off_at_its_own_load(kind, sign, scatter):
    case = nut_case(kind, 60, 23, elastic=False, scatter=scatter, balls=8)
    nut = dataclasses.replace(case.nut, preload=np.maximum(case.preload, 1.0))
    # the load that lifts off is that of the side on which the load is
    lift = ball_loads(case.screw, nut, sign * 1e-9 * nut.preload, deviations=case.deviations).lift_off_load
    left = [
        ball_loads(case.screw, nut, sign * factor * lift, deviations=case.deviations).remaining_preload
        for factor in (1 - 1e-5, 1 + 1e-5)
    ]
    braced = lift > 0
    assert np.mean(braced) > 0.5
    assert np.all(left[0][braced] > 0)
    assert np.all(left[1][braced] == 0)


# -- recordings ------------------------------------------------------------------------------------

#: One point of each input, by the order of the inputs: load, preload, contact angle, ball diameter.
INPUTS = ("load", "preload", "contact_angle", "ball_diameter")


def outcome(kind, constant, load, preload, contact_angle, ball_diameter):
    """All that a rigid nut answers, by name."""
    screw = dataclasses.replace(
        SCREW, lead=0.010, ball_diameter=ball_diameter, contact_angle=contact_angle, nut_conformity=0.52
    )
    r = ball_loads(screw, nut_of(kind, preload), load, constant_contact_angle=constant)
    found = {f"{name} {i}": getattr(part, name) for i, part in enumerate(r.kinds) for name in OF_KIND}
    return found | {name: getattr(r, name) for name in OF_NUT}


@functools.cache
def recorded(kind, constant, slopes=False):
    """The program of the outcome, and of its derivatives."""
    tape = Tape(len(INPUTS))
    with np.errstate(all="ignore"):
        found = outcome(kind, constant, *(tape.value(i) for i in range(len(INPUTS))))
        if slopes:
            found = {
                f"{name} by {by}": slope
                for name, value in found.items()
                for by, slope in zip(INPUTS, partials(tape, value, range(len(INPUTS))), strict=True)
            }
    return Program.of(tape, found)


def played(program, points):
    results = {name: np.full(points.shape[1], 99.0) for name in (*program.outputs, *program.constants)}
    with np.errstate(all="ignore"):
        program.interpreter.run(list(points), results)
    return results


def points(size, kind, away=0.0):
    """Loads of both signs and none, at some distance from lift-off; preloads; angles; balls."""
    rng = np.random.default_rng(5)
    preload = 10 ** rng.uniform(1, 3.5, size)
    angle, diameter = np.radians(rng.uniform(25, 65, size)), rng.uniform(2e-3, 5e-3, size)
    lift = outcome(kind, False, 0.0, preload, angle, diameter)["lift_off_load"] if kind != "single" else preload
    part = rng.uniform(0.01, 3, size)
    part = np.where(np.abs(part - 1) < away, 0.5, part) * rng.choice([-1.0, 1.0], size)
    return np.array([np.where(rng.random(size) < 0.1, 0.0, part * lift), preload, angle, diameter])


@pytest.mark.slow
@pytest.mark.parametrize("constant", [False, True])
@pytest.mark.parametrize("kind", KINDS)
def test_a_recording_gives_the_numbers_of_arrays(kind, constant):
    at = points(2000, kind)
    at[1, :20] = 0.0
    at[0, 10:20] = 0.0
    at[0, 20:23], at[1, 23:26] = np.nan, [-1.0, np.nan, -0.5]
    numbers, found = outcome_of_arrays(kind, constant, at), played(recorded(kind, constant), at)
    for name, expected in numbers.items():
        size = np.nanmax(np.abs(expected)) if name == "deflection" else np.abs(expected)
        error = np.abs(found[name] - expected)
        assert np.array_equal(np.isnan(found[name]), np.isnan(expected)), name
        # what is left just before lift-off is the difference of two displacements
        assert np.nanmax(error - 1e-12 * size - 1e-12 * np.nanmax(np.abs(expected))) <= 0, name


def outcome_of_arrays(kind, constant, at):
    """The outcome of arrays, where a constructor does not refuse what a recording may meet."""
    given = at.copy()
    refused = ~(given[1] >= 0)
    given[1] = np.where(refused, 1.0, given[1])
    found = outcome(kind, constant, *given)
    answered = refused if kind != "single" else np.zeros_like(refused)
    absent = {name for name, value in found.items() if np.ndim(value) == 0}
    return {
        name: value + 0 * given[3] if name in absent else np.where(answered, np.nan, value)
        for name, value in found.items()
    }


@functools.cache
def slopes_there(kind, constant):
    """Points, all derivatives there, and the numbers themselves."""
    at = points(300, kind, away=0.05)
    if kind == "single":
        at[0] = np.where(at[0] == 0, 1.0, at[0])
    return at, played(recorded(kind, constant, slopes=True), at), outcome(kind, constant, *at)


@pytest.mark.slow
@pytest.mark.parametrize("constant", [False, True])
@pytest.mark.parametrize(
    ("kind", "by"),
    [one for one in itertools.product(["single", "oversize", "double"], INPUTS) if one != ("single", "preload")],
)
def test_derivatives_are_those_of_differences(kind, constant, by):
    """To 1e-7 of the derivative and of the quantity over its input; a difference over ±1e-4, twice, is good to 1e-10.

    Without load, too, where it is the derivative from both sides.
    """
    (at, slopes, numbers), row = slopes_there(kind, constant), INPUTS.index(by)
    scale = np.maximum(np.abs(at[row]), at[1] if by == "load" and kind != "single" else 0.0)

    def differences(step):
        more, less = at.copy(), at.copy()
        more[row], less[row] = at[row] + step * scale, at[row] - step * scale
        above, below = outcome(kind, constant, *more), outcome(kind, constant, *less)
        return {name: (above[name] - below[name]) / (2 * step * scale) for name in above}

    ones, twos = differences(1e-4), differences(2e-4)
    for name, value in numbers.items():
        one, two = ones[name] + 0 * at[0], twos[name] + 0 * at[0]
        expected = one + (one - two) / 3
        # without a number there is no slope: 1e-300 of nothing
        size = np.abs(expected) + np.max(np.abs(value)) / scale + 1e-300
        error = np.abs(slopes[f"{name} by {by}"] - expected) / size
        # either sign of the load relieves a flank
        kink = (at[0] == 0) & (name == "remaining_preload") & (by == "load")
        assert np.max(error[~kink]) <= 1e-7, name


@pytest.mark.parametrize("kind", ["single", "oversize", "double"])
def test_no_derivative_is_undefined(kind):
    """Without load, without preload, without both, and where the other flanks just lift off."""
    at = points(4, kind)
    lift = outcome(kind, False, 0.0, *at[1:])["lift_off_load"] + 0 * at[0]
    at[0] = [0.0, 500.0, 0.0, lift[3]]
    at[1, 1:3] = 0.0
    for name, slope in played(recorded(kind, False, slopes=True), at).items():
        if "rigidity" not in name:  # that of no balls pressed is a root
            assert np.all(np.isfinite(slope)), name


def test_a_single_nut_shares_the_first_newton_alike():
    """At no load each ball's load rises with 1/(z sin α cos φ)."""
    at = np.array([[0.0], [0.0], [math.pi / 4], [3.175e-3]])
    slope = played(recorded("single", False, slopes=True), at)["forward_load 0 by load"][0]
    screw_angle = math.atan(0.010 / (math.pi * 0.040))
    assert slope == pytest.approx(1 / (56 * math.sin(math.pi / 4) * math.cos(screw_angle)), rel=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["single", "oversize", "double"])
def test_jax_gives_the_numbers_and_the_derivatives(kind):
    """By load and preload, reverse mode, without load and beyond lift-off, too."""
    import jax  # 100 MB
    import jax.numpy as jnp

    at = points(12, kind, away=0.05)
    at[2:] = at[2:, :1]
    lift = 0 * at[0] + outcome(kind, False, 0.0, *at[1:])["lift_off_load"] if kind != "single" else at[1]
    at[0] = lift * np.array([0, 0.1, 0.5, 0.9, 1.2, 5, 0, -0.1, -0.5, -0.9, -1.2, -5])
    expected, slopes = outcome(kind, False, *at), played(recorded(kind, False, slopes=True), at)
    with jax.enable_x64(True):
        found, back = jax.vjp(lambda *forces: outcome(kind, False, *forces, *at[2:, 0]), *map(jnp.asarray, at[:2]))
        for name, value in expected.items():
            assert np.max(np.abs(np.asarray(found[name]) - value)) <= 1e-12 * np.max(np.abs(value)), name
        for name in ("forward_load 0", "deflection"):
            ones = {each: jnp.ones_like(value) * (each == name) for each, value in found.items()}
            for by, slope in zip(INPUTS, back(ones), strict=False):
                mine = slopes[f"{name} by {by}"]
                size = np.abs(mine) + np.max(np.abs(expected[name])) / at[1]
                assert np.max(np.abs(np.asarray(slope) - mine) / size) <= 1e-9, (name, by)


def test_bodies_of_no_matter_are_not_asked_for():
    """Kinds for rigid nuts, balls one by one for all others; the same attributes of both."""
    case = nut_case("double", 3, 1, elastic=True, balls=4)
    rigid, elastic = (ball_loads(case.screw, case.nut, case.load, bodies=bodies) for bodies in (None, case.bodies))
    assert isinstance(case.bodies, Bodies)
    assert (rigid.one_by_one, elastic.one_by_one) == (False, True)
    assert (len(rigid.kinds), len(elastic.kinds)) == (2, 1)
    assert rigid.forward_load.shape == rigid.balls.shape == (3, 2)
    assert elastic.forward_load.shape == elastic.balls.shape == (3, 8)
    assert np.all(rigid.balls == 4)
    assert np.all(elastic.balls == 1)
