"""Tables that other programs read, and tables in narrow terminals."""

import io
import re

import numpy as np
import pytest

from support.commands import ROOT

CASE = ROOT / "examples" / "feed_drive.toml"


def test_numpy_reads_the_table_of_two_axes(ballscrew):
    axes = ["--vary", "axial_load=0, 2, 5 kN", "--vary", "screw_speed=100, 600 rpm"]
    found = ballscrew("sweep", CASE, *axes, "--output", "back_driving_efficiency")
    table = np.genfromtxt(io.StringIO(found.stdout), delimiter=",")
    assert table.shape == (4, 3)
    np.testing.assert_array_equal(table[0, 1:], [100, 600])
    np.testing.assert_array_equal(table[1:, 0], [0, 2000, 5000])
    assert np.isnan(table[1, 1:]).all()  # without load nothing drives
    assert (table[2:, 1:] > 0.9).all()
    assert "inf" not in found.stdout


@pytest.mark.parametrize("columns", ["40", "60"])
def test_no_digit_is_cut_in_a_narrow_terminal(ballscrew, columns):
    wide, narrow = (ballscrew("run", CASE, environment={"COLUMNS": width}).stdout for width in ("200", columns))
    assert "…" not in narrow
    digits = [sorted(re.sub(r"\D", "", text)) for text in (wide, narrow)]
    assert digits[0] == digits[1]
