"""Slip on four contacts: against the contact integral, at its limits, and energy on the way."""

import dataclasses
import json
import math
from pathlib import Path

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.physics.friction.balls import ball_contacts
from ballscrew.physics.laws.ball_chain import ProportionalBallForce
from ballscrew.physics.laws.conditions import Motion
from ballscrew.physics.laws.frame import helix_frame
from ballscrew.physics.solvers.four_point_slip import PARTS, FlankPair, FourPointBall, four_point_slip
from oracles.contact_integral import contact_integral
from oracles.free_ball import BallResistances
from oracles.judged import screw
from oracles.tractions import Coulomb
from support.screws import of_row

FRICTION = 0.1
OIL = bs.Lubricant(0.1, 2.2e-8)
ROWS = json.loads((Path(__file__).parents[2] / "data/contact_integral.json").read_text(encoding="utf-8"))["rows"]
FOUR = [row for row in ROWS if row["contacts"] == 4]
NONE = BallResistances()
#: What resists a ball beside its slip, as shares of friction times load, and of that times the ball's radius.
SHARES = BallResistances(0.05, 0.07, 0.01, 0.015, 0.01, 0.03)


def dry(friction=FRICTION):
    """A model in which nothing resists but dry friction."""
    return dataclasses.replace(
        bs.FrictionModel.reference(),
        friction=lambda c: friction + 0 * c.contact_load,
        rolling=lambda conditions: 0 * conditions.contact_load,
        elastic_resistance=lambda c: 0 * c.contact_load,
        contact_load=lambda axial_load, *_: axial_load,
        ball_force=ProportionalBallForce(0.0),
    )


def pair(part, load, friction, resistances, share=1.0):
    frame = helix_frame(part)
    v = frame.entrainment_speed(1.0)
    with np.errstate(all="ignore"):  # no load, no film
        contacts = ball_contacts(dry(friction).contact_laws, part, OIL, frame, load, (Motion(v, 0 * v, 0 * v),) * 2)
    forces = (resistances.screw_rolling_force, resistances.nut_rolling_force)
    moments = (resistances.screw_elastic_moment, resistances.nut_elastic_moment)
    contacts = [
        dataclasses.replace(contact, hydrodynamic_rolling_force=share * force, elastic_resistance_moment=share * moment)
        for contact, force, moment in zip(contacts, forces, moments, strict=True)
    ]
    return FlankPair(*contacts, part.contact_angle)


def slip(part, forward, backward, *, friction=FRICTION, resistances=NONE):
    """The slip of a ball under a load on each flank pair; rolling forces and moments are those of the larger one."""
    frame = helix_frame(part)
    largest = np.maximum(np.maximum(forward, backward), 1e-300)
    return four_point_slip(
        FourPointBall(
            pair(part, forward, friction, resistances, forward / largest),
            pair(part, backward, friction, resistances, backward / largest),
            resistances.ball_friction_moment,
            resistances.ball_to_ball_force,
            part.ball_diameter,
            frame.lead_angle,
            frame.path_radius,
        )
    )


def torque(result):
    return sum(result.contributions.values())


def resisting(part, load, share=1.0):
    """Resistances in proportion to friction times load."""
    force = share * FRICTION * load
    moment = force * part.ball_diameter / 2
    sizes = (force, force, moment, moment, moment, force)
    return BallResistances(*(part * size for part, size in zip(SHARES, sizes, strict=True)))


@dataclasses.dataclass(frozen=True)
class Screws:
    """Random screws, as arrays and one by one, with a load for each."""

    part: bs.BallScrew
    load: np.ndarray

    def __iter__(self):
        names = [field.name for field in dataclasses.fields(self.part)]
        for i, load in enumerate(self.load):
            values = {name: getattr(self.part, name) for name in names}
            picked = {name: float(value[i]) for name, value in values.items() if np.ndim(value)}
            yield dataclasses.replace(self.part, **picked), float(load)


