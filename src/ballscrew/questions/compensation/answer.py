"""A compensation of positions for controls: its table, its document, and its sheet."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any, NamedTuple

import numpy as np

from ballscrew.axis.motion.states import Numbers
from ballscrew.basis import units
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import Fault, InputError, nearest
from ballscrew.basis.output.sheet import (
    Axis,
    Chart,
    Column,
    Columns,
    Curve,
    Line,
    Lines,
    Number,
    Sheet,
    Table,
    verdict_lines,
    warning_lines,
)
from ballscrew.basis.quantities import Duration, Info, Length, Quantity, Unit
from ballscrew.questions.compensation import STEP, CompensationOptions
from ballscrew.questions.shared.declared import envelope
from ballscrew.questions.warm_up.compute import HOUR, WarmUpReport, check_hours
from ballscrew.questions.warm_up.verdicts import verdicts, warnings

#: The number of points of a list at most (SINUMERIK 808D).
MOST = 200
#: Which way the positions of the axis may grow, seen from the fixed bearing, and the sign of that.
DIRECTIONS = {"away": 1.0, "towards": -1.0}
_WORDS = {"away": "away from", "towards": "towards"}
#: How much finer the growth is looked at where the error is measured.
_FINER = 20


@dataclasses.dataclass(frozen=True, eq=False)
class PositionCompensation(ByValue):
    """Positions of an axis at even steps, and by how much the nut is farther along there than its encoder says, m.

    The encoder is that of the motor. It is the growth at the last instant of work, less that at the reference.
    """

    positions: Numbers
    errors: Numbers
    #: What straight lines between the positions miss of the computed growth, m.
    worst_error: float
    #: Length of the cells of the shaft, m: within one the computed growth is a straight line.
    cell: float
    hours: float
    #: Positions grow away from the fixed bearing, or towards it.
    direction: str

    @property
    def missed(self) -> str:
        """Growth that straight lines between the positions miss, in words, as far as it is known."""
        cell = f"{1e3 * self.cell:.4g} mm"
        if self.step <= self.cell * (1 + 1e-9):
            return f"the growth is computed in cells of {cell}; what straight lines miss within them is not known"
        missed = f"{1e6 * self.worst_error:.2g} µm"
        return f"straight lines between them miss up to {missed} of the computed growth, whose cells are {cell}"

    @property
    def mounting(self) -> str:
        """The direction and the zero of the axis, in words: a wrong one gives the table the wrong sign."""
        place = self.positions[0] if self.direction == "away" else self.positions[-1]
        zero = abs(1e3 * float(place))
        return f"positions grow {_WORDS[self.direction]} the fixed bearing, zero is {zero:.6g} mm from it"

    @property
    def step(self) -> float:
        """Distance of the positions, m."""
        return float((self.positions[-1] - self.positions[0]) / (len(self.positions) - 1))


def position_compensation(
    report: WarmUpReport,
    hours: float,
    *,
    zero: float = 0.0,
    direction: str = "away",
    step: float = STEP,
    reference: float | None = None,
) -> PositionCompensation:
    """The compensation of the growth of a shaft after some hours of work.

    ``zero`` is the place on the shaft, from its fixed bearing, at which the position of the axis is zero; positions
    grow ``"away"`` from that bearing or ``"towards"`` it, on which the sign of the errors depends. At the
    ``reference``, a position of the axis, nothing is compensated: by default at the fixed bearing, which does not move.
    Raises :class:`~ballscrew.basis.errors.InputError` for a step that is not positive or too small, for an unknown
    direction, for a zero or a reference beyond the shaft, and where the warm-up stopped before the hours.
    """
    if report.warm_up.stopped is not None:
        raise InputError(_stopped(report.warm_up.stopped, hours))
    shaft = report.warm_up.network.shaft
    length = float(shaft.length)
    if not length / (MOST - 1) <= step <= length:
        given = f"{1000 * step:g} mm"
        length_2 = units.to_significant(1000 * length, 4)
        remedy = f"give {units.to_significant(1000 * length / (MOST - 1), 3)} mm to {length_2} mm"
        raise InputError(Fault("--step", f"makes more than {MOST} points, or less than two", given, remedy))
    if direction not in DIRECTIONS:
        raise InputError(Fault("--direction", "unknown direction", direction, nearest(direction, DIRECTIONS)))
    if not 0 <= zero <= length:
        remedy = f"its place is 0 mm to {units.to_significant(1000 * length, 6)} mm from the fixed bearing"
        raise InputError(Fault("--zero", "is beyond the shaft", f"{1000 * zero:g} mm", remedy))
    sign = DIRECTIONS[direction]
    at = 0.0 if reference is None else zero + sign * reference
    if not 0 <= at <= length:
        low, high = sorted((-1000 * sign * zero, 1000 * sign * (length - zero)))
        remedy = f"it is {low:zg} mm to {high:zg} mm"
        raise InputError(Fault("--reference", "is beyond the shaft", f"{1000 * sign * (at - zero):g} mm", remedy))
    places, growth = report.warm_up.compensation_table(step / _FINER)
    even = np.linspace(0.0, length, int(np.ceil(length / step - 1e-9)) + 1)
    errors = np.interp(even, places, growth)
    missed = float(np.max(np.abs(np.interp(places, even, errors) - growth)))
    positions, moved = sign * (even - zero), sign * (errors - float(np.interp(at, places, growth)))
    onward = slice(None, None, int(sign))  # positions of a list grow
    return PositionCompensation(
        positions[onward] + 0.0, moved[onward] + 0.0, missed, shaft.cell, hours, direction
    )  # no -0


def check(options: CompensationOptions) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for hours and for a name of an axis that are none."""
    if not options.axis.isidentifier():
        remedy = "write letters and digits, such as X1"
        raise InputError(Fault("--axis", "is no name of an axis", options.axis, remedy))
    check_hours(options.hours, 0.0)


