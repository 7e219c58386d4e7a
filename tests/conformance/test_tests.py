"""No test ends before its last assertion: what cannot be tested is skipped with a reason, or not a case of the test."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[1]
_OF_THEIR_OWN = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda, ast.ClassDef)


def returns(test: ast.AST) -> Iterator[int]:
    """The lines of ``return`` in a function, apart from those of functions within it."""
    for node in ast.iter_child_nodes(test):
        if isinstance(node, ast.Return):
            yield node.lineno
        elif not isinstance(node, _OF_THEIR_OWN):
            yield from returns(node)


def written_tests(module: ast.Module) -> Iterator[ast.FunctionDef | ast.AsyncFunctionDef]:
    for node in ast.walk(module):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and node.name.startswith("test_"):
            yield node


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("assert a", []),
        ("if a: return\n assert b", [2]),
        ("for x in a:\n  with b:\n   try: c\n   except E: return", [5]),
        ("def inner(): return 1\n class C:\n  def m(self): return 1\n assert inner()", []),
    ],
)
def test_an_early_end_is_found(body, expected):
    (test,) = written_tests(ast.parse(f"def test_it():\n {body}"))
    assert list(returns(test)) == expected


@pytest.mark.slow
def test_no_test_returns_early():
    files = sorted(TESTS.rglob("test_*.py"))
    modules = {path.relative_to(TESTS).as_posix(): ast.parse(path.read_text(encoding="utf-8")) for path in files}
    tests = [(name, test) for name, module in modules.items() for test in written_tests(module)]
    assert len(tests) > 2000
    assert [f"{name}:{line} {test.name}" for name, test in tests for line in returns(test)] == []
