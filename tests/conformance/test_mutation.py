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


def test_tests_of_a_statement_are_those_of_its_lines_and_all_that_share_a_fixture(changes, tmp_path):
    spec = importlib.util.spec_from_file_location("mutation_mutate", TOOLS / "mutate.py")
    mutate = importlib.util.module_from_spec(spec)
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(TOOLS)
        spec.loader.exec_module(mutate)
    (one,) = found(changes, tmp_path, "a = f(\n  b\n  + c\n)\nd = e")
    assert (one.statement, one.line) == (1, 3)
    reached = mutate.Reached(
        {"part.py": {1: ["a.py::test_f"], 2: ["fixture f"], 5: ["b.py::test_of_another"]}},
        {
            "a.py::test_f": 1.0,
            "fixture f": 4.0,
            "a.py::test_g": 0.5,
            "b.py::test_of_another": 3.0,
            "b.py::test_of_a_constant": 0.1,
            "c.py::test_of_another_part": 0.1,
        },
        {"fixture f": ["a.py::test_f", "a.py::test_g"]},
    )
    assert reached.of(one) == (["a.py::test_g", "a.py::test_f"], 5.0)
    # of a line that the import runs, also those that run no line of the module; with its fixture test_g takes longer
    tests, seconds = reached.of(one._replace(statement=4, line=4))
    assert tests == ["b.py::test_of_a_constant", "b.py::test_of_another", "a.py::test_g", "a.py::test_f"]
    assert seconds == pytest.approx(4.6)


def test_lines_of_a_script_that_were_run():
    """The condition of a block that was not run was; the function around it, too, and none that was never called."""
    spec = importlib.util.spec_from_file_location("mutation_contexts", TOOLS / "contexts.py")
    contexts = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(contexts)
    text = "let a;\nfunction f() {\n  if (a) {\n    g();\n  }\n  return 1;\n}\nfunction h() {\n  return 2;\n}\nf();\n"

    def part(first, last, count):
        return {"startOffset": text.index(first), "endOffset": text.index(last) + len(last), "count": count}

    block, unused = part("{\n    g", "g();\n  }", 0), part("function h", "return 2;\n}", 0)
    ranges = [
        unused,
        {"startOffset": 0, "endOffset": len(text), "count": 1},
        part("function f", "return 1;\n}", 1),
        block,
    ]
    assert contexts.reached(text, ranges) == {*range(1, 13)} - {4, 9}


def test_a_file_that_is_another_by_now_is_not_changed(changes, tmp_path):
    (one,) = found(changes, tmp_path, "a = b + c")
    with pytest.raises(ValueError, match=r"part\.py is another"):
        one.apply("a = bc + d")