def _stopped(stopped: Duration, hours: float) -> Fault:
    """The fault of a warm-up that never came as far as the hours."""
    reached = math.floor(100 * stopped / HOUR) / 100
    problem = (
        f"the warm-up stops after {units.fixed(reached, 2)} h: beyond it oil or preload are outside what the "
        "model knows"
    )
    less = f"write --hours {reached:g} at most, or " if reached else ""
    return Fault("--hours", problem, f"{hours:g}", f"{less}look at ballscrew warm-up: less work, or more cooling")


class CompensationResults(NamedTuple):
    """Positions of an axis, and by how much the nut is farther along there than its encoder says."""

    position: Annotated[Sequence[float], Unit("m")]
    error: Annotated[Sequence[float], Unit("m")]
    #: What straight lines between the positions miss of the computed growth.
    worst_error: Length
    #: Length of the cells of the shaft.
    cell: Length
    hours: Annotated[float, Unit("h")]
    #: Positions grow away from the fixed bearing, or towards it.
    direction: str


def document(result: PositionCompensation, report: WarmUpReport) -> dict[str, Any]:
    """The document of a compensation of positions, in SI."""
    return envelope(
        report.case,
        CompensationResults(
            result.positions.tolist(),
            result.errors.tolist(),
            result.worst_error,
            result.cell,
            result.hours,
            result.direction,
        ),
        assumed=report.assumed,
        warnings=warnings(report),
        verdicts=verdicts(report),
    )


_WIDTH = 28


def sinumerik(position_compensation: PositionCompensation, axis: str) -> str:
    """``_N_AX_EEC_INI`` of a machine axis, ``X1``."""
    points = enumerate((1e3 * position_compensation.errors).tolist())
    first, last = (1e3 * float(position_compensation.positions[end]) for end in (0, -1))
    lines = [
        "%_N_AX_EEC_INI",
        "CHANDATA(1)",
        *(f"$AA_ENC_COMP[0,{k},{axis}]={value:.5f}" for k, value in points),
        f"$AA_ENC_COMP_STEP[0,{axis}]={1e3 * position_compensation.step:.6f}",
        f"$AA_ENC_COMP_MIN[0,{axis}]={first:.4f} ; {position_compensation.mounting}",
        f"$AA_ENC_COMP_MAX[0,{axis}]={last:.4f} ; {_state(position_compensation)}",
        f"$AA_ENC_COMP_IS_MODULO[0,{axis}]=0",
        "M17",
        "",
    ]
    return "\n".join(lines)


def isg(position_compensation: PositionCompensation, axis: str) -> str:
    """``kw.ssfk.*`` for both directions, of an axis by its name."""
    positions, values = (
        np.round(1e7 * each).astype(int).tolist()
        for each in (position_compensation.positions, position_compensation.errors)
    )
    entries: dict[str, object] = {
        "kopf.log_achs_name": axis,
        "kw.ssfk.interval": 0,
        "kw.ssfk.kw_startpos": positions[0],
        "kw.ssfk.kw_nr_max": len(positions),
        "kw.ssfk.unit": 1,
        "kw.ssfk.bilateral": 1,
    }
    for name, column in (("setpoint", positions), ("pos", values), ("neg", values)):
        entries |= {f"kw.ssfk.table[{k}].{name}": value for k, value in enumerate(column)}
    said = (f"# {line}" for line in (position_compensation.mounting, _state(position_compensation)))
    return "\n".join([*said, *(f"{name:<{_WIDTH}} {value}" for name, value in entries.items()), ""])


def _state(position_compensation: PositionCompensation) -> str:
    return f"holds after {position_compensation.hours:g} h of the work of its case only"


#: The lists by the name of the control.
LISTS: Mapping[str, Callable[[PositionCompensation, str], str]] = {"sinumerik": sinumerik, "isg": isg}


_POSITION = Quantity("position", "m", Info("x", "position of the axis", "mm"))
_ERROR = Quantity("error", "m", Info("e", "by how much the nut is farther along", "um"))


# -- what people see of it -------------------------------------------------------------------------


def sheet(result: PositionCompensation, report: WarmUpReport) -> Sheet:
    """All that people see of a compensation."""
    positions, errors = result.positions, result.errors
    return Sheet(
        f"compensation of {len(positions)} points at steps of {units.shown(result.step, _POSITION)}: "
        f"it holds after {result.hours:g} h of this work only",
        [
            verdict_lines(verdicts(report)),
            warning_lines(warnings(report)),
            Table(
                "range",
                "Growth of the shaft",
                ("", "from", "to"),
                [
                    ["position", Number(positions[0], _POSITION), Number(positions[-1], _POSITION)],
                    ["error", Number(errors.min(), _ERROR, 3), Number(errors.max(), _ERROR, 3)],
                ],
                [
                    result.missed,
                    f"taken: {result.mounting} (--direction, --zero); if that is not so, signs and places are wrong",
                    "format checked against the manual, not on a control",
                ],
            ),
            Chart(
                "error over position",
                Axis("position", _POSITION),
                Axis("error", _ERROR),
                [Curve("", positions, errors)],
            ),
            Lines([Line(f"assumed: {text}", "small") for text in report.assumed]),
            Columns("points", [Column("position", positions, _POSITION), Column("error", errors, _ERROR)]),
        ],
    )
