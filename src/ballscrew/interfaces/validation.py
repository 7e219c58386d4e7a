"""``ballscrew validate``: sets of data against a model, as text, as JSON and as a picture."""

from __future__ import annotations

import dataclasses
import functools
import hashlib
import io
import math
from collections.abc import Iterator, Mapping, Sequence
from importlib import resources
from pathlib import Path
from typing import Any

from ballscrew.analyses.validation import CONDITIONS, Conditions, Entry, Point, ValidationSet, Values
from ballscrew.analyses.validation_sets import SETS
from ballscrew.calibrations import Calibration, calibrated, calibration
from ballscrew.faults import Fault, InputError, fault_of, nearest, raise_if_any
from ballscrew.interfaces import units
from ballscrew.interfaces.catalogue import COLUMNS
from ballscrew.interfaces.files import check_writable, whole
from ballscrew.interfaces.headings import Column
from ballscrew.interfaces.rows import made, read
from ballscrew.interfaces.schema import MODELS
from ballscrew.interfaces.wrapping import aligned, wrapped
from ballscrew.model import FrictionModel
from ballscrew.quantities import Quantity
from ballscrew.solvers.ellipse_slip import ellipse_slip

DEFAULT_CALIBRATION = "rexroth-2006"
PICTURES = (".png", ".svg", ".pdf")
_ALIASES: Mapping[str, tuple[str, ...]] = {
    "screw_speed": ("speed", "rpm", "rotational speed"),
    "grade": ("oil", "oil grade"),
    "temperature": ("oil temperature",),
}
#: What laws and definitions beside the model are called.
WORDS: Mapping[str, str] = {
    "jis": "JIS B 1192",
    "rexroth": "Rexroth's rule",
    "efficiency": "from the model's efficiency under load",
    "static": "static rating",
    "one_ball_less": "with one ball less a turn",
    "static_one_ball_less": "static rating with one ball less a turn",
    "tangent_at_30": "tangent at 30 % of the rating",
    "double_nut_at_10": "double nut at a preload of 10 %, rigid bodies",
    "double_nut_at_10_elastic": "double nut at a preload of 10 %, elastic bodies",
    "rigid_bodies": "rigid bodies",
}


# -- what was asked for ---------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Request:
    """Which sets, with which model, calibration and conditions."""

    sets: Sequence[ValidationSet]
    model: FrictionModel
    calibration: Calibration | None
    conditions: Conditions
    rows: Path | None = None
    keep_going: bool = False
    #: What is left out of all sets, and why.
    notes: Sequence[str] = ()


def request(
    names: Sequence[str] = (),
    *,
    model: str = "reference",
    calibration_name: str | None = None,
    rows: Path | None = None,
    keep_going: bool = False,
    grade: str | None = None,
    temperature: str | None = None,
    speed: str | None = None,
) -> Request:
    """The request that options mean. Raises :class:`~ballscrew.faults.InputError` with all faults found."""
    faults = [Fault("validate", "unknown set", name, nearest(name, SETS)) for name in names if name not in SETS]
    if model not in MODELS:
        faults.append(Fault("--model", "unknown model", model, nearest(model, MODELS)))
    if rows is not None and len(names) != 1:
        given = ", ".join(names) or "none"
        faults.append(Fault("--rows", "needs exactly one set", given, "name the set whose columns the file has"))
    conditions = _conditions(grade, temperature, speed, faults)
    raise_if_any(faults)
    found, notes = _sets(names, MODELS[model])
    asked_for = grade is not None or temperature is not None or speed is not None
    if asked_for and not any(data.conditioned for data in found):
        raise InputError(Fault("validate", "oil and speed do not move these sets", ", ".join(names), "leave them out"))
    chosen = calibration(calibration_name or DEFAULT_CALIBRATION)
    return Request(
        sets=found,
        model=MODELS[model],
        # a calibration goes with its model, unless it is asked for
        calibration=chosen if calibration_name or chosen.model == model else None,
        conditions=conditions,
        rows=rows,
        keep_going=keep_going,
        notes=notes,
    )


