"""All that is judged of a screw at an operating point: verdicts, warnings of the model, and checks, as tables.

The interface is three things. :data:`JUDGED` is the rows: each has an id, templates, and the names of what it ``needs``
(values), of its ``words``, and of what it gives. :func:`judged` is all formulas at once, from named values in SI to
masks and numbers: call it with numbers for one point, with arrays for many, or on a tape, and make outputs of what it
returns (:func:`outputs`). :func:`documents` is the tables as they stand in JSON, from which another program fills
sentences.

The names of values and words are explained in :mod:`ballscrew.physics.friction.verdicts` and
:mod:`ballscrew.physics.sizing.checks`.

What is judged of a screw besides its friction: sizes, ratings, loads and rules, from its inputs and what is listed.

Elementwise: numbers, arrays, and values that are recorded, so that another program judges by the same formulas.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ballscrew.basis import records
from ballscrew.basis.arrays import where
from ballscrew.basis.quantities import AngularSpeed, Force, Torque
from ballscrew.basis.records import Judgement, is_nan
from ballscrew.basis.usual_ranges import is_unusual
from ballscrew.physics.components.nut import PRELOAD
from ballscrew.physics.components.screw import BallScrew, is_odd_preload, rating_of
from ballscrew.physics.equations import transmission
from ballscrew.physics.friction.verdicts import VERDICTS, WARNINGS
from ballscrew.physics.sizing.checks import CHECKS, NOT_CHECKED, groove_bottom, loads_at_point
from ballscrew.physics.sizing.ratings import load_ratings
from ballscrew.physics.sizing.rules import Subject, drags

#: All rows: verdicts, warnings and checks, each group in the order in which it is said.
JUDGED: tuple[Judgement, ...] = (*VERDICTS, *WARNINGS, *CHECKS)


def judged(values: Mapping[str, Any]) -> dict[str, Mapping[str, Any]]:
    """The masks and numbers of each row by its id, of those whose needs are among the values.

    A value that is None is not given. Numbers are in SI; truth values are masks, and a number that stands for one is to
    be compared with zero first. The ids are those of :data:`JUDGED`, and what a row gives is named in its document,
    ``masks`` and ``numbers``: see :mod:`ballscrew.basis.records` for the names that are the same in all rows.
    """
    return records.judged(JUDGED, values)


def outputs(result: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """Results of :func:`judged` under one name each, ``check.buckling:value``, as outputs of a recording."""
    return {f"{row}:{name}": value for row, of_row in result.items() for name, value in of_row.items()}


def documents() -> dict[str, Any]:
    """The tables as they stand in JSON, without their formulas.

    A row ``needs`` values by name, and ``takes`` others that may be left out: numbers are NaN then, and ``truths``
    false. Its formula gives ``masks`` and ``numbers`` by name.

    A row of ``verdicts`` and ``warnings`` is a record wherever its mask ``said`` holds, or always where it has none. A
    row of ``checks`` is one always: where a need is not given its sentence is ``not_checked`` with ``give`` of the row
    as ``input``, and where its mask ``judged`` is false it has a value, and neither limit nor truth. Of the
    ``sentences`` of a row, and of a choice that stands in one, the first counts whose mask ``said`` holds, or that has
    none. A record is of ``severity``; where its mask ``holds`` is false, of ``severity_of_failure`` if there is one. In
    a sentence a ``number`` is shown in the unit ``shown_in`` (from ``unit``) with so many ``digits`` or ``decimals``,
    ``words`` are given, and a ``constant`` stands as it is.
    """
    tables = {"verdicts": VERDICTS, "warnings": WARNINGS, "checks": CHECKS}
    values: dict[str, Any] = {name: [row.document() for row in rows] for name, rows in tables.items()}
    return values | {"not_checked": NOT_CHECKED}


#: What a catalogue may list of a screw, and NaN where it does not.
LISTED = ("dynamic_load_rating", "static_load_rating", "root_diameter", "nominal_diameter")


def derived(
    screw: BallScrew,
    *,
    axial_load: Force,
    screw_speed: AngularSpeed,
    remaining_preload: Force,
    idle_torque: Torque,
    idle_losses: Torque,
    listed: Mapping[str, Any],
) -> dict[str, Any]:
    """Values of :mod:`ballscrew.physics.sizing.rules` by their names, and a few that people look for.

    ``remaining_preload`` is what the load leaves of the preload; ``idle_torque`` the torque on the screw without load,
    of which ``idle_losses`` are not of the balls; ``listed`` has :data:`LISTED`. The torque of the nut without load and
    seals by the rules of makers is ``drag_by_jis``, ``drag_by_rexroth`` and so on; a nut without preload has none.
    """
    computed = load_ratings(screw)
    preload = getattr(screw.nut, "preload", None)
    nominal = _or(listed["nominal_diameter"], screw.pitch_circle_diameter)
    values: dict[str, Any] = {
        **loads_at_point(axial_load, remaining_preload),
        "root_diameter": _or(listed["root_diameter"], groove_bottom(screw)),
        "dynamic_load_rating": _or(listed["dynamic_load_rating"], computed.dynamic),
        "static_load_rating": _or(listed["static_load_rating"], computed.static),
        "lead_angle": screw.lead_angle,
        "nut_speed": transmission.nut_speed(screw_speed, screw.lead),
    }
    if preload is None:
        return values
    subject = Subject(
        nominal_diameter=nominal,
        pitch_circle_diameter=screw.pitch_circle_diameter,
        lead=screw.lead,
        axial_load=abs(axial_load),
        preload=preload,
        oversize_balls=screw.nut.contacts_per_ball > 2,
    )
    return values | {
        **{f"drag_by_{name}": torque for name, torque in drags(subject).items()},
        "preload_drag_of_balls": idle_torque - idle_losses,
        "implausible_preload": is_odd_preload(preload, rating_of(screw)) | is_unusual(PRELOAD, preload),
    }


def _or(listed: Any, computed: Any) -> Any:
    """Return what is listed, else what is computed."""
    return where(is_nan(listed), computed, listed)
