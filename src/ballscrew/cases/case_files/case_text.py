"""Texts of case files: as tables (TOML, or the same tables as JSON), and numbers in them that could be two.

Such a text is ``"3.000 N"`` is 3 N, and 3000 N where a point parts thousands.

A point is that of decimals, in this package and in most programs, and trailing zeros are common: ``"6.350 mm"``. So
nothing is refused, and it is said only where the other number is plausible and the one that is read is not; of load,
speed and preload, of which either may be, wherever the other is plausible.
"""

from __future__ import annotations

import datetime
import json
import math
import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, NoReturn, get_args

from pydantic import BaseModel

from ballscrew.basis import units
from ballscrew.basis.atomic_files import read_bytes
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import Quantity, within_bounds
from ballscrew.basis.records import Record
from ballscrew.cases.schema.case_schema import sections
from ballscrew.physics.components.screw import PRELOAD_SHARES
from ballscrew.physics.friction.model import LAWS

#: Bytes of a case file at most, and bits of a whole number in it: no float is larger.
LARGEST_FILE, LARGEST_INTEGER = 4_000_000, 1024
#: Tables within tables at most, and parts of a dotted key.
DEEPEST = 16
#: Tables within a design that goes through JSON at most: answers and requests have three more around it.
_DEEPEST_DESIGN = 5
#: Whole numbers up to this are the same in every program that reads JSON.
_LARGEST_EXACT = 2**53
_START = 'start from "ballscrew catalogue show hiwin-40-20k4 --case"'
_TWICE = "is given twice"
_HEADER = re.compile(r"\s*\[([^\[\]]+)\]\s*(?:#.*)?")
_KEY = re.compile(r"\s*([^=#\[]+?)\s*=")
#: A line with a value of a few words without quotes, perhaps with a comment behind it.
_BARE_VALUE = re.compile(
    r"""\s*(?P<key>[\w.-]+)\s*=\s*(?P<value>[^\s"'#\[\]{}=\\][^"'#\[\]{}=\\]{0,59}?)\s*(?:\#.*)?"""
)
#: Strings of TOML, and what begins with # outside them; keys of too many parts, and other words. Its possessive parts
#: keep the time in proportion to the text, also where a string has no end.
_TOKEN = re.compile(
    rf"""(?P<key>(?:(?:[\w-]++|"(?:[^"\\\n]++|\\.)*+"|'[^'\n]*+')[ \t]*+\.[ \t]*+){{{DEEPEST}}})
    |"{{3}}(?:[^"\\]++|\\.|"{{1,2}}(?!"))*+"{{0,5}}+ | '{{3}}(?:[^']++|'{{1,2}}(?!'))*+'{{0,5}}+
    |"(?:[^"\\\n]++|\\.)*+"? | '[^'\n]*+'? | (?P<comment>\#[^\n]*+) | [\w-]++""",
    re.DOTALL | re.VERBOSE,
)


def tables_at(path: Path) -> dict[str, Any]:
    """The tables of a file. Raises :class:`~ballscrew.basis.errors.InputError` if it has none."""
    try:
        content = read_bytes(path, LARGEST_FILE)
    except (OSError, ValueError) as error:
        problem = "does not exist" if isinstance(error, FileNotFoundError) else "cannot be read"
        reason = "" if isinstance(error, FileNotFoundError) else getattr(error, "strerror", str(error))
        raise InputError(Fault(str(path), problem, reason, "give the path of a case file")) from None
    return tables_in(content, str(path))


def tables_in(content: bytes, where: str) -> dict[str, Any]:
    """The tables that are written in the content of a file. Raises :class:`~ballscrew.basis.errors.InputError`."""
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError(Fault(where, "is not text in UTF-8", "", "save it as UTF-8")) from None
    is_json = text.lstrip().startswith("{")  # no TOML begins with it
    try:
        tables = _json(text) if is_json else toml(text)
    except (ValueError, RecursionError) as error:
        if not is_json and (twice := _given_twice(where, str(error), text)) is not None:
            raise InputError(twice) from None
        remedy = _remedy(str(error), text)
        if is_json:
            remedy = "leave one of them out" if str(error).endswith(_TWICE) else "write one JSON object"
        raise InputError(Fault(where, "is not JSON" if is_json else "is not TOML", str(error), remedy)) from None
    if not tables:
        raise InputError(Fault(where, "is empty", "", _START))
    return tables


def toml(text: str) -> dict[str, Any]:
    """The tables of a text.

    Raises ``ValueError`` where it is no TOML, for tables nested too deeply, and for whole numbers beyond any float.
    """
    if any(each["key"] for each in _TOKEN.finditer(text)):  # tomllib keeps each beginning of a key: 24 kB take 1.1 GB
        raise ValueError(f"a key has more than {DEEPEST} parts")
    return _checked(tomllib.loads(text))


