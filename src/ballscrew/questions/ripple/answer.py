"""The torque of a nut over the angle of its screw, with faults and for several nuts: its document, and its sheet."""

from __future__ import annotations

import dataclasses
import itertools
import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Annotated, Any, NamedTuple

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.arrays import lazy
from ballscrew.basis.errors import Fault, InputError, nearest, raise_if_any
from ballscrew.basis.output.sheet import (
    Axis,
    Cell,
    Chart,
    Colour,
    Column,
    Columns,
    Curve,
    Line,
    Lines,
    Number,
    Share,
    Sheet,
    Table,
    Vertical,
    verdict_lines,
    warning_lines,
)
from ballscrew.basis.quantities import Array, Info, Quantity, Torque, Unit, quantities_of
from ballscrew.basis.records import Record
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.case_files.case import Case
from ballscrew.physics.equations import ball_chain
from ballscrew.physics.laws.ball_chain import ChainBallForce
from ballscrew.physics.laws.nut_losses import ReturnBraking
from ballscrew.physics.moving_balls.ripple import (
    Defect,
    FullCircuit,
    MissingBall,
    NamedOrder,
    NutGroove,
    PreloadLeft,
    Ripple,
    Spall,
    torque_ripple,
)
from ballscrew.questions.ripple import RippleOptions
from ballscrew.questions.shared.declared import envelope, from_attributes, parts_like
from ballscrew.questions.shared.option_values import faults_named, flags_of
from ballscrew.questions.shared.question import Answer, Done, Request, Work

#: Faults that "all" stands for; a nut without preload has none to lose.
ALL = ("missing-ball", "full", "spall=2 mm x 2 um", "preload=0.35", "groove=3")
#: The same by name.
FAULTS = ("missing-ball", "full", "spall", "preload", "groove")
#: Changes by which torque shows a fault: of the mean, and of its range over the mean, either way. One nut of a kind
#: differs from the next by a third of its range.
SHOWS_MEAN, SHOWS_RANGE = 0.1, 0.5
#: Quantiles of a band over nuts.
LOW, HIGH = 0.1, 0.9
_FLAGS: Mapping[str, str] = {
    **flags_of("chain", RippleOptions),
    **flags_of("ripple", RippleOptions),
    "ripple.defect": "--fault",
    "chain.axial_load": "operation.axial_load",
    "chain.screw_speed": "operation.screw_speed",
}
_WIDTH = Quantity("width", "m", Info("w", "width of a spall", "mm"))
_DEPTH = Quantity("depth", "m", Info("t", "depth of a spall", "um"))
_DEVIATION = Quantity("groove_deviation", "m", Info("e", "deviation of the grooves, root mean square", "um"))
_KNOWN = quantities_of(Ripple)


class Range(NamedTuple):
    """The peak to peak of several nuts, N m: the median, and what eight in ten lie between."""

    #: The number of nuts.
    nuts: int
    low: Annotated[Torque, Info("M_10", "peak to peak that one nut in ten is below")]
    median: Annotated[Torque, Info("M_50", "median of the peaks to peaks")]
    high: Annotated[Torque, Info("M_90", "peak to peak that one nut in ten is above")]


@dataclasses.dataclass(frozen=True, eq=False)
class RippleReport:
    """The torque of a nut over the angle, and with faults."""

    case: Case
    #: What the torque was computed with beside the case, assumed numbers too.
    given: Mapping[str, Any]
    ripple: Ripple
    #: By what was written.
    faults: Mapping[str, Ripple]
    range: Range | None

    @lazy
    def verdicts(self) -> Sequence[Record]:
        """The size of the ripple and its greatest order, and whether torque shows each fault."""
        return [self._size(), *(self._fault(name, each) for name, each in self.faults.items())]

    @lazy
    def assumed(self) -> Sequence[str]:
        """Assumptions for what a catalogue does not print, and what is left out."""
        gap, deviation, circuits = (self.given[name] for name in ("gap", "groove_deviation", "circuits"))
        return [
            f"in each circuit room for {gap:g} balls, grooves {units.shown(deviation, _DEVIATION)} off "
            f"(root mean square), circuits in each half: {circuits}; no catalogue has them",
            "each circuit has grooves of its own; bodies are rigid, and balls have no inertia",
            "seals and other losses are left out",
        ]

    def _size(self) -> Record:
        ripple = self.ripple
        most = max(ripple.orders, key=lambda one: one.amplitude)
        message = (
            f"the torque goes up and down by {_torque(ripple.peak_to_peak)}, {units.percent(ripple.relative)} of its "
            f"mean; its greatest order is {most.order:.3g} per turn ({most.name}), {_torque(most.amplitude)}"
        )
        return Record("ripple.size", "peak_to_peak", message, value=ripple.peak_to_peak, unit="N m")

    def _fault(self, name: str, ripple: Ripple) -> Record:
        shown = shows(self.ripple, ripple)
        mean = units.percent(ripple.mean / self.ripple.mean)
        range_over_mean = units.percent(ripple.relative / self.ripple.relative)
        message = (
            f"{name}: torque {'shows it' if shown else 'is a poor sensor of it'}, its mean is {mean} and its range "
            f"over the mean {range_over_mean} of what they were"
        )
        return Record(f"ripple.{name.partition('=')[0]}", "torque", message, holds=shown)


