"""Speed from position and time: exact where the position is, and as noisy as straight lines through it."""

import numpy as np
import pytest

from ballscrew.files.torque_logs import reading
from ballscrew.files.torque_logs.motion import FeedRates, feed_rate
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


@pytest.mark.slow
@pytest.mark.parametrize("noise", [1e-6, 1e-5])
def test_pieces_make_no_difference(noise, read):
    """Noise of the position that takes lines of 17 and 65 rows; gaps, a clock that begins anew and a missing value."""
    head, *rows = log_text(noise).splitlines()
    rows = [*rows[:997], *rows[1500:2003], "5,00;;1000;0,5", *rows[2003:], *rows[:700]]
    text = "\n".join([head, *rows]) + "\n"
    whole = read(text, lead=0.005)
    for chunk in (5, 61, 997, 4000):
        found = read(text, lead=0.005, chunk=chunk)
        assert found.notes == whole.notes
        for name, values in whole.columns.items():
            np.testing.assert_array_equal(getattr(found, name), values)


def test_pieces_make_no_difference_to_a_log_that_is_thinned(read):
    """The first rows, as many as are held, tell how wide the lines are, and the notes say so."""
    text = log_text(1e-5)
    logs = [read(text, lead=0.005, held=1000, chunk=chunk) for chunk in (70, 999, 1000, 1001, 5000)]
    assert any("as the noise in the first 1000 allows" in note for note in logs[0].notes)
    for log in logs:
        assert len(log) == 1000
        assert log.notes == logs[0].notes
        np.testing.assert_array_equal(log.line, logs[0].line)
        np.testing.assert_array_equal(log.screw_speed, logs[0].screw_speed)
        np.testing.assert_array_equal(log.motion.slope, logs[0].motion.slope)


def test_a_position_that_is_lost_holds_back_few_rows():
    rates, waiting = FeedRates(100), 0
    for first in range(0, 10_000, 50):
        time = 0.01 * np.arange(first, first + 50)
        position = np.where(time < 20, 0.05 * time, np.nan)
        given = rates.add({"time": time, "position": position})
        np.testing.assert_allclose(given["feed_rate"][given["time"] < 20], 0.05, rtol=1e-6)
        assert np.isnan(given["feed_rate"][given["time"] >= 20]).all()
        waiting += 50 - given["time"].size
        assert waiting <= 150
    assert rates.end()["time"].size == waiting


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


def test_what_is_the_same_in_every_row_needs_the_same(read):
    text = "load [N];torque [N m]\n1000;0.5\n1100;0.6\n"
    assert lines_of(read, text, columns={"position": "0 mm"}) == [
        "--column position: needs the lead · give the lead of the screw, or a column with its speed",
        "--column position: gives no speed without the time · give a column with the time, or the speed",
    ]
    text = "load [N];speed [rpm]\n1000;50\n1100;60\n"
    assert lines_of(read, text, columns={"current": "2 A"}) == [
        '--column current: needs the torque constant · give --torque-constant "0.5 N m/A"'
    ]
    assert read(text, columns={"current": "2 A"}, torque_constant=0.5).torque.tolist() == [1.0, 1.0]
