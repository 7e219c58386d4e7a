"""The contact integral on random and absurd input: it finds the balance, or says in words why there is none."""

import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.physics.laws.frame import helix_frame
from oracles import contact_integral as solver
from oracles.contact_integral import contact_integral
from oracles.contact_patch import hertz_ellipse
from oracles.free_ball import BallResistances
from oracles.judged import HIGHEST_PRESSURE, screw
from oracles.tractions import Coulomb, Eyring, LimitingShear

pytestmark = pytest.mark.slow

# -- everywhere -----------------------------------------------------------------------------------


def random_cases(size, seed=2005):
    """Screws, loads, laws and resistances over the whole range that the solver is for."""
    rng = np.random.default_rng(seed)

    def power(low, high):
        return float(np.exp(rng.uniform(math.log(low), math.log(high))))

    while size:
        d_m = power(0.008, 0.150)
        try:
            part = screw(
                pitch_circle_diameter=d_m,
                ball_diameter=d_m * rng.uniform(0.05, 0.2),
                lead=d_m * power(0.05, 1.0),
                contact_angle=math.radians(rng.uniform(20, 70)),
                screw_conformity=rng.uniform(0.505, 0.56),
                nut_conformity=rng.uniform(0.505, 0.56),
            )
        except bs.InputError:
            continue
        oil = {
            "viscosity": power(0.005, 1.0),
            "pressure_viscosity_coefficient": rng.uniform(1e-8, 2.5e-8),
            "film_thickness": power(1e-8, 1e-6),
        }
        law = (
            Coulomb(power(0.001, 0.3)),
            Eyring(**oil, eyring_stress=rng.uniform(2e6, 1e7)),
            LimitingShear(**oil, limiting_shear_coefficient=rng.uniform(0.03, 0.12)),
        )[size % 3]
        heaviest = min(load_at(HIGHEST_PRESSURE, part, way) for way in (part.screw_raceway, part.nut_raceway))
        load = heaviest if size % 4 == 0 else power(min(0.05, heaviest), heaviest)
        yield part, load, law, int(rng.integers(1, 3)), rng.random(), power(0.1, 500.0)
        size -= 1


def load_at(pressure, part, way):
    """The contact load that leads to a maximum pressure, which goes with its cube root."""
    gamma = helix_frame(part).curvature_ratio * (-1 if way.conformity == part.screw_conformity else 1)
    R_x = part.ball_diameter / 2 * (1 + gamma)
    unit = hertz_ellipse(1.0, part.equivalent_modulus(way), part.ball_diameter, way.conformity, R_x)
    return (pressure / unit.maximum_pressure) ** 3


def test_converges_everywhere():
    """Every ball that touches, up to 4.2 GPa and nine tenths of the force at which it skids.

    The tightest grooves cannot hold the ellipse of the highest pressure: the solver says so, and nothing else.
    """
    solved, too_large, heaviest = 0, 0, 0.0
    for part, load, law, pairs, share, speed in random_cases(240):
        friction_force = law.friction_coefficient * load if isinstance(law, Coulomb) else 0.0
        pushed = BallResistances(ball_to_ball_force=0.9 * share * 2 * pairs * friction_force)
        found = contact_integral(part, load, law, flank_pairs=pairs, resistances=pushed, screw_speed=speed)
        if found.message == solver.TOO_LARGE:
            assert min(part.screw_conformity, part.nut_conformity) < 0.51
            too_large += 1
            continue
        assert found.converged, (part, load, law, pairs, found.message)
        assert abs(found.power_balance_error) < 1e-7
        assert max(found.force_residual, found.moment_residual) <= solver.BALANCED
        heaviest = max(heaviest, *(contact.ellipse.maximum_pressure for contact in found.contacts))
        solved += 1
    assert solved > 200
    assert too_large < 10
    assert heaviest == pytest.approx(HIGHEST_PRESSURE)


@pytest.mark.parametrize("load", [1e-12, 100.0])
@pytest.mark.parametrize("speed", [1e-9, 1e6])
@pytest.mark.parametrize("pairs", [1, 2])
@pytest.mark.parametrize(
    "law",
    [
        Coulomb(1e-12),
        Coulomb(100.0),
        Eyring(viscosity=10.0, pressure_viscosity_coefficient=5e-8, film_thickness=1e-12, eyring_stress=1e8),
        Eyring(viscosity=1e-4, pressure_viscosity_coefficient=1e-12, film_thickness=1e-3, eyring_stress=1e3),
        LimitingShear(
            viscosity=10.0, pressure_viscosity_coefficient=5e-8, film_thickness=1e-12, limiting_shear_coefficient=0.1
        ),
    ],
    ids=["slippery", "rough", "solid film", "thin film", "solid limited film"],
)
def test_absurd_numbers_are_answered_in_words(law, load, speed, pairs):
    """Neither an exception nor a warning, and a reason wherever there is no number."""
    for force in (0.0, 1e-9, 1e8):
        pushed = BallResistances(*[force] * 6)
        found = contact_integral(screw(), load, law, flank_pairs=pairs, screw_speed=speed, resistances=pushed)
        assert found.message != solver.NOT_FOUND
        assert found.converged == math.isfinite(found.screw_torque)
        assert found.converged or found.message
