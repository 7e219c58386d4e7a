"""The table of checks: life, strength and speed of a screw against their limits, as formulas of named values.

The values, SI, by name; see :func:`ballscrew.physics.sizing.checks.checks`:

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

from collections.abc import Mapping
from typing import Any

from ballscrew.basis.arrays import namespace, where
from ballscrew.basis.quantities import Force
from ballscrew.basis.records import Judgement, Sentence, Shown, Words, at_least, at_most, is_nan
from ballscrew.physics.equations import life, shaft
from ballscrew.physics.friction.validity import LARGEST_PRESSURE

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
