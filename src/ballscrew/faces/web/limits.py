"""Limits on the cost of a request, checked before its work starts; limits on its body are in ``bodies``.

Each of these takes some seconds at most on two processors: ``benchmarks/serve.py --limits`` measures it.
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Mapping, Sequence
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.cases.case_files.case_file import (
    Case,
)
from ballscrew.cases.case_files.uncertain_inputs import all_of
from ballscrew.engine.uncertainty.bands import NUT_SAMPLES, SAMPLES
from ballscrew.engine.uncertainty.sensitivity import NUT_SAMPLES as NUT_SAMPLES_OF_METHOD
from ballscrew.engine.uncertainty.sensitivity import SAMPLES as SAMPLES_OF_METHOD
from ballscrew.physics.components.nut import OversizeBallNut
from ballscrew.physics.moving_balls.reversal import STROKES, step_count
from ballscrew.physics.moving_balls.ripple import NutGroove, Spall
from ballscrew.questions.optimise.compute import Plan
from ballscrew.questions.optimise.options import OptimiseOptions
from ballscrew.questions.reversal.options import ReversalOptions
from ballscrew.questions.ripple import compute as ripples
from ballscrew.questions.ripple.options import RippleOptions
from ballscrew.questions.select.need import Need
from ballscrew.questions.sensitivity.options import SensitivityOptions
from ballscrew.questions.sweep import compute as sweeps
from ballscrew.questions.sweep.band import INNER

#: Axes and points of a sweep, and the values that it returns; a nut takes a hundred times as long as one ball.
MOST_AXES, MOST_POINTS, MOST_POINTS_OF_NUT, MOST_RETURNED = 8, 20_000, 2_000, 200_000
#: Samples of a band.
MOST_SAMPLES, MOST_SAMPLES_OF_NUT = 65_536, 1_024
#: Samples of all points of a sweep together, and the fewest of a point that make a band.
MOST_SAMPLES_OF_SWEEP, FEWEST_SAMPLES = 2**20, 32
#: Balls that are computed one by one, in all points of a sweep or samples of a band.
MOST_BALLS_IN_ALL = 250_000
#: States of a duty times balls that are computed one by one: its friction is mapped at 312 temperatures and preloads.
MOST_BALLS_TO_WARM, MOST_TRANSIENTS = 10_000, 1_024
#: Points of a sweep of a tenth of a second, and balls in all of them that are computed one by one.
SHORT_POINTS, SHORT_POINTS_OF_NUT, SHORT_BALLS = 1_000, 200, 5_000
#: With more balls than this, a single point is heavy work.
MANY_BALLS = 300
#: Combinations of nut, preload and oil for each row of the catalogue.
MOST_CHOICES = 24
#: Steps of the contacts of a reversal.
MOST_STEPS_OF_REVERSAL = 20_000
#: Nuts of a ripple: as it is, with faults, with other grooves; balls of one and of all, in the return too, in 12 turns.
MOST_NUTS_OF_RIPPLE, MOST_BALLS_OF_RIPPLE, MOST_BALLS_OF_RIPPLES = 8, 250, 1_000
#: Deviation of grooves, and depth of a spall, m: balls that part and meet very often have no end.
MOST_DEVIATION = 1e-4
#: Samples of all inputs of a sensitivity times balls that are computed one by one.
MOST_BALLS_OF_SENSITIVITY = 4_000_000
#: Designs of a generation, and samples of a quantile; seconds of a processor that a search may take by its plan.
MOST_IN_A_GENERATION, MOST_SECONDS_OF_SEARCH = 1_000, 120
#: Columns of a log, and the lines at its top in which they are counted.
MOST_COLUMNS, _FIRST_LINES = 1_000, 5_000
#: Parameters, outputs and derivatives of a hand-over besides the usual ones.
MOST_MORE = 8
#: Balls with two contacts that take as long as one with four.
_FOUR_CONTACTS = 3
#: Values of an output with the ends of its band and of the intervals within it.
_WITH_ENDS = 3 + 2 * len(INNER)


def check_size(vary: Mapping[str, str], outputs: int, *, banded: bool = False) -> None:
    """Refuse a sweep that is too large for any case, before its axes are made."""
    points = _points(vary)
    values = points * outputs * (_WITH_ENDS if banded else 1)
    faults: list[Fault] = []
    if len(vary) > MOST_AXES:
        faults.append(
            Fault(
                "sweep",
                "too many axes",
                str(len(vary)),
                f"{MOST_AXES} at most here",
            )
        )
    elif points > MOST_POINTS:
        faults.append(_too_many_points(points, MOST_POINTS))
    elif values > MOST_RETURNED:
        faults.append(
            Fault(
                "sweep",
                "too many values",
                f"{values:,}",
                f"{units.grouped(MOST_RETURNED)} at most here",
            )
        )
    raise_if_any(faults)


def check_sweep(case: Case, plan: sweeps.Plan) -> None:
    """Refuse a sweep that is too large for its case, before it is computed."""
    points = math.prod(len(values) for values in plan.axes.values())
    faults: list[Fault] = []
    if case.nut is not None and points > MOST_POINTS_OF_NUT:
        faults.append(_too_many_points(points, MOST_POINTS_OF_NUT))
    elif points * balls_of(case) > MOST_BALLS_IN_ALL:
        faults.append(_too_many_points(points, MOST_BALLS_IN_ALL // balls_of(case)))
    elif points * len(plan.columns) > MOST_RETURNED:
        number = f"{points * len(plan.columns):,}"
        faults.append(
            Fault(
                "sweep",
                "too many values",
                number,
                f"{units.grouped(MOST_RETURNED)} at most here",
            )
        )
    raise_if_any(faults)


def check_motion(case: Case) -> None:
    """Refuse a motion of too many states for its balls, before it is computed."""
    balls = balls_of(case)
    if case.motion is None or not balls:
        return
    states = len(case.motion.states().time)
    if states * balls > MOST_BALLS_IN_ALL:
        remedy = "fewer segments, or a nut whose balls are alike; the rest by ballscrew duty"
        raise InputError(Fault("motion", "has too many states to compute ball by ball", f"{states:,}", remedy))


def check_warm_up(case: Case, samples: int | None) -> None:
    """Refuse what takes long to warm up: a map of friction of too many states, and bands of too many samples."""
    faults: list[Fault] = []
    states = 1 if case.motion is None else len(case.motion.states().time)
    if states * max(1, balls_of(case)) > MOST_BALLS_TO_WARM:
        remedy = "fewer segments, or a nut whose balls are alike; the rest by ballscrew warm-up"
        faults.append(Fault("motion", "has too many states to map their friction", f"{states:,}", remedy))
    if samples is not None and samples > MOST_TRANSIENTS:
        remedy = f"{units.grouped(MOST_TRANSIENTS)} at most here; the rest by ballscrew warm-up"
        faults.append(Fault("--samples", "too many", f"{samples:,}", remedy))
    raise_if_any(faults)


def check_reversal(case: Case, options: ReversalOptions) -> None:
    """Refuse a reversal that its contacts take too many steps for; a screw at rest is refused by the question."""
    if not case.operation.screw_speed:
        return
    steps = step_count(
        case.model,
        case.screw,
        case.lubricant,
        axial_load=case.operation.axial_load,
        screw_speed=float(case.operation.screw_speed),
        travel=options.travel,
        gap=options.gap,
        strokes=STROKES,
    )
    if steps > MOST_STEPS_OF_REVERSAL:
        remedy = "a shorter travel, or more load or preload; the rest by ballscrew reversal"
        raise InputError(Fault("--travel", "takes too many steps of the contacts", f"{steps:,}", remedy))


def check_ripple(case: Case, options: RippleOptions) -> None:
    """Refuse a ripple of too many nuts, balls or turns; numbers that are none are refused by the question."""
    faults = len(ripples.ALL) + len(options.fault) if "all" in options.fault else len(options.fault)
    nuts = faults + max(1, options.seeds)
    if nuts > MOST_NUTS_OF_RIPPLE:
        remedy = f"{MOST_NUTS_OF_RIPPLE} at most here with faults and seeds; the rest by ballscrew ripple"
        raise InputError(Fault("--seeds", "takes too many nuts", f"{nuts:,}", remedy))
    given = ripples.given_of(case, options)
    for name in options.fault:
        for defect in () if name == "all" else ripples.defects_of([name]).values():
            if isinstance(defect, Spall) and defect.depth > MOST_DEVIATION:
                raise InputError(_too_deep("--fault"))
            if isinstance(defect, NutGroove) and defect.factor * given["groove_deviation"] > MOST_DEVIATION:
                raise InputError(_too_deep("--fault"))
    if given["groove_deviation"] > MOST_DEVIATION:
        raise InputError(_too_deep("--groove-deviation"))
    each = max(0, given["return_balls"]) + max(0.0, given["gap"])
    balls = float(case.screw.loaded_balls) + max(0, given["circuits"]) * each
    balls *= max(1.0, options.turns / RippleOptions.turns)
    if not (balls <= MOST_BALLS_OF_RIPPLE and nuts * balls <= MOST_BALLS_OF_RIPPLES):
        remedy = "fewer faults, seeds, turns or places for balls; the rest by ballscrew ripple"
        raise InputError(Fault("--turns", "takes too many balls", f"{nuts * balls:,.0f}", remedy))


def _too_deep(where: str) -> Fault:
    return Fault(where, "deviates too far", "", "100 um at most here; the rest by ballscrew ripple")


def check_need(need: Need) -> Need:
    """The need, unless it has more choices for each row than are computed here."""
    choices = max(1, len(need.nuts)) * max(1, len(need.preloads)) * len(need.oils)
    if choices > MOST_CHOICES:
        remedy = f"{MOST_CHOICES} at most here; the rest by ballscrew select"
        raise InputError(Fault("need", "has too many choices of nut, preload and oil", str(choices), remedy))
    return need


def samples_of_sensitivity(case: Case, options: SensitivityOptions) -> int | None:
    """The samples of a sensitivity: the requested number, or the default, or fewer where its balls are too many.

    A method whose number or name is none is refused by the question. Raises
    :class:`~ballscrew.basis.errors.InputError` where more are requested than are computed here.
    """
    known: Mapping[str, int] = {**(NUT_SAMPLES_OF_METHOD if case.screw.nut.one_by_one else SAMPLES_OF_METHOD)}
    usual = known.get(options.method)
    if usual is None:  # no method, or one without samples
        return options.samples
    sets = len(all_of(case, options.only_given)) + 2
    balls = balls_of(case)
    total = MOST_BALLS_OF_SENSITIVITY // balls if balls else MOST_SAMPLES_OF_SWEEP
    most = 2 ** int(math.log2(max(1, total // sets)))
    if options.samples is not None and options.samples > most:
        remedy = f"{units.grouped(most)} at most here; the rest by ballscrew sensitivity"
        raise InputError(Fault("--samples", "too many", f"{options.samples:,}", remedy))
    return options.samples or (most if usual > most else None)


def check_search(need: Need, options: OptimiseOptions) -> None:
    """Refuse a search whose generations are too large for the memory, before its space is made."""
    asked: Mapping[str, int | None] = {"population": options.population, "samples": None}
    for name, given in asked.items():
        value: Any = need.optimise.get(name) if given is None else given
        with contextlib.suppress(TypeError, ValueError):  # what is no number is refused where it is read
            value = float(value)  # a file may have a number as a text
        if isinstance(value, int | float) and value > MOST_IN_A_GENERATION:
            most = units.grouped(MOST_IN_A_GENERATION)
            remedy = f"{most} at most here; the rest by ballscrew optimise"
            raise InputError(Fault(f"optimise.{name}", "too many", f"{value:,.0f}", remedy))


def check_plan(plan: Plan) -> None:
    """Refuse a search that takes long by its plan."""
    if plan.seconds > MOST_SECONDS_OF_SEARCH:
        remedy = (
            f"{MOST_SECONDS_OF_SEARCH} s at most here: fewer designs, generations or members; the rest by "
            "ballscrew optimise"
        )
        raise InputError(Fault("optimise", "takes too many seconds of a processor", f"{plan.seconds:,.0f}", remedy))


def check_columns(name: str, content: bytes) -> None:
    """Refuse a log of very many columns, each of which would be looked up among the names that are known."""
    widest = max((line.count(mark) for line in content.splitlines()[:_FIRST_LINES] for mark in b";\t,"), default=0)
    if widest >= MOST_COLUMNS:
        raise InputError(
            Fault(
                name,
                "has too many columns",
                f"{widest + 1:,}",
                f"{units.grouped(MOST_COLUMNS)} at most here",
            )
        )


def check_hand_over(case: Case, *lists: Sequence[str]) -> Case:
    """The case, unless more inputs, outputs or derivatives are asked for than are made here."""
    asked = sum(map(len, lists))
    if asked > MOST_MORE:
        remedy = f"{MOST_MORE} at most here; the rest by ballscrew hand-over"
        raise InputError(Fault("hand_over", "has too many parameters, outputs and derivatives", str(asked), remedy))
    return case


def is_short(case: Case, plan: sweeps.Plan) -> bool:
    """Test whether a sweep takes about a tenth of a second at most, such as those of the page without bands."""
    if plan.banded:
        return False
    points = math.prod(len(values) for values in plan.axes.values())
    most = SHORT_POINTS if case.nut is None else SHORT_POINTS_OF_NUT
    return points <= most and points * balls_of(case) <= SHORT_BALLS


def samples_of(case: Case, requested: int | None = None) -> int | None:
    """The samples of a band: the requested number, or the default, or fewer where its balls are too many.

    Raises :class:`~ballscrew.basis.errors.InputError` where more are requested than are computed here.
    """
    most = _most_samples(case)
    if requested is None:
        return most if _default_samples(case) > most else None
    if requested > most:
        raise InputError(Fault("--samples", "too many", f"{requested:,}", f"{units.grouped(most)} at most here"))
    return requested


def samples_of_sweep(case: Case, plan: sweeps.Plan, requested: int | None = None) -> int:
    """The samples of each point of a sweep with a band: the requested number, or the default, or fewer of many points.

    Fewer are a power of two. Raises :class:`~ballscrew.basis.errors.InputError` where more are requested than are
    computed here, and for more points than there are samples for.
    """
    points = math.prod(len(values) for values in plan.axes.values())
    total = MOST_BALLS_IN_ALL // balls_of(case) if balls_of(case) else MOST_SAMPLES_OF_SWEEP
    most = total // points
    if most < FEWEST_SAMPLES:
        raise InputError(_too_many_points(points, total // FEWEST_SAMPLES))
    if requested is not None and requested > most:
        raise InputError(Fault("--samples", "too many", f"{requested:,}", f"{units.grouped(most)} at most here"))
    usual = NUT_SAMPLES if case.screw.nut.one_by_one else SAMPLES
    return requested or min(usual, 2 ** int(math.log2(most)))


def _default_samples(case: Case) -> int:
    return SAMPLES if case.nut is None else NUT_SAMPLES


def _most_samples(case: Case) -> int:
    if case.nut is None:
        return MOST_SAMPLES
    return min(MOST_SAMPLES_OF_NUT, MOST_BALLS_IN_ALL // max(1, balls_of(case)))


def balls_of(case: Case) -> int:
    """The number of balls that are computed one by one, weighted by their time; zero where all balls are equal."""
    nut = case.screw.nut
    if not nut.one_by_one:
        return 0
    each = _FOUR_CONTACTS if isinstance(nut, OversizeBallNut) else nut.halves
    return int(case.screw.carrying_balls) * each


def _points(vary: Mapping[str, str]) -> int:
    """The points of a grid; an axis without values is refused later, with its own message."""
    return math.prod(max(1, sweeps.length_of(text)) for text in list(vary.values())[: MOST_AXES + 1])


def _too_many_points(points: int, most: int) -> Fault:
    return Fault(
        "sweep",
        "too many points",
        f"{points:,}",
        f"{units.grouped(most)} at most here; the rest by ballscrew sweep",
    )
