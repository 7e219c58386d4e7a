"""The checks of a screw: its life, strength and speed against their limits, as formulas of named values.

The values, SI, by name, see :func:`checks`:

- ``screw_speed`` of either sign, ``pitch_circle_diameter``, ``root_diameter``, ``young_modulus`` of the shaft;
- magnitudes of loads, at one operating point those of :func:`loads_at_point`: ``half_load`` and ``other_half_load``,
  the axial forces on the loaded and on the relieved flanks at the mean load, which tire the screw, the other zero where
  they carry none; ``largest_half_load`` at the largest load, and ``largest_load`` on the shaft;
- ``maximum_pressure`` of the most loaded contact;
- ``dynamic_load_rating`` and ``static_load_rating`` of one nut body;
- ``unsupported_length``, ``shaft_density``, and the least roots of the ends of the shaft, ``buckling_root`` and
  ``whirling_root`` (:class:`~ballscrew.physics.sizing.installation.Ends`);
- ``limits.static_safety``, ``limits.running_time`` (NaN or left out where none is asked for), ``limits.shaft_stress``,
  ``limits.buckling_safety``, ``limits.critical_speed_share``, ``limits.diameter_speed_product``, which is that of the
  make of the nut where none is given.

The words are ``ends`` and ``limit_source``, whose DN value the limit is.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any, NamedTuple, cast

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.arrays import namespace, where
from ballscrew.basis.errors import Fault, accepts_units, raise_if_any, shown
from ballscrew.basis.quantities import AngularSpeed, Force, Length, Pressure, Ratio, fields_of
from ballscrew.basis.records import Judgement, Record, Sentence, Shown, Words, at_least, at_most, is_nan
from ballscrew.physics.components.nut import Nut, SingleNut
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import geometry, life, shaft
from ballscrew.physics.friction.validity import LARGEST_PRESSURE
from ballscrew.physics.sizing.installation import Installation, Limits
from ballscrew.physics.sizing.makers_tables import GENERAL, Source, SpeedLimit

HOUR = 3600.0
#: What is to be given where no running time is asked for.
RUNNING_TIME = "limits.running_time"

NOT_CHECKED = "not checked: give {input}"
#: A life that no running time is asked of, and what to give for it.
NOT_JUDGED, UNJUDGED = "not judged: give {input}", "{life}; {advice}"


def half_loads(axial_load: Force, remaining_preload: Force) -> tuple[Force, Force]:
    """The axial forces on the loaded and on the relieved flanks of a nut, of a load that leaves so much preload.

    Of a nut without preload, whose balls leave the other flanks nothing, zero or NaN.
    """
    left = where(remaining_preload > 0, remaining_preload, 0.0)
    return abs(axial_load) + left, left


def loads_at_point(axial_load: Force, remaining_preload: Force) -> dict[str, Any]:
    """The loads that the checks need, by name, at an operating point that is the mean load and the largest in one."""
    half, other = half_loads(axial_load, remaining_preload)
    return {
        "half_load": half,
        "other_half_load": other,
        "largest_half_load": half,
        "largest_load": abs(axial_load),
    }


def _static_safety(of: Mapping[str, Any]) -> Mapping[str, Any]:
    safety = life.static_safety(of["static_load_rating"], of["largest_half_load"])
    return at_least(safety, of["limits.static_safety"])


def _lives(of: Mapping[str, Any]) -> dict[str, Any]:
    """Basic rating life in revolutions and in time, and what is to be said of them."""
    rated, other, speed = of["dynamic_load_rating"], of["other_half_load"], abs(of["screw_speed"])
    alone = life.basic_life(rated, of["half_load"])
    turns = where(other > 0, life.combined_life(alone, life.basic_life(rated, other)), alone)
    time = life.running_time(turns, speed)
    xp = namespace(turns, time)
    is_asked = xp.logical_not(is_nan(of[RUNNING_TIME]))
    lasts, tires = xp.isfinite(time), xp.isfinite(turns)
    at_rest = tires & (speed == 0)
    return {
        "turns": turns,
        "time": time,
        "tires": tires,
        "lasts": lasts,
        "at_rest": at_rest,
        "judged": is_asked & xp.logical_not(at_rest),
        "unjudged": xp.logical_not(is_asked) | at_rest,
    }


def _life(of: Mapping[str, Any]) -> Mapping[str, Any]:
    lives = _lives(of)
    turns = lives.pop("turns")
    required = of[RUNNING_TIME] / life.running_time(1.0, abs(of["screw_speed"]))
    del lives["time"], lives["lasts"]
    return {**at_least(turns, required), **lives, "million_turns": turns / 1e6}


def _running_time(of: Mapping[str, Any]) -> Mapping[str, Any]:
    lives = _lives(of)
    time = lives.pop("time")
    del lives["turns"]
    return {**at_least(time, of[RUNNING_TIME]), **lives, "hours": time / HOUR}


def _contact_pressure(of: Mapping[str, Any]) -> Mapping[str, Any]:
    return at_most(of["maximum_pressure"], LARGEST_PRESSURE)


def _shaft_stress(of: Mapping[str, Any]) -> Mapping[str, Any]:
    return at_most(shaft.shaft_stress(of["largest_load"], of["root_diameter"]), of["limits.shaft_stress"])


def _buckling(of: Mapping[str, Any]) -> Mapping[str, Any]:
    safety = of["limits.buckling_safety"]
    euler = shaft.buckling_load(of["buckling_root"], of["young_modulus"], of["root_diameter"], of["unsupported_length"])
    return {**at_most(of["largest_load"], euler / safety), "safety": safety}


def _critical_speed(of: Mapping[str, Any]) -> Mapping[str, Any]:
    share = of["limits.critical_speed_share"]
    critical = shaft.critical_speed(
        of["whirling_root"], of["young_modulus"], of["shaft_density"], of["root_diameter"], of["unsupported_length"]
    )
    return {**at_most(abs(of["screw_speed"]), critical * share), "share": share}


def _diameter_speed_product(of: Mapping[str, Any]) -> Mapping[str, Any]:
    value = shaft.diameter_speed_product(of["pitch_circle_diameter"], abs(of["screw_speed"]))
    return at_most(value, of["limits.diameter_speed_product"])


_ENDLESS = Sentence("no load tires it")
_OF_TURNS = (
    Sentence(
        "basic rating life L10: {turns} million revolutions, preload included",
        "tires",
        {"turns": Shown("million_turns", digits=3)},
    ),
    _ENDLESS,
)
_OF_TIME = (
    Sentence("{hours} h at this speed", "lasts", {"hours": Shown("hours", digits=3)}),
    Sentence("no turn tires it", "tires"),
    _ENDLESS,
)
_ADVICE = (
    Sentence("not judged: at rest", "at_rest"),
    Sentence(NOT_JUDGED, places={"input": RUNNING_TIME}),
)
_OF_LIFE = ("dynamic_load_rating", "half_load", "other_half_load", "screw_speed")
_MOUNTED = ("young_modulus", "root_diameter", "unsupported_length")


def _check(name: str, **row: Any) -> Judgement:
    """A check: an error where it fails."""
    return Judgement(id=f"check.{name}", subject=name, severity_of_failure="error", **row)


#: All checks in their order. The source of a formula is its kind; a static rating or a limit of the DN value may have
#: another one, by what is given.
CHECKS: tuple[Judgement, ...] = (
    _check(
        "static_safety",
        formula=_static_safety,
        needs=("static_load_rating", "largest_half_load", "limits.static_safety"),
        give="static_load_rating",
        sentences=(Sentence("static rating against the largest load, preload included"),),
        source="read",  # quotient and least value of THK514E
    ),
    _check(
        "life",
        formula=_life,
        needs=_OF_LIFE,
        takes=(RUNNING_TIME,),
        give="dynamic_load_rating",
        sentences=(Sentence(UNJUDGED, "unjudged", {"life": _OF_TURNS, "advice": _ADVICE}), *_OF_TURNS),
        source="recalled",  # ISO3408-5
    ),
    _check(
        "running_time",
        formula=_running_time,
        needs=_OF_LIFE,
        takes=(RUNNING_TIME,),
        give="dynamic_load_rating",
        unit="s",
        sentences=(Sentence(UNJUDGED, "unjudged", {"life": _OF_TIME, "advice": _ADVICE}), *_OF_TIME),
        source="recalled",  # the same life over the speed
    ),
    _check(
        "contact_pressure",
        formula=_contact_pressure,
        needs=("maximum_pressure",),
        give="maximum_pressure",
        unit="Pa",
        sentences=(
            Sentence("largest Hertz pressure against that which leaves a dent of 1e-4 of the ball diameter (ISO 76)"),
        ),
        source="read",  # 4200 MPa and a dent of 1e-4: ISO76, clauses 3.2 and 3.3
    ),
    _check(
        "shaft_stress",
        formula=_shaft_stress,
        needs=("largest_load", "root_diameter", "limits.shaft_stress"),
        unit="Pa",
        sentences=(Sentence("largest load over the core of the shaft, pulled or pushed"),),
        source="read",  # force over area, the limit of THK514E
    ),
    _check(
        "buckling",
        formula=_buckling,
        needs=("largest_load", *_MOUNTED, "buckling_root", "limits.buckling_safety"),
        give="installation",
        unit="N",
        sentences=(
            Sentence(
                "largest load, if it pushes, against Euler's over {safety}, ends {ends}, the nut no support",
                places={"safety": Shown("safety", digits=6), "ends": Words("ends")},
            ),
        ),
        source="read",  # TimoshenkoGere1961, the safety of THK514E
    ),
    _check(
        "critical_speed",
        formula=_critical_speed,
        needs=("screw_speed", *_MOUNTED, "shaft_density", "whirling_root", "limits.critical_speed_share"),
        give="installation",
        unit="rad/s",
        sentences=(
            Sentence(
                "speed against {share} of the critical speed, ends {ends}, the nut no support",
                places={"share": Shown("share", digits=6), "ends": Words("ends")},
            ),
        ),
        source="read",  # Timoshenko1974, the share of THK514E
    ),
    _check(
        "diameter_speed_product",
        formula=_diameter_speed_product,
        needs=("pitch_circle_diameter", "screw_speed", "limits.diameter_speed_product"),
        unit="m rad/s",
        sentences=(
            Sentence(
                "DN value, pitch circle diameter times speed, which the return of the balls must stand; limit {source}",
                places={"source": Words("limit_source")},
            ),
        ),
        source="read",  # makers' limits; that of another nut is an estimate (SpeedLimit.source)
    ),
)


#: The kind of source of the formulas and limits of each check, where its inputs do not change it.
SOURCES = cast("Mapping[str, Source]", {row.name: row.source for row in CHECKS})

_SINGLE = SingleNut()
_USUAL = Limits()
_PASSES = "passes"
#: Whose limit of the DN value it is, where one is given.
GIVEN_LIMIT = "that was given"


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
    #: The input without which it is not judged; empty where it is.
    missing: str = ""
    #: The kind of source of its formulas and its limit; None where it compares nothing but what is given and computed.
    source: Source | None = None
    #: Whose limit it is, in words, where makers have their own.
    whose_limit: str = ""

    @classmethod
    def saying(
        cls,
        text: str,
        name: str,
        value: float | None,
        limit: float | None,
        unit: str,
        utilisation: float | None,
        holds: bool | None,
        missing: str = "",
        source: Source | None = None,
    ) -> Check:
        """A check with a text; without a ``source`` of its own it has that of its name."""
        of = SOURCES.get(name) if source is None else source
        return cls(name, value, limit, unit, utilisation, holds, text, missing, of)

    @classmethod
    def at_most(cls, text: str, name: str, value: Any, limit: Any, unit: str, source: Source | None = None) -> Check:
        """A check that holds up to a limit; its utilisation is the value over the limit."""
        return cls._of(text, name, unit, at_most(float(value), float(limit)), source)

    @classmethod
    def at_least(cls, text: str, name: str, value: Any, limit: Any, unit: str, source: Source | None = None) -> Check:
        """A check that holds from a limit on; its utilisation is the limit over the value."""
        return cls._of(text, name, unit, at_least(float(value), float(limit)), source)

    @classmethod
    def _of(cls, text: str, name: str, unit: str, values: Mapping[str, Any], source: Source | None) -> Check:
        """A check that was judged."""
        value, limit, used = (float(values[one]) for one in ("value", "limit", "utilisation"))
        return cls.saying(text, name, value, limit, unit, used, bool(values["holds"]), source=source)

    @classmethod
    def of(cls, row: Judgement, values: Mapping[str, Any], words: Mapping[str, str], source: Source | None) -> Check:
        """The row of the table of checks at one point; without a ``source`` of its own it has that of the row."""
        result = row.finds(values)
        if result is None:
            return cls.saying(NOT_CHECKED.format(input=row.give), row.name, None, None, row.unit, None, None, row.give)
        text = row.text(result, words)
        if result.get("judged", True):
            whose = words["limit_source"] if row.name == "diameter_speed_product" else ""
            return cls._of(text, row.name, row.unit, result, source)._replace(whose_limit=whose)
        missing = "" if result["at_rest"] else RUNNING_TIME
        return cls.saying(text, row.name, float(result["value"]), None, row.unit, None, None, missing)

    @property
    def title(self) -> str:
        """The name as people read it."""
        return self.name.replace("_", " ")

    @property
    def record(self) -> Record:
        """The check as a record of a document: an error where it fails, a note where it is not judged."""
        return Record(
            f"check.{self.name}",
            self.name,
            self.text,
            severity="error" if self.holds is False else "info",
            holds=self.holds,
            value=self.value,
            limit=self.limit,
            unit=self.unit,
        )


def judged(checks: Sequence[Check]) -> int:
    """Number of the checks that were judged."""
    return sum(check.holds is not None for check in checks)


def all_hold(checks: Sequence[Check]) -> bool | None:
    """False where one fails, True where all were judged and hold; None where none fails and not all were judged."""
    if any(check.holds is False for check in checks):
        return False
    return True if judged(checks) == len(checks) else None


def verdict_of(checks: Sequence[Check], *, passes: str = _PASSES, by_how_much: bool = False) -> str:
    """Checks in a few words. ``passes`` is said only where all of them were judged and hold.

    Elsewhere the words say how many were judged; ``by_how_much`` adds the utilisation of those that fail.
    """
    if all_hold(checks):
        return passes
    return _in_few_words(checks, by_how_much=by_how_much)


def verdict_at_point(checks: Sequence[Check], *, valid: bool, has_cycle: bool) -> str:
    """The same of an operating point: what is said outside the model's validity, and of a case with a cycle, too."""
    words = _in_few_words(checks, outside=not valid)
    # of a case with a cycle, which is judged elsewhere
    return f"this operating point for ever: {words}" if has_cycle else words


