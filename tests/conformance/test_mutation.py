"""The one-line changes of ``make mutate``: each is one, is Python, and has a name of its own."""

import ast
import importlib.util
import sys
from pathlib import Path

import pytest

TOOLS = Path(__file__).parents[2] / "tools" / "mutation"


@pytest.fixture(scope="module")
def changes():
    """The module that finds them."""
    spec = importlib.util.spec_from_file_location("mutation_changes", TOOLS / "changes.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # a named tuple looks for its module there
    spec.loader.exec_module(module)
    yield module
    del sys.modules[spec.name]


def found(changes, tmp_path, text, name="part.py"):
    file = tmp_path / name
    file.write_text(text, encoding="utf-8")
    return changes.changes_of(file, name)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a = b + 1", {"a = b - 1", "a = b + 2"}),
        ("a = b < c and not d", {"a = b >= c and not d", "a = b < c or not d", "a = b < c and d"}),
        ("a = -max(b)", {"a = max(b)", "a = -min(b)"}),
        ("a = 0.5 if f(b) else c", {"a = 1.0 if f(b) else c", "a = 0.5 if not (f(b)) else c"}),
        ("a += abs(b)", {"a -= abs(b)", "a += (b)"}),
        ('raise InputError(Fault("a", "b", str(1 + 2)))', set()),
        ("a: int | None = True", {"a: int | None = False"}),
        ('a = "α" + b', set()),
        ("a = (b) * (c)", {"a = (b) / (c)"}),
        ("a = zip(b, c, strict=True)", set()),
    ],
)
def test_what_is_changed(changes, tmp_path, text, expected):
    assert {one.apply(text) for one in found(changes, tmp_path, text)} == expected


def test_a_change_knows_the_line_on_which_its_statement_begins(changes, tmp_path):
    text = "for a in b:\n    c += 1\n    d = f(\n        2,\n    )\n"
    assert {(one.line, one.statement) for one in found(changes, tmp_path, text)} == {(2, 2), (4, 3)}


def test_what_is_changed_in_a_script(changes, tmp_path):
    text = 'import * as a from "./a.js";\n// b && c\nexport function f(b) {\n  return b === 1 && "x && y" !== b;\n}\n'
    assert [one.key for one in found(changes, tmp_path, text, "part.js")] == [
        "part.js f: === -> !==",
        "part.js f: && -> ||",
        "part.js f: !== -> ===",
    ]


def test_every_change_of_a_file_has_a_name_of_its_own_and_is_python(changes):
    file = TOOLS / "changes.py"
    text, each = file.read_text(encoding="utf-8"), changes.changes_of(file, "changes.py")
    assert len({one.key for one in each}) == len(each) > 50
    for one in each:
        assert ast.dump(ast.parse(one.apply(text))) != ast.dump(ast.parse(text)), one.key


def test_a_file_that_is_another_by_now_is_not_changed(changes, tmp_path):
    (one,) = found(changes, tmp_path, "a = b + c")
    with pytest.raises(ValueError, match=r"part\.py is another"):
        one.apply("a = bc + d")
