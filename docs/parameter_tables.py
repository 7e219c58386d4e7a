"""Parameters of what ``import ballscrew as bs`` offers, as tables: name, unit, type, default, meaning.

Units are those of the annotations (:mod:`ballscrew.basis.quantities`). A meaning is that of the annotation, else of the
comment ``#:`` of the field, else of ``parameter_meanings.toml``.
"""

from __future__ import annotations

import dataclasses
import functools
import inspect
import re
import tomllib
import typing
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, get_type_hints

import ballscrew
from ballscrew.basis import quantities
from ballscrew.basis.field_docs import comments_of, words_of
from ballscrew.basis.quantities import info_of, unit_of

PAGE = Path(__file__).with_name("reference.md")
MEANINGS = Path(__file__).with_name("parameter_meanings.toml")
#: Functions that compute element by element; parts of a screw and its operating point do so, too.
ELEMENTWISE = (
    *("band", "breakaway", "nut_friction", "off_line_balls", "CalibratedModel.predict", "CalibratedModel.band"),
    *("Axis.carriage_loads", "Axis.guide_friction", "ContactGuide.under", "LinearGuide.under"),
)
_ELEMENTWISE_PARTS = ("ballscrew.physics.components.", "ballscrew.physics.friction.")
#: Logs, whose fields have one number for each row.
_LOGS = ("ballscrew.files.torque_logs.", "ballscrew.evidence.moving_logs.moving_log")
#: A public class of the page, and the members that it lists; none where it lists all.
_LISTED = re.compile(r"^\.\. autoclass:: ballscrew\.(\w+)\n   :members:(.*)$", re.MULTILINE)
_ANNOTATED = re.compile(r"^Annotated\[(.*)\]$", re.DOTALL)
_OPTIONAL = re.compile(r" \| None$")
#: The module before the name of a class.
_MODULES = re.compile(r"\b(?:[a-z_]+\.)+(?=[A-Z])")


@dataclasses.dataclass(frozen=True)
class Row:
    """One parameter; ``unit`` and ``meaning`` are empty where there is none."""

    name: str
    unit: str
    kind: str
    default: str
    meaning: str


@functools.cache
def meanings() -> Mapping[str, Mapping[str, str]]:
    """Meanings by function or class, and those of names that mean the same everywhere."""
    return tomllib.loads(MEANINGS.read_text(encoding="utf-8"))


@functools.cache
def public() -> dict[str, Any]:
    """The functions and classes that the package offers, by name."""
    found = {name: getattr(ballscrew, name) for name in ballscrew.__all__}
    return {name: value for name, value in found.items() if callable(value)}


@functools.cache
def methods() -> dict[str, Any]:
    """The methods of public classes that stand on the page of the Python reference and take something, by name."""
    found: dict[str, Any] = {}
    for name, listed in _LISTED.findall(PAGE.read_text(encoding="utf-8")):
        cls = public().get(name)
        every = [one for one in vars(cls or object) if not one.startswith("_")]
        for method in listed.replace(",", " ").split() or every:
            function = getattr(cls, method, None)
            if (inspect.isfunction(function) or inspect.ismethod(function)) and [*_parameters(function)]:
                found[f"{name}.{method}"] = function
    return found


def takes_nothing_of_its_own(value: Any) -> bool:
    """True for an exception or a warning that is made as any other is."""
    return isinstance(value, type) and issubclass(value, BaseException) and "__init__" not in vars(value)


def rows_of(name: str) -> list[Row]:
    """The parameters of a public function or method, or of the constructor of a public class, in their order."""
    value = public()[name] if name in public() else methods()[name]
    if takes_nothing_of_its_own(value):
        return []
    hints = _hints(value)
    shown = comments_of(value) if isinstance(value, type) else {}
    return [_row(name, value, parameter, hints, shown) for parameter in _parameters(value)]


def _parameters(value: Any) -> Iterator[inspect.Parameter]:
    for parameter in inspect.signature(value).parameters.values():
        if parameter.name not in ("self", "cls"):
            yield parameter


