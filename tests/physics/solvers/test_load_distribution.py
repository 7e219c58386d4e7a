"""The loads of the balls: against a solution by other means, against closed forms, and for the paper's screw."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.optimize import root

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.basis.quantities import quantities_of
from ballscrew.evidence.papers.olaru2005.case import SCREW as PAPER
from ballscrew.physics.components.nut import Bodies, Deviations, DoubleNut, OffsetLeadNut, OversizeBallNut, SingleNut
from ballscrew.physics.equations import geometry, hertz, nut_losses
from ballscrew.physics.friction.loaded_balls import loads_of, loads_of_each
from ballscrew.physics.laws.frame import helix_frame
from ballscrew.physics.solvers import ball_springs, load_distribution
from ballscrew.physics.solvers.load_distribution import BallLoads, ball_loads, preload_of

STEEL = PAPER.ball_material
LOAD = 4000.0


def screw(**changes):
    return dataclasses.replace(PAPER, **changes)


# -- by other means --------------------------------------------------------------------------------


def approach_at_one_newton(part):
    """Approach of a ball between screw and nut under one newton; that of any load goes with its power of 2/3."""
    gamma, d_w, total = helix_frame(part).curvature_ratio, part.ball_diameter, 0.0
    for way, R_x in (
        (part.screw_raceway, geometry.screw_rolling_radius(d_w, gamma)),
        (part.nut_raceway, geometry.nut_rolling_radius(d_w, gamma)),
    ):
        k = geometry.radii_ratio(geometry.transverse_radius(d_w, way.conformity), R_x)
        kappa = hertz.ellipticity(k)
        integrals = hertz.elliptic_integrals(kappa)
        c_d = hertz.approach_coefficient(k, kappa, integrals.K, integrals.E)
        total += hertz.mutual_approach(c_d, R_x, 1.0 / (part.equivalent_modulus(way) * R_x**2))
    return total


@dataclasses.dataclass
class TwoBodies:
    """Screw and nut as two rows of nodes with bars between them, a ball between each pair of nodes.

    The screw is pushed at its first node; the nut is held at its first or at its last one. Unknown are the
    places of all nodes, what each half opens radially, and of a braced nut the gap between its halves. Nothing of the
    solver is used.
    """

    part: bs.BallScrew
    bodies: Bodies
    facing: np.ndarray
    both_flanks: bool
    excess: np.ndarray
    lead_error: np.ndarray
    spacing: float = 0.0

    def __post_init__(self):
        n, step = len(self.facing), self.part.ball_diameter * math.sin(self.part.lead_angle)
        self.lengths = np.full(n - 1, step)
        if np.any(self.facing < 0):
            self.lengths[n // 2 - 1] += self.spacing
        E, b = STEEL.young_modulus, self.bodies
        self.on_screw = E * math.pi / 4 * b.screw_diameter**2 / self.lengths
        self.on_nut = E * math.pi / 4 * (b.nut_outer_diameter**2 - b.nut_inner_diameter**2) / self.lengths
        self.held = 0 if b.same_side else n - 1
        self.softness = approach_at_one_newton(self.part)
        self.A = (self.part.screw_conformity + self.part.nut_conformity - 1) * self.part.ball_diameter
        # halves: the first n/2 balls and the others, or all
        self.halves = 2 if np.any(self.facing < 0) and np.any(self.facing > 0) else 1
        # Lamé: what a tube opens and a solid shaft shrinks by, by a pressure of one
        D, d, E, nu = b.nut_outer_diameter, self.part.pitch_circle_diameter, STEEL.young_modulus, 0.3
        d_c, D_c = (d + sign * self.part.ball_diameter * math.cos(self.part.contact_angle) for sign in (-1, 1))
        tube = D_c / 2 / E * ((D**2 + D_c**2) / (D**2 - D_c**2) + nu)
        area = math.pi * step * n / self.halves
        self.opening = (tube / (area * D_c) + d_c / 2 / E * (1 - nu) / (area * d_c)) if b.swelling else 0.0

    def flank(self, facing, apart, gap, opened):
        """Load, axial and radial force of one flank pair each."""
        alpha, c_phi = self.part.contact_angle, math.cos(self.part.lead_angle)
        xi = facing * (apart - self.lead_error - np.where(self.facing < 0, gap, 0.0)) * c_phi
        across = self.A * math.cos(alpha) - opened
        s = np.hypot(across, self.A * math.sin(alpha) + xi)
        # beyond the radial plane there is no flank
        delta = np.where(self.A * math.sin(alpha) + xi > 0, np.maximum(s - self.A + self.excess, 0.0), 0.0)
        load = (delta / self.softness) ** 1.5
        return load, facing * load * (self.A * math.sin(alpha) + xi) / s * c_phi, load * across / s

    def balls(self, apart, gap, opened):
        by_ball = np.repeat(opened, len(self.facing) // self.halves)
        pairs = [self.flank(self.facing, apart, gap, by_ball)]
        if self.both_flanks:
            pairs.append(self.flank(-self.facing, apart, gap, by_ball))
        return pairs

    def left(self, on_screw, on_nut, gap, opened, force):
        """Forces left at the nodes of screw and nut, at the held node its place, and what is left of the openings."""
        pairs = self.balls(on_screw - on_nut, gap, opened)
        through, radial = sum(pair[1] for pair in pairs), sum(pair[2] for pair in pairs)
        at_screw, at_nut = -through, through.copy()
        at_screw[0] += force
        for at, places, bars in ((at_screw, on_screw, self.on_screw), (at_nut, on_nut, self.on_nut)):
            passed = bars * np.diff(places)
            at[:-1] += passed
            at[1:] -= passed
        at_nut[self.held] = on_nut[self.held] * 1e9
        openings = (opened - self.opening * radial.reshape(self.halves, -1).sum(axis=1)) * 1e9
        return np.concatenate([at_screw, at_nut, openings])

    def solve(self, force, braced_by=None, gap=0.0):
        """Places of screw and nut, the gap, and what opens; with a preload the gap is found."""
        n, um = len(self.facing), 1e-6
        last = 2 * n + self.halves
        start = (-2.0 if force < 0 else 2.0) * np.ones(last + (braced_by is not None))
        start[n:] = 0.0
        if braced_by is not None:
            start[: n // 2], start[n // 2 : n], start[-1] = 2.0, 0.0, 4.0

        def left(unknowns):
            x = unknowns * um
            free_gap = x[-1] if braced_by is not None else gap
            found = self.left(x[:n], x[n : 2 * n], free_gap, x[2 * n : last], force)
            if braced_by is None:
                return found
            pairs = self.balls(x[:n] - x[n : 2 * n], free_gap, x[2 * n : last])
            return np.append(found, sum(pair[1][self.facing > 0].sum() for pair in pairs) - braced_by)

        for _ in range(30):
            step = root(left, start, method="hybr", options={"xtol": 1e-14, "maxfev": 20_000})
            if np.max(np.abs(step.fun)) < 1e-7:
                break
            start = step.x
        assert np.max(np.abs(step.fun)) < 1e-5
        x = step.x * um
        return x[:n], x[n : 2 * n], x[-1] if braced_by is not None else gap, x[2 * n : last]

    def excess_of(self, preload):
        """What balls on both flanks, all alike, are too big by to carry a preload on each without load."""
        balls, alpha, c_phi = len(self.facing), self.part.contact_angle, math.cos(self.part.lead_angle)

        def left(unknowns):
            opened, excess = unknowns * 1e-6
            across, along = self.A * math.cos(alpha) - opened, self.A * math.sin(alpha)
            s = math.hypot(across, along)
            load = (max(s - self.A + excess, 0.0) / self.softness) ** 1.5
            return [
                balls * load * along / s * c_phi - preload,
                (opened - 2 * balls * self.opening * load * across / s) * 1e9,
            ]

        return root(left, [0.1, 2.0], options={"xtol": 1e-14}).x[1] * 1e-6


def scattered(balls, seed):
    return Deviations.scattered(balls, seed=seed, ball_diameter=3e-7, lead=4e-7)


@pytest.mark.slow
@pytest.mark.implausible
@pytest.mark.parametrize("swelling", [False, True])
@pytest.mark.parametrize("same_side", [True, False])
@pytest.mark.parametrize("scatter", [False, True])
@pytest.mark.parametrize("nut", [SingleNut(), OversizeBallNut(180.0), DoubleNut(180.0, 0.03), OffsetLeadNut(180.0)])
@pytest.mark.parametrize("load", [60.0, 700.0, -60.0, -700.0])
def test_two_elastic_bodies_node_by_node(nut, scatter, same_side, swelling, load):
    """Seven balls, bodies so thin that loads differ by half: places, loads, angles, deflection and rigidity.

    A load of the other sign presses on the other flanks of a single nut.
    """
    part = screw(loaded_balls=7, lead=0.040, screw_conformity=0.56, nut_conformity=0.56)
    halves = 2 if isinstance(nut, DoubleNut | OffsetLeadNut) else 1
    n = 7 * halves
    bodies = Bodies(
        screw_diameter=5e-4,
        nut_outer_diameter=0.0440030,
        nut_inner_diameter=0.0440,
        same_side=same_side,
        swelling=swelling,
    )
    deviations = scattered(n, 5) if scatter else Deviations(np.zeros(n), np.zeros(n))
    excess = deviations.ball_diameter.copy()
    model = TwoBodies(
        part,
        bodies,
        facing=np.where(np.arange(n) < 7, 1.0, -1.0) * (-1.0 if isinstance(nut, SingleNut) and load < 0 else 1.0),
        both_flanks=isinstance(nut, OversizeBallNut),
        excess=excess,
        lead_error=deviations.lead,
        spacing=getattr(nut, "spacing", 0.0),
    )
    if isinstance(nut, OversizeBallNut):
        excess += model.excess_of(180.0)
    gap, rest = 0.0, 0.0
    if halves == 2:
        *braced, gap, _ = model.solve(0.0, braced_by=180.0)
        rest = braced[0][0] - braced[1][model.held]
    elif isinstance(nut, OversizeBallNut):
        braced = model.solve(0.0)
        rest = braced[0][0] - braced[1][model.held]
    else:
        s, A, alpha = model.A - excess, model.A, math.pi / 4
        touch = np.sqrt(s**2 - (A * math.cos(alpha)) ** 2) - A * math.sin(alpha)
        side = np.sign(load)
        rest = side * np.min(touch / math.cos(part.lead_angle) + side * deviations.lead)

    def state(force):
        on_screw, on_nut, _, opened = model.solve(force, gap=gap)
        return on_screw[0] - on_nut[model.held] - rest, model.balls(on_screw - on_nut, gap, opened)

    r = ball_loads(part, nut, load, bodies=bodies, deviations=deviations)
    travel, pairs = state(load)
    forward = pairs[0][0] * (model.facing > 0)
    backward = pairs[1][0] if isinstance(nut, OversizeBallNut) else pairs[0][0] * (model.facing < 0)
    most = max(forward, backward, key=np.max)
    # the other solver leaves 1e-5 N
    assert r.forward_load == pytest.approx(forward, abs=1e-4)
    assert r.backward_load == pytest.approx(backward, abs=1e-4)
    assert r.deflection == pytest.approx(travel, rel=1e-6, abs=1e-12)
    slope = 0.02 * load / (state(1.01 * load)[0] - state(0.99 * load)[0])
    assert r.rigidity == pytest.approx(slope, rel=2e-3)
    assert np.max(most) / np.mean(most[most > 0]) > 1.1


# -- closed forms ----------------------------------------------------------------------------------


def test_balls_alike_share_alike():
    r = ball_loads(PAPER, SingleNut(), LOAD)
    assert r.balls == 56
    assert r.forward_load.shape == (1,)
    share = LOAD / (56 * math.sin(r.forward_angle[0]) * math.cos(PAPER.lead_angle))
    assert r.forward_load[0] == pytest.approx(share, rel=1e-12)
    one_by_one = ball_loads(PAPER, SingleNut(), LOAD, deviations=Deviations())
    assert one_by_one.forward_load == pytest.approx(np.full(56, r.forward_load[0]), rel=1e-12)


@pytest.mark.parametrize("same_side", [True, False])
def test_one_ball_knows_no_bars(same_side):
    part = screw(loaded_balls=1)
    rigid = ball_loads(part, SingleNut(), 80.0)
    elastic = ball_loads(part, SingleNut(), 80.0, bodies=Bodies(same_side=same_side, swelling=False))
    assert elastic.forward_load == pytest.approx(rigid.forward_load, rel=1e-12)
    assert elastic.deflection == pytest.approx(rigid.deflection, rel=1e-12)
    assert elastic.rigidity == pytest.approx(rigid.rigidity, rel=1e-12)


def test_deflection_at_a_constant_angle_is_that_of_hertz():
    """x = δ/(sin α cos φ), and the rigidity 1.5 F/x."""
    r = ball_loads(PAPER, SingleNut(), LOAD, constant_contact_angle=True)
    lever = math.sin(math.pi / 4) * math.cos(PAPER.lead_angle)
    assert r.forward_angle[0] == pytest.approx(math.pi / 4, rel=1e-15)
    approach = approach_at_one_newton(PAPER) * (LOAD / 56 / lever) ** (2 / 3)
    assert r.deflection == pytest.approx(approach / lever, rel=1e-12)
    assert r.rigidity == pytest.approx(1.5 * LOAD / r.deflection, rel=1e-12)


@pytest.mark.parametrize("nut", [DoubleNut(500.0, 0.01), OffsetLeadNut(500.0), OversizeBallNut(500.0)])
def test_two_sides_braced_against_each_other(nut):
    """At a constant angle every preloaded nut is F_pr (1 + x)^1.5 against F_pr (1 − x)^1.5, up to 2^1.5 F_pr."""
    lever = math.sin(math.pi / 4) * math.cos(PAPER.lead_angle)
    unit = approach_at_one_newton(PAPER) * (500 / 56 / lever) ** (2 / 3) / lever
    loads = 500 * np.array([0.0, 0.1, 1.0, 2.0, 2.8, 3.5, 6.0])
    r = ball_loads(PAPER, nut, loads, constant_contact_angle=True)
    x = r.deflection / unit
    assert r.remaining_preload == pytest.approx(nut_losses.backward_half_load(500.0, x), rel=1e-10, abs=1e-10)
    assert r.remaining_preload + loads == pytest.approx(nut_losses.forward_half_load(500.0, x), rel=1e-11)
    assert r.remaining_preload[0] == pytest.approx(500.0, rel=1e-12)
    assert np.all(r.remaining_preload[-2:] == 0)
    assert r.lift_off_load == pytest.approx(np.full(7, nut_losses.lift_off_load(500.0)), rel=1e-12)
    # two springs of one stiffness without load, one beyond lift-off
    assert r.rigidity[0] == pytest.approx(3 * 500 / unit, rel=1e-10)


@pytest.mark.parametrize("nut", [DoubleNut, OversizeBallNut])
def test_a_contact_angle_that_rises_puts_lift_off_further_away(nut):
    """More than 2^1.5, and more with more preload: 4 to 5 % with 1 kN on the paper's screw, none in the limit."""
    forces = np.array([1e-3, 10.0, 1000.0])
    ratio = ball_loads(PAPER, nut(forces), 0.0).lift_off_load / nut_losses.lift_off_load(forces)
    assert np.all(np.diff(ratio) > 0)
    assert ratio[0] == pytest.approx(1.0, abs=1e-5)
    assert 1.03 < ratio[2] < 1.05


