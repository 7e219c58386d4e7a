"""Friction after a reversal: its ends, its energy, its two scales, and the bristles behind it."""

import dataclasses
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.evidence.papers.olaru2005 import OIL as PAPER_OIL
from ballscrew.evidence.papers.olaru2005 import SCREW
from ballscrew.physics.equations import across_groove, presliding
from ballscrew.physics.friction.across_groove import arms_of
from ballscrew.physics.moving_balls.brush import BallContacts, Brush
from ballscrew.physics.moving_balls.reversal import MECHANISMS, loops, reversal

REFERENCE = bs.FrictionModel.reference()
OIL = bs.Lubricant.from_grade("VG 100", temperature=313.15)
ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
SINGLE = ROW.screw(nut=bs.SingleNut())
SLOW = {"axial_load": 3605.0, "screw_speed": 2 * math.pi * 100 / 60}


@pytest.fixture(scope="module")
def turned():
    return reversal(REFERENCE, SINGLE, OIL, **SLOW)


@pytest.fixture(scope="module")
def ball():
    """The contacts of a ball of the 40×10, and its friction."""
    found = REFERENCE(SINGLE, OIL, **SLOW)
    friction = found.kinds[0].friction
    return BallContacts.of(SINGLE, found.frame, friction.screw, friction.nut), friction


def test_it_goes_from_minus_to_plus_the_steady_torque(turned):
    steady = REFERENCE(SINGLE, OIL, **SLOW).screw_torque
    assert turned.screw_torque[0] == pytest.approx(-steady, rel=1e-3)
    assert turned.screw_torque[-1] == pytest.approx(steady, rel=1e-3)
    assert np.all(np.diff(turned.screw_angle) > 0)
    np.testing.assert_allclose(sum(turned.contributions.values()), turned.screw_torque, rtol=1e-12)


@pytest.mark.parametrize("travel", [1e-8, 3e-7, 2e-6, 2e-5])
def test_a_short_travel_is_the_begin_of_the_curve(turned, travel):
    """Also where it ends before the contacts have wound up."""
    short = reversal(REFERENCE, SINGLE, OIL, **SLOW, travel=travel)
    assert np.all(np.diff(short.screw_angle) > 0)
    assert short.travel[-1] == pytest.approx(travel, rel=1e-12)
    there = np.interp(short.screw_angle[1:], turned.screw_angle[1:], turned.screw_torque[1:])
    beyond = short.screw_angle[1:] >= turned.screw_angle[1]
    # the longer curve has straight lines between fewer angles
    assert short.screw_torque[1:][beyond] == pytest.approx(there[beyond], abs=2e-3 * turned.steady_torque)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("screw", "oil", "load"), [(SCREW, PAPER_OIL, 500.0), (SINGLE, OIL, 3605.0), (SINGLE, OIL, 15e3)]
)
def test_bristles_slip_as_the_reference_does(screw, oil, load):
    """Measured: 0.994 and 0.998 of the slip torque of the strips."""
    found = reversal(REFERENCE, screw, oil, axial_load=load, screw_speed=10.0)
    assert found.bristles_over_model == pytest.approx(1, abs=0.05)


def test_spin_is_back_at_once_and_the_helix_over_degrees(turned):
    """Of a 40×10: within 0.1° and over some 12°, that is a third of a millimetre of travel."""
    angle = np.degrees(turned.screw_angle)
    spin, helix = (turned.contributions[name] for name in ("spin_and_curvature", "helix"))
    assert np.interp(0.1, angle, spin) > 0.9 * turned.steady_contributions["spin_and_curvature"]
    back = (helix - helix[0]) / (helix[-1] - helix[0])
    at = [float(angle[np.argmax(back > share)]) for share in (0.5, 0.9)]
    assert 5 < at[0] < 9 < 11 < at[1] < 17
    assert turned.travel[-1] == pytest.approx(turned.screw_angle[-1] * SINGLE.lead / (2 * math.pi), rel=1e-12)