def random_screws(size, seed):
    """Pitch circles of 8 to 150 mm, leads of d_m/20 to d_m, angles of 20 to 70 degrees; 1.5 N to 150 N per mm²."""
    rng = np.random.default_rng(seed)
    d_m = np.exp(rng.uniform(math.log(0.008), math.log(0.150), size))
    d_w = d_m * rng.uniform(0.05, 0.2, size)
    lead = np.maximum(d_m * np.exp(rng.uniform(math.log(0.05), 0, size)), 1.1 * d_w)
    part = screw(
        pitch_circle_diameter=d_m,
        lead=lead,
        ball_diameter=d_w,
        contact_angle=np.radians(rng.uniform(20, 70, size)),
        screw_conformity=rng.uniform(0.505, 0.56, size),
        nut_conformity=rng.uniform(0.505, 0.56, size),
    )
    return Screws(part, 1e6 * d_w**2 * np.exp(rng.uniform(math.log(1.5), math.log(100), size)))


SCREWS = random_screws(60, 6)


# -- against the integral --------------------------------------------------------------------------


@pytest.mark.parametrize(
    "row", FOUR, ids=lambda row: f"{row['pitch_circle_diameter']}-{row['lead']}-{row['contact_load']}"
)
def test_published_slip_torque(row):
    """The independent table asks for 1 %; the worst of the eight is 0.7 % off."""
    result = slip(of_row(row), row["contact_load"], row["contact_load"])
    assert torque(result) == pytest.approx(row["slip_torque_per_ball"], rel=0.01)
    assert result.converged


def test_there_are_eight_of_them():
    assert len(FOUR) == 8


def integrals(ratio, *, resistances=lambda part, load: NONE):
    return [
        contact_integral(
            part, load, Coulomb(FRICTION), flank_pairs=2, second_load=ratio * load, resistances=resistances(part, load)
        )
        for part, load in SCREWS
    ]


@pytest.mark.slow
@pytest.mark.implausible
@pytest.mark.parametrize("ratio", [1.0, 0.5, 0.1, 0.03, 0.01, 1e-3])
def test_random_screws_with_loads_that_differ(ratio):
    """Measured: median 0.2 %, 95 % within 0.65 %, largest 1.3 %; slip on two contacts has 0.02 %, 0.5 % and 1.2 %."""
    result = slip(SCREWS.part, SCREWS.load, ratio * SCREWS.load)
    truth = np.array([integral.slip_torque for integral in integrals(ratio)])
    error = np.abs(torque(result) / truth - 1)
    assert np.all(np.isfinite(error))
    assert np.median(error) < 0.003
    assert np.percentile(error, 95) < 0.01
    assert np.max(error) < 0.02


@pytest.mark.implausible
def test_random_screws_that_are_resisted():
    """Rolling forces, hysteresis and neighbours, up to a third of friction in all: torques on screw and nut."""
    found = [slip(part, load, load, resistances=resisting(part, load)) for part, load in SCREWS]
    truth = integrals(1.0, resistances=resisting)
    for name, ours in (("screw_torque", map(torque, found)), ("nut_torque", (one.nut_torque for one in found))):
        error = np.abs(np.array(list(ours)) / np.array([getattr(one, name) for one in truth]) - 1)
        assert np.median(error) < 0.003, name
        assert np.percentile(error, 95) < 0.01, name
        assert np.max(error) < 0.02, name


@pytest.mark.slow
@pytest.mark.implausible
@pytest.mark.parametrize("ratio", [1.0, 0.3, 0.03])
def test_the_ball_turns_as_the_integral_has_it(ratio):
    """The angle of its axis against the binormal: a thousandth of a radian in the median, 0.005 for nine of ten.

    Where two ways to turn cost nearly the same power, the axis is loose and the torque is not: one screw is 0.15 off.
    """
    result = slip(SCREWS.part, SCREWS.load, ratio * SCREWS.load)
    errors = []
    for (part, _), angle, integral in zip(SCREWS, result.axis_angle, integrals(ratio), strict=True):
        sine, cosine = math.sin(part.contact_angle), math.cos(part.contact_angle)
        outward = -integral.rotation_across * sine + integral.rotation_normal * cosine
        binormal = integral.rotation_across * cosine + integral.rotation_normal * sine
        errors.append(abs(angle - math.atan(-outward / binormal)))
    assert np.median(errors) < 0.002
    assert np.percentile(errors, 90) < 0.01