SMALL = bs.catalogue()["rexroth-25x5x3-4-double"]
#: 6 % of the dynamic load rating.
BRACED = DoubleNut(preload=954.0, bodies=Bodies())


def loads_of_small(load, nut=BRACED):
    part = SMALL.screw(nut=nut)
    return ball_loads(part, nut, load, bodies=nut.bodies and nut.bodies.sized(part))


def test_balls_between_elastic_bodies_leave_one_after_the_other_up_to_the_lift_off_load():
    """25×5, 6 % of C: at another load backwards (2400 to 2600 N) than forwards (2800 to 3000 N); rigid ones at 2738."""
    for sign, bracket, relieved in ((-1.0, (2400.0, 2602.0), "forward"), (1.0, (2800.0, 3000.0), "backward")):
        found = loads_of_small(sign * 100.0)
        limit = float(found.lift_off_load)
        assert bracket[0] < limit < bracket[1]
        assert found.rigid_lift_off_load == pytest.approx(2738, abs=0.5)
        below, above = (loads_of_small(sign * limit * (1 + part)) for part in (-1e-6, 1e-6))
        assert np.count_nonzero(getattr(below, f"{relieved}_load")) >= 1
        assert 0 < float(below.remaining_preload) < 1e-4
        assert float(above.remaining_preload) == 0
        assert float(above.lift_off_load) == pytest.approx(limit, rel=1e-9)
    assert np.count_nonzero(loads_of_small(-2400.0).forward_load) < 98
    assert np.count_nonzero(loads_of_small(2800.0).backward_load) == 98


