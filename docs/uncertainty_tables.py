"""What the page on uncertainty shows: what is assumed, a picture, and how often vendors' rows lie in the band."""

from __future__ import annotations

from pathlib import Path

from ballscrew.analyses.known_uncertainties import JUDGEMENT, KnownUncertainty, known_uncertainties
from ballscrew.analyses.nut_parts import NutParts
from ballscrew.analyses.validation import Conditions, Values
from ballscrew.analyses.validation_rows import screw_of
from ballscrew.analyses.validation_sets import SETS
from ballscrew.calibrations import calibrated, calibration
from ballscrew.components.laws import ProportionalBallForce
from ballscrew.components.nut import DoubleNut, Nut, OversizeBallNut
from ballscrew.components.screw import Operation
from ballscrew.interfaces import band, config
from ballscrew.interfaces.figures import style
from ballscrew.interfaces.validation import shipped_rows
from ballscrew.model import FrictionModel

EXAMPLES = Path(__file__).parents[1] / "examples"
#: Kinds of nut by set, and preloads in per cent of the dynamic load rating for which a band of torques is stated.
_SETS = {"rexroth-double-nut": (DoubleNut, (7, 10)), "rexroth-single-nut": (OversizeBallNut, (5,))}
_SAMPLES = 2**8


def write(folder: Path) -> None:
    """The picture as SVG and PNG, tables as Markdown."""
    folder.mkdir(parents=True, exist_ok=True)
    case = config.load(EXAMPLES / "feed_drive.toml")
    with style.house_style():
        options = band.Options()
        style.save(band.picture(case, band.computed(case, options), options), folder, "band")
    (folder / "assumed.md").write_text(assumed_table(), encoding="utf-8")
    (folder / "coverage.md").write_text(coverage_table(), encoding="utf-8")


def assumed_table() -> str:
    """What is assumed of numbers that users rarely know."""
    rows = [
        f"| `{name}` | {_spread(one)} | {_source(one)} | {one.reason} |" for name, one in known_uncertainties().items()
    ]
    return "\n".join(["| input | 95 % lie | source | reason |", "|---|---|---|---|", *rows]) + "\n"


def _spread(one: KnownUncertainty) -> str:
    if one.half_width is not None:
        return f"within {one.half_width:g} K"
    if one.share is not None:
        of = " of its excess over 0.5" if one.name.endswith("conformity") else ""
        return f"within {one.share:.0%}{of}"
    if one.limits is not None:
        return f"within {one.limits:.0%}, uniform"
    return f"within a factor of {one.factor:g}, log-normal"


def _source(one: KnownUncertainty) -> str:
    return one.source if one.source == JUDGEMENT else f"{{cite:t}}`{one.source}`"


def coverage_table() -> str:
    """How many rows of vendors have the middle of their band within the model's 95 %, and where the others lie."""
    lines = ["| rows | model | in the band | below it | above it |", "|---|---|---:|---:|---:|"]
    for model in (FrictionModel.reference(), calibrated(FrictionModel.reference(), calibration("rexroth-2006"))):
        for name in _SETS:
            places = list(coverage(model, name))
            counts = " | ".join(f"{places.count(place)} of {len(places)}" for place in ("in", "below", "above"))
            label = "calibrated" if model.ball_force is not FrictionModel.reference().ball_force else "reference"
            lines.append(f"| {name} | {label} | {counts} |")
    return "\n".join(lines) + "\n"


def coverage(model: FrictionModel, name: str):
    """For each row and preload whether the vendor's middle is "in" the band of the model, "below" or "above"."""
    nut, preloads = _SETS[name]
    for values in shipped_rows(SETS[name]):
        for percent in preloads:
            found = band.computed(_case(model, values, nut, percent), band.Options(samples=_SAMPLES)).band
            column = f"no_load_torque_{percent}pct"
            middle = (values[f"{column}_min"] + values[f"{column}_max"]) / 2
            low, high = found["screw_torque"].both
            yield "below" if middle < low else "above" if middle > high else "in"


def _case(model: FrictionModel, values: Values, nut: type[Nut], percent: int) -> config.Case:
    """A row as a case without load, at the conditions of the vendor."""
    at = Conditions().of(values)
    return config.Case(
        model=model,
        screw=screw_of(values).screw(),
        lubricant=at.lubricant,
        operation=Operation(axial_load=0.0, screw_speed=at.screw_speed),
        sweep={},
        oil={"grade": at.grade, "temperature": at.temperature},
        parts=NutParts(nut=nut(preload=percent / 100 * values["dynamic_load_rating"])),
        calibration=calibration("rexroth-2006") if isinstance(model.ball_force, ProportionalBallForce) else None,
    )