# -- limits ----------------------------------------------------------------------------------------


def on_two_contacts(part, load):
    one = dataclasses.replace(part, loaded_balls=1)
    return dry()(one, OIL, axial_load=load, screw_speed=1.0)


def test_a_flank_without_load_takes_no_part():
    """Then four contacts are two, and both slip laws the same strips.

    0.11 % apart at most, as unfinished steps move the torque by so much: see the tolerance of either law.
    """
    result = slip(SCREWS.part, SCREWS.load, 0 * SCREWS.load)
    two = on_two_contacts(SCREWS.part, SCREWS.load)
    assert np.all(np.isfinite(torque(result)))
    assert np.all(result.rolling_share == 1)
    settled = result.converged & two.converged
    assert np.mean(settled) > 0.9
    assert torque(result)[settled] == pytest.approx(two.screw_torque[settled], rel=2e-3)
    assert np.median(np.abs(torque(result) / two.screw_torque - 1)) < 1e-5


def test_relieving_a_flank_is_no_jump():
    """Its power is friction times its load times a slip that stays finite, so the torque falls in proportion to it."""
    without = torque(slip(SCREWS.part, SCREWS.load, 0 * SCREWS.load))
    for ratio in (1e-4, 1e-6, 1e-8):
        change = torque(slip(SCREWS.part, SCREWS.load, ratio * SCREWS.load)) - without
        # a slip speed below that of the screw at the ball, twice over: two contacts
        most = 2 * FRICTION * ratio * SCREWS.load * SCREWS.part.pitch_circle_diameter
        assert np.all(change <= most + 1e-5 * without)
        assert np.all(change >= -1e-5 * without)


def test_a_ball_between_equal_flanks_turns_about_the_binormal():
    result = slip(SCREWS.part, SCREWS.load, SCREWS.load)
    assert np.max(np.abs(result.axis_angle)) < 1e-10


def test_the_axis_goes_over_to_the_loaded_flank():
    """From the binormal to the contact angle, which it passes by what the helix and the shared spin add."""
    angles = np.array(
        [slip(SCREWS.part, SCREWS.load, ratio * SCREWS.load).axis_angle for ratio in (1.0, 0.3, 0.1, 0.01, 1e-4)]
    )
    share = angles / SCREWS.part.contact_angle
    assert np.all(np.diff(share, axis=0) > -1e-3)
    assert np.all((share[-1] > 0.8) & (share[-1] < 1.5))


def test_flanks_may_be_exchanged():
    """A load that pushes from the other side: the same torque on screw and nut, the axis mirrored.

    Only the helix tells forwards from backwards, and a mirror turns it around: lateral slip changes sign.
    """
    there, back = (
        slip(SCREWS.part, *loads) for loads in ((SCREWS.load, SCREWS.load / 5), (SCREWS.load / 5, SCREWS.load))
    )
    settled = there.converged & back.converged
    assert np.mean(settled) > 0.95
    assert torque(back)[settled] == pytest.approx(torque(there)[settled], rel=1e-3)
    assert np.max(np.abs(there.axis_angle + back.axis_angle)[settled]) < 1e-2


def test_four_contacts_slip_far_more_than_two():
    """Invariant 24: with the same load on every contact twice as much at least, most often five times."""
    ratio = torque(slip(SCREWS.part, SCREWS.load, SCREWS.load)) / on_two_contacts(SCREWS.part, SCREWS.load).screw_torque
    assert np.min(ratio) > 2
    assert np.median(ratio) > 5


@pytest.mark.parametrize("factor", [0.01, 3.0])
def test_dry_friction_is_a_factor(factor):
    """Invariant 19: where nothing else resists, the torque goes with the friction coefficient."""
    one, other = (slip(SCREWS.part, SCREWS.load, SCREWS.load / 2, friction=FRICTION * scale) for scale in (1.0, factor))
    assert torque(other) == pytest.approx(factor * torque(one), rel=1e-10)
    assert other.axis_angle == pytest.approx(one.axis_angle, abs=1e-8)


