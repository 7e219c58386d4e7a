"""Parts of the page on uncertainty: default uncertainties, a figure, and the coverage of vendors' rows.

``python docs/uncertainty_tables.py`` prints the coverage, which takes minutes; with ``--write`` into docs/coverage.inc.
"""

from __future__ import annotations

import argparse
import dataclasses
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ballscrew.cases.case_files import case_file
from ballscrew.cases.screw_tables.nut_kinds import NUTS
from ballscrew.engine.uncertainty.default_uncertainties import JUDGEMENT, DefaultUncertainty, default_uncertainties
from ballscrew.evidence.validation.entries import Conditions, Values
from ballscrew.evidence.validation.rows import screw_of
from ballscrew.evidence.validation.sets import SETS
from ballscrew.physics.components.nut import DoubleNut, Nut, OversizeBallNut
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.friction.calibrations import calibrated, calibration
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.questions.band import compute as band
from ballscrew.questions.band import figure as figures
from ballscrew.questions.shared import charts
from ballscrew.questions.validate.compute import shipped_rows

EXAMPLES = Path(__file__).parents[1] / "examples"
#: Where the coverage stands: too slow for each build of the pages.
PAGE = Path(__file__).parent / "coverage.inc"
#: Kinds of nut by set, and preloads in per cent of the dynamic load rating for which a band of torques is stated.
_PRELOADS = {"rexroth-double-nut": (DoubleNut, (7, 10)), "rexroth-single-nut": (OversizeBallNut, (5,))}
CALIBRATION = "rexroth-2006"
SAMPLES = 2**11


def write(folder: Path) -> None:
    """The picture as SVG and PNG, tables as Markdown."""
    folder.mkdir(parents=True, exist_ok=True)
    case = case_file.load(EXAMPLES / "feed_drive.toml")
    with charts.house_style():
        options = band.BandOptions()
        report = band.band(case, options)
        charts.save_as(figures.picture(case, report, band.curve(case, report, options)), folder / "band.svg", "svg")
    (folder / "assumed.md").write_text(assumed_table(), encoding="utf-8")


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
    if one.between is not None:
        return "from {:g} to {:g}, triangular".format(*one.between)
    if one.limits is not None:
        return f"within {one.limits:.0%}, uniform"
    return f"within a factor of {one.factor:g}, log-normal"


def _source(one: DefaultUncertainty) -> str:
    return one.source if one.source == JUDGEMENT else f"{{cite:t}}`{one.source}`"


class Covered(NamedTuple):
    """A row of a vendor, or a screw that could be the measured one, against the band of the model."""

    #: What is stated of the row lies "in" the band, "below" or "above" it.
    places: tuple[str, ...]
    #: Width of the band over its median.
    width: float


def coverage_table() -> str:
    """Number of stated torques inside, below and above the model's 95 % interval of their row, and its width."""
    lines = [
        "| rows | model | in the band | below it | above it | width / median of the band, in the median |",
        "|---|---|---:|---:|---:|---:|",
    ]
    for model in (FrictionModel.reference(), calibrated(FrictionModel.reference(), calibration(CALIBRATION))):
        label = "reference" if model == FrictionModel.reference() else "calibrated"
        found = {name: coverage(model, name) for name in _PRELOADS}
        found["both of these"] = [one for those in found.values() for one in those]
        if model == FrictionModel.reference():
            found["xjtu, two torques against each screw that it could be"] = coverage(model, "xjtu")
        for words, those in found.items():
            lines.append(f"| {words} | {label} | {_counts(those)} | {np.median([one.width for one in those]):.2f} |")
    return "\n".join(lines) + "\n"


def _counts(those: Sequence[Covered]) -> str:
    places = [place for one in those for place in one.places]
    return " | ".join(f"{places.count(place)} of {len(places)}" for place in ("in", "below", "above"))


def coverage(model: FrictionModel, name: str) -> list[Covered]:
    """The rows of a set against the bands of a model at their conditions, without load."""
    found: list[Covered] = []
    for values, nut, stated in _rows(name):
        of_row = band.band(_case(model, values, nut), band.BandOptions(samples=SAMPLES)).band["screw_torque"]
        low, high = of_row.both
        places = ("below" if one < low else "above" if one > high else "in" for one in stated)
        found.append(Covered(tuple(places), (high - low) / of_row.median))
    return found


def _rows(name: str) -> Iterator[tuple[Values, Nut, Sequence[float]]]:
    """The values of the rows of a set, their nuts, and what is stated of each.

    That is the middle of a vendor's band, or each of the two torques measured.
    """
    for values in shipped_rows(SETS[name]):
        if name == "xjtu":
            yield values, NUTS[values["nut"]](preload=values["preload"]), (values["torque_min"], values["torque_max"])
            continue
        kind, preloads = _PRELOADS[name]
        for percent in preloads:
            column = f"no_load_torque_{percent}pct"
            middle = (values[f"{column}_min"] + values[f"{column}_max"]) / 2
            yield values, kind(preload=percent / 100 * values["dynamic_load_rating"]), (middle,)


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


def main() -> None:
    """Print or write the coverage."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--write", action="store_true", help=f"into {PAGE.name}")
    table = coverage_table()
    if parser.parse_args().write:
        PAGE.write_text(table, encoding="utf-8")
    else:
        print(table)


if __name__ == "__main__":
    main()
