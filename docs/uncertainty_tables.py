"""Parts of the page on uncertainty: default uncertainties, a figure, and the coverage of vendors' rows."""

from __future__ import annotations

import dataclasses
from pathlib import Path

from ballscrew.cases import case_file
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
_SETS = {"rexroth-double-nut": (DoubleNut, (7, 10)), "rexroth-single-nut": (OversizeBallNut, (5,))}
_SAMPLES = 2**8


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


def coverage_table() -> str:
    """Number of vendors' rows with the middle of their band inside, below and above the model's 95 % interval."""
    lines = ["| rows | model | in the band | below it | above it |", "|---|---|---:|---:|---:|"]
    for model in (FrictionModel.reference(), calibrated(FrictionModel.reference(), calibration("rexroth-2006"))):
        for name in _SETS:
            places = list(coverage(model, name))
            counts = " | ".join(f"{places.count(place)} of {len(places)}" for place in ("in", "below", "above"))
            label = "reference" if model == FrictionModel.reference() else "calibrated"
            lines.append(f"| {name} | {label} | {counts} |")
    return "\n".join(lines) + "\n"


def coverage(model: FrictionModel, name: str):
    """Middle of the vendor's band for each row and preload: "in" the model's band, "below" or "above"."""
    nut, preloads = _SETS[name]
    for values in shipped_rows(SETS[name]):
        for percent in preloads:
            found = band.band(_case(model, values, nut, percent), band.Options(samples=_SAMPLES)).band
            column = f"no_load_torque_{percent}pct"
            middle = (values[f"{column}_min"] + values[f"{column}_max"]) / 2
            low, high = found["screw_torque"].both
            yield "below" if middle < low else "above" if middle > high else "in"


def _case(model: FrictionModel, values: Values, nut: type[Nut], percent: int) -> case_file.Case:
    """Case of a row without load, at the conditions of the vendor."""
    at = Conditions().of(values)
    braced = nut(preload=percent / 100 * values["dynamic_load_rating"])
    return case_file.Case(
        model=model,
        screw=dataclasses.replace(screw_of(values).screw(), nut=braced),
        lubricant=at.lubricant,
        operation=OperatingState(axial_load=0.0, screw_speed=at.screw_speed),
        sweep={},
        oil={"grade": at.grade, "temperature": at.temperature},
        calibration=None if model == FrictionModel.reference() else calibration("rexroth-2006"),
    )
