"""Numbers of a report with no more digits than a band leaves."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from ballscrew import units
from ballscrew.output.plain_numbers import MILLIONS, plain
from ballscrew.quantities import Quantity
from ballscrew.uncertainty.bands import OutputBand

#: What :func:`~ballscrew.units.placeholders` puts in place of a quantity.
_PLACEHOLDER = re.compile(r"\{(\d+)_*\}")
#: Half of a band is written with two digits if its first ones are below this, else with one.
_TWO_DIGITS_BELOW = 3.55
_MOST_DECIMALS = 6


class Banded(NamedTuple):
    """A number and its band in words, both with the digits that the band leaves."""

    value: str
    interval: str


def banded(value: float, low: float, high: float, quantity: Quantity) -> Banded:
    """A value in SI with the interval in which it lies, as many digits as half of the interval has with one or two.

    Where there is no interval the value has its four digits and the interval is empty.
    """
    ends = [float(units.from_si(end, quantity)) for end in (low, high)]
    if not all(map(math.isfinite, (value, *ends))) or not ends[1] > ends[0]:
        return Banded("–" if not math.isfinite(value) else plain(units.shown(value + 0.0, quantity)), "")
    place = last_place(*ends)
    unit = f" {units.label(quantity)}".rstrip()
    numbers = [to_place(number, place) for number in (float(units.from_si(value, quantity)), *ends)]
    return Banded(f"{numbers[0]}{unit}", f"{numbers[1]} to {numbers[2]}{unit}")


def last_place(low: float, high: float) -> int:
    """The power of ten at which numbers end that are known to an interval."""
    half = abs(high - low) / 2
    power = math.floor(math.log10(half))
    return power - (half / 10**power < _TWO_DIGITS_BELOW)


def to_place(value: float, place: int) -> str:
    """A number that ends at a power of ten, with the zeros that say so."""
    if place < -_MOST_DECIMALS:
        return plain(f"{value:.4g}")
    rounded = round(value, -place) + 0.0
    return f"{rounded:.{max(0, -place)}f}" if abs(rounded) < MILLIONS else plain(f"{rounded:.{_MOST_DECIMALS}e}")


def banded_share(value: float, low: float, high: float) -> Banded:
    """As :func:`banded`, of a share in per cent."""
    if not all(map(math.isfinite, (value, low, high))) or not high > low:
        return Banded(f"{100 * value:.1f} %" if math.isfinite(value) else "–", "")
    place = last_place(100 * low, 100 * high)
    numbers = [to_place(100 * number, place) for number in (value, low, high)]
    return Banded(f"{numbers[0]} %", f"{numbers[1]} to {numbers[2]} %")


def with_digits_of(bands: Mapping[str, OutputBand], texts: Callable[[], Sequence[str]]) -> list[str]:
    """Texts whose quantities have no more digits than the bands of the outputs of the same name leave them."""
    with units.placeholders() as shown:
        templates = texts()

    def filled(found: re.Match[str]) -> str:
        one = shown[int(found[1])]
        band = bands.get(one.quantity.name)
        return one.text if band is None else banded(one.value, *band.both, one.quantity).value

    return [_PLACEHOLDER.sub(filled, template) for template in templates]
