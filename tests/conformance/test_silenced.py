"""What silences a checker, and what skips a test, says why: CONTRIBUTING.md asks for it."""

import ast
import re

from support.commands import ROOT

FOLDERS = "benchmarks", "docs", "src", "tests", "tools"
FILES = [
    path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.py")) if "node_modules" not in path.parts
]
SILENCED = re.compile(r"# (?:ruff: )?(?:noqa|type: ignore|pyright: ignore)\b(?P<rest>.*)$", re.MULTILINE)
#: The rules, by name, and then the reason in brackets.
EXPLAINED = re.compile(r"(?:: [A-Z0-9, ]+|\[[\w, -]+\])  \(.+\)$")
#: The reason stands on the line or above it.
IGNORED_WARNING = re.compile(r"""(?:simplefilter|catch_warnings|mark\.filterwarnings)\((?:action=)?[\"']ignore""")


def name(path):
    return path.relative_to(ROOT).as_posix()


def test_a_silenced_checker_has_its_rule_and_a_reason():
    bare = [
        f"{name(path)}: {found[0]}"
        for path in FILES
        for found in SILENCED.finditer(path.read_text(encoding="utf-8"))
        if path.name != "test_silenced.py" and not EXPLAINED.match(found["rest"])
    ]
    assert bare == []


def _called(node):
    return node.func.attr if isinstance(node.func, ast.Attribute) else ""


def test_a_skipped_test_has_a_reason():
    bare = []
    texts = {path: path.read_text(encoding="utf-8") for path in FILES if "tests" in path.parts}
    for path, text in texts.items():
        for node in ast.walk(ast.parse(text)) if re.search("skip|xfail", text) else ():
            if isinstance(node, ast.Call) and _called(node) in ("skip", "skipif", "importorskip", "xfail"):
                is_positional = _called(node) == "skip" and node.args
                if not is_positional and "reason" not in {keyword.arg for keyword in node.keywords}:
                    bare.append(f"{name(path)}:{node.lineno}")
    assert bare == []


def test_a_silenced_warning_has_a_reason():
    bare = []
    for path in FILES:
        lines = path.read_text(encoding="utf-8").splitlines()
        for number, line in enumerate(lines):
            explained = "#" in line or lines[number - 1].lstrip().startswith("#")
            if IGNORED_WARNING.search(line) and not explained:
                bare.append(f"{name(path)}:{number + 1}")
    assert bare == []
