"""Tables of what people write, from its declarations: fields of a case file, laws, columns of tables, torque cards."""

from __future__ import annotations

import dataclasses
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ballscrew.axis.duty_cycle.axis import Axis, Motor
from ballscrew.axis.motion.profiles import Segment, Trapezoid
from ballscrew.axis.supports.bearing import MountedBearing
from ballscrew.axis.supports.element_laws import BEARING_LAWS, GUIDE_LAWS, STATICS
from ballscrew.axis.supports.guide import LinearGuide
from ballscrew.axis.thermal.surroundings import Surroundings
from ballscrew.basis import units
from ballscrew.basis.quantities import Quantity, fields_of
from ballscrew.cases.schema.case_schema import MODELS, coefficients_of, name_of_law
from ballscrew.cases.schema.duty_schema import MOTIONS
from ballscrew.cases.schema.fields import example_of
from ballscrew.cases.screw_tables.catalogue import COLUMNS
from ballscrew.cases.screw_tables.nut_kinds import ENDS, LISTED, LOSSES
from ballscrew.cases.torque_cards.torque_card import json_schema
from ballscrew.files.tables.headings import Column
from ballscrew.physics.components.materials import Lubricant, Material
from ballscrew.physics.components.nut import NUTS, Bodies, Scatter
from ballscrew.physics.components.oil_grades import DataSheet, grades
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import MATERIALS, BallScrew
from ballscrew.physics.friction.model import LAWS, FrictionModel
from ballscrew.physics.sizing.installation import Installation, Limits
from ballscrew.questions.shared.text_tables import markdown_table

EXAMPLE = Path(__file__).parents[1] / "examples" / "feed_drive.toml"

#: Sections of the file, with the class that holds their fields.
PARTS = {
    "[screw]": BallScrew,
    ", ".join(f"[screw.{name}]" for name in MATERIALS): Material,
    "[lubricant]": Lubricant,
    "[operation]": OperatingState,
    "[model]": FrictionModel,
    **{f'[nut] type = "{kind}"': cls for kind, cls in NUTS.items()},
    "[bodies]": Bodies,
    "[deviations]": Scatter,
    **{f'[losses] {slot}.law = "{name}"': law for slot, known in LOSSES.items() for name, law in known.items()},
    "[installation]": Installation,
    "[limits]": Limits,
    "[axis]": Axis,
    **{f'[motion] kind = "{kind}"': cls for kind, cls in MOTIONS.items()},
    "[[motion.segment]]": Segment,
    "[motor]": Motor,
    "[surroundings]": Surroundings,
    **{f'[bearings.fixed] law = "{law}"': cls for law, cls in BEARING_LAWS.items()},
    "[bearings.fixed], [bearings.floating], [bearings.second_fixed]": MountedBearing,
    **{f'[guides] law = "{law}"': cls for law, cls in GUIDE_LAWS.items()},
}
#: Example values of fields that the example file does not have.
OTHERS: dict[str, Any] = {"viscosity": "0.1 Pa s", "ball_to_ball_force": "0.02 N"}


def field_table() -> str:
    """One table for each table of the file."""
    return "\n".join(line for title, cls in PARTS.items() for line in _lines(title, cls)) + "\n"


def examples() -> Iterator[tuple[str, Quantity, Any]]:
    """Every field: section, quantity, and an example value."""
    for title, cls in PARTS.items():
        for quantity in fields_of(cls).values():
            yield title, quantity, _example(title, cls, quantity)


