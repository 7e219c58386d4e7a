"""SYNTHETIC logs of a moving axis: ``examples/axis_log.csv`` and ``axis_test.csv``. No axis was measured for them.

The screw of ``examples/axis.toml`` moves a table to and fro. The log has what a drive records: time, position of the
table, torque of the motor. The truth behind it is known:

- a table of 40 kg, and a rotor that weighs as much at the nut as its inertia says;
- friction: the model of the case, with the viscosity below, and a constant force of the seals;
- an offset, which is no gravity but the zero of the torque;
- noise of the torque that lasts a tenth of a second, and a position in steps of a micrometre.

    python examples/make_axis_log.py            fail if the files are not what this script makes
    python examples/make_axis_log.py --write    write them

The same bytes every time.
"""

from __future__ import annotations

import argparse
import dataclasses
from pathlib import Path
from typing import Any

import numpy as np

from ballscrew.cases.case_files import case_file

HERE = Path(__file__).parent
#: What a fit should find: kg, kg m², Pa s, N, N.
TABLE, ROTOR, VISCOSITY, SEALS, OFFSET = 40.0, 2e-5, 0.05, 8.0, -4.0
NOISE, LASTING = 1.5, 0.1  # N at the nut, s
STEP, RESOLUTION = 4e-3, 1e-6  # s, m
ACCELERATION, HOLD, REST = 2.0, 0.4, 0.1  # m/s², s, s
#: The speeds of the strokes, m/s, and the seed of the noise, by log.
LOGS = {"axis_log.csv": ((0.03, 0.1, 0.2, 0.3), 1), "axis_test.csv": ((0.05, 0.15, 0.25), 2)}
REPEATS = 2
ROUNDED = 15  # rows over which corners are rounded


def columns(speeds: tuple[float, ...], seed: int) -> dict[str, Any]:
    """A log as it is written: s, mm, N m."""
    random = np.random.default_rng(seed)
    pieces = []
    for top in speeds * REPEATS:
        ramp = np.linspace(0, top, max(2, int(top / ACCELERATION / STEP)))
        stroke = np.concatenate([ramp, np.full(int(HOLD / STEP), top), ramp[::-1], np.zeros(int(REST / STEP))])
        pieces += [stroke, -stroke]
    window = np.hanning(ROUNDED + 2)
    speed = np.convolve(np.concatenate(pieces), window / window.sum(), mode="same")
    position = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * STEP)])
    acceleration = np.gradient(speed, STEP)
    case = case_file.load(HERE / "axis.toml")
    turns = 2 * np.pi / float(case.screw.lead)
    oil = dataclasses.replace(case.lubricant, viscosity=VISCOSITY)
    load = TABLE * acceleration
    moves = np.abs(speed) > 1e-6
    found = case.model(case.screw, oil, axial_load=load[moves], screw_speed=turns * speed[moves])
    friction = np.zeros(speed.size)
    friction[moves] = np.sign(speed[moves]) * (turns * found.screw_torque + SEALS)
    mass = TABLE + ROTOR * turns**2
    noise = random.standard_normal(speed.size)
    kept = np.exp(-STEP / LASTING)
    for row in range(1, noise.size):
        noise[row] = kept * noise[row - 1] + np.sqrt(1 - kept**2) * noise[row]
    force = mass * acceleration + friction + OFFSET + NOISE * noise
    stepped = RESOLUTION * np.round(position / RESOLUTION)
    return {
        "time [s]": STEP * np.arange(speed.size),
        "position [mm]": 1e3 * stepped,
        "motor torque [N m]": force / turns,
    }


def text_of(data: dict[str, Any]) -> str:
    """The log as CSV."""
    digits = ("{:.3f}", "{:.3f}", "{:.5f}")
    lines = ["# SYNTHETIC: made by examples/make_axis_log.py, measured on no axis", ",".join(data)]
    for row in zip(*data.values(), strict=True):
        lines.append(",".join(form.format(value + 0.0) for form, value in zip(digits, row, strict=True)))
    return "\n".join(lines) + "\n"


def main() -> None:
    """Write the logs, or compare them with what is there."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true")
    write = parser.parse_args().write
    for name, (speeds, seed) in LOGS.items():
        text = text_of(columns(speeds, seed))
        if write:
            (HERE / name).write_text(text, encoding="utf-8")
        elif (HERE / name).read_text(encoding="utf-8") != text:
            raise SystemExit(f"{name} is not what this script makes: run it with --write")


if __name__ == "__main__":
    main()