def test_of_an_array_each_load_has_the_lift_off_load_of_its_sign():
    together = loads_of_small(np.array([-5e3, -1.0, 0.0, 1e3]))
    alone = [float(loads_of_small(load).lift_off_load) for load in (-1.0, 1.0)]
    assert together.lift_off_load == pytest.approx([alone[0], alone[0], alone[1], alone[1]], rel=1e-9)
    assert together.at(np.array([2, 0])).lift_off_load == pytest.approx(alone[::-1], rel=1e-9)
    assert together.at(np.array([2, 0])).rigid_lift_off_load == pytest.approx([2738, 2738], abs=0.5)


def test_many_screws_together_are_each_by_itself():
    """Screws with the same and with other numbers of balls, nuts of all kinds, either sign of the load, and none."""
    rows = ("rexroth-25x5x3-4-double", "thk-bnfn3205-2.5")
    nuts = [
        DoubleNut(954.0, 0.01, bodies=Bodies()),
        OffsetLeadNut(954.0, bodies=Bodies(swelling=False, same_side=False)),
        OversizeBallNut(500.0, bodies=Bodies()),
        OversizeBallNut(oversize=4e-6, bodies=Bodies()),
        SingleNut(bodies=Bodies()),
        DoubleNut(954.0),
        DoubleNut(954.0, bodies=Bodies(), deviations=Deviations(ball_diameter=1e-7)),
    ]
    parts = [bs.catalogue()[row].screw(nut=nut) for row in rows for nut in nuts for _ in range(4)]
    loads = [load for _ in rows for _ in nuts for load in (-2500.0, 0.0, 3000.0, 3000.0)]
    found = loads_of_each(parts, loads)
    for part, load, mine in zip(parts, loads, found, strict=True):
        alone = loads_of(part, load)
        for name in (*({*quantities_of(BallLoads)} - {"lift_off_load"}), "rigid_lift_off_load", "balls"):
            assert getattr(mine, name) == pytest.approx(getattr(alone, name), rel=1e-9, abs=1e-12), name
    for place in range(0, len(nuts) * 4, 4):
        alone = loads_of(parts[place], loads[place])
        assert float(found[place].lift_off_load) == pytest.approx(float(alone.lift_off_load), rel=1e-9)
    assert found[2] is found[3]  # the same numbers are solved once


