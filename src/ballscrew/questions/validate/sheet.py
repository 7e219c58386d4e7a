"""The sheets of a validation: the ratios and the rows of each set, all charts for one picture, and all makers."""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.output.sheet import (
    Axis,
    Cell,
    Chart,
    Colour,
    Curve,
    Level,
    Line,
    Lines,
    Number,
    Share,
    Sheet,
    Table,
    lines,
)
from ballscrew.basis.quantities import Info, Quantity, fields_of
from ballscrew.evidence.validation.entries import DESCRIPTORS, Entry, Point, RuleEntry, ValidationSet, may_be_fitted
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.friction.calibrations import calibrated, calibrations
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.sizing.rules import DRAG_RULES, RULES
from ballscrew.questions.validate.answer import warnings
from ballscrew.questions.validate.compute import Request, entries_of

#: What the rows of the table are of.
MODEL, CALIBRATION, RULE = "model", "calibration", "rule"
_CHOSEN_MODEL = FrictionModel.reference().name
_BEHIND = "rule {rule}: the values stated are computed by it"


@dataclasses.dataclass(frozen=True, kw_only=True)
class SummaryRow:
    """A model or a rule against the no-load torques of one maker for one kind of nut."""

    maker: str
    nut: str
    #: The set that the rows are of.
    set: str
    #: One of ``model``, ``calibration`` and ``rule``.
    kind: str
    name: str
    n: int
    mean_ratio: float
    #: Standard deviation of a sample, divided by n − 1; NaN of one row.
    std_ratio: float
    share_in_band: float | None
    #: Exponents of the ratio over diameter and lead, of one fit of both; empty where the rows do not tell them.
    exponents: Mapping[str, float]
    #: What was chosen with these rows in sight; empty where they were never used.
    chosen_on: Sequence[str]


def summary(request: Request, result: Sequence[Sequence[Entry]] = ()) -> tuple[list[SummaryRow], list[str]]:
    """The table of the sets of a request that are torques of known nuts, and notes on rows left out.

    ``found`` has entries that were computed before, whose notes were said then.
    """
    known = {(entry.data.name, entry.calibration): entry for entries in result for entry in entries}
    rows: list[SummaryRow] = []
    notes: list[str] = []
    for entries, of_rows in _entries(request, known):
        rows += _of_groups(entries)
        notes += of_rows if not result else []
    return rows, notes


def _entries(
    request: Request, known: Mapping[tuple[str, str | None], Entry]
) -> Iterator[tuple[list[Entry], list[str]]]:
    """Each set with the model, and with every calibration of it, and notes on its rows."""
    fits = [each for each in calibrations().values() if each.model == request.model.name]
    for data in request.sets:
        if not data.of_screws or not data.calibratable or data.loaded or data.alternatives or data.bound:
            continue
        models = [(request.model, None), *((calibrated(request.model, fit), fit.name) for fit in fits)]
        missing = [(model, name) for model, name in models if (data.name, name) not in known]
        computed, notes = entries_of(data, missing, request) if missing else ([], [])
        every = {**known, **{(data.name, entry.calibration): entry for entry in computed}}
        yield [every[data.name, name] for _, name in models], notes


def _of_groups(entries: Sequence[Entry]) -> Iterator[SummaryRow]:
    """The rows of a set: its models and rules, one kind of nut after the other."""
    for group in entries[0].groups:
        of_group = [entry.groups[group] for entry in entries]
        for entry in of_group:
            name = entry.calibration or entry.model.name
            fitted = _fitted(entry, name)
            # what was chosen is of the reference; other models have none of it
            chosen = [*(entry.data.used_for if entry.model.name == _CHOSEN_MODEL else ()), *fitted]
            yield _row(entry, group, CALIBRATION if entry.calibration else MODEL, name, entry, chosen)
        for rule in of_group[0].rules:
            if rule.rule in DRAG_RULES:
                behind = [_BEHIND.format(rule=rule.rule)] if rule.rule in of_group[0].data.rules_behind else []
                yield _row(of_group[0], group, RULE, rule.rule, rule, behind)


