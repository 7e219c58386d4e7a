"""Reads the formula of a docstring and the letters of a function, and compares the two.

The formula is the first ``.. math::`` block; the letters are those of the tuple assignments at the
top of the body, ``E, R_x, k = equivalent_modulus, rolling_radius, radii_ratio``.
"""

import ast
import functools
import inspect
import re
import textwrap
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any
from unittest import mock

import sympy
from antlr4 import PredictionMode
from antlr4.atn.ParserATNSimulator import ParserATNSimulator
from sympy.core.function import AppliedUndef
from sympy.parsing.latex import parse_latex
from sympy.parsing.latex._antlr import latexparser

from .discovery import Equation

_BLOCK = re.compile(r"\.\. math:: (?P<formula>.*?)(?:\n\s*\n|\Z)", re.DOTALL)
#: LaTeX has two small phis, and ``lambda`` is a word of Python.
_OTHER_SPELLINGS = {"varphi": "phi", "lambda": "lam"}
_FUNCTIONS = {"min": sympy.Min, "max": sympy.Max}

_GREEK = "alpha|beta|gamma|delta|eta|kappa|lambda|mu|nu|omega|Omega|phi|varphi|pi|rho|sigma|tau|xi"
#: A letter before a bracket is a factor, but the parser would take it for a function.
_FACTOR = re.compile(rf"(?<![A-Za-z\\])((?:[A-Za-z]|\\(?:{_GREEK}))'?(?:_\{{[^}}]*\}})?)\s*(?=(?:\\left)?\()")

#: Floats of the formula and of the code carry 53 bits; the evaluation itself carries 30 digits.
RELATIVE = 1e-13
POINTS = 5


def formula_of(function: Callable[..., Any]) -> str | None:
    """The first formula of a docstring, on one line."""
    match = _BLOCK.search(inspect.getdoc(function) or "")
    return " ".join(match["formula"].split()) if match else None


@functools.cache
def letters_of(function: Callable[..., Any]) -> dict[str, str]:
    """The letter of each parameter that the body binds to one."""
    (definition,) = ast.parse(textwrap.dedent(inspect.getsource(function))).body
    assert isinstance(definition, ast.FunctionDef)
    parameters = {argument.arg for argument in definition.args.args}
    letters: dict[str, str] = {}
    for statement in definition.body:
        if not isinstance(statement, ast.Assign):
            continue
        (target,) = statement.targets
        targets = target.elts if isinstance(target, ast.Tuple) else [target]
        values = statement.value.elts if isinstance(statement.value, ast.Tuple) else [statement.value]
        for letter, value in zip(targets, values, strict=False):
            if isinstance(letter, ast.Name) and isinstance(value, ast.Name) and value.id in parameters:
                letters[value.id] = letter.id
    return letters


def spelling(symbol: str) -> str:
    """The name of a LaTeX symbol as Python spells it: ``M_{E*R}`` is ``M_ER``, ``E'`` is ``E``."""
    name = re.sub(r"[{}*'\\ ]", "", symbol)
    head, *subscript = name.split("_")
    return "_".join([_OTHER_SPELLINGS.get(head, head), *subscript])


class _QuickPrediction(ParserATNSimulator):
    """Prediction without the context of the rules: the same tree or an error of syntax, in a quarter of the time."""

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self.predictionMode = PredictionMode.SLL


@functools.cache
def parsed(formula: str) -> sympy.Eq:
    """A formula as SymPy reads it, its symbols spelled as in the code."""
    # An unbraced subscript confuses the parser where a differential might stand: c_d R_x.
    braced = re.sub(r"_(\\[A-Za-z]+|[A-Za-z0-9])", r"_{\1}", formula)
    with mock.patch.object(latexparser, "ParserATNSimulator", _QuickPrediction):
        equation = parse_latex(_FACTOR.sub(r"\1 \\cdot ", braced), backend="antlr", strict=True)
    assert isinstance(equation, sympy.Eq), formula

    def canonical(node: Any) -> Any:
        if isinstance(node, sympy.Symbol):
            name = spelling(node.name)
            return sympy.pi if name == "pi" else sympy.Symbol(name, positive=True)
        if not node.args:
            return node
        arguments = [canonical(argument) for argument in node.args]
        if isinstance(node, AppliedUndef):
            return _FUNCTIONS[node.func.__name__](*arguments)
        return node.func(*arguments)

    return sympy.Eq(canonical(equation.lhs), canonical(equation.rhs), evaluate=False)


#: A number of a formula; the digit of a subscript is part of a name, and that of ``\sinh^{-1}`` of the function's.
NUMBER = re.compile(r"(?<![\d_.])(?<!_\{)(?<![A-Z])(?<!sinh\^\{-)\d+(?:\.\d+)?")


def lettered(formula: str) -> tuple[str, dict[str, str]]:
    """A formula with a letter in place of each of its numbers, and the numbers by letter: read once, changed often."""
    numbers: dict[str, str] = {}

    def letter(match: re.Match[str]) -> str:
        name = f"{chr(ord('a') + len(numbers) // 26)}{chr(ord('a') + len(numbers) % 26)}"
        numbers[f"Z_{name}"] = match[0]
        return f"{{Z_{{{name}}}}}"

    return NUMBER.sub(letter, formula), numbers


@functools.cache
def evaluated(equation: Equation, point: int) -> tuple[Mapping[sympy.Symbol, sympy.Rational], Any]:
    """The parameters of an equation at a point, by their letters, and what the code makes of them with 30 digits."""
    letters = letters_of(equation.function)
    symbols = {name: sympy.Symbol(letters[name], positive=True) for name in equation.parameters}
    (from_code,) = equation(*symbols.values())
    columns = equation.sample(POINTS)
    values = {symbols[name]: sympy.Rational(float(column[point])) for name, column in columns.items()}
    return values, from_code.evalf(30, subs=values)


def differences(equation: Equation, formula: str, numbers: Mapping[str, str] = MappingProxyType({})) -> list[str]:
    """What is different between a formula and the code; empty if nothing is.

    ``numbers`` are those that letters of the formula stand for.
    """
    letters = letters_of(equation.function)
    unbound = [name for name in equation.parameters if name not in letters]
    if unbound:
        return [f"no letter is bound to {', '.join(unbound)}"]
    if len(set(letters.values())) < len(letters):
        return ["one letter is bound to two parameters"]
    read = parsed(formula)
    in_formula, in_code = {symbol.name for symbol in read.rhs.free_symbols} - set(numbers), set(letters.values())
    found = [f"the formula has no {letter}" for letter in sorted(in_code - in_formula)]
    found += [f"the code has no {letter}" for letter in sorted(in_formula - in_code)]
    if not isinstance(read.lhs, sympy.Symbol) or read.lhs in read.rhs.free_symbols:
        found.append("the left side is not one new symbol")
    if found:
        return found
    given = {sympy.Symbol(name, positive=True): sympy.Rational(number) for name, number in numbers.items()}
    for point in range(POINTS):
        values, ours = evaluated(equation, point)
        theirs = read.rhs.evalf(30, subs={**values, **given})
        # a zero is no Float
        assert ours.is_Number, f"{equation.name} gives no number at {values}"
        assert ours.is_finite, f"{equation.name} gives no finite number at {values}"
        if not (theirs.is_Number and abs(ours - theirs) <= RELATIVE * abs(ours)):
            return [f"code {ours}, formula {theirs} at {values}"]
    return []
