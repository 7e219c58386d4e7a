"""The contact integral: balance, energy, limits that are known, skid, and independent minima."""

import dataclasses
import math

import numpy as np
import pytest
from scipy import integrate, optimize

import ballscrew as bs
from ballscrew.physics.equations import friction
from ballscrew.physics.laws.frame import bearing_frame, helix_frame
from oracles import contact_integral as solver
from oracles.contact_integral import contact_integral
from oracles.contact_patch import ContactPatch, Ellipse, hertz_ellipse
from oracles.free_ball import BallResistances
from oracles.judged import LAWS, RESISTANCES, ball, screw
from oracles.tractions import STIFFEST, Coulomb, Eyring

# -- local laws -----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["coulomb", "eyring", "limiting"])
@pytest.mark.parametrize("pressure", [1e6, 0.3e9, 2e9])
def test_potential_stress_and_slope_belong_together(name, pressure):
    law, p = LAWS[name], np.array([pressure])
    for s in (1e-9, 1e-5, 0.01, 1.0):
        breaks = [s * 10.0**-k for k in range(1, 12)]
        whole, _ = integrate.quad(
            lambda u: float(law.stress(p, np.array([u]))[0]), 0, s, points=breaks, limit=500, epsabs=0, epsrel=1e-10
        )
        assert law.potential(p, np.array([s]))[0] == pytest.approx(whole, rel=1e-6)
        step = 1e-4 * s
        rise = law.stress(p, np.array([s + step])) - law.stress(p, np.array([s - step]))
        assert law.slope(p, np.array([s]))[0] == pytest.approx(rise[0] / (2 * step), rel=1e-4, abs=1e-9 * pressure / s)


@pytest.mark.parametrize("name", ["eyring", "limiting"])
def test_laws_stay_finite_where_roelands_does_not(name):
    law = dataclasses.replace(LAWS[name], viscosity=2.0, pressure_viscosity_coefficient=8e-8)
    pressure, slip = np.array([1.0, 1e9, 4e9, 2e10]), np.array([1e-12, 1e-3, 10.0, 1e3])
    # the viscosity itself: a finite traction could be its limit alone
    assert law._film_viscosity(pressure)[-1] == STIFFEST
    for value in (law.stress(pressure, slip), law.slope(pressure, slip), law.potential(pressure, slip)):
        assert np.all(np.isfinite(value))
        assert np.all(value >= 0)


# -- one contact ----------------------------------------------------------------------------------


@pytest.mark.parametrize("shape", [(1e-4, 1e-4), (1e-4, 1e-8)], ids=["circular", "slender"])
def test_moment_of_pure_spin(shape):
    """3π/16 µQa of a circle, 3/8 µQa of a slender ellipse."""
    across, along = shape
    patch = ContactPatch.of(Ellipse(across, along, 1e9, 1e3 * across), LAWS["coulomb"], (200, 50))
    load = patch.area @ patch.pressure
    assert load == pytest.approx(2 * math.pi / 3 * 1e9 * across * along, rel=1e-13)
    factor = 3 * math.pi / 16 if across == along else 3 / 8
    wrench = patch.answer(np.array([0.0, 0.0, 0.0, 0.0, 1.0]), 1e-30).wrench
    assert wrench[4] == pytest.approx(factor * 0.1 * load * across, rel=2e-4)
    assert wrench[:4] == pytest.approx(0, abs=1e-6 * load * across)


