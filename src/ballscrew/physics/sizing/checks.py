"""The checks of a screw: its life, strength and speed against their limits."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.arrays import as_array
from ballscrew.basis.errors import Fault, accepts_units, raise_if_any, shown
from ballscrew.basis.quantities import AngularSpeed, Force, Length, Pressure, Ratio
from ballscrew.basis.records import Measured, Message, Record
from ballscrew.physics.components.nut import Nut, SingleNut
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import geometry, life, shaft
from ballscrew.physics.friction.validity import LARGEST_PRESSURE
from ballscrew.physics.sizing.dn_limits import GENERAL, SpeedLimit
from ballscrew.physics.sizing.installation import Installation, Limits
from ballscrew.physics.sizing.ratings import RATING_CONFORMITY as RATING_CONFORMITY
from ballscrew.physics.sizing.ratings import Ratings as Ratings
from ballscrew.physics.sizing.ratings import ratings_of as ratings_of
from ballscrew.physics.sizing.sources import Source

HOUR = 3600.0

#: The kind of source of the formulas and limits of each check, where its inputs do not change it.
SOURCES: Mapping[str, Source] = {
    "static_safety": "read",  # quotient and least value of THK514E
    "life": "recalled",  # ISO3408-5
    "running_time": "recalled",  # the same life over the speed
    "contact_pressure": "read",  # 4200 MPa and a dent of 1e-4: ISO76, clauses 3.2 and 3.3
    "shaft_stress": "read",  # force over area, the limit of THK514E
    "buckling": "read",  # TimoshenkoGere1961, the safety of THK514E
    "critical_speed": "read",  # Timoshenko1974, the share of THK514E
    "diameter_speed_product": "read",  # makers' limits; that of another nut is an estimate (SpeedLimit.source)
}

_SINGLE = SingleNut()
_USUAL = Limits()
_PASSES = Message("passes")
NOT_CHECKED = Message("not checked: give {input}")
#: A life that no running time is asked of, and what to give for it.
NOT_JUDGED, UNJUDGED = Message("not judged: give {input}"), Message("{life}; {advice}")


@accepts_units("checks")
def mean_load(loads: Sequence[Force], revolutions: Sequence[Ratio]) -> Force:
    """The steady load that tires a nut without preload as much as these loads, each for so many revolutions."""
    return np.average(np.power(loads, 3.0), weights=revolutions) ** (1 / 3)


@accepts_units("checks")
def loads_of_halves(nut: Nut, axial_load: Force) -> tuple[Force, ...]:
    """The load of a nut; with preload that of the half, or flank, which the axial load presses, then of the other."""
    if isinstance(nut, SingleNut) or nut.preload == 0:
        return (axial_load,)
    relieved = life.relieved_half_load(nut.preload, life.preload_release(axial_load, nut.preload))
    return axial_load + relieved, relieved


class Check(NamedTuple):
    """One check, in SI. It holds where the utilisation, demand over capacity, is at most one.

    None stands for what is not known; the text then states which input is missing.
    """

    name: str
    value: float | None
    limit: float | None
    unit: str
    utilisation: float | None
    holds: bool | None
    text: str
    #: The text as a template with its values.
    message: Message
    #: The input without which it is not judged; empty where it is.
    missing: str = ""
    #: The kind of source of its formulas and its limit; None where it compares nothing but what is given and computed.
    source: Source | None = None

    @classmethod
    def saying(
        cls,
        message: Message,
        name: str,
        value: float | None,
        limit: float | None,
        unit: str,
        utilisation: float | None,
        holds: bool | None,
        missing: str = "",
        source: Source | None = None,
    ) -> Check:
        """A check whose text is a message; without a ``source`` of its own it has that of its name."""
        of = SOURCES.get(name) if source is None else source
        return cls(name, value, limit, unit, utilisation, holds, units.filled(message), message, missing, of)

    @classmethod
    def at_most(
        cls, message: Message, name: str, value: Any, limit: Any, unit: str, source: Source | None = None
    ) -> Check:
        """A check that holds up to a limit; its utilisation is the value over the limit."""
        value, limit = float(value), float(limit)
        return cls.saying(message, name, value, limit, unit, _ratio(value, limit), value <= limit, source=source)

    @classmethod
    def at_least(
        cls, message: Message, name: str, value: Any, limit: Any, unit: str, source: Source | None = None
    ) -> Check:
        """A check that holds from a limit on; its utilisation is the limit over the value."""
        value, limit = float(value), float(limit)
        return cls.saying(message, name, value, limit, unit, _ratio(limit, value), value >= limit, source=source)

    @property
    def title(self) -> Message:
        """The name as people read it."""
        return Message(self.name.replace("_", " "))

    @property
    def record(self) -> Record:
        """The check as a record of a document: an error where it fails, a note where it is not judged."""
        return Record(
            id=f"check.{self.name}",
            subject=self.name,
            text=self.text,
            message=self.message,
            severity="error" if self.holds is False else "info",
            holds=self.holds,
            value=self.value,
            limit=self.limit,
            unit=self.unit,
        )


def _ratio(over: float, under: float) -> float:
    return over / under if under else math.inf if over else 0.0


def judged(checks: Sequence[Check]) -> int:
    """Number of the checks that were judged."""
    return sum(check.holds is not None for check in checks)


def all_hold(checks: Sequence[Check]) -> bool | None:
    """False where one fails, True where all were judged and hold; None where none fails and not all were judged."""
    if any(check.holds is False for check in checks):
        return False
    return True if judged(checks) == len(checks) else None


def verdict_of(checks: Sequence[Check], *, passes: Message = _PASSES, by_how_much: bool = False) -> Message:
    """Checks in a few words. ``passes`` is said only where all of them were judged and hold.

    Elsewhere the words say how many were judged; ``by_how_much`` adds the utilisation of those that fail.
    """
    names = [failing(check, by_how_much=by_how_much) for check in checks if check.holds is False]
    count = {"judged": Measured(judged(checks)), "all": Measured(len(checks))}
    if judged(checks) == len(checks):
        return Message("fails: {names}", {"names": names}) if names else passes
    if names:
        return Message("fails: {names}; {judged} of {all} judged", {"names": names, **count})
    return Message("{judged} of {all} judged, and these hold", count)


def failing(check: Check, *, by_how_much: bool = True) -> Message:
    """The name of a check that fails, and by how many times."""
    if not by_how_much or check.utilisation is None:
        return check.title
    return Message("{check} {times} times", {"check": check.title, "times": Measured(check.utilisation, digits=3)})


@accepts_units("checks")
def checks(
    screw: BallScrew,
    *,
    axial_load: Force,
    screw_speed: AngularSpeed,
    nut: Nut = _SINGLE,
    dynamic_load_rating: Force | None = None,
    static_load_rating: Force | None = None,
    maximum_pressure: Pressure | None = None,
    largest_load: Force | None = None,
    half_loads: tuple[Force, ...] | None = None,
    root_diameter: Length | None = None,
    installation: Installation | None = None,
    limits: Limits = _USUAL,
    speed_limit: SpeedLimit | None = None,
    computed_ratings: Collection[str] = (),
) -> tuple[Check, ...]:
    """The checks of a screw at one operating point, all of them every time; one without its inputs says so.

    ``axial_load`` is the mean load, which tires the screw, always in one direction; ``largest_load`` (the mean where
    None) may break it. Loads and speed count by their size, whatever their signs. The ratings are those of one
    nut body or half, as are the loaded balls of the screw.
    ``half_loads`` are the axial forces at the mean load on the loaded flanks and, if they carry any, on the relieved
    ones; where they are not known, those of the closed formula of :func:`loads_of_halves` are taken.
    ``maximum_pressure`` is that of the most loaded contact. The DN value is held against that of ``limits``, if one is
    set there, else against ``speed_limit``, that of the make of the nut, else against a general one
    (:data:`~ballscrew.physics.sizing.dn_limits.GENERAL`); the text says which. Without a ``root_diameter`` that of
    the groove is taken. ``computed_ratings`` names the ratings that are not listed but follow from the geometry, by
    ISO3408-5 as recalled: the check of the static one is then of that source, too.
    Raises :class:`~ballscrew.basis.errors.InputError` for values that are not positive, and a largest load below the
    mean.
    """
    OperatingState(axial_load=axial_load, screw_speed=screw_speed)
    axial_load, screw_speed = abs(axial_load), abs(screw_speed)
    largest_load = None if largest_load is None else abs(largest_load)
    _raise_for_nonsense(axial_load, largest_load, dynamic_load_rating, static_load_rating, root_diameter)
    largest = axial_load if largest_load is None else largest_load
    at_mean = loads_of_halves(nut, axial_load) if half_loads is None else half_loads
    of_most = at_mean if largest_load is None else loads_of_halves(nut, largest)
    most = of_most[0]
    # the loads of both halves of a preloaded nut are of a recalled formula, where the contacts have not told them
    closed = len(of_most) > 1 and (half_loads is None or largest_load is not None)
    recalled = closed or "static_load_rating" in computed_ratings
    d_r = _groove_bottom(screw) if root_diameter is None else root_diameter
    with np.errstate(divide="ignore"):
        return (
            _static_safety(static_load_rating, most, limits, "recalled" if recalled else None),
            *_life(dynamic_load_rating, at_mean, screw_speed, limits),
            _contact_pressure(maximum_pressure),
            _shaft_stress(largest, d_r, limits),
            _buckling(screw, largest, d_r, installation, limits),
            _critical_speed(screw, screw_speed, d_r, installation, limits),
            _diameter_speed_product(screw, screw_speed, limits, speed_limit),
        )


def _raise_for_nonsense(
    axial_load: Force,
    largest_load: Force | None,
    dynamic_load_rating: Force | None,
    static_load_rating: Force | None,
    root_diameter: Length | None,
) -> None:
    given = {
        "dynamic_load_rating": (dynamic_load_rating, "N"),
        "static_load_rating": (static_load_rating, "N"),
        "root_diameter": (root_diameter, "m"),
    }
    faults = [
        Fault(f"checks.{name}", "must be positive", shown(value, unit), "leave it out where it is not known")
        for name, (value, unit) in given.items()
        if value is not None and not value > 0
    ]
    if largest_load is not None and not largest_load >= axial_load:
        remedy = "give the greatest magnitude, or leave it out"
        faults.append(Fault("checks.largest_load", "is below the mean load", shown(largest_load, "N"), remedy))
    raise_if_any(faults)


def _groove_bottom(screw: BallScrew) -> Length:
    return geometry.groove_root_diameter(
        screw.pitch_circle_diameter, screw.ball_diameter, screw.screw_conformity, screw.contact_angle
    )


def _not_checked(name: str, unit: str, give: str) -> Check:
    return Check.saying(NOT_CHECKED.of(input=Message(give)), name, None, None, unit, None, None, give)


def _static_safety(rated: Force | None, load: Force, limits: Limits, source: Source | None) -> Check:
    name = "static_safety"
    if rated is None:
        return _not_checked(name, "1", "static_load_rating")
    message = Message("static rating against the largest load, preload included")
    safety = life.static_safety(rated, as_array(load))
    return Check.at_least(message, name, safety, limits.static_safety, "1", source)


def _life(rated: Force | None, loads: Sequence[Force], speed: AngularSpeed, limits: Limits) -> tuple[Check, Check]:
    names = ("life", "running_time")
    if rated is None:
        give = "dynamic_load_rating"
        return _not_checked(names[0], "1", give), _not_checked(names[1], "s", give)
    lives = [life.basic_life(rated, as_array(load)) for load in loads]
    revolutions = lives[0] if len(lives) == 1 else life.combined_life(*lives)
    time = life.running_time(revolutions, as_array(speed))
    endless = not np.isfinite(revolutions)
    millions = {"turns": Measured(float(revolutions) / 1e6, digits=3)}
    of_turns = (
        Message("no load tires it")
        if endless
        else Message("basic rating life L10: {turns} million revolutions, preload included", millions)
    )
    without_end = of_turns if endless else Message("no turn tires it")
    of_hours = (
        Message("{hours} h at this speed", {"hours": Measured(float(time / HOUR), digits=3)})
        if np.isfinite(time)
        else without_end
    )
    required = limits.running_time
    at_rest = not endless and not float(as_array(speed))
    if required is None or at_rest:
        missing = "" if at_rest else "limits.running_time"
        advice = Message("not judged: at rest") if at_rest else NOT_JUDGED.of(input=Message(missing))
        both = [UNJUDGED.of(life=one, advice=advice) for one in (of_turns, of_hours)]
        return (
            Check.saying(both[0], names[0], float(revolutions), None, "1", None, None, missing),
            Check.saying(both[1], names[1], float(time), None, "s", None, None, missing),
        )
    turns = required / life.running_time(1.0, as_array(speed))
    return (
        Check.at_least(of_turns, names[0], revolutions, turns, "1"),
        Check.at_least(of_hours, names[1], time, required, "s"),
    )


def _contact_pressure(pressure: Pressure | None) -> Check:
    name = "contact_pressure"
    if pressure is None:
        return _not_checked(name, "Pa", "maximum_pressure")
    message = Message("largest Hertz pressure against that which leaves a dent of 1e-4 of the ball diameter (ISO 76)")
    return Check.at_most(message, name, pressure, LARGEST_PRESSURE, "Pa")


def _shaft_stress(load: Force, d_r: Length, limits: Limits) -> Check:
    message = Message("largest load over the core of the shaft, pulled or pushed")
    return Check.at_most(message, "shaft_stress", shaft.shaft_stress(load, d_r), limits.shaft_stress, "Pa")


def _buckling(screw: BallScrew, load: Force, d_r: Length, installation: Installation | None, limits: Limits) -> Check:
    name = "buckling"
    if installation is None:
        return _not_checked(name, "N", "installation")
    ends, E = installation.ends, screw.screw_material.young_modulus
    euler = shaft.buckling_load(ends.buckling_root, E, d_r, installation.unsupported_length)
    message = Message(
        "largest load, if it pushes, against Euler's over {safety}, ends {ends}",
        {"safety": Measured(limits.buckling_safety, digits=6), "ends": Message(ends.words)},
    )
    return Check.at_most(message, name, load, euler / limits.buckling_safety, "N")


def _critical_speed(
    screw: BallScrew, speed: AngularSpeed, d_r: Length, installation: Installation | None, limits: Limits
) -> Check:
    name = "critical_speed"
    if installation is None:
        return _not_checked(name, "rad/s", "installation")
    ends, E, rho = installation.ends, screw.screw_material.young_modulus, installation.shaft_density
    critical = shaft.critical_speed(ends.whirling_root, E, rho, d_r, installation.unsupported_length)
    message = Message(
        "speed against {share} of the critical speed, ends {ends}",
        {"share": Measured(limits.critical_speed_share, digits=6), "ends": Message(ends.words)},
    )
    return Check.at_most(message, name, speed, critical * limits.critical_speed_share, "rad/s")


def _diameter_speed_product(screw: BallScrew, speed: AngularSpeed, limits: Limits, of_make: SpeedLimit | None) -> Check:
    value, given = shaft.diameter_speed_product(screw.pitch_circle_diameter, speed), limits.diameter_speed_product
    known = GENERAL if of_make is None else of_make
    limit, words = (known.value, known.words) if given is None else (given, Message("that was given"))
    source = known.source if given is None else None
    message = Message(
        "DN value, pitch circle diameter times speed, which the return of the balls must stand; limit {source}",
        {"source": words},
    )
    return Check.at_most(message, "diameter_speed_product", value, limit, "m rad/s", source)