def shows(usual: Ripple, ripple: Ripple) -> bool:
    """Test whether the torque of a nut with a fault differs from that without it by more than nuts of one kind do."""
    mean, change = ripple.mean / usual.mean, ripple.relative / usual.relative
    return abs(mean - 1) > SHOWS_MEAN or abs(change - 1) > SHOWS_RANGE


def ripple_of(case: Case, options: RippleOptions, done: Callable[[int, int], None] | None = None) -> RippleReport:
    """The torque of a case's nut over the angle, with the faults that are asked for.

    ``done`` is told after each nut how many of all there are.
    Raises :class:`~ballscrew.basis.errors.InputError` as
    :func:`~ballscrew.physics.moving_balls.ripple.torque_ripple` does, and for an unknown fault.
    """
    asked = [name for one in options.fault for name in (_all_of(case) if one == "all" else [one])]
    defects = defects_of(asked)
    if options.seeds < 1:
        raise InputError(Fault("--seeds", "must be at least one", str(options.seeds), "leave it out, or give 8"))
    given = given_of(case, options)

    total, counted = len(defects) + options.seeds, itertools.count(1)

    def run(defect: Defect | None = None, seed: int = options.seed) -> Ripple:
        ripple = torque_ripple(case.model, case.screw, case.lubricant, **given, seed=seed, defect=defect)
        if done is not None:
            done(next(counted), total)
        return ripple

    with faults_named(_FLAGS):
        usual = run()
        faults = {name: run(defect) for name, defect in defects.items()}
        others = [run(seed=options.seed + i) for i in range(1, options.seeds)]
    return RippleReport(case, given, usual, faults, _peaks_of([usual, *others]))


def given_of(case: Case, options: RippleOptions) -> Mapping[str, Any]:
    """Inputs of the physics: as written, else as the case has them, else as assumed.

    A case may describe its circuits by the law of the force between balls, and its returns by that of their losses.
    """
    screw, force = case.screw, case.model.ball_force
    law = force if isinstance(force, ChainBallForce) else ChainBallForce()
    turn = ball_chain.balls_of_a_turn(case.model.laws.frame(screw).path_radius, screw.ball_diameter)
    known: dict[str, Any] = {
        "gap": law.gap, "groove_deviation": law.groove_deviation, "circuits": max(1, round(float(law.circuits))),
        "wall_factor": law.wall_factor, "return_balls": math.ceil(law.return_turns * turn),
    }  # fmt: skip
    loss = screw.nut.losses.get("recirculation")
    if isinstance(loss, ReturnBraking) and loss.return_balls:
        known |= {"wall_factor": loss.wall_factor, "return_balls": loss.return_balls}
    written = {name: getattr(options, name) for name in known}
    return {
        "axial_load": float(case.operation.axial_load),
        "screw_speed": float(case.operation.screw_speed),
        **known,
        **{name: value for name, value in written.items() if value is not None},
        **{name: getattr(options, name) for name in ("relief", "turns")},
    }


def _all_of(case: Case) -> list[str]:
    preloaded = getattr(case.screw.nut, "preload", None) is not None
    return [name for name in ALL if preloaded or not name.startswith("preload")]


def _peaks_of(ripples: Sequence[Ripple]) -> Range | None:
    if len(ripples) == 1:
        return None
    low, median, high = np.quantile([one.peak_to_peak for one in ripples], (LOW, 0.5, HIGH))
    return Range(len(ripples), float(low), float(median), float(high))


def _torque(value: float) -> str:
    return units.shown(value, _KNOWN["peak_to_peak"], 3)


# -- faults as people write them ------------------------------------------------------------------


def defects_of(written: Sequence[str]) -> Mapping[str, Defect]:
    """The faults by what was written. Raises :class:`~ballscrew.basis.errors.InputError` for unknown ones."""
    faults: list[Fault] = []
    defects: dict[str, Defect] = {}
    for one in written:
        name, _, value = (part.strip() for part in one.partition("="))
        reader = _READERS.get(name)
        if reader is None:
            faults.append(Fault("--fault", "unknown fault", one, nearest(name, FAULTS)))
            continue
        made = reader(one, value)
        if isinstance(made, Fault):
            faults.append(made)
        else:
            defects[one] = made
    raise_if_any(faults)
    return defects


