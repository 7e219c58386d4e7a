"""The cycle of an axis in its report: the answer, numbers, torque and energy by cause, power off, checks, pictures."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ballscrew.basis.errors import InputError
from ballscrew.basis.quantities import Quantity
from ballscrew.questions.duty import band as duty_band
from ballscrew.questions.duty import figure as figures
from ballscrew.questions.duty import text
from ballscrew.questions.duty import verdicts as duty_verdicts
from ballscrew.questions.duty.band import DutyBandReport
from ballscrew.questions.duty.compute import NUMBERS, DutyReport
from ballscrew.questions.shared.chart_svg import named, svg_of
from ballscrew.questions.shared.report_blocks import Bar, Block, Bullets, Columns, Paragraph, Picture, Table, sentence
from ballscrew.questions.shared.report_blocks import value as value_of
from ballscrew.questions.shared.report_numbers import banded

_TORQUE, _ENERGY = NUMBERS["torque_rms"], NUMBERS["energy_lost"]
#: Samples of the bands of a cycle, and where its balls are solved one by one: a fifth of the time of a report.
_SAMPLES, _SAMPLES_OF_NUT = 256, 64


def _bands(report: DutyReport) -> DutyBandReport | None:
    """The bands of a cycle; None for a screw without inputs that are uncertain."""
    nut = report.case.screw.nut
    try:
        return duty_band.band(report, _SAMPLES_OF_NUT if nut.one_by_one else _SAMPLES)
    except InputError:
        return None


def answer(report: DutyReport) -> Paragraph:
    """The answer to a cycle in some sentences: torque of the motor, life, motor and brake."""
    numbers = report.numbers
    peak, rms = (value_of(numbers[name], _TORQUE) for name in ("torque_peak", "torque_rms"))
    said = [f"Over a cycle the motor gives {peak} at the peak and {rms} RMS."]
    if math.isfinite(numbers["life_time"]):
        said.append(f"The L10 life is {value_of(numbers['life_time'], NUMBERS['life_time'])}.")
    return Paragraph(" ".join([*said, *_verdicts(report)]), strong=True)


def _verdicts(report: DutyReport) -> list[str]:
    """Sentences on motor and brake."""
    return [f"{sentence(one.text)}." for one in duty_verdicts.verdicts(report) if one.id != "verdict.checks"]


def blocks(report: DutyReport) -> list[Block]:
    """All that a report says of a cycle."""
    warned = [f"Beware: {record.text}." for record in duty_verdicts.warnings(report)]
    words = (
        "Motion, torque of the motor by cause and power over the time of a cycle, and torque over speed: "
        f"{text.title(report)}."
    )
    caption = "Motion, torque by cause and power of the motor over a cycle, and its torque over its speed."
    drawn = named(svg_of(lambda: figures.panels(report), "duty"), words)
    return [
        Paragraph(" ".join([f"{sentence(text.title(report))}.", *_verdicts(report)]), strong=True),
        Columns([_numbers(report, _bands(report))], [_paid_for(report)]),
        Picture(drawn, words, caption),
        *_power_off(report),
        *([Bullets(warned)] if warned else []),
    ]


def _numbers(report: DutyReport, found: DutyBandReport | None) -> Table:
    bands = {} if found is None else found.bands.numbers
    rows: list[tuple[str, str, str]] = []
    for name, quantity in text.shown_numbers(report).items():
        value, interval = text.number(quantity, report.numbers[name]), ""
        if name in bands:
            low, high = bands[name].band
            value, interval = banded(report.numbers[name], low, high, quantity)
        rows.append((quantity.info.meaning, value, interval))
    if found is None:
        return Table("The cycle", ("", "value", "band"), rows)
    samples = f"{100 * found.bands.level:.4g} % of {found.bands.count} samples"
    note = f"Bands: {samples} of the uncertain inputs, laws as they are."
    return Table("The cycle", ("", "value", "band"), rows, note=note)


def _paid_for(report: DutyReport) -> Table:
    """Parts of the torque and of the energy, in the order of the document."""
    total = report.duty.torque_rms
    rows: list[Sequence[str | Bar]] = []
    for name, values in text.shown_parts(report).items():
        share = values[1] / total if total else 0.0
        cells = [_small(value, q) for value, q in zip(values, (_TORQUE, _TORQUE, _ENERGY), strict=True)]
        rows.append([name, *cells, Bar(0.0, max(0.0, min(share, 1.0)))])
    note = (
        "The first two columns sum to the peak and to the RMS torque; a part that acts against the others is negative."
    )
    return Table("Torque and energy by cause", ("", "at the peak", "of the RMS", "energy", ""), rows, wide=4, note=note)


def _small(value: float, quantity: Quantity) -> str:
    return value_of(float(f"{value:.3g}"), quantity)


def _power_off(report: DutyReport) -> list[Block]:
    if not report.brake.load_torque:
        return []
    rows = [text.condition_cells(found) for found in report.brake.conditions]
    of_words = (0, len(text.CONDITIONS) - 1)
    return [Table("The axis with its motor off and no brake", text.CONDITIONS, rows, of_words, note=text.OFF_NOTE)]
