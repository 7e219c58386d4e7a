"""A nut from the few numbers that a catalogue prints: the row that they make, what is estimated in it, and how well.

Where both load ratings are printed, the balls are those with which a maker of the catalogue shipped would state both.
Balls of a table of another maker: of those that are made, the ones that go with the ratings of all its rows.
"""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import Fault, InputError, accepts_units
from ballscrew.basis.quantities import (
    Angle,
    Count,
    Force,
    Length,
    Quantity,
    Ratio,
    Stiffness,
    Torque,
    fields_of,
    quantities_of,
)
from ballscrew.basis.records import Record
from ballscrew.basis.usual_ranges import IMPLAUSIBLE
from ballscrew.physics.components.screw import RATING_CONFORMITY, BallScrew
from ballscrew.physics.equations import geometry
from ballscrew.physics.laws.nut_losses import Seals, seal_table
from ballscrew.physics.sizing.catalogue import (
    CONFORMITY_DOUBT,
    SMALLEST_BALL,
    TURNS_WITHOUT_LOAD,
    CatalogueRow,
    catalogue,
)
from ballscrew.physics.sizing.ratings import RatedGeometry, Ratings, ratings_of
from ballscrew.physics.solvers.swelling import ball_of_rating

#: The rule of the ball diameter without a load rating: its factor, its exponent, and the lead over the diameter from
#: which on the ball grows no more. Least squares of the logarithms over the 44 rows shipped.
RULE_FACTOR, RULE_EXPONENT, LARGEST_PITCH = 0.146, 0.85, 0.25
#: True ball diameter over that by the rule: those of 44 rows, each by the rows of other sizes, and of 31 stocked nuts.
RULE_BAND = (0.69, 1.66)
#: True ball diameter over that of the rating: of the same 44 rows and 31 nuts, none of which it is fitted to.
RATED_BAND = (0.92, 1.24)
#: The same of balls below SMALL_BALL, whose ratings are lower than the formula has them.
SMALL_BAND, SMALL_BALL = (0.92, 1.39), 2.3e-3
#: Dynamic load rating as listed over that by the geometry, of the same rows and nuts.
RATING_RATIOS = (0.65, 1.13)
#: The same of the static load rating: makers have criteria of their own.
STATIC_RATIOS = (0.6, 1.1)
#: Torque of the seals over that of the vendor's nut of the next diameter: makers differ, by less than a slip of ten.
SEAL_RATIO = 5.0
#: Balls that a nut may have, over its nominal diameter and over the distance of neighbouring grooves.
BALLS_PER_DIAMETER, BALLS_PER_PITCH = (0.04, 0.26), 0.8
#: Conformities that makers are known to grind.
CONFORMITIES = (0.51, 0.58)
#: Pitch circle over nominal diameter, of rows that list both.
PITCH_CIRCLES = (1.0, 1.05)
#: Turns that carry load over those listed, at least: nuts of 2.5 turns a circuit have ratings as if 0.57 did not.
LEAST_LOADED = 0.77
#: Usual contact angles, rad.
ANGLES = (math.radians(40), math.radians(50))

#: The load ratings of a row.
RATED = ("dynamic_load_rating", "static_load_rating")
#: Decimals of a length in metres, and of a conformity, that an estimate is written with.
_WHOLE_MICROMETRES, _DIGITS = 6, 4

#: Where each estimate is from.
BY_RATING = (
    "the ball whose dynamic load rating by ISO 3408-5 is the one listed: within -8 and +24 % on 75 rows of "
    "catalogues, balls below 2.3 mm within +39 %"
)
BY_RULE = (
    "from lead and diameter alone, a rule of 44 rows of catalogues: each is within -31 and +66 % of the rule of "
    "the others; give the ball diameter or the dynamic load rating"
)
BY_NOMINAL = "as large as the nominal diameter; those that catalogues list are mostly 1.5 to 5 % larger"
BY_BALL = "as much larger than the nominal diameter as with such balls of this maker"
BY_ROOT = "from the diameter at the bottom of the groove, good to about 0.01"
BY_DEFAULT = "most root diameters of a catalogue imply 0.54, some 0.56; good to about 0.01"
BY_HABIT = "the usual value; no catalogue consulted prints it"
BY_SURFACE = "balls have 0.02 to 0.1 um; the usual one stands for what no catalogue prints"
BY_GRINDING = "ground races have 0.2 to 0.4 um, rolled ones more; no catalogue consulted prints it"


