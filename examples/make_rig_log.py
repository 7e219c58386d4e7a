"""A SYNTHETIC log of a ball screw on a test rig: ``examples/rig_log.csv``. No screw was measured for it.

The screw of ``examples/rig.toml`` is driven to and fro under loads that always pull in one direction: forward strokes
work against the load, reverse strokes are helped by it. The torque is that on the shaft. The truth behind it is known:

- friction: the model of the case, with the boundary friction coefficient and the torque of the seals below;
- the sensor: a zero error that drifts, white noise, and a few readings that are far off;
- ramps between the strokes, in which the inertia takes its share of the torque;
- oil that warms up from 25 to 45 °C; settings in random order, so that neither temperature nor drift follows them;
- a pause of the logger, and a few cells without a value.

    python examples/make_rig_log.py            fail if the file is not what this script makes
    python examples/make_rig_log.py --write    write it

The same bytes every time.
"""

from __future__ import annotations

import argparse
import dataclasses
import itertools
from pathlib import Path
from typing import Any

import numpy as np

from ballscrew.cases.case_files import case_file

HERE = Path(__file__).parent
LOG = HERE / "rig_log.csv"
SEED = 2005

#: What a fit should find.
BOUNDARY_FRICTION, SEAL_TORQUE = 0.105, 0.08  # -, N m
NOISE, DRIFT, ZERO_ERROR = 0.015, 0.04, 0.03  # N m: of one reading; over the log; at its beginning
OUTLIERS, OUTLYING = 0.01, 0.4  # share of the readings, and how far off they are, N m
INERTIA = 2e-3  # kg m², seen at the screw

LOADS = 0.5, 1.0, 2.0, 4.0, 7.0, 10.0  # kN
SPEEDS = 10.0, 25.0, 50.0, 100.0, 200.0, 400.0, 600.0  # rpm
STEP = 0.5  # s between rows
RAMP, STEADY, REST = 2, 31, 2  # rows; a stroke ramps up and down
PAUSE = 300.0  # s in which nothing is logged, halfway
COLD, WARM = 25.0, 45.0  # °C
BLANK = 12  # cells without a value
RPM = 2 * np.pi / 60


def columns() -> dict[str, Any]:
    """The log as it is written: s, rpm, N, N m, °C."""
    random = np.random.default_rng(SEED)
    settings = random.permutation(list(itertools.product(LOADS, SPEEDS)))
    up = (np.arange(RAMP) + 0.5) / RAMP
    stroke = np.concatenate([up, np.ones(STEADY), up[::-1], np.zeros(REST)])
    both = np.concatenate([stroke, -stroke])
    speed = np.concatenate([setting[1] * both for setting in settings])
    load = 1000 * np.repeat(settings[:, 0], both.size)
    time = STEP * np.arange(speed.size)
    time[speed.size // 2 :] += PAUSE
    temperature = COLD + (WARM - COLD) * np.expm1(-3 * time / time[-1]) / np.expm1(-3)
    # the rig holds the load to a per cent, and its load cell shows what it is
    load = load * (1 + 0.01 * np.sin(2 * np.pi * time / 47))
    torque = _torque(load, speed * RPM, temperature + 273.15)
    torque += INERTIA * np.gradient(speed * RPM, STEP)
    torque += ZERO_ERROR + DRIFT * time / time[-1] + random.normal(0, NOISE, time.size)
    wild = random.random(time.size) < OUTLIERS
    torque[wild] += random.choice([-OUTLYING, OUTLYING], np.count_nonzero(wild))
    found = {
        "time [s]": time,
        "speed [rpm]": speed + random.normal(0, 0.1, time.size),
        "axial load [N]": load + random.normal(0, 1.0, time.size),
        "torque [N m]": torque,
        "temperature [degC]": temperature + random.normal(0, 0.1, time.size),
    }
    for name in ("torque [N m]", "temperature [degC]"):
        found[name][random.choice(time.size, BLANK // 2, replace=False)] = np.nan
    return found


def _torque(load: Any, speed: Any, temperature: Any) -> Any:
    """The torque on the shaft, N m: with the friction where the screw turns, and without where it does not."""
    case = case_file.load(HERE / "rig.toml")
    friction: Any = case.model.friction
    friction = dataclasses.replace(friction, boundary_friction_coefficient=BOUNDARY_FRICTION)
    true = dataclasses.replace(case.model, friction=friction)
    turning = speed != 0
    oil = case.lubricant.at(temperature)
    result = true(case.screw, oil, axial_load=load, screw_speed=np.where(turning, np.abs(speed), 1.0))
    return result.ideal_torque + np.where(turning, np.sign(speed) * (result.screw_torque + SEAL_TORQUE), 0.0)


def text() -> str:
    """The file."""
    found = columns()
    digits = 1, 1, 0, 4, 1
    lines = [
        "# SYNTHETIC: made by examples/make_rig_log.py; no screw was measured. "
        f"True boundary friction coefficient {BOUNDARY_FRICTION}, seal torque {SEAL_TORQUE} N m, noise {NOISE} N m",
        ",".join(found),
    ]
    for row in zip(*(values.tolist() for values in found.values()), strict=True):
        cells = ("" if np.isnan(x) else f"{x + 0.0:.{n}f}" for x, n in zip(row, digits, strict=True))
        lines.append(",".join(cells))
    return "\n".join(lines) + "\n"


def main() -> None:
    """Compare or write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true", help="write examples/rig_log.csv")
    made = text().encode()
    if parser.parse_args().write:
        LOG.write_bytes(made)
    elif LOG.read_bytes() != made:
        raise SystemExit(f"{LOG.name} is not what this script makes; --write writes it anew")


if __name__ == "__main__":
    main()