def _plain(make: Callable[[], Defect]) -> Callable[[str, str], Defect | Fault]:
    def read(one: str, value: str) -> Defect | Fault:
        return Fault("--fault", "takes no number", one, "leave it out") if value else make()

    return read


def _number(make: Callable[[float], Defect], remedy: str) -> Callable[[str, str], Defect | Fault]:
    def read(one: str, value: str) -> Defect | Fault:
        percent = value.endswith("%")
        try:
            number = float(value.removesuffix("%")) * (0.01 if percent else 1.0)
        except ValueError:
            return Fault("--fault", "needs a number", one, remedy)
        return make(number) if math.isfinite(number) else Fault("--fault", "needs a number", one, remedy)

    return read


def _spall(one: str, value: str) -> Defect | Fault:
    sizes = re.split(r"\s*[x×]\s*", value)
    if len(sizes) != 2:
        return Fault("--fault", "needs a width and a depth", one, 'write spall="2 mm x 2 um"')
    width, depth = (
        units.parse("--fault", size, quantity) for size, quantity in zip(sizes, (_WIDTH, _DEPTH), strict=True)
    )
    if isinstance(width, Fault):
        return width
    return depth if isinstance(depth, Fault) else Spall(float(width), float(depth))


_READERS: Mapping[str, Callable[[str, str], Defect | Fault]] = {
    "missing-ball": _plain(MissingBall),
    "full": _plain(FullCircuit),
    "spall": _spall,
    "preload": _number(PreloadLeft, "write preload=0.35"),
    "groove": _number(NutGroove, "write groove=3"),
}


@dataclasses.dataclass(frozen=True)
class FaultAsked:
    """A fault that is asked for."""

    #: The fault as it was written.
    fault: str


@dataclasses.dataclass(frozen=True, eq=False)
class FaultResult(
    parts_like(Ripple, "mean", "peak_to_peak", "deviation", "relative", "share", "orders"),
    FaultAsked,
):
    """The torque with a fault."""


class CurveResult(NamedTuple):
    """A curve of the torque."""

    #: Turns of the screw, or orders.
    x: Annotated[Sequence[float], Unit("1")]
    #: The friction torque, or its amplitude.
    y: Annotated[Sequence[float], Unit("N m")]


@dataclasses.dataclass(frozen=True, eq=False)
class RippleResults(
    parts_like(Ripple, "mean", "peak_to_peak", "deviation", "relative", "parts", "displacement", "share", "orders")
):
    """The friction torque of the balls of a nut over the angle of the screw."""

    parts: Annotated[Mapping[str, float], Unit("N m"), Info("", "mean torques by cause")]
    #: The peak to peak of several nuts, where they are asked for.
    range: Range | None
    #: The torque with each fault that is asked for.
    faults: Sequence[FaultResult]
    #: Torque over the turns of the screw.
    torque: CurveResult
    #: Amplitude of the torque over the order.
    spectrum: CurveResult


def document(report: RippleReport) -> dict[str, Any]:
    """Inputs, torque over the angle, orders, faults, verdicts and provenance."""
    ripple = report.ripple
    results = from_attributes(
        RippleResults,
        ripple,
        range=report.range,
        faults=[from_attributes(FaultResult, ripple, fault=name) for name, ripple in report.faults.items()],
        torque=CurveResult((ripple.angle / (2 * math.pi)).tolist(), ripple.torque.tolist()),
        spectrum=CurveResult(*(values.tolist() for values in ripple.spectrum)),
    )
    return envelope(
        report.case,
        results,
        assumed=report.assumed,
        warnings=report.case.implausible(),
        verdicts=report.verdicts,
    )


_ORDER = quantities_of(NamedOrder)
_TORQUE = Quantity("torque", "N m", Info("M", "friction torque of the balls"))
_TURNS = Quantity("turns", "1", Info("n", "turns of the screw"))
_COLOURS: tuple[Colour, ...] = ("blue", "orange", "green", "purple", "red", "grey")
#: Orders and turns that are drawn, and the least amplitude over the greatest.
_MOST_ORDER, _MOST_TURNS, _LEAST = 24.0, 6.0, 1e-4


# -- what people see of it -------------------------------------------------------------------------


def sheet(report: RippleReport) -> Sheet:
    """All that people see of a ripple."""
    ripples = {"as it is": report.ripple, **report.faults}
    return Sheet(
        f"torque over the angle: {descriptions.nut_text(report.case.screw.nut)}",
        [
            Lines([Line(descriptions.design(report.case, plain_text=True), "small")], detail=True),
            verdict_lines(report.verdicts),
            warning_lines(report.case.implausible()),
            _sizes(ripples),
            *_range(report),
            _orders(ripples),
            *_charts(ripples),
            Lines([Line(f"assumed: {message}", "small") for message in report.assumed]),
            *_files(ripples),
        ],
    )