#: What may be estimated: quantities of a row, and of the screw that it makes.
QUANTITIES: Mapping[str, Quantity] = {**fields_of(BallScrew), **quantities_of(CatalogueRow)}
_SEALS = fields_of(Seals)["seal_torque"]
#: Roughnesses, with their bands as shares, which are those of ``data/uncertainties.toml``.
_ROUGHNESSES: Mapping[str, tuple[tuple[float, float], str]] = {
    "ball_roughness": ((1 / 3, 3.0), BY_SURFACE),
    "screw_roughness": ((1 / 1.5, 1.5), BY_GRINDING),
    "nut_roughness": ((1 / 1.5, 1.5), BY_GRINDING),
}


@dataclasses.dataclass(frozen=True)
class Estimate:
    """A number that the catalogue does not print: its field, its value and band in SI, and where it is from."""

    #: A field of the row or of the screw that it makes: ``ball_diameter``, ``loaded_balls``.
    name: str
    value: float
    #: Ends of the band that holds the rows of catalogues it was held against.
    low: float
    high: float
    source: str

    @property
    def quantity(self) -> Quantity:
        """Quantity of this name, with its unit."""
        return QUANTITIES[self.name]


@dataclasses.dataclass(frozen=True, eq=False)
class OwnNut(ByValue):
    """A complete row, what was estimated in it, and what does not go together in the numbers given."""

    #: The row, which makes a screw as one of the catalogue does.
    row: CatalogueRow
    #: Numbers that the catalogue does not print, each with its band and where it is from.
    estimates: tuple[Estimate, ...]
    #: Numbers given that do not go together, with the value and what to do.
    warnings: tuple[Record, ...]


@accepts_units("own_nut")
def own_nut(
    *,
    nominal_diameter: Length,
    lead: Length,
    turns: Ratio,
    ball_diameter: Length | None = None,
    dynamic_load_rating: Force | None = None,
    static_load_rating: Force | None = None,
    starts: Count | None = None,
    pitch_circle_diameter: Length | None = None,
    root_diameter: Length | None = None,
    contact_angle: Angle | None = None,
    conformity: Ratio | None = None,
    rigidity: Stiffness | None = None,
    nut_outer_diameter: Length | None = None,
    nut: str = "",
    preload: Force | None = None,
    preload_share: Ratio | None = None,
    seal_torque: Torque | None = None,
    spacer_balls: bool | None = None,
    name: str = "own nut",
    source: str = "",
    make: str = "",
) -> OwnNut:
    """A nut of one's own from the few numbers that its catalogue prints.

    Needed are ``nominal_diameter`` (m), ``lead`` (m) and ``turns``, those of one nut body, all circuits together: 2.5
    turns in two circuits are 5. Of the others, each may be left out: ``ball_diameter`` (m), ``dynamic_load_rating`` and
    ``static_load_rating`` (N), ``starts`` of the thread, ``pitch_circle_diameter`` and ``root_diameter`` (m),
    ``contact_angle`` (rad), ``conformity`` (groove radius over ball diameter), ``rigidity`` as listed (N/m),
    ``nut_outer_diameter`` (m), ``nut``, how the nut is braced (``single``, ``oversize-balls``, ``double``,
    ``offset-lead``), ``preload`` (N) or ``preload_share`` of the dynamic load rating, ``seal_torque`` (N m),
    ``spacer_balls``, whether every second ball is one. ``name``, ``source`` and ``make`` are texts of the row.

    The ball diameter is that whose rating by ISO 3408-5 is the dynamic load rating listed, else follows from lead and
    diameter (:data:`BY_RATING`, :data:`BY_RULE`); the conformity follows from the root diameter where ball and pitch
    circle are listed. It does not follow from the rating: makers rate all their grooves with one conformity, 0.52.
    Returns an :class:`OwnNut`: ``row`` makes a screw with ``row.screw()``, ``estimates`` have bands. Raises
    :class:`~ballscrew.basis.errors.InputError` for numbers out of bounds.
    """
    given = dict(locals())
    return completed({name: value for name, value in given.items() if value is not None})


