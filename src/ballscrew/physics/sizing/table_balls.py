"""Balls of a table that prints none: of those that are made, the ones that go with the ratings of all its rows."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.quantities import Length
from ballscrew.physics.equations import geometry
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.physics.sizing.own_nut import BALLS_PER_DIAMETER, BY_RATING, BY_RULE, CONFORMITIES
from ballscrew.physics.sizing.ratings import RatedGeometry, ratings_of

_Numbers: TypeAlias = NDArray[np.float64]

#: Balls that are made: of multiples of 1/32 in. (below 2 mm of 1/64 in.), and of half millimetres, m.
_INCHES = 0.0254 * np.array([1 / 32, 3 / 64, 1 / 16, 5 / 64, *np.arange(3, 32) / 32])
_MILLIMETRES = 1e-3 * np.array([0.8, 1.0, 1.2, *np.arange(1.5, 10.5, 0.5), *np.arange(11.0, 21.0)])
BALLS: _Numbers = np.concatenate([_INCHES, _MILLIMETRES])
_IS_INCH = np.arange(BALLS.size) < _INCHES.size
#: What the rows of a maker have in common: the logarithm of their ratings over those of ISO 3408-5, and turns of a nut
#: that carry no load.
_FACTORS = np.arange(-0.30, 0.20, 0.005)
_IDLE_TURNS = np.array([0.0, 0.12, 0.24, 0.36, 0.5])
#: Scatter of the logarithm of the ratings of one maker about that; the most that a row can cost, in squares of it.
_SCATTER, _MOST = 0.008, 9.0
#: What another size of balls costs, and one of the system, inch or metric, that the others are not of.
_OF_SIZE, _OF_SYSTEM = 6.0, 3.0
#: Grooves of a table that tell, at least, where all print their root diameter and where not.
_LEAST_GROOVES = {True: 8, False: 20}
#: How much dearer every other choice of balls must be, another one being that of other balls in so many of the grooves;
#: and the share of the grooves that the choice must fit.
_MARGIN, _OTHER, _FITS = 15.0, 0.2, 0.75
#: Choices that are looked at in full.
_LOOKED_AT = 40
#: Balls over the distance of neighbouring grooves, at most: rows that print theirs have up to 0.7.
_OF_PITCH = 0.72
#: Rounding of a root diameter that is printed, and balls that are the same.
_PRINTED, _SAME = 0.05e-3, 0.012

#: Where such an estimate is from.
BY_TABLE = (
    "the ball that is made, of as few sizes as go with all load ratings of the table, which have one factor over ISO "
    "3408-5: within 1 % on all 38 rows that it tells of 44 of two makers"
)


@dataclasses.dataclass(frozen=True)
class _Choice:
    """Balls of a table for one factor and so many idle turns."""

    cost: float
    #: The place in :data:`BALLS` of each groove, and what it costs there.
    balls: NDArray[np.intp]
    costs: _Numbers


def with_table_balls(rows: Sequence[CatalogueRow]) -> list[CatalogueRow]:
    """The rows with the balls of their table in place of those estimated row by row, where the table tells.

    Rows of one make and one kind of nut have a factor in common; those of one diameter, lead and pitch circle have one
    groove, in nuts of all kinds. Chosen are balls, factor and idle turns that cost least: squares of the residuals of
    the logarithms of the ratings, and each size of balls. Rows that print their ball help. Root diameters bound the
    balls where all rows print them, unless the ratings say otherwise: makers differ in what they call root.
    """
    kinds: dict[tuple[str, str], dict[tuple[Any, ...], list[CatalogueRow]]] = {}
    for row in rows:
        if row.dynamic_load_rating is not None:
            kinds.setdefault((row.make, row.nut), {}).setdefault(_groove(row), []).append(row)
    told: dict[tuple[Any, ...], Length] = {}
    for grooves in sorted(kinds.values(), key=len, reverse=True):
        if any(_is_estimated(row) for groove in grooves.values() for row in groove):
            balls = zip(grooves, _balls([*grooves.values()]), strict=False)
            told = {groove: ball for groove, ball in balls if np.isfinite(ball)} | told
    return [
        dataclasses.replace(row, ball_diameter=ball, ball_diameter_source=BY_TABLE)
        if _is_estimated(row) and (ball := told.get(_groove(row)))
        else row
        for row in rows
    ]


def _groove(row: CatalogueRow) -> tuple[Any, ...]:
    """What rows of one groove have in common: make, diameter, lead, pitch circle and starts."""
    sizes = (row.nominal_diameter, row.lead, row.ball_circle, row.starts)
    return row.make, *(round(float(size), 6) for size in sizes)


def _is_estimated(row: CatalogueRow) -> bool:
    return row.ball_diameter_source in (BY_RATING, BY_RULE)


def _balls(grooves: Sequence[Sequence[CatalogueRow]]) -> Sequence[Length]:
    """The ball of each groove, NaN of one whose rows do not fit; none where the table does not tell."""
    rows = np.array([len(groove) for groove in grooves])
    for by_root, least in _LEAST_GROOVES.items():
        if len(grooves) < least or (by_root and any(row.root_diameter is None for groove in grooves for row in groove)):
            continue
        choice = _choice(np.stack([_costs(groove, by_root=by_root) for groove in grooves]), rows)
        if choice is not None:
            return np.where(choice.costs < rows * _MOST / 2, BALLS[choice.balls], np.nan).tolist()
    return []


def _costs(rows: Sequence[CatalogueRow], *, by_root: bool) -> _Numbers:
    """What each ball costs the rows of one groove, by ball, idle turns and factor; infinite for one that cannot be."""
    row = rows[0]
    low, high = (share * row.nominal_diameter for share in BALLS_PER_DIAMETER)
    may_be = (low <= BALLS) & (min(high, _OF_PITCH * row.lead / row.starts) >= BALLS)
    costs = np.zeros((BALLS.size, _IDLE_TURNS.size, _FACTORS.size))
    for each in rows:
        if not _is_estimated(each):
            may_be &= np.abs(BALLS / each.ball_diameter - 1) < _SAME
        in_a_turn = np.floor(np.pi * each.ball_circle / BALLS / np.cos(each.lead_angle))[:, None]
        shape = (each.ball_circle, BALLS[:, None], each.contact_angle, each.lead_angle, in_a_turn)
        rated: Any = RatedGeometry(*shape, each.turns - _IDLE_TURNS, bool(each.spacer_balls))
        with np.errstate(invalid="ignore"):
            over = np.log(each.dynamic_load_rating / ratings_of(rated).dynamic)[..., None] - _FACTORS
        # beyond the most, the nearer ball is still the better one
        costs += np.minimum((over / _SCATTER) ** 2, _MOST) + 1e-3 * np.abs(over) / _SCATTER
        if by_root:
            root: Any = each.root_diameter
            deep, flat = (
                np.asarray(geometry.groove_root_diameter(each.ball_circle, BALLS, share, each.contact_angle))
                for share in CONFORMITIES[::-1]
            )
            fits = (deep - _PRINTED <= root) & (root <= flat + _PRINTED)
            costs[~fits] += 2 * _MOST
    return np.where((may_be[:, None, None]) & np.isfinite(costs), costs, np.inf)


def _choice(costs: _Numbers, rows: NDArray[np.intp]) -> _Choice | None:
    """The cheapest choice of balls, where it fits and all others are dearer."""
    by_groove = costs.min(axis=1)
    least = np.where(_fits(by_groove, rows) >= _FITS, by_groove.sum(axis=0), np.inf)
    choices = [
        _sizes(costs[:, :, *place], np.where(is_cheap, _OF_SIZE, _OF_SIZE + _OF_SYSTEM))
        for place in (np.unravel_index(place, least.shape) for place in np.argsort(least, axis=None)[:_LOOKED_AT])
        if np.isfinite(least[place])
        for is_cheap in (_IS_INCH, ~_IS_INCH)
    ]
    if not choices:
        return None
    best = min(choices, key=lambda choice: choice.cost)
    others = [
        choice.cost
        for choice in choices
        if np.mean(np.abs(BALLS[choice.balls] / BALLS[best.balls] - 1) > _SAME) >= _OTHER
    ]
    tells = min(others, default=np.inf) - best.cost >= _MARGIN and _fits(best.costs, rows) >= _FITS
    return best if tells else None


def _fits(costs: _Numbers, rows: NDArray[np.intp]) -> Any:
    """The share of the grooves whose rows a choice fits, by their ``costs`` along the first axis."""
    return np.mean(costs < rows.reshape(-1, *[1] * (costs.ndim - 1)) * _MOST / 2, axis=0)


def _sizes(costs: _Numbers, of_sizes: _Numbers) -> _Choice:
    """The balls of each groove, of as few sizes as pay: one size after the other is left out while it costs more."""
    sizes = sorted(set(costs.argmin(axis=1).tolist()))

    def cost(of: Sequence[int]) -> float:
        return float(costs[:, of].min(axis=1).sum() + of_sizes[of].sum())

    total = cost(sizes)
    while len(sizes) > 1:
        fewer = min(([size for size in sizes if size != left] for left in sizes), key=cost)
        if cost(fewer) >= total:
            break
        sizes, total = fewer, cost(fewer)
    place = costs[:, sizes].argmin(axis=1)
    balls = np.array(sizes)[place]
    return _Choice(total, balls, costs[np.arange(len(balls)), balls])
