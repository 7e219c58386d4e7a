"""Headings as people write them: which column is meant, and in which unit its numbers are.

A heading is the name of a column, or one of the other names it has in the field, with its unit:
``lead_mm``, ``Ph [mm]``, ``Dynamic load rating Ca (kN)``, ``Nenndurchmesser d0 [mm]``, ``stiffness_kgf_per_um``.
Capitals, blanks and hyphens do not count. A heading that could mean two columns means none.

Names of the columns of vendors' tables, in English and German.

A name is enough by itself. A hint is a name of more than one thing ("load rating", "d"): it counts only beside a name.
Capitals, blanks, hyphens and subscripts do not count; "dia." and "Ø" stand for "diameter", "No." for "number". Of
CAPITALS they do: d1 is of the shaft, D1 of the nut.
"""

from __future__ import annotations

import dataclasses
import difflib
import functools
import re
import unicodedata
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.basis.quantities import Quantity
from ballscrew.files.tables.sheets import HEADINGS_WITHIN, MOST_COLUMNS, Record

#: Kinds of faults of headings.
NEEDS_UNIT, SAME_MEANING, NO_COLUMN, NO_HEADING = "needs_unit", "same_meaning", "no_column", "no_heading"
#: Letters of a heading at most: a longer cell is none, and is not looked at.
LONGEST_HEADING = 200
#: What stands for nothing in a cell.
NOTHING = ("", "-", "–", "—")

#: The unit of a share.
PERCENT = "%"

#: A heading with its unit in brackets.
BRACKETS = re.compile(r"(?P<name>.*?)[\s_]*[\[(](?P<unit>[^\[\]()]*)[\])]")
_WORD = re.compile(r"[^\W_]+")
#: Units as headings have them, and as they stand in case files.
_UNITS = {
    **units.TORQUES,
    **dict.fromkeys(units.PER_MINUTE, "rpm"),
    "C": "degC", "F": "degF", "sec": "s",
    **dict.fromkeys(("pct", "percent", "per cent", "Prozent"), PERCENT),
}  # fmt: skip
#: Other spellings: of letters and signs, and of words.
_LETTERS = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue", "×": " x "})
_WORDS: Mapping[str, str] = {"dia": "diameter", "ø": "diameter", "no": "number"}


@dataclasses.dataclass(frozen=True)
class Column:
    """A column that a table may have: of a quantity, or of text where there is none."""

    name: str
    quantity: Quantity | None = None
    aliases: tuple[str, ...] = ()
    required: bool = False
    #: Names that mean the column only beside one of its own: ``d``, ``load rating``.
    hints: tuple[str, ...] = ()
    #: Whether a cell may be a product: ``2x2.5``.
    product: bool = False
    #: Those of the names whose capitals count: ``D1`` is not ``d1``.
    capitals: tuple[str, ...] = ()
    #: The quantity that a cell in per cent is of, where it may be a share: ``7 %``.
    share: Quantity | None = None
    #: Words that a cell may have in place of a number, in small letters, and what they stand for.
    words: Mapping[str, str] = dataclasses.field(default_factory=dict[str, str])

    def answers_to(self, name: str) -> bool:
        """Test whether the column has this name."""
        return bare(name) in self._names or self._is_in_capitals(name)

    def _is_in_capitals(self, name: str) -> bool:
        return bool(self.capitals) and "".join(_WORD.findall(unicodedata.normalize("NFKC", name))) in self.capitals

    @functools.cached_property
    def _names(self) -> frozenset[str]:
        return frozenset(map(bare, {self.name, *self.aliases} - {*self.capitals}))

    @functools.cached_property
    def _hints(self) -> frozenset[str]:
        return frozenset(map(bare, self.hints))

    @functools.cached_property
    def _longest(self) -> int:
        """Letters of a text at most that is a name, two of them, or one and a hint."""
        longest = max(map(len, self._names))
        return longest + max(longest, *map(len, self._hints), 0)

    def is_named(self, text: str) -> bool:
        """Test whether a text is a name of the column, or two of them, or one and a hint: "Dynamic load rating Ca"."""
        if self.answers_to(text):
            return True
        if len(bare(text)) > self._longest:
            return False
        for word in list(_WORD.finditer(text))[1:]:
            halves = (text[: word.start()], text[word.start() :])
            named = [self.answers_to(half) for half in halves]
            if any(named) and all(own or bare(half) in self._hints for own, half in zip(named, halves, strict=True)):
                return True
        return False

    @property
    def example(self) -> str:
        """A heading for it."""
        if self.quantity is None or self.quantity.unit == "1":
            return self.name
        return f"{self.name} [{self.quantity.shown_in}]"