def _lines(title: str, cls: type) -> Iterator[str]:
    yield "\n" + ", ".join(f"`{name}`" for name in title.split(", ")) + "\n"
    yield "| field | symbol | example | needed | bounds | meaning |"
    yield "|---|---|---|---|---|---|"
    for name, quantity in fields_of(cls).items():
        default = _default(cls, name)
        needed = "yes" if default is dataclasses.MISSING else f"no: {_shown(default, quantity)}"
        needed = "no: of a usual size" if cls is Bodies else needed
        example = _written(_example(title, cls, quantity))
        bounds, meaning = _bounds(quantity), quantity.info.meaning
        yield f"| `{name}` | ${quantity.info.symbol}$ | `{example}` | {needed} | {bounds} | {meaning} |"
    if cls is BallScrew:
        listed = ", ".join(f"`{name}`" for name in LISTED)
        yield f"\nAlso `catalogue`, `catalogue_file`, and what catalogues list: {listed}."
    if cls is Bodies:
        yield (
            "\nAlso `same_side = false` where screw and nut are held on opposite sides of the balls, and"
            " `swelling = false` for bodies that are bars alone."
        )
    if cls is Installation:
        yield f"\nAnd `ends`, which is needed, too: {', '.join(f'`{name}`' for name in ENDS)}."
    if cls is Axis:
        yield '\nAlso `brake_holds = true`. The counterweight may be a force, too: `"1.5 kN"`.'
    if cls is Trapezoid:
        yield "\nAlso `return = false`, here and for an S-curve."
    if cls is Motor:
        yield '\nAlso `curve = [["0 rpm", "7 N m"], ["3000 rpm", "5 N m"]]`, the peak torque over the speed.'
    if cls is MountedBearing:
        yield (
            "\nAlso `law`, `catalogue` (a support unit), and its own oil, if it has one: `grade`, or `oil`"
            " with `oil_file`."
        )
    if cls is LinearGuide:
        yield (
            "\nAlso `law`, `catalogue` (a carriage), and for the load of each of four carriages: "
            + ", ".join(f"`{name}`" for name in STATICS)
            + "."
        )
    if cls is Lubricant:
        yield (
            "\nInstead of `viscosity` the fields of a data sheet: "
            + ", ".join(f"`{name}`" for name in fields_of(DataSheet))
            + "; or `oil`, a name of the library, or of a file of your own beside the case (`oil_file`); with"
            " `temperature` (-80 to 200 degC, 40 degC if left out)."
            f"\n\nOr a shortcut: `grade` ({', '.join(grades())}; `VG68` is `ISO VG 68`) and `temperature`"
            " (-20 to 150 degC, 40 degC if left out)."
        )


def _default(cls: type, name: str) -> Any:
    return next(field.default for field in dataclasses.fields(cls) if field.name == name)


def _example(title: str, cls: type, quantity: Quantity) -> Any:
    """The value of the example file, or the default."""
    name = quantity.name
    written = tomllib.loads(EXAMPLE.read_text(encoding="utf-8")).get(title.strip("[]"), {})
    if name in written:
        return written[name]
    other = OTHERS.get(name, example_of(quantity))
    if other is not None:
        return other
    value = units.from_si(_default(cls, name), quantity)
    return value if quantity.unit == "1" else f"{value:.4g} {quantity.shown_in}"


def _written(value: Any) -> str:
    return f'"{value}"' if isinstance(value, str) else f"{value}"


def _shown(default: Any, quantity: Quantity) -> str:
    return "see its meaning" if default is None else units.shown(default, quantity)


def _bounds(quantity: Quantity) -> str:
    info = quantity.info
    words = {"above": info.above, "at least": info.at_least, "below": info.below, "at most": info.at_most}
    said = [f"{word} {units.shown(bound, quantity)}" for word, bound in words.items() if bound is not None]
    usual = [] if info.usual is None else [f"usual {' to '.join(units.shown(end, quantity) for end in info.usual)}"]
    return ", ".join([*said, *(["whole"] if info.whole else []), *usual])


# -- laws ----------------------------------------------------------------------------------------------


#: Purpose of each slot.
SLOTS = {
    "frame": "geometry of the ball path",
    "hertz": "contact ellipse",
    "film": "film thickness",
    "film_parameter": "film over roughness",
    "inlet": "heat and oil supply of the inlet",
    "friction": "friction coefficient of a contact",
    "full_film": "friction of the full film",
    "rolling": "hydrodynamic rolling force",
    "elastic_resistance": "elastic resistance to rolling",
    "slip": "slip of the contacts",
    "ball_chain": "friction between neighbouring balls",
    "ball_force": "ball-to-ball force",
    "race_torques": "torques from contact forces and moments",
    "ideal_torque": "torque without friction",
}
_NAMED = ("olaru2005", "corrected", "reference")


