"""The contact integral against one that was computed elsewhere, with the same assumptions."""

import dataclasses
import json
import math
from pathlib import Path

import numpy as np
import pytest

from ballscrew.physics.equations import geometry
from oracles.contact_integral import contact_integral
from oracles.contact_patch import ContactPatch, hertz_ellipse
from oracles.tractions import Coulomb
from support.screws import of_row

DATA = json.loads((Path(__file__).parents[1] / "data/contact_integral.json").read_text(encoding="utf-8"))
POINTS = DATA["slip_power_of_one_contact"]["rows"]
MODULUS = 2.26e11
FRICTION = Coulomb(0.1)


def named(rows):
    return [pytest.param(row, id=f"{i}") for i, row in enumerate(rows)]


def judged(row, **more):
    """The outcome for one row of the reference."""
    return contact_integral(of_row(row), row["contact_load"], FRICTION, flank_pairs=row["contacts"] // 2, **more)


@pytest.mark.implausible
@pytest.mark.parametrize("row", named(DATA["rows"]))
def test_slip_torque(row):
    """The worst of the 26 differs by 9e-5, its own resolution error."""
    found = judged(row)
    assert found.converged
    assert found.message == ""
    assert found.slip_torque == pytest.approx(row["slip_torque_per_ball"], rel=1e-4 + row["resolution_error"])
    assert abs(found.power_balance_error) < 1e-12


@pytest.mark.parametrize("row", named(row for row in DATA["rows"] if row["resolution_error"] > 1e-6))
def test_resolution_error(row):
    """Even the error of the grid is that of the reference: the same points, or a coincidence in every row."""
    assert judged(row, check_resolution=True).resolution_error == pytest.approx(row["resolution_error"], rel=0.05)


@pytest.mark.implausible
@pytest.mark.parametrize("row", named(row for row in DATA["rows"] if row["resolution_error"] < 1e-9))
def test_no_resolution_error(row):
    assert judged(row, check_resolution=True).resolution_error < 1e-9


def least_slip_power(patch, turn):
    """Least power over all sliding speeds along the path, where traction vanishes, by ever finer steps."""
    low, high = -1.0, 1.0
    for _ in range(16):
        speeds = np.linspace(low, high, 9) * patch.depth.max()
        powers = [patch.field(np.array([speed, 0.0, *turn]), 1e-30).dissipation for speed in speeds]
        best, width = int(np.argmin(powers)), (high - low) / 8
        middle = low + best * width
        low, high = middle - width, middle + width
    return min(powers)


@pytest.mark.parametrize("row", named(POINTS))
@pytest.mark.parametrize("key", ["curvature", "with_spin"])
def test_slip_power_of_one_contact(row, key):
    """The grid, the pressure and the slip, on the surface of that reference: a parabola with parallel normals."""
    d_w, d_m, f, Q = (row[name] for name in ("ball_diameter", "pitch_circle_diameter", "conformity", "contact_load"))
    R_x = geometry.screw_rolling_radius(d_w, geometry.curvature_ratio(d_w, d_m, math.pi / 4, 0.0))
    patch = ContactPatch.of(hertz_ellipse(Q, MODULUS, d_w, f, R_x), FRICTION, (128, 32))
    flat = dataclasses.replace(
        patch,
        sine=0 * patch.sine,
        cosine=1 + 0 * patch.cosine,
        depth=patch.across**2 / (2 * geometry.deformed_radius(d_w, f)),
    )
    spin = d_w * math.sin(math.pi / 4) / d_m if key == "with_spin" else 0.0
    power = least_slip_power(flat, (0.0, 1.0, spin))
    assert power / (FRICTION.friction_coefficient * Q) == pytest.approx(row[key], rel=1e-3)
