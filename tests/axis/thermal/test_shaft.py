"""The shaft in finite volumes against exact solutions: errors fall with the square of the cells."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import erfc

from ballscrew.axis.thermal.network import CAPACITY, CONDUCTIVITY, DENSITY, EXPANSION, Shaft

LENGTH, DIAMETER, CONVECTION, HEAT = 1.0, 0.036, 12.0, 30.0
FIN = Shaft(length=LENGTH, diameter=DIAMETER, convection=CONVECTION)
#: Decay of a fin, 1/m, and its conductivity times its section.
M = math.sqrt(4 * CONVECTION / (CONDUCTIVITY * DIAMETER))
K_A = CONDUCTIVITY * FIN.section


def steady(shaft, source):
    """Rise over the air in the steady state."""
    return np.linalg.solve(shaft.conduction + shaft.cell_to_air * np.eye(shaft.cells), source)


def end_flux(shaft):
    """Error of a fin with heat into its first end, whose other is insulated."""
    heat = np.zeros(shaft.cells)
    heat[0] = HEAT
    exact = HEAT * np.cosh(M * (LENGTH - shaft.places)) / (K_A * M * math.sinh(M * LENGTH))
    return steady(shaft, heat), exact


def source_over_a_stroke(shaft, first=0.2, last=0.65):
    """Error of a heat spread over a part of the fin: the integral of its Green's function."""
    heat = HEAT * shaft.spread(np.array([(first + last) / 2]), np.ones(1), last - first)
    x, density = shaft.places, HEAT / (last - first)

    def to(place):  # integral of cosh(m ξ) from 0, and of cosh(m (L − ξ)) to L
        return np.sinh(M * place) / M

    below = np.clip(x, first, last)
    left = np.cosh(M * (LENGTH - x)) * (to(below) - to(first))
    right = np.cosh(M * x) * (to(LENGTH - below) - to(LENGTH - last))
    return steady(shaft, heat), density * (left + right) / (K_A * M * math.sinh(M * LENGTH))


@pytest.mark.parametrize("case", [end_flux, source_over_a_stroke])
def test_steady_fins_at_second_order(case):
    errors = []
    for cells in (60, 120, 240):
        found, exact = case(dataclasses.replace(FIN, cells=cells))
        errors.append(float(np.max(np.abs(found - exact)) / np.max(exact)))
    assert errors[0] < 4e-3
    assert np.log2(errors[0] / errors[1]) > 1.9
    assert np.log2(errors[1] / errors[2]) > 1.9


@pytest.mark.parametrize("cells", [7, 60])
def test_growth_of_a_shaft_with_insulated_ends(cells):
    """Whatever the conduction and the place of the heat: α Q / h U, exactly."""
    shaft = dataclasses.replace(FIN, cells=cells)
    heat = HEAT * shaft.spread(np.array([0.1, 0.7]), np.array([1.0, 2.0]), 0.13)
    growth = shaft.growth_at(steady(shaft, heat), 0.0, LENGTH)[0]
    assert growth == pytest.approx(EXPANSION * HEAT / (CONVECTION * math.pi * DIAMETER), rel=1e-12)


def integrated(shaft, start, heat, time, rtol=1e-9):
    """Rises after a time, with a heat that may depend on it."""
    matrix = shaft.conduction + shaft.cell_to_air * np.eye(shaft.cells)
    found = solve_ivp(
        lambda t, T: (heat(t) - matrix @ T) / shaft.cell_capacity,
        (0.0, time),
        start,
        method="BDF",
        jac=-matrix / shaft.cell_capacity,
        rtol=rtol,
        atol=1e-9,
    )
    return found.y[:, -1]


def test_decay_of_a_cosine():
    errors, time = [], 600.0
    for cells in (30, 60):
        shaft = dataclasses.replace(FIN, cells=cells)
        mode = np.cos(math.pi * shaft.places / LENGTH)
        rate = (CONVECTION * math.pi * DIAMETER + K_A * (math.pi / LENGTH) ** 2) / (DENSITY * CAPACITY * FIN.section)
        found = integrated(shaft, 10 * mode, lambda _: 0.0, time)
        errors.append(float(np.max(np.abs(found - 10 * mode * math.exp(-rate * time)))))
    assert errors[0] < 1e-3
    assert np.log2(errors[0] / errors[1]) > 1.9


def test_heat_into_the_end_of_a_long_bar():
    """Carslaw and Jaeger's half space with a constant flux, before the other end knows of it."""
    time, flux = 400.0, HEAT / FIN.section
    diffusivity = CONDUCTIVITY / (DENSITY * CAPACITY)
    errors = []
    for cells in (60, 120):
        bar = dataclasses.replace(FIN, convection=0.0, cells=cells)
        heat = np.zeros(cells)
        heat[0] = HEAT
        found = integrated(bar, np.zeros(cells), lambda _, heat=heat: heat, time)
        x, reach = bar.places, 2 * math.sqrt(diffusivity * time)
        exact = flux / CONDUCTIVITY * (reach / math.sqrt(math.pi) * np.exp(-((x / reach) ** 2)) - x * erfc(x / reach))
        errors.append(float(np.max(np.abs(found - exact)) / np.max(exact)))
    assert errors[0] < 2e-3
    assert np.log2(errors[0] / errors[1]) > 1.8


@pytest.mark.slow
def test_a_moving_source_far_from_the_ends():
    """The profile that travels with the nut: exp((−U ± √(U² + 4 a β)) ξ / 2a) before and behind it."""
    speed, width = 0.4e-3, 0.1
    bar = Shaft(length=2.0, diameter=DIAMETER, convection=60.0, cells=200)
    diffusivity = CONDUCTIVITY / (DENSITY * CAPACITY)
    beta = 4 * 60.0 / (DENSITY * CAPACITY * DIAMETER)
    time = 1.2 / speed

    def heat(t):
        return HEAT * bar.spread(np.array([0.4 + speed * t]), np.ones(1), width)

    found = integrated(bar, np.zeros(bar.cells), heat, time, rtol=1e-5)
    root = math.sqrt(speed**2 + 4 * diffusivity * beta)
    ahead, behind = (-speed - root) / (2 * diffusivity), (-speed + root) / (2 * diffusivity)
    xi = bar.places - 1.6
    before, after = (xi > 0.55 * width) & (xi < 0.2), (xi < -0.55 * width) & (xi > -0.35)
    slopes = [np.polyfit(xi[part], np.log(found[part]), 1)[0] for part in (before, after)]
    assert slopes == pytest.approx([ahead, behind], rel=0.01)


def test_shares_of_a_spread():
    """They sum to one, also where a nut would leave the shaft, and their middle is that of the nut."""
    places, weights = np.array([0.3, 0.5]), np.array([1.0, 3.0])
    shares = FIN.spread(places, weights, 0.1)
    assert np.sum(shares) == pytest.approx(1.0, rel=1e-14)
    assert shares @ FIN.places == pytest.approx(0.45, rel=1e-3)
    assert np.sum(FIN.spread(np.array([0.0]), np.ones(1), 0.3)) == pytest.approx(1.0, rel=1e-14)
