"""One-line changes of Python source: the faults that a slip of the hand makes, and that a test should notice.

An operator becomes its opposite, a comparison its negation, ``and`` becomes ``or``, a maximum a minimum; a number is
one more or twice as large; a sign, a ``not`` or an ``abs`` is lost; a condition is turned round. What people read
(texts, annotations, meanings of fields, faults) is left alone: a change there is no change of a result.
"""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple


class Change(NamedTuple):
    """A change of one expression."""

    #: File below ``src/ballscrew``.
    file: str
    #: Function that it stands in, with its class; empty at the top of a module.
    function: str
    #: From 1.
    line: int
    #: Offsets in the file, in characters.
    start: int
    end: int
    before: str
    after: str
    #: First line of the statement that it stands in.
    statement: int
    #: Which of the same changes in its function it is, from 1.
    number: int = 1

    @property
    def key(self) -> str:
        """What it is known by, while other functions come and go: no other change of the package has it."""
        number = f" ({self.number})" if self.number > 1 else ""
        return f"{self.file} {self.function}: {_one_line(self.before)} -> {_one_line(self.after)}{number}"

    def apply(self, text: str) -> str:
        """The file with the change."""
        if text[self.start : self.end] != self.before:
            raise ValueError(f"{self.file} is another than the one in which the change was found")
        return text[: self.start] + self.after + text[self.end :]


_OPERATORS: dict[type[ast.operator], tuple[str, str]] = {
    ast.Add: ("+", "-"), ast.Sub: ("-", "+"), ast.Mult: ("*", "/"), ast.Div: ("/", "*"), ast.Pow: ("**", "*"),
    ast.FloorDiv: ("//", "/"), ast.Mod: ("%", "*"), ast.BitAnd: ("&", "|"), ast.BitOr: ("|", "&"),
}  # fmt: skip
_NEGATED: dict[type[ast.cmpop], tuple[str, str]] = {
    ast.Lt: ("<", ">="), ast.LtE: ("<=", ">"), ast.Gt: (">", "<="), ast.GtE: (">=", "<"), ast.Eq: ("==", "!="),
    ast.NotEq: ("!=", "=="), ast.Is: ("is", "is not"), ast.IsNot: ("is not", "is"), ast.In: ("in", "not in"),
    ast.NotIn: ("not in", "in"),
}  # fmt: skip
_TWINS = (
    ("max", "min"), ("maximum", "minimum"), ("fmax", "fmin"), ("nanmax", "nanmin"), ("argmax", "argmin"),
    ("nanargmax", "nanargmin"), ("any", "all"), ("floor", "ceil"), ("sum", "max"), ("mean", "max"), ("sin", "cos"),
    ("cumsum", "cumprod"),
)  # fmt: skip
_OPPOSITE = {one: other for pair in _TWINS for one, other in (pair, reversed(pair))} | {"max": "min", "all": "any"}
#: Functions of one argument that are lost.
_LOST = ("abs", "sqrt", "absolute", "sorted", "radians", "degrees", "exp", "log", "square", "cumsum")
#: Calls in which nothing is changed: they describe, or say what is wrong.
_DESCRIBE = (
    "Info", "Unit", "Option", "Quantity", "Field", "field", "Fault", "Record", "InputError",
)  # fmt: skip


def changes_of(file: Path, name: str) -> list[Change]:
    """All changes of a file of Python or JavaScript, in its order. ``name`` is its path below ``src/ballscrew``."""
    source = file.read_text(encoding="utf-8")
    found = _of_script(source, name) if file.suffix == ".js" else _Finder(source, name).found
    count = Counter[str]()
    changes: list[Change] = []
    for change in sorted(found, key=lambda one: (one.start, one.end, one.after)):
        count[change.key] += 1
        changes.append(change._replace(number=count[change.key]))
    return changes


