"""What is judged of a screw besides its friction: sizes, ratings, loads and rules, from its inputs and what is listed.

Elementwise: numbers, arrays, and values that are recorded, so that another program judges by the same formulas.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ballscrew.basis.arrays import where
from ballscrew.basis.quantities import AngularSpeed, Force, Torque
from ballscrew.basis.records import is_nan
from ballscrew.basis.usual_ranges import is_unusual
from ballscrew.physics.components.nut import PRELOAD
from ballscrew.physics.components.screw import BallScrew, is_odd_preload, rating_of
from ballscrew.physics.equations import transmission
from ballscrew.physics.sizing.check_table import loads_at_point
from ballscrew.physics.sizing.checks import groove_bottom
from ballscrew.physics.sizing.ratings import load_ratings
from ballscrew.physics.sizing.rules import Subject, drags

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
    """What is listed, else what is computed."""
    return where(is_nan(listed), computed, listed)
