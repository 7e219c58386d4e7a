"""``ballscrew run --band``: where the results of a case lie, as text, as JSON and as a picture."""

from __future__ import annotations

import dataclasses
import io
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.console import Console
from rich.table import Table

from ballscrew.analyses.band_work import BANDED
from ballscrew.analyses.comparison import Candidate
from ballscrew.analyses.known_uncertainties import JUDGEMENT
from ballscrew.analyses.outputs import known_outputs
from ballscrew.analyses.uncertainty import Band, Interval, OutputBand, band, band_along
from ballscrew.assembly import NUT_REASONS
from ballscrew.calibrations import PARAMETERS
from ballscrew.components.screw import Operation
from ballscrew.faults import Fault, InputError, raise_if_any
from ballscrew.interfaces import comparison, report, uncertain, units
from ballscrew.interfaces.answer import Answer, title
from ballscrew.interfaces.computable import computable
from ballscrew.interfaces.config import Case
from ballscrew.interfaces.files import whole
from ballscrew.interfaces.schema import LAWS
from ballscrew.interfaces.uncertain import Uncertain
from ballscrew.quantities import fields_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Laws that leave out what another law of their slot has, or that approximate it: what they do is an error that is
#: known, and no doubt. Where a case has one, the others count as usual.
LEAVE_OUT = frozenset({
    ("frame", "bearing"), ("hertz", "houpert"), ("hertz", "brewe-hamrock"), ("inlet", "ideal"), ("slip", "curvature"),
    ("slip", "line"), ("ball_chain", "one-neighbour"),
})  # fmt: skip
_TORQUE = "screw_torque"
#: What the terminal shows besides the friction torque.
_SHOWN = ("drive_torque", "holding_torque", "efficiency", "back_driving_efficiency", "friction_power")
#: Meanings where there is little room.
_SHORT = {"holding_torque": "torque that holds the load", "back_driving_efficiency": "efficiency, load drives"}
_CAUSES = ("inputs and laws", "inputs alone", "laws alone")
_BAR_WIDTH = 24
#: Points of the curve in the picture, of a screw and of a whole nut, and how far it goes beyond the operating point.
_POINTS, _NUT_POINTS, _BEYOND = 25, 9, 2.0
#: Where a fault of the analysis stands on the command line.
_OPTIONS = {"band.samples": "--samples", "band.level": "--level"}
Done = Callable[[int, int], None]


@dataclasses.dataclass(frozen=True)
class Options:
    """What the command line says of a band; what is None was not said."""

    samples: int | None = None
    level: float | None = None
    only_given: bool = False
    to: Path | None = None

    def check(self, wanted: bool) -> None:
        """Raise :class:`~ballscrew.faults.InputError` for options without a band, and a picture that cannot be."""
        said = {"--samples": self.samples, "--level": self.level, "--only-given": self.only_given or None}
        given = {**said, "--to": self.to} if not wanted else {}
        raise_if_any(
            [
                Fault(name, "needs --band", str(value), "add --band")
                for name, value in given.items()
                if value is not None
            ]
        )
        if self.to is not None:
            comparison.check_picture(self.to)


@dataclasses.dataclass(frozen=True, eq=False)
class Found:
    """The band of a case, and what was taken as uncertain."""

    band: Band
    inputs: Mapping[str, Uncertain]


def alternatives(case: Case) -> list[Candidate]:
    """The case's model with each law that could as well be the right one: none that only leaves something out.

    A named calibration holds for the laws that it was fitted with: those whose coefficients it sets are not exchanged.
    With any other law a fit would have found other numbers: of a case that a fit wrote none is exchanged.
    """
    if case.fit:
        return []
    _, laws = comparison.candidates(case)
    numbers = [] if case.calibration is None else PARAMETERS.values()
    fitted = {name.partition(".")[0] for name in numbers}
    return [
        law
        for law in laws
        if law.counts and law.name in LAWS[law.slot] and (law.slot, law.name) not in LEAVE_OUT
        if law.slot not in fitted
    ]


@computable()
def computed(case: Case, options: Options, done: Done | None = None) -> Found:
    """The band of a case. Raises :class:`~ballscrew.faults.InputError` in the words of the command line."""
    inputs = uncertain.all_of(case, options.only_given)
    try:
        return Found(
            band(
                **_asked(case, inputs, options),
                screw_speed=case.operation.screw_speed,
                axial_load=case.operation.axial_load,
                outputs=BANDED,
                samples=options.samples,
                done=done,
            ),
            inputs,
        )
    except InputError as error:
        faults = (dataclasses.replace(f, where=_OPTIONS.get(f.where, f.where)) for f in error.faults)
        raise InputError(*faults) from None


def _asked(case: Case, inputs: Mapping[str, Uncertain], options: Options) -> dict[str, Any]:
    """What the band and the curve have in common."""
    joint = uncertain.joint_of(case, inputs)
    together = () if joint is None else joint.names
    return {
        "model": case.model,
        "screw": case.screw,
        "lubricant": case.lubricant,
        "nut": case.parts,
        "uncertain": {name: u.distribution for name, u in inputs.items() if name not in together},
        "joint": joint,
        "alternatives": alternatives(case),
        "level": 0.95 if options.level is None else options.level,
    }


