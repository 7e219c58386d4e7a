"""Parts of the page on uncertainty: default uncertainties, a figure, and the coverage of vendors' rows."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ballscrew.cases import case_file
from ballscrew.cases.nut_kinds import NUTS
from ballscrew.components.nut import DoubleNut, Nut, OversizeBallNut
from ballscrew.components.operating_state import OperatingState
from ballscrew.figures import band as figures
from ballscrew.figures import style
from ballscrew.friction.calibrations import calibrated, calibration
from ballscrew.friction.model import FrictionModel
from ballscrew.studies import band
from ballscrew.studies.validation import shipped_rows
from ballscrew.uncertainty.default_uncertainties import JUDGEMENT, DefaultUncertainty, default_uncertainties
from ballscrew.validation.entries import Conditions, Values
from ballscrew.validation.rows import screw_of
from ballscrew.validation.sets import SETS

EXAMPLES = Path(__file__).parents[1] / "examples"
#: Kinds of nut by set, and preloads in per cent of the dynamic load rating for which a band of torques is stated.
_PRELOADS = {"rexroth-double-nut": (DoubleNut, (7, 10)), "rexroth-single-nut": (OversizeBallNut, (5,))}
#: The sets whose rows are held against bands; those of the last are screws that could be the measured one.
SETS_COVERED = (*_PRELOADS, "xjtu")
CALIBRATION = "rexroth-2006"
SAMPLES = 2**8


def write(folder: Path) -> None:
    """The picture as SVG and PNG, tables as Markdown."""
    folder.mkdir(parents=True, exist_ok=True)
    case = case_file.load(EXAMPLES / "feed_drive.toml")
    with style.house_style():
        options = band.Options()
        report = band.band(case, options)
        style.save(figures.picture(case, report, band.curve(case, report, options)), folder, "band")
    (folder / "assumed.md").write_text(assumed_table(), encoding="utf-8")
    (folder / "coverage.md").write_text(coverage_table(), encoding="utf-8")


def assumed_table() -> str:
    """Default uncertainties of numbers that users rarely know."""
    rows = [
        f"| `{name}` | {_spread(one)} | {_source(one)} | {one.reason} |"
        for name, one in default_uncertainties().items()
    ]
    return "\n".join(["| input | 95 % lie | source | reason |", "|---|---|---|---|", *rows]) + "\n"


def _spread(one: DefaultUncertainty) -> str:
    if one.half_width is not None:
        return f"within {one.half_width:g} K"
    if one.share is not None:
        of = " of its excess over 0.5" if one.name.endswith("conformity") else ""
        return f"within {one.share:.0%}{of}"
    if one.limits is not None:
        return f"within {one.limits:.0%}, uniform"
    return f"within a factor of {one.factor:g}, log-normal"


def _source(one: DefaultUncertainty) -> str:
    return one.source if one.source == JUDGEMENT else f"{{cite:t}}`{one.source}`"


class Covered(NamedTuple):
    """A row of a vendor, or a screw that could be the measured one, against the band of the model."""

    #: The middle of what is stated lies "in" the band, "below" or "above" it.
    place: str
    #: Width of the band over its median.
    width: float


def coverage_table() -> str:
    """Number of rows with their stated middle inside, below and above the model's 95 % interval, and its width."""
    lines = [
        "| rows | model | in the band | below it | above it | width / median of the band, in the median |",
        "|---|---|---:|---:|---:|---:|",
    ]
    for model in (FrictionModel.reference(), calibrated(FrictionModel.reference(), calibration(CALIBRATION))):
        label = "reference" if model == FrictionModel.reference() else "calibrated"
        found = {name: coverage(model, name) for name in SETS_COVERED}
        vendors = [one for name, those in found.items() if not SETS[name].alternatives for one in those]
        for words, those in {**found, "both sets of a vendor": vendors}.items():
            lines.append(f"| {words} | {label} | {_counts(those)} | {np.median([one.width for one in those]):.2f} |")
    return "\n".join(lines) + "\n"


def _counts(those: Sequence[Covered]) -> str:
    places = [one.place for one in those]
    return " | ".join(f"{places.count(place)} of {len(places)}" for place in ("in", "below", "above"))


def coverage(model: FrictionModel, name: str) -> list[Covered]:
    """The rows of a set against the bands of a model at their conditions, without load."""
    found: list[Covered] = []
    for values, nut, middle in _rows(name):
        band_of_row = band.band(_case(model, values, nut), band.Options(samples=SAMPLES)).band
        low, high = band_of_row["screw_torque"].both
        place = "below" if middle < low else "above" if middle > high else "in"
        found.append(Covered(place, (high - low) / band_of_row["screw_torque"].median))
    return found


def _rows(name: str) -> Iterator[tuple[Values, Nut, float]]:
    """The values of the rows of a set, their nuts, and the middle of what is stated of each."""
    for values in shipped_rows(SETS[name]):
        if name == "xjtu":
            nut = NUTS[values["nut"]](preload=values["preload"])
            yield values, nut, (values["torque_min"] + values["torque_max"]) / 2
            continue
        kind, preloads = _PRELOADS[name]
        for percent in preloads:
            column = f"no_load_torque_{percent}pct"
            nut = kind(preload=percent / 100 * values["dynamic_load_rating"])
            yield values, nut, (values[f"{column}_min"] + values[f"{column}_max"]) / 2


def _case(model: FrictionModel, values: Values, nut: Nut) -> case_file.Case:
    """Case of a row without load, at its conditions."""
    at = Conditions().of(values)
    return case_file.Case(
        model=model,
        screw=dataclasses.replace(screw_of(values).screw(), nut=nut),
        lubricant=at.lubricant,
        operation=OperatingState(axial_load=0.0, screw_speed=at.screw_speed),
        sweep={},
        oil={"grade": at.grade, "temperature": at.temperature},
        calibration=None if model == FrictionModel.reference() else calibration(CALIBRATION),
    )
