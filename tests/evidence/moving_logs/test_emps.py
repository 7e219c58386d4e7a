"""The record of the EMPS benchmark against its published numbers, where somebody has the file.

Its licence is not stated, so this repository has no copy (docs/howto/moving_log.md says where it is). The test runs
where the environment variable BALLSCREW_EMPS names the folder of DATA_EMPS.mat, and is skipped elsewhere.
"""

import os
from pathlib import Path

import pytest

import ballscrew as bs
from ballscrew.evidence.moving_logs.motion_fit import LINEAR, SCREW
from ballscrew.evidence.moving_logs.reading import read_moving
from support.moving_logs import MODEL, OIL, SCREW_OF

FOLDER = Path(os.environ.get("BALLSCREW_EMPS", "nowhere"))


@pytest.mark.skipif(
    not (FOLDER / "DATA_EMPS.mat").is_file(), reason="BALLSCREW_EMPS names no folder with DATA_EMPS.mat"
)
def test_the_published_numbers_of_emps():
    log = read_moving(FOLDER / "DATA_EMPS.mat", lead=float(SCREW_OF.lead))
    other = FOLDER / "DATA_EMPS_PULSES.mat"
    test = read_moving(other, lead=float(SCREW_OF.lead), usual_gain=log.gain) if other.is_file() else None
    found = bs.fit_motion(MODEL, SCREW_OF, OIL, log, test=test)
    # JanotGautierBrunot2019: 95.1089 kg, 203.5034 N s/m, 20.3935 N, -3.1648 N
    assert found.estimates["mass"].value == pytest.approx(95.1089, rel=5e-3)
    assert found.estimates["coulomb_force"].value == pytest.approx(20.3935, rel=5e-2)
    assert found.estimates["viscous_coefficient"].value == pytest.approx(203.5034, rel=5e-2)
    assert found.estimates["offset"].value == pytest.approx(-3.1648, rel=5e-2)
    assert found.relative_errors[SCREW] <= found.relative_errors[LINEAR]
    if test is not None:
        assert found.cross_errors[SCREW] <= found.cross_errors[LINEAR]
    low, high = found.estimates["speed_exponent"].interval
    assert 0.6 < low < high < 1.0