# -- for people -----------------------------------------------------------------------------------


def print_band(case: Case, found: Found) -> None:
    """The friction torque and its two causes, what follows from it, and what was taken as uncertain."""
    console = Console(highlight=False)

    def say(text: str, style: str | None = None) -> None:
        console.print(text, style=style, markup=False, soft_wrap=True)

    say(f"{title(case)}\n", "bold")
    for line in sentences(case, found):
        say(line)
    console.print(_causes(case, found, console.encoding))
    console.print(_others(case, found))
    for line in laws_in_words(case, found):
        say(line)
    for line in inputs_in_words(found):
        say(line, "dim")
    for line in warnings(found):
        say(f"beware  {line}", "yellow")


def sentences(case: Case, found: Found) -> list[str]:
    """The answer in words."""
    torque, quantity = found.band[_TORQUE], _quantities(case)[_TORQUE]
    if not math.isfinite(torque.median):
        return ["no band: the friction torque is no number here"]
    if float(case.operation.axial_load) == 0 and torque.both == (0.0, 0.0):
        return ["no band: without load there is no friction torque"]
    low, high = (units.shown(end, quantity) for end in torque.both)
    lines = [
        f"friction torque {units.shown(torque.value, quantity)} at the values of the case, "
        f"median {units.shown(torque.median, quantity)}, "
        f"{100 * found.band.level:.4g} % of the samples between {low} and {high}"
    ]
    if case.fit:
        lines.append(
            f"calibrated to {case.fit.get('log') or 'a log'}: what the fit held counts as known, no law is exchanged; "
            f"on rows held out the model was off by {case.fit.get('holdout_rms', 'an unknown torque')}"
        )
        lines += report.constant_torque(case)
    if float(case.operation.axial_load) > 0:
        share = found.band.self_locking_share
        lines.append(f"self-locking in {share:.2%} of the samples" if share else "self-locking in none of the samples")
    return lines


def _quantities(case: Case) -> dict[str, Any]:
    return {name: known_outputs(case.parts)[name].quantity for name in BANDED}


def _intervals(found: OutputBand) -> Sequence[Interval]:
    return found.both, found.parameters, found.model_form


def _causes(case: Case, found: Found, encoding: str) -> Table:
    """The friction torque because of inputs and laws together, and of each alone, as bars on one axis."""
    torque, quantity = found.band[_TORQUE], _quantities(case)[_TORQUE]
    table = report.table_of(
        "\nFriction torque on the screw, and the share of its variance", "", "from", "to", "share", ""
    )
    table.columns[-1].justify = "left"
    shares = ("", _percent(torque.share_of_parameters), _percent(1 - torque.share_of_parameters))
    ends = [end for interval in _intervals(torque) for end in interval if math.isfinite(end)]
    for words, interval, share in zip(_CAUSES, _intervals(torque), shares, strict=True):
        cells = (report.shown_or_dash(end, quantity) for end in interval)
        table.add_row(words, *cells, share, _bar(interval, torque.value, ends, encoding))
    return table


def _bar(interval: Interval, value: float, ends: Sequence[float], encoding: str) -> str:
    """An interval on the axis of all, with a stroke at the value of the case."""
    if not ends or not all(map(math.isfinite, (*interval, value))):
        return ""
    low, high = min(*ends, value), max(*ends, value)
    if high == low:
        return ""
    block, stroke = ("█", "│") if "utf" in encoding.lower() else ("#", "|")

    def place(x: float) -> int:
        return round((x - low) / (high - low) * (_BAR_WIDTH - 1))

    cells = [" "] * _BAR_WIDTH
    first, last = (place(end) for end in interval)
    cells[first : last + 1] = block * (last + 1 - first)
    cells[place(value)] = stroke
    return "".join(cells).rstrip()


def _others(case: Case, found: Found) -> Table:
    table = report.table_of("\nWhat follows from it", "", "case", "median", "from", "to")
    for name in _SHOWN:
        quantity, one = _quantities(case)[name], found.band[name]
        table.add_row(
            _SHORT.get(name, quantity.info.meaning),
            *(report.shown_or_dash(x, quantity) for x in (one.value, one.median, *one.both)),
        )
    return table


def laws_in_words(case: Case, found: Found) -> list[str]:
    """The laws that were drawn instead of the model's, slot by slot."""
    shown = [
        f"  {slot.replace('_', ' ')}: " + ", ".join(f"{law.name} {math.expm1(law.shift):+.1%}" for law in laws)
        for slot, laws in found.band.alternatives.items()
    ]
    if case.fit:
        return []  # said already: none is exchanged
    if not shown:
        return ["", "no other law is valid here: the band is that of the inputs alone"]
    return ["", "laws that are valid here and could stand in place of the model's, and the torque with each", *shown]


