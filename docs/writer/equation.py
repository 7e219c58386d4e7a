"""A formula with symbols, units and sources, such as that of ``ballscrew.physics.equations.film.film_parameter``.

Formula, letters, units, source and range come from the function itself: its docstring, the line that binds the letters,
and its annotations. So a page of theory cannot say anything else than the program does.
"""

from __future__ import annotations

import ast
import functools
import importlib
import inspect
import re
import textwrap
from collections.abc import Callable, Collection, Mapping
from typing import Any, get_type_hints

import sources

from ballscrew.basis.quantities import unit_of

_MATH = re.compile(r"^\.\. math::(?P<formula>.*(?:\n(?:[ \t]+\S.*|[ \t]*(?=\n[ \t])))*)", re.MULTILINE)
_ROLE_OF_MATH = re.compile(r":math:`([^`]*)`")
_ROLE_OF_CODE = re.compile(r":func:`~?([^`]*)`")
_ADDRESS = re.compile(r"Olaru2005\s+(§[\d.]+\s+\(\d+\))")
_GREEK = re.compile(
    "alpha|beta|gamma|delta|epsilon|zeta|eta|theta|kappa|lambda|mu|nu|xi|pi|rho|sigma|tau|phi|varphi|chi|psi|omega"
    "|Gamma|Delta|Theta|Lambda|Xi|Pi|Sigma|Phi|Psi|Omega"
)
_UNITS = {"1": "", "N m": "N m", "m^2/s": "m²/s", "kg/m^3": "kg/m³", "1/m^2": "1/m²", "N/m^1.5": "N/m¹·⁵"}


#: What belongs to a formula, in its order on the page.
SHOWN = ("title", "formula", "letters", "remark")


def as_markdown(name: str, up: str, shown: Collection[str] = SHOWN, known: Mapping[str, str] | None = None) -> str:
    """The formula of a function of ``ballscrew.physics.equations``, with all that belongs to it; ``up``: to ``docs``.

    ``shown`` leaves out what another place says: the remark on a formula that an erratum repeats. Letters that are
    ``known``, with the same meaning and unit, are not explained again.

    Raises:
        ValueError: there is no such function, it has no formula, a parameter has no letter, or nothing is called so.
    """
    if unknown := set(shown) - set(SHOWN):
        raise ValueError(f"{name}: a formula has no {', '.join(sorted(unknown))}")
    function, head, formula, rest = _read(name)
    short = name.removeprefix("ballscrew.physics.equations.")
    source = f"{up}../src/{name.rpartition('.')[0].replace('.', '/')}.py"
    parts = {
        "title": f"**{_plain(head)}**",
        "formula": f"$$\n{formula}\n$$",
        "letters": _legend(letters(name), known or {}, _unit(_hints(function).get("return"))),
        "remark": _cited(_plain(rest), up),
    }
    paragraphs = [*(parts[part] for part in SHOWN if part in shown and parts[part]), f"[`{short}`]({source})"]
    if len(paragraphs) > 2:  # a formula alone needs no box
        paragraphs = ['<div class="equation">', *paragraphs, "</div>"]
    return "\n\n".join(paragraphs) + "\n"


@functools.cache
def letters(name: str) -> dict[str, str]:
    """What each letter of a formula stands for, with its unit, from the bindings and annotations of the function."""
    function, _, formula, _ = _read(name)
    hints, bound = _hints(function), _letters(function)
    missing = set(inspect.signature(function).parameters) - set(bound)
    if missing:
        raise ValueError(f"{name}: no letter for {', '.join(sorted(missing))}")
    return {
        tex(letter, formula): f"{parameter.replace('_', ' ')}{_unit(hints.get(parameter))}"
        for parameter, letter in bound.items()
    }


def _read(name: str) -> tuple[Callable[..., Any], str, str, str]:
    """A function, and what its docstring says before its formula, in it and after it."""
    module_name, _, function_name = name.rpartition(".")
    try:
        function = getattr(importlib.import_module(module_name), function_name)
    except (ImportError, AttributeError, ValueError) as error:
        raise ValueError(f"{name}: there is no such function ({error})") from error
    doc = inspect.getdoc(function) or ""
    found = _MATH.search(doc)
    if found is None:
        raise ValueError(f"{name}: its docstring has no formula")
    formula = " ".join(line.strip() for line in found["formula"].splitlines()).strip()
    return function, doc[: found.start()].strip(), formula, doc[found.end() :].strip()


def _hints(function: Callable[..., Any]) -> dict[str, Any]:
    return get_type_hints(function, include_extras=True)


def _plain(text: str) -> str:
    """The few roles of docstrings, in Markdown."""
    text = _ROLE_OF_MATH.sub(lambda role: f"${' '.join(role[1].split())}$", text)
    text = _ROLE_OF_CODE.sub(lambda role: f"`{role[1].rpartition('.')[2]}`", text)
    if ":`" in text:
        raise ValueError(f"a role that pages do not know: {text}")
    return text


def _cited(text: str, up: str) -> str:
    """Keys of the bibliography as citations, addresses in the paper as links to the table of its equations."""
    text = _ADDRESS.sub(
        lambda found: f"[{'p' if found.start() else 'P'}aper {' '.join(found[1].split())}]({up}equations.md)", text
    )
    for key in sources.known():
        text = re.sub(rf"\b{re.escape(key)}\b", sources.link(key, up), text)
    return text


def _legend(meanings: Mapping[str, str], known: Mapping[str, str], result: str) -> str:
    """Each letter that is not known, with its meaning, and the unit of the result."""
    said = ", ".join(f"${letter}$ {meaning}" for letter, meaning in meanings.items() if known.get(letter) != meaning)
    if not said:
        return f"The result{result}." if result else ""
    return said + (f"; the result{result}." if result else ".")


def _unit(annotation: object) -> str:
    unit = unit_of(annotation) or "1"
    shown = _UNITS.get(unit, unit)
    return f" ({shown})" if shown else ""


def _letters(function: Callable[..., Any]) -> dict[str, str]:
    """Symbols by parameter, from the lines ``a, b = first, second`` of the function."""
    tree = ast.parse(textwrap.dedent(inspect.getsource(function)))
    found: dict[str, str] = {}
    parameters = set(inspect.signature(function).parameters)
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign) and len(node.targets) == 1:
            target, value = node.targets[0], node.value
            pairs = (
                zip(target.elts, value.elts, strict=True)
                if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple)
                else [(target, value)]
            )
            for left, right in pairs:
                if isinstance(left, ast.Name) and isinstance(right, ast.Name) and right.id in parameters:
                    found[right.id] = left.id
    return {name: found[name] for name in inspect.signature(function).parameters if name in found}


def tex(letter: str, formula: str) -> str:
    """A symbol of the code in the notation of the formula: ``sigma_b`` as ``\\sigma_b``."""
    base, _, index = letter.partition("_")
    written = _symbol(base, formula)
    if not index:
        return f"{written}'" if f"{written}'" in formula else written
    return f"{written}_{{{_symbol(index, formula)}}}"


def _symbol(word: str, formula: str) -> str:
    if word == "lam":
        word = "lambda"
    if word == "phi" and r"\varphi" in formula:
        word = "varphi"
    return f"\\{word}" if _GREEK.fullmatch(word) else word
