"""Docstrings open with a noun phrase or a verb; equations have a sentence, a formula, and units of all values."""

import ast
import inspect
import re

import pytest

from ballscrew.basis.references import bibliography
from support.commands import ROOT
from support.rules import for_each

from .discovery import EQUATIONS, RECURRENCES
from .formulas import formula_of

#: Words that open neither a noun phrase nor a verb.
NO_OPENING = re.compile(r"(?:What|Whether|How|Who|Where|When|Which|Why|That|By|Of|From|As|At|For|In|To|With)\b")
DOCUMENTED = ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef


def test_a_docstring_opens_with_a_noun_phrase_or_a_verb():
    wrong = []
    for path in sorted((ROOT / "src").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            text = ast.get_docstring(node) if isinstance(node, DOCUMENTED) else None
            if text and NO_OPENING.match(text):
                wrong.append(f"{path.relative_to(ROOT).as_posix()}:{node.body[0].lineno}: {text.splitlines()[0]}")
    assert wrong == []


@for_each(equation=EQUATIONS)
def test_a_sentence_comes_first(equation):
    lines = (inspect.getdoc(equation.function) or "").split("\n\n")
    assert lines[0].endswith(".")
    assert lines[0][0].isupper()


@for_each(equation=EQUATIONS)
def test_there_is_a_formula(equation):
    assert (formula_of(equation.function) is None) == (equation.name in RECURRENCES)


@for_each(equation=EQUATIONS)
def test_every_parameter_has_a_unit(equation):
    assert [name for name, unit in equation.units.items() if unit is None] == []


@for_each(equation=EQUATIONS)
def test_every_result_has_a_unit(equation):
    assert None not in equation.return_units


@for_each(equation=EQUATIONS)
def test_parameters_have_no_defaults(equation):
    # Physics has no defaults; those belong to components and models.
    for parameter in inspect.signature(equation.function).parameters.values():
        assert parameter.default is inspect.Parameter.empty
        assert parameter.kind is inspect.Parameter.POSITIONAL_OR_KEYWORD


def test_a_name_has_one_unit_everywhere():
    units: dict[str, set[str]] = {}
    for equation in EQUATIONS.values():
        for name, unit in equation.units.items():
            units.setdefault(name, set()).add(str(unit))
        if len(equation.return_units) == 1:
            units.setdefault(equation.name.partition(".")[2], set()).add(str(equation.return_units[0]))
    assert {name: found for name, found in units.items() if len(found) > 1} == {}


def test_units_are_coherent(registry):
    for equation in EQUATIONS.values():
        for unit in [*equation.units.values(), *equation.return_units]:
            if unit is not None:
                assert registry.Quantity(1.0, unit).to_base_units().magnitude == pytest.approx(1.0)


@for_each(equation=EQUATIONS)
def test_sources_look_like_keys_of_the_bibliography(equation):
    # A word such as "HamrockDowson1977" names a source, and the source must be known.
    words = (inspect.getdoc(equation.function) or "").replace(",", " ").replace(".", " ").replace(";", " ").split()
    keys = {word for word in words if word[:1].isupper() and word[-4:].isdigit() and word[:-4].isalpha()}
    assert keys <= set(bibliography())
