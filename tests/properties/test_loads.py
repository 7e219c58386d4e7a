"""Laws of physics that the loads of the balls obey, on ten thousand random nuts."""

import dataclasses
import itertools
import math

import numpy as np
import pytest

from ballscrew.basis.quantities import quantities_of
from ballscrew.physics.components.nut import Deviations, DoubleNut, OversizeBallNut, SingleNut
from ballscrew.physics.solvers.ball_springs import BallSprings, Flanks
from ballscrew.physics.solvers.load_distribution import TOLERANCE, BallLoads, ball_loads, radial_stiffness
from support.nut_cases import KINDS, nut_case

#: 4 kinds × elastic or not × scatter or not × side, and this many points of each: ten thousand and more.
POINTS = 330
VARIANTS = [
    {"kind": kind, "elastic": elastic, "scatter": scatter, "same_side": same_side}
    for kind, elastic, scatter, same_side in itertools.product(KINDS, (False, True), (False, True), (True, False))
]
NAMES = ["-".join(str(value) for value in variant.values()) for variant in VARIANTS]
#: Force that stiff bodies make of a place's rounding where nothing is there to carry.
NOTHING = 1e-6


def solved(case, **changed):
    values = {"bodies": case.bodies, "deviations": case.deviations, **changed}
    load = values.pop("load", case.load)
    return ball_loads(values.pop("screw", case.screw), values.pop("nut", case.nut), load, **values)


def of_variants(condition):
    """A test of the points of those variants only."""
    numbers = [number for number, variant in enumerate(VARIANTS) if condition(variant)]
    return pytest.mark.parametrize("drawn", numbers, ids=[NAMES[i] for i in numbers], indirect=True, scope="module")


@pytest.fixture(scope="module", params=range(len(VARIANTS)), ids=NAMES)
def drawn(request):
    case = nut_case(size=POINTS, seed=100 + request.param, **VARIANTS[request.param])
    return case, solved(case)


def axial(r, screw):
    """What balls put on the screw by their forward and by their backward flanks."""
    c_phi = np.cos(screw.lead_angle)
    forward = np.sum(r.balls * r.forward_load * np.sin(r.forward_angle), axis=-1) * c_phi
    return forward, np.sum(r.balls * r.backward_load * np.sin(r.backward_angle), axis=-1) * c_phi


# -- balance ---------------------------------------------------------------------------------------


def test_balls_balance_the_load(drawn):
    """Σ Q sin α cos φ over all balls is the load; 1e-10 of load and preload, the tolerance of the solver."""
    case, r = drawn
    forward, backward = axial(r, case.screw)
    assert np.all(np.abs(forward - backward - case.load) <= TOLERANCE * (forward + backward) + NOTHING)
    assert np.all(np.abs(backward - r.remaining_preload) <= 1e-12 * (forward + backward) + NOTHING)
    assert np.all(r.converged)


@pytest.mark.slow
def test_everything_is_a_number(drawn):
    _, r = drawn
    for name in (*quantities_of(BallLoads), "balls"):
        assert np.all(np.isfinite(getattr(r, name))), name


@pytest.mark.slow
def test_balls_are_pressed_and_never_pulled(drawn):
    case, r = drawn
    size = case.load + case.preload
    assert np.all(r.forward_load >= 0)
    assert np.all(r.backward_load >= 0)
    assert np.all(r.remaining_preload >= 0)
    for load, angle in ((r.forward_load, r.forward_angle), (r.backward_load, r.backward_angle)):
        assert np.all((angle[load > 0] > 0) & (angle[load > 0] < math.pi / 2))
    # a load pushes the screw in; 1e-13 of the heaviest preload moves a stiff nut by some 1e-16 m
    assert np.all(r.deflection >= -1e-15)
    assert np.all(r.deflection[(case.load == 0) & (case.preload > 0)] <= 1e-15)
    assert np.all(r.rigidity[size > 0] > 0)


@pytest.mark.slow
@of_variants(lambda variant: variant["kind"] != "single")
def test_without_load_the_halves_hold_each_other(drawn):
    """Invariant 22: at F = 0 both halves carry the preload; oversize balls scatter around it."""
    case, _ = drawn
    r = solved(case, load=0 * case.load)
    forward, backward = axial(r, case.screw)
    assert np.all(np.abs(forward - backward) <= TOLERANCE * (forward + backward) + NOTHING)
    if case.deviations is None or not isinstance(case.nut, OversizeBallNut):
        assert np.all(np.abs(forward - case.preload) <= TOLERANCE * case.preload + NOTHING)


