"""English templates of faults, records and messages, as they stand in the source: the keys of their translations.

A template is a literal. What is given to a fault as its problem or remedy is followed back to literals through
conditionals, names, tables and functions of the same module, and imports; a text that is put together has none.
"""

from __future__ import annotations

import ast
import dataclasses
import functools
import re
from collections.abc import Iterator
from pathlib import Path

import ballscrew

_FUNCTIONS = ast.FunctionDef | ast.AsyncFunctionDef
PACKAGE = Path(ballscrew.__file__).parent
_TEXTS = ("where", "problem", "given", "remedy")
#: Attributes that pass on what another fault, record, annotation or option of an export says: its own source is read.
_PASSED_ON = ("problem", "remedy", "hint", "meaning", "given", "message")


@dataclasses.dataclass(frozen=True)
class Source:
    """A module with its tree, and for each node the function that it stands in."""

    file: Path
    tree: ast.Module
    inside: dict[ast.AST, ast.AST]

    @property
    def name(self) -> str:
        return (
            self.file.relative_to(PACKAGE.parent).with_suffix("").as_posix().replace("/", ".").removesuffix(".__init__")
        )


@functools.cache
def sources() -> dict[str, Source]:
    """All modules of the package by name."""
    found = {}
    for file in sorted(PACKAGE.rglob("*.py")):
        tree = ast.parse(file.read_text(encoding="utf-8"))
        inside: dict[ast.AST, ast.AST] = {}
        _place(tree, tree, inside)
        source = Source(file, tree, inside)
        found[source.name] = source
    return found


def _place(node: ast.AST, owner: ast.AST, inside: dict[ast.AST, ast.AST]) -> None:
    for child in ast.iter_child_nodes(node):
        inside[child] = owner
        _place(child, child if isinstance(child, _FUNCTIONS) else owner, inside)


def calls(*names: str) -> Iterator[tuple[Source, ast.Call]]:
    """All calls of functions or classes by their names."""
    for name in names:
        yield from _calls().get(name, ())


@functools.cache
def _calls() -> dict[str, list[tuple[Source, ast.Call]]]:
    found: dict[str, list[tuple[Source, ast.Call]]] = {}
    for source in sources().values():
        for node in ast.walk(source.tree):
            if isinstance(node, ast.Call):
                found.setdefault(called(node), []).append((source, node))
    return found


def called(node: ast.Call) -> str:
    """The last name of what is called."""
    return getattr(node.func, "id", getattr(node.func, "attr", ""))


def argument(call: ast.Call, name: str, place: int) -> ast.expr | None:
    """An argument by its name or its place."""
    if place < len(call.args) and not any(isinstance(one, ast.Starred) for one in call.args[: place + 1]):
        return call.args[place]
    return next((one.value for one in call.keywords if one.arg == name), None)


@dataclasses.dataclass(frozen=True)
class Said:
    """The templates of a fault or a record, and the expressions that have none."""

    module: str
    where: str
    templates: frozenset[str]
    untold: tuple[str, ...]


@functools.cache
def faults() -> tuple[Said, ...]:
    """The problems and remedies of all faults."""
    found = []
    for source, call in calls("Fault"):
        templates: set[str] = set()
        untold: list[str] = []
        for name in ("problem", "remedy"):
            value = argument(call, name, _TEXTS.index(name))
            if value is not None:
                _follow(source, value, templates, untold, frozenset())
        place = f"{source.file.relative_to(PACKAGE).as_posix()}:{call.lineno}"
        found.append(Said(source.name, place, frozenset(templates - {""}), tuple(untold)))
    return tuple(found)


@functools.cache
def records() -> tuple[Said, ...]:
    """The messages of all records: verdicts, checks and warnings, which have an id."""
    found = []
    for source, call in calls("Record", "record"):
        if not any(one.arg == "id" for one in call.keywords):
            continue  # a row of a table, a step of a tape
        message = argument(call, "message", 0)
        templates: set[str] = set()
        untold: list[str] = []
        if message is None:
            untold.append(ast.unparse(call))
        else:
            _follow(source, message, templates, untold, frozenset())
        place = f"{source.file.relative_to(PACKAGE).as_posix()}:{call.lineno}"
        found.append(Said(source.name, place, frozenset(templates - {""}), tuple(untold)))
    return tuple(found)


@functools.cache
def messages() -> frozenset[tuple[str, str]]:
    """The templates of all messages with their modules, texts that are marked as such, and the hints of annotations."""
    found = set()
    for source, call in calls("Message", "translatable", "filled_text"):
        templates: set[str] = set()
        value = argument(call, "template", 0)
        if value is not None:
            _follow(source, value, templates, [], frozenset())
        found |= {(source.name, one) for one in templates}
    for source, call in calls("Info", "ColumnInfo"):
        hint = next((one.value for one in call.keywords if one.arg == "hint"), None)
        if isinstance(hint, ast.Constant) and hint.value:
            found.add((source.name, hint.value))
    return frozenset(found)