def completed(listed: Mapping[str, Any]) -> OwnNut:
    """The nut of the fields of a :class:`CatalogueRow` that are listed, SI; see :func:`own_nut`.

    ``listed`` has a ``name``, the nominal diameter, the lead and the turns at least. Raises
    :class:`~ballscrew.basis.errors.InputError` for numbers out of bounds.
    """
    estimates: list[Estimate] = []
    warnings: list[Record] = []
    fields: dict[str, Any] = dict(listed)
    if "ball_diameter" not in fields:
        start = _of_any_ball(fields)
        as_of_make = ball_of_make(start, _makes_shipped())
        ball, odd = _ball(start) if as_of_make is None else (as_of_make.ball, [])
        fields |= {"ball_diameter": ball.value, "ball_diameter_source": ball.source}
        if as_of_make is not None:
            fields = {**as_of_make.fields, **fields}
        estimates.append(ball)
        warnings += odd
    row = CatalogueRow(**fields)
    row.screw()  # raises for faults between the numbers, as of a ball that is too big for the lead
    if "ball_diameter" in listed:
        warnings += odd_ratings(
            {name: value for name in RATED if (value := getattr(row, name)) is not None}, ratings_of(row)
        )
    if listed.get("pitch_circle_diameter") is None:
        low, high = (share * row.nominal_diameter for share in PITCH_CIRCLES)
        source = BY_NOMINAL if row.pitch_circle_diameter is None else BY_BALL
        value = row.ball_circle
        estimates.append(Estimate("ball_circle", value, min(low, value), max(high, value), source))
    if "conformity" not in fields:
        conformity, odd = _conformity(row, is_listed={"ball_diameter", "root_diameter"} <= listed.keys())
        row = dataclasses.replace(row, conformity=conformity.value)
        estimates.append(conformity)
        warnings += odd
    if "contact_angle" not in fields:
        estimates.append(Estimate("contact_angle", row.contact_angle, *ANGLES, BY_HABIT))
    estimates.append(_balls(row, next((one for one in estimates if one.name == "ball_diameter"), None)))
    screw = row.screw()
    estimates += [_within(name, getattr(screw, name), *told) for name, told in _ROUGHNESSES.items()]
    return OwnNut(row, tuple(estimates), tuple(warnings))


def _of_any_ball(fields: Mapping[str, Any]) -> CatalogueRow:
    """A row of these fields with some ball, to have the others checked first."""
    diameter = fields["nominal_diameter"]
    try:
        ball = abs(float(diameter)) / 10
    except (TypeError, ValueError):
        ball = 1e-3
    try:
        given: dict[str, Any] = {**fields, "ball_diameter": ball or 1e-3}
        return CatalogueRow(**given)
    except InputError as error:
        # the ball is none of the user's
        own = [fault for fault in error.faults if not fault.where.endswith(".ball_diameter")]
        raise (InputError(*own) if own else error) from None


def _ball(row: CatalogueRow) -> tuple[Estimate, list[Record]]:
    """The ball diameter that goes with the dynamic load rating, else with lead and diameter."""
    pitch = row.lead / row.starts
    by_rule = RULE_FACTOR * row.nominal_diameter
    by_rule *= (min(pitch / row.nominal_diameter, LARGEST_PITCH) / LARGEST_PITCH) ** RULE_EXPONENT
    rule = _within("ball_diameter", round(by_rule, _WHOLE_MICROMETRES), RULE_BAND, BY_RULE)
    if rule.value < SMALLEST_BALL * row.ball_circle:
        raise InputError(_no_room(row, pitch))
    rating = row.dynamic_load_rating
    if rating is None:
        return rule, []
    # of spacers and balls by turns, half carry, with the power of 2/3 of the rating
    of_all = rating * 2 ** (2 / 3) if row.spacer_balls else rating
    result = ball_of_rating(of_all, row.ball_circle, row.lead, row.contact_angle, row.loaded_turns)
    ball = round(result, _WHOLE_MICROMETRES)
    low, high = (share * row.nominal_diameter for share in BALLS_PER_DIAMETER)
    if low <= ball <= min(high, BALLS_PER_PITCH * pitch):
        band = SMALL_BAND if ball < SMALL_BALL else RATED_BAND
        return _within("ball_diameter", ball, band, BY_RATING), []
    listed = units.shown(rating, QUANTITIES["dynamic_load_rating"])
    message = (
        f"dynamic_load_rating {listed} goes with no ball that a nut of this size has; the ball diameter is "
        "estimated from lead and diameter: check the unit of the rating and the turns, or give the ball diameter"
    )
    return rule, [_warning("dynamic_load_rating", rating, message)]