@pytest.mark.slow
def test_nothing_without_load_and_preload(drawn):
    case, _ = drawn
    nut = case.nut if isinstance(case.nut, SingleNut) else dataclasses.replace(case.nut, preload=0.0)
    r = solved(case, load=0 * case.load, nut=nut)
    # oversize balls that scatter brace each other
    if case.deviations is None or not isinstance(nut, OversizeBallNut):
        forward, backward = axial(r, case.screw)
        assert np.all(forward + backward <= NOTHING)
    # nothing holds the place
    assert np.all(np.abs(r.deflection) <= 1e-10)


# -- symmetries ------------------------------------------------------------------------------------


@pytest.mark.slow
def test_an_array_is_a_row_of_numbers(drawn):
    """Neighbours in an array change nothing but the order of a sum: 1e-11 of the forces.

    Elastic bodies pass what rounding leaves of a place on to their balls, in both.
    """
    case, r = drawn
    for i in range(0, POINTS, 66):
        one = solved(case.one(i))
        forces = case.load[i] + case.preload[i] + np.max(r.forward_load[i])
        for name in ("forward_load", "backward_load"):
            assert np.max(np.abs(getattr(one, name) - getattr(r, name)[i])) <= 1e-11 * forces, name
        assert abs(one.deflection - r.deflection[i]) <= 1e-11 * r.deflection[i] + 1e-17


def test_two_supports_on_opposite_sides_read_the_chain_from_either_end():
    """With screw and nut of one stiffness (E A), the chain reversed is the same: loads mirrored."""
    case = nut_case("single", 50, 3, elastic=True, same_side=False, scatter=True, balls=23)
    tube = np.sqrt(case.bodies.screw_diameter**2 + case.bodies.nut_inner_diameter**2)
    equal = dataclasses.replace(case.bodies, nut_outer_diameter=tube)
    there, back = (
        solved(case, bodies=equal, deviations=Deviations(*(part[::step] for part in case.deviations)))
        for step in (1, -1)
    )
    largest = np.max(there.forward_load, axis=-1, keepdims=True)
    assert (
        np.max(np.abs(there.forward_load - back.forward_load[..., ::-1]) / np.where(largest > 0, largest, 1)) <= 1e-10
    )
    assert np.max(np.abs(there.deflection - back.deflection)) <= 1e-15
    # unequal, they are not
    one, other = (solved(case, deviations=Deviations(*(part[::step] for part in case.deviations))) for step in (1, -1))
    assert np.max(np.abs(one.deflection - other.deflection)) > 1e-9


@pytest.mark.parametrize("kind", ["single", "oversize"])
def test_on_rigid_bodies_the_order_of_the_balls_is_nothing(kind):
    """Invariant 21: permutation of the balls permutes their loads."""
    case = nut_case(kind, 100, 4, elastic=False, scatter=True, balls=31)
    order = np.random.default_rng(0).permutation(31)
    r, mixed = solved(case), solved(case, deviations=Deviations(*(part[order] for part in case.deviations)))
    size = np.max(r.forward_load, axis=-1, keepdims=True) + 1e-9
    assert np.max(np.abs(r.forward_load[..., order] - mixed.forward_load) / size) <= 1e-10
    assert np.max(np.abs(r.backward_load[..., order] - mixed.backward_load) / size) <= 1e-10


def test_a_common_error_of_the_lead_is_a_shift():
    """All balls displaced alike: a single nut touches later, and carries as before."""
    case = nut_case("single", 100, 5, elastic=True, balls=20)
    r, shifted = solved(case), solved(case, deviations=Deviations(lead=2e-6))
    size = np.max(r.forward_load, axis=-1, keepdims=True) + 1e-9
    assert np.max(np.abs(r.forward_load - shifted.forward_load) / size) <= 1e-9
    assert np.max(np.abs(r.deflection - shifted.deflection)) <= 1e-15


