"""A result on a whole nut, for people and for programs: torque by mechanism, loads of the balls, stiffness."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from rich.console import Console
from rich.table import Table

from ballscrew import __version__
from ballscrew.analyses.nut_parts import NutParts
from ballscrew.assembly import NutFriction
from ballscrew.components.contact import RaceState
from ballscrew.components.screw import Operation
from ballscrew.interfaces import config, report, units
from ballscrew.interfaces.nuts import LOSSES, kind_of
from ballscrew.quantities import Quantity, fields_of, quantities_of
from ballscrew.solvers.load_distribution import BallLoads

#: What the terminal shows first, in this order.
SHOWN = (
    "screw_torque", "nut_torque", "ideal_torque", "drive_torque", "efficiency", "back_driving_efficiency",
    "friction_power",
)  # fmt: skip
#: What the terminal shows of the contacts of the most loaded ball.
_OF_CONTACT = (
    "contact_load", "semi_major_axis", "semi_minor_axis", "maximum_pressure", "minimum_film_thickness",
    "film_parameter", "friction_coefficient", "spin_parameter", "friction_torque",
)  # fmt: skip
#: What the loads of all balls have in common.
OF_LOADS: Mapping[str, Quantity] = {
    name: quantity
    for name, quantity in quantities_of(BallLoads).items()
    if not name.startswith(("forward", "backward"))
}
_RESULT = quantities_of(NutFriction)
_TORQUE = _RESULT["screw_torque"]
_HOLDING = _RESULT["holding_torque"]
_LOADS = quantities_of(BallLoads)
_OPERATION = fields_of(Operation)
_WORDS = {"seals": "seals", "churning": "churning", "recirculation": "return path"}


class Flank(NamedTuple):
    """Loads and contact angles of the balls on one flank: least, mean and greatest."""

    load: tuple[float, float, float]
    angle: tuple[float, float, float]


class NutResult(NamedTuple):
    """A result, and what it is without load."""

    found: NutFriction
    #: The same at rest: what a brake is sized for.
    rest: NutFriction
    #: Torque of the nut without load: what preload and losses cost.
    preload_drag: float
    #: The flank that carries the load, and the one that it relieves; None where no ball touches.
    loaded: Flank | None
    relieved: Flank | None

    @property
    def preload(self) -> float:
        """Preload of the nut."""
        return float(getattr(self.found.nut, "preload", 0.0))

    @property
    def preload_is_lost(self) -> bool:
        """Whether the load has lifted the balls off the other flank."""
        return self.preload > 0 and float(self.found.loads.remaining_preload) <= 0


def evaluate(case: config.Case, parts: NutParts) -> NutResult:
    """The nut of a case at its operating point."""
    load, speed = case.operation.axial_load, case.operation.screw_speed

    def friction(load: float, speed: float) -> NutFriction:
        return parts.friction(case.model, case.screw, case.lubricant, axial_load=load, screw_speed=speed)

    found = friction(load, speed)
    loads, half = found.loads, np.shape(found.loads.balls)[-1] // parts.halves
    return NutResult(
        found,
        friction(load, 0.0) if float(speed) and float(load) else found,
        float(friction(0.0, speed).screw_torque),
        _flank(loads.forward_load[:half], loads.forward_angle[:half], loads.balls[:half]),
        _flank(loads.backward_load[-half:], loads.backward_angle[-half:], loads.balls[-half:]),
    )


def _flank(load: Any, angle: Any, balls: Any) -> Flank | None:
    """What is to be said of one flank; the angles are those of balls that touch."""
    touches = load > 0
    if not np.any(touches):
        return None

    def ends(values: Any, weights: Any) -> tuple[float, float, float]:
        return float(np.min(values)), float(np.average(values, weights=weights)), float(np.max(values))

    return Flank(ends(load, balls), ends(angle[touches], balls[touches]))


# -- for people -----------------------------------------------------------------------------------


def nut_in_words(parts: NutParts) -> str:
    """``double nut, preload 5047 N``."""
    known = fields_of(parts.nut)
    numbers = [
        f", {name.replace('_', ' ')} {units.shown(getattr(parts.nut, name), known[name])}"
        for name in known
        if name == "preload" or getattr(parts.nut, name)
    ]
    return f"{kind_of(parts.nut)} nut{''.join(numbers)}"


def print_result(case: config.Case, result: NutResult) -> None:
    """Tables on the terminal."""
    assert case.parts is not None
    parts, found, console = case.parts, result.found, Console(highlight=False)

    def say(text: str, style: str | None = None) -> None:
        console.print(text, style=style, markup=False, soft_wrap=True)

    say(f"{report.operating_point(case)}, {nut_in_words(parts)}, {report.model_in_words(case)}\n", "bold")
    for line in (report.design(case, plain_text=True), *assumptions(case, parts)):
        say(line, "dim")
    console.print()
    console.print(_quantities(result))
    for line in verdicts(result):
        say(line, "bold")
    for warning in found.warnings:
        say(f"beware  {warning}", "yellow")
    say(left_out(case, parts))
    if float(found.screw_torque):
        console.print(report.parts_table(found.contributions, float(found.screw_torque), console.encoding))
    console.print(_loads(result))
    console.print(_contacts(found))


def assumptions(case: config.Case, parts: NutParts) -> list[str]:
    """What the result depends on and people seldom write down."""
    bodies = (
        "screw and nut rigid between the balls"
        if parts.bodies is None
        else "screw and nut elastic" + ("" if parts.bodies else ", of a usual size")
    )
    return [*report.assumed(case).split("; "), bodies, *case.notes, *_against_vendors(case, parts)]


def _against_vendors(case: config.Case, parts: NutParts) -> list[str]:
    """What ``ballscrew validate`` shows first, where it concerns the case."""
    if not getattr(parts.nut, "preload", 0.0) or case.calibration is not None or case.fit:
        return []
    return [
        "vendors state more torque of preloaded nuts without load than the model as it is (ballscrew validate), "
        'model.calibration = "rexroth-2006" meets their tables'
    ]


def left_out(case: config.Case, parts: NutParts) -> str:
    """What a nut loses and was not given."""
    words = [_WORDS[slot] for slot in LOSSES if slot not in parts.losses]
    return report.left_out(case, f"left out: {', '.join(words)}" if words else "")


def verdicts(result: NutResult) -> list[str]:
    """What drives what, and what has become of the preload, in words."""
    found = result.found
    lines: list[str] = []
    if float(found.axial_load) == 0:
        lines.append("no load: nothing to hold")
    else:
        moving = [report.holding(found, "at this speed")] if float(found.screw_speed) else []
        lines += [line for line in (*moving, report.holding(result.rest, "at rest")) if line]
    if result.preload_is_lost:
        lift_off = units.shown(found.loads.lift_off_load, _LOADS["lift_off_load"])
        lines.append(f"preload lost: the balls lift off the other flank at a load of about {lift_off}")
    return lines


def _quantities(result: NutResult) -> Table:
    table = report.table_of("Torque and efficiency", "", "")
    for name in SHOWN:
        table.add_row(_RESULT[name].info.meaning, report.shown_or_dash(getattr(result.found, name), _RESULT[name]))
    table.add_row("torque without load", report.shown_or_dash(result.preload_drag, _TORQUE))
    return table


def _loads(result: NutResult) -> Table:
    table = report.table_of("\nLoads of the balls, and how the nut gives way", "", "least", "mean", "greatest")
    for flank, words in ((result.loaded, "the flank that carries the load"), (result.relieved, "the other flank")):
        if flank is not None:
            for values, name, what in ((flank.load, "forward_load", "load"), (flank.angle, "forward_angle", "angle")):
                table.add_row(f"{what} on {words}", *(units.shown(value, _LOADS[name]) for value in values))
    loads = result.found.loads
    names = ["deflection", "rigidity"]
    names += ["remaining_preload", "lift_off_load"] if result.preload else []
    for name in names:
        table.add_row(_LOADS[name].info.meaning, "", report.shown_or_dash(float(getattr(loads, name)), _LOADS[name]))
    pressure = _RESULT["maximum_pressure"]
    table.add_row(pressure.info.meaning, "", "", report.shown_or_dash(float(result.found.maximum_pressure), pressure))
    return table


def _contacts(found: NutFriction) -> Table:
    sides = most_loaded(found)
    known = quantities_of(RaceState)
    table = report.table_of("\nContacts of the most loaded ball", "", "screw", "nut")
    for name in _OF_CONTACT:
        if name in sides["screw"]:
            cells = [report.shown_or_dash(side[name], known[name]) for side in sides.values()]
            table.add_row(report.SHORT.get(name, known[name].info.meaning), *cells)
    return table


# -- for programs ---------------------------------------------------------------------------------


def most_loaded(found: NutFriction) -> dict[str, dict[str, float]]:
    """The contacts of the most loaded ball, on screw and nut."""
    pair = max(found.pairs, key=lambda pair: float(np.max(pair.load)))
    ball = int(np.argmax(pair.load))

    def of_ball(value: Any) -> float:
        array = np.asarray(value)
        return float(array if array.ndim == 0 else array[ball if array.shape[-1] > 1 else 0])

    return {
        side: {name: of_ball(getattr(contact, name)) for name in quantities_of(type(contact))}
        for side, contact in (("screw", pair.screw), ("nut", pair.nut))
    }


def results(result: NutResult) -> dict[str, Any]:
    """All results in SI, as plain numbers and nested tables."""
    found = result.found
    return {
        **{name: getattr(found, name) for name in _RESULT if name not in _OPERATION},
        "holding_torque": float(result.found.holding_torque),
        "preload_drag": result.preload_drag,
        "contributions": dict(found.contributions),
        "validity": {reason: bool(mask) for reason, mask in found.validity.items()},
        **most_loaded(found),
    }


def loads(result: NutResult) -> dict[str, Any]:
    """The loads of the balls in SI: least, mean and greatest on both flanks, then ball by ball."""
    found = result.found.loads

    def flank(values: Flank | None) -> dict[str, Any] | None:
        keys = ("least", "mean", "greatest")
        if values is None:
            return None
        return {name: dict(zip(keys, numbers, strict=True)) for name, numbers in values._asdict().items()}

    return {
        **{name: getattr(found, name) for name in OF_LOADS},
        "preload_is_lost": result.preload_is_lost,
        "loaded_flank": flank(result.loaded),
        "relieved_flank": flank(result.relieved),
        "balls": {
            "count": found.balls,
            **{name: getattr(found, name) for name in _LOADS if name not in OF_LOADS},
        },
    }


def result_units(found: NutFriction) -> dict[str, Any]:
    """The units of :func:`results` and :func:`loads`, in the same places."""
    side = {name: quantity.unit for name, quantity in quantities_of(type(found.pairs[0].screw)).items()}
    flank = {"load": _LOADS["forward_load"].unit, "angle": _LOADS["forward_angle"].unit}
    own = {name: q.unit for name, q in _RESULT.items() if name not in (*_OPERATION, "valid")}
    return {
        **own,
        "holding_torque": _HOLDING.unit,
        "preload_drag": _TORQUE.unit,
        "contributions": dict.fromkeys(found.contributions, _TORQUE.unit),
        "screw": side,
        "nut": side,
        "loads": {
            **{name: quantity.unit for name, quantity in OF_LOADS.items()},
            "loaded_flank": flank,
            "relieved_flank": flank,
            "balls": {name: quantity.unit for name, quantity in _LOADS.items() if name not in OF_LOADS},
        },
    }


def document(case: config.Case, result: NutResult) -> dict[str, Any]:
    """Inputs, results, loads and units in SI, warnings, provenance."""
    return {
        "inputs": config.inputs(case),
        "results": results(result),
        "loads": loads(result),
        "units": result_units(result.found),
        "warnings": warnings(result),
        "provenance": {"version": __version__, "model": case.model.label, "references": config.references(case)},
    }


def warnings(result: NutResult) -> list[str]:
    """What to beware of, the loss of the preload, too."""
    lost = [line for line in verdicts(result) if line.startswith("preload lost")]
    return [*result.found.warnings, *lost]
