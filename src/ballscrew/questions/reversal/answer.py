"""Friction after a reversal: where it is back, by mechanism and by share; its document, and its sheet."""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, overflow_as_input_error
from ballscrew.basis.output.sheet import (
    Axis,
    Cell,
    Chart,
    Colour,
    Column,
    Columns,
    Curve,
    Level,
    Line,
    Lines,
    Number,
    Share,
    Sheet,
    Table,
    verdict_lines,
    warning_lines,
    words,
)
from ballscrew.basis.quantities import (
    Angle,
    Info,
    Length,
    Quantity,
    Ratio,
    RotationalDamping,
    Torque,
    Unit,
    quantities_of,
)
from ballscrew.basis.records import Record
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.sweeps.sweep import PARTS, QUANTITIES
from ballscrew.physics.moving_balls import reversal as moving_balls
from ballscrew.physics.moving_balls.friction_states import (
    Dahl,
    DahlFit,
    FitError,
    LuGre,
    LuGreFit,
    SlipElement,
    SlipElementsFit,
    WindingUp,
    fit_dahl,
    fit_dahl_first,
    fit_lugre,
    fit_slip_elements,
    of_elements,
)
from ballscrew.questions.reversal import ReversalOptions
from ballscrew.questions.shared.declared import envelope, from_attributes
from ballscrew.questions.shared.question import Answer, Request, Work

#: Shares of the swing whose places are told.
SHARES = (0.5, 0.63, 0.9, 0.98)
#: Share of the steady torque that is what a difference of torques leaves.
_ROUNDING = 1e-12
#: Step of the speed, as a share, over which the slope of a torque is taken.
_STEP = 0.01
#: Travel beyond which the stiffness for tracking is of use, m.
TRACKING = 1e-4
#: How far the steady slip torque of the bristles may be from the model's without a word, as a share.
BRISTLES_OFF = 0.1
#: The share of which verdicts and captions speak.
MOST = 0.9
#: Numbers of Maxwell-slip elements that are fitted.
COUNTS = (2, 3, 4)
ANGLE, TORQUE = (QUANTITIES[name] for name in ("screw_angle", "steady_torque"))
#: In µm, as the first of it are.
TRAVEL = dataclasses.replace(QUANTITIES["travel"], info=dataclasses.replace(QUANTITIES["travel"].info, shown_in="um"))
STIFFNESS: Quantity = quantities_of(Dahl)["presliding_stiffness"]


class Place(NamedTuple):
    """Point where friction is back at a share of its swing; zero at once, NaN where it is not within the travel."""

    share: Annotated[Ratio, Info("", "share of the swing of the friction torque")]
    screw_angle: Annotated[Angle, Info(r"\theta", "angle of the screw at which this share is back", "deg")]
    travel: Annotated[Length, Info("x", "travel of the nut at which this share is back", "um")]


