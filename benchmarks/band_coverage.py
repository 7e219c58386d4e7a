"""How often the band of an uncalibrated nut holds what makers state, over the factor of the force between balls.

The rows declared in ``data/validation/splits.toml`` would allow a factor of 1.5; at 2 two of the nuts kept aside lie
outside, at 2.5 none. ``data/uncertainties.toml`` has 2.5: so its choice has seen all rows.

    python benchmarks/band_coverage.py
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from unittest import mock

import numpy as np

from ballscrew.engine.uncertainty import default_uncertainties
from ballscrew.evidence.validation.entries import Entry, Point, may_be_fitted
from ballscrew.questions.validate import compute
from ballscrew.questions.validate.uncertainty import with_bands

SETS = ("rexroth-double-nut", "rexroth-single-nut", "hiwin-stock", "thk-jis")
FACTORS = (1.5, 2.0, 2.5, 3.0)
NAME = "ball_force.share_of_load"
TWO_CONTACTS = ("double", "offset")
#: Groups of rows, by words.
GROUPS: Mapping[str, Callable[[str, Point], bool]] = {
    "two contacts, fitted": lambda data, point: point.group in TWO_CONTACTS and may_be_fitted(data, point),
    "two contacts, kept aside": lambda data, point: point.group in TWO_CONTACTS and not may_be_fitted(data, point),
    "four contacts of Rexroth": lambda data, _: data == "rexroth-single-nut",
    "single nuts of HIWIN": lambda data, point: data == "hiwin-stock" and point.group.startswith("single"),
}


def with_factor(entry: Entry, factor: float) -> Entry:
    """An entry with the bands of its rows where the force between balls is uncertain by this factor."""
    table = dict(default_uncertainties.default_uncertainties())
    table[NAME] = dataclasses.replace(table[NAME], factor=factor)
    with mock.patch.object(default_uncertainties, "default_uncertainties", return_value=table):
        return with_bands(entry)


def main() -> None:
    """Print the table as Markdown."""
    request = dataclasses.replace(compute.request(SETS), calibration=None)
    entries = [found[0] for found, _ in compute.evaluate(request)]
    print("| factor | " + " | ".join(f"{words}: within, upper / lower end" for words in GROUPS) + " |")
    print("|---" * (1 + len(GROUPS)) + "|")
    for factor in FACTORS:
        found = [with_factor(entry, factor) for entry in entries]
        cells: list[str] = []
        for belongs in GROUPS.values():
            points = [point for entry in found for point in entry.points if belongs(entry.data.name, point)]
            ends = [point.uncertainty for point in points if point.uncertainty is not None]
            inside = sum(bool(point.in_uncertainty_band) for point in points)
            width = np.exp(np.mean([np.log(high / low) for low, high in ends]))
            cells.append(f"{inside} of {len(points)}, {width:.1f}")
        print(f"| {factor:g} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
