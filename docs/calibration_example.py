"""The worked example of the page on calibration, from Python, run for its output."""

from pathlib import Path

import numpy as np

import ballscrew as bs
from ballscrew.cases.case_files import case_file
from ballscrew.files.torque_logs import reading

case = case_file.load(Path("examples/rig.toml"))
log = reading.read(Path("examples/rig_log.csv"))  # or arrays by name in SI: {"axial_load": ..., "torque": ...}
free = ["boundary_friction_coefficient", "constant_torque"]
found = bs.fit(case.model, case.screw, case.lubricant, log, free)

print(found.report(), end="\n\n")

load, speed, temperature = 5000.0, np.array([50, 200, 600]) * 2 * np.pi / 60, 313.15
print("friction torque", found.predict(load, speed, temperature), "N m")
mean, reading = (found.band(load, speed, temperature, scatter=scatter) for scatter in (False, True))
print("95 % hold the mean  ", mean.low, "to", mean.high)
print("95 % hold a reading ", reading.low, "to", reading.high, end="\n\n")

test = found.next_test({"axial_load": (500, 12_000)})
print("next test", test.best, "leaves", test.best_volume, "of the volume", end="\n\n")

samples = found.posterior(steps=300)  # needs the extra "calibrate"
print(
    "posterior", samples.interval("boundary_friction_coefficient"), "forgets in", samples.autocorrelation_time, "steps"
)