@dataclasses.dataclass(frozen=True)
class Heading:
    """A heading as written: its column and its place, and what its numbers are in SI: ``offset + scale · number``."""

    written: str
    column: Column
    place: int
    unit: str = ""
    offset: float = 0.0
    scale: float = 1.0
    #: Whether it stands in a table; False for the name of one number by itself.
    in_table: bool = True

    @property
    def quantity(self) -> Quantity | None:
        """Quantity of a cell with a plain number."""
        return self.column.share if self.unit == PERCENT else self.column.quantity


@functools.lru_cache(maxsize=4096)
def bare(name: str) -> str:
    """A name without what does not count: capitals, blanks, hyphens, subscripts."""
    plain = unicodedata.normalize("NFKC", name).casefold().translate(_LETTERS)
    return "".join(_WORDS.get(each[0], each[0]) for each in _WORD.finditer(plain))


def known_heading_of(cell: Any, place: int, columns: Sequence[Column]) -> Heading | None:
    """Heading as by :func:`heading_of`, for columns whose names have letters: a number is not looked at."""
    return heading_of(cell, place, columns) if isinstance(cell, str) and any(map(str.isalpha, cell)) else None


def heading_of(cell: Any, place: int, columns: Sequence[Column]) -> Heading | None:
    """The heading that a cell is, with its unit; None where no column is meant."""
    if not isinstance(cell, str) or not 0 < len(cell) <= LONGEST_HEADING:
        return None
    written = " ".join(cell.split())
    bracketed = BRACKETS.fullmatch(written)
    name, unit = (bracketed["name"], bracketed["unit"].strip()) if bracketed else (written, "")
    meant = [column for column in columns if column.is_named(name)]
    if len(meant) > 1 and unit:  # "T [N m]" is no time
        meant = [column for column in meant if fits(unit, column)]
    if len(meant) == 1:
        (column,) = meant
        return Heading(written, column, place, _bracketed(unit, column) if bracketed else _unbracketed(name, column))
    if meant or bracketed:
        return None
    headings = [Heading(written, column, place, behind) for column in columns if (behind := _unit_behind(name, column))]
    return headings[0] if len(headings) == 1 else None


def _bracketed(unit: str, column: Column) -> str:
    """The unit that stands in brackets behind a name; nothing for another name of the column."""
    no_unit = unit in NOTHING or (column.answers_to(unit) and not fits(unit, column))
    return "" if no_unit else spelt(unit)


def _unbracketed(name: str, column: Column) -> str:
    """The unit in a name without brackets; "rpm" is both name and unit."""
    return _unit_behind(name, column) or (spelt(name) if fits(name, column) else "")


def _unit_behind(written: str, column: Column) -> str:
    """The unit behind the name of a column, ``mm`` in ``lead_mm``; nothing where there is none that fits."""
    if column.quantity is None or column.quantity.unit == "1":
        return ""
    for word in reversed(list(_WORD.finditer(written))[1:]):
        unit = spelt(written[word.start() :])
        if column.is_named(written[: word.start()]) and fits(unit, column):
            return unit
    return ""


def fits(unit: str, column: Column) -> bool:
    """Test whether the numbers of a column may be in this unit."""
    quantity = column.quantity
    if column.share is not None and spelt(unit) == PERCENT:
        return True
    return quantity is not None and quantity.unit != "1" and _is_of(spelt(unit), quantity)


@functools.lru_cache(maxsize=4096)
def _is_of(unit: str, quantity: Quantity) -> bool:
    """Test whether a unit is of a quantity; a heading is asked for the same few units by each of the columns."""
    return not isinstance(_scale("", unit, quantity), Fault)


def spelt(unit: str) -> str:
    """A unit of a heading in the spelling of case files: ``kgf_per_um`` is ``kgf/um``."""
    unit = re.sub(r"[\s_]+per[\s_]+", "/", unit.strip()).replace("_", " ")
    return _UNITS.get(unit, unit)