def comments_in(text: str) -> int:
    """The number of comments in a text of TOML."""
    return sum(each["comment"] is not None for each in _TOKEN.finditer(text))


def comments_at(path: Path) -> int:
    """The number of comments in a file of TOML; JSON has none."""
    text = read_bytes(path, LARGEST_FILE).decode("utf-8-sig", "replace")
    return 0 if text.lstrip().startswith("{") else comments_in(text)


def for_json(where: str, value: Any, notes: list[str], depth: int = 0) -> Any:
    """The tables of a design as JSON has them, with a note for each value that is kept as text.

    Raises :class:`~ballscrew.basis.errors.InputError` where they are nested too deeply for an answer.
    """
    if depth > _DEEPEST_DESIGN:
        raise InputError(Fault(where, "is nested too deeply", "", f"{_DEEPEST_DESIGN} levels at most in a design"))
    if isinstance(value, Mapping):
        return {
            name: for_json(f"{where}.{name}".removeprefix("."), inner, notes, depth + 1)
            for name, inner in value.items()
        }
    if isinstance(value, list):
        return [for_json(where, inner, notes, depth + 1) for inner in value]
    if isinstance(value, datetime.date | datetime.time):
        text = value.isoformat()
    elif (isinstance(value, int) and abs(value) > _LARGEST_EXACT) or (
        isinstance(value, float) and not math.isfinite(value)
    ):
        text = str(value)
    else:
        return value
    notes.append(f"{where} is kept as text: {text}")
    return text


def _json(text: str) -> dict[str, Any]:
    tables = _checked(json.loads(text, parse_constant=_no_number, object_pairs_hook=_table))
    if any(leaf is None for leaf in _leaves(tables)):
        raise ValueError("null stands for nothing: leave such names out")
    return tables


def _no_number(name: str) -> NoReturn:
    raise ValueError(f"{name} is no JSON number")


