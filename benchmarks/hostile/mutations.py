"""Mutations of case files: as text, as bytes, and as the tables of a request."""

from __future__ import annotations

import copy
import re
from collections.abc import Callable
from typing import Any

import numpy as np

Random = np.random.Generator

NUMBERS = (
    "0", "-0.0", "-1", "1", "1e308", "-1e308", "1e309", "1e-308", "5e-324", "nan", "inf", "-inf", "0.5", "1e12",
    "1e-12",
    "9" * 400, "0x1F", "0b101", "1_000", "1__0", "1,5", "1.2.3", "+", "1e", "２", "−5", "½", "1e999999999",
)  # fmt: skip
UNITS = (
    "", "mm", "m", "km", "in", "N", "kN", "lbf", "N m", "rpm", "rad/s", "Hz", "Pa s", "cP", "cSt", "degC", "degF", "K",
    "delta_degC",
    "%", "deg", "rad", "µm", "um", "1/Pa", "GPa^-1", "m**9**9", "m/0", "furlong", "mm mm", "(", "mm;", "e", "pi", "°",
    "N·m", "\u200bmm",
)  # fmt: skip
FRAGMENTS = (
    "true", "false", '""', '" "', '"text"', "[]", "{}", "[1, 2]", '["5 mm"]', "{ a = 1 }", "1979-05-27", "07:32:00",
    "0", "-1", "1e400",
    "nan", "inf", '"nan mm"', '"uniform(1, 2) mm"', '"uniform(2, 1) mm"', '"normal(1, -1) N"', '"0.54 ± 0.01"',
    '"5 ± 500 mm"',
    '"5 mm ± 200 %"', '"± 1"', '"1 ± "', "'''\nmore\nlines\n'''", '"\\u0000"', '"../../etc/passwd"', '"os:getcwd"',
    '"json:loads"',
    '"1:2:0 N"', '"1:2:-5 N"', '"1:2:1e9 N"', '"2:1:5 N"', '", , N"', '"$HOME"', '"{lead}"', '"%s"',
    '"[bold]x[/bold]"', '"<script>"',
    "{ law = 1 }", '{ law = "exact" }', '"reference"', '"catalogue"', "[[[[[[[[[[1]]]]]]]]]]",
)  # fmt: skip
NAMES = (
    "lead", "Lead", "leed", "", '""', '"a b"', "preload", "type", "law", "name", "catalogue", "catalogue_file",
    "calibration", "seed",
    "friction.decay", "friction.law", "a.b.c.d.e", "__class__", "größe", "'\\'", "1", "-", "ball_force", "hertz",
    "slip", "film", "spin",
    "temperature", "grade", "viscosity", "axial_load", "screw_speed", "loaded_balls", "same_side", "ends",
    "unsupported_length",
)  # fmt: skip
SECTIONS = (
    "screw", "lubricant", "operation", "model", "sweep", "nut", "bodies", "deviations", "losses", "installation",
    "limits", "calibration",
    "screw.lead", "model.friction", "screw.ball_material", "losses.seals", "losses.churning", "unknown", "", "[screw]",
    "screw.screw",
)  # fmt: skip
LETTERS = "\0\ufeff\u200b\u202e\u2212\u00a0\ud7ff\U0001f529\n\r\t\x1b\x7f\"'\\#=[]{},.±·%"


def chosen(rng: Random, known: Any) -> Any:
    """One of some values."""
    return known[int(rng.integers(len(known)))]


# -- text -----------------------------------------------------------------------------------------


def _replaced(pattern: str, new: Callable[[Random, re.Match[str]], str]) -> Callable[[str, Random], str]:
    """A mutation of one of the places where a pattern matches."""

    def mutate(text: str, rng: Random) -> str:
        found = list(re.finditer(pattern, text, re.MULTILINE))
        if not found:
            return text
        place = chosen(rng, found)
        return text[: place.start()] + new(rng, place) + text[place.end() :]

    return mutate


def _scaled(rng: Random, place: re.Match[str]) -> str:
    return f"{float(place[0]) * 10 ** rng.uniform(-9, 9):.6g}"


def _field(rng: Random) -> str:
    return f"{chosen(rng, NAMES)} = {chosen(rng, FRAGMENTS)}\n"


def _misspelt(rng: Random, place: re.Match[str]) -> str:
    name, where = place[0], int(rng.integers(len(place[0])))
    return chosen(rng, (name[:where] + name[where + 1 :], name.upper(), name + name[where], chosen(rng, NAMES)))


def _lines(change: Callable[[list[str], int, Random], list[str]]) -> Callable[[str, Random], str]:
    def mutate(text: str, rng: Random) -> str:
        lines = text.splitlines(keepends=True)
        return "".join(change(lines, int(rng.integers(len(lines))), rng)) if lines else text

    return mutate


def _other_line(lines: list[str], i: int, rng: Random) -> list[str]:
    other = int(rng.integers(len(lines)))
    lines[i], lines[other] = lines[other], lines[i]
    return lines


def _inserted(text: str, rng: Random) -> str:
    where = int(rng.integers(len(text) + 1))
    return text[:where] + chosen(rng, LETTERS) * int(rng.choice([1, 1, 1, 2000])) + text[where:]


_NUMBER = r"(?<![\w.])\d+(?:\.\d+)?(?:e-?\d+)?(?!\w)"
_VALUE = r"(?<== )[^#\n]+"