def test_a_screw_that_has_no_loads_leaves_the_others_theirs():
    """A nut without a wall around its balls, elastic or with balls that deviate, beside one that has all."""
    thin = Bodies(nut_outer_diameter=0.026)
    good = SMALL.screw(nut=BRACED)
    faulty = [dataclasses.replace(good, nut=DoubleNut(954.0, bodies=thin, deviations=d)) for d in (None, Deviations())]
    first, one, other, last = loads_of_each([good, *faulty, good], [100.0] * 4)
    assert first is last
    assert first.rigidity == pytest.approx(float(loads_of_small(100.0).rigidity), rel=1e-9)
    for error in (one, other):
        assert isinstance(error, InputError)
        assert "bodies.nut_outer_diameter" in str(error)
    assert loads_of_each([], []) == []


@pytest.mark.slow
@pytest.mark.parametrize("same_side", [True, False])
@pytest.mark.parametrize("swelling", [True, False])
@pytest.mark.parametrize("nut", [DoubleNut(954.0, 0.01), OffsetLeadNut(954.0), OversizeBallNut(500.0)])
def test_nothing_is_left_at_the_lift_off_load_and_something_just_below(nut, swelling, same_side):
    nut = dataclasses.replace(nut, bodies=Bodies(swelling=swelling, same_side=same_side))
    for sign in (-1.0, 1.0):
        limit = float(loads_of_small(sign, nut).lift_off_load)
        left = loads_of_small(sign * limit * np.array([1 - 1e-5, 1 + 1e-8]), nut).remaining_preload
        assert left[0] > 0
        assert left[1] == 0