class _Finder:
    """The changes of one module."""

    def __init__(self, source: str, name: str) -> None:
        self.source, self.name = source, name
        lines = source.splitlines(keepends=True)
        self._bytes = [line.encode() for line in lines]
        self._starts = [0]
        for line in lines:
            self._starts.append(self._starts[-1] + len(line))
        self.found: list[Change] = []
        self._statement = 1
        self._visit(ast.parse(source), ())

    def _place(self, line: int, column: int) -> int:
        return self._starts[line - 1] + len(self._bytes[line - 1][:column].decode())

    def _span(self, node: ast.expr) -> tuple[int, int]:
        return self._place(node.lineno, node.col_offset), self._place(node.end_lineno or 0, node.end_col_offset or 0)

    def _visit(self, node: ast.AST, inside: tuple[str, ...]) -> None:
        if _describes(node):
            return
        outer = self._statement
        if isinstance(node, ast.stmt):
            self._statement = node.lineno
        if isinstance(node, ast.expr):
            for start, end, after in self._of(node):
                self._add(inside, start, end, after)
        if isinstance(node, ast.AugAssign) and type(node.op) in _OPERATORS:
            sign, other = (f"{operator}=" for operator in _OPERATORS[type(node.op)])
            for start, end, _ in self._between(node.target, node.value, sign, other):
                self._add(inside, start, end, other)
        for name, value in ast.iter_fields(node):
            if name in ("annotation", "returns", "decorator_list", "type_params"):
                continue
            for child in value if isinstance(value, list) else [value]:
                if isinstance(child, ast.AST):
                    self._visit(child, (*inside, child.name) if isinstance(child, _NAMED) else inside)
        if isinstance(node, ast.If | ast.IfExp) and not isinstance(node.test, ast.Compare | ast.BoolOp | ast.UnaryOp):
            start, end = self._span(node.test)
            self._add(inside, start, end, f"not ({self.source[start:end]})")
        self._statement = outer

    def _add(self, inside: tuple[str, ...], start: int, end: int, after: str) -> None:
        line = self.source.count("\n", 0, start) + 1
        self.found.append(
            Change(self.name, ".".join(inside), line, start, end, self.source[start:end], after, self._statement)
        )

    def _of(self, node: ast.expr) -> Iterator[tuple[int, int, str]]:
        match node:
            case ast.BinOp() if type(node.op) in _OPERATORS and not _is_text(node):
                yield from self._between(node.left, node.right, *_OPERATORS[type(node.op)])
            case ast.Compare(ops=[one], comparators=[right]) if type(one) in _NEGATED:
                yield from self._between(node.left, right, *_NEGATED[type(one)])
            case ast.BoolOp():
                words = ("and", "or") if isinstance(node.op, ast.And) else ("or", "and")
                yield from self._between(node.values[0], node.values[1], *words)
            case ast.UnaryOp(op=ast.Not() | ast.USub()):
                yield (*self._span(node), self._text(node.operand))
            case ast.Constant(value=bool(value)):
                yield (*self._span(node), str(not value))
            case ast.Constant(value=int(value)):
                yield (*self._span(node), str(value + 1))
            case ast.Constant(value=float(value)):
                yield (*self._span(node), repr(2 * value) if value else "1.0")
            case ast.Call(args=[one], keywords=[]) if _name(node) in _LOST and not isinstance(one, ast.Starred):
                yield (*self._span(node), f"({self._text(one)})")
            case ast.Call() if _name(node) in _OPPOSITE:
                _, end = self._span(node.func)
                name = _name(node)
                yield end - len(name), end, _OPPOSITE[name]
            case _:
                pass

    def _between(self, left: ast.expr, right: ast.expr, before: str, after: str) -> Iterator[tuple[int, int, str]]:
        """An operator between two expressions, beside brackets and comments."""
        start, end = self._span(left)[1], self._span(right)[0]
        token = rf"\b{before}\b" if before[0].isalpha() else re.escape(before)
        match = re.search(token, self.source[start:end])
        if match is not None:
            yield start + match.start(), start + match.end(), after

    def _text(self, node: ast.expr) -> str:
        start, end = self._span(node)
        return self.source[start:end]


#: What is passed over in JavaScript: imports, comments, texts, regular expressions.
_PASSED = "|".join(
    (
        r"^import[^;]*;",
        r"//[^\n]*",
        r"/\*.*?\*/",
        r'"(?:\\.|[^"\\\n])*"',
        r"'(?:\\.|[^'\\\n])*'",
        r"`(?:\\.|[^`\\])*`",
        r"/(?![*/ ])(?:\\.|\[[^\]\n]*\]|[^/\\\n])+/\w*",
    )
)
_SCRIPT = {
    "===": "!==", "!==": "===", "&&": "||", "||": "&&", " < ": " >= ", " > ": " <= ", " <= ": " > ", " >= ": " < ",
    " + ": " - ", " - ": " + ", " * ": " / ", " / ": " * ", "true": "false", "false": "true", ".some(": ".every(",
    ".every(": ".some(", "Math.min": "Math.max", "Math.max": "Math.min",
}  # fmt: skip
#: Functions of a module, and methods of its classes, which are two columns further in.
_FUNCTIONS = re.compile(
    r"^(?:export )?(?:async )?function (\w+)"
    r"|^  (?!(?:if|for|while|switch|return)\b)(?:static |async |get |set )*(#?\w+)\(.*\{$",
    re.MULTILINE,
)
_CHANGED = "|".join(map(re.escape, sorted(_SCRIPT, key=len, reverse=True)))
_TOKENS = re.compile(f"(?P<passed>{_PASSED})|{_CHANGED}", re.DOTALL | re.MULTILINE)


def _of_script(source: str, name: str) -> Iterator[Change]:
    for match in _TOKENS.finditer(source):
        if match["passed"] is None:
            function = _FUNCTIONS.findall(source[: match.start()])
            line = source.count("\n", 0, match.start()) + 1
            yield Change(
                name, "".join(map("".join, function[-1:])), line, *match.span(), match[0], _SCRIPT[match[0]], line
            )


_NAMED = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef


def _describes(node: ast.AST) -> bool:
    """True for what holds no result: faults, texts, types, and what is only read by a type checker."""
    match node:
        case ast.Raise() | ast.Assert() | ast.Import() | ast.ImportFrom() | ast.JoinedStr():
            return True
        case ast.If(test=ast.Name(id="TYPE_CHECKING")):
            return True
        case ast.keyword(arg="strict"):  # of a zip: what it would refuse does not come
            return True
        case ast.Subscript(value=ast.Name(id=name)):
            return name in ("Annotated", "Literal", "Callable", "Mapping", "Sequence", "TypeAlias")
        case ast.BinOp(op=ast.BitOr()):  # a union of types
            return any(isinstance(one, ast.Constant) and one.value is None for one in (node.left, node.right))
        case ast.Call():
            return _name(node) in _DESCRIBE
        case _:
            return False


def _name(node: ast.Call) -> str:
    return getattr(node.func, "id", getattr(node.func, "attr", ""))


def _is_text(node: ast.BinOp) -> bool:
    return any(
        isinstance(one, ast.JoinedStr | ast.List | ast.Tuple)
        or (isinstance(one, ast.Constant) and isinstance(one.value, str))
        for one in (node.left, node.right)
    )


def _one_line(text: str) -> str:
    return " ".join(text.split())