@dataclasses.dataclass(frozen=True, eq=False)
class ReversalReport:
    """Friction of a case after a reversal, or from rest, with the models fitted to it."""

    case: Case
    reversal: moving_balls.Reversal
    curve: WindingUp
    #: For the first 0.02° alone; None where the curve has too few angles there.
    dahl_first: DahlFit | None
    #: With the least squares over the travel.
    dahl: DahlFit
    lugre: LuGreFit
    #: With two, three and four elements, as far as they are of use.
    slip_elements: Sequence[SlipElementsFit]

    @functools.cached_property
    def swing(self) -> Sequence[Place]:
        """Places where the shares of the swing are back, of all friction."""
        return self._places(np.asarray(self.reversal.screw_torque, dtype=float), float(self.reversal.steady_torque))

    @functools.cached_property
    def swing_by_mechanism(self) -> Mapping[str, Sequence[Place]]:
        """The same of each part that there is; what follows the direction at once has zeros.

        The swing of a part ends where its curve ends, once all friction is back: the bristles may share the slip in
        another way than the model does.
        """
        steady = {name: float(value) for name, value in self.reversal.steady_contributions.items()}
        whole = abs(float(self.reversal.steady_torque))
        back = math.isfinite(self.swing[-1].screw_angle)
        return {
            name: self._places(np.asarray(values, dtype=float), float(values[-1]) if back else steady[name])
            for name, values in self.reversal.contributions.items()
            if abs(steady[name]) > _ROUNDING * whole
        }

    @property
    def crosses(self) -> bool:
        """True where the balls roll across their grooves, so that helix slip comes back over degrees."""
        return any(np.ptp(np.asarray(one, dtype=float)) > 0 for one in self.reversal.displacement)

    def _places(self, torque: NDArray[np.float64], end: float) -> Sequence[Place]:
        angle, travel = (np.asarray(one, dtype=float) for one in (self.reversal.screw_angle, self.reversal.travel))
        shares = (torque - torque[0]) / (end - torque[0])
        return [Place(share, *_reached(shares, share, angle, travel)) for share in SHARES]

    @property
    def verdicts(self) -> list[Record]:
        """Verdicts on the travel to most of the friction, on a single stiffness, and on Maxwell-slip elements."""
        place = next(one for one in self.swing if one.share == MOST)
        share = units.percent(MOST)
        start = "from rest" if self.reversal.from_rest else "after a reversal"
        if math.isfinite(place.screw_angle):
            angle, travel = units.shown(place.screw_angle, ANGLE, 3), units.shown(place.travel, TRAVEL, 3)
            text = f"{start} {share} of the friction is back within {angle} of the screw, {travel}"
        else:
            end = units.shown(float(np.asarray(self.curve.travel)[-1]), TRAVEL, 3)
            text = f"{start} less than {share} of the friction is back within {end}"
        verdicts = [Record("reversal.back", "screw_torque", text, value=place.screw_angle, unit="rad")]
        two = self.slip_elements[0]
        if self.dahl_first is not None and float(np.asarray(self.curve.travel)[-1]) > TRACKING:
            first = units.shown(self.dahl_first.model.presliding_stiffness, STIFFNESS, 3)
            tracking = units.shown(self.dahl.model.presliding_stiffness, STIFFNESS, 3)
            text = (
                f"one stiffness of Dahl or LuGre is {first} for the first 0.02° and {tracking} for tracking over more "
                "than 0.1 mm; with the latter the torque is off by up to "
                f"{units.percent(self.dahl.error.largest)} of the steady one"
            )
            verdicts.append(
                Record("reversal.one_stiffness", "presliding_stiffness", text, value=self.dahl.error.largest)
            )
        off = units.percent(two.error.largest)
        text = f"one Maxwell-slip element is off by up to {off}"
        if len(two.elements) > 1:
            text = f"{len(two.elements)} Maxwell-slip elements are off by up to {off}"
        verdicts.append(Record("reversal.slip_elements", "slip_elements", text, value=two.error.largest))
        return verdicts

    @property
    def warnings(self) -> list[Record]:
        """Warnings: the helix part as a hypothesis, limits of what is known of the first range, implausible inputs."""
        records: list[Record] = []
        if self.crosses:
            text = (
                "helix slip that comes back over degrees of the screw is a hypothesis: it is computed, and the log of "
                "one axis (EMPS: guides, an unknown screw) is all that speaks for it"
            )
            records.append(Record("reversal.hypothesis", "helix", text, severity="warning"))
        ratio = float(self.reversal.bristles_over_model)
        if abs(ratio - 1) > BRISTLES_OFF:
            text = (
                f"the bristles that the curve is computed with have {units.percent(ratio)} of the steady slip torque "
                "of the model, to which the curve is scaled: its shape is as uncertain"
            )
            records.append(
                Record(
                    "reversal.bristles",
                    "bristles_over_model",
                    text,
                    severity="warning",
                    value=ratio,
                    limit=BRISTLES_OFF,
                )
            )
        ratios = [loop.work_ratio for fit in self.slip_elements for loop in fit.loops]
        if ratios:
            loops = (self.curve.loops[0], self.curve.loops[-1])
            shortest, longest = (units.shown(loop.stroke / 2, ANGLE, 3) for loop in loops)
            text = (
                f"on strokes of ±{shortest} to ±{longest} the friction work of the Maxwell-slip elements is "
                f"{units.percent(min(ratios))} to {units.percent(max(ratios))} of that of the balls, whose contacts "
                "have no memory of turning points: no elements have both the curve and the work of all strokes"
            )
            worst = max(fit.work_error for fit in self.slip_elements)
            records.append(Record("reversal.work_of_elements", "slip_elements", text, value=worst))
        text = "the stiffness of the first hundredths of a degree is known to a factor of three"
        records.append(Record("reversal.first_range", "spin_and_curvature", text))
        return [*records, *self.case.implausible()]


