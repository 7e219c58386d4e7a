"""Tables of results, cases and bands as HTML, for notebooks."""

from __future__ import annotations

import functools
import html as markup
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from ballscrew.basis.quantities import Quantity, quantities_of
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.engine.uncertainty.bands import Band, Interval
from ballscrew.engine.uncertainty.sensitivity import Sensitivity
from ballscrew.evidence.calibration.fit_result import FitResult
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.run.sheet import SHOWN
from ballscrew.questions.shared.text_tables import shown_or_dash

_KNOWN = quantities_of(FrictionResult)
_OPERATION = ("axial_load", "screw_speed")
#: Results of many points that are shown with their ends.
_OF_MANY = ("screw_torque", "drive_torque", "efficiency", "friction_power", "maximum_pressure")


@functools.singledispatch
def html(value: Any) -> str:
    """The table of a value; its text for what has none."""
    return f"<pre>{markup.escape(repr(value))}</pre>"


@html.register
def _of_result(result: FrictionResult) -> str:
    many = np.ndim(result.screw_torque) > 0
    rows = _ends(result) if many else _numbers(result)
    table = _table(["", "range" if many else ""], rows)
    warned = "".join(f"<li>{markup.escape(text)}</li>" for text in result.warnings)
    return f"<div>{table}{'' if many else _parts(result)}{f'<ul>{warned}</ul>' if warned else ''}</div>"


def _numbers(result: FrictionResult) -> Iterable[Sequence[str]]:
    for name in dict.fromkeys([*_OPERATION, *SHOWN]):
        if name in _KNOWN:
            yield _KNOWN[name].info.meaning, shown_or_dash(float(getattr(result, name)), _KNOWN[name])


def _ends(result: FrictionResult) -> Iterable[Sequence[str]]:
    """The least and the greatest of each result, and at how many points the model holds."""
    valid = np.asarray(result.valid)
    yield "points", " × ".join(map(str, valid.shape))
    yield "valid", f"{int(valid.sum())} of {valid.size}"
    for name in (*_OPERATION, *_OF_MANY):
        values = np.asarray(getattr(result, name), dtype=float)
        finite = values[np.isfinite(values)]
        if finite.size:
            yield _KNOWN[name].info.meaning, _range(float(finite.min()), float(finite.max()), _KNOWN[name])


def _range(low: float, high: float, quantity: Quantity) -> str:
    ends = [shown_or_dash(end, quantity) for end in (low, high)]
    return ends[0] if ends[0] == ends[1] else " to ".join(ends)


def _parts(result: FrictionResult) -> str:
    """The parts of the torque with bars."""
    total = float(result.screw_torque)
    rows: list[Sequence[str]] = []
    for name, part in result.contributions.items():
        if part and total:
            share = 100 * float(part) / total
            bar = f'<div style="background:#0072B2;height:0.7em;width:{max(0.0, min(share, 100.0)):.1f}px"></div>'
            text = markup.escape(MECHANISMS.get(name, name))
            torque = markup.escape(shown_or_dash(float(part), _KNOWN["screw_torque"]))
            rows.append((text, torque, f"{share:.1f} %", bar))
    return _table(["friction torque by cause", "", "", ""], rows, escape=False) if rows else ""


@html.register
def _of_case(case: Case) -> str:
    lines = [descriptions.design(case, plain_text=True), *descriptions.assumptions(case, None)]
    items = "".join(f"<li>{markup.escape(line)}</li>" for line in lines if line)
    return f"<div><b>{markup.escape(descriptions.title(case))}</b><ul>{items}</ul></div>"


@html.register
def _of_band(band: Band) -> str:
    known = known_outputs()
    share = f"{100 * band.level:.4g} %"
    heads = ["", "as it is", "median", f"{share}, inputs and laws", f"{share}, inputs alone"]
    rows = [
        (
            known[name].quantity.info.meaning if name in known else name,
            *(shown_or_dash(value, known[name].quantity) for value in (of.value, of.median)),
            *(_interval(interval, known[name].quantity) for interval in (of.both, of.parameters)),
        )
        for name, of in band.outputs.items()
        if name in known
    ]
    note = f"{band.count} samples, seed {band.seed}; {100 * band.invalid_share:.3g} % of them outside the model"
    return f"<div>{_table(heads, rows)}<p>{markup.escape(note)}</p></div>"


@html.register
def _of_fit(fit: FitResult) -> str:
    rows = [
        (
            estimate.name,
            estimate.quantity.info.meaning,
            shown_or_dash(estimate.value, estimate.quantity),
            "not identified" if ends is None else _range(*ends, estimate.quantity),
        )
        for estimate in (*fit.estimates.values(), *fit.sensor.values())
        for ends in (estimate.interval(),)
    ]
    said = "".join(f"<li>{markup.escape(text)}</li>" for text in (*fit.verdicts, *fit.warnings))
    table = _table(["", "", "estimate", "95 %"], rows)
    return f"<div>{table}<p>{markup.escape(fit.rows.log.usage)}</p>{f'<ul>{said}</ul>' if said else ''}</div>"


@html.register
def _of_sensitivity(sensitivity: Sensitivity) -> str:
    effect = {"effect", "effect_deviation"}
    rows = [
        (
            name,
            *(
                shown_or_dash(of[name].value, sensitivity.quantity) if measure in effect else f"{of[name].value:.1%}"
                for measure, of in sensitivity.measures.items()
            ),
        )
        for name in sensitivity.inputs
    ]
    heads = ["", *(measure.replace("_", " ") for measure in sensitivity.measures)]
    note = f"{sensitivity.quantity.info.meaning}: {shown_or_dash(sensitivity.mean, sensitivity.quantity)}"
    return f"<div><p>{markup.escape(note)}</p>{_table(heads, rows)}</div>"


def _interval(interval: Interval, quantity: Quantity) -> str:
    return _range(interval.low, interval.high, quantity)


def _table(heads: Sequence[str], rows: Iterable[Sequence[str]], *, escape: bool = True) -> str:
    def cells(row: Sequence[str], tag: str, text: Any) -> str:
        return "".join(f"<{tag}>{text(cell)}</{tag}>" for cell in row)

    plain = markup.escape if escape else str
    head = f"<thead><tr>{cells(heads, 'th', markup.escape)}</tr></thead>" if any(heads) else ""
    body = "".join(f"<tr>{cells(row, 'td', plain)}</tr>" for row in rows)
    return f"<table>{head}<tbody>{body}</tbody></table>"