def _sets(names: Sequence[str], model: FrictionModel) -> tuple[list[ValidationSet], list[str]]:
    """The sets asked for, or all those that the model can do."""
    wanted = [SETS[name] for name in dict.fromkeys(names)] or list(SETS.values())
    cannot = [data.name for data in wanted if data.four_contacts and model.slip is not ellipse_slip]
    if names and cannot:
        problem = f"model {model.name} knows no balls with four contacts"
        raise InputError(*(Fault(name, problem, "", "take the model reference") for name in cannot))
    notes = [f"{name}: left out, the model {model.name} knows no balls with four contacts" for name in cannot]
    return [data for data in wanted if data.name not in cannot], notes


def _conditions(grade: str | None, temperature: str | None, speed: str | None, faults: list[Fault]) -> Conditions:
    """The conditions of the options; what is wrong with them goes to the list of faults."""
    given: dict[str, Any] = {} if grade is None else {"grade": grade}
    for option, name, text in (("--temperature", "temperature", temperature), ("--speed", "screw_speed", speed)):
        quantity = CONDITIONS[name]
        if text is None or quantity is None:
            continue
        value = units.parse(option, text, quantity)
        fault = value if isinstance(value, Fault) else fault_of(option, quantity, value)
        if fault is None:
            given[name] = value
        else:
            people = fault if fault is value else units.in_people_units(fault, quantity, text)
            faults.append(dataclasses.replace(people, where=option))
    conditions = Conditions(**given)
    try:
        _ = conditions.lubricant
    except InputError as error:
        faults += [dataclasses.replace(fault, where="--grade") for fault in error.faults if "grade" in fault.where]
    return conditions


# -- rows -----------------------------------------------------------------------------------------


def columns_of(data: ValidationSet) -> list[Column]:
    """The columns that a table of a set may have."""
    screw = list(COLUMNS) if data.of_screws else []
    own = [Column(name, quantity) for name, quantity in data.columns.items()]
    further = [] if not data.conditioned else list(CONDITIONS.items())
    conditions = [Column(name, quantity, _ALIASES.get(name, ())) for name, quantity in further]
    return [
        dataclasses.replace(column, required=column.required or column.name in data.required)
        for column in (*screw, *own, *conditions)
    ]


def evaluate(asked: Request) -> Iterator[tuple[list[Entry], list[str]]]:
    """Each set with its entries, uncalibrated first, and what is to be said of rows left out."""
    for data in asked.sets:
        models: list[tuple[FrictionModel, str | None]] = [(asked.model, None)]
        if data.calibratable and asked.calibration is not None:
            models.append((calibrated(asked.model, asked.calibration), asked.calibration.name))
        if asked.rows is None:
            with resources.as_file(_shipped(data.file)) as path:
                points, notes = _points(path, data, models, asked)
        else:
            points, notes = _points(asked.rows, data, models, asked)
        yield (
            [
                Entry(data=data, model=model, calibration=name, points=[point for row in points for point in row[i]])
                for i, (model, name) in enumerate(models)
            ],
            notes,
        )


def _points(
    path: Path, data: ValidationSet, models: Sequence[tuple[FrictionModel, str | None]], asked: Request
) -> tuple[list[list[list[Point]]], list[str]]:
    """The points of each row, model by model."""
    return made(
        read(path, columns_of(data)),
        lambda row: [data.evaluate(model, row.values, asked.conditions) for model, _ in models],
        asked.keep_going,
    )


@functools.cache
def shipped_rows(data: ValidationSet) -> tuple[Values, ...]:
    """The rows shipped with a set, SI."""
    with resources.as_file(_shipped(data.file)) as path:
        return tuple(made(read(path, columns_of(data)), lambda row: row.values)[0])


def _shipped(file: str) -> Any:
    return resources.files("ballscrew").joinpath("data/validation", file)


def fingerprint(file: str) -> str:
    """SHA-256 of a file of rows shipped, whatever its line ends."""
    text = _shipped(file).read_text(encoding="utf-8")
    return hashlib.sha256(text.encode()).hexdigest()


# -- for programs ---------------------------------------------------------------------------------


