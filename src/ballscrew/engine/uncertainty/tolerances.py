"""Tolerances that standards give to lengths: what a class says about how far a size may be off."""

from __future__ import annotations

import bisect
import math
from collections.abc import Mapping

from ballscrew.basis.quantities import Length, Ratio

#: Ends of the size steps, mm (ISO286-1). The first step counts from 1 mm.
SIZE_STEPS = (1, 3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500)
#: Standard tolerances as multiples of the tolerance factor i, by grade (ISO286-1): from IT6 on, ten times as much
#: every five grades.
MULTIPLES: Mapping[int, float] = {
    5: 7, 6: 10, 7: 16, 8: 25, 9: 40, 10: 64, 11: 100, 12: 160, 13: 250, 14: 400, 15: 640, 16: 1000, 17: 1600, 18: 2500,
}  # fmt: skip
#: Variation of the diameters within a lot of steel balls, m, by grade (ISO3290-1).
BALL_LOT_VARIATION: Mapping[int, Length] = {
    3: 0.13e-6, 5: 0.25e-6, 10: 0.5e-6, 16: 0.8e-6, 20: 1e-6, 24: 1.2e-6, 28: 1.4e-6, 40: 2e-6, 60: 3e-6, 100: 5e-6,
    200: 10e-6,
}  # fmt: skip
#: Travel variation over 300 mm, as a share of the travel, by class (ISO3408-3): 3.5, 6, 12, 23, 52 and 210 µm.
TRAVEL_VARIATION: Mapping[int, Ratio] = {
    grade: microns * 1e-6 / 0.3 for grade, microns in {0: 3.5, 1: 6, 3: 12, 5: 23, 7: 52, 10: 210}.items()
}


def standard_tolerance(size: Length, grade: int) -> Length | None:
    """Width of the tolerance zone of a size, m, by its grade; None for a grade or a size that has no formula.

    ISO286-1: a multiple of i = 0.45 D^⅓ + 0.001 D (i in µm, D in mm the geometric mean of the ends of the size
    step), rounded to whole micrometres up to 100 µm; within 1 µm of the printed table there. Larger ones are as
    the formula has them.
    """
    mm = round(1e3 * size, 6)  # 0.018 m are 18 mm, and no more
    if grade not in MULTIPLES or not 0 < mm <= SIZE_STEPS[-1]:
        return None
    step = max(1, bisect.bisect_left(SIZE_STEPS, mm))
    mean = math.sqrt(SIZE_STEPS[step - 1] * SIZE_STEPS[step])
    width = MULTIPLES[grade] * (0.45 * mean ** (1 / 3) + 0.001 * mean)
    return (round(width) if width <= 100 else width) * 1e-6
