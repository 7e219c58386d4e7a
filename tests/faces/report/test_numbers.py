"""Numbers of a report: written as people do, with and without a band alike."""

import math

import numpy as np
import pytest

from ballscrew.basis.output.sheet import Number, Share, words
from ballscrew.basis.output.text import plain
from ballscrew.basis.quantities import quantities_of
from ballscrew.basis.units import to_digits
from ballscrew.faces.sheets.report_blocks import Paragraph, Picture, Report, Section, as_data
from ballscrew.physics.friction.result import FrictionResult

KNOWN = quantities_of(FrictionResult)
TORQUE = KNOWN["screw_torque"]


@pytest.mark.parametrize(
    ("written", "read"),
    [
        ("4.027e+08 turns, 3.6e+08", "402.7 million turns, 360 million"),
        ("5.751e+08", "575.1 million"),
        ("1.12e+04 h", "11200 h"),
        ("-3.756e+04 N/µm", "-37560 N/µm"),
        ("1.5e-08 to 6e-08", "1.5 × 10⁻⁸ to 6 × 10⁻⁸"),
        ("1e-06", "10⁻⁶"),
        ("1e-4 of the ball diameter", "0.0001 of the ball diameter"),
        ("1e9 to 1e15", "1000 million to 10¹⁵"),
        ("2.5e-3.", "0.0025."),
        # no numbers: names of files, rows and sources
        ("case1e5 x2e+3y 12e4b 0.5", "case1e5 x2e+3y 12e4b 0.5"),
    ],
)
def test_numbers_of_programs_are_written_out(written, read):
    assert plain(written) == read


@pytest.mark.parametrize(
    ("value", "low", "high", "written"),
    [
        (1.014, 0.62137, 1.56, "1.014 N m (0.6213 to 1.56)"),
        (0.43781, 0.270001, 0.610001, "0.4378 N m (0.27 to 0.6101)"),
        (12.1494, 12.1411, 12.1589, "12.15 N m (12.14 to 12.16)"),
        (1234.6, -900.04, 17004.0, "1235 N m (-900.1 to 17010)"),
        (2.0, 2.0, 2.0, "2 N m"),
        (2.0, math.nan, math.nan, "2 N m"),
        (math.nan, 1.0, 2.0, "–"),
    ],
)
def test_a_number_is_written_as_without_its_band_whose_ends_are_rounded_outward(value, low, high, written):
    assert words(Number(value, TORQUE, band=(low, high))) == written
    assert written.startswith(words(Number(value, TORQUE)))


def test_shares_are_written_so_in_per_cent():
    assert words(Share(0.91666, band=(0.87721, 0.94721))) == "91.7% (87.7% to 94.8%)"
    assert words(Share(0.91666, band=(math.nan, math.nan))) == "91.7%"


@pytest.mark.parametrize("digits", [1, 2, 4, 7])
def test_what_is_written_of_a_band_holds_no_less_than_was_computed(digits):
    """And no more than one unit of its last digit; what is off by rounding errors counts as written."""
    random = np.random.default_rng(7)
    numbers = random.uniform(-10, 10, 500) * 10.0 ** random.integers(-9, 9, 500)
    for number in numbers.tolist():
        low, near, high = (float(to_digits(number, digits, toward)) for toward in (-1, 0, 1))
        step = 10.0 ** (math.floor(math.log10(abs(number))) - digits + 1)
        assert low <= number + 1e-11 * abs(number)
        assert high >= number - 1e-11 * abs(number)
        assert low in (near, pytest.approx(near - step))
        assert high in (near, pytest.approx(near + step))
        assert high - low <= step + 1e-9 * abs(number)
    assert [to_digits(0.1 + 0.2, 2, toward) for toward in (-1, 0, 1)] == ["0.3"] * 3
    assert [to_digits(number, toward=1) for number in (0.0, math.inf, math.nan)] == ["0", "inf", "nan"]


def test_no_text_of_a_report_has_an_exponent_but_what_people_wrote():
    svg = '<svg d="M1e-05 2"><text>4e+08</text></svg>'
    found = as_data(
        Report(
            "1e+08",
            ["2e+08"],
            [Section("3e+08", [Paragraph("4e+08"), Picture(svg, "5e+08", "6e+08")])],
            "x",
            heading=["Project: 7e+08"],
        )
    )
    (section,) = found["sections"]
    text, picture = section["blocks"]
    assert [
        found["title"],
        *found["subtitle"],
        section["title"],
        text["text"],
        picture["words"],
        picture["caption"],
    ] == [f"{number}00 million" for number in range(1, 7)]
    assert picture["svg"] == '<svg d="M1e-05 2"><text>400 million</text></svg>'
    assert found["heading"] == ["Project: 7e+08"]
