"""The curves of a report: what stands beside the torque where the screw is starved of oil."""

import numpy as np
import pytest

from ballscrew.cases.case_files import case_file
from ballscrew.faces.report.curve_figures import pictures
from ballscrew.faces.report.curves import curves
from support.commands import ROOT

EXAMPLE = ROOT / "examples" / "feed_drive.toml"
LABEL = "all, in a full bath of oil"


def case_at(temperature):
    return case_file.load(EXAMPLE, [f"lubricant.temperature={temperature}"])


def test_a_starved_screw_has_the_torque_of_a_full_bath_over_the_speed():
    case = case_at("-10 degC")
    found = curves(case)
    assert found.flooded_torque is not None
    wanted = case.model(
        case.screw, case.lubricant, axial_load=case.operation.axial_load, screw_speed=case.operation.screw_speed
    ).flooded_torque
    middle = len(found.speeds) // 2  # curves end at twice the operating point
    assert found.flooded_torque[middle] == pytest.approx(float(wanted), rel=1e-12)
    assert found.flooded_torque[middle] > 1.1 * np.sum([part[middle] for part in found.parts.values()])
    assert LABEL in pictures(found)["speed"]


def test_one_that_is_not_starved_has_one_torque():
    found = curves(case_at("60 degC"))
    assert found.flooded_torque is None
    assert LABEL not in pictures(found)["speed"]
