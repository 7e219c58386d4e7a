"""The curves of a report: torque and its parts, efficiency, film and pressure around the operating point."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.physics.components.operating_state import OperatingState

Numbers = NDArray[np.float64]
Masks = NDArray[np.bool_]
#: How far curves go beyond the operating point, and how many points they have.
BEYOND, POINTS, MAP_POINTS, FIRST = 2.0, 61, 25, 0.02
#: The points of a map along each axis where the balls of a nut are solved one by one: half of the time of a report.
MAP_POINTS_OF_NUT = 17
#: Where the curves of a case at rest or without load end.
SPEED, LOAD, SHARE_OF_RATING = 1200 * np.pi / 30, 2000.0, 0.2
_KNOWN = fields_of(OperatingState)


class Curves(NamedTuple):
    """Curves of the report, in display units: rpm, N, N m, GPa."""

    here: tuple[float, float]
    speeds: Numbers
    #: Parts of the friction torque over the speed, at the load of the case.
    parts: Mapping[str, Numbers]
    #: Friction torque in a full bath of oil over the speed, where that of the case is starved at one of the speeds.
    flooded_torque: Numbers | None
    #: Film parameters over the speed, by what they are of.
    films: Mapping[str, Numbers]
    loads: Numbers
    #: Over the load, at the speed of the case.
    efficiency: Numbers
    back_driving_efficiency: Numbers
    pressure: Mapping[str, Numbers]
    map_loads: Numbers
    map_speeds: Numbers
    #: Over load (first axis) and speed.
    map_efficiency: Numbers
    map_torque: Numbers
    #: Where all conditions of the model hold: over the speed, over the load, and over both.
    valid_over_speed: Masks
    valid_over_load: Masks
    valid_everywhere: Masks


def friction_of(case: Case) -> Callable[[Any, Any], Any]:
    """The friction of a case, or of its nut, at loads and speeds."""

    def of(load: Any, speed: Any) -> Any:
        return case.model(case.screw, case.lubricant, axial_load=load, screw_speed=speed)

    return of


def curves(case: Case) -> Curves:
    """The curves around the operating point of a case, from rest and from no load to twice of both.

    Loads and speeds are magnitudes. The load is on the flank that it presses in the case, and the screw drives it:
    there both efficiencies are numbers, and friction is the same in either direction.
    """
    load, speed = (abs(float(getattr(case.operation, name))) for name in OPERATION)
    sign = -1.0 if case.operation.axial_load < 0 else 1.0
    evaluated = friction_of(case)

    def friction(load: Any, speed: Any) -> Any:
        return evaluated(sign * load, sign * speed)

    rating = case.origins.listed.get("dynamic_load_rating")
    most_load = BEYOND * load or (LOAD if rating is None else SHARE_OF_RATING * rating)
    most_speed = BEYOND * speed or SPEED
    speeds, loads = (np.linspace(0.0, most, POINTS) for most in (most_speed, most_load))
    of_map = MAP_POINTS_OF_NUT if case.screw.nut.one_by_one else MAP_POINTS
    map_loads, map_speeds = (np.linspace(FIRST, 1.0, of_map) * most for most in (most_load, most_speed))
    with np.errstate(all="ignore"):
        over_speed = friction(np.full_like(speeds, load), speeds)
        over_load = friction(loads[1:], np.full_like(loads[1:], speed))
        everywhere = friction(map_loads[:, None], map_speeds[None, :])
        films, pressure = _contacts(case, over_speed, over_load)
        return Curves(
            here=(_people("screw_speed", speed), _people("axial_load", load)),
            speeds=_people("screw_speed", speeds),
            parts={name: _array(part, speeds) for name, part in over_speed.contributions.items()},
            flooded_torque=_array(over_speed.flooded_torque, speeds) if over_speed.starvation else None,
            films={name: _array(film, speeds) for name, film in films.items()},
            loads=_people("axial_load", loads[1:]),
            efficiency=_array(over_load.efficiency, loads[1:]),
            back_driving_efficiency=_array(over_load.back_driving_efficiency, loads[1:]),
            pressure={name: _array(each, loads[1:]) / 1e9 for name, each in pressure.items()},
            map_loads=_people("axial_load", map_loads),
            map_speeds=_people("screw_speed", map_speeds),
            map_efficiency=np.asarray(everywhere.efficiency, dtype=float),
            map_torque=np.asarray(everywhere.screw_torque, dtype=float),
            valid_over_speed=np.broadcast_to(over_speed.valid, speeds.shape),
            valid_over_load=np.broadcast_to(over_load.valid, loads[1:].shape),
            valid_everywhere=np.asarray(everywhere.valid),
        )


def _contacts(case: Case, over_speed: Any, over_load: Any) -> tuple[Mapping[str, Any], Mapping[str, Any]]:
    if case.nut is not None:
        words = "of all contacts"
        return {f"least {words}": over_speed.minimum_film_parameter}, {f"greatest {words}": over_load.maximum_pressure}
    sides = {"at the screw": "screw", "at the nut": "nut"}
    films = {words: getattr(over_speed, side).film_parameter for words, side in sides.items()}
    return films, {words: getattr(over_load, side).maximum_pressure for words, side in sides.items()}


def _people(name: str, value: Any) -> Any:
    return units.from_si(value, _KNOWN[name])


def _array(value: Any, like: Numbers) -> Numbers:
    """One number for each point; what is not finite is not drawn."""
    array = np.broadcast_to(np.asarray(value, dtype=float), like.shape).copy()
    array[~np.isfinite(array)] = np.nan
    return array