def _no_room(row: CatalogueRow, pitch: float) -> Fault:
    """The fault of a lead or of starts that are listed, in place of one of the ball, which is none of the user's."""
    lead, apart = (f"{size * 1000.0:.4g} mm" for size in (row.lead, pitch))
    name, given = ("starts", str(int(row.starts))) if row.starts > 1 else ("lead", lead)
    remedy = f"neighbouring grooves are {apart} apart: give a larger lead or fewer starts"
    return Fault(f"{row.name}.{name}", "leaves no room for balls", given, remedy)


def _within(name: str, value: float, band: tuple[float, float], source: str) -> Estimate:
    """An estimate whose band is given as shares of it."""
    return Estimate(name, value, band[0] * value, band[1] * value, source)


def odd_ratings(listed: Mapping[str, float], computed: Ratings) -> list[Record]:
    """Warnings of load ratings, as they are listed, that do not go with those by the geometry or with each other."""
    dynamic, static = (listed.get(name) for name in RATED)
    records = [
        *_odd_rating("dynamic_load_rating", dynamic, computed.dynamic, RATING_RATIOS),
        *_odd_rating("static_load_rating", static, computed.static, STATIC_RATIOS),
    ]
    if dynamic is None or static is None or static >= dynamic or records:
        return records
    message = (
        f"static_load_rating {units.shown(static, QUANTITIES['static_load_rating'])} is below the dynamic one, "
        f"{units.shown(dynamic, QUANTITIES['dynamic_load_rating'])}: rows of catalogues have 1.2 to 4.4 times it; "
        "check the two and their units"
    )
    return [_warning("static_load_rating", static, message, dynamic)]


def _odd_rating(name: str, listed: float | None, computed: Force, ratios: tuple[float, float]) -> list[Record]:
    """A warning of a load rating whose ratio to that by the geometry no row of a catalogue has."""
    low, high = ratios
    ratio = math.nan if listed is None else listed / float(computed)
    if listed is None or not math.isfinite(ratio) or low <= ratio <= high:
        return []
    quantity = QUANTITIES[name]
    message = (
        f"{name} {units.shown(listed, quantity)} is {units.number(ratio, 2)} times that by the geometry, "
        f"{units.shown(computed, quantity)}; rows of catalogues have {low:g} to {high:g}: check its unit, the ball "
        "diameter, and that the turns are those of one nut body, all circuits together"
    )
    return [_warning(name, ratio, message, high if ratio > high else low)]


def odd_root(root_diameter: float | None, screw: BallScrew) -> list[Record]:
    """A warning of a diameter at the bottom of the groove that no conformity of a maker has on this screw."""
    if root_diameter is None:
        return []
    sizes = screw.pitch_circle_diameter, screw.ball_diameter
    deepest, highest = (
        float(geometry.groove_root_diameter(*sizes, share, screw.contact_angle)) for share in CONFORMITIES[::-1]
    )
    if deepest <= root_diameter <= highest:
        return []
    listed = units.shown(root_diameter, QUANTITIES["root_diameter"])
    return [
        _warning(
            "root_diameter",
            root_diameter,
            f"root_diameter {listed} is no bottom of a groove for this ball and pitch circle: it would need a "
            "conformity outside 0.51 to 0.58: check its unit, or leave it out",
        )
    ]


