"""Numbers of a report: written as people do, with the digits that a band leaves."""

import math

import pytest

from ballscrew.friction.result import FrictionResult
from ballscrew.output.plain_numbers import plain
from ballscrew.quantities import quantities_of
from ballscrew.report.blocks import Paragraph, Picture, Report, Section, as_data
from ballscrew.report.numbers import banded, banded_share, last_place, to_place, with_digits_of
from ballscrew.uncertainty.bands import Interval, OutputBand
from ballscrew.units import shown

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
    ("value", "low", "high", "words"),
    [
        (1.014, 0.6213, 1.56, ("1.0 N m", "0.6 to 1.6 N m")),
        (0.4378, 0.27, 0.61, ("0.44 N m", "0.27 to 0.61 N m")),
        (12.1494, 12.14, 12.16, ("12.149 N m", "12.140 to 12.160 N m")),
        (1234.0, 900.0, 1700.0, ("1200 N m", "900 to 1700 N m")),
        (2.0, 2.0, 2.0, ("2 N m", "")),
        (2.0, math.nan, math.nan, ("2 N m", "")),
        (math.nan, 1.0, 2.0, ("–", "")),
    ],
)
def test_digits_follow_the_band(value, low, high, words):
    assert banded(value, low, high, TORQUE) == words


def test_shares_follow_their_band_in_per_cent():
    assert banded_share(0.9166, 0.8772, 0.9472) == ("91.7 %", "87.7 to 94.7 %")
    assert banded_share(0.9166, math.nan, math.nan) == ("91.7 %", "")


@pytest.mark.parametrize("half", [3e-7, 0.02, 0.4, 1.0, 33.0, 36.0, 5e6])
def test_half_of_a_band_has_one_digit_or_two(half):
    digits = round(half / 10.0 ** last_place(-half, half))
    assert 3 < digits <= 35


def test_numbers_end_where_they_should():
    assert [to_place(1.04, -1), to_place(-0.04, -1), to_place(1250.0, 2), to_place(4.2e8, 7)] == [
        "1.0", "0.0", "1200", "420 million",
    ]  # fmt: skip


def test_quantities_in_sentences_have_the_digits_of_their_bands():
    band = OutputBand(1.014, 0.94, Interval(0.62, 1.56), Interval(0, 0), Interval(0, 0), math.nan, 0.0)
    power = KNOWN["friction_power"]
    texts = with_digits_of({"screw_torque": band}, lambda: [f"{shown(1.014, TORQUE)}, {shown(63.68, power)}"])
    assert texts == ["1.0 N m, 63.68 W"]


def test_no_text_of_a_report_has_an_exponent_but_what_people_wrote():
    svg = '<svg d="M1e-05 2"><text>4e+08</text></svg>'
    found = as_data(
        Report(
            "1e+08", ["2e+08"], [Section("3e+08", [Paragraph("4e+08"), Picture(svg, "5e+08", "6e+08")])], "x",
            heading=["Project: 7e+08"],
        )
    )  # fmt: skip
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
