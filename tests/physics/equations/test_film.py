"""Truth: Hamrock and Dowson's film, and the film parameter."""

import math

import pytest

from ballscrew.physics.equations import film, hertz

from .numbers import BALL_ROUGHNESS, RACE_ROUGHNESS, ROLLING_RADIUS


@pytest.mark.parametrize(
    ("U", "G", "W", "kappa", "H"),
    # HamrockDowson1977, minimum film, check values of the reference sheet
    [
        (1e-11, 4500, 1e-6, 1, 1.002686e-5),
        (1e-11, 4500, 1e-6, 3, 1.768014e-5),
        (1e-10, 5000, 1e-4, 10, 7.31001e-5),
    ],
)
@pytest.mark.equation("Olaru2005 §4 (26)")
def test_minimum_film_of_hamrock_and_dowson(U, G, W, kappa, H):
    assert film.minimum_film_thickness(1.0, U, G, W, kappa, 0.68) == pytest.approx(H, rel=1e-6)
    assert film.minimum_film_thickness(1.5e-3, U, G, W, kappa, 0.68) == pytest.approx(1.5e-3 * H, rel=1e-6)


@pytest.mark.parametrize(
    ("U", "G", "W", "kappa", "H"),
    # HamrockDowson1977, central film, check values of the reference sheet
    [
        (1e-11, 4500, 1e-6, 1, 1.765149e-5),
        (1e-11, 4500, 1e-6, 3, 2.329407e-5),
        (1e-10, 5000, 1e-4, 10, 9.078778e-5),
    ],
)
def test_central_film_of_hamrock_and_dowson(U, G, W, kappa, H):
    assert film.central_film_thickness(1.0, U, G, W, kappa) == pytest.approx(H, rel=1e-6)
    assert film.central_film_thickness(1.5e-3, U, G, W, kappa) == pytest.approx(1.5e-3 * H, rel=1e-6)
    assert film.central_film_thickness(1.5e-3, 0.0, G, W, kappa) == 0.0


@pytest.mark.parametrize(
    ("U", "G", "W", "k", "H"),
    # Chittenden1985 worked out by logarithms: U^0.68 = 10^-7.48 or 10^-6.8, W^-0.073 = 10^0.438 or 10^0.292; k^(2/3)
    # is 1, 4 and 9 for a k of 1, 8 and 27
    [
        (1e-11, 4500, 1e-6, 1, 3.68 * 10**-7.042 * 4500**0.49 * (1 - math.exp(-0.67))),
        (1e-11, 4500, 1e-6, 8, 3.68 * 10**-7.042 * 4500**0.49 * (1 - math.exp(-2.68))),
        (1e-10, 5000, 1e-4, 27, 3.68 * 10**-6.508 * 5000**0.49 * (1 - math.exp(-6.03))),
    ],
)
def test_minimum_film_of_chittenden(U, G, W, k, H):
    assert film.minimum_film_thickness_chittenden(1.0, U, G, W, k) == pytest.approx(H, rel=1e-12)
    assert film.minimum_film_thickness_chittenden(1.5e-3, U, G, W, k) == pytest.approx(1.5e-3 * H, rel=1e-12)
    assert film.minimum_film_thickness_chittenden(1.5e-3, 0.0, G, W, k) == 0.0


@pytest.mark.parametrize("k", [1.0, 2.0, 5.0, 10.0, 36.0, 100.0])
def test_both_minimum_films_are_close_where_the_ball_rolls_along_the_minor_axis(k):
    """Chittenden1985 extends HamrockDowson1977: the other direction of k gives a quarter of the film at k = 5."""
    U, G, W = 1e-11, 4500, 1e-6
    of_radii = film.minimum_film_thickness_chittenden(1.0, U, G, W, k)
    of_ellipse = film.minimum_film_thickness(1.0, U, G, W, hertz.ellipticity(k), 0.68)
    assert of_radii == pytest.approx(of_ellipse, rel=0.02)


def test_slide_to_roll_ratio_counts_in_mean_speeds():
    # surfaces at 3 and 1 m/s: they slide with 2 m/s on a mean of 2 m/s
    assert film.slide_to_roll_ratio(3.0 - 1.0, (3.0 + 1.0) / 2) == 1.0


@pytest.mark.parametrize(
    ("p_0", "L", "S", "phi_T"),
    # Gupta1992 worked out by hand: at L = 1 all powers of L are one, and at S = 1 those of S
    [
        (0.0, 1.0, 0.0, 1 / 1.213),
        (0.0, 1.0, 1.0, 1 / 1.68799),
        (2.26e9, 1.0, 0.0, 0.868 / 1.213),
        (2.26e9, 1.0, 1.0, 0.868 / 1.68799),
        # powers of 32 and 4 by logarithms: 32^0.42 = 2^2.1, 32^0.64 = 2^3.2, 4^0.83 = 2^1.66
        (2.26e9, 32.0, 4.0, (1 - 0.132 * 2**2.1) / (1 + 0.213 * (1 + 2.23 * 2**1.66) * 2**3.2)),
    ],
)
def test_inlet_heating_factor(p_0, L, S, phi_T):
    assert film.inlet_heating_factor(p_0, 2.26e11, L, S) == pytest.approx(phi_T, rel=1e-13)


def test_inlet_heating_leaves_the_film_alone_at_rest_and_never_turns_it_over():
    assert film.inlet_heating_factor(2e9, 2.26e11, 0.0, 0.0) == 1.0
    assert film.inlet_heating_factor(1.7e9, 2.26e11, 244.0, 0.0) > 0
    assert film.inlet_heating_factor(1.7e9, 2.26e11, 245.0, 0.0) == 0.0


@pytest.mark.equation("Olaru2005 §4 (26)")
def test_minimum_film_as_printed():
    # reference sheet: mpmath, 40 digits, exponent 0.66
    U, G, W = 1.84958236788959844e-10, 4972.0, 1.99078134111473684e-4
    a, b = 5.42571487704369921e-4, 5.12785261390040394e-5
    h = film.minimum_film_thickness(ROLLING_RADIUS, U, G, W, a / b, 0.66)
    assert h == pytest.approx(2.47142976578154276e-7, rel=1e-12)
    printed = 3.63 * ROLLING_RADIUS * U**0.66 * G**0.49 * W**-0.073 * (1 - math.exp(-0.68 * a / b))
    assert h == pytest.approx(printed, rel=1e-13)


@pytest.mark.equation("Olaru2005 §4 (22)")
def test_film_parameter_is_the_film_over_the_combined_roughness():
    # reference sheet: mpmath, 40 digits
    lam = film.film_parameter(2.47142976578154276e-7, BALL_ROUGHNESS, RACE_ROUGHNESS)
    assert lam == pytest.approx(0.795993930156217079, rel=1e-13)
    assert film.film_parameter(5e-7, 3e-7, 4e-7) == pytest.approx(1.0, rel=1e-15)


@pytest.mark.equation("Olaru2005 §4 (22)")
def test_film_parameter_to_the_letter():
    # reference sheet: mpmath, 40 digits
    lam = film.literal_film_parameter(2.47142976578154276e-7, BALL_ROUGHNESS, RACE_ROUGHNESS)
    assert lam == pytest.approx(2.56372382342483689e6, rel=1e-13)