def test_without_bodies_the_lift_off_load_is_that_of_rigid_ones():
    found = loads_of_small(100.0, DoubleNut(preload=954.0))
    assert found.lift_off_load == found.rigid_lift_off_load
    assert float(found.lift_off_load) == pytest.approx(2737.911905075621, rel=1e-15)


def test_nothing_lifts_off_where_nothing_is_braced():
    for nut in (DoubleNut(0.0, bodies=Bodies()), SingleNut(bodies=Bodies())):
        assert loads_of_small(100.0, nut).lift_off_load == 0
    assert np.isnan(loads_of_small(100.0, DoubleNut(np.array([-1.0, 954.0]), bodies=Bodies())).lift_off_load[0])


def test_the_work_of_the_load_is_what_the_balls_store():
    """∫F dx = Σ 2/5 Q δ over all flanks, less what the preload has stored."""
    part = screw(loaded_balls=9)
    deviations = scattered(9, 2)
    nodes, weights = np.polynomial.legendre.leggauss(200)
    t = (nodes + 1) / 2
    # x goes with the power of 2/3 of the load at first: even in t with F = t³
    full = 600.0
    for nut, given in ((SingleNut(), None), (OversizeBallNut(90.0), None), (OversizeBallNut(90.0), deviations)):
        r = ball_loads(part, nut, full * t**3, deviations=given)
        end, start = (ball_loads(part, nut, force, deviations=given) for force in (full, 0.0))
        work = full * end.deflection - np.sum(weights / 2 * 3 * full * t**2 * r.deflection)
        stored = [
            sum(
                0.4 * np.sum(state.balls * load * approach_at_one_newton(part) * load ** (2 / 3))
                for load in (state.forward_load, state.backward_load)
            )
            for state in (end, start)
        ]
        # lift-off of a ball is a kink, which costs the quadrature digits
        assert work == pytest.approx(stored[0] - stored[1], rel=1e-6)