def _scale(where: str, unit: str, quantity: Quantity) -> tuple[float, float] | Fault:
    """Offset and scale of a unit: what 0 and one more are in SI."""
    zero, one = (units.parse(where, f"{number} {unit}", quantity) for number in ("0", "1"))
    if isinstance(zero, Fault) or isinstance(one, Fault):
        fault = zero if isinstance(zero, Fault) else one
        assert isinstance(fault, Fault)
        return dataclasses.replace(fault, given=unit)
    return zero, one - zero


def headings_in(
    path: Path, records: Sequence[Record], columns: Sequence[Column], within: int = HEADINGS_WITHIN
) -> tuple[int, list[Heading]]:
    """The row of the headings, and the headings of known columns. Raises
    :class:`~ballscrew.basis.errors.InputError`.
    """
    if not records:
        raise InputError(Fault(str(path), "is empty", "", "give a table with headings and rows"))
    if (widest := max(len(record.cells) for record in records)) > MOST_COLUMNS:
        remedy = f"{units.grouped(MOST_COLUMNS)} at most: keep those that are needed"
        raise InputError(Fault(str(path), "has too many columns", f"{widest:,}", remedy))
    best: tuple[int, list[Heading]] = (0, [])
    for number, record in enumerate(records[:within]):
        headings = [known_heading_of(cell, place, columns) for place, cell in enumerate(record.cells)]
        known = [heading for heading in headings if heading is not None]
        if len(known) > len(best[1]):
            best = number, known
    if not best[1]:
        needed = ", ".join(column.example for column in columns if column.required)
        row = likely_headings(records[:within], columns)
        raise InputError(
            Fault(
                str(path),
                "has no heading that is known",
                ", ".join(f'"{cell}"' for cell in row.cells if cell != ""),
                f"begin with a row like: {needed}",
                id=NO_HEADING,
            )
        )
    return best


def likely_headings(records: Sequence[Record], columns: Sequence[Column]) -> Record:
    """The row that has most known headings, or else most cells: what a logger writes above it about itself has few."""

    def rank(record: Record) -> tuple[int, int]:
        known = [known_heading_of(cell, place, columns) for place, cell in enumerate(record.cells)]
        return sum(heading is not None for heading in known), sum(cell != "" for cell in record.cells)

    return max(records, key=rank)


def checked(
    path: Path, headings: Sequence[Heading], first: Record, body: Sequence[Record], columns: Sequence[Column]
) -> list[Heading]:
    """The headings with the scale of their units. Raises if one is missing, double or without a unit."""
    faults: list[Fault] = []
    known: list[Heading] = []
    for heading in headings:
        twin = next((other for other in known if other.column is heading.column), None)
        where = f'{path.name} column "{heading.written}"'
        result = _scaled(where, heading, body) if twin is None else _twice(where, heading, twin)
        if isinstance(result, Fault):
            faults.append(result)
        else:
            known.append(result)
    missing = [column for column in columns if column.required and all(h.column is not column for h in headings)]
    raise_if_any([*(_missing(path, column, headings, first) for column in missing), *faults])
    return known


def _twice(where: str, heading: Heading, twin: Heading) -> Fault:
    """The fault of a heading beside a twin of the same column."""
    name = heading.column.name
    problem = f'means the same as "{twin.written}"'
    return Fault(where, problem, name.replace("_", " "), "leave out one of the two", id=SAME_MEANING, column=name)


def _scaled(where: str, heading: Heading, body: Sequence[Record]) -> Heading | Fault:
    """The heading with the scale of its unit, or the fault of a unit that does not fit or is not there."""
    column, quantity = heading.column, heading.column.quantity
    if quantity is None or (quantity.unit == "1" and not heading.unit):
        return heading
    if quantity.unit == "1":
        return Fault(where, "takes no unit", heading.unit, "it is a plain number; leave the unit out")
    if heading.unit == PERCENT and column.share is not None:
        return dataclasses.replace(heading, scale=0.01)
    if heading.unit:
        scale = _scale(where, heading.unit, quantity)
        return scale if isinstance(scale, Fault) else dataclasses.replace(heading, offset=scale[0], scale=scale[1])
    if _cells_tell_unit(heading, body):
        return heading
    remedy = f'write "{heading.written} [{quantity.shown_in}]"'
    return Fault(where, "needs a unit", "", remedy, id=NEEDS_UNIT, column=column.name)