def _table(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """A table without repeated names, as TOML has it; JSON would keep the last one."""
    table: dict[str, Any] = {}
    for name, value in pairs:
        if name in table:
            raise ValueError(f"{name[:40]} {_TWICE}")
        table[name] = value
    return table


def _checked(tables: dict[str, Any]) -> dict[str, Any]:
    level: list[Any] = [tables]
    for _ in range(DEEPEST + 1):
        level = [inner for value in level for inner in _inside(value)]
    if level:
        raise ValueError(f"its tables are nested more than {DEEPEST} deep")
    if any(isinstance(leaf, int) and leaf.bit_length() > LARGEST_INTEGER for leaf in _leaves(tables)):
        raise ValueError(f"a whole number has more than {LARGEST_INTEGER} bits")
    return tables


def _inside(value: Any) -> Iterable[Any]:
    if isinstance(value, dict):
        return value.values()
    return value if isinstance(value, list) else ()


def _leaves(value: Any) -> Iterator[Any]:
    """All values of nested tables and lists."""
    if isinstance(value, dict | list):
        for inner in value.values() if isinstance(value, dict) else value:
            yield from _leaves(inner)
    else:
        yield value


def _given_twice(where: str, error: str, text: str) -> Fault | None:
    """The fault of a table or a key that is given twice, with both lines; None for another error of TOML."""
    if not re.match("Cannot (overwrite|declare|redefine|mutate)", error):
        return None
    seen: dict[tuple[str, str], int] = {}
    table = ""
    for number, line in enumerate(text.splitlines(), start=1):
        header, key = _HEADER.fullmatch(line), _KEY.match(line)
        if header is not None:
            table, name = _bare(header[1]), ""
        elif key is not None:
            name = _bare(key[1])
        else:
            table = f"[[{number}" if line.lstrip().startswith("[[") else table  # each table of a list is one by itself
            continue
        first = seen.setdefault((table, name), number)
        if first < number:
            of_list = table.removeprefix("[[")
            of_table = f"the table of line {of_list}" if of_list != table else f"[{table}]" if table else "the file"
            words = f'"{name}" of {of_table}' if name else of_table
            remedy = "leave one of them out" if name else "put their keys into one"
            return Fault(where, f"{words} {_TWICE}", f"lines {first} and {number}", remedy)
    return None


def _bare(key: str) -> str:
    """A key without quotes and blanks."""
    return re.sub(r"[\s\"']", "", key)


def _unquoted(error: str, text: str) -> str | None:
    """The remedy of a line whose value stands without quotes, as in ``lead = 10,0 mm``; None for any other line."""
    at = re.match(r"(?:Expected newline|Invalid value).*\(at line (\d+)", error)
    lines = text.split("\n")  # as tomllib counts them
    result = _BARE_VALUE.fullmatch(lines[int(at[1]) - 1]) if at and int(at[1]) <= len(lines) else None
    if result is None:
        return None
    key, value = result["key"], result["value"]
    if value.casefold() in ("true", "false"):
        return f"write {key} = {value.casefold()}"
    return f'put the value in quotes: {key} = "{value}"'


def _remedy(error: str, text: str) -> str:
    """Remedy: most often a value has no quotes, or a law is given by name and with coefficients."""
    if (unquoted := _unquoted(error, text)) is not None:
        return unquoted
    line = re.search(r"Cannot overwrite a value \(at line (\d+)", error)
    if line is None:
        return _START
    key = re.match(r"\s*(?:model\.)?(\w+)\.", text.splitlines()[int(line[1]) - 1])
    slot = key[1] if key and key[1] in LAWS else "rolling"
    given = re.search(rf"""^\s*{slot}\s*=\s*["']([\w-]+)["']""", text, re.MULTILINE)
    law = given[1] if given else "houpert"
    return f'a law with coefficients: write {slot}.law = "{law}" beside them'


#: The id of the warning.
THOUSANDS = "inputs.thousands"
#: One to three digits, a point, three digits, and a unit: as a number with its thousands parted, or three decimals.
_EITHER = re.compile(r"\s*([-+]?[1-9]\d{0,2})\.(\d{3})(?![\d.,'])\s*(\D.*)?")
#: What may be a thousand times as large on another screw.
_OF_ANY_SIZE = ("operation.axial_load", "operation.screw_speed", "nut.preload")
_FORCES = {"operation.axial_load": (0.0, 1.0), "nut.preload": PRELOAD_SHARES}


def doubtful(tables: Mapping[str, Any], dynamic_load_rating: float | None) -> list[Record]:
    """A warning for each number of a case that would be another, and a plausible one, if its point parted thousands.

    The force on the screw and the preload are plausible in relation to the dynamic load rating, where it is known.
    """
    return [
        record
        for section, table in tables.items()
        if section in sections() and isinstance(table, dict)
        for where, text, quantity in _texts(section, sections()[section], table)
        if (record := _doubt(where, text, quantity, dynamic_load_rating)) is not None
    ]


def _texts(where: str, model: type[BaseModel], table: Mapping[str, Any]) -> Iterator[tuple[str, str, Quantity]]:
    """The texts of a table that stand for quantities, with their places."""
    for name, value in table.items():
        field = model.model_fields.get(name)
        if field is None:
            continue
        quantity = next((each for each in field.metadata if isinstance(each, Quantity)), None)
        kinds: tuple[Any, ...] = (field.annotation, *get_args(field.annotation))
        inner = next((kind for kind in kinds if isinstance(kind, type) and issubclass(kind, BaseModel)), None)
        if isinstance(value, str) and quantity is not None:
            yield f"{where}.{name}", value, quantity
        elif isinstance(value, dict) and inner is not None:
            yield from _texts(f"{where}.{name}", inner, value)


def _doubt(where: str, text: str, quantity: Quantity, rating: float | None) -> Record | None:
    match = _EITHER.fullmatch(units.in_ascii(text)) if len(text) <= units.LONGEST_VALUE else None
    if match is None:
        return None
    whole, thousandths, unit = match[1], match[2], match[3] or ""
    read, other = (
        units.parse(where, f"{number} {unit}", quantity) for number in (_decimal(match), whole + thousandths)
    )
    if isinstance(read, Fault) or isinstance(other, Fault) or not _plausible(where, other, quantity, rating):
        return None
    if where not in _OF_ANY_SIZE and _plausible(where, read, quantity, rating):
        return None
    plain, with_thousands = (
        f"{number} {unit}".strip() for number in (f"{float(_decimal(match)):g}", whole + thousandths)
    )
    decimal = f"{_decimal(match)}0 {unit}".strip() if _EITHER.fullmatch(plain) else plain  # which is not asked again
    message = f'"{text.strip()}" is read as {plain}: write "{with_thousands}" if that is meant, else "{decimal}"'
    return Record.warning(THOUSANDS, where, message, value=read, limit=other, unit=quantity.unit)


def _decimal(match: re.Match[str]) -> str:
    """The number with its decimals."""
    return f"{match[1]}.{match[2]}"


def _plausible(where: str, value: float, quantity: Quantity, rating: float | None) -> bool:
    """Test whether a value may be one of this quantity."""
    if rating is not None and where in _FORCES:
        least, most = _FORCES[where]
        return least * rating <= abs(value) <= most * rating
    low, high = quantity.info.usual or (-float("inf"), float("inf"))
    return bool(within_bounds(quantity.info, value)) and low <= value <= high