def _fitted(entry: Entry, calibration: str) -> list[str]:
    """Remark that a calibration was fitted to rows of a group: to all of its file, or to those that are declared."""
    if calibration not in entry.data.calibrations:
        return []
    if not calibrations()[calibration].declared_rows:
        return [f"calibration {calibration}, fitted"]
    of = sum(may_be_fitted(entry.data.name, point) for point in entry.points)
    return [f"calibration {calibration}, fitted to {of} of {len(entry.points)} rows"] if of else []


def _row(entry: Entry, group: str, kind: str, name: str, of: Entry | RuleEntry, chosen: Sequence[str]) -> SummaryRow:
    return SummaryRow(
        maker=entry.data.maker,
        nut=group,
        set=entry.data.name,
        kind=kind,
        name=name,
        n=len(entry.counted) if isinstance(of, Entry) else of.n,
        mean_ratio=of.mean_ratio,
        std_ratio=of.std_ratio,
        share_in_band=of.share_in_band,
        exponents=of.exponents,
        chosen_on=chosen,
    )


def document(rows: Sequence[SummaryRow]) -> dict[str, Any]:
    """The table as a document."""
    return {"summary": [dataclasses.asdict(row) for row in rows]}


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
    "at_30": "at 0.3 C_a, as THK defines it for one nut",
    "torque": "torque",
    "growth": "growth with speed over that of the whole",
    "torque_at_10_rpm": "torque at 10 rpm, as if it were that of a start",
    "uncorrected": "R_nu, without the factor for accuracy",
    "factor_0.55": "R_nu,ar with a factor for accuracy of 0.55",
    "factor_0.6": "R_nu,ar with a factor for accuracy of 0.6",
    "rigid_bodies": "tangent without load, rigid bodies",
    "elastic_bodies": "tangent without load, elastic bodies",
}
_RATIO = Quantity("ratio", "1", Info("", "model / stated"))
_STATISTICS = ("", "n", "mean", "scatter", "least", "greatest", "in band", "own band", "high / low")
_OF_BAND = "own band: rows whose middle the 95 % band of the model holds; high / low: how wide that is"
_OF_BRACKETS = "in brackets: the band that is stated, and the 95 % band of a model alone"
_OF_EXPONENTS = "d0^, Ph^: exponents of one fit of the ratio over diameter and lead"
_OF_USE = "rows on which something was chosen are no evidence for it"
#: An axis with fewer values shows no trend.
_FEWEST_VALUES = 3
_COLOURS: Sequence[Colour] = ("blue", "red")


def sheet(entries: Sequence[Entry], request: Request) -> Sheet:
    """All that people see of a set: against the model as it is first, then against calibrated ones."""
    data = entries[0].data
    source = data.source if request.rows is None else f"rows of {request.rows.name}"
    stated = "; ".join(filter(None, [source, conditions(data, request)]))
    chosen = "; ".join(entries[0].used_for) or "nothing of the model"
    return Sheet(
        f"{data.name}: {data.description}",
        [
            Lines([Line(f"stated: {stated}", "small"), Line(f"chosen on these rows: {chosen}")]),
            _ratios(entries),
            _rows(entries),
            Lines([Line(f"{_label(e)}, {one.text}", "warning", one.name) for e in entries for one in warnings(e)]),
            *_charts(entries),
        ],
    )


def picture(rows: Sequence[Sequence[Entry]], request: Request) -> Sheet:
    """The charts of all sets, with what is small below them."""
    sheets = [sheet(entries, request) for entries in rows]
    said = [f"model {request.model.name}"]
    if (fitted := request.calibration) is not None and any(len(entries) > 1 for entries in rows):
        friction, share = fitted.boundary_friction_coefficient, fitted.share_of_load
        said.append(f"calibration {fitted.name}: boundary friction {friction:.3g}, ball force {share:.2g} of the load")
    blocks = [block for one in sheets for block in (lines([one.title], "small"), *one.of_kind(Lines, Chart))]
    return Sheet("ratio of the model to what is stated, of a band to its middle", [lines(said, "small"), *blocks])