def _cells_tell_unit(heading: Heading, body: Sequence[Record]) -> bool:
    """Test whether a heading needs no unit: its cells are empty, have units, or are asked each for its own."""
    # in place of numbers with a unit there may be words and shares
    words = heading.column.words
    if heading.column.share is not None or (words and not heading.column.required):
        return True
    cells = [record.cells[heading.place] for record in body if heading.place < len(record.cells)]
    filled = [cell for cell in cells if cell not in NOTHING and str(cell).casefold() not in words]
    return not filled or any(isinstance(cell, str) and units.unit_in(cell.replace(",", ".")) for cell in filled)


def _missing(path: Path, column: Column, headings: Sequence[Heading], first: Record) -> Fault:
    """The fault of a column that is not there, perhaps under a name that is not known."""
    known = {heading.place for heading in headings}
    others = {
        bare(" ".join(words)): cell
        for place, cell in enumerate(first.cells)
        if place not in known and isinstance(cell, str)
        for words in [_WORD.findall(cell)]
        for words in (words, words[:-1])  # with and without a unit behind the name
        if words
    }
    names = [bare(name) for name in (column.name, *column.aliases)]
    alike = [other for name in names for other in difflib.get_close_matches(name, others, n=1, cutoff=0.7)]
    guess = f'write it for "{others[alike[0]]}"' if alike else f"it may also be called {', '.join(column.aliases[:3])}"
    return Fault(path.name, f'has no column "{column.example}"', "", guess, id=NO_COLUMN, column=column.name)


def unused(first: Record, headings: Sequence[Heading], body: Sequence[Record]) -> list[str]:
    """Columns that hold something and are not known."""
    known = {heading.place for heading in headings}
    values = {place: f'"{cell}"' for place, cell in enumerate(first.cells) if cell != "" and place not in known}
    for record in body:
        nameless = (place for place, cell in enumerate(record.cells[: len(first.cells)]) if cell != "")
        values |= {place: f"column {place + 1} (no heading)" for place in nameless if place not in {*known, *values}}
    return [values[place] for place in sorted(values)]


