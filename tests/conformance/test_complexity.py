"""No function has more branches than a reader can follow."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

import ballscrew

#: Branches, loops, excepts and operands that a function may have, and one.
MOST = 25
_BRANCHES = (ast.If, ast.IfExp, ast.For, ast.AsyncFor, ast.While, ast.ExceptHandler, ast.Assert, ast.match_case)


def complexity(function: ast.AST) -> int:
    """One, and one for each branch, loop, except and assertion, each further operand of ``and`` and ``or``, and each
    loop and condition of a comprehension; those of functions within it count, too.
    """
    found = 1
    for node in ast.walk(function):
        if isinstance(node, _BRANCHES):
            found += 1
        elif isinstance(node, ast.BoolOp):
            found += len(node.values) - 1
        elif isinstance(node, ast.comprehension):
            found += 1 + len(node.ifs)
    return found


def functions_in(folder: Path) -> Iterator[tuple[str, ast.AST]]:
    """The functions of the modules in a folder by file and name, without methods."""
    for path in sorted(folder.rglob("*.py")):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                yield f"{path.relative_to(folder).as_posix()} {node.name}", node


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("return 1", 1),
        ("if a: return 1\n elif b: return 2\n else: return 3", 3),
        ("return 1 if a else 2", 2),
        ("for x in a: pass\n while b: pass", 3),
        ("return a and b and (c or d)", 4),
        ("return [x for x in a if x if b for y in x]", 5),
        ("try: a()\n except ValueError: b()\n except KeyError: c()\n finally: d()", 3),
        ("assert a\n with b: pass", 2),
        ("match a:\n  case 1: pass\n  case _: pass", 3),
        ("def inner():\n  if a: pass\n return inner", 2),
    ],
)
def test_complexity_counts_what_branches(body, expected):
    (function,) = ast.parse(f"def f(a, b, c, d):\n {body}").body
    assert complexity(function) == expected


@pytest.mark.slow
def test_functions_are_found_in_every_folder():
    (folder,) = ballscrew.__path__
    found = [name for name, _ in functions_in(Path(folder))]
    assert {name.partition("/")[0] for name in found} >= {"basis", "physics", "questions", "faces"}
    assert len(found) > 2000


@pytest.mark.slow
def test_no_function_is_too_complex():
    (folder,) = ballscrew.__path__
    counted = {name: complexity(function) for name, function in functions_in(Path(folder))}
    assert {name: count for name, count in counted.items() if count > MOST} == {}