def of_makers(rows: Sequence[SummaryRow]) -> Sheet:
    """Torques without load by maker and kind of nut, and what was chosen on the rows of each set."""
    cells: list[Sequence[Cell]] = []
    for place, of_place in itertools.groupby(rows, lambda row: f"{row.maker}, {row.nut}"):
        cells += [[place, *[""] * 7], *map(_of_maker, of_place)]
    columns = ("", "n", "mean", "scatter", "in band", "d0^", "Ph^", "rows")
    table = Table("makers", "Model / middle", columns, cells, (_OF_EXPONENTS, _OF_USE), is_compact=True)
    chosen: dict[str, dict[str, None]] = {}
    for row in rows:
        chosen.setdefault(row.set, {}).update(dict.fromkeys(row.chosen_on))
    told = [f"chosen on {name}: {'; '.join(words) or 'nothing'}" for name, words in chosen.items()]
    return Sheet("no-load torques by maker and kind of nut: model / middle of the band", [table, lines(told)])


def _of_maker(row: SummaryRow) -> list[Cell]:
    exponents = [f"{row.exponents[name]:+.2f}" if name in row.exponents else "–" for name in ("size", "lead")]
    name = f"rule: {RULES[row.name].title}" if row.kind == RULE else row.name
    numbers = [_number(row.n), _number(row.mean_ratio, 3), _number(row.std_ratio, 2), _share(row.share_in_band)]
    return [f"  {name}", *numbers, *exponents, "chosen on" if row.chosen_on else "never used"]


# -- what is stated -------------------------------------------------------------------------------


def conditions(data: ValidationSet, request: Request) -> str:
    """``100 rpm, ISO VG 100 at 25 degC, no wipers``; nothing where they do not count."""
    if not data.conditioned:
        return ""
    load = "" if data.loaded else ", no load"
    if data.bound and data.alternatives:
        return f"speed and oil by row{load}, no wipers"
    at = request.conditions_of(data)
    speed = units.shown(at.screw_speed, fields_of(OperatingState)["screw_speed"])
    if data.alternatives:
        return f"{speed}, oil by row{load}, with and without wipers"
    unless = " unless the row has its own" if request.rows is not None else ""
    wipers = ", no wipers" if data.of_screws else ""
    return f"{speed}, {at.grade} at {units.shown(at.temperature, TEMPERATURE)}{unless}{load}{wipers}"


def _label(entry: Entry) -> str:
    return f"calibrated ({entry.calibration})" if entry.calibration else f"uncalibrated ({entry.model.name})"


# -- numbers --------------------------------------------------------------------------------------


def _ratios(entries: Sequence[Entry]) -> Table:
    """Statistics of each model, also by kind of rows, with the means of other definitions, and of rules of one line."""
    data, rows = entries[0].data, list[list[Cell]]()
    for entry in entries:
        rows += [_statistics(_label(entry), entry, data), *_definitions(entry, "  ")]
        for name, group in entry.groups.items() if len(entry.groups) > 1 else ():
            rows += [_statistics(f"  {name}", group, data), *_definitions(group, "    ")]
    return _filled("ratios", [*rows, *(_statistics(f"rule: {WORDS[r.rule]}", r, data) for r in entries[0].rules)])


def of_sets(entries: Sequence[Entry]) -> Table:
    """The statistics of several sets, a row for each."""
    return _filled("sets", [_statistics(f"{one.data.name}: {one.data.title}", one, one.data) for one in entries])


def _filled(name: str, rows: Sequence[Sequence[Cell]]) -> Table:
    """Statistics without the columns that no row has."""
    kept = [place for place in range(len(_STATISTICS)) if any(row[place] is not None for row in rows)]
    columns = [_STATISTICS[place] for place in kept]
    notes = [_OF_BAND] if "own band" in columns else []
    return Table(name, "Model / stated", columns, [[row[i] for i in kept] for row in rows], notes, is_compact=True)


def _statistics(name: str, result: Entry | RuleEntry, data: ValidationSet) -> list[Cell]:
    n = result.n if isinstance(result, RuleEntry) else len(result.counted)
    own = None if isinstance(result, RuleEntry) else result.share_in_uncertainty_band
    width = None if isinstance(result, RuleEntry) else result.uncertainty_width
    # of screws that could be the one measured, and of parts of a whole, the mean says nothing
    mean = [None] * 2 if data.alternatives or data.bound else [_number(result.mean_ratio), _number(result.std_ratio, 3)]
    ends = [_number(end, 3) for end in result.range_ratio]
    return [name, _number(n), *mean, *ends, _share(result.share_in_band), _share(own), _number(width, 2)]