# -- energy ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("share", [0.0, 1.0, 10.0])
@pytest.mark.parametrize("ratio", [1.0, 0.1, 0.0])
def test_action_is_reaction(share, ratio):
    """M_S − M_N = F_B L of one ball, skidding or not; the parts are named and sum to M_S."""
    part, load = SCREWS.part, SCREWS.load
    resistances = resisting(part, load, share)
    result = slip(part, load, ratio * load, resistances=resistances)
    assert tuple(result.contributions) == PARTS
    pushed = result.rolling_share * resistances.ball_to_ball_force * helix_frame(part).path_radius
    assert torque(result) - result.nut_torque == pytest.approx(pushed, rel=1e-9, abs=1e-15)
    for name, found in result.contributions.items():
        if share == 0 and name not in {"curvature", "spin", "helix"}:
            assert np.all(found == 0), name
        assert np.all(found >= -1e-9 * torque(result)), name


def test_a_ball_skids_where_friction_cannot_carry_what_resists_it():
    """Resistances far beyond friction: a share of them is left, the same as of those twice as large halved."""
    part, load = SCREWS.part, SCREWS.load
    light, heavy, heavier = (slip(part, load, load, resistances=resisting(part, load, n)) for n in (1.0, 30.0, 60.0))
    assert np.all(light.rolling_share == 1)
    assert np.all(heavy.rolling_share < 0.5)
    assert heavier.rolling_share == pytest.approx(heavy.rolling_share / 2, rel=1e-12)
    assert torque(heavier) == pytest.approx(torque(heavy), rel=1e-9)
    assert np.all(torque(heavy) > torque(light))


def test_a_light_flank_with_a_thick_film_does_not_spin_the_ball_up():
    """Its rolling force has the ball's radius as a lever about the normal of the other flank, which holds by its spin.

    Beyond that moment the power would fall for ever: the ball skids, as it does along its path.
    """
    part, frame = screw(), helix_frame(screw())
    heavy = pair(part, 50.0, 0.02, NONE)
    light = pair(part, 0.1, 0.02, BallResistances(screw_rolling_force=0.3, nut_rolling_force=0.3))
    place = (part.ball_diameter, frame.lead_angle, frame.path_radius)
    result = four_point_slip(FourPointBall(heavy, light, 0.0, 0.0, *place))
    assert result.rolling_share < 1
    assert result.converged
    # all friction at the speed of the screw
    assert 0 < torque(result) < 0.02 * 2 * 50.1 * part.pitch_circle_diameter


def test_no_load_at_all_is_no_torque():
    result = slip(screw(), 0.0, 0.0)
    assert torque(result) == 0
    assert result.nut_torque == 0


# -- arrays ----------------------------------------------------------------------------------------


@pytest.mark.implausible
def test_an_array_is_a_row_of_numbers():
    whole = slip(SCREWS.part, SCREWS.load, SCREWS.load / 7)
    for i, (part, load) in enumerate(SCREWS):
        one = slip(part, load, load / 7)
        assert torque(one) == pytest.approx(torque(whole)[i], rel=1e-12)
        assert one.axis_angle == pytest.approx(whole.axis_angle[i], abs=1e-10)
        assert one.residual == pytest.approx(whole.residual[i], rel=1e-3, abs=1e-6)


def test_a_long_array_goes_through_in_blocks():
    few = slip(SCREWS.part, SCREWS.load, SCREWS.load / 3)
    many = slip(
        dataclasses.replace(
            SCREWS.part, **{name: np.tile(value, 700) for name, value in vars(SCREWS.part).items() if np.ndim(value)}
        ),
        np.tile(SCREWS.load, 700),
        np.tile(SCREWS.load / 3, 700),
    )
    assert torque(many) == pytest.approx(np.tile(torque(few), 700), rel=1e-12)


def test_most_settle():
    """What is left of the balance, on a thousand screws with loads that differ up to a hundredfold."""
    many = random_screws(1000, 8)
    ratio = 10 ** np.random.default_rng(1).uniform(-2, 0, 1000)
    result = slip(many.part, many.load, ratio * many.load)
    assert np.mean(result.converged) > 0.98
    assert np.max(result.residual) < 0.2
    assert "two contacts" in result.advice
