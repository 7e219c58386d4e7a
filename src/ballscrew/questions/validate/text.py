"""``ballscrew validate``: the summary and the rows of a set as text, and the caption of the picture."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

from ballscrew.basis import units
from ballscrew.basis.output.wrapping import aligned, wrapped
from ballscrew.basis.quantities import Quantity
from ballscrew.evidence.validation.entries import CONDITIONS, Entry, Point, RuleEntry, ValidationSet
from ballscrew.questions.validate.compute import Request

#: What laws and definitions beside the model are called.
WORDS: Mapping[str, str] = {
    "jis": "JIS B 1192 and THK",
    "rexroth": "Rexroth's rule",
    "hiwin": "HIWIN's rule",
    "constant-efficiency": "constant efficiency 0.9",
    "lead-angle": "lead angle, µ = 0.003",
    "feed-drive-library": "Modelica FeedDriveLibrary, ρ = 0.2°",
    "efficiency": "from the model's efficiency under load",
    "static": "static rating",
    "one_ball_less": "with one ball less a turn",
    "static_one_ball_less": "static rating with one ball less a turn",
    "tangent_at_30": "tangent at 30 % of the rating",
    "double_nut_at_10": "double nut at a preload of 10 %, rigid bodies",
    "double_nut_at_10_elastic": "double nut at a preload of 10 %, elastic bodies",
    "at_5_percent": "at a preload of 5 % of the rating",
    "at_6_percent": "at a preload of 6 % of the rating",
    "at_8_percent": "at a preload of 8 % of the rating",
    "torque": "torque",
    "growth": "growth with speed over that of the whole",
    "torque_at_10_rpm": "torque at 10 rpm, as if it were that of a start",
    "uncorrected": "R_nu, without the factor for accuracy",
    "factor_0.55": "R_nu,ar with a factor for accuracy of 0.55",
    "factor_0.6": "R_nu,ar with a factor for accuracy of 0.6",
    "rigid_bodies": "tangent without load, rigid bodies",
    "elastic_bodies": "tangent without load, elastic bodies",
}


def text_of(entries: Sequence[Entry], request: Request) -> str:
    """The summary and the rows of one set."""
    data = entries[0].data
    lines = [
        f"{data.name}: {data.description}",
        f"  {'; '.join(filter(None, [source_of(data, request), conditions(data, request)]))}",
    ]
    lines += [f"  {_used(entries[0])}"]
    lines += [f"  {_summary(entry)}" for entry in entries]
    lines += [f"  {line}" for line in (*_rules(entries[0]), *_other_means(entries[0]))]
    lines += [f"  {line}" for line in _groups(entries)]
    lines += ["", *(f"  {line}" for line in _table(entries))]
    apart = _apart(entries)
    if apart:
        lines += ["", "  apart, with a maximum only, which is in no mean:", *(f"  {line}" for line in apart)]
    for entry in entries:
        lines += [f"  beware, {_label(entry)}, {n} rows: {warning}" for warning, n in entry.warnings.items()]
    return "\n".join(map(wrapped, lines))


def source_of(data: ValidationSet, request: Request) -> str:
    """The source of the values."""
    return data.source if request.rows is None else f"rows of {request.rows.name}"


def conditions(data: ValidationSet, request: Request) -> str:
    """``100 rpm, ISO VG 100 at 25 degC, no wipers``; nothing where they do not count."""
    if not data.conditioned:
        return ""
    at = request.conditions_of(data)
    speed, temperature = (
        units.shown(getattr(at, name), quantity)
        for name in ("screw_speed", "temperature")
        for quantity in (CONDITIONS[name],)
        if quantity is not None
    )
    unless = " unless the row has its own" if request.rows is not None else ""
    load = "" if data.loaded else ", no load"
    if data.alternatives:
        return (
            f"speed and oil by row{load}, no wipers"
            if data.bound
            else f"{speed}, oil by row{load}, with and without wipers"
        )
    wipers = ", no wipers" if data.of_screws else ""
    return f"{speed}, {at.grade} at {temperature}{unless}{load}{wipers}"


def _label(entry: Entry) -> str:
    return f"calibrated ({entry.calibration})" if entry.calibration else f"uncalibrated ({entry.model.name})"


def _used(entry: Entry) -> str:
    """What was chosen with the rows in sight."""
    return f"chosen on these rows: {'; '.join(entry.used_for) or 'nothing of the model'}"


def _groups(entries: Sequence[Entry]) -> list[str]:
    """The statistics of each kind of nut, or maker, where there are several; other definitions by the first model."""
    if len(entries[0].groups) < 2:
        return []
    words = _words_of(entries[0].data)
    lines: list[str] = []
    for entry in entries:
        for name, group in entry.groups.items():
            means = group.mean_definitions if entry is entries[0] else {}
            own = {other: value for other, value in means.items() if other in entry.data.ratio_names}
            own |= {other: value for other, value in means.items() if other not in entry.mean_definitions}
            others = "".join(f"; {WORDS[other]} {value:.3f}" for other, value in own.items())
            lines.append(f"{f'{_label(entry)}, {name}':<52} n = {len(group.counted)}, {words(group)}{others}")
    return lines


def _words_of(data: ValidationSet) -> Callable[[Entry | RuleEntry], str]:
    """The statistics that say something of the rows of a set."""
    return _of_bounds if data.bound else _of_alternatives if data.alternatives else _statistics


def _summary(entry: Entry) -> str:
    words = _words_of(entry.data)
    missing = len(entry.points) - len(entry.counted)
    lost = f", {missing} without a number" if missing else ""
    return f"{_label(entry):<27} n = {len(entry.counted)}, {words(entry)}{lost}"


def _rules(entry: Entry) -> list[str]:
    """Rules of one line over the same rows."""
    words = _words_of(entry.data)
    return [f"{f'rule: {WORDS[one.rule]}':<52} {words(one)}" for one in entry.rules]


def _statistics(found: Entry | RuleEntry) -> str:
    share = "" if found.share_in_band is None else f", {found.share_in_band:.0%} of rows in their band"
    scatter = f" ± {found.std_ratio:.3f}" if math.isfinite(found.std_ratio) else ""
    width = None if isinstance(found, RuleEntry) else found.uncertainty_width
    if isinstance(found, Entry) and width is not None:
        share += f"; own 95 % band, high / low {width:.2g}, holds {found.share_in_uncertainty_band:.0%} of the middles"
    return f"mean ratio {found.mean_ratio:.3f}{scatter}{share}"


def _of_alternatives(found: Entry | RuleEntry) -> str:
    """The range of the ratios of rows that could be the same screw; their mean says nothing."""
    least, greatest = found.range_ratio
    return f"ratio {least:.2f} to {greatest:.2f}, {found.share_in_band or 0:.0%} of these screws in the measured band"


def _of_bounds(found: Entry | RuleEntry) -> str:
    """The range of the shares of a whole."""
    least, greatest = found.range_ratio
    return f"{least:.2f} to {greatest:.2f} of the whole, {found.share_in_band or 0:.0%} of the rows below it"


def _other_means(entry: Entry) -> list[str]:
    """Mean ratios of other definitions."""
    return [f"{WORDS[name]:<52} mean ratio {value:.3f}" for name, value in entry.mean_definitions.items()]


def _table(entries: Sequence[Entry]) -> list[str]:
    quantity = entries[0].data.quantity
    banded = entries[0].share_in_band is not None
    heading = ["row", f"stated [{quantity.shown_in}]", *(["band"] if banded else [])]
    for entry in entries:
        heading += ["calibrated" if entry.calibration else "model", "ratio"]
        heading += [""] if banded else []
    # beside two models there is no room for them
    others = entries[0].mean_definitions if len(entries) == 1 else {}
    lines = [[*heading, *(name.replace("_", " ") for name in others)]]
    for same in zip(*(entry.points for entry in entries), strict=True):
        band = same[0].band
        line = [same[0].name, _shown(band.middle, quantity)]
        if banded:
            line.append("–" if band.low is None else f"{_shown(band.low, quantity)} to {_shown(band.high, quantity)}")
        for point in same:
            line += [_shown(point.value, quantity), _number(point.ratio, ".3f")]
            line += [_band_verdict(point)] if banded else []
        lines.append([*line, *(_number(same[0].definitions[name], ".3f") for name in others)])
    return aligned(lines)


def _band_verdict(point: Point) -> str:
    return {True: "", False: "outside", None: "no number" if point.band.low is not None else ""}[point.in_band]


def _apart(entries: Sequence[Entry]) -> list[str]:
    quantity = entries[0].data.quantity
    heading = ["row", f"maximum [{quantity.shown_in}]"]
    for entry in entries:
        heading += ["calibrated" if entry.calibration else "model", "ratio"]
    lines = [heading]
    for same in zip(*(entry.upper_limits for entry in entries), strict=True):
        line = [same[0].name, _shown(same[0].maximum, quantity)]
        for apart in same:
            line += [_shown(apart.value, quantity), _number(apart.ratio, ".3f")]
        lines.append(line)
    return aligned(lines) if len(lines) > 1 else []


def _shown(value: float | None, quantity: Quantity) -> str:
    return "–" if value is None or not math.isfinite(value) else units.rounded(value, quantity)


def _number(value: float | None, form: str) -> str:
    return "–" if value is None or not math.isfinite(value) else format(value, form)


def source_and_fit(data: ValidationSet, request: Request) -> str:
    """The source of the values of a set, and whether the calibration was fitted to them."""
    fitted = request.calibration if data.calibratable and request.rows is None else None
    words = f"fitted: {fitted.name}" if fitted is not None and data.file in fitted.data else "not fitted"
    return f"{source_of(data, request)}; {words}"


def _conditions_of(sets: Sequence[ValidationSet], request: Request) -> str:
    """Oil and speed of sets with torques without load; those that differ from the first with the name of their set."""
    torques = [data for data in sets if data.conditioned and data.of_screws]
    usual = [data for data in torques if not data.alternatives and not data.loaded] or torques[:1]
    told = {data.name: conditions(data, request) for data in usual}
    first = next(iter(told.values()), "")
    return "; ".join([first, *(f"{name}: {words}" for name, words in told.items() if words != first)])


def caption(found: Sequence[Sequence[Entry]], request: Request) -> str:
    """The caption of the picture."""
    entries = [entry for one in found for entry in one]
    words = ["Ratio of the model to what the table states (for a band its middle); grey: the vendor's bands."]
    if told := _conditions_of([one[0].data for one in found], request):
        words.append(f"No-load torques: {told}.")
    words.append(f"Model {request.model.name}.")
    if request.calibration is not None and any(entry.calibration for entry in entries):
        fitted = request.calibration
        mu, share = fitted.boundary_friction_coefficient, fitted.share_of_load
        words.append(
            f"Calibration {fitted.name}: boundary friction {mu:.3g}, force between balls {share:.2g} of the load."
        )
    return " ".join(words)
