"""Tolerance classes against the tables that standards and makers print."""

import pytest

from ballscrew.engine.uncertainty.uncertain_value import BALL_LOT_VARIATION, TRAVEL_VARIATION, standard_tolerance

#: IT5, IT6, IT7 and IT8 in µm for sizes up to these, mm: the table of ISO 286-1.
PRINTED = {
    3: (4, 6, 10, 14), 6: (5, 8, 12, 18), 10: (6, 9, 15, 22), 18: (8, 11, 18, 27), 30: (9, 13, 21, 33),
    50: (11, 16, 25, 39), 80: (13, 19, 30, 46), 120: (15, 22, 35, 54), 180: (18, 25, 40, 63), 250: (20, 29, 46, 72),
    315: (23, 32, 52, 81), 400: (25, 36, 57, 89), 500: (27, 40, 63, 97),
}  # fmt: skip


@pytest.mark.parametrize("size", PRINTED)
def test_standard_tolerances(size):
    """The table is rounded by rules that are not in the formula: it lies within 1 µm."""
    lower = ([1, *PRINTED])[list(PRINTED).index(size)]
    for place in (size, (size + lower) / 2):
        found = [1e6 * standard_tolerance(place * 1e-3, grade) for grade in (5, 6, 7, 8)]
        assert found == pytest.approx(PRINTED[size], abs=1.0)


def test_a_screw_of_40_mm():
    """30 to 50 mm: 11, 16, 25 and 39 µm, to the digit."""
    assert [round(1e6 * standard_tolerance(0.04, grade), 6) for grade in (5, 6, 7, 8)] == [11, 16, 25, 39]


def test_what_has_no_tolerance():
    assert standard_tolerance(0.04, 4) is None
    assert standard_tolerance(0.6, 6) is None
    assert standard_tolerance(0.0, 6) is None


def test_balls_and_leads():
    """G10: 0.5 µm in a lot, as makers of balls print ISO 3290-1; class 5: 23 µm in 300 mm."""
    assert BALL_LOT_VARIATION[10] == pytest.approx(0.5e-6)
    assert BALL_LOT_VARIATION[3] == pytest.approx(0.13e-6)
    assert [300e3 * TRAVEL_VARIATION[grade] for grade in (3, 5, 7)] == pytest.approx([12, 23, 52])