@pytest.mark.slow
@pytest.mark.parametrize("variant", VARIANTS, ids=NAMES)
def test_units_do_not_matter(variant):
    """Lengths a thousandfold, forces a million: E in N/m² is in the same number."""
    case = nut_case(size=60, seed=9, balls=17, **variant)
    larger = {name: 1e3 * getattr(case.screw, name) for name in ("pitch_circle_diameter", "lead", "ball_diameter")}
    nut = case.nut
    if not isinstance(nut, SingleNut):
        nut = dataclasses.replace(nut, preload=1e6 * nut.preload)
    if hasattr(nut, "spacing"):
        nut = dataclasses.replace(nut, spacing=1e3 * nut.spacing)
    bodies = case.bodies and dataclasses.replace(
        case.bodies,
        **{name: 1e3 * getattr(case.bodies, name) for name in vars(case.bodies) if name.endswith("diameter")},
    )
    deviations = case.deviations and Deviations(*(1e3 * part for part in case.deviations))
    screw = dataclasses.replace(case.screw, **larger)
    r = solved(case)
    s = solved(case, screw=screw, nut=nut, load=1e6 * case.load, bodies=bodies, deviations=deviations)
    forces = (case.load + case.preload)[:, None] + 1e-9
    assert np.max(np.abs(s.forward_load / 1e6 - r.forward_load) / forces) <= 1e-9
    assert np.max(np.abs(s.backward_load / 1e6 - r.backward_load) / forces) <= 1e-9
    assert np.max(np.abs(s.deflection / 1e3 - r.deflection)) <= 1e-15
    assert s.lift_off_load / 1e6 == pytest.approx(r.lift_off_load, rel=1e-9, abs=1e-9 * np.max(forces))


# -- stiffness -------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("variant", VARIANTS, ids=NAMES)
def test_rigidity_is_the_slope_of_load_over_deflection(variant):
    """A central difference over ±1e-4 of the load: errors of 1e-8, where no ball touches or leaves in between."""
    case = nut_case(size=60, seed=11, balls=12, **variant)
    loads = np.maximum(case.load, 1e-3 * case.load.max())
    r, less, more = (solved(case, load=(1 + step) * loads) for step in (0.0, -1e-4, 1e-4))
    slope = 2e-4 * loads / (more.deflection - less.deflection)
    touches = [
        np.count_nonzero(state.forward_load, axis=-1) + np.count_nonzero(state.backward_load, axis=-1)
        for state in (less, more)
    ]
    steady = touches[0] == touches[1]
    assert np.mean(steady) > 0.8
    # a hardly pressed ball bends the curve within the step, and a stiff nut moves by no more than rounding
    error = np.abs(slope / r.rigidity - 1)[steady]
    assert np.median(error) <= 1e-8
    assert np.max(error) <= 1e-3


@pytest.mark.slow
@pytest.mark.parametrize("variant", VARIANTS, ids=NAMES)
def test_more_load_presses_more(variant):
    """Deflection, the sum of the forward loads, and what is left of the preload are monotone in the load."""
    case = nut_case(size=20, seed=12, balls=9, **variant)
    loads = case.load.max() * np.linspace(0, 1, 41)[:, None] + 0 * case.load
    r = solved(case, load=loads)
    forward, backward = axial(r, case.screw)
    size = forward[-1]
    assert np.all(np.diff(r.deflection, axis=0) > -1e-16)
    assert np.all(np.diff(forward, axis=0) > 0)
    assert np.all(np.diff(backward, axis=0) <= 1e-10 * size)
    if case.bodies is None:
        # rigid bodies leave no ball out
        assert np.all(np.diff(r.forward_load, axis=0) >= -1e-10 * size[:, None])


@of_variants(lambda variant: variant["kind"] == "single" and variant["elastic"])
def test_bodies_only_give_way(drawn):
    """Not so with two halves: where rigid bodies have lifted one of them off, elastic ones may not have yet."""
    case, r = drawn
    rigid = solved(case, bodies=None)
    assert np.all(r.rigidity[case.load > 0] < rigid.rigidity[case.load > 0] * (1 + 1e-12))
    assert np.all(r.deflection >= rigid.deflection - 1e-16)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("scatter", [False, True])
def test_stiff_bodies_are_rigid(kind, scatter):
    """The difference goes with one over the stiffness of the bodies."""
    case = nut_case(kind, 40, 13, elastic=True, scatter=scatter, balls=14)
    rigid = solved(case, bodies=None, deviations=case.deviations or Deviations())
    hold = np.maximum(case.load + case.preload, 1e-3 * np.max(case.load))[:, None]

    def difference(stiffer):
        # E A grows with the square of the diameters: what a bar is called is of no matter to its balls
        wider = {name: stiffer * getattr(case.bodies, name) for name in vars(case.bodies) if name.endswith("diameter")}
        r = solved(case, bodies=dataclasses.replace(case.bodies, **wider, swelling=False))
        return np.max(np.abs(r.forward_load - rigid.forward_load) / hold)

    some, few = difference(30), difference(300)
    assert few <= 1e-4
    assert few <= 0.015 * some