NAMES: Mapping[str, tuple[str, ...]] = {
    "name": (
        "model", "model no", "part number", "part no", "designation", "type", "size",
        "Bezeichnung", "Typ", "Materialnummer", "Teilenummer",
    ),
    "nominal_diameter": (
        "d0", "screw diameter", "shaft diameter", "screw shaft diameter", "screw shaft outer diameter",
        "shaft outer diameter", "Nenndurchmesser", "Nenn-Ø", "Spindeldurchmesser",
    ),
    "lead": ("Ph", "P", "Steigung", "Spindelsteigung"),
    "ball_diameter": ("Dw", "Da", "Db", "ball", "ball size", "balls", "Kugeldurchmesser", "Kugel-Ø"),
    "turns": (
        "i", "circuits", "number of turns", "number of circuits", "effective turns", "effective turns of balls",
        "loaded circuits", "number of loaded circuits", "loaded turns", "number of loaded turns",
        "rows x turns", "turns x rows", "turns x circuits", "circuits x turns",
        "Umläufe", "tragende Umläufe", "Anzahl Umläufe", "Anzahl tragender Umläufe", "Zahl der Umläufe",
        "Zahl der tragenden Umläufe", "Kugelumläufe",
    ),
    "starts": ("number of starts", "thread starts", "Gangzahl", "Anzahl Gänge"),
    "pitch_circle_diameter": (
        "Dpw", "dm", "dp", "ball circle", "ball circle diameter", "pitch circle", "PCD", "BCD",
        "ball centre-to-centre diameter", "ball center-to-center diameter",
        "Teilkreisdurchmesser", "Teilkreis-Ø", "Teilkreis", "Kugelmittenkreisdurchmesser",
    ),
    "root_diameter": (
        "dr", "d2", "dc", "root", "core diameter", "minor diameter", "thread minor diameter",
        "Kerndurchmesser", "Kern-Ø",
    ),
    "contact_angle": ("alpha", "α", "Kontaktwinkel", "Druckwinkel"),
    "conformity": ("f", "groove conformity", "Schmiegung"),
    "dynamic_load_rating": (
        "Ca", "C", "Cdyn", "dynamic", "dynamic load", "dynamic rating", "dynamic axial load rating",
        "basic dynamic load rating", "dyn. load rating",
        "dynamische Tragzahl", "dyn. Tragzahl", "Tragzahl dyn.", "Tragzahl dynamisch", "dynamische axiale Tragzahl",
    ),
    "static_load_rating": (
        "C0a", "C0", "Coa", "Co", "C0stat", "static", "static load", "static rating", "static axial load rating",
        "basic static load rating", "stat. load rating",
        "statische Tragzahl", "stat. Tragzahl", "Tragzahl stat.", "Tragzahl statisch", "statische axiale Tragzahl",
    ),
    "rigidity": (
        "stiffness", "Rnu", "K", "nut rigidity", "nut stiffness", "axial stiffness", "rigidity_10pct",
        "Steifigkeit", "Mutternsteifigkeit", "axiale Steifigkeit",
    ),
    "nut_outer_diameter": (
        "D1", "nut outer diameter", "nut outside diameter", "nut diameter", "outer diameter of the nut",
        "nut body diameter", "Mutternaußendurchmesser", "Mutteraußendurchmesser", "Außendurchmesser Mutter",
        "Mutterdurchmesser", "Mutterndurchmesser", "Mutter-Ø",
    ),
    "nut": ("nut type", "kind of nut", "Mutterart", "Muttertyp", "Mutter"),
    "preload": (
        "preload force", "axial preload", "Fpr", "Vorspannung", "Vorspannkraft", "axiale Vorspannung",
    ),
    "preload_share": ("preload share",),
    "seal_torque": (
        "seals", "seal", "torque of seals", "seal friction torque", "seal drag", "wipers", "wiper torque",
        "Dichtung", "Dichtungen", "Dichtungsmoment", "Dichtungsreibmoment", "Reibmoment der Dichtungen", "Abstreifer",
    ),
    "price_index": ("relative price", "Preisindex"),
    "speed_limit": (
        "DN", "DN value", "limit of DN", "characteristic speed", "DN-Wert", "Drehzahlkennwert",
    ),
    "make": ("maker", "manufacturer", "brand", "Hersteller", "Fabrikat"),
    "recirculation": ("return of balls", "ball return", "recirculation system", "Umlenkung", "Kugelrückführung"),
    "spacer_balls": ("spacers", "spacer ball", "Distanzkugeln", "Abstandskugeln", "Zwischenkugeln", "Trennkugeln"),
    "log": ("test log", "log file", "measurement", "Messung", "Messdatei", "Messprotokoll"),
    "source": ("Quelle",),
}  # fmt: skip
_RATING = ("load rating", "basic load rating", "axial load rating", "Tragzahl")
HINTS: Mapping[str, tuple[str, ...]] = {
    "nominal_diameter": ("d", "diameter", "Durchmesser"),
    "pitch_circle_diameter": ("diameter", "Durchmesser"),
    "root_diameter": ("diameter", "Durchmesser"),
    "ball_diameter": ("diameter", "Durchmesser"),
    "dynamic_load_rating": _RATING,
    "static_load_rating": _RATING,
}
#: Names that are others in small letters, as they are without blanks and underscores.
CAPITALS: Mapping[str, tuple[str, ...]] = {"nut_outer_diameter": ("D1",)}
#: Columns whose cells may be products: "2x2.5".
PRODUCTS = ("turns",)
#: Columns whose cells may be shares: "7 %", and the column of the share.
SHARES: Mapping[str, str] = {"preload": "preload_share"}
#: What the standard seals of a vendor are called, and none.
STANDARD, NONE = "standard", "none"
#: What stands for a ball diameter that the catalogue does not print.
ESTIMATED = "estimate"
#: What a column that says yes or no has.
YES, NO = "yes", "no"
#: Words in place of a number, or the only ones, in small letters.
WORDS: Mapping[str, Mapping[str, str]] = {
    "seal_torque": {
        STANDARD: STANDARD, **dict.fromkeys((NONE, "no", "without", "ohne", "keine", "nein"), NONE),
    },
    "ball_diameter": dict.fromkeys((ESTIMATED, "estimated", "?", "schätzen", "geschätzt"), ESTIMATED),
    "spacer_balls": {
        **dict.fromkeys((YES, "true", "with", "ja", "mit", "1:1"), YES),
        **dict.fromkeys((NO, "false", NONE, "without", "nein", "ohne", "keine"), NO),
    },
}  # fmt: skip
