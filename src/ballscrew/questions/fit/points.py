"""Points of the picture of a fit, as the figure and the page draw them; SI."""

from __future__ import annotations

from typing import Any

import numpy as np

from ballscrew.evidence.calibration.calibrated_model import CalibratedModel
from ballscrew.questions.shared.log_points import MOST_POINTS, Numbers, short, some

#: Kinds of rows of a fit.
KINDS = ("fitted", "held_out", "outlier")


def measured_and_predicted(model: CalibratedModel) -> tuple[Numbers, Numbers]:
    """The friction torque of each row as it was measured, and by the calibrated model, N m."""
    rows = model.rows
    predicted = rows.friction + model.constant_torque
    return predicted - rows.residuals * rows.direction, predicted


def of_fit(model: CalibratedModel) -> dict[str, Any]:
    """The rows of a fit to draw: kind, measured and predicted friction torque, and where they were measured."""
    rows = model.rows
    places = some(np.arange(len(rows.log)), MOST_POINTS)
    measured, predicted = measured_and_predicted(model)
    kinds = np.where(rows.outlying, 2, np.where(rows.held_out, 1, 0))
    columns = {
        "measured": measured,
        "predicted": predicted,
        "residual": predicted - measured,
        "screw_speed": np.abs(rows.log.screw_speed),
        "axial_load": np.abs(rows.log.axial_load),
        "temperature": rows.log.temperature,
        "time": rows.log.time,
    }
    return {
        "rows": len(rows.log),
        "kinds": [KINDS[kind] for kind in kinds[places]],
        **{name: short(values[places]) for name, values in columns.items() if values is not None},
    }