def inputs_in_words(found: Found) -> list[str]:
    """What was taken as uncertain: as the file says, then what is assumed, with its source."""
    given = [f"  {_spoken(name)} {u.words}{_by(u)}" for name, u in found.inputs.items() if u.given]
    taken = [f"  {_spoken(name)} {u.words} ({u.source}: {u.reason})" for name, u in found.inputs.items() if not u.given]
    lines = ["", "uncertain, as the case says", *given] if given else []
    if taken:
        lines += ["", "assumed to be uncertain; write them with ± in the case file if you know better", *taken]
    return lines or ["", "no input is uncertain"]


def _by(one: Uncertain) -> str:
    return "" if one.source == uncertain.GIVEN else f" ({one.source})"


def _spoken(name: str) -> str:
    return name.replace("_", " ").replace(".", " ")


def warnings(found: Found) -> list[str]:
    """What to beware of: samples outside the model's validity, and samples that are no number."""
    lines: list[str] = []
    if found.band.invalid_share > 0:
        reasons = ", ".join(
            f"{share:.2%} {reason}: {NUT_REASONS[reason]}" for reason, share in _by_size(found.band.reasons)
        )
        lines.append(f"{found.band.invalid_share:.2%} of the samples lie outside the model's validity ({reasons})")
    if found.band[_TORQUE].missing_share > 0:
        lines.append(f"{found.band[_TORQUE].missing_share:.2%} of the samples are no number, and left out")
    return lines


def _by_size(shares: Mapping[str, float]) -> list[tuple[str, float]]:
    return sorted(shares.items(), key=lambda item: -item[1])


def _percent(share: float) -> str:
    return f"{share:.0%}" if math.isfinite(share) else "–"


# -- for programs ---------------------------------------------------------------------------------


def document(answer: Answer, found: Found) -> dict[str, Any]:
    """The document of an answer with the band beside it; all in SI."""
    case, known, beside = answer.case, found.band, answer.document
    beside["band"] = {
        "level": known.level,
        "samples": known.count,
        "seed": known.seed,
        **{name: _as_table(one) for name, one in known.outputs.items()},
        "self_locking_share": known.self_locking_share,
        "invalid_share": known.invalid_share,
        "reasons": dict(_by_size(known.reasons)),
        "laws": {
            slot: [{"name": law.name, "factor": math.exp(law.shift)} for law in laws]
            for slot, laws in known.alternatives.items()
        },
        "inputs": {name: _input(case, name, one) for name, one in found.inputs.items()},
    }
    return {**beside, "warnings": [*beside["warnings"], *warnings(found)]}


def _as_table(one: OutputBand) -> dict[str, Any]:
    return {
        "value": one.value,
        "median": one.median,
        **one.both._asdict(),
        "parameters": one.parameters._asdict(),
        "model_form": one.model_form._asdict(),
        "share_of_parameters": one.share_of_parameters,
        "missing_share": one.missing_share,
    }


def _input(case: Case, name: str, one: Uncertain) -> dict[str, Any]:
    quantity = uncertain.quantity_of(case, name)
    said = {} if not one.reason else {"reason": one.reason}
    return {"distribution": one.distribution.words(quantity.unit), "source": one.source, **said}


# -- the picture ----------------------------------------------------------------------------------


def draw(case: Case, found: Found, options: Options, done: Done | None = None) -> None:
    """Write the picture, whole or not at all."""
    assert options.to is not None
    # matplotlib takes its time: only for those who want a picture
    from ballscrew.interfaces.figures import style

    buffer = io.BytesIO()
    with style.house_style():
        figure = picture(case, found, options, done)
        style.save_as(figure, buffer, options.to.suffix.lower().removeprefix("."))
    with whole("--to", options.to) as path:
        path.write_bytes(buffer.getvalue())


def picture(case: Case, found: Found, options: Options, done: Done | None = None) -> Figure:
    """The torque with its bands over the speed, at rest over the load, and the causes; call within the house style."""
    from ballscrew.interfaces.figures import band as figures

    along = "axial_load" if float(case.operation.screw_speed) == 0 else "screw_speed"
    here = float(getattr(case.operation, along)) or 1.0
    points = np.linspace(0.0, _BEYOND * here, _POINTS if case.parts is None else _NUT_POINTS)
    curve = band_along(
        along=along,
        points=points,
        axial_load=case.operation.axial_load,
        screw_speed=case.operation.screw_speed,
        **_asked(case, found.inputs, options),
        done=done,
    )
    parts = [report.design(case), assumed_in_words(found), *warnings(found)]
    exact = f"On the left {curve.count} samples" + (f", and the {_spoken(along)} is exact" * (along in found.inputs))
    caption = ". ".join(part for part in (*parts, exact) if part) + "."
    return figures.picture(title(case), caption, curve, fields_of(Operation)[along], found.band, _CAUSES)


def assumed_in_words(found: Found) -> str:
    """How many inputs are uncertain, and by whose word."""
    given = sum(one.given for one in found.inputs.values())
    judged = sum(one.source == JUDGEMENT for one in found.inputs.values())
    others = len(found.inputs) - given
    return (
        f"{found.band.count} samples of {len(found.inputs)} uncertain inputs: {given} by the case, {others} assumed, "
        f"{judged} of these by judgement"
    )