OF_TEXT: dict[str, Callable[[str, Random], str]] = {
    "another number": _replaced(_NUMBER, lambda rng, _: chosen(rng, NUMBERS)),
    "a scaled number": _replaced(_NUMBER, _scaled),
    "another unit": _replaced(r'(?<=\d )[^"\n#]+(?=")', lambda rng, _: chosen(rng, UNITS)),
    "another value": _replaced(_VALUE, lambda rng, _: chosen(rng, FRAGMENTS)),
    "a long value": _replaced(_VALUE, lambda rng, p: '"' + p[0].strip('" ') * int(rng.choice([50, 5000])) + '"'),
    "another name": _replaced(r"^[\w.]+(?= =)", _misspelt),
    "another section": _replaced(r"(?<=^\[)[\w.]+(?=\])", lambda rng, _: chosen(rng, SECTIONS)),
    "a new field": _replaced(r"^\[[\w.]+\]$", lambda rng, place: f"{place[0]}\n{_field(rng)}"),
    "a new section": lambda text, rng: f"{text}\n[{chosen(rng, SECTIONS)}]\n{_field(rng)}",
    "a missing line": _lines(lambda lines, i, _: lines[:i] + lines[i + 1 :]),
    "a doubled line": _lines(lambda lines, i, _: lines[: i + 1] + lines[i:]),
    "exchanged lines": _lines(_other_line),
    "strange letters": _inserted,
}  # fmt: skip


def _flipped(content: bytes, rng: Random) -> bytes:
    found = bytearray(content or b"\0")
    for place in rng.integers(len(found), size=int(rng.choice([1, 1, 8]))):
        found[place] ^= 1 << int(rng.integers(8))
    return bytes(found)


def _random_piece(content: bytes, rng: Random) -> bytes:
    where = int(rng.integers(len(content) + 1))
    return content[:where] + rng.bytes(int(rng.choice([1, 7, 300]))) + content[where + int(rng.choice([0, 7])) :]


def _zeroed(content: bytes, rng: Random) -> bytes:
    where, length = int(rng.integers(len(content) + 1)), int(rng.choice([1, 64, 4096]))
    return content[:where] + b"\0" * min(length, len(content) - where) + content[where + length :]


#: Damage of the bytes of any file.
OF_BYTES: dict[str, Callable[[bytes, Random], bytes]] = {
    "cut off": lambda content, rng: content[: int(rng.integers(len(content) + 1))],
    "cut at the beginning": lambda content, rng: content[int(rng.integers(len(content) + 1)) :],
    "flipped bits": _flipped,
    "random bytes": _random_piece,
    "zeroed bytes": _zeroed,
    "twice": lambda content, _: content + content,
}


def _encoded(name: str) -> Callable[[bytes, Random], bytes]:
    return lambda content, _: content.decode("utf-8", "replace").encode(name, "replace")


#: Damage of texts, that of encodings included.
OF_TEXT_BYTES: dict[str, Callable[[bytes, Random], bytes]] = {
    **OF_BYTES,
    **{name: _encoded(name) for name in ("utf-16", "utf-16-le", "utf-32", "latin-1", "utf-8-sig", "cp037")},
    "other ends of lines": lambda content, rng: content.replace(b"\n", chosen(rng, (b"\r\n", b"\r", b"\n\n", b"\x0b"))),
}


def mutated_text(text: str, rng: Random) -> tuple[str, bytes]:
    """One to three mutations of a case file, one in six also with damaged bytes; their names, and the file."""
    done: list[str] = []
    for _ in range(int(rng.choice([1, 1, 2, 3]))):
        done.append(chosen(rng, list(OF_TEXT)))
        text = OF_TEXT[done[-1]](text, rng)
    content = text.encode("utf-8", "surrogatepass")
    if rng.random() < 1 / 6:
        done.append(chosen(rng, list(OF_TEXT_BYTES)))
        content = OF_TEXT_BYTES[done[-1]](content, rng)
    return ", ".join(done), content


# -- tables ---------------------------------------------------------------------------------------

VALUES: tuple[Any, ...] = (
    None, True, False, 0, -1, 1, 1e308, -0.0, 10**30, 0.5, "", " ", [], {}, [1, 2], {"law": 1}, {"law": "exact"},
    "text", "1:2:3 N",
    "nan", "nan mm", "inf N", "../../etc/passwd", "os:getcwd", "<script>alert(1)</script>", "5 mm ± 1 mm",
    "uniform(2, 1) mm", "\0",
    "x" * 900, "١ mm", {"a": {"b": {"c": 1}}}, [[[[1]]]], "reference", "olaru2005", "exact",
)  # fmt: skip


def mutated_tables(tables: dict[str, Any], rng: Random) -> dict[str, Any]:
    """The tables of a case with one to three fields changed, renamed, added or left out."""
    found = copy.deepcopy(tables)
    for _ in range(int(rng.choice([1, 1, 2, 3]))):
        sections = [table for table in found.values() if isinstance(table, dict)]
        table = chosen(rng, [found, *sections, *sections, *sections])
        name = chosen(rng, list(table)) if table else "lead"
        how = int(rng.integers(6))
        if how == 0:
            table.pop(name, None)
        elif how == 1:
            table[chosen(rng, NAMES)] = table.pop(name, 1)
        elif how == 2:
            table[chosen(rng, (*NAMES, *SECTIONS))] = chosen(rng, VALUES)
        elif how == 3 and isinstance(table.get(name), str):
            number, _, unit = table[name].partition(" ")
            table[name] = chosen(rng, (f"{chosen(rng, NUMBERS)[:100]} {unit}", f"{number} {chosen(rng, UNITS)}"))
        else:
            table[name] = chosen(rng, VALUES)
    return found
