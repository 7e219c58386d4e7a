"""Speed from position and time: exact where the position is, and as noisy as straight lines through it."""

import numpy as np
import pytest

from ballscrew.torque_logs import reading
from ballscrew.torque_logs.positions import feed_rate
from support.log_texts import RPM, lines_of


def strokes(noise, rows=4000, seed=0):
    """Position of strokes forward and back at 50 mm/s, every 10 ms, and its speed."""
    time = 0.01 * np.arange(rows)
    speed = np.where(np.arange(rows) // 500 % 2, -0.05, 0.05)
    position = np.concatenate([[0.0], np.cumsum(speed[:-1] * 0.01)])
    return time, position + np.random.default_rng(seed).normal(0, noise, rows), speed


def test_a_position_without_noise_has_its_speed_but_where_a_stroke_ends():
    time, position, speed = strokes(0.0)
    found, width = feed_rate(time, position)
    inside = np.ones(time.size, dtype=bool)
    inside[500::500] = inside[499::500] = False
    assert width == 1
    np.testing.assert_allclose(found[inside[:4000]], speed[inside[:4000]], rtol=1e-9)


@pytest.mark.parametrize("noise", [1e-6, 1e-5])
def test_noise_of_the_position_is_averaged_by_wider_lines(noise):
    """The standard deviation of the slope of n points in steps of τ is σ/τ √(12 / (n³ − n))."""
    time, position, speed = strokes(noise)
    found, width = feed_rate(time, position)
    rows = 2 * width + 1
    expected = noise / 0.01 * np.sqrt(12 / (rows**3 - rows))
    away = np.abs((np.arange(4000) + 250) % 500 - 250) > width
    deviation = np.std((found - speed)[away])
    assert expected <= 0.01 * 0.05 * 1.3
    assert deviation == pytest.approx(expected, rel=0.25)  # some 3000 slopes, of which 3000/rows are independent


def test_no_line_crosses_a_gap_or_a_clock_that_begins_anew():
    time, position, _ = strokes(0.0, 400)
    for second in (time + 100, time):
        found, _ = feed_rate(np.concatenate([time, second]), np.concatenate([position, position + 3]))
        np.testing.assert_allclose(found, 0.05, rtol=1e-6)


def test_missing_values_have_no_speed_and_spoil_no_other():
    time, position, _ = strokes(0.0, 400)
    position[7] = time[20] = np.nan
    found, _ = feed_rate(time, position)
    assert np.flatnonzero(np.isnan(found)).tolist() == [7, 20]
    np.testing.assert_allclose(found[~np.isnan(found)], 0.05, rtol=1e-6)


def log_text(noise=1e-6):
    time, position, _ = strokes(noise)
    rows = (f"{t:.2f};{1e3 * x:.6f};1000;0.5" for t, x in zip(time, position, strict=True))
    return "\n".join(["Zeit [s];Weg [mm];Axialkraft [N];Reibmoment [Nm]", *rows]).replace(".", ",") + "\n"


def test_a_log_with_a_position_has_a_speed(read):
    log = read(log_text(), lead=0.005)
    assert np.median(np.abs(log.screw_speed)) / RPM == pytest.approx(600, rel=1e-3)
    assert any(note.startswith("the speed is that of the position over the time") for note in log.notes)
    steady = log.cleaned()
    assert np.abs(steady.screw_speed) / RPM == pytest.approx(600, rel=0.05)  # the ends of strokes are left out
    assert steady.left_out["speed changes"] > 0


def test_a_position_needs_the_time_and_the_lead(tmp_path):
    path = tmp_path / "log.csv"
    path.write_text(log_text(), encoding="utf-8")
    assert lines_of(reading.read, path) == [
        'log.csv column "Weg [mm]": needs the lead · give the lead of the screw, or a column with its speed'
    ]
    path.write_text(log_text().replace("Zeit [s]", "Nummer"), encoding="utf-8")
    assert lines_of(reading.read, path, lead=0.005) == [
        'log.csv column "Weg [mm]": gives no speed without the time · give a column with the time, or the speed'
    ]


def test_long_rests_do_not_smooth_the_strokes():
    """Most rows at rest: the width follows the speed of the strokes, not that of the noise."""
    moves = np.tile(np.repeat([0.0, 0.05, 0.0, -0.05], [100, 40, 100, 40]), 5)
    time = 0.01 * np.arange(moves.size)
    position = np.cumsum(moves) * 0.01 + 1e-6 * np.random.default_rng(0).standard_normal(moves.size)
    speed, _ = feed_rate(time, position)
    middle = np.convolve(np.abs(moves) > 0, np.ones(21), "same") == 21
    assert np.abs(speed[middle]) == pytest.approx(0.05, rel=0.02)
    rest = np.convolve(np.abs(moves) > 0, np.ones(21), "same") == 0
    assert np.max(np.abs(speed[rest])) < 5e-4
