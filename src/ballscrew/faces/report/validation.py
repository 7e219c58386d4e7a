"""``ballscrew validate --report``: all data, laws and rules in one paper, what is circular and what is not measured.

The numbers are those of ``ballscrew validate`` and of its summary.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence

from matplotlib.figure import Figure

from ballscrew.basis.version import __version__
from ballscrew.evidence.validation.entries import Entry, fitted_rows, may_be_fitted
from ballscrew.faces.sheets import report_blocks
from ballscrew.faces.sheets.report_blocks import Bullets, Paragraph, Picture, Report, Section, Table
from ballscrew.questions.shared import charts
from ballscrew.questions.shared.charts import named, svg_of
from ballscrew.questions.validate import sheet
from ballscrew.questions.validate.compute import Request
from ballscrew.questions.validate.sheet import CALIBRATION, MODEL, RULE, SummaryRow

_TITLE = "What friction models of ball screws are worth"
_PAGES = 16
_MARKS = {MODEL: ("o", charts.BLUE), CALIBRATION: ("D", charts.RED), RULE: ("|", charts.INK)}

#: What no source that could be read has measured, in the order of what it would settle.
NOT_MEASURED = (
    "The torque of any ball screw with its size, balls, nut, preload, oil, temperature and speed all stated. Of "
    "the one public set of measured screws neither diameter nor nut nor oil is stated.",
    "A full complement of balls against spacer balls at equal load of each ball: how full the circuits are, on "
    "which it depends whether neighbours rub on each other.",
    "The same nut with two leads on one diameter: the makers' rules differ there by a factor of two.",
    "The torque of a preloaded nut below 0 °C: whether oil comes back into the track in time.",
    "The gap that is left in a circuit of balls, and the deviation of its grooves over a turn.",
    "Friction over the first degrees after a reversal, slowly, with the force of the nut measured.",
)
#: The day at a rig that would settle it.
EXPERIMENT = (
    "An adjustable double nut without wipers, its preload measured, torque to 1 mN m, both ways.",
    "1 to 2000 rpm at 25 and 60 °C: rolling from boundary friction.",
    "Preloads of 2, 5 and 10 % of the rating: the exponent of the load.",
    "Full complement against spacer balls 1:1 at equal load of each ball: the fill of the circuits.",
    "Oils of VG 10 and VG 220 at equal temperature: film from boundary friction.",
    "Leads of 5 and 20 mm on one diameter: JIS B 1192 has twice the torque, the rules of Rexroth and HIWIN the same.",
    "A slow reversal, a triangle below 1 mm/s: over which angle helix slip comes back.",
)


def report(request: Request, rows: Sequence[Sequence[Entry]], table: Sequence[SummaryRow]) -> Report:
    """The report of all sets of a request, with the table of all makers."""
    plain = [entries[0] for entries in rows]
    sections = [
        Section("In short", [Paragraph(text, strong=not place) for place, text in enumerate(_in_short(plain, table))]),
        *(_of_makers(plain, table) if table else ()),
        Section("Each set", [report_blocks.table(sheet.of_sets(plain))]),
        Section("What nobody has measured", [Bullets(NOT_MEASURED)]),
        Section("The experiment that would settle it", [Bullets(EXPERIMENT), _CALL]),
        *(Section(e.data.name, report_blocks.blocks(sheet.sheet([e], request), e.data.name)) for e in plain),
    ]
    subtitle = [f"model {request.model.label}; ratios are model / middle of what is stated"]
    return Report(_TITLE, subtitle, sections, f"ballscrew {__version__}", _PAGES)


def _of_makers(entries: Sequence[Entry], table: Sequence[SummaryRow]) -> list[Section]:
    """The sections on torques without load that makers state."""
    _, statistics, chosen = report_blocks.blocks(sheet.of_makers(table), "makers")
    return [
        Section("All makers", [statistics, _picture(table)]),
        Section("Does the band hold them?", [_coverage(entries)]),
        Section("What is circular", [chosen, _OF_BAND]),
    ]


#: The band, too, was made with rows in sight.
_OF_BAND = Paragraph(
    "The band: it draws the calibrations that were fitted to rows of Rexroth, of HIWIN and to the rule of THK, and the "
    "factor of the force between balls was chosen with all of these rows in sight."
)
_CALL = Paragraph(
    "Whoever has such torques: a torque card (ballscrew card) holds what was measured and on what, is checked "
    "by a command, and is compared with all laws by ballscrew validate --card. Twenty of them would decide more than "
    "all tables of makers."
)


def _in_short(entries: Sequence[Entry], table: Sequence[SummaryRow]) -> list[str]:
    model = [row for row in table if row.kind == MODEL]
    rules = [row for row in table if row.kind == RULE and row.nut == "double" and row.maker == "Rexroth" and row.n > 1]
    spread = max(row.mean_ratio for row in rules) / min(row.mean_ratio for row in rules) if rules else math.nan
    judged = [point for entry in entries for point in entry.counted if point.in_uncertainty_band is not None]
    inside = sum(bool(point.in_uncertainty_band) for point in judged)
    said: list[str] = []
    if model:
        low, high = (one(model, key=lambda row: row.mean_ratio) for one in (min, max))
        said.append(
            f"Uncalibrated, the model has {_of(low)} to {_of(high)} of the torque without load that makers state, "
            "by maker and kind of nut."
        )
    said.append("Torques in catalogues are acceptance bands, most of them computed by rules of one line.")
    if math.isfinite(spread):
        said.append(
            f"On the same double nuts the rules of three makers differ by a factor of {spread:.2f}: no model can agree "
            "with all of them, and agreement with one is agreement with its rule."
        )
    if judged:
        said.append(
            "The 95 % band of an uncalibrated nut, which draws the calibrations of makers as alternatives, holds the "
            f"middle of {inside} of {len(judged)} statements ({100 * inside / len(judged):.0f} %)."
        )
    said.append(
        "No measured torque of a ball screw that is described well enough to test a model could be found in public."
    )
    return said


def _of(row: SummaryRow) -> str:
    return f"{row.mean_ratio:.2f} ({row.maker}, {row.nut})"


def _picture(table: Sequence[SummaryRow]) -> Picture:
    words = "ratios of the model, its calibrations and rules to what makers state, by maker and kind of nut"
    caption = (
        "Mean ratio to the middle of what is stated: the model (circles), its calibrations (diamonds) and rules "
        "of one line (strokes); lines are one standard deviation of the model."
    )
    return Picture(named(svg_of(lambda: _ratios(table), "makers"), words), words, caption)


def _ratios(table: Sequence[SummaryRow]) -> Figure:
    """The mean ratios of all makers on one logarithmic axis."""
    places = list(dict.fromkeys((row.maker, row.nut) for row in table))
    figure, [panel] = charts.new_figure("", rows=1, columns=1, height=0.45 * len(places) + 1.2)
    panel.axvline(1.0, color=charts.INK, linewidth=0.9)
    for kind, (mark, colour) in _MARKS.items():
        rows = [row for row in table if row.kind == kind]
        y = [-places.index((row.maker, row.nut)) for row in rows]
        panel.plot([row.mean_ratio for row in rows], y, mark, color=colour, markersize=6, label=kind)
    for row in table:
        if row.kind == MODEL and math.isfinite(row.std_ratio):
            ends = [max(row.mean_ratio - row.std_ratio, 0.05), row.mean_ratio + row.std_ratio]
            panel.plot(ends, [-places.index((row.maker, row.nut))] * 2, color=charts.BLUE, linewidth=1.2)
    panel.set_xscale("log")
    panel.set_xticks([0.3, 0.5, 0.7, 1.0, 1.5, 2.0], ["0.3", "0.5", "0.7", "1", "1.5", "2"])
    panel.minorticks_off()
    panel.set_yticks([-place for place in range(len(places))], [f"{maker}, {nut}" for maker, nut in places])
    panel.set_ylim(-len(places) + 0.4, 0.6)
    panel.set_xlabel("model or rule / middle of what is stated")
    panel.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=3, borderaxespad=0.2)
    return figure


def _coverage(entries: Sequence[Entry]) -> Table:
    """Share of statements whose middle the band of the model holds, and its width, by what was fitted."""
    rows: list[list[str]] = []
    for entry in entries:
        split = fitted_rows(entry.data.name)
        for group, of_group in (entry.groups or {"": entry}).items():
            parts = {"": of_group}
            if any(may_be_fitted(entry.data.name, point) for point in of_group.points):
                parts = {words: _half(of_group, fitted) for words, fitted in (("fitted", True), ("kept aside", False))}
            for words, part in parts.items():
                share, width = part.share_in_uncertainty_band, part.uncertainty_width
                if share is not None and width is not None:
                    used = words or ("not used" if split else "all")
                    cells = [used, str(len(part.counted)), f"{100 * share:.0f} %", f"{width:.1f}"]
                    rows.append([entry.data.maker, group or entry.data.name, *cells])
    note = (
        "Fitted: the rows that may be (data/validation/splits.toml); the calibration hiwin, which the band draws, was; "
        "that of Rexroth is of all its rows. The width is the geometric mean of the upper over the lower end, of 256 "
        "samples a row. Preloads that are not stated are those of the set."
    )
    heads = ["maker", "nut", "rows", "n", "middle within the band", "upper / lower end"]
    return Table("95 % band of an uncalibrated nut", heads, rows, texts=(0, 1, 2), wide=1, note=note)


def _half(entry: Entry, fitted: bool) -> Entry:
    """The points of an entry that may be fitted, or those that are kept aside."""
    points = [point for point in entry.points if may_be_fitted(entry.data.name, point) == fitted]
    return dataclasses.replace(entry, points=points)
