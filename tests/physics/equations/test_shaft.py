"""Truth: the beam equation solved by differences, its characteristic roots, a catalogue's diameters and formulas."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.optimize import brentq

from ballscrew.physics.equations import geometry, shaft
from ballscrew.physics.sizing.installation import Ends

RELATIVE = 1e-13
RPM = math.tau / 60
DATA = Path(__file__).parents[2] / "data" / "hiwin_fsc.csv"
ROWS = list(csv.DictReader(DATA.read_text(encoding="utf-8").splitlines()))

#: The conditions of each mounting, and an interval that holds their least root and no other.
BUCKLING = {
    Ends.FIXED_FIXED: (lambda x: math.sin(x / 2), 4, 8),
    Ends.FIXED_SUPPORTED: (lambda x: math.sin(x) - x * math.cos(x), 3, 6),
    Ends.SUPPORTED_SUPPORTED: (math.sin, 2, 4),
    Ends.FIXED_FREE: (math.cos, 1, 2),
}
WHIRLING = {
    Ends.FIXED_FIXED: (lambda x: math.cos(x) * math.cosh(x) - 1, 4, 6),
    Ends.FIXED_SUPPORTED: (lambda x: math.tan(x) - math.tanh(x), 3.2, 4.5),
    Ends.SUPPORTED_SUPPORTED: (math.sin, 2, 4),
    Ends.FIXED_FREE: (lambda x: math.cos(x) * math.cosh(x) + 1, 1, 3),
}


@pytest.mark.parametrize("ends", Ends)
def test_roots_solve_their_conditions(ends):
    assert ends.buckling_root == pytest.approx(brentq(*BUCKLING[ends], xtol=1e-15), rel=RELATIVE)
    assert ends.whirling_root == pytest.approx(brentq(*WHIRLING[ends], xtol=1e-15), rel=RELATIVE)


def beam(elements):
    """Stiffness, geometric stiffness and mass of a beam of length, stiffness, force and mass one, Hermite elements."""
    h = 1 / elements
    bending = np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]]) / h**3
    pushing = np.array([[36, 3, -36, 3], [3, 4, -3, -1], [-36, -3, 36, -3], [3, -1, -3, 4]]) / (30 * h)
    inertia = np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]) * h / 420
    turns = np.array([1, h, 1, h])
    matrices = np.zeros((3, 2 * elements + 2, 2 * elements + 2))
    for first in range(0, 2 * elements, 2):
        where = slice(first, first + 4)
        for whole, part in zip(matrices, (bending, pushing, inertia), strict=True):
            whole[where, where] += part * np.outer(turns, turns)
    return matrices


@pytest.mark.parametrize("ends", Ends)
def test_roots_are_those_of_a_beam(ends):
    # a slope or a place of an end that is held is no freedom
    stiffness, pushing, mass = beam(20)
    held = {
        Ends.FIXED_FIXED: [0, 1, -2, -1],
        Ends.FIXED_SUPPORTED: [0, 1, -2],
        Ends.SUPPORTED_SUPPORTED: [0, -2],
        Ends.FIXED_FREE: [0, 1],
    }[ends]
    free = np.delete(np.arange(len(mass)), held)
    stiffness, pushing, mass = (matrix[np.ix_(free, free)] for matrix in (stiffness, pushing, mass))
    buckling = eigh(stiffness, pushing, eigvals_only=True)[0]
    vibration = eigh(stiffness, mass, eigvals_only=True)[0]
    assert ends.buckling_root**2 == pytest.approx(buckling, rel=2e-5)
    assert ends.whirling_root**4 == pytest.approx(vibration, rel=2e-5)


@pytest.mark.parametrize(("ends", "rounded"), [("FIXED_FREE", 1.3), ("FIXED_SUPPORTED", 10), ("FIXED_FIXED", 20)])
def test_buckling_of_a_catalogue(ends, rounded):
    # THK 514E (5): half of Euler's load is η d⁴/l² 10⁴ in mm and N, E 206 GPa; its factors are rounded
    F_k = shaft.buckling_load(Ends[ends].buckling_root, 206e9, 0.030, 1.0)
    assert F_k / 2 == pytest.approx(rounded * 30**4 / 1000**2 * 1e4, rel=0.05)


@pytest.mark.parametrize(
    ("ends", "rounded"),
    [("FIXED_FREE", 3.4), ("SUPPORTED_SUPPORTED", 9.7), ("FIXED_SUPPORTED", 15.1), ("FIXED_FIXED", 21.9)],
)
def test_critical_speed_of_a_catalogue(ends, rounded):
    # THK 514E (7): 0.8 of the critical speed is λ d/l² 10⁷ in mm and rpm, E 206 GPa, 7850 kg/m³, λ rounded
    omega = shaft.critical_speed(Ends[ends].whirling_root, 206e9, 7850.0, 0.030, 1.0)
    assert 0.8 * omega / RPM == pytest.approx(rounded * 30 / 1000**2 * 1e7, rel=0.013)


def test_buckling_is_eulers_with_the_moment_of_a_circle():
    E, d, l = 206e9, 0.03, 0.9  # noqa: E741  (l is the formula's letter)
    assert shaft.buckling_load(math.pi, E, d, l) == pytest.approx(
        math.pi**2 * E * (math.pi * d**4 / 64) / l**2, rel=RELATIVE
    )


def test_critical_speed_is_that_of_a_bar():
    E, rho, d, l, lam = 206e9, 7850.0, 0.03, 0.9, 4.73  # noqa: E741  (l is the formula's letter)
    moment, area = math.pi * d**4 / 64, math.pi * d**2 / 4
    assert shaft.critical_speed(lam, E, rho, d, l) == pytest.approx(
        (lam / l) ** 2 * math.sqrt(E * moment / (rho * area)), rel=RELATIVE
    )


def test_stress_of_a_catalogue():
    # THK 514E (6): 147 MPa are 116 d² N with d in mm
    assert shaft.shaft_stress(116 * 30**2, 0.030) == pytest.approx(147e6, rel=6e-3)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["model"])
def test_root_diameters_of_a_catalogue(row):
    # HIWIN S99TE20-1610; balls of 3.175 mm have grooves a little shallower
    d_m, d_w, printed = (
        float(row[f"{name}_mm"]) for name in ("pitch_circle_diameter", "ball_diameter", "root_diameter")
    )
    found = 1000 * geometry.groove_root_diameter(d_m / 1000, d_w / 1000, 0.54, math.pi / 4)
    assert found == pytest.approx(printed, abs=0.035 if d_w == 3.175 else 0.0015)


def test_dn_value_of_a_catalogue():
    # 70000 mm rpm: 35 mm at 2000 rpm
    assert shaft.diameter_speed_product(0.035, 2000 * RPM) == pytest.approx(70 * RPM, rel=RELATIVE)


@pytest.mark.parametrize(("diameter", "length", "printed"), [(0.020, 1.2, 1.48e-4), (0.015, 0.8, 3.12e-5)])
def test_inertia_of_a_catalogue(diameter, length, printed):
    # THK 514E, its examples of selecting a motor: the nominal diameter, to three digits
    assert shaft.shaft_inertia(diameter, 0.0, length, 7850.0) == pytest.approx(printed, rel=5e-3)


def test_inertia_is_that_of_rings():
    """The sum over thin rings of their mass times the square of their radius."""
    radius = np.linspace(0.005, 0.02, 20_001)
    middle = (radius[1:] + radius[:-1]) / 2
    rings = 7850 * 1.5 * 2 * math.pi * middle**3 * np.diff(radius)
    assert shaft.shaft_inertia(0.04, 0.01, 1.5, 7850.0) == pytest.approx(np.sum(rings), rel=1e-8)