def odd_seals(screw: BallScrew) -> list[Record]:
    """A warning of seals whose known torque is far above that of a vendor's seals on about this diameter."""
    torque = getattr(screw.nut.losses.get("seals"), "seal_torque", None)
    if torque is None:
        return []
    row = min(seal_table(), key=lambda row: row.distance(float(screw.pitch_circle_diameter), float(screw.lead)))
    ratio = float(torque) / row.torque
    if not ratio > SEAL_RATIO:
        return []
    diameter = units.shown(row.nominal_diameter, QUANTITIES["nominal_diameter"])
    message = (
        f"torque of the seals {units.shown(torque, _SEALS)} is {units.number(ratio, 2)} times that of a vendor's "
        f"seals on {diameter}, {units.shown(row.torque, _SEALS)}: check the number and its unit"
    )
    return [dataclasses.replace(_warning("", ratio, message, SEAL_RATIO), subject="losses.seals.seal_torque")]


def _conformity(row: CatalogueRow, *, is_listed: bool) -> tuple[Estimate, list[Record]]:
    """The conformity by the root diameter where ball and pitch circle are listed, too; else the usual one."""
    usual = Estimate(
        "conformity", row.conformity, row.conformity - CONFORMITY_DOUBT, row.conformity + CONFORMITY_DOUBT, BY_DEFAULT
    )
    if not is_listed or row.pitch_circle_diameter is None or row.root_diameter is None:
        return usual, []
    if odd := odd_root(row.root_diameter, row.screw()):
        return usual, odd
    low, high = CONFORMITIES
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if _bottom(row, middle) > row.root_diameter else (low, middle)
    result = round(low, _DIGITS)
    return Estimate("conformity", result, result - CONFORMITY_DOUBT, result + CONFORMITY_DOUBT, BY_ROOT), []


def _bottom(row: CatalogueRow, conformity: Ratio) -> Length:
    """Diameter at the bottom of the groove, which falls with the conformity."""
    return float(geometry.groove_root_diameter(row.ball_circle, row.ball_diameter, conformity, row.contact_angle))


def _balls(row: CatalogueRow, ball: Estimate | None) -> Estimate:
    """The loaded balls, with the band of returns and of the ball where it is estimated."""
    most = row.balls_per_turn * row.turns
    low, high = LEAST_LOADED * most, most
    if ball is not None:
        low, high = low * ball.value / ball.high, high * ball.value / ball.low
    source = (
        f"whole balls that find room in a turn, {units.number(row.balls_per_turn)}, times "
        f"{units.number(row.loaded_turns)} of {units.number(row.turns)} turns: "
    )
    if ball is not None and ball.source.startswith(BY_MAKE):
        source += "so many carry load in nuts with such ratings"
    else:
        source += (
            "0.24 turns carry no load, as in nuts with long circuits; nuts with circuits of 2.5 turns are rated as if "
            "they had 23 % fewer balls"
        )
    return Estimate("loaded_balls", row.loaded_balls, min(math.floor(low), row.loaded_balls), math.ceil(high), source)


def _warning(subject: str, value: float, message: str, limit: float | None = None) -> Record:
    return Record.warning(IMPLAUSIBLE, f"screw.{subject}", message, value=value, limit=limit)


_Numbers: TypeAlias = NDArray[np.float64]

#: A row is as a maker has them if it is no farther from its usual ratios, in squares of their scatter; another ball is
#: told apart by so much, as -2 times the logarithm of the likelihood.
_NO_FARTHER, _APART = 12.0, 6.0
#: Scatter of the ratios of a maker, at least; rows that tell one, at least.
_LEAST_SCATTER, _LEAST_ROWS = 0.012, 4
#: Depth of a groove, from pitch circle to root as catalogues print them, over the ball.
_DEPTHS = (1.0, 1.26)
#: True ball over that of a maker: 3.969 and 4 mm, 9.525 and 9.5 mm count as one.
MAKE_BAND = (0.988, 1.012)
BY_MAKE = (
    "the ball that gives both load ratings as this maker states them (each row tried by others: of 44 that print their "
    "ball 38 are told, all right; of 501 whose ball is itself an estimate 403, all but one alike): "
)


