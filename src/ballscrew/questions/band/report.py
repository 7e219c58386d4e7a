"""The band of a case in its report: the answer with it, its causes, the inputs that make it, a vendor's rows beside."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ballscrew.basis import units
from ballscrew.basis.quantities import quantities_of
from ballscrew.cases.case_files import case_messages
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.named_calibration import vendor_rows_like
from ballscrew.engine.uncertainty.bands import Interval
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.band import text as band
from ballscrew.questions.band import tornado_figure as figures
from ballscrew.questions.band.compute import BandReport
from ballscrew.questions.band.tornado import tornado
from ballscrew.questions.run.compute import Run
from ballscrew.questions.shared.chart_svg import named, svg_of
from ballscrew.questions.shared.report_blocks import Bar, Block, Bullets, Paragraph, Picture, Table, sentence
from ballscrew.questions.shared.report_blocks import value as value_of
from ballscrew.questions.shared.report_numbers import banded, banded_share

_ONE = quantities_of(FrictionResult)
_TORQUE = _ONE["screw_torque"]


def has_band(report: BandReport) -> bool:
    """Test whether there is a band: a friction torque that is a number and not zero for certain."""
    torque = report.band["screw_torque"]
    return math.isfinite(torque.median) and torque.both != (0.0, 0.0)


def answer(run: Run, report: BandReport) -> Paragraph:
    """The answer in some sentences, the numbers of the first one with their bands."""
    said = [_headline(run, report), *(f"{sentence(record.text)}." for record in run.verdicts)]
    if has_band(report):
        causes = "inputs and laws" if report.band.alternatives else "the inputs alone"
        said.append(f"The ends in brackets hold {100 * report.band.level:.4g} % of the samples of {causes}.")
    return Paragraph(" ".join(said), strong=True)


def _headline(run: Run, report: BandReport) -> str:
    found, bands = run.friction, report.band
    if not math.isfinite(float(found.screw_torque)):
        return "No friction torque came out: it is no number here."

    def with_band(words: str, name: str) -> str:
        share = name.endswith("efficiency")
        one, value = bands[name], float(getattr(found, name))
        said = banded_share(value, *one.both) if share else banded(value, *one.both, _ONE[name])
        return f"{words} {said.value}" + (f" ({said.interval})" if said.interval else "")

    words = [with_band("Friction torque on the screw", "screw_torque")]
    if math.isfinite(float(found.efficiency)):
        words.append(with_band("efficiency", "efficiency"))
    elif float(found.axial_load) != 0:
        words.append(with_band("efficiency, the load drives the screw,", "back_driving_efficiency"))
    words.append(with_band("power lost", "friction_power"))
    outside = "" if found.valid else " (outside the model's validity)"
    return f"{', '.join(words)}{outside}."


def blocks(case: Case, report: BandReport) -> list[Block]:
    """Band of the results, its causes, the inputs that make it, and the uncertain inputs."""
    verdicts = [verdict.text for verdict in band.verdicts(case, report)]
    summary = [Paragraph(f"{'. '.join(map(sentence, verdicts))}.", strong=True)]
    if not has_band(report):
        return [*summary]
    warnings = band.warnings(report)
    warned = [Bullets([f"Beware: {one.text}." for one in warnings])] if warnings else []
    laws = band.exchanged_laws(case, report)
    exchanged = [Paragraph(f"{': '.join(filter(None, [sentence(laws.heading), '; '.join(laws.entries)]))}.")]
    inputs: list[Block] = [Paragraph(f"{units.filled(band.input_counts(report))}.")]
    for heading, entries in band.uncertain_inputs(report):
        inputs += [Paragraph(f"{sentence(heading)}:"), Bullets(entries)]
    return [*summary, _causes(report), *swings(case, report), *warned, *exchanged * bool(laws.heading), *inputs]


def _causes(report: BandReport) -> Table:
    torque = report.band["screw_torque"]
    intervals = band.intervals(torque)
    share = torque.share_of_parameters
    shares = ["", *(f"{part:.0%}" if math.isfinite(part) else "–" for part in (share, 1 - share))]
    ends = [end for interval in intervals for end in interval if math.isfinite(end)]
    rows = [
        (words, banded(torque.value, *interval, _TORQUE).interval or value_of(interval.low, _TORQUE), part,
         _bar(interval, torque.value, ends))
        for words, interval, part in zip(band.CAUSES, intervals, shares, strict=True)
    ]  # fmt: skip
    level = f"{100 * report.band.level:.4g} %"
    return Table(
        f"Friction torque on the screw: {level} of the samples, and the share of its variance",
        ("because of", "between", "share", ""),
        rows,
        wide=3,
        note="Bars: the ends on one axis; the stroke is the value of the case.",
    )


def _bar(interval: Interval, value: float, ends: Sequence[float]) -> Bar | str:
    if not ends or not all(map(math.isfinite, (*interval, value))):
        return ""
    low, high = min(*ends, value), max(*ends, value)
    if high == low:
        return ""
    places = [(x - low) / (high - low) for x in (*interval, value)]
    return Bar(*places)


def swings(case: Case, report: BandReport) -> list[Block]:
    """The tornado, where an input moves the torque."""
    found = tornado(case, report)
    widest = figures.shown(found) if has_band(report) else ()
    if not widest:
        return []
    first = ", ".join(
        f"{band.spoken(one.input)} {banded(found.torque.value, *one.ends, _TORQUE).interval}" for one in widest[:3]
    )
    level = f"{100 * found.level:.4g} %"
    words = f"Friction torque with one uncertain input at a time at either end of its {level}; the widest: {first}."
    caption = (
        f"Which inputs make the band: friction torque with one of them at either end of its {level}, the others at "
        "their middles; the line is the value of the case."
    )
    return [Picture(named(svg_of(lambda: figures.picture(found), "tornado"), words), words, caption)]


def vendor_blocks(case: Case) -> list[Block]:
    """The rows of a vendor most like the nut: their no-load torque, and what the model says of them."""
    near = vendor_rows_like(case)
    if near is None:
        return []
    rows: list[tuple[str, ...]] = []
    for row, (low, high), ratio in zip(near.rows, near.bands, near.ratios, strict=True):
        middle = (low + high) / 2
        model = value_of(float(f"{ratio * middle:.3g}"), _TORQUE)
        rows.append((row, banded(middle, low, high, _TORQUE).interval, model, f"{ratio:.2f}"))
    how = "without calibration" if case.calibration is None else f"with the calibration {case.calibration.name}"
    said = (
        f"For the {len(rows)} rows of {near.data} most like this nut in diameter and lead the model gives "
        f"{near.mean:.2f} ± {near.scatter:.2f} times the vendor's no-load torque, {how}."
    )
    whose = case_messages.whose_rows(case, near.data)
    if whose is not None:
        said = f"{said} {sentence(units.filled(whose))}."
    note = "At 100 rpm without wipers, ISO VG 100 at 25 degC; after the sizes the preload, by the dynamic rating."
    columns = ("diameter x lead x ball - turns", "vendor", "model", "model / vendor's middle")
    return [Paragraph(said), Table("Torque without load", columns, rows, note=note)]