# -- preload ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("constant", [False, True])
@pytest.mark.parametrize("scatter", [False, True])
@pytest.mark.parametrize("kind", ["oversize", "double", "offset"])
def test_the_other_flanks_lift_off_at_the_lift_off_load(kind, scatter, constant):
    """Rigid bodies: just pressed below, free from there on."""
    case = nut_case(kind, 100, 14, elastic=False, scatter=scatter, balls=8)
    if not isinstance(case.nut, OversizeBallNut) or not scatter:
        case = dataclasses.replace(case, nut=dataclasses.replace(case.nut, preload=np.maximum(case.preload, 1.0)))
    lift = solved(case, constant_contact_angle=constant).lift_off_load
    at, below, above = (
        solved(case, load=np.maximum(step * lift, 0), constant_contact_angle=constant)
        for step in (1.0, 1 - 1e-5, 1 + 1e-5)
    )
    # flanks that a scatter has set free before any load, lift off at less than none
    braced = lift > 0
    assert np.mean(braced) > 0.5
    assert np.all(below.remaining_preload[braced] > 0)
    assert np.all(above.remaining_preload[braced] == 0)
    assert np.all(np.abs(at.remaining_preload)[braced] <= 1e-9 * lift[braced])


@pytest.mark.slow
@pytest.mark.parametrize("constant", [False, True])
@pytest.mark.parametrize("same_side", [None, True, False])
@pytest.mark.parametrize("scatter", [False, True])
def test_beyond_lift_off_an_oversize_nut_is_a_single_nut_with_interference(scatter, same_side, constant):
    """Balls too big by e load the forward flanks alone; only the place from which one counts differs.

    The single nut counts from its first touch, the other from where both flanks are alike.
    """
    elastic = same_side is not None
    case = nut_case("oversize", 100, 15, elastic=elastic, same_side=bool(same_side), scatter=scatter, balls=10)
    c_phi, alpha, z = np.cos(case.screw.lead_angle), case.screw.contact_angle, case.screw.loaded_balls
    compared = 0
    for i in range(0, 100, 5):
        one = case.one(i)
        preload = max(float(one.preload), 1.0)
        nut, load = OversizeBallNut(preload), max(one.load, 4 * preload)
        excess = (preload / (z * math.sin(alpha[i]) * c_phi[i])) ** (2 / 3) / pair_constant(one.screw) ** (2 / 3)
        if elastic:  # bodies that swell need more oversize for a preload than rigid ones
            nut = OversizeBallNut(oversize=excess)
        r = solved(one, nut=nut, load=load, constant_contact_angle=constant)
        if np.any(r.backward_load > 0):
            continue
        scattered = one.deviations or Deviations(np.zeros(10), 0.0)
        # ball by ball, or all as one
        bigger = Deviations(scattered.ball_diameter + excess, scattered.lead)
        single = solved(one, nut=SingleNut(), load=load, deviations=bigger, constant_contact_angle=constant)
        assert r.forward_load + 0 * single.forward_load == pytest.approx(single.forward_load, rel=1e-8)
        assert r.forward_angle + 0 * single.forward_load == pytest.approx(single.forward_angle, rel=1e-9)
        assert r.rigidity == pytest.approx(single.rigidity, rel=1e-8)
        assert single.deflection > r.deflection
        compared += 1
    assert compared >= 5


def pair_constant(screw):
    """Load over approach to the power of one and a half, from what one newton lets a rigid single nut approach."""
    one = dataclasses.replace(screw, loaded_balls=1)
    r = ball_loads(one, SingleNut(), 1.0, constant_contact_angle=True)
    approach = r.deflection * math.cos(screw.lead_angle) * math.sin(screw.contact_angle)
    return float(r.forward_load[0]) / approach**1.5


def test_halves_far_apart_and_near_carry_alike_on_rigid_bodies():
    case = nut_case("double", 100, 16, elastic=False, balls=6)
    near = solved(case, nut=DoubleNut(case.preload, 0.0))
    far = solved(case)
    assert np.array_equal(near.forward_load, far.forward_load)
    assert np.array_equal(near.deflection, far.deflection)