@overflow_as_input_error()
def reversal(case: Case, options: ReversalOptions) -> ReversalReport:
    """The reversal of a case at its operating point.

    Raises :class:`~ballscrew.basis.errors.InputError` for a screw at rest, which has no direction, and for a travel in
    which there is no curve.
    """
    speed = float(case.operation.screw_speed)
    if not speed:
        remedy = 'give the speed that it turns with: --set operation.screw_speed="10 rpm"'
        raise InputError(Fault("operation.screw_speed", "must not be zero", "0 rpm", remedy))
    result = moving_balls.reversal(
        case.model,
        case.screw,
        case.lubricant,
        axial_load=case.operation.axial_load,
        screw_speed=speed,
        travel=options.travel,
        from_rest=options.from_rest,
        gap=options.gap,
    )
    loops = moving_balls.loops(
        case.model,
        case.screw,
        case.lubricant,
        result,
        axial_load=case.operation.axial_load,
        screw_speed=speed,
        gap=options.gap,
    )
    return of(case, result, options, loops)


def of(
    case: Case, result: moving_balls.Reversal, options: ReversalOptions, loops: Sequence[moving_balls.Loop] = ()
) -> ReversalReport:
    """The report of a reversal that is known, and of the ``loops`` of short strokes."""
    curve = WindingUp.of(result, loops)
    fits = (fit_slip_elements(curve, count) for count in COUNTS)
    return ReversalReport(
        case=case,
        reversal=result,
        curve=curve,
        dahl_first=fit_dahl_first(curve),
        dahl=fit_dahl(curve),
        lugre=fit_lugre(
            curve,
            screw_speed=float(case.operation.screw_speed),
            viscous_slope=viscous_slope(case),
            moment_of_inertia=options.inertia,
        ),
        slip_elements=tuple({len(fit.elements): fit for fit in fits}.values()),
    )


def viscous_slope(case: Case) -> RotationalDamping:
    """Slope of the rolling resistance over the speed at the operating point, N m s/rad.

    Rolling grows with less than the speed, so that this is a tangent; what falls with the speed is not in it.
    """
    speed = float(case.operation.screw_speed)
    ends = (speed * (1 - _STEP), speed * (1 + _STEP))
    load = case.operation.axial_load
    slower, faster = (case.model(case.screw, case.lubricant, axial_load=load, screw_speed=each) for each in ends)
    rolling = [
        sum(float(one.contributions[name]) for name in moving_balls.MECHANISMS["rolling"]) for one in (slower, faster)
    ]
    return (rolling[1] - rolling[0]) / abs(ends[1] - ends[0])


def _reached(
    shares: NDArray[np.float64], share: float, angle: NDArray[np.float64], travel: NDArray[np.float64]
) -> tuple[float, float]:
    """Angle and travel at which a share is first reached, on straight lines; NaN where it is not.

    Zero where the first angle beside zero has it: what follows the direction at once.
    """
    there = np.flatnonzero(shares >= share)
    if not there.size:
        return math.nan, math.nan
    if there[0] <= 1:
        return 0.0, 0.0
    here = slice(int(there[0]) - 1, int(there[0]) + 1)
    return float(np.interp(share, shares[here], angle[here])), float(np.interp(share, shares[here], travel[here]))


_CURVE = quantities_of(WindingUp)


@dataclasses.dataclass(frozen=True, eq=False)
class ReversalResults:
    """Friction over the angle of the screw after a reversal or from rest, and the models fitted to it."""

    #: True for a curve from rest.
    from_rest: bool
    screw_angle: Annotated[Sequence[float], Unit("rad"), ANGLE.info]
    travel: Annotated[Sequence[float], Unit("m"), TRAVEL.info]
    screw_torque: Annotated[
        Sequence[float], Unit("N m"), Info("M", "friction torque on the screw, against its new direction")
    ]
    contributions: Annotated[Mapping[str, Sequence[float]], Unit("N m"), Info("", "its parts by mechanism")]
    steady_torque: Annotated[Torque, TORQUE.info]
    steady_contributions: Annotated[Mapping[str, float], Unit("N m"), Info("", "its parts by mechanism")]
    coulomb_torque: Annotated[Torque, _CURVE["coulomb_torque"].info]
    at_once: Annotated[Torque, _CURVE["at_once"].info]
    #: Where 50, 63, 90 and 98 % of the swing are back.
    swing: Sequence[Place]
    #: The same by mechanism, of those that wind up.
    swing_by_mechanism: Mapping[str, Sequence[Place]]
    #: The model of Dahl for the first 0.02° alone; null where the curve has too few angles there.
    dahl_first: DahlFit | None
    #: The model of Dahl with the least squares over the travel.
    dahl: DahlFit
    #: The model LuGre with the same stiffness.
    lugre: LuGreFit
    #: Two, three and four Maxwell-slip elements, as far as they are of use.
    slip_elements: Sequence[SlipElementsFit]


