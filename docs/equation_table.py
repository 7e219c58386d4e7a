"""The equations of the paper: each with the function that implements it and the tests that check it.

Nothing is written by hand: what an equation is and the verdict on it come from the package's data,
the functions from the addresses in their docstrings, the tests from their ``equation`` markers.
"""

from __future__ import annotations

import ast
import importlib
import inspect
import pkgutil
from collections.abc import Iterator
from pathlib import Path

import ballscrew.physics.equations
from ballscrew.basis.references import addresses_in, paper_equations
from ballscrew.questions.shared.text_tables import markdown_table

TESTS = Path(__file__).resolve().parents[1] / "tests"


def functions() -> dict[str, list[str]]:
    """For each address, the functions of ``ballscrew.physics.equations`` whose docstrings name it."""
    found: dict[str, list[str]] = {}
    for module_info in pkgutil.iter_modules(ballscrew.physics.equations.__path__):
        module = importlib.import_module(f"ballscrew.physics.equations.{module_info.name}")
        for name, function in inspect.getmembers(module, inspect.isfunction):
            if function.__module__ == module.__name__ and not name.startswith("_"):
                for address in dict.fromkeys(addresses_in(inspect.getdoc(function))):
                    found.setdefault(address, []).append(f"{module_info.name}.{name}")
    return found


def is_marker(node: ast.AST) -> bool:
    """True for ``pytest.mark.equation``."""
    return (
        isinstance(node, ast.Attribute)
        and node.attr == "equation"
        and isinstance(node.value, ast.Attribute)
        and node.value.attr == "mark"
    )


def marked(tree: ast.Module) -> Iterator[tuple[str, list[str]]]:
    """The marked tests of a file and their addresses; only functions carry the marker."""
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            addresses = [
                ast.literal_eval(argument)
                for decorator in node.decorator_list
                if isinstance(decorator, ast.Call) and is_marker(decorator.func)
                for argument in decorator.args
            ]
            if addresses:
                yield node.name, addresses


def tests() -> dict[str, list[str]]:
    """For each address, the tests that are marked with it, as ``folder/file::test``."""
    found: dict[str, list[str]] = {}
    for path in sorted(TESTS.rglob("test_*.py")):
        for name, addresses in marked(ast.parse(path.read_text(encoding="utf-8"))):
            for address in dict.fromkeys(addresses):
                found.setdefault(address, []).append(f"{path.relative_to(TESTS).as_posix()}::{name}")
    return found


def table() -> str:
    """The equations by their addresses."""
    by_function, by_test = functions(), tests()

    def code(names: list[str]) -> str:
        return ", ".join(f"`{name}`" for name in names)

    rows = [
        (
            equation.address.removeprefix("Olaru2005 "),
            equation.what,
            equation.verdict,
            code(by_function.get(equation.address, [])),
            code(by_test.get(equation.address, [])),
        )
        for equation in paper_equations()
    ]
    return markdown_table(("address", "what", "verdict", "functions", "tests"), rows)
