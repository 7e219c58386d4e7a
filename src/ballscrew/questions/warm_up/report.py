"""Heat in the report of a case that has surroundings: where four hours of work lead, numbers, pictures, assumptions."""

from __future__ import annotations

from ballscrew.basis import units
from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files.case import Case
from ballscrew.questions.shared.chart_svg import named, svg_of
from ballscrew.questions.shared.report_blocks import Block, Bullets, Columns, Paragraph, Picture, Table, sentence
from ballscrew.questions.shared.text_tables import shown_or_dash
from ballscrew.questions.warm_up import figure as figures
from ballscrew.questions.warm_up import text
from ballscrew.questions.warm_up import verdicts as warm_up_verdicts
from ballscrew.questions.warm_up.compute import EQUILIBRIUM, PLACE, SERIES, WarmUpReport, warmed_up

#: Hours of work that a report shows.
HOURS = 4.0
_GROWTH = SERIES["shaft_growth"]
_MARGIN = "stability margin of the thermal loop"


def blocks_of(case: Case) -> list[Block]:
    """Heat of a case; where it cannot be computed, the reason."""
    try:
        report = warmed_up(case, HOURS)
    except InputError as error:
        said = "; ".join(str(fault) for fault in error.faults)
        return [Paragraph(f"Heat is not computed: {said}.")]
    return blocks(report)


def blocks(report: WarmUpReport) -> list[Block]:
    """All that a report says of warming up."""
    said = [f"{sentence(record.text)}." for record in warm_up_verdicts.verdicts(report)]
    warned = [f"Beware: {record.text}." for record in warm_up_verdicts.warnings(report)]
    words = (
        "Temperatures, growth at ends and middle of the stroke, preload or friction power, and friction torque over "
        f"{HOURS:g} hours: {text.title(report)}."
    )
    drawn = named(svg_of(lambda: figures.panels(report), "warm_up"), words)
    caption = "Temperatures, growth, preload and torque while the screw warms up; dashed: the steady state."
    assumed = [f"Assumed: {line}." for line in report.assumed]
    return [
        Paragraph(" ".join([f"{sentence(text.title(report))}.", *said]), strong=True),
        Columns([_steady(report)], [_drift(report), _heat(report)]),
        Picture(drawn, words, caption),
        Bullets([*warned, *assumed]),
    ]


def _steady(report: WarmUpReport) -> Table:
    end = report.warm_up.equilibrium
    if not end.exists:
        return Table("The steady state", ("", "value"), [(f"{_MARGIN}; below 0 there is none", f"{end.margin:.3g}")])
    each = [report, *([] if report.full_bath is None else [report.full_bath])]
    rows = [
        (quantity.info.meaning, *(shown_or_dash(one.equilibrium[name], quantity) for one in each))
        for name, quantity in EQUILIBRIUM.items()
        if name != "preload" or report.warm_up.network.preload_set
    ]
    margins = [f"{one.warm_up.equilibrium.margin:.3g}" for one in each]
    heads = ("", "value", "in a full bath of oil")[: 1 + len(each)]
    return Table("The steady state", heads, [*rows, (f"{_MARGIN} (1: no feedback, 0: thermal runaway)", *margins)])


def _drift(report: WarmUpReport) -> Table:
    places, growth = report.drift
    rows = [
        (f"at {units.shown(float(place), PLACE)}", units.shown(float(value), _GROWTH))
        for place, value in zip(places, growth[report.last_at_work], strict=True)
    ]
    return Table("Growth of the shaft at ends and middle of the stroke", ("", f"after {HOURS:g} h"), rows)


def _heat(report: WarmUpReport) -> Table:
    rows = [
        (quantity.info.meaning, units.shown(float(report.series[name][report.last_at_work]), quantity))
        for name, quantity in SERIES.items()
        if name.startswith("heat_")
    ]
    return Table("Heat", ("", f"in {HOURS:g} h"), rows)