# -- the paper's screw -----------------------------------------------------------------------------


def test_elastic_bodies_spread_the_loads_by_a_percent():
    """±1 %: 2.1 % from the least to the most loaded ball where both bodies are held on one side, less otherwise."""
    one_side, opposite = (
        ball_loads(PAPER, SingleNut(), LOAD, bodies=Bodies.of(PAPER, same_side=same)).forward_load
        for same in (True, False)
    )
    assert np.ptp(one_side) / np.mean(one_side) / 2 == pytest.approx(0.01, abs=0.001)
    assert np.ptp(opposite) < np.ptp(one_side) / 3
    assert np.all(np.diff(one_side) < 0)
    assert 0 < np.argmin(opposite) < 55


def test_scatter_of_the_balls_scatters_their_loads():
    """Balls of ±0.5 µm (a standard deviation): loads ±12 %, the most loaded 1.3 of the mean, over 400 nuts."""
    scatter, peak = [], []
    for seed in range(400):
        given = Deviations.scattered(56, seed=seed, ball_diameter=0.5e-6)
        loads = ball_loads(PAPER, SingleNut(), LOAD, deviations=given).forward_load
        scatter.append(np.std(loads) / np.mean(loads))
        peak.append(np.max(loads) / np.mean(loads))
    # the most of 56 normal deviates is 2.3 standard deviations out
    assert np.mean(scatter) == pytest.approx(0.12, abs=0.003)
    assert np.mean(peak) == pytest.approx(1.3, abs=0.02)