def documents(entries: Sequence[Entry]) -> list[dict[str, Any]]:
    """An object for each set and model, uncalibrated first, SI."""
    return [_document(entry) for entry in sorted(entries, key=lambda entry: entry.calibration is not None)]


def _document(entry: Entry) -> dict[str, Any]:
    return {
        "set": entry.data.name,
        "model": entry.model.name,
        "calibration": entry.calibration,
        "n": len(entry.counted),
        "mean_ratio": entry.mean_ratio,
        "std_ratio": entry.std_ratio,
        "share_in_band": entry.share_in_band,
        **({"static_mean_ratio": static} if (static := entry.mean_definitions.get("static")) is not None else {}),
        "rows": [_row(point, entry.data.quantity.unit) for point in entry.points],
    }


def _row(point: Point, unit: str) -> dict[str, Any]:
    ratios = {
        "definitions": dict(point.definitions),
        "laws": dict(point.laws),
        "apart": [{**apart._asdict(), "ratio": apart.ratio} for apart in point.apart],
    }
    return {
        "name": point.name,
        "unit": unit,
        "value": point.value,
        **point.band._asdict(),
        "ratio": point.ratio,
        "in_band": point.in_band,
        "residual": point.residual,
        "residual_in_half_bands": point.deviation,
        **({"static_ratio": point.definitions["static"]} if "static" in point.definitions else {}),
        **{name: found for name, found in ratios.items() if found},
        "descriptors": dict(point.descriptors),
        "warnings": list(point.warnings),
    }


# -- for people -----------------------------------------------------------------------------------


def text_of(entries: Sequence[Entry], asked: Request) -> str:
    """The summary and the rows of one set."""
    data = entries[0].data
    lines = [f"{data.name}: {data.words}", f"  {source_of(data, asked)}{conditions_in_words(data, asked)}"]
    lines += [f"  {_summary(entry)}" for entry in entries]
    lines += [f"  {line}" for line in _beside(entries[0])]
    lines += ["", *(f"  {line}" for line in _table(entries))]
    apart = _apart(entries)
    if apart:
        lines += ["", "  apart, with a maximum only, which is in no mean:", *(f"  {line}" for line in apart)]
    for entry in entries:
        lines += [f"  beware, {_who(entry)}, {n} rows: {warning}" for warning, n in entry.warnings.items()]
    return "\n".join(map(wrapped, lines))


def source_of(data: ValidationSet, asked: Request) -> str:
    """Who states the values."""
    return data.source if asked.rows is None else f"rows of {asked.rows.name}"


def conditions_in_words(data: ValidationSet, asked: Request) -> str:
    """``; 100 rpm, ISO VG 100 at 25 degC, no wipers``; nothing where they do not count."""
    if not data.conditioned:
        return ""
    speed, temperature = (
        units.shown(getattr(asked.conditions, name), quantity)
        for name in ("screw_speed", "temperature")
        for quantity in (CONDITIONS[name],)
        if quantity is not None
    )
    unless = " unless the row has its own" if asked.rows is not None else ""
    return f"; {speed}, {asked.conditions.grade} at {temperature}{unless}, no load, no wipers"


def _who(entry: Entry) -> str:
    return f"calibrated ({entry.calibration})" if entry.calibration else f"uncalibrated ({entry.model.name})"


def _summary(entry: Entry) -> str:
    share = "" if entry.share_in_band is None else f", {entry.share_in_band:.0%} of rows in their band"
    scatter = f" ± {entry.std_ratio:.3f}" if math.isfinite(entry.std_ratio) else ""
    missing = len(entry.points) - len(entry.counted)
    lost = f", {missing} without a number" if missing else ""
    return f"{_who(entry):<27} n = {len(entry.counted)}, mean ratio {entry.mean_ratio:.3f}{scatter}{share}{lost}"


def _beside(entry: Entry) -> list[str]:
    """Mean ratios of other laws and definitions."""
    found = {**entry.mean_laws, **entry.mean_definitions}
    return [f"{WORDS[name]:<52} mean ratio {value:.3f}" for name, value in found.items()]