def test_the_ball_crosses_its_groove(turned):
    """From one side to the other, arm times lateral force over load on both."""
    across = turned.displacement[0]
    assert across[0] == pytest.approx(-across[-1], rel=0.01)
    friction = REFERENCE(SINGLE, OIL, **SLOW).kinds[0].friction
    arms = arms_of(SINGLE, friction.screw, friction.nut)
    beta = across_groove.lateral_friction_angle(friction.lateral_force, friction.contact_load)
    assert abs(across[-1]) == pytest.approx(float(across_groove.off_line_distance(*arms, beta)), rel=0.02)


def test_the_first_slope_of_the_helix_is_that_of_the_leaning_normals(ball):
    """A ball that starts from the line of its grooves, and whose contacts hold: two springs in series."""
    contacts, friction = ball
    sticky = tuple(patch._replace(limit=1e9 * patch.limit) for patch in contacts.patches)
    brush = Brush(dataclasses.replace(contacts, patches=sticky, spin=0.0))
    angle = 1e-3 * contacts.cell / contacts.rolled
    stuck = brush.turn(angle).torque.helix / angle
    arms = arms_of(SINGLE, friction.screw, friction.nut)
    compliance = across_groove.groove_compliance(friction.contact_load, *arms)
    k_t = [np.sum(patch.stiffness * patch.area * (patch.limit > 0)) for patch in contacts.patches]
    series = k_t[0] * k_t[1] / (k_t[0] + k_t[1])
    expected = presliding.lateral_stiffness(series, compliance, SINGLE.ball_diameter, SINGLE.lead_angle)
    assert stuck == pytest.approx(float(expected), rel=1e-6)
    # nearly all of it is the groove's
    alone = presliding.lateral_stiffness(1e30, compliance, SINGLE.ball_diameter, SINGLE.lead_angle)
    assert stuck == pytest.approx(float(alone), rel=0.01)


def test_a_loop_encloses_the_energy_that_is_lost(ball):
    """To and fro until the loop closes: its area, term by term, is what slips; nothing stays behind."""
    contacts, _ = ball
    brush, cell = Brush(contacts), contacts.cell / contacts.rolled
    area = lost = 0.0
    for _ in range(4):
        area = lost = stored = 0.0
        for way in (1, -1):
            for _ in range(400):
                step = brush.turn(way * cell)
                area += sum(step.torque) * way * cell
                lost += step.dissipated
                stored += step.stored
                assert step.imbalance < 1e-9
        assert area == pytest.approx(lost + stored, rel=1e-9)
    assert stored == pytest.approx(0, abs=1e-9 * lost)
    assert area == pytest.approx(lost, rel=1e-9)
    assert lost > 0


def test_bristles_roll_as_elastic_strips_do(ball):
    """Lateral creepage without slip: the force of a slender ellipse, π²/4 G a b for each unit of it."""
    contacts, friction = ball
    patch = contacts.patches[0]
    G = float(presliding.shear_modulus(SINGLE.ball_material.young_modulus, SINGLE.ball_material.poisson_ratio))
    a, b = float(friction.screw.semi_major_axis), float(friction.screw.semi_major_axis / friction.screw.ellipticity)
    width = b * np.sqrt(1 - patch.across**2)
    weights = np.polynomial.legendre.leggauss(len(patch.across))[1]
    stiffness = presliding.bristle_stiffness(width, G, G)
    force = np.sum(stiffness * 2 * width**2 * a * weights)  # a bristle has been carried along from the edge
    assert force == pytest.approx(math.pi**2 / 4 * G * a * b, rel=2e-3)


def test_from_rest_it_starts_at_zero():
    found = reversal(REFERENCE, SINGLE, OIL, **SLOW, from_rest=True)
    assert found.screw_torque[0] == 0
    assert found.screw_torque[-1] == pytest.approx(found.steady_torque, rel=1e-3)
    assert found.displacement[0][0] == 0