def _follow(source: Source, node: ast.expr, found: set[str], untold: list[str], seen: frozenset[ast.AST]) -> None:
    """Add the literals that an expression may be, or the expression where it is none."""
    if node in seen:
        return
    seen |= {node}
    for one in _alternatives(node):
        if isinstance(one, ast.Constant) and isinstance(one.value, str):
            found.add(one.value)
        elif isinstance(one, ast.Call):
            _follow_call(source, one, found, untold, seen)
        elif isinstance(one, ast.Name):
            values = list(_assigned(source, one))
            if not values:
                untold.append(ast.unparse(one))
            for owner, value in values:
                _follow(owner, value, found, untold, seen)
        elif isinstance(one, ast.Subscript) and isinstance(one.value, ast.Name):
            for owner, table in _assigned(source, one.value):
                entries = table.values if isinstance(table, ast.Dict) else getattr(table, "elts", [])
                if not entries:
                    untold.append(ast.unparse(one))
                for value in entries:
                    _follow(owner, value, found, untold, seen)
        elif not (isinstance(one, ast.Attribute) and one.attr.strip("_") in _PASSED_ON) and not _is_none(one):
            untold.append(ast.unparse(one))


def _is_none(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and node.value is None


def _alternatives(node: ast.expr) -> Iterator[ast.expr]:
    """The expressions that a conditional may be."""
    if isinstance(node, ast.IfExp):
        yield from (*_alternatives(node.body), *_alternatives(node.orelse))
    elif isinstance(node, ast.BoolOp):
        for value in node.values:
            yield from _alternatives(value)
    elif isinstance(node, ast.NamedExpr):
        yield from _alternatives(node.value)
    else:
        yield node


def _follow_call(source: Source, call: ast.Call, found: set[str], untold: list[str], seen: frozenset[ast.AST]) -> None:
    name = called(call)
    if name == "Message":
        value = argument(call, "template", 0)
        assert value is not None
        _follow(source, value, found, untold, seen)
    elif name in ("of", "changed") and isinstance(call.func, ast.Attribute):
        _follow(source, call.func.value, found, untold, seen)
    elif name in ("message_of", "dict"):
        _follow(source, call.args[0], found, untold, seen)
    else:
        functions = list(_functions(source, name))
        if not functions:
            untold.append(ast.unparse(call))
        for owner, function in functions:
            returned = [one for one in _returned(function) if one not in seen]
            for value in returned:
                _follow(owner, value, found, untold, seen)


def _returned(function: ast.FunctionDef | ast.AsyncFunctionDef) -> Iterator[ast.expr]:
    for node in ast.walk(function):
        if isinstance(node, ast.Return) and node.value is not None:
            yield node.value


def _functions(source: Source, name: str) -> Iterator[tuple[Source, ast.FunctionDef | ast.AsyncFunctionDef]]:
    """The functions of a name in a module, or where it imports them from."""
    own = [one for one in ast.walk(source.tree) if isinstance(one, _FUNCTIONS) and one.name == name]
    if own:
        yield from ((source, one) for one in own)
        return
    for owner, original in _imported(source, name):
        yield from _functions(owner, original)


def _imported(source: Source, name: str) -> Iterator[tuple[Source, str]]:
    for node in ast.walk(source.tree):
        if isinstance(node, ast.ImportFrom) and node.module in sources():
            for alias in node.names:
                if (alias.asname or alias.name) == name:
                    yield sources()[node.module], alias.name


def _assigned(source: Source, name: ast.Name) -> Iterator[tuple[Source, ast.expr]]:
    """The values that a name is given in its function, by its callers, in its module, or where it is imported from."""
    owner = source.inside.get(name, source.tree)
    while owner is not source.tree:
        found = [(source, value) for node in ast.walk(owner) for value in _given_to(owner, node, name.id)]
        found += _passed(source, owner, name.id)
        if found:
            yield from found
            return
        owner = source.inside[owner]
    found = [value for node in source.tree.body for value in _given_to(node, node, name.id)]
    yield from ((source, value) for value in found)
    for other, original in [] if found else _imported(source, name.id):
        for node in other.tree.body:
            yield from ((other, value) for value in _given_to(node, node, original))


def _passed(source: Source, function: ast.AST, name: str) -> list[tuple[Source, ast.expr]]:
    """What callers of a function give to a parameter, and its default."""
    assert isinstance(function, _FUNCTIONS)
    places = [*function.args.posonlyargs, *function.args.args]
    names = [one.arg for one in (*places, *function.args.kwonlyargs)]
    if name not in names:
        return []
    defaults = [*zip(reversed(places), reversed(function.args.defaults), strict=False)]
    defaults += zip(function.args.kwonlyargs, function.args.kw_defaults, strict=True)
    found = [(source, value) for one, value in defaults if one.arg == name]
    for caller, call in calls(function.name):
        if caller is source or not function.name.startswith("_"):
            found.append((caller, argument(call, name, names.index(name))))
    return [(caller, value) for caller, value in found if value is not None]


def _given_to(owner: ast.AST, node: ast.AST, name: str) -> Iterator[ast.expr]:
    """What a statement gives to a name: alone, in a tuple, or one after another from a tuple of tuples."""
    pairs: list[tuple[ast.expr, ast.expr]] = []
    if isinstance(node, ast.Assign):
        pairs = [(target, node.value) for target in node.targets]
    elif isinstance(node, ast.AnnAssign | ast.NamedExpr) and node.value is not None:
        pairs = [(node.target, node.value)]
    elif isinstance(node, ast.For | ast.comprehension):
        values = [node.iter]
        if isinstance(node.iter, ast.Name):
            tables = [one for one in ast.walk(owner) if isinstance(one, ast.Assign) and len(one.targets) == 1]
            values = [one.value for one in tables if getattr(one.targets[0], "id", "") == node.iter.id]
        rows = [row for value in values for row in getattr(value, "elts", [])]
        pairs = [(node.target, row) for row in rows]
    for target, value in pairs:
        if isinstance(target, ast.Name) and target.id == name:
            yield value
        elif isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple) and len(target.elts) == len(value.elts):
            for one, part in zip(target.elts, value.elts, strict=True):
                if isinstance(one, ast.Name) and one.id == name:
                    yield part


