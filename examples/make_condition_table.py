"""A SYNTHETIC table of torques over the years: ``examples/nut_over_years.csv``. No nut was measured.

The screw of ``examples/service.toml`` is turned without load at 100 rpm four times a year, both ways. The truth:

- the preload stays for two years and then goes down evenly, to 75 % of it in the last test;
- the oil is as warm as the season makes it, 18 °C to 34 °C, which moves the torque more than the wear does;
- each mean torque has 1 % of noise, the sensor of the nut 0.5 K, and gravity adds the same to both directions.

    python examples/make_condition_table.py            fail if the file is not what this script makes
    python examples/make_condition_table.py --write    write it

The same bytes every time.
"""

from __future__ import annotations

import argparse
import datetime
import math
from pathlib import Path

import numpy as np

from ballscrew.cases.case_files import case_file
from ballscrew.engine.evaluation.plan import Configuration

HERE = Path(__file__).parent
FILE = HERE / "nut_over_years.csv"
TESTS, HEALTHY = 24, 8  # tests in all, and before the wear
LEFT, PRELOAD = 0.75, 4326.0  # share of the preload left, and the preload, N
NOISE, OFFSET = 0.01, 0.03  # of a mean torque; gravity, N m
MEAN, SEASON, READING = 26.0, 8.0, 0.5  # °C, K, K
RPM = 2 * np.pi / 60


def text() -> str:
    """The file."""
    random = np.random.default_rng(2026)
    number = np.arange(TESTS)
    left = 1 - (1 - LEFT) * np.clip((number - HEALTHY + 1) / (TESTS - HEALTHY), 0, 1)
    warm = MEAN + SEASON * np.sin(2 * math.pi * (number - 1) / 4) + random.normal(0, 1, TESTS)
    case = case_file.load(HERE / "service.toml")
    true = Configuration(case.model, case.screw, case.lubricant).changed({"nut.preload": PRELOAD * left})
    oil = true.lubricant.at(warm + 273.15)
    friction = true.model(true.screw, oil, axial_load=0.0, screw_speed=100 * RPM).screw_torque
    up, down = (friction * (1 + random.normal(0, NOISE, TESTS)) + side * OFFSET for side in (1, -1))
    read = warm + random.normal(0, READING, TESTS)
    lines = [
        "# SYNTHETIC: made by examples/make_condition_table.py; no nut was measured. "
        f"True preload {PRELOAD:.0f} N, and {LEFT:.0%} of it in the last test",
        "date,torque up [N m],torque down [N m],temperature [degC],speed [rpm]",
    ]
    for i in range(TESTS):
        date = datetime.date(2020 + i // 4, 3 * (i % 4) + 2, 15)
        lines.append(f"{date},{up[i]:.3f},{down[i]:.3f},{read[i]:.1f},100")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Compare or write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true", help="write the table")
    made = text().encode()
    if parser.parse_args().write:
        FILE.write_bytes(made)
    elif FILE.read_bytes() != made:
        raise SystemExit(f"{FILE.name} is not what this script makes; --write writes it anew")


if __name__ == "__main__":
    main()