def document(report: ReversalReport) -> dict[str, Any]:
    """The document of a reversal, in SI."""
    results = from_attributes(ReversalResults, report, report.reversal, report.curve)
    return envelope(report.case, results, warnings=report.warnings, verdicts=report.verdicts)


_ELEMENT, _LUGRE = quantities_of(SlipElement), quantities_of(LuGre)
_DIGITS = 3
_COLOURS: Mapping[str, Colour] = {
    "rolling": "sky",
    "spin_and_curvature": "red",
    "helix": "blue",
    "ball_to_ball": "purple",
    "losses": "green",
}


# -- what people see of it -------------------------------------------------------------------------


def sheet(report: ReversalReport) -> Sheet:
    """All that people see of a reversal."""
    warnings = [record for record in report.warnings if record.severity == "warning"]
    notes = [record for record in report.warnings if record.severity != "warning"]
    return Sheet(
        _title(report),
        [
            verdict_lines(report.verdicts),
            warning_lines(warnings),
            _mechanisms(report),
            _swing(report),
            _models(report),
            _elements(report),
            *_charts(report),
            Lines([Line(f"note: {record.text}", "small") for record in notes]),
            Lines([Line(descriptions.design(report.case, plain_text=True), "small")]),
            _columns(report),
        ],
    )


def _title(report: ReversalReport) -> str:
    """``Friction after a reversal: 7000 N, 600 rpm, double nut, preload 5047 N, model reference``."""
    start = "Friction from rest" if report.reversal.from_rest else "Friction after a reversal"
    return f"{start}: {descriptions.title(report.case)}"


def _mechanisms(report: ReversalReport) -> Table:
    """Each part of the steady torque, and where most of it is back."""
    rows: list[Sequence[Cell]] = []
    for name, places in report.swing_by_mechanism.items():
        steady = float(report.reversal.steady_contributions[name])
        rows.append([PARTS.get(name, name), Number(steady, TORQUE, _DIGITS), *_where(places)])
    steady = float(report.reversal.steady_torque)
    rows.append(["all friction", Number(steady, TORQUE, _DIGITS), *_where(report.swing)])
    return Table("parts", "part", ("", "steady torque", f"{MOST:.0%} back at", "travel"), rows)


def _where(places: Sequence[Place]) -> list[Cell]:
    """Angle and travel at which most is back."""
    place = next(place for place in places if place.share == MOST)
    if not place.screw_angle:
        return ["at once", ""]
    return [Number(place.screw_angle, ANGLE, _DIGITS), Number(place.travel, TRAVEL, _DIGITS)]


def _swing(report: ReversalReport) -> Table:
    """Places where the shares of the swing are back, of all friction."""
    steady = float(report.reversal.steady_torque)
    start = 0.0 if report.reversal.from_rest else -steady
    rows: list[Sequence[Cell]] = [
        ["torque", *(Number(start + place.share * (steady - start), TORQUE, _DIGITS) for place in report.swing)],
        ["angle of the screw", *(Number(place.screw_angle, ANGLE, _DIGITS) for place in report.swing)],
        ["travel of the nut", *(Number(place.travel, TRAVEL, _DIGITS) for place in report.swing)],
    ]
    return Table("swing", "share of the swing", ("", *(f"{place.share:.0%}" for place in report.swing)), rows)


def _models(report: ReversalReport) -> Table:
    """Dahl in both ranges, and LuGre."""
    lugre, coulomb = report.lugre.model, Number(report.curve.coulomb_torque, TORQUE, _DIGITS)
    stiffness = Number(report.dahl.model.presliding_stiffness, STIFFNESS, _DIGITS)
    rows: list[Sequence[Cell]] = []
    if report.dahl_first is not None:
        first = Number(report.dahl_first.model.presliding_stiffness, STIFFNESS, _DIGITS)
        rows.append(["Dahl, first 0.02°", first, coulomb, "", "", *_errors(report.dahl_first.error)])
    rows.append(["Dahl, tracking", stiffness, coulomb, "", "", *_errors(report.dahl.error)])
    damping = Number(lugre.micro_damping, _LUGRE["micro_damping"], _DIGITS) if lugre.micro_damping else "none chosen"
    viscous = Number(lugre.viscous_slope, _LUGRE["viscous_slope"], _DIGITS)
    rows.append(["LuGre, tracking", stiffness, coulomb, damping, viscous, *_errors(report.lugre.error)])
    at_once = words(Number(report.curve.at_once, TORQUE, _DIGITS))
    dry = words(Number(lugre.dry_torque, _LUGRE["dry_torque"], _DIGITS))
    note = (
        f"With the sign of the speed, as it follows at once, add {at_once} to Dahl and to the elements, {dry} to LuGre."
    )
    return Table("models", "model", ("", "σ0", "M_c", "σ1", "σ2", "largest error", "rms error"), rows, [note])