def slots_table() -> str:
    """Laws of each named model by slot, with the names of the case file."""
    lines: list[list[str]] = []
    for slot in LAWS:
        names = [_in_slot(slot, getattr(MODELS[name], slot)) for name in _NAMED]
        # bold where it differs from the model before
        marked = [n if i == 0 or n == names[i - 1] else f"**{n}**" for i, n in enumerate(names)]
        lines.append([f"`{slot}`", SLOTS[slot], *marked])
    return markdown_table(("slot", "purpose", *(f"`{name}`" for name in _NAMED)), lines)


def _in_slot(slot: str, law: Any) -> str:
    name = name_of_law(slot, law)
    if not dataclasses.is_dataclass(law):
        return name
    defaults = type(law)()
    changed = [
        f"{field} {units.shown(getattr(law, field), quantity)}"
        for field, quantity in fields_of(law).items()
        if getattr(law, field) != getattr(defaults, field)
    ]
    return f"{name} ({', '.join(changed)})" if changed else name


def laws_table() -> str:
    """Every law by slot and name, with the first sentence of its docstring and its coefficients."""
    lines: list[list[str]] = []
    for slot, known in LAWS.items():
        for name, law in known.items():
            lines.append([f"`{slot}`", f"`{name}`", _says(law), ", ".join(_coefficients(slot, name, law))])
    return markdown_table(("slot", "name", "description", "coefficients and their defaults"), lines)


def _says(law: Any) -> str:
    if law is None:
        return "a constant, the full-film coefficient of the friction law"
    first = (law.__doc__ or "").partition("\n\n")[0]
    return " ".join(first.split())


def _coefficients(slot: str, name: str, law: Any) -> Iterator[str]:
    defaults = {field.name: field.default for field in dataclasses.fields(law)} if isinstance(law, type) else {}
    for field, quantity in coefficients_of(slot, name).items():
        yield f"`{field}` {units.shown(defaults[field], quantity)}"


# -- columns of tables of screws -----------------------------------------------------------------------


def column_table() -> str:
    """One row for each column."""
    rows = [
        (
            f"`{column.name}`",
            "" if column.quantity is None else column.quantity.info.meaning,
            "yes" if column.required else "no",
            _cells(column),
            _listed(column.aliases),
            _listed(_own_hints(column)),
        )
        for column in COLUMNS
    ]
    return markdown_table(("column", "meaning", "needed", "unit", "other names", "only beside another name"), rows)


def _cells(column: Column) -> str:
    """The unit of numbers, and what else a cell may be."""
    words = list(dict.fromkeys(column.words.values()))
    return ", or ".join([_unit(column.quantity), *(["%"] if column.share else []), *map("`{}`".format, words)])


def _unit(quantity: Quantity | None) -> str:
    if quantity is None:
        return "text"
    return "none" if quantity.unit == "1" else quantity.shown_in


def _own_hints(column: Column) -> list[str]:
    return [hint for hint in column.hints if hint not in column.aliases]


def _listed(names: tuple[str, ...] | list[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)


# -- torque cards --------------------------------------------------------------------------------------


def card_tables() -> str:
    """The sections that only a card has, field by field."""
    schema = json_schema()
    parts = {"card": "[card]", "setup": "[setup]", "points": "[[points]]"}
    found = []
    for name, title in parts.items():
        reference = schema["properties"][name]
        reference = reference.get("items", reference)["$ref"].rpartition("/")[2]
        found.append(_card_table(title, schema["$defs"][reference]))
    return "\n".join(found)


def _card_table(title, part):
    needed = part.get("required", ())
    rows = [
        (f"`{name}`", "yes" if name in needed else "", _value_of(field), field.get("description", ""))
        for name, field in part["properties"].items()
    ]
    return f"**`{title}`**\n\n{markdown_table(('field', 'needed', 'written as', 'meaning'), rows)}"


def _value_of(field):
    if "const" in field:
        return f"`{field['const']}`"
    if "enum" in field:
        return ", ".join(f'`"{value}"`' for value in field["enum"])
    if "x-unit" in field:
        return f'`"… {field["x-unit"]}"`'
    kinds = [one.get("format") or one.get("type") for one in field.get("anyOf", [field])]
    words = {"string": "text", "boolean": "`true`, `false`", "date": "a date", "number": "a number"}
    return ", ".join(words[kind] for kind in kinds if kind in words)