@pytest.mark.parametrize("kind", ["oversize", "double"])
def test_the_work_of_the_load_is_stored_in_balls_and_rings(kind):
    """Energy with swelling: ∫F dx from rest is Σ 2/5 Q δ of the balls and ½ N²/k_r of the rings; bars are stiff."""
    case = nut_case(kind, 1, 31, elastic=True, balls=12).one(0)
    preload = float(case.preload)
    bodies = dataclasses.replace(case.bodies, screw_diameter=1e3, nut_inner_diameter=1e-6)
    k_r, K = float(radial_stiffness(case.screw, bodies)), pair_constant(case.screw)

    def stored(r):
        loads, angles = (
            np.stack([getattr(r, f"{side}_{what}") for side in ("forward", "backward")]) for what in ("load", "angle")
        )
        radial = loads * np.where(loads > 0, np.cos(angles), 0.0)
        halves = radial.sum(axis=0).reshape(case.nut.halves, -1).sum(axis=1)
        return np.sum(0.4 * loads ** (5 / 3) / K ** (2 / 3)) + np.sum(halves**2) / (2 * k_r)

    nodes, weights = np.polynomial.legendre.leggauss(12)
    loads = np.append(0.75 * preload * (nodes + 1), [0.0, 1.5 * preload])
    results = [solved(case, load=float(load), bodies=bodies) for load in loads]
    # ∫F dx = F x at the end less ∫x dF
    within = 0.75 * preload * np.sum(weights * [float(r.deflection) for r in results[:-2]])
    work = 1.5 * preload * float(results[-1].deflection) - within
    assert work == pytest.approx(stored(results[-1]) - stored(results[-2]), rel=2e-4)
    rigid = [solved(case, load=float(load), bodies=dataclasses.replace(bodies, swelling=False)) for load in loads[-2:]]
    assert float(rigid[1].deflection) < float(results[-1].deflection)


@pytest.mark.parametrize("kind", ["single", "double", "offset"])
def test_a_thinner_nut_gives_way_more(kind):
    """Not one with oversize balls: what a small load adds to one flank it takes from the other of the same ball."""
    case = nut_case(kind, 30, 33, elastic=True, balls=15)
    wide = solved(case, bodies=dataclasses.replace(case.bodies, nut_inner_diameter=1e-3))
    d_c = case.screw.pitch_circle_diameter + case.screw.ball_diameter
    thin_nut = dataclasses.replace(case.bodies, nut_inner_diameter=1e-3, nut_outer_diameter=1.05 * d_c)
    thin = solved(case, bodies=thin_nut)
    bars = solved(case, bodies=dataclasses.replace(case.bodies, nut_inner_diameter=1e-3, swelling=False))
    held = (case.load > 0) | (case.preload > 0)
    for stiffer, softer in ((bars, wide), (wide, thin)):
        assert np.all(softer.rigidity[held] < stiffer.rigidity[held] * (1 + 1e-9))


@pytest.mark.parametrize("constant_angle", [False, True])
def test_springs_in_widened_grooves_are_one_formula_of_displacement_and_gap(constant_angle):
    """Two balls with both flanks on two bodies; slopes are differences of the forces."""
    A, alpha = np.array([3e-4]), np.array([np.pi / 4])
    facing, excess = np.array([[1.0], [-1.0]]), np.array([[6e-6], [9e-6]])
    flanks = tuple(Flanks(sign * facing, 1e-6 * facing, excess) for sign in (1, -1))
    springs = BallSprings(np.array([6e9]), A, alpha, np.array([0.99]), np.array([1.0]), constant_angle, flanks)
    x, gap, body = np.array([[-2e-6, 0.0, 3e-6, 3e-5]] * 2), np.array([[1e-6] * 4, [3e-6] * 4]), np.arange(2)
    found, widened = springs.pushed_apart(x, gap), springs.widened(gap, body)
    push = widened.radial_push(x)
    for one, other in zip(found, (*widened.forces(x), push.force, push.slope, push.cross), strict=True):
        assert np.allclose(one, other, rtol=1e-9, atol=1e-12 * np.max(np.abs(other)))
    h = 1e-10
    ahead, back = springs.pushed_apart(x + h, gap), springs.pushed_apart(x - h, gap)
    wide, narrow = springs.pushed_apart(x, gap + h), springs.pushed_apart(x, gap - h)
    for slope, high, low in (
        (found.slope, ahead.force, back.force),
        (found.push_by_displacement, ahead.push, back.push),
        (found.push_by_opening, wide.push, narrow.push),
        (-found.push_by_displacement, wide.force, narrow.force),
    ):
        assert np.allclose(slope, (high - low) / (2 * h), rtol=1e-6, atol=1e-6 * np.max(np.abs(slope)))