def placeholders(template: str) -> list[str]:
    """The names in braces of a template."""
    return sorted(set(re.findall(r"\{(\w+(?:\.\w+)*)\}", template)))


def has_words(template: str) -> bool:
    """Test whether a template has words of its own to translate."""
    return re.search(r"[A-Za-z]{2}", re.sub(r"\{[\w.]+\}", "", template)) is not None


#: Rooms and modules whose texts no answer of the web application can have, and why.
NOT_ON_PAGE = {
    "ballscrew.cases.schema.law_import": "a request may not name code: it is refused before",
    "ballscrew.cases.torque_cards.torque_card": "cards are read by the command line",
    "ballscrew.engine.evaluation.derivatives": "arguments of a function in Python",
    "ballscrew.engine.evaluation.evaluator": "arguments of a function in Python",
    "ballscrew.engine.evaluation.jax_derivatives": "arguments of a function in Python",
    "ballscrew.engine.sweeps.cluster": "sweeps of the page are in memory",
    "ballscrew.engine.sweeps.lock": "sweeps of the page are in memory",
    "ballscrew.engine.sweeps.store": "sweeps of the page are in memory",
    "ballscrew.engine.sweeps.store_check": "sweeps of the page are in memory",
    "ballscrew.engine.sweeps.store_entries": "sweeps of the page are in memory",
    "ballscrew.engine.sweeps.store_rows": "sweeps of the page are in memory",
    "ballscrew.evidence.moving_logs.moving_log": "the page says which logs are of a moving axis, and fits none",
    "ballscrew.questions.card": "a command",
}
#: Modules that are imported by the name of what is asked for.
_BY_NAME = ("ballscrew.exports.programs", "ballscrew.exports.tables")


def is_left_out(module: str) -> bool:
    """True for a module that :data:`NOT_ON_PAGE` names, or whose room it names."""
    return any(module == one or module.startswith(f"{one}.") for one in NOT_ON_PAGE)


@functools.cache
def shown_by_page() -> frozenset[str]:
    """The modules whose texts the page can show: those that the web application imports, directly or through others."""
    found: set[str] = set()
    wanted = {name for name in sources() if name.startswith(("ballscrew.faces.web", *_BY_NAME))}
    while wanted:
        name = wanted.pop()
        found.add(name)
        wanted |= imports_of(name) - found
    return frozenset(name for name in found if not is_left_out(name))


def imports_of(name: str) -> set[str]:
    """The modules of the package that a module imports."""
    found: set[str] = set()
    for node in ast.walk(sources()[name].tree):
        if isinstance(node, ast.ImportFrom) and node.module:
            found |= {node.module, *(f"{node.module}.{one.name}" for one in node.names)}
        elif isinstance(node, ast.Import):
            found |= {one.name for one in node.names}
    return found & sources().keys()