@pytest.mark.parametrize("name", ["coulomb", "eyring", "limiting"])
def test_wrench_is_the_slope_of_the_potential(name):
    ellipse = Ellipse(3e-4, 5e-5, 1.5e9, 1.6e-3)
    patch, blur = ContactPatch.of(ellipse, LAWS[name], (32, 8)), 1e-5
    twist = np.array([1e-4, 2e-4, 0.3, 5.0, 2.0])
    wrench, slope, _ = patch.answer(twist, blur)
    for i, size in enumerate((1e-3, 1e-3, 1.0, 1.0, 1.0)):
        step = np.zeros(5)
        step[i] = 1e-5 * size
        rise = patch.potential(twist + step, blur) - patch.potential(twist - step, blur)
        assert rise / (2 * step[i]) == pytest.approx(wrench[i], rel=1e-4)
        column = (patch.answer(twist + step, blur).wrench - patch.answer(twist - step, blur).wrench) / (2 * step[i])
        assert column == pytest.approx(slope[:, i], rel=1e-3, abs=1e-6 * np.abs(slope).max() * size / 1e-3)
    assert slope == pytest.approx(slope.T, rel=1e-12)
    assert np.all(np.linalg.eigvalsh(slope) > 0)


# -- balance and energy ---------------------------------------------------------------------------


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
@pytest.mark.parametrize("pairs", [1, 2])
@pytest.mark.parametrize("resistances", [None, RESISTANCES], ids=["alone", "resisted"])
def test_power_in_is_power_dissipated_and_action_is_reaction(law, pairs, resistances):
    part = screw()
    found = contact_integral(part, 101.0, law, flank_pairs=pairs, resistances=resistances, screw_speed=50.0)
    assert found.converged
    assert len(found.contacts) == 2 * pairs
    assert abs(found.power_balance_error) < 1e-10
    assert max(found.force_residual, found.moment_residual) < 1e-10
    assert found.slip_power == pytest.approx(sum(c.slip_power for c in found.contacts), rel=1e-14)
    assert found.screw_torque * 50.0 == pytest.approx(found.slip_power + found.resistance_power, rel=1e-10)
    braking = 0.05 * helix_frame(part).path_radius if resistances else 0.0
    assert found.screw_torque - found.nut_torque == pytest.approx(braking, rel=1e-9, abs=1e-9 * found.screw_torque)
    assert (found.resistance_power > 0) == (resistances is not None)


def test_resistances_add_their_torque_at_light_slip():
    """Rolling forces at 2v, elastic moments and the chain at their speeds: the power of the paper's balance."""
    part, r = screw(), RESISTANCES
    frame, omega = helix_frame(part), 50.0
    found = contact_integral(part, 101.0, LAWS["coulomb"], resistances=r, screw_speed=omega)
    v, gamma, c = frame.entrainment_speed(omega), frame.curvature_ratio, frame.rolling_plane_cosine
    turning, orbit = 2 * v / part.ball_diameter, omega * (1 - gamma) / 2
    power = (
        2 * v * (r.screw_rolling_force + r.nut_rolling_force)
        + r.screw_elastic_moment * (turning + (omega - orbit) * c)
        + r.nut_elastic_moment * (turning - orbit * c)
        + r.ball_friction_moment * turning
        + r.ball_to_ball_force * orbit * frame.path_radius
    )
    assert found.resistance_power == pytest.approx(power, rel=5e-3)


@pytest.mark.parametrize("pairs", [1, 2])
def test_another_optimiser_finds_the_same_minimum(pairs):
    """scipy's trust region on the potential, from a ball that is far from rolling."""
    one = ball(screw(), 101.0, LAWS["coulomb"], pairs, RESISTANCES)
    found = solver.balance(one)
    unit = 1 / np.sqrt(np.diag(one.imbalance(found.change, found.blur).slope))
    energy = one.mean_slip * one.imbalance(found.change, found.blur).capacity
    unit, far = unit * math.sqrt(energy), np.array([0.3, -0.2, 0.2, 0.1])
    best = far
    for share in solver.BLURS:
        blur = share * one.mean_slip
        best = optimize.minimize(
            lambda x, blur=blur: one.potential(unit * x, blur) / energy,
            best,
            jac=lambda x, blur=blur: one.imbalance(unit * x, blur).forces * unit / energy,
            hess=lambda x, blur=blur: one.imbalance(unit * x, blur).slope * np.outer(unit, unit) / energy,
            method="trust-exact",
            options={"gtol": 1e-8},
        ).x
    slip = sum(side.patch.field(side.twist(unit * best), found.blur).dissipation for side in one.sides)
    same = sum(side.patch.field(side.twist(found.change), found.blur).dissipation for side in one.sides)
    assert slip == pytest.approx(same, rel=1e-6)


