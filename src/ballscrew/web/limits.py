"""What one request may cost, known before it is begun; what its body may be stands in ``bodies``.

Each of these takes some seconds at most on two processors: ``benchmarks/serve.py --limits`` measures it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from ballscrew.analyses.uncertainty import NUT_SAMPLES, SAMPLES
from ballscrew.components.nut import OversizeBallNut
from ballscrew.faults import Fault, InputError, raise_if_any
from ballscrew.interfaces import export
from ballscrew.interfaces.config import Case

#: Axes of a sweep, its points, and the values that it returns; a whole nut takes a hundred times as long as a ball.
MOST_AXES, MOST_POINTS, MOST_POINTS_OF_NUT, MOST_RETURNED = 8, 20_000, 2_000, 200_000
#: Samples of a band.
MOST_SAMPLES, MOST_SAMPLES_OF_NUT = 65_536, 1_024
#: Balls that are computed one by one, over all points of a sweep or samples of a band.
MOST_BALLS_IN_ALL = 250_000
#: With more of them at one point, that is no quick work.
MANY_BALLS = 300
#: A ball with four contacts takes as long as so many with two.
_FOUR_CONTACTS = 3


def check_size(vary: Mapping[str, str], outputs: int) -> None:
    """Refuse a sweep that is too large for anything, before its axes are made."""
    points = _points(vary)
    faults: list[Fault] = []
    if len(vary) > MOST_AXES:
        faults.append(Fault("sweep", "too many axes", str(len(vary)), f"{MOST_AXES} at most here"))
    elif points > MOST_POINTS:
        faults.append(_too_many_points(points, MOST_POINTS))
    elif points * outputs > MOST_RETURNED:
        faults.append(Fault("sweep", "too many values", f"{points * outputs:,}", f"{MOST_RETURNED:,} at most here"))
    raise_if_any(faults)


def check_sweep(case: Case, plan: export.Plan) -> None:
    """Refuse a sweep that is too large for its case, before it is computed."""
    points = math.prod(len(values) for values in plan.axes.values())
    faults: list[Fault] = []
    if case.parts is not None and points > MOST_POINTS_OF_NUT:
        faults.append(_too_many_points(points, MOST_POINTS_OF_NUT))
    elif points * balls_of(case) > MOST_BALLS_IN_ALL:
        faults.append(_too_many_points(points, MOST_BALLS_IN_ALL // balls_of(case)))
    elif points * len(plan.columns) > MOST_RETURNED:
        number = f"{points * len(plan.columns):,}"
        faults.append(Fault("sweep", "too many values", number, f"{MOST_RETURNED:,} at most here"))
    raise_if_any(faults)


def samples_of(case: Case, asked: int | None = None) -> int | None:
    """The samples of a band: those asked for, or the usual number, or fewer where its balls are too many.

    Raises :class:`~ballscrew.faults.InputError` where more are asked for than are computed here.
    """
    most = _most_samples(case)
    if asked is None:
        return most if _usual_samples(case) > most else None
    if asked > most:
        raise InputError(Fault("--samples", "too many", f"{asked:,}", f"{most:,} at most here"))
    return asked


def _usual_samples(case: Case) -> int:
    return SAMPLES if case.parts is None else NUT_SAMPLES


def _most_samples(case: Case) -> int:
    if case.parts is None:
        return MOST_SAMPLES
    return min(MOST_SAMPLES_OF_NUT, MOST_BALLS_IN_ALL // max(1, balls_of(case)))


def balls_of(case: Case) -> int:
    """The balls that are computed one by one, by the time they take; none where all are alike."""
    parts = case.parts
    if parts is None or not parts.one_by_one:
        return 0
    each = _FOUR_CONTACTS if isinstance(parts.nut, OversizeBallNut) else parts.halves
    return int(case.screw.loaded_balls) * each


def _points(vary: Mapping[str, str]) -> int:
    """The points of a grid; an axis of no values at all is refused with better words later."""
    return math.prod(max(1, export.length_of(text)) for text in list(vary.values())[: MOST_AXES + 1])


def _too_many_points(points: int, most: int) -> Fault:
    return Fault("sweep", "too many points", f"{points:,}", f"{most:,} at most here; the rest by ballscrew sweep")