def _in_few_words(checks: Sequence[Check], *, by_how_much: bool = False, outside: bool = False) -> str:
    names = [failing(check, by_how_much=by_how_much) for check in checks if check.holds is False]
    count, number = judged(checks), len(checks)
    if names:
        words = f"fails: {', '.join(names)}" + ("" if count == number else f"; {count} of {number} judged")
    else:
        words = "passes" if count == number else f"{count} of {number} judged, and these hold"
    return f"{words}; outside the model's validity" if outside else words


def failing(check: Check, *, by_how_much: bool = True) -> str:
    """The name of a check that fails, and by how many times; of what limit, where that is an estimate."""
    if not by_how_much or check.utilisation is None:
        return check.title
    times = f"{check.title} {units.number(check.utilisation, 3)} times"
    return f"{times} an estimated limit" if check.source == "estimate" else times


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
    (:data:`~ballscrew.physics.sizing.makers_tables.GENERAL`); the text says which. Without a ``root_diameter`` that of
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
    half, *other = at_mean
    most, *relieved = of_most
    # the loads of both halves of a preloaded nut are of a recalled formula, where the contacts have not told them
    closed = bool(relieved) and (half_loads is None or largest_load is not None)
    recalled = closed or "static_load_rating" in computed_ratings
    known = GENERAL if speed_limit is None else speed_limit
    if limits.diameter_speed_product is not None:
        known = SpeedLimit(limits.diameter_speed_product, GIVEN_LIMIT)
    values = {
        "screw_speed": screw_speed,
        "pitch_circle_diameter": screw.pitch_circle_diameter,
        "root_diameter": groove_bottom(screw) if root_diameter is None else root_diameter,
        "young_modulus": screw.screw_material.young_modulus,
        "half_load": half,
        "other_half_load": other[0] if other else 0.0,
        "largest_half_load": most,
        "largest_load": largest,
        "maximum_pressure": maximum_pressure,
        "dynamic_load_rating": dynamic_load_rating,
        "static_load_rating": static_load_rating,
        **values_of_limits(limits),
        "limits.diameter_speed_product": known.value,
        **({} if installation is None else values_of_installation(installation)),
    }
    words: dict[str, str] = {"limit_source": known.words}
    if installation is not None:
        words["ends"] = installation.ends.words
    sources: dict[str, Source | None] = {
        "static_safety": "recalled" if recalled else None,
        "diameter_speed_product": known.source,
    }
    return tuple(Check.of(row, values, words, sources.get(row.name)) for row in CHECKS)


def values_of_limits(limits: Limits) -> dict[str, Any]:
    """Limits by their names in the table."""
    return {f"limits.{name}": getattr(limits, name) for name in fields_of(Limits)}


def values_of_installation(installation: Installation) -> dict[str, Any]:
    """Numbers of a mounted shaft by their names in the table."""
    return {
        "unsupported_length": installation.unsupported_length,
        "shaft_density": installation.shaft_density,
        "buckling_root": installation.ends.buckling_root,
        "whirling_root": installation.ends.whirling_root,
    }


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


def groove_bottom(screw: BallScrew) -> Length:
    """The diameter at the bottom of the groove of a screw, from its conformity."""
    return geometry.groove_root_diameter(
        screw.pitch_circle_diameter, screw.ball_diameter, screw.screw_conformity, screw.contact_angle
    )