def test_a_nut_mirrored_is_the_same():
    """Load and speed of other signs: the same balls are pushed the same way."""
    one, other = (
        reversal(REFERENCE, SINGLE, OIL, axial_load=sign * 3605.0, screw_speed=sign * 10.0, travel=1e-4)
        for sign in (1, -1)
    )
    np.testing.assert_allclose(one.screw_torque, other.screw_torque, rtol=1e-12)


def test_four_contacts_wind_up_within_the_contacts():
    oversize = ROW.screw(nut=bs.OversizeBallNut(preload=3605.0))
    found = reversal(REFERENCE, oversize, OIL, axial_load=0.0, screw_speed=10.0, gap=0.0)
    assert math.degrees(found.angle_at(0.98)) < 1
    assert all(np.all(across == 0) for across in found.displacement)


def test_the_gap_closes_before_balls_press():
    whole, half = (reversal(REFERENCE, SINGLE, OIL, **SLOW, gap=gap) for gap in (1.0, 0.5))
    for found, share in ((whole, 0.5), (half, 1.0)):
        closing = half.screw_angle[
            np.argmax(half.contributions["ball_to_ball"] >= 0.999 * half.steady_contributions["ball_to_ball"])
        ]
        at = np.interp(closing, found.screw_angle, found.contributions["ball_to_ball"])
        assert at == pytest.approx(share * found.steady_contributions["ball_to_ball"], rel=0.05)
    assert set(whole.contributions) == {*MECHANISMS, "losses"}


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"screw_speed": 0.0}, "operation.screw_speed: must not be zero"),
        ({"travel": 0.0}, "reversal.travel: must be above zero"),
        ({"gap": -1.0}, "reversal.gap: must not be negative"),
        ({"axial_load": 0.0}, "operation.axial_load: leaves the balls without load"),
        ({"travel": math.inf}, "reversal.travel: must be above zero"),
        ({"axial_load": np.ones(2)}, "operation.axial_load: must be one number"),
    ],
)
def test_what_cannot_be_followed_is_refused(changed, message):
    with pytest.raises(bs.InputError, match=message):
        reversal(REFERENCE, SINGLE, OIL, **{**SLOW, **changed})
    with pytest.raises(bs.InputError, match=r"model\.slip: knows no slip across the path"):
        reversal(bs.FrictionModel.olaru2005(), SINGLE, OIL, **SLOW)


def test_a_long_stroke_to_and_fro_has_the_work_of_the_curve(turned):
    """Where all friction comes back within the stroke, each way is one reversal; to what a first loop is off."""
    stroke = float(turned.screw_angle[-1])
    (loop,) = loops(REFERENCE, SINGLE, OIL, turned, [stroke], **SLOW)
    work = np.trapezoid(turned.screw_torque[1:], turned.screw_angle[1:])
    assert loop.work_share == pytest.approx(work / (turned.steady_torque * stroke), rel=0.03)


def test_on_a_short_stroke_balls_slip_by_their_spin_alone(turned, ball):
    """Balls that swing about the line of their grooves roll sideways: what is left is the slip of a screw without a
    helix, which is more than the spin has beside it, and all that follows at once; balls part and hardly press.
    """
    stroke = math.radians(4)
    (loop,) = loops(REFERENCE, SINGLE, OIL, turned, [stroke], **SLOW)
    straight = Brush(dataclasses.replace(ball[0], lateral=0.0))
    for _ in range(100):
        spin = sum(straight.turn(ball[0].cell / ball[0].rolled).torque)
    parts = turned.steady_contributions
    number = REFERENCE(SINGLE, OIL, **SLOW).kinds[0].balls
    slip = number * spin / turned.bristles_over_model
    closing = float(
        np.interp(0.999999, turned.contributions["ball_to_ball"] / parts["ball_to_ball"], turned.screw_angle)
    )
    pressed = parts["ball_to_ball"] * stroke / (2 * closing)
    expected = parts["rolling"] + parts["losses"] + slip + pressed
    assert loop.work_share * turned.steady_torque == pytest.approx(expected, rel=0.03)
    assert slip > 1.5 * parts["spin_and_curvature"]