def test_the_same_seed_scatters_alike():
    one, same, other = (Deviations.scattered(9, seed=seed, ball_diameter=1e-6, lead=1e-6) for seed in (4, 4, 5))
    assert np.array_equal(one.ball_diameter, same.ball_diameter)
    assert np.array_equal(one.lead, same.lead)
    assert not np.any(one.ball_diameter == other.ball_diameter)


# -- arrays, blocks and bad input ------------------------------------------------------------------


@pytest.mark.parametrize("nut", [SingleNut(), OversizeBallNut(300.0), DoubleNut(300.0, 0.01)])
def test_blocks_do_not_show(nut, monkeypatch):
    part, loads = screw(loaded_balls=11), np.linspace(0, 2000, 50).reshape(10, 5)
    given = scattered(22 if isinstance(nut, DoubleNut) else 11, 1)
    bodies = Bodies.of(part)
    whole = ball_loads(part, nut, loads, bodies=bodies, deviations=given)
    monkeypatch.setattr(load_distribution, "BLOCK", 100)
    parts = ball_loads(part, nut, loads, bodies=bodies, deviations=given)
    assert whole.forward_load.shape == (10, 5, len(given.ball_diameter))
    assert whole.deflection.shape == (10, 5)
    assert parts.forward_load == pytest.approx(whole.forward_load, rel=1e-12, abs=1e-9)
    assert parts.deflection == pytest.approx(whole.deflection, rel=1e-12, abs=1e-18)


def test_screws_loads_and_preloads_broadcast():
    angles = np.radians([30.0, 45.0, 60.0])[:, None]
    loads = np.array([0.0, 100.0, 3000.0, 10.0])
    r = ball_loads(screw(contact_angle=angles), DoubleNut(np.array([200.0, 0.0, 300.0, 5.0])), loads)
    assert r.forward_load.shape == (3, 4, 2)
    assert r.rigidity.shape == (3, 4)
    one = ball_loads(screw(contact_angle=math.radians(60)), DoubleNut(300.0), 3000.0)
    assert r.forward_load[2, 2] == pytest.approx(one.forward_load, rel=1e-12)
    assert np.ndim(one.deflection) == 0


def test_numbers_of_balls_may_differ_where_balls_do_not():
    r = ball_loads(screw(loaded_balls=np.array([10.0, 56.0])), SingleNut(), LOAD)
    assert r.forward_load[1, 0] == pytest.approx(ball_loads(PAPER, SingleNut(), LOAD).forward_load[0], rel=1e-12)
    assert np.array_equal(r.balls[:, 0], [10.0, 56.0])


@pytest.mark.parametrize("more", [{"bodies": Bodies.of(PAPER)}, {"deviations": Deviations()}])
def test_balls_that_differ_must_be_counted(more):
    with pytest.raises(InputError, match=r"loaded_balls: must be one number"):
        ball_loads(screw(loaded_balls=np.array([10.0, 56.0])), SingleNut(), LOAD, **more)


@pytest.mark.parametrize("nut", [SingleNut(), DoubleNut(100.0)])
@pytest.mark.parametrize("field", ["ball_diameter", "lead"])
def test_deviations_are_one_for_each_ball(nut, field):
    wrong = Deviations(**{field: np.zeros(55)})
    balls = 112 if isinstance(nut, DoubleNut) else 56
    with pytest.raises(InputError, match=rf"deviations.{field}: must be one number or one for each ball.*give {balls}"):
        ball_loads(PAPER, nut, LOAD, deviations=wrong)


