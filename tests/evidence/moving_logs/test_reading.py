"""Moving logs in files: what is recognised, units, and the channels of the EMPS benchmark."""

import math

import numpy as np
import pytest
from scipy.io import savemat

from ballscrew.basis.errors import InputError
from ballscrew.evidence.moving_logs.reading import is_moving, read_moving
from support.moving_logs import record, strokes

LOG = record(strokes(repeats=1, step=4e-3), step=4e-3)
GAIN = 35.15


def csv_of(path, headings, *columns, delimiter=",", decimal="."):
    rows = (delimiter.join(repr(float(x)).replace(".", decimal) for x in row) for row in zip(*columns, strict=True))
    path.write_text("\n".join([delimiter.join(headings), *rows]) + "\n", encoding="utf-8")
    return path


def emps(path, **more):
    """A record with the channels of the benchmark, as MATLAB saves them: columns, and numbers as matrices."""
    column = {name: values[:, np.newaxis] for name, values in LOG.items()}
    channels = {"t": column["time"], "qm": column["position"], "qg": column["position"]}
    savemat(path, {**channels, "vir": column["force"] / GAIN, "gtau": GAIN, "kp": 160.18, "kv": 243.45, **more})
    return path


def test_the_channels_of_emps(tmp_path):
    path = emps(tmp_path / "DATA_EMPS.mat")
    assert is_moving(path, {})
    log = read_moving(path, lead=2.5e-3)
    np.testing.assert_allclose(log.force, LOG["force"])
    np.testing.assert_array_equal(log.position, LOG["position"])
    assert log.gain == GAIN
    assert any("EMPS" in note for note in log.notes)


@pytest.mark.parametrize("shape", [(7, 2), (50, 1), (1, 1)])
def test_other_channels_of_any_shape_do_not_matter(tmp_path, shape):
    log = read_moving(emps(tmp_path / "pulses.mat", pulses_N=np.ones(shape)), lead=2.5e-3)
    np.testing.assert_allclose(log.force, LOG["force"])


def test_a_struct_with_its_gain(tmp_path):
    path = tmp_path / "struct.mat"
    savemat(path, {"data": {"t": LOG["time"], "qm": LOG["position"], "vir": LOG["force"] / GAIN, "gtau": GAIN}})
    np.testing.assert_allclose(read_moving(path, lead=2.5e-3).force, LOG["force"])


def test_a_test_log_without_a_gain_has_that_of_the_other(tmp_path):
    path = emps(tmp_path / "test.mat", gtau="not here")
    with pytest.raises(InputError, match="needs the gain"):
        read_moving(path, lead=2.5e-3)
    np.testing.assert_allclose(read_moving(path, lead=2.5e-3, usual_gain=GAIN).force, LOG["force"])


LEAD = 5e-3
SCALES = {
    "force [kN]": 1e-3,
    "motor torque [N m]": LEAD / (2 * math.pi),
    "Iq (A)": LEAD / (2 * math.pi) / 0.5,
    "u [V]": 1 / GAIN,
}


@pytest.mark.parametrize("heading", SCALES)
def test_a_force_from_what_the_drive_logs(tmp_path, heading):
    position = 1e3 * LOG["position"]
    path = csv_of(
        tmp_path / "log.csv",
        ["time [s]", "Istposition [mm]", heading],
        LOG["time"],
        position,
        SCALES[heading] * LOG["force"],
    )
    assert is_moving(path, {})
    log = read_moving(path, lead=LEAD, torque_constant=0.5, gain=GAIN)
    np.testing.assert_allclose(log.force, LOG["force"])
    np.testing.assert_allclose(log.position, LOG["position"])
    assert log.line[0] == 2


def test_a_force_from_the_power_of_the_motor_over_its_speed(tmp_path):
    """30 N against either direction; near rest a power tells no force."""
    speed = np.array([0.2, 0.1, 0.001, 0.0, -0.001, -0.2])
    position, time = 1.0 + np.cumsum(speed) * 0.1, 0.1 * np.arange(6)
    power = 30.0 * np.abs(speed)
    path = csv_of(tmp_path / "log.csv", ["t [s]", "x [m]", "v [m/s]", "motor power [W]"], time, position, speed, power)
    log = read_moving(path, lead=LEAD, steady=True)
    assert log.force == pytest.approx([30, 30, math.nan, math.nan, math.nan, -30], nan_ok=True)
    assert log.unit == "N"
    without = csv_of(tmp_path / "slow.csv", ["t [s]", "x [m]", "motor power [W]"], time, position, power)
    with pytest.raises(InputError, match="makes a force only over a speed that is logged"):
        read_moving(without, lead=LEAD, steady=True)
    with pytest.raises(InputError, match="tells no force where the axis turns round · --steady"):
        read_moving(path, lead=LEAD)