def _sizes(ripples: Mapping[str, Ripple]) -> Table:
    """Mean and range of the torque, as the nut is and with each fault."""
    rows: list[list[Cell]] = [
        [
            name,
            Number(ripple.mean, _KNOWN["mean"], 3),
            Number(ripple.peak_to_peak, _KNOWN["peak_to_peak"], 3),
            Share(ripple.relative, bar=False),
            Number(ripple.deviation, _KNOWN["deviation"], 3),
            Number(ripple.share, _KNOWN["share"], 2),
        ]
        for name, ripple in ripples.items()
    ]
    columns = ("", "mean", "peak to peak", "over mean", "standard deviation", "force between balls")
    notes = ["Forces between balls are over the load of a ball.", *_displacement(ripples["as it is"])]
    return Table("sizes", "Torque of the balls", columns, rows, notes)


def _displacement(ripple: Ripple) -> Iterator[str]:
    if math.isfinite(ripple.displacement):
        moved = units.shown(ripple.displacement, _KNOWN["displacement"], 2)
        yield f"The nut moves against the screw by {moved} along the axis at constant load."


def _range(report: RippleReport) -> Iterator[Table]:
    """The range of several nuts, where they are asked for."""
    if report.range is not None:
        nuts, low, median, high = report.range
        peaks = Number(median, _KNOWN["peak_to_peak"], 3, (low, high))
        yield Table("nuts", f"{nuts} nuts", ("", "median (eight in ten)"), [["peak to peak", peaks]])


def _orders(ripples: Mapping[str, Ripple]) -> Table:
    """The orders with their causes, as the nut is and with each fault."""
    rows: list[list[Cell]] = []
    for orders in zip(*(ripple.orders for ripple in ripples.values()), strict=True):
        amplitudes = [Number(float(order.amplitude), _ORDER["amplitude"], 2) for order in orders]
        rows.append([orders[0].name, Number(float(orders[0].order), _ORDER["order"]), *amplitudes])
    return Table("orders", "Amplitude of orders", ("", "per turn", *ripples), rows)


def _charts(ripples: Mapping[str, Ripple]) -> Iterator[Chart]:
    colours = dict(zip(ripples, _COLOURS * len(ripples), strict=False))
    torques, spectra = list[Curve](), list[Curve | Vertical]()
    for name, ripple in ripples.items():
        turns, (orders, amplitudes) = ripple.angle / (2 * math.pi), ripple.spectrum
        drawn, listed = turns <= _MOST_TURNS, (orders > 0) & (orders <= _MOST_ORDER)
        torques.append(Curve(name, turns[drawn], ripple.torque[drawn], colours[name]))
        spectra.append(Curve(name, orders[listed], amplitudes[listed], colours[name]))
    for index, order in enumerate(ripples["as it is"].orders):
        spectra.append(Vertical("" if index else "with a cause", float(order.order)))
    yield Chart("torque of the balls", Axis("turns of the screw", _TURNS), Axis("torque", _TORQUE, least=0.0), torques)
    least = _LEAST * max(float(np.max(ripple.spectrum[1])) for ripple in ripples.values())
    amplitude = Axis("amplitude", _ORDER["amplitude"], log=True, least=least)
    yield Chart("orders of the torque", Axis("order, per turn of the screw", _ORDER["order"]), amplitude, spectra)


def _files(ripples: Mapping[str, Ripple]) -> Iterator[Columns]:
    """Torque over the turns and amplitude over the orders, of each nut below the other."""
    torque = [(ripple.angle / (2 * math.pi), ripple.torque) for ripple in ripples.values()]
    spectra = [ripple.spectrum for ripple in ripples.values()]
    yield _curves("curves", list(ripples), ("turns", _TURNS, "torque", _TORQUE), torque)
    yield _curves("spectra", list(ripples), ("order", _ORDER["order"], "amplitude", _ORDER["amplitude"]), spectra)


def _curves(
    name: str, nuts: Sequence[str], axes: tuple[str, Quantity, str, Quantity], curves: Sequence[tuple[Array, Array]]
) -> Columns:
    nut = [nut for nut, (x, _) in zip(nuts, curves, strict=True) for _ in x]
    x, y = (np.concatenate(values) for values in zip(*curves, strict=True))
    return Columns(name, [Column("nut", nut), Column(axes[0], x, axes[1]), Column(axes[2], y, axes[3])])


def prepare(request: Request) -> Work:
    """The work for an answer; a request is read and checked at once."""
    options, case = request.options(RippleOptions), request.load()

    def answer(done: Done) -> Answer:
        report = ripple_of(case, options, done)
        return Answer(sheet(report), lambda: document(report), f"{len(report.ripple.angle)} angles")

    return Work(answer, "ripple")
