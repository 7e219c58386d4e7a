"""The sweeps around the operating point of a run: over the speed, over the load, over both, and from cold to hot."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from ballscrew.questions.run.compute import Run

#: Points of a curve and of one side of the map; fewer for a whole nut, which takes longer.
CURVE, CURVE_OF_NUT, MAP, MAP_OF_NUT = 41, 15, 20, 10
#: Points of a curve of either sign, one more than a multiple of every step of a band.
OF_SIGN = 29
#: How many times as far as its first point a curve ends, and a side of the map.
OVER_SPEED, OVER_LOAD, OVER_BOTH = 100, 50, 20
#: Digits of a value of an axis: the text of an axis has no room for all.
_DIGITS = 6
#: Where the curves of a screw at rest (rad/s) and without load (N) end.
SPEED, LOAD = 200.0, 10_000.0
#: A cold start and a hot machine, K.
COLD, HOT = 273.15, 353.15


class Curve(NamedTuple):
    """A sweep: the axes to vary, as they are written, and the outputs."""

    vary: Mapping[str, str]
    outputs: Sequence[str]


def curves(run: Run) -> dict[str, Curve]:
    """The curves by name; ``cold_and_hot`` only where the oil follows the temperature, under load and not at rest."""
    operation = run.case.operation
    load, speed = float(operation.axial_load), float(operation.screw_speed)
    is_nut = run.nut is not None
    speeds, loads = _far(speed, SPEED), _far(load, LOAD)
    films = ["minimum_film_parameter"] if is_nut else ["screw_film_parameter", "nut_film_parameter"]
    pressures = ["maximum_pressure"] if is_nut else ["screw_maximum_pressure", "nut_maximum_pressure"]
    side = MAP_OF_NUT if is_nut else MAP
    hot = _cold_and_hot(run, load, speed)
    return {
        "over_speed": Curve(
            {"screw_speed": _axis(speeds, OVER_SPEED, _points(speeds, CURVE), "rad/s")},
            ["screw_torque", *(f"contribution_{name}" for name in run.friction.contributions), *films],
        ),
        **({} if hot is None else {"cold_and_hot": hot}),
        "over_both": Curve(
            {
                "axial_load": _axis(loads, OVER_BOTH, side // 2 if loads < 0 else side, "N"),
                "screw_speed": _axis(speeds, OVER_BOTH, side // 2 if speeds < 0 else side, "rad/s"),
            },
            ["efficiency", "back_driving_efficiency"],
        ),
        "over_load": Curve(
            {"axial_load": _axis(loads, OVER_LOAD, _points(loads, CURVE_OF_NUT if is_nut else CURVE), "N")}, pressures
        ),
    }


def _cold_and_hot(run: Run, load: float, speed: float) -> Curve | None:
    """The torque over the temperature, at rest and at speed, and in a full bath where oil comes back late."""
    case = run.case
    if not case.lubricant.follows_temperature or not load or not speed:
        return None
    now = case.origins.oil.get("temperature")
    temperatures = sorted({COLD, HOT, *([float(now)] if isinstance(now, float | int) else [])})
    vary = {"temperature": f"{', '.join(map(repr, temperatures))} K", "screw_speed": f"0, {speed!r} rad/s"}
    constant = getattr(case.model.inlet, "replenishment_constant", None)
    if constant:
        vary["inlet.replenishment_constant"] = f"0, {float(constant)!r}"
    return Curve(vary, ["screw_torque", "holding_torque"])


def _far(value: float, otherwise: float) -> float:
    """The far end of a curve around a value: negative where both signs are drawn."""
    return 2 * value or otherwise


def _points(far: float, count: int) -> int:
    """The points of a curve of one sign."""
    return min(count, OF_SIGN) if far < 0 else count


def _axis(far: float, share: float, count: int, unit: str) -> str:
    """Values from a share of the far end to it, and their negatives where that is negative: none of them is zero."""
    end, first = abs(far), abs(far) / share
    sizes = [first + place * (end - first) / (count - 1) for place in range(count)]
    values = [float(f"{size:.{_DIGITS}g}") for size in sizes]
    return f"{', '.join(map(repr, [*(-value for value in reversed(values)), *values] if far < 0 else values))} {unit}"


def axes_around(*, is_nut: bool) -> dict[str, Any]:
    """Axes of the curves around an operating point, by the curve and the axis, for a page that draws them.

    Each goes to twice the value there, or ``far`` where that is none, from the ``share`` of that end.
    """
    side, loads = (MAP_OF_NUT, CURVE_OF_NUT) if is_nut else (MAP, CURVE)
    return {
        "over_speed": {"screw_speed": _around(OVER_SPEED, CURVE, OF_SIGN, SPEED)},
        "over_load": {"axial_load": _around(OVER_LOAD, loads, min(loads, OF_SIGN), LOAD)},
        "over_both": {
            "axial_load": _around(OVER_BOTH, side, side // 2, LOAD),
            "screw_speed": _around(OVER_BOTH, side, side // 2, SPEED),
        },
    }


def _around(share: float, points: int, points_of_sign: int, far: float) -> dict[str, Any]:
    return {"share": share, "points": points, "points_of_sign": points_of_sign, "far": far}