class Make(NamedTuple):
    """Nuts of one make and one kind of return: how their listed ratings are to those of ISO 3408-5, and their balls."""

    name: str
    #: Conformity that the ratings follow from; turns of a nut, and share of each turn, that carry no load.
    conformity: Ratio
    idle: tuple[Ratio, Ratio]
    #: Medians of the logarithms of listed over computed rating, dynamic and static, and their scatter.
    ratios: _Numbers
    scatter: _Numbers
    rows: int
    balls: _Numbers
    #: Median of what the pitch circle is larger than the nominal diameter by, over the ball; 0 where none is printed.
    circle: Ratio


class MadeBall(NamedTuple):
    """The ball of a nut that is as those of a make, and the fields of its row that go with that."""

    ball: Estimate
    fields: Mapping[str, float]


class _Likely(NamedTuple):
    """A ball of a make for a row: -2 times the logarithm of its likelihood, and its distance from the usual ratios."""

    cost: float
    square: float
    ball: Length
    make: Make


def makes_of(rows: Iterable[CatalogueRow]) -> list[Make]:
    """The makes of ``rows`` with both ratings; without rolled screws and nuts that no torque is computed of."""
    groups: dict[tuple[str, Ratio, Ratio, Ratio], list[CatalogueRow]] = {}
    for row in rows:
        is_rated = row.dynamic_load_rating is not None and row.static_load_rating is not None
        if is_rated and not row.refusal and not row.family.endswith("rolled"):
            groups.setdefault((row.make, row.rating_conformity, *_idle_of(row)), []).append(row)
    return [_make(*like, group) for like, group in groups.items() if len(group) >= _LEAST_ROWS]


def _make(name: str, conformity: Ratio, idle_turns: Ratio, idle_of_a_turn: Ratio, rows: Sequence[CatalogueRow]) -> Make:
    idle = (idle_turns, idle_of_a_turn)
    ratios = np.array([_ratios(row, row.ball_diameter, row.ball_circle, conformity, idle) for row in rows])
    median: _Numbers = np.median(ratios, axis=0)
    # of the middle half, which no odd row moves; 1.48 times that is the standard deviation of a normal distribution
    scatter: _Numbers = np.maximum(1.48 * np.median(np.abs(ratios - median), axis=0), _LEAST_SCATTER)
    larger = [(row.ball_circle - row.nominal_diameter) / row.ball_diameter for row in rows]
    balls: _Numbers = np.unique([row.ball_diameter for row in rows])
    return Make(name, conformity, idle, median, scatter, len(rows), balls, float(np.median(larger)))


@functools.cache
def _makes_shipped() -> Sequence[Make]:
    return tuple(makes_of(catalogue().values()))


def ball_of_make(row: CatalogueRow, makes: Iterable[Make]) -> MadeBall | None:
    """The ball of a row as one of the makes would have it; None where none or more than one ball is likely.

    The ball of the row plays no part. Where it has the make, that alone counts.
    """
    if row.dynamic_load_rating is None or row.static_load_rating is None:
        return None
    likely = [one for make in makes if _may_be(row, make) for one in _likely(row, make)]
    if not likely:
        return None
    best = min(likely, key=lambda one: one.cost)
    others = [one.cost for one in likely if abs(one.ball / best.ball - 1) > _SAME]
    if best.square > _NO_FARTHER or min(others, default=math.inf) < best.cost + _APART:
        return None
    make, ball = best.make, best.ball
    fields = {
        "turns_without_load": make.idle[0] + make.idle[1] * row.turns,
        "rating_conformity": make.conformity,
    }
    if row.pitch_circle_diameter is None and make.circle:
        fields["pitch_circle_diameter"] = round(row.nominal_diameter + make.circle * ball, _WHOLE_MICROMETRES)
    return MadeBall(_within("ball_diameter", ball, MAKE_BAND, BY_MAKE + make.name), fields)


def _may_be(row: CatalogueRow, make: Make) -> bool:
    """Test whether a row may be of a make: of its name, and of whole turns where each returns its balls."""
    return (not row.make or row.make.casefold() == make.name.casefold()) and not (make.idle[1] and row.turns % 1)