def _elements(report: ReversalReport) -> Table:
    """The Maxwell-slip elements, by their number."""
    rows: list[Sequence[Cell]] = []
    for fit in report.slip_elements:
        work = Share(fit.work_error, bar=False) if fit.loops else None
        for number, element in enumerate(fit.elements):
            names = ("stiffness", "slip_torque", "slip_angle")
            numbers = [Number(getattr(element, name), _ELEMENT[name], _DIGITS) for name in names]
            errors: list[Cell] = ["", "", ""] if number else [*_errors(fit.error), work]
            rows.append(["" if number else f"{len(fit.elements)} elements", *numbers, *errors])
    headings = ("", "k", "M", "slides from rest at", "largest error", "rms error", "error of work")
    return Table("elements", "Maxwell-slip (GMS)", headings, rows)


def _errors(error: FitError) -> list[Cell]:
    return [Share(error.largest, bar=False), Share(error.rms, bar=False)]


# -- curves ---------------------------------------------------------------------------------------


def _charts(report: ReversalReport) -> Iterator[Chart]:
    """The parts and the models over the angle, which is logarithmic."""
    x, y = Axis("angle of the screw", ANGLE, log=True), Axis("friction torque", TORQUE)
    yield Chart("by mechanism", x, y, [*_parts(report), Level("", 0.0)])
    yield Chart("models fitted to it", x, y, [*_fitted(report), Level("", 0.0)])


def _shown(report: ReversalReport) -> NDArray[np.bool_]:
    """The places of the curve that a logarithmic axis has."""
    return np.asarray(report.reversal.screw_angle, dtype=float) > 0


def _parts(report: ReversalReport) -> Iterator[Curve]:
    shown = _shown(report)
    angle = np.asarray(report.reversal.screw_angle, dtype=float)[shown]
    for name, values in report.reversal.contributions.items():
        torque = np.asarray(values, dtype=float)[shown]
        if np.any(torque):
            yield Curve(PARTS.get(name, name).partition(",")[0], angle, torque, _COLOURS.get(name, "grey"))
    yield Curve("all friction", angle, np.asarray(report.reversal.screw_torque)[shown])


def _fitted(report: ReversalReport) -> Iterator[Curve]:
    shown, curve = _shown(report), report.curve
    angle = np.asarray(curve.screw_angle, dtype=float)[shown]
    yield Curve("computed", angle, np.asarray(report.reversal.screw_torque)[shown])
    if report.dahl_first is not None:
        first = report.dahl_first.model.torque(angle, curve.initial_torque)
        yield Curve("Dahl, first 0.02°", angle, first + curve.at_once, "orange", "dashed")
    tracking = report.dahl.model.torque(angle, curve.initial_torque)
    yield Curve("Dahl and LuGre, tracking", angle, tracking + curve.at_once, "red", "dashed")
    fewest_and_most = {len(fit.elements): fit for fit in (report.slip_elements[0], report.slip_elements[-1])}
    colours: Sequence[Colour] = ("green", "sky")
    for (count, fit), colour in zip(fewest_and_most.items(), colours, strict=False):
        torque = of_elements(fit.elements, curve)[shown] + curve.at_once
        yield Curve(f"{count} Maxwell-slip elements", angle, torque, colour, "dotted")


def _columns(report: ReversalReport) -> Columns:
    """The curve: angle, travel, and the torque with its parts."""
    reversal = report.reversal
    parts = [Column(PARTS.get(name, name), values, TORQUE) for name, values in reversal.contributions.items()]
    return Columns(
        "curve",
        [
            Column("angle of the screw", reversal.screw_angle, ANGLE),
            Column("travel of the nut", reversal.travel, TRAVEL),
            Column("friction torque", reversal.screw_torque, TORQUE),
            *parts,
        ],
    )


def prepare(request: Request) -> Work:
    """The work for an answer; a request is read and checked at once."""
    options, case = request.options(ReversalOptions), request.load()

    def answer(_: object) -> Answer:
        report = reversal(case, options)
        return Answer(sheet(report), lambda: document(report), f"{len(report.reversal.screw_angle)} angles")

    return Work(answer, "reversal")
