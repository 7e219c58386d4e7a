"""Parts of the page on uncertainty: default uncertainties, a figure, and the coverage of vendors' rows.

``python docs/uncertainty_tables.py`` prints the coverage, which takes minutes: too slow for each build of the pages;
with ``--write`` into docs/coverage.inc.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure

from ballscrew.cases.case_files import case_file
from ballscrew.engine.uncertainty.uncertain_value import JUDGEMENT, DefaultUncertainty, default_uncertainties
from ballscrew.evidence.validation.entries import Entry, Point, may_be_fitted
from ballscrew.faces.sheets import pictures
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.questions.band import compute as band
from ballscrew.questions.band.sheet import sheet
from ballscrew.questions.shared.text_tables import markdown_table
from ballscrew.questions.validate.compute import evaluate, request, with_bands

sys.path.append(str(Path(__file__).parents[1] / "benchmarks"))
from harness import study

EXAMPLES = Path(__file__).parents[1] / "examples"
#: Sets of torques without load of ball screws.
SETS_COVERED = ("rexroth-double-nut", "rexroth-single-nut", "hiwin-stock", "thk-jis", "xjtu")
#: What was made of rows before, the most of it first.
_USES = (
    "a calibration is fitted to them",
    "kept aside, but seen when a factor was chosen",
    "never used",
)


def parts() -> dict[str, Any]:
    """The picture, and the table of assumptions as Markdown."""
    return {"band.svg": picture, "assumed.md": assumed_table()}


def picture() -> Figure:
    """The band of the torque of an example."""
    case, options = case_file.load(EXAMPLES / "feed_drive.toml"), band.BandOptions()
    report = band.band(case, options)
    return pictures.picture(sheet(case, report, band.curve(case, report, options)))


def assumed_table() -> str:
    """Default uncertainties of numbers that users rarely know."""
    every = default_uncertainties().items()
    rows = [(f"`{name}`", _spread(one), _source(one), one.reason) for name, one in every]
    return markdown_table(("input", "95 % lie", "source", "reason"), rows)


def _spread(one: DefaultUncertainty) -> str:
    if one.half_width is not None:
        return f"within {one.half_width:g} K" if one.name == TEMPERATURE.name else f"within {1e6 * one.half_width:g} µm"
    if one.share is not None:
        of = " of its excess over 0.5" if one.name.endswith("conformity") else ""
        return f"within {one.share:.0%}{of}"
    if one.between is not None:
        return "from {:g} to {:g}, triangular".format(*one.between)
    if one.limits is not None:
        return f"within {one.limits:.0%}, uniform"
    return f"within a factor of {one.factor:g}, log-normal"


def _source(one: DefaultUncertainty) -> str:
    return one.source if one.source == JUDGEMENT else f"{{cite:t}}`{one.source}`"


class Covered(NamedTuple):
    """What a row states, against the band of the model: a torque lies "in" it, "below" or "above" it."""

    places: tuple[str, ...]
    #: Upper over lower end of the band.
    width: float


def coverage_table() -> str:
    """Number of stated torques inside, below and above the model's 95 % interval of their row, and its width."""
    grouped: dict[tuple[str, ...], list[Covered]] = {}
    for entries, _ in evaluate(request(SETS_COVERED)):
        for entry in entries:
            if entry.calibration is not None and entry.calibration not in entry.data.calibrations:
                continue
            # of screws each of which could be the one measured validate makes no band
            for point in (with_bands(entry) if entry.data.alternatives else entry).points:
                label = "calibrated" if entry.calibration else "reference"
                nuts = f"two torques, {point.group} that it could be" if entry.data.alternatives else point.group
                key = (entry.data.maker, nuts, label, _use(entry, point))
                grouped.setdefault(key, []).append(_covered(entry, point))
    heads = (
        "maker",
        "nuts",
        "model",
        "these rows",
        "in the band",
        "below it",
        "above it",
        "high / low of the band, median",
    )
    rows = [
        [*key, *_counts(those), f"{np.median([one.width for one in those]):.1f}"]
        for key, those in sorted(grouped.items(), key=lambda one: (one[0][2] != "reference", _USES.index(one[0][3])))
    ]
    return markdown_table(heads, rows)


def _use(entry: Entry, point: Point) -> str:
    """The use that was made of a row before."""
    fitted, seen, never = _USES
    if entry.data.alternatives:
        return never
    if entry.data.name != "hiwin-stock" or may_be_fitted(entry.data.name, point):
        return fitted
    return never if point.group.startswith("single") else seen


def _covered(entry: Entry, point: Point) -> Covered:
    assert point.uncertainty is not None, point.name
    low, high = point.uncertainty
    band = point.band
    stated = (band.low, band.high) if entry.data.alternatives else (band.middle,)
    places = ("below" if one < low else "above" if one > high else "in" for one in stated if one is not None)
    return Covered(tuple(places), high / low)


def _counts(those: Sequence[Covered]) -> list[str]:
    places = [place for one in those for place in one.places]
    return [f"{places.count(place)} of {len(places)}" for place in ("in", "below", "above")]


if __name__ == "__main__":
    study(__doc__, coverage_table, "coverage.inc")