def test_an_unfit_load_is_flagged():
    """Not a number in, no convergence out; and the neighbours do not notice."""
    r = ball_loads(PAPER, DoubleNut(500.0), np.array([100.0, np.nan, 300.0]))
    assert list(r.converged) == [True, False, True]
    assert "outgrow" in r.advice


def test_the_preload_of_an_oversize_in_bodies_that_swell_is_what_is_left_without_load():
    """Swelling takes a part of the oversize: 14.5 kN of 17.2 kN that rigid bodies would have."""
    row = bs.catalogue()["rexroth-40x10x6-6-double"]
    swelling, bars = (
        bs.OversizeBallNut(oversize=10e-6, bodies=bs.Bodies(nut_outer_diameter=0.063, swelling=swells))
        for swells in (True, False)
    )
    screw = row.screw(nut=swelling)
    loads = ball_loads(screw, swelling, 0.0, bodies=swelling.bodies.sized(screw))
    assert preload_of(screw, swelling) == pytest.approx(float(loads.remaining_preload), rel=1e-12)
    assert preload_of(screw, swelling) < 0.9 * preload_of(screw, bars)


# -- the elimination ---------------------------------------------------------------------------------


@pytest.mark.parametrize("loose", [0.0, 0.4], ids=["all balls carry", "some do not"])
def test_a_chain_is_eliminated_alone_as_side_by_side(loose):
    """Few points are solved one by one: to the last bit as among many, and the solution balances the forces."""
    random = np.random.default_rng(1)
    balls, points = 121, ball_springs.FEW_POINTS + 3
    bars = 10 ** random.uniform(6, 9, (balls - 1, points))
    grounds = 10 ** random.uniform(5, 8, (balls, points)) * (random.random((balls, points)) >= loose)
    right = random.normal(size=(balls, points))
    together = ball_springs.tridiagonal(bars, grounds, right)
    alone = np.hstack([ball_springs.tridiagonal(bars[:, [i]], grounds[:, [i]], right[:, [i]]) for i in range(points)])
    np.testing.assert_array_equal(alone, together)
    passed_on = bars * np.diff(together, axis=0)
    left = right - grounds * together
    left[:-1] += passed_on
    left[1:] -= passed_on
    assert np.max(np.abs(left)) < 1e-9


def test_a_chain_tied_to_nothing_has_no_solution():
    """Alone as side by side: no bar and no ground is NaN, not an error."""
    for points in (1, ball_springs.FEW_POINTS + 1):
        with np.errstate(invalid="ignore", divide="ignore"):
            moved = ball_springs.tridiagonal(np.zeros((2, 1)), np.zeros((3, points)), np.ones((3, points)))
        assert np.isnan(moved[0]).all()


# -- work ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("compiled", [False, True])
def test_each_distinct_load_is_solved_once(monkeypatch, compiled):
    """A cycle has few loads at many speeds; the loads of the balls are those of each load by itself."""
    solved, points = load_distribution.solved, []

    def counted(case, *numbers):
        points.append(numbers[0].size)
        return solved(case, *numbers)

    monkeypatch.setattr(load_distribution, "solved", counted)
    nut, bodies = DoubleNut(preload=1500.0), Bodies()
    bodies = bodies.sized(PAPER)
    found = ball_loads(PAPER, nut, np.repeat([3000.0, -500.0, 3000.0], 40), bodies=bodies, compiled=compiled)
    assert sum(points) == 2
    apart = ball_loads(PAPER, nut, np.array([3000.0, -500.0]), bodies=bodies, compiled=compiled)
    places = np.repeat([0, 1, 0], 40)
    assert np.array_equal(found.forward_load, apart.forward_load[places])
    assert np.array_equal(found.rigidity, apart.rigidity[places])
    assert np.array_equal(found.at([0, 40]).backward_angle, apart.backward_angle)
