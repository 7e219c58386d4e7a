"""Truth: the paper's printed forms, and geometry that can be measured on a drawing."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest

from ballscrew.physics.equations import geometry

from .numbers import SCREWS

every_screw = pytest.mark.parametrize(("d_m", "d_w", "alpha", "f"), SCREWS.values(), ids=SCREWS)
RELATIVE = 1e-13


@pytest.mark.equation("Olaru2005 §2.1 (4)")
def test_radii_ratio_of_the_paper():
    # reference sheet: mpmath, 40 digits
    R_y = geometry.transverse_radius(3.175e-3, 0.515)
    assert geometry.radii_ratio(R_y, 1.49839902129876699e-3) == pytest.approx(36.3749347750001211, rel=RELATIVE)
    assert geometry.radii_ratio(R_y, 1.67660097870123301e-3) == pytest.approx(32.5087288860390379, rel=RELATIVE)


def test_lead_angle_of_the_paper():
    # reference sheet: mpmath, 40 digits
    assert geometry.lead_angle(0.005, 0.040) == pytest.approx(3.97677586025641090e-2, rel=RELATIVE)


def test_helix_of_the_paper():
    # reference sheet: mpmath, 40 digits
    phi = geometry.lead_angle(0.005, 0.040)
    assert geometry.path_radius(0.040, phi) == pytest.approx(2.00158251740407798e-2, rel=RELATIVE)
    gamma = geometry.curvature_ratio(3.175e-3, 0.040, math.pi / 4, phi)
    assert gamma == pytest.approx(5.60378847440091487e-2, rel=RELATIVE)


@every_screw
@pytest.mark.parametrize("lead", [0.005, 0.02, 0.04])
def test_curvature_ratio_is_that_of_the_path(d_m, d_w, alpha, f, lead):
    # Curvature of a helix: r/(r^2 + c^2) with c = lead/2 pi. Half a ball diameter times it, in the rolling plane.
    radius, c = d_m / 2, lead / (2 * math.pi)
    curvature = radius / (radius**2 + c**2)
    phi = geometry.lead_angle(lead, d_m)
    expected = d_w / 2 * math.cos(alpha) * curvature
    assert geometry.curvature_ratio(d_w, d_m, alpha, phi) == pytest.approx(expected, rel=RELATIVE)


@pytest.mark.parametrize("lead", [0.005, 0.02, 0.04])
def test_path_radius_is_length_of_path_per_radian(lead):
    turn = math.hypot(math.pi * 0.040, lead)
    phi = geometry.lead_angle(lead, 0.040)
    assert geometry.path_radius(0.040, phi) == pytest.approx(turn / (2 * math.pi), rel=RELATIVE)


@pytest.mark.parametrize("lead", [0.0, 0.005, 0.04])
def test_rolling_plane_cosine_is_an_angle_between_directions(lead):
    # The direction of rolling's axis in the ball's frame: cos(alpha) along the binormal, which leans by the lead angle.
    alpha, phi = math.pi / 4, geometry.lead_angle(lead, 0.040)
    binormal = np.array([0.0, -math.sin(phi), math.cos(phi)])
    normal = np.array([1.0, 0.0, 0.0])
    axis_of_rolling = math.cos(alpha) * binormal + math.sin(alpha) * normal
    assert geometry.rolling_plane_cosine(alpha, phi) == pytest.approx(axis_of_rolling[2], rel=RELATIVE)


@pytest.mark.parametrize("alpha", [0.4, math.pi / 4, 1.2])
@pytest.mark.parametrize("phi", [0.0, 0.04, 0.3])
def test_cosine_and_sine_of_the_rolling_plane_are_components_of_the_axis(alpha, phi):
    radial, binormal = np.array([1.0, 0.0, 0.0]), np.array([0.0, -math.sin(phi), math.cos(phi)])
    normal = math.cos(alpha) * radial + math.sin(alpha) * binormal
    across = math.cos(alpha) * binormal - math.sin(alpha) * radial
    assert geometry.rolling_plane_sine(alpha, phi) == pytest.approx(normal[2], rel=1e-13)
    assert geometry.rolling_plane_cosine(alpha, phi) == pytest.approx(across[2], rel=1e-13)


def hiwin():
    with (Path(__file__).parents[2] / "data" / "hiwin_fsc.csv").open(encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


@pytest.mark.parametrize("row", hiwin(), ids=lambda row: row["model"])
def test_groove_root_diameter_of_a_catalogue(row):
    # all rows have a conformity of 0.54 to a micrometre, but those with balls of 3.175 mm, which have 0.56
    d_m, d_w, d_r = (float(row[f"{name}_diameter_mm"]) for name in ("pitch_circle", "ball", "root"))
    conformity = 0.56 if d_w == 3.175 else 0.54
    found = geometry.groove_root_diameter(d_m, d_w, conformity, math.pi / 4)
    assert found == pytest.approx(d_r, abs=1e-3)


@every_screw
def test_groove_root_is_where_both_circles_meet(d_m, d_w, alpha, f):
    # The plane across the groove: the ball at the origin, the axis of the screw below. Each circle touches the ball
    # at the contact angle from within the groove, so that its centre lies (f - 1/2) d_w on the far side of the ball.
    offset = (f - 0.5) * d_w
    centre = np.array([offset * math.sin(alpha), offset * math.cos(alpha)])
    root = np.array([0.0, geometry.groove_root_diameter(d_m, d_w, f, alpha) / 2 - d_m / 2])
    for side in (-1, 1):
        assert np.linalg.norm(root - centre * [side, 1]) == pytest.approx(f * d_w, rel=RELATIVE)


def test_groove_root_of_a_perfect_fit_is_a_ball_below():
    assert geometry.groove_root_diameter(0.04, 0.006, 0.5, 0.9) == pytest.approx(0.034, rel=RELATIVE)