def test_decimal_commas_and_a_row_of_units(tmp_path):
    path = csv_of(
        tmp_path / "log.csv",
        ["Zeit", "Weg", "Kraft"],
        LOG["time"],
        1e3 * LOG["position"],
        LOG["force"],
        delimiter=";",
        decimal=",",
    )
    lines = path.read_text(encoding="utf-8").splitlines()
    path.write_text("\n".join([lines[0], "s;mm;N", *lines[1:]]), encoding="utf-8")
    np.testing.assert_allclose(read_moving(path, lead=LEAD).position, LOG["position"])


def test_headings_given_by_hand(tmp_path):
    path = csv_of(tmp_path / "log.csv", ["t [s]", "axis1", "drive"], LOG["time"], 1e3 * LOG["position"], LOG["force"])
    columns = {"position": "axis1 [mm]", "force": "drive [N]"}
    assert not is_moving(path, {})
    assert is_moving(path, columns)
    np.testing.assert_allclose(read_moving(path, columns, lead=LEAD).position, LOG["position"])
    with pytest.raises(InputError, match="is not a column of the file"):
        read_moving(path, {"position": "axis9 [mm]"}, lead=LEAD)


@pytest.mark.parametrize(
    ("headings", "words"),
    [
        (["time [s]", "position", "force [N]"], 'needs a unit · write "position .mm."'),
        (["time [s]", "position [mm]", "noise [N]"], "no column of a force"),
        (["time [s]", "place [mm]", "force [N]"], "no column of a position"),
        (["time [s]", "position [N]", "force [N]"], "wrong unit"),
        (["time [s]", "position [mm]", "current [A]"], "needs the torque constant"),
        (["time [s]", "position [mm]", "voltage [V]"], "needs the gain"),
    ],
)
def test_faults_of_headings(tmp_path, headings, words):
    path = csv_of(tmp_path / "log.csv", headings, *(np.linspace(0.0, 1.0, 9) for _ in headings))
    with pytest.raises(InputError, match=words):
        read_moving(path, lead=LEAD)


def test_a_log_of_torques_at_steady_speed_is_no_moving_one(tmp_path):
    ramp = np.linspace(0.0, 1.0, 9)
    headings = ["time [s]", "position [mm]", "axial load [N]", "torque [N m]"]
    assert not is_moving(csv_of(tmp_path / "log.csv", headings, *(ramp for _ in headings)), {})
    headings = ["time [s]", "position [mm]", "torque [N m]"]
    path = csv_of(tmp_path / "moving.csv", headings, *(ramp for _ in headings))
    assert is_moving(path, {})
    assert not is_moving(path, {"axial_load": "0 N"})
    assert not is_moving(tmp_path / "none.csv", {})


def test_a_cell_that_is_no_number_is_named(tmp_path):
    path = csv_of(
        tmp_path / "log.csv", ["time [s]", "position [mm]", "force [N]"], *(np.linspace(0.0, 1.0, 9) for _ in range(3))
    )
    path.write_text(path.read_text(encoding="utf-8").replace("0.5,0.5,0.5", "0.5,off,0.5"), encoding="utf-8")
    with pytest.raises(InputError, match=r'log\.csv row 6, column "position .mm."'):
        read_moving(path, lead=LEAD)
    assert np.isnan(read_moving(path, lead=LEAD, keep_going=True).position[4])


@pytest.mark.slow
@pytest.mark.parametrize(
    "content", [b"", b"\n \n", b"\x00" * 600, b"MATLAB 5.0 MAT-file" + b"\xff" * 600, b"t,q,F\n", b"PK\x03\x04oops"]
)
@pytest.mark.parametrize("name", ["log.csv", "log.mat"])
def test_what_is_no_log_is_refused(tmp_path, content, name):
    path = tmp_path / name
    path.write_bytes(content)
    assert not is_moving(path, {}) or content == b"t,q,F\n"
    with pytest.raises(InputError):
        read_moving(path, lead=LEAD)