def _definitions(entry: Entry, indent: str) -> list[list[Cell]]:
    nothing = [None] * (len(_STATISTICS) - 3)
    n = _number(len(entry.points))
    return [[f"{indent}{WORDS[name]}", n, _number(mean), *nothing] for name, mean in entry.mean_definitions.items()]


def _number(value: float | None, digits: int = 4) -> Number | None:
    return None if value is None else Number(round(value, 9), _RATIO, digits)  # what is less is noise


def _share(value: float | None) -> Share | None:
    return None if value is None else Share(value, bar=False)


def _rows(entries: Sequence[Entry]) -> Table:
    """Each row with its band; beside one model, where there is room, its own bands and other definitions."""
    first, quantity, alone = entries[0], entries[0].data.quantity, len(entries) == 1
    others = first.mean_definitions if alone else {}
    columns = ["", "stated"]
    for entry in entries:
        columns += ["calibrated" if entry.calibration else "model", "ratio"]
    columns += [*(name.replace("_", " ") for name in others), "outside" if first.share_in_band is not None else ""]
    rows: list[list[Cell]] = []
    for same in zip(*(entry.points for entry in entries), strict=True):
        row: list[Cell] = [same[0].name, Number(same[0].band.middle, quantity, band=_ends(same[0]))]
        for point in same:
            row += [Number(point.value, quantity, band=point.uncertainty if alone else None), _number(point.ratio)]
        rows.append([*row, *(_number(same[0].definitions[name]) for name in others), _outside(same)])
    if first.upper_limits:
        rows.append(["apart, with a maximum only, which is in no mean", *[""] * (len(columns) - 1)])
    for same in zip(*(entry.upper_limits for entry in entries), strict=True):
        row = [same[0].name, Number(same[0].maximum, quantity)]
        for apart in same:
            row += [Number(apart.value, quantity), _number(apart.ratio)]
        rows.append([*row, *[None] * len(others), ""])
    heading = ", ".join(filter(None, ["Each row", units.label(quantity)]))
    notes = [_OF_BRACKETS] if first.share_in_band is not None else []
    return Table("rows", heading, columns, rows, notes, is_compact=True)


def _ends(point: Point) -> tuple[float, float] | None:
    low, high = point.band.low, point.band.high
    return None if low is None or high is None else (low, high)


def _outside(same: Sequence[Point]) -> str:
    """Names of the models that lie outside the band of a row."""
    names = [name for name, point in zip(("model", "calibrated"), same, strict=False) if point.in_band is False]
    return "both" if len(names) > 1 else "".join(names)


# -- pictures -------------------------------------------------------------------------------------


def _charts(entries: Sequence[Entry]) -> Iterator[Chart]:
    """The ratios against each of what the rows of a set differ in."""
    data, points = entries[0].data, entries[0].points
    axes = [name for name in data.axes if len({point.descriptors[name] for point in points}) >= _FEWEST_VALUES]
    for name in axes or data.axes[:1]:
        x = [point.descriptors[name] for point in points]
        marks: list[Curve | Level] = [_bands(x, points), Level("", 1.0, "ink")]
        for entry, colour in zip(entries, _COLOURS, strict=False):
            fitted = ", fitted" if entry.calibration in data.calibrations else ""
            who = f"{entry.calibration}{fitted}" if entry.calibration else "uncalibrated"
            marks.append(Curve(who, x, [point.ratio for point in entry.points], colour, "circles"))
        yield Chart(data.name, Axis(*DESCRIPTORS[name]), Axis("model / stated", _RATIO, least=0.0), marks, detail=True)


def _bands(x: Sequence[float], points: Sequence[Point]) -> Curve:
    """The bands that are stated, in units of their middle; each a stroke of its own."""
    places = [(at, point.band.middle, ends) for at, point in zip(x, points, strict=True) if (ends := _ends(point))]
    along = [at for at, *_ in places for _ in range(3)]
    ratios = [end / middle for _, middle, ends in places for end in (*ends, math.nan)]
    return Curve("stated band" if places else "", along, ratios, "grey")