def slip_power_by_vectors(part, load, mu, ball_rotation, orbit, omega):
    """Coulomb slip power by cross products in the helix's own directions t, n, b, on rings of midpoints."""
    frame = helix_frame(part)
    alpha, phi, L, rho = part.contact_angle, frame.lead_angle, frame.path_radius, part.ball_diameter / 2
    t = np.array([1.0, 0.0, 0.0])
    axis = np.array([math.sin(phi), 0.0, math.cos(phi)])
    nut = np.array([0.0, -math.cos(alpha), math.sin(alpha)])
    across = np.cross(nut, t)
    spin = ball_rotation @ np.array([t, across, nut])
    radii, turns = (np.arange(150) + 0.5) / 150, 2 * math.pi * (np.arange(180) + 0.5) / 180
    r, turn = (grid.ravel() for grid in np.meshgrid(radii, turns))
    share = r * np.sqrt(1 - r**2)
    share = share / share.sum()
    power = 0.0
    for way, normal in ((part.screw_raceway, -nut), (part.nut_raceway, nut)):
        R_x = rho * (1 + frame.curvature_ratio * (1 if way is None or normal is nut else -1))
        ellipse = hertz_ellipse(load, part.equivalent_modulus(way), part.ball_diameter, way.conformity, R_x)
        R_d, side = ellipse.deformed_radius, np.cross(normal, t)
        x, y = ellipse.along * r * np.cos(turn), ellipse.across * r * np.sin(turn)
        centre = (rho - R_d) * normal
        lean = np.outer(y, side) + np.outer(np.sqrt(R_d**2 - y**2), normal)
        position = np.outer(x, t) + centre + lean
        moving = omega * L * t + np.cross(omega * axis, position) if normal is not nut else 0 * position
        slip = moving - orbit * L * t - np.cross(spin, position)
        slip = slip - lean * (np.sum(slip * lean, axis=1) / R_d**2)[:, None]
        power += mu * load * share @ np.linalg.norm(slip, axis=1)
    return power


def test_no_other_motion_slips_less():
    """Without resistances the balance is the least slip power, judged by an integral of its own."""
    part, omega = screw(), 2.0
    found = contact_integral(part, 101.0, Coulomb(0.1), screw_speed=omega)
    rotation = np.array([found.rotation_along, found.rotation_across, found.rotation_normal])

    def power(d_rotation=0.0, d_orbit=0.0):
        return slip_power_by_vectors(part, 101.0, 0.1, rotation + d_rotation, found.orbital_rotation + d_orbit, omega)

    least = power()
    assert least == pytest.approx(found.slip_power, rel=2e-4)
    for unit, size in zip(np.eye(3), (0.1, 0.01, 0.1), strict=True):
        for sign in (-1, 1):
            assert power(d_rotation=sign * size * unit) > least
    for sign in (-1, 1):
        assert power(d_orbit=sign * 1e-3) > least


# -- limits ---------------------------------------------------------------------------------------


def test_a_plain_bearing_has_no_lateral_slip():
    part = screw()
    found = contact_integral(part, 101.0, Coulomb(0.1), frame=bearing_frame(part))
    assert found.rotation_along == pytest.approx(0, abs=1e-12)
    for contact in found.contacts:
        assert contact.lateral_force == pytest.approx(0, abs=1e-10 * 101)