def _table(entries: Sequence[Entry]) -> list[str]:
    quantity = entries[0].data.quantity
    banded = entries[0].share_in_band is not None
    heading = ["row", f"stated [{quantity.shown_in}]", *(["band"] if banded else [])]
    for entry in entries:
        heading += ["calibrated" if entry.calibration else "model", "ratio"]
        heading += [""] if banded else []
    others = entries[0].mean_definitions
    lines = [[*heading, *(name.replace("_", " ") for name in others)]]
    for same in zip(*(entry.points for entry in entries), strict=True):
        band = same[0].band
        line = [same[0].name, _shown(band.middle, quantity)]
        if banded:
            line.append("–" if band.low is None else f"{_shown(band.low, quantity)} to {_shown(band.high, quantity)}")
        for point in same:
            line += [_shown(point.value, quantity), _number(point.ratio, ".3f")]
            line += [_verdict(point)] if banded else []
        lines.append([*line, *(_number(same[0].definitions[name], ".3f") for name in others)])
    return aligned(lines)


def _verdict(point: Point) -> str:
    return {True: "", False: "outside", None: "no number" if point.band.low is not None else ""}[point.in_band]


def _apart(entries: Sequence[Entry]) -> list[str]:
    quantity = entries[0].data.quantity
    heading = ["row", f"maximum [{quantity.shown_in}]"]
    for entry in entries:
        heading += ["calibrated" if entry.calibration else "model", "ratio"]
    lines = [heading]
    for same in zip(*(entry.apart for entry in entries), strict=True):
        line = [same[0].name, _shown(same[0].maximum, quantity)]
        for apart in same:
            line += [_shown(apart.value, quantity), _number(apart.ratio, ".3f")]
        lines.append(line)
    return aligned(lines) if len(lines) > 1 else []


def _shown(value: float | None, quantity: Quantity) -> str:
    return "–" if value is None or not math.isfinite(value) else f"{units.from_si(value, quantity):.4g}"


def _number(value: float | None, form: str) -> str:
    return "–" if value is None or not math.isfinite(value) else format(value, form)


# -- the picture ----------------------------------------------------------------------------------


def check_picture(to: Path) -> None:
    """Raise :class:`~ballscrew.faults.InputError` if no picture can be written there."""
    if to.suffix.lower() not in PICTURES:
        raise InputError(Fault("--to", "unknown kind of file", str(to), "end it in .png, .svg or .pdf"))
    check_writable("--to", to)


def draw(found: Sequence[Sequence[Entry]], asked: Request, to: Path) -> None:
    """Write the picture, whole or not at all."""
    # matplotlib takes its time: only for those who want a picture
    from ballscrew.interfaces.figures import style
    from ballscrew.interfaces.figures import validation as figures

    buffer = io.BytesIO()
    with style.house_style():
        sources = [in_brief(entries[0].data, asked) for entries in found]
        style.save_as(
            figures.ratios(found, caption(found, asked), sources), buffer, to.suffix.lower().removeprefix(".")
        )
    with whole("--to", to) as path:
        path.write_bytes(buffer.getvalue())


def in_brief(data: ValidationSet, asked: Request) -> str:
    """Who states the values of a set, and whether the calibration was fitted to them."""
    fitted = asked.calibration if data.calibratable and asked.rows is None else None
    words = f"fitted: {fitted.name}" if fitted is not None and data.file in fitted.data else "not fitted"
    return f"{source_of(data, asked)}; {words}"


def caption(found: Sequence[Sequence[Entry]], asked: Request) -> str:
    """What the picture shows."""
    entries = [entry for one in found for entry in one]
    words = ["Ratio of the model to what the table states (for a band its middle); grey: the vendor's bands."]
    if any(entry.data.conditioned for entry in entries):
        data = next(entry.data for entry in entries if entry.data.conditioned)
        words.append(f"No-load torques: {conditions_in_words(data, asked).removeprefix('; ')}.")
    words.append(f"Model {asked.model.name}.")
    if asked.calibration is not None and any(entry.calibration for entry in entries):
        fitted = asked.calibration
        mu, share = fitted.boundary_friction_coefficient, fitted.share_of_load
        words.append(
            f"Calibration {fitted.name}: boundary friction {mu:.3g}, force between balls {share:.2g} of the load."
        )
    return " ".join(words)