def _likely(row: CatalogueRow, make: Make) -> list[_Likely]:
    """The balls of a make that a nut of this size may have."""
    low, high = (share * row.nominal_diameter for share in BALLS_PER_DIAMETER)
    balls = make.balls[(low <= make.balls) & (make.balls <= min(high, _OF_PITCH * row.lead / row.starts))]
    if row.pitch_circle_diameter is not None and row.root_diameter is not None:
        depths = (row.pitch_circle_diameter - row.root_diameter) / balls
        balls = balls[(_DEPTHS[0] <= depths) & (depths <= _DEPTHS[1])]
    circles: Any = row.pitch_circle_diameter or row.nominal_diameter + make.circle * balls
    over = (_ratios(row, balls, circles, make.conformity, make.idle) - make.ratios) / make.scatter
    squares = np.sum(over**2, axis=-1)
    # a make of many rows is the likelier one
    costs = squares + 2 * math.log(float(np.prod(make.scatter)) / make.rows)
    return [
        _Likely(cost, square, ball, make)
        for cost, square, ball in zip(costs.tolist(), squares.tolist(), balls.tolist(), strict=True)
    ]


def _idle_of(row: CatalogueRow) -> tuple[Ratio, Ratio]:
    """Turns without load of a nut, and of each turn where every turn is a circuit of its own."""
    if row.turns_without_load in (0.0, TURNS_WITHOUT_LOAD):
        return row.turns_without_load, 0.0
    return 0.0, round(row.turns_without_load / row.turns, _DIGITS)


def _ratios(row: CatalogueRow, balls: Any, circles: Any, conformity: Ratio, idle: tuple[Any, Ratio]) -> _Numbers:
    """Logarithms of listed over computed rating, dynamic and static along the last axis, of balls and pitch circles.

    That of a rating which is not listed is NaN.
    """
    angle: Any = geometry.lead_angle(row.lead, circles)
    in_a_turn: Any = np.floor(np.pi * (circles / balls) / np.cos(angle))
    turns = row.turns * (1 - idle[1]) - idle[0]
    spacers = bool(row.spacer_balls)
    computed = ratings_of(
        RatedGeometry(circles, balls, row.contact_angle, angle, in_a_turn, turns, spacers, conformity)
    )
    listed = [math.nan if rating is None else rating for rating in (row.dynamic_load_rating, row.static_load_rating)]
    return np.log(np.stack([stated / rating for stated, rating in zip(listed, computed, strict=True)], axis=-1))


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
            balls = zip(grooves, _balls_of_grooves([*grooves.values()]), strict=False)
            told = {groove: ball for groove, ball in balls if np.isfinite(ball)} | told
    return [
        dataclasses.replace(row, ball_diameter=ball, ball_diameter_source=BY_TABLE)
        if _is_estimated(row) and (ball := told.get(_groove(row)))
        else row
        for row in rows
    ]


def _groove(row: CatalogueRow) -> tuple[Any, ...]:
    """Key that rows of one groove have in common: make, diameter, lead, pitch circle and starts."""
    sizes = (row.nominal_diameter, row.lead, row.ball_circle, row.starts)
    return row.make, *(round(float(size), 6) for size in sizes)


def _is_estimated(row: CatalogueRow) -> bool:
    return row.ball_diameter_source in (BY_RATING, BY_RULE)


def _balls_of_grooves(grooves: Sequence[Sequence[CatalogueRow]]) -> Sequence[Length]:
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
    """Costs of each ball for rows of one groove, by ball, idle turns and factor; infinite for one that cannot be."""
    row = rows[0]
    low, high = (share * row.nominal_diameter for share in BALLS_PER_DIAMETER)
    may_be = (low <= BALLS) & (min(high, _OF_PITCH * row.lead / row.starts) >= BALLS)
    costs = np.zeros((BALLS.size, _IDLE_TURNS.size, _FACTORS.size))
    for each in rows:
        if not _is_estimated(each):
            may_be &= np.abs(BALLS / each.ball_diameter - 1) < _SAME
        with np.errstate(invalid="ignore"):
            ratios = _ratios(each, BALLS[:, None], each.ball_circle, RATING_CONFORMITY, (_IDLE_TURNS, 0.0))
        over = ratios[..., :1] - _FACTORS
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
