"""Directive ``{equation} ballscrew.physics.equations.film.film_parameter``: a formula with symbols, units, sources.

Formula, letters, units, source and range come from the function itself: its docstring, the line that binds the letters,
and its annotations. So a page of theory cannot say anything else than the program does.
"""

from __future__ import annotations

import ast
import importlib
import inspect
import re
import textwrap
from collections.abc import Callable
from typing import Any, get_type_hints

from docutils import nodes
from myst_parser.mdit_to_docutils.base import make_document
from myst_parser.mocking import MockRSTParser
from sphinx.util.docutils import SphinxDirective

from ballscrew.basis.quantities import unit_of
from ballscrew.basis.references import bibliography

_MATH = re.compile(r"^\.\. math::(?P<formula>.*(?:\n(?:[ \t]+\S.*|[ \t]*(?=\n[ \t])))*)", re.MULTILINE)
_ADDRESS = re.compile(r"Olaru2005\s+(§[\d.]+\s+\(\d+\))")
_GREEK = re.compile(
    "alpha|beta|gamma|delta|epsilon|zeta|eta|theta|kappa|lambda|mu|nu|xi|pi|rho|sigma|tau|phi|varphi|chi|psi|omega"
    "|Gamma|Delta|Theta|Lambda|Xi|Pi|Sigma|Phi|Psi|Omega"
)
_UNITS = {"1": "", "N m": "N m", "m^2/s": "m²/s", "kg/m^3": "kg/m³", "1/m^2": "1/m²", "N/m^1.5": "N/m¹·⁵"}


class Equation(SphinxDirective):
    """The formula of a function of ``ballscrew.physics.equations``; the content of the directive is not used."""

    required_arguments = 1
    has_content = False

    def run(self) -> list[nodes.Node]:
        name = self.arguments[0]
        module_name, _, function_name = name.rpartition(".")
        try:
            module = importlib.import_module(module_name)
            function = getattr(module, function_name)
        except (ImportError, AttributeError, ValueError) as error:
            raise self.error(f"{name}: there is no such function ({error})") from error
        try:
            text = _as_rst(name, function, self._up() + f"_modules/{module_name.replace('.', '/')}.html")
        except ValueError as error:
            raise self.error(f"{name}: {error}") from error
        self.env.note_dependency(inspect.getsourcefile(module) or "")
        box = nodes.container(classes=["equation"])
        box += self._parsed(text, module_name)
        paragraphs = [node for node in box.children if isinstance(node, nodes.paragraph)]
        paragraphs[0]["classes"].append("equation-what")
        paragraphs[-1]["classes"].append("equation-links")
        return [box]

    def _up(self) -> str:
        return "../" * self.env.docname.count("/")

    def _parsed(self, text: str, module_name: str) -> list[nodes.Node]:
        """Parse the text as reStructuredText, the format of docstrings, on a Markdown page."""
        document = make_document()
        document["source"] = self.state.document["source"]
        document.settings = self.state.document.settings
        document.reporter = self.state.document.reporter
        before = self.env.ref_context.get("py:module")
        self.env.ref_context["py:module"] = module_name
        try:
            MockRSTParser().parse("\n" * self.lineno + text, document)
        finally:
            self.env.ref_context["py:module"] = before
        return list(document.children)


def _as_rst(name: str, function: Callable[..., Any], source: str) -> str:
    doc = inspect.getdoc(function) or ""
    found = _MATH.search(doc)
    if found is None:
        raise ValueError("its docstring has no formula")
    formula = textwrap.dedent("\n".join(line.strip() for line in found["formula"].splitlines())).strip()
    head, rest = doc[: found.start()].strip(), doc[found.end() :].strip()
    short = name.removeprefix("ballscrew.physics.equations.")
    links = [f":py:func:`{short} <{name}>`", f"`source <{source}#{name.rpartition('.')[2]}>`__"]
    lines = [
        head,
        "",
        f".. math:: {formula.replace(chr(10), ' ')}",
        "",
        _legend(function, formula),
        "",
        *([_cited(rest), ""] if rest else []),
        " · ".join(links),
        "",
    ]
    return "\n".join(lines)


def _cited(text: str) -> str:
    """Keys of the bibliography as citations, addresses in the paper as links to the table of equations."""
    text = _ADDRESS.sub(r"Olaru2005 :doc:`\1 </equations>`", text)
    for key in bibliography():
        text = re.sub(rf"\b{re.escape(key)}\b", f":cite:t:`{key}`", text)
    return text


def _legend(function: Callable[..., Any], formula: str) -> str:
    """Each symbol with its meaning and unit, from the bindings and annotations of the function."""
    hints = get_type_hints(function, include_extras=True)
    letters = _letters(function)
    missing = set(inspect.signature(function).parameters) - set(letters)
    if missing:
        raise ValueError(f"no letter for {', '.join(sorted(missing))}")
    said = [
        f":math:`{tex(letter, formula)}` {parameter.replace('_', ' ')}{_unit(hints.get(parameter))}"
        for parameter, letter in letters.items()
    ]
    result = _unit(hints.get("return"))
    return ", ".join(said) + (f"; the result{result}." if result else ".")


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


def setup(app: Any) -> dict[str, bool]:
    app.add_directive("equation", Equation)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