def test_the_helix_fades_into_the_bearing():
    part = screw()
    plain = contact_integral(part, 101.0, Coulomb(0.1), frame=bearing_frame(part)).slip_torque
    frame = helix_frame(part)
    slight = dataclasses.replace(bearing_frame(part), lead_angle=1e-7)
    assert contact_integral(part, 101.0, Coulomb(0.1), frame=slight).slip_torque == pytest.approx(plain, rel=1e-5)
    assert contact_integral(part, 101.0, Coulomb(0.1), frame=frame).slip_torque > 1.2 * plain


@pytest.mark.parametrize("pairs", [1, 2])
def test_a_left_hand_thread_turns_the_lateral_forces_round(pairs):
    part = screw()
    right = helix_frame(part)
    left = dataclasses.replace(right, lead_angle=-right.lead_angle)
    one, other = (contact_integral(part, 101.0, Coulomb(0.1), flank_pairs=pairs, frame=f) for f in (right, left))
    assert other.screw_torque == pytest.approx(one.screw_torque, rel=1e-9)
    assert other.rotation_along == pytest.approx(-one.rotation_along, rel=1e-9)
    assert other.rotation_across == pytest.approx(one.rotation_across, rel=1e-9)
    assert abs(one.screw.lateral_force) > 0.01
    assert other.screw.lateral_force == pytest.approx(-one.screw.lateral_force, rel=1e-6)


def test_on_an_endless_circle_both_contacts_are_alike():
    part = screw(pitch_circle_diameter=4e4, lead=1e4, screw_conformity=0.54)
    found = contact_integral(part, 101.0, Coulomb(0.1))
    assert found.converged
    assert found.screw_spin_share == pytest.approx(0.5, rel=1e-6)
    assert found.screw.slip_power == pytest.approx(found.nut.slip_power, rel=1e-6)
    assert found.orbital_rotation == pytest.approx(0.5, rel=1e-6)


def test_without_spin_a_slender_contact_obeys_the_closed_law():
    """Curvature moments at Y = 2 sin 10° turning with v/R_x: small in its groove, and 70 times longer than wide."""
    part = screw(contact_angle=1e-6, screw_conformity=0.5004, nut_conformity=0.5004)
    frame, load, mu = bearing_frame(part), 0.01, 0.1
    found = contact_integral(part, load, Coulomb(mu), frame=frame, resolution=(128, 16))
    Y, v, power = 2 * math.sin(math.radians(10)), frame.entrainment_speed(1.0), 0.0
    for contact, sign in ((found.screw, -1), (found.nut, 1)):
        a, R_d = contact.ellipse.across, contact.ellipse.deformed_radius
        assert a / contact.ellipse.along > 70
        R_x = part.ball_diameter / 2 * (1 + sign * frame.curvature_ratio)
        power += friction.curvature_friction_moment(mu, load, a, R_d, Y) * v / R_x
    assert found.slip_power == pytest.approx(power, rel=2e-3)


def test_dry_friction_scales():
    """With friction; with load and modulus at the same ellipse; and not with speed."""
    part = screw()
    stiff = bs.Material(young_modulus=2 * 2.06e11, poisson_ratio=0.3)
    torque = contact_integral(part, 101.0, Coulomb(0.1)).slip_torque
    assert contact_integral(part, 101.0, Coulomb(0.05)).slip_torque == pytest.approx(torque / 2, rel=1e-9)
    assert contact_integral(part, 101.0, Coulomb(0.1), screw_speed=321.0).slip_torque == pytest.approx(torque, rel=1e-9)
    harder = dataclasses.replace(part, ball_material=stiff, screw_material=stiff, nut_material=stiff)
    assert contact_integral(harder, 202.0, Coulomb(0.1)).slip_torque == pytest.approx(2 * torque, rel=1e-9)


def test_films_know_the_speed():
    torques = [
        contact_integral(screw(), 101.0, LAWS["eyring"], screw_speed=speed).slip_torque for speed in (1, 10, 100)
    ]
    assert torques[0] < torques[1] < torques[2]


