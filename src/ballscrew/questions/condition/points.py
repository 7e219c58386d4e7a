"""The curve of a condition over time that is no state of a test: the trend of the preload."""

from __future__ import annotations

import math

import numpy as np

from ballscrew.evidence.calibration.robust import Vector
from ballscrew.evidence.service.condition_values import Condition


def trend_of(found: Condition) -> Vector | None:
    """The preload by the trend at the time of each test, over that of the first tests; None where there is no trend.

    Of the slope b of the logarithm of the preload it is exp(a + b t), with the a that has as many tests above the curve
    as below.
    """
    if not math.isfinite(found.trend.slope):
        return None
    times = np.array([one.time for one in found.states])
    preload = np.array([one.preload for one in found.states])
    middle = float(np.nanmedian(np.log(preload) - found.trend.slope * times))
    return np.exp(middle + found.trend.slope * times)