def _hints(value: Any) -> Mapping[str, Any]:
    """The annotations; those of names that type checkers alone have stay away."""
    if isinstance(value, type) and "__init__" not in vars(value):
        return get_type_hints(value, include_extras=True)
    if dataclasses.is_dataclass(value) and isinstance(value, type):
        return get_type_hints(value, include_extras=True)
    function: Any = inspect.unwrap(vars(value)["__init__"] if isinstance(value, type) else value)
    known = {**vars(typing), **vars(quantities), **function.__globals__}
    found: dict[str, Any] = {}
    for name, annotation in function.__annotations__.items():
        try:
            found[name] = eval(annotation, known) if isinstance(annotation, str) else annotation
        except (NameError, AttributeError):
            continue
    return found


def _row(
    of: str, value: Any, parameter: inspect.Parameter, hints: Mapping[str, Any], comments: Mapping[str, str]
) -> Row:
    name, hint = parameter.name, hints.get(parameter.name)
    unit, info = unit_of(hint), _info(hint)
    stars = {parameter.VAR_POSITIONAL: "*", parameter.VAR_KEYWORD: "**"}.get(parameter.kind, "")
    own = meanings().get(of, {}).get(name)
    common = None if isinstance(value, type) else meanings()["common"].get(name)
    meaning = own or (info and words_of(info)) or _begun_small(comments.get(name, "")) or common or ""
    return Row(
        stars + name,
        "" if unit in (None, "1") else str(unit),
        _kind(of, value, parameter, hint),
        "" if stars else _default(parameter),
        meaning,
    )


def _begun_small(sentence: str) -> str:
    """A sentence of a comment as the other meanings are written."""
    return sentence[:1].lower() + sentence[1:] if sentence[1:2].islower() or sentence[1:2] == " " else sentence


def _info(hint: Any) -> quantities.Info | None:
    """The description in an annotation, also inside ``… | None``."""
    found = info_of(hint)
    return found or next((one for one in map(info_of, typing.get_args(hint)) if one is not None), None)


def _kind(of: str, value: Any, parameter: inspect.Parameter, hint: Any) -> str:
    """The type in words for a quantity, else as it is annotated."""
    info = _info(hint)
    if unit_of(hint) is not None:
        owner = value if isinstance(value, type) else public().get(of.rpartition(".")[0])
        module = owner.__module__ if owner else ""
        if module.startswith(_LOGS):
            return "array"
        number = "whole number" if info is not None and info.whole else "number"
        many = of in ELEMENTWISE or module.startswith(_ELEMENTWISE_PARTS)
        return f"{number} or array" if many else number
    literals = [one for one in (hint, *typing.get_args(hint)) if typing.get_origin(one) is typing.Literal]
    if literals:
        return ", ".join(f'``"{value}"``' for value in typing.get_args(literals[0]))
    text = parameter.annotation
    text = text if isinstance(text, str) else inspect.formatannotation(text)
    inner = _ANNOTATED.match(text)
    text = _MODULES.sub("", inner[1].split(", ")[0] if inner else text)
    return f"``{_OPTIONAL.sub('', text)}``"


def _default(parameter: inspect.Parameter) -> str:
    default = parameter.default
    if default is inspect.Parameter.empty:
        return "needed"
    if type(default).__name__ == "_HAS_DEFAULT_FACTORY_CLASS":
        return "empty"
    return _shown(default)


def _shown(default: Any) -> str:
    if isinstance(default, bool) or default is None:
        return f"``{default}``"
    if isinstance(default, int | float):
        return f"``{default:.6g}``"
    if isinstance(default, str | tuple):
        return f"``{default!r}``" if default else "empty"
    if callable(default) and hasattr(default, "__name__"):
        return f"``{default.__name__}``"
    return f"``{type(default).__name__}(…)``"


def lines_of(name: str) -> list[str]:
    """The table of a function or class as reStructuredText; no line where it takes nothing."""
    rows = rows_of(name)
    if not rows:
        return []
    lines = [".. list-table::", "   :header-rows: 1", "   :class: parameters", ""]
    cells = [("parameter", "unit", "type", "default", "meaning")]
    cells += [(f"``{row.name}``", row.unit or "–", row.kind, row.default or "–", row.meaning) for row in rows]
    for row in cells:
        lines += [f"   {'* -' if not index else '  -'} {cell}" for index, cell in enumerate(row)]
    return ["", *lines, ""]
