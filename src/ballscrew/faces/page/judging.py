"""Verdicts, checks and the picture of the ball without a server: their module, and the tables that say them.

The page computes the operating point and a few points beside it, takes from there and from the visitor what is judged,
and fills the sentences of the tables. Which value is from where is data, too.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from ballscrew.basis import units
from ballscrew.basis.arrays import where
from ballscrew.basis.quantities import Info, Quantity, fields_of
from ballscrew.cases.case_files.nut_tables import RATING_SOURCES
from ballscrew.compiler.tracing.merging import merged_program
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.tape import Tape
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.engine.evaluation.structures import inputs_of_structure
from ballscrew.exports.wasm_modules import BALL, Function, Module, compiled, described
from ballscrew.faces.page import kinds
from ballscrew.physics.friction.ball_section import Arc, FlankPair, MostLoadedBall, contact_width, land_height, touched
from ballscrew.physics.sizing.catalogue import catalogue
from ballscrew.physics.sizing.checks import GIVEN_LIMIT, values_of_limits
from ballscrew.physics.sizing.installation import Ends, Installation, Limits
from ballscrew.physics.sizing.judged import JUDGED, LISTED, derived, documents, judged, outputs
from ballscrew.physics.sizing.makers_tables import GENERAL, speed_limit_of
from ballscrew.physics.sizing.rules import rule_of

#: What else is computed at once: points that differ from that of the visitor in these inputs.
BESIDE: Mapping[str, Mapping[str, float]] = {
    "at_rest": {"screw_speed": 0.0},
    "full_bath": {"inlet.replenishment_constant": 0.0},
    "without_load": {"axial_load": 0.0},
}
_OF_RUN = (
    "screw_torque", "drive_torque", "holding_torque", "valid", "rolling_share", "remaining_preload", "lift_off_load",
    "power_imbalance", "nut_torque",
)  # fmt: skip
_OF_SCREW = (*OPERATION, "pitch_circle_diameter", "preload")
_OF_INSTALLATION = ("unsupported_length", "shaft_density", "buckling_root", "whirling_root")
#: What the page asks nobody for: it has no motor.
_NOT_ASKED = ("motor_torque",)
_DERIVED = (
    "half_load", "other_half_load", "largest_half_load", "largest_load", "root_diameter", "dynamic_load_rating",
    "static_load_rating", "preload_drag_of_balls", "implausible_preload",
)  # fmt: skip
#: Further inputs of what is derived, by name, and where they are from.
_FOR_DERIVED: Mapping[str, tuple[str, str]] = {
    "remaining_preload": ("checked", "remaining_preload"),
    "idle_torque": ("without_load", "screw_torque"),
    "idle_losses": ("without_load", "contribution_seals"),
    **{f"listed.{name}": ("listed", name) for name in LISTED},
}
#: A screw is checked with a nut; one without as a single one.
CHECKED_AS: Mapping[str, str] = {"row": "single"}


class Judging(NamedTuple):
    """The module of what is judged, and which of its functions is which."""

    module: Module
    judged: Function
    derived: Mapping[str, Function]
    #: Of loaded balls alone, and of a nut.
    drawing: Mapping[str, Function]


def values() -> dict[str, tuple[str, str]]:
    """The values that are judged by name, each with where it is from, and its name there.

    ``inputs`` and ``outputs`` are of the operating point, ``checked`` outputs of the nut that is checked; the names of
    :data:`BESIDE` are outputs there; ``given`` and ``listed`` are of the visitor and of the catalogue.
    """
    needed = [name for row in JUDGED for name in (*row.needs, *row.takes)]
    result = {
        name: ("outputs", name) for name in (*_OF_RUN, *needed) if name in _OF_RUN or name.startswith("validity_")
    }
    result |= {name: ("inputs", name) for name in _OF_SCREW} | {
        "young_modulus": ("inputs", "screw_material.young_modulus")
    }
    result |= {name: ("derived", name) for name in _DERIVED}
    result |= {name: ("given", name) for name in (*_OF_INSTALLATION, *_NOT_ASKED)}
    result |= {name: ("given", name) for name in values_of_limits(Limits())}
    result |= {f"at_rest.{name}": ("at_rest", name) for name in ("holding_torque", "valid")}
    result |= {
        "flooded_torque": ("full_bath", "screw_torque"),
        "maximum_pressure": ("checked", "maximum_pressure"),
        "rule_of_maker": ("rule", "torque"),
    }
    return {name: result[name] for name in dict.fromkeys(needed)}


# -- the module -----------------------------------------------------------------------------------


def module_of_judging() -> Judging:
    """The module of what is judged, derived and drawn."""
    programs: dict[str, tuple[tuple[str, ...], Program]] = {"judged": _judged()}
    places: dict[tuple[str, bool], str] = {}
    of_kind: dict[str, str] = {}
    for kind, chosen in kinds.KINDS.items():
        name = places.setdefault((chosen.nut, chosen.spacer_balls), f"derived_{len(places)}")
        of_kind[kind] = name
        if name not in programs:
            programs[name] = _derived(kind)
    programs |= {f"drawing_{what}": _drawing(is_row=what == "row") for what in ("row", "nut")}
    module = compiled([(name, inputs, program) for name, (inputs, program) in programs.items()])
    functions = {function.name: function for function in module.functions}
    return Judging(
        module,
        functions["judged"],
        {kind: functions[name] for kind, name in of_kind.items()},
        {what: functions[f"drawing_{what}"] for what in ("row", "nut")},
    )


def _judged() -> tuple[tuple[str, ...], Program]:
    """All that is judged; a truth value is a number that is not zero."""
    names = tuple(values())
    truths = {name for row in JUDGED for name in row.truths}
    tape = Tape(len(names))
    traced: dict[str, Any] = {name: tape.value(place) for place, name in enumerate(names)}
    traced |= {name: traced[name] != 0 for name in truths & {*names}}
    return names, merged_program(tape, outputs(judged(traced)))


def _derived(kind: str) -> tuple[tuple[str, ...], Program]:
    subject = kinds.subject_of(kinds.case_of(kinds.PAPER, kinds.MODELS[0], kind))
    names = inputs_of_structure(subject)
    every = (*names, *_FOR_DERIVED)
    tape = Tape(len(every), None, [subject.is_nonnegative(name) for name in names] + [False] * len(_FOR_DERIVED))
    traced = {name: tape.value(place) for place, name in enumerate(every)}
    here = subject.changed({name: traced[name] for name in names if name not in OPERATION})
    others = {name: traced[name] for name in ("remaining_preload", "idle_torque", "idle_losses")}
    listed = {name: traced[f"listed.{name}"] for name in LISTED}
    operation = {name: traced[name] for name in OPERATION}
    return every, merged_program(tape, derived(here.screw, **operation, **others, listed=listed))


_OF_SECTION = ("ball_diameter", "screw_conformity", "nut_conformity", "contact_angle")
_AXES = ("screw_semi_major_axis", "nut_semi_major_axis")


def _drawing(*, is_row: bool) -> tuple[tuple[str, ...], Program]:
    names = (*_OF_SECTION, *_AXES, *(("contact_load",) if is_row else ("axial_load", *BALL)))
    tape = Tape(len(names))
    of = {name: tape.value(place) for place, name in enumerate(names)}
    if is_row:
        flanks = FlankPair(of["contact_load"], of["contact_angle"], True), FlankPair(0.0, of["contact_angle"], False)
    else:
        ball = MostLoadedBall(*(of[name] for name in BALL))
        flanks = touched(ball, of["axial_load"], of["contact_angle"])
    conformities = {"screw": of["screw_conformity"], "nut": of["nut_conformity"]}
    axes = {body: of[f"{body}_semi_major_axis"] for body in conformities}
    return names, merged_program(tape, section(of["ball_diameter"], conformities, axes, flanks))


def section(
    ball_diameter: Any, conformities: Mapping[str, Any], axes: Mapping[str, Any], flanks: tuple[FlankPair, FlankPair]
) -> dict[str, Any]:
    """Places of the section across the path by name, in metres from the middle of the ball.

    ``loaded`` is the pair of flanks that carries the load, ``other`` the other pair. Of each groove and flank there are
    its edge, its bottom, its contact, and the ends of the width of the contact; the arcs have a ``radius``.
    """
    loaded, other = flanks
    radius = ball_diameter / 2
    # a flank that is not touched is drawn at the angle of the other one
    is_alone = where(other.touches, False, True)
    other_carries_more = where(is_alone, False, other.load > loaded.load)
    angle = where(loaded.touches, loaded.angle, other.angle)
    other_angle = where(is_alone, angle, other.angle)
    largest = where(other_carries_more, other.load, loaded.load)
    land = land_height(radius, where(other_angle > angle, other_angle, angle))
    result: dict[str, Any] = {"ball_radius": radius, "land": land}
    for name, flank, own in (("loaded", loaded, angle), ("other", other, other_angle)):
        result |= {f"{name}.touches": flank.touches, f"{name}.load": flank.load, f"{name}.angle": flank.angle}
        for body, outward in (("screw", -1), ("nut", 1)):
            arc = Arc.of(radius, conformities[body], own, loaded=name == "loaded", outward=outward)
            first, last = arc.around(contact_width(axes[body], flank.load, largest))
            places = {
                "edge": arc.edge(land), "bottom": arc.bottom, "contact": arc.contact, "from": first, "to": last,
            }  # fmt: skip
            result[f"{body}.{name}.radius"] = arc.radius
            for what, (x, y) in places.items():
                result |= {f"{body}.{name}.{what}.x": x, f"{body}.{name}.{what}.y": y}
    return result


# -- contents -------------------------------------------------------------------------------------


def contents_of_judging(judging: Judging) -> dict[str, Any]:
    """Data that the page has of the module: functions, tables, and where their values are from."""
    limits = fields_of(Limits)
    tables = documents()
    return {
        "file": judging.module.file,
        "judged": described(judging.judged),
        "derived": {kind: described(function) for kind, function in judging.derived.items()},
        "drawing": {what: described(function) for what, function in judging.drawing.items()},
        "tables": tables,
        "values": values(),
        "for_derived": dict(_FOR_DERIVED),
        "beside": {name: dict(changes) for name, changes in BESIDE.items()},
        "checked_as": dict(CHECKED_AS),
        "without": {kind: _without(kind) for kind in kinds.KINDS},
        "given_limit": _sentence(GIVEN_LIMIT),
        "rating_sources": list(RATING_SOURCES),
        "ends": {
            one.name.lower().replace("_", "-"): {
                "words": one.words,
                "buckling_root": one.buckling_root,
                "whirling_root": one.whirling_root,
            }
            for one in Ends
        },
        "given": {
            **{f"limits.{name}": _described(quantity, getattr(Limits(), name)) for name, quantity in limits.items()},
            **{
                name: _described(quantity, Installation.__dataclass_fields__[name].default)
                for name, quantity in fields_of(Installation).items()
                if name in _OF_INSTALLATION
            },
        },
        "units": _units(tables),
    }


def of_start(name: str) -> dict[str, Any]:
    """Listed data of the screw of a start, the limit of its DN value, and the rule of its maker."""
    row = catalogue().get(name) if name != kinds.PAPER else None
    limit = speed_limit_of(row) or GENERAL
    rule = None if row is None else rule_of(row.make)
    return {
        "listed": {one: None if row is None else getattr(row, one) for one in LISTED},
        "speed_limit": {"value": limit.value, "words": _sentence(limit.words)},
        "rule": None
        if rule is None
        else {"torque": f"drag_by_{rule.name}", "words": {"rule": rule.label, "range": _sentence(rule.range)}},
    }


def _sentence(text: str) -> dict[str, Any]:
    """A text as words stand in a sentence of the page."""
    return {"template": text, "values": {}}


def _without(kind: str) -> list[str]:
    """The values that such a nut has not, though they are computed."""
    chosen = kinds.KINDS[kind]
    of_ball = [] if not chosen.nut else ["rolling_share"]
    return [*of_ball, *(["rule_of_maker"] if chosen.spacer_balls else [])]


def _described(quantity: Quantity, default: Any) -> dict[str, Any]:
    """A quantity that is given: its unit, its bounds, and what stands for it where nothing is given."""
    bounds = {bound: getattr(quantity.info, bound) for bound in ("above", "at_least", "below", "at_most")}
    return {
        "unit": quantity.unit,
        **{bound: value for bound, value in bounds.items() if value is not None},
        "default": default if isinstance(default, int | float) else None,
    }


def _scale(unit: str, shown_in: str) -> dict[str, float]:
    quantity = Quantity("", unit, Info("", "", shown_in))
    offset = units.to_si(0.0, quantity.shown_in, quantity)
    return {"factor": units.to_si(1.0, quantity.shown_in, quantity) - offset, "offset": offset}


def _units(tables: Mapping[str, Any]) -> dict[str, dict[str, float]]:
    """The scales of all units that sentences and checks are shown in, by SI unit and unit."""
    pairs = {(one["unit"], one["shown_in"]) for one in _dicts(tables) if "shown_in" in one}
    return {f"{unit}|{shown_in}": _scale(unit, shown_in) for unit, shown_in in sorted(pairs)}


def _dicts(value: Any) -> Iterator[Mapping[str, Any]]:
    if isinstance(value, Mapping):
        yield value
    parts: Sequence[Any] = (
        list(value.values()) if isinstance(value, Mapping) else value if isinstance(value, list) else []
    )
    for part in parts:
        yield from _dicts(part)
