"""Numbers of a report with their bands: the digits of all numbers for people, the ends rounded outward."""

from __future__ import annotations

import math
from typing import NamedTuple

from ballscrew.basis import units
from ballscrew.basis.output.plain_numbers import plain
from ballscrew.basis.quantities import Quantity


class Banded(NamedTuple):
    """A number and its band in words; the number is written as without a band."""

    value: str
    interval: str


def banded(value: float, low: float, high: float, quantity: Quantity) -> Banded:
    """A value in SI with the interval in which it lies, empty where there is none."""
    said = "–" if not math.isfinite(value) else plain(units.shown(value + 0.0, quantity))
    if not all(map(math.isfinite, (value, low, high))) or not high > low:
        return Banded(said, "")
    start, end = units.rounded(low + 0.0, quantity, toward=-1), units.rounded(high + 0.0, quantity, toward=1)
    return Banded(said, " ".join(filter(None, (f"{plain(start)} to {plain(end)}", units.label(quantity)))))


def banded_share(value: float, low: float, high: float) -> Banded:
    """As :func:`banded`, of a share in per cent."""
    said = f"{units.to_digits(100 * value)} %" if math.isfinite(value) else "–"
    if not all(map(math.isfinite, (value, low, high))) or not high > low:
        return Banded(said, "")
    return Banded(said, f"{units.to_digits(100 * low, toward=-1)} to {units.to_digits(100 * high, toward=1)} %")