@pytest.mark.slow
@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
@pytest.mark.parametrize("pairs", [1, 2])
def test_the_grid_is_fine_enough(law, pairs):
    found = contact_integral(screw(), 101.0, law, flank_pairs=pairs, screw_speed=50.0, check_resolution=True)
    assert 0 <= found.resolution_error < 2e-3
    assert contact_integral(screw(), 101.0, law, flank_pairs=pairs, screw_speed=50.0).resolution_error is None


# -- skid -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("pairs", [1, 2])
def test_a_pushed_ball_skids_beyond_what_both_contacts_carry(pairs):
    """A force along the path is shared equally by screw and nut: µQ each at most."""
    limit = 2 * pairs * 0.1 * 101.0

    def pushed(share):
        return contact_integral(
            screw(),
            101.0,
            Coulomb(0.1),
            flank_pairs=pairs,
            resistances=BallResistances(ball_to_ball_force=share * limit),
        )

    holds = pushed(0.99)
    assert holds.converged
    assert abs(holds.power_balance_error) < 1e-9
    shares = [contact.traction_ratio for contact in holds.contacts]
    assert np.mean(np.abs(shares)) == pytest.approx(0.99, rel=1e-9)
    assert shares == pytest.approx([0.99, -0.99] * pairs, rel=1e-2)
    skids = pushed(1.01)
    assert not skids.converged
    assert "skids" in skids.message
    assert math.isnan(skids.screw_torque)
    assert skids.contacts == ()


def test_a_braked_ball_skids_beyond_what_both_contacts_carry():
    """A moment about the rolling axis takes M/d_w at each contact, and the curved path M c/2L on top at the screw."""
    part, load = screw(), 5.0
    frame, d_w = helix_frame(part), part.ball_diameter
    limit = 0.1 * load / (1 / d_w + frame.rolling_plane_cosine / (2 * frame.path_radius))

    def braked(share):
        return contact_integral(
            part, load, Coulomb(0.1), resistances=BallResistances(ball_friction_moment=share * limit)
        )

    assert braked(0.98).converged
    assert not braked(1.02).converged


def test_sliding_faster_than_rolling_is_said():
    """Films always carry more when they slide faster: there is a balance, but the ball hardly rolls."""
    thin = Eyring(viscosity=0.01, pressure_viscosity_coefficient=1e-8, film_thickness=1e-6, eyring_stress=5e6)
    pushed = BallResistances(ball_to_ball_force=0.5)
    found = contact_integral(screw(), 20.0, thin, resistances=pushed)
    assert found.converged
    assert found.message == solver.SLIDES


def test_what_cannot_touch_is_said():
    """No load, and a load so high that the ellipse is wider than the groove is round."""
    assert contact_integral(screw(), 0.0, Coulomb(0.1)).message == solver.NO_LOAD
    close = screw(screw_conformity=0.5005, nut_conformity=0.5005)
    found = contact_integral(close, 30e3, Coulomb(0.1))
    assert not found.converged
    assert found.message == solver.TOO_LARGE
    assert found.iterations == 0


def test_rolling_asks_for_what_the_balance_asks_for():
    """Olaru2005 §3 (24) and (25): equal rolling forces need F_R (1 + 2γ) at the screw, F_R (1 - 2γ) at the nut."""
    part, F_R, Q = screw(), 0.5, 101.0
    gamma = helix_frame(part).curvature_ratio
    bare = contact_integral(part, Q, Coulomb(0.1))
    found = contact_integral(part, Q, Coulomb(0.1), resistances=BallResistances(F_R, F_R))
    more = [(x.traction_ratio - y.traction_ratio) * 0.1 * Q for x, y in zip(found.contacts, bare.contacts, strict=True)]
    assert more[0] == pytest.approx(F_R * (1 + 2 * gamma), rel=1e-2)
    assert more[1] == pytest.approx(F_R * (1 - 2 * gamma), rel=1e-2)
