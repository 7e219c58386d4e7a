"""Rows of catalogues for people and programs: those shipped, or those of a table of the user's own."""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, closest, nearest, raise_if_any
from ballscrew.basis.quantities import Quantity, fields_of, quantities_of
from ballscrew.basis.version import __version__
from ballscrew.cases.screw_tables.nut_kinds import LISTED, kind_in
from ballscrew.files.tables import headings
from ballscrew.files.tables.cells import Share
from ballscrew.files.tables.headings import Column
from ballscrew.files.tables.rows import Row, made, read
from ballscrew.physics.components.nut import NUTS
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.laws.nut_losses import SEAL_MAKER, SEAL_SOURCE, Seals
from ballscrew.physics.sizing.catalogue import (
    CONFORMITY_DOUBT,
    TURNS_WITHOUT_LOAD,
    CatalogueRow,
    UnknownRowError,
    catalogue,
    is_shipped,
)
from ballscrew.physics.sizing.own_nut import RATED, Estimate, completed, with_table_balls
from ballscrew.physics.sizing.ratings import lists_preload, ratings_of

#: Quantities of a row that are listed, and that follow from it.
FIELDS = fields_of(CatalogueRow)
DERIVED = {name: quantity for name, quantity in quantities_of(CatalogueRow).items() if name not in FIELDS}
_DEFAULTS = {field.name: field.default for field in dataclasses.fields(CatalogueRow)}
_REQUIRED = ("nominal_diameter", "lead", "ball_diameter", "turns")


def _column(name: str, quantity: Quantity | None = None) -> Column:
    names, hints = headings.NAMES.get(name, ()), headings.HINTS.get(name, ())
    return Column(
        name,
        quantity,
        names,
        name in _REQUIRED,
        hints,
        product=name in headings.PRODUCTS,
        capitals=headings.CAPITALS.get(name, ()),
        share=FIELDS.get(headings.SHARES.get(name, "")),
        words=headings.WORDS.get(name, {}),
    )


COLUMNS = (
    _column("name"),
    *(_column(name, quantity) for name, quantity in FIELDS.items()),
    _column("nut"),
    _column("make"),
    _column("recirculation"),
    _column("spacer_balls"),
    _column("log"),
    _column("source"),
)
#: A word of sizes: diameter x lead, perhaps one of them alone, perhaps the ball diameter or the turns.
#: Distance of sizes that are the same but for rounding.
SAME_SIZE = 1e-6
#: Diameter and lead in mm in order codes of makers: 3210 in BNFN3210-5, 40x10 in R40x10; R1532 of Rexroth has no size.
_ORDER_CODE = re.compile(
    r"(?<!\d)(?!(?<=R)\d{4}(?!\d))([1-9]\d{1,2})(?:x|(?=\d{2}(?!\d)))0?([1-9]\d?)(?!\d)", re.IGNORECASE
)
_SIZES = re.compile(r"(?=.*\d)(\d+(?:\.\d+)?)?[x×](\d+(?:\.\d+)?)?(?:[x×](\d+(?:\.\d+)?))?")
#: Load ratings as listed and by the geometry agree within this share, or the row says so.
RATINGS_AGREE = 0.05
#: Preloads of the kinds of nut, as catalogues have them.
EXAMPLE_PRELOADS: Mapping[str, str] = {"double": "7 %", "offset-lead": "7 %", "oversize-balls": "5 %"}


class Screws(dict[str, CatalogueRow]):
    """The rows of a table of one's own by name, its notes, and the logs of the rows that have one."""

    def __init__(self, rows: Sequence[CatalogueRow], file: str, notes: Sequence[str], logs: Mapping[str, Path]) -> None:
        super().__init__({row.name: row for row in rows})
        self.file, self.notes, self.logs = file, tuple(notes), logs

    def __missing__(self, name: str) -> CatalogueRow:
        raise UnknownRowError(Fault(self.file, "unknown row", str(name), nearest(str(name), self, most=5)))


def screws(path: str | Path, *, keep_going: bool = False) -> Screws:
    """The rows of a table of screws of one's own, CSV or a spreadsheet, by name: ``screws("mine.csv")["A"].screw()``.

    Returns :class:`Screws` of the file ``path``. Their ``notes`` name columns that are not used, rows whose ball
    diameter is estimated (the word ``estimate`` in its cell), and with ``keep_going`` rows that are left out.

    Raises :class:`~ballscrew.basis.errors.InputError` with all faults of the table; with ``keep_going`` only if no row
    is good.
    """
    path = Path(path)
    table = read(path, COLUMNS)
    taken: dict[str, int] = {}
    logs: dict[str, Path] = {}
    odd: list[str] = []
    result, notes = made(table, lambda row: _made(row, path, taken, logs, odd), keep_going)
    result = with_table_balls(result)
    estimated = [row.name for row in result if row.ball_diameter_source]
    if estimated:
        notes.append(
            f"{path.name}: ball diameters are estimated of {len(estimated)} rows: {', '.join(estimated[:5])}"
            + (", …" if len(estimated) > 5 else "")
        )
    return Screws(result, path.name, [*notes, *odd], logs)


def load(path: Path | None, keep_going: bool = False) -> tuple[Mapping[str, CatalogueRow], Sequence[str]]:
    """The rows of a table, or those shipped, by name, and what is to be said of rows left out."""
    if path is None:
        return catalogue(), ()
    result = screws(path, keep_going=keep_going)
    return result, result.notes


def _made(row: Row, path: Path, taken: dict[str, int], logs: dict[str, Path], odd: list[str]) -> CatalogueRow:
    """The catalogue row of a row of a table; without a name it is called by its sizes."""
    values = dict(row.values)
    is_estimated = values.get("ball_diameter") == headings.ESTIMATED
    if is_estimated:
        del values["ball_diameter"]
    file, log = path.name, values.pop("log", None)
    if isinstance(values.get("preload"), Share):
        values["preload_share"] = float(values.pop("preload"))
    name = values.setdefault("name", _called_by_sizes(values))
    values.setdefault("source", f"{file} row {row.line}")
    faults: list[Fault] = []
    if name in taken:
        faults.append(Fault("row.name", "is given twice", name, f"row {taken[name]} has it, too: name both apart"))
    if isinstance(seals := values.get("seal_torque"), str):
        values["seal_torque"] = _seal_torque(seals, values, faults)
        if seals == headings.STANDARD:
            values["seal_torque_source"] = seal_source(str(values.get("make", "")))
    if "spacer_balls" in values:
        values["spacer_balls"] = values["spacer_balls"] == headings.YES
    try:
        fields: dict[str, Any] = {**values, "nut": kind_in(values.get("nut", ""))}
        if is_estimated:
            own = completed(fields)
            catalogue_row = own.row
            odd += [f"{path.name} row {row.line}: {one.text}" for one in own.warnings]
        else:
            catalogue_row = CatalogueRow(**fields)
        catalogue_row.screw()
    except InputError as error:
        # a share stands in the column of the preload
        of_row = [_in_column(fault, row) for fault in error.faults]
        raise InputError(*faults, *of_row) from None
    raise_if_any(faults)
    taken[name] = row.line
    if log is not None:
        logs[name] = path.parent / log
    return catalogue_row


def _seal_torque(word: str, values: Mapping[str, Any], faults: list[Fault]) -> float | None:
    """The torque of seals that a word stands for."""
    if word == headings.NONE:
        return 0.0
    try:
        return float(Seals.of_table(values["nominal_diameter"], values["lead"]).seal_torque)
    except InputError as error:
        remedy = f"{error.faults[0].remedy}; write the torque"
        faults.append(Fault("row.seal_torque", "no standard seals are known of this size", word, remedy))
        return None


def seal_source(make: str) -> str:
    """The source of the torque of standard seals, which are those of one maker."""
    if SEAL_MAKER in make.casefold():
        return f"standard seals of {SEAL_SOURCE}"
    if not make:
        return f"standard seals of {SEAL_SOURCE}, of whatever make the nut is"
    return f"standard seals of {SEAL_SOURCE}, not of {make}"


def _in_column(fault: Fault, row: Row) -> Fault:
    """The fault of a share, in the column of the preload where it stands there."""
    parent, _, name = fault.where.rpartition(".")
    column = next((column for column, share in headings.SHARES.items() if share == name), name)
    return dataclasses.replace(fault, where=f"{parent}.{column}") if column in row.written else fault


def _called_by_sizes(values: Mapping[str, Any]) -> str:
    names = ("nominal_diameter", "lead", "ball_diameter")
    sizes = [units.from_si(values[name], FIELDS[name]) for name in names if name in values]
    return f"{'x'.join(f'{size:.6g}' for size in sizes)}-{values['turns']:g}"


def chosen(rows: Mapping[str, CatalogueRow], words: str, file: Path | None = None) -> list[CatalogueRow]:
    """The rows that have all these words; a fault names the file they are of.

    A word of sizes is nominal diameter x lead in mm, then the ball diameter or the turns: ``40x``, ``40x10``, ``x10``,
    ``40x10x6``. Any other word stands in name, source or kind of nut.
    """
    asked = words.casefold().split()
    catalogue_rows = [row for row in rows.values() if all(_has(row, word) for word in asked)]
    if not catalogue_rows:
        where = "catalogue" if file is None else file.name
        remedy = "leave them out to see all rows"
        if any(map(_SIZES.fullmatch, asked)):
            remedy += "; sizes are diameter x lead in mm: 40x10, or 40x for all of 40 mm"
        raise InputError(Fault(where, "no row has these words", words, remedy))
    return catalogue_rows


def computable(rows: Sequence[CatalogueRow]) -> tuple[list[CatalogueRow], list[str]]:
    """The rows of which a torque is computed, and a note on the others; a fault where all are others."""
    kept = [row for row in rows if not row.refusal]
    if not kept:
        rows[0].screw()
    reasons: dict[str, dict[str, None]] = {}
    for row in rows:
        if row.refusal:
            reasons.setdefault(row.refusal, {})[row.family] = None
    notes = [f"no torque is computed of {', '.join(families)}: {reason}" for reason, families in reasons.items()]
    return kept, notes


def _has(row: CatalogueRow, word: str) -> bool:
    """Test whether a row has a word: as its sizes where it is one of sizes, else in its texts."""
    sizes = _SIZES.fullmatch(word)
    if sizes is None:
        return word in f"{row.name} {row.source} {row.nut}".casefold()
    diameter, lead, last = (None if size is None else float(size) for size in sizes.groups())
    return (
        _is(diameter, 1e3 * row.nominal_diameter)
        and _is(lead, 1e3 * row.lead)
        and (_is(last, 1e3 * row.ball_diameter) or _is(last, row.turns))
    )


def _is(asked: float | None, value: float) -> bool:
    """Test whether a size is the one that is asked for, if any is."""
    return asked is None or math.isclose(asked, value, rel_tol=1e-9)


def named(rows: Mapping[str, CatalogueRow], name: str, where: str = "", file: str | Path | None = None) -> CatalogueRow:
    """The row of that name, whatever its capitals; a fault is one of ``where`` the name was given, or of the file."""
    if name in rows:
        return rows[name]
    asked = name.casefold()
    for known in rows:
        if asked == known.casefold():
            return rows[known]
        # the part number of a general catalogue is the name without the maker, blanks where one likes
        numbers = (known.partition("-")[2].casefold(), known.casefold().replace("-", "", 1))
        if "".join(asked.split()) in numbers and rows[known].family:
            return rows[known]
    code = _ORDER_CODE.search(name)
    sizes = None if code is None else (float(code[1]), float(code[2]))
    containing = [f'"{known}"' for known in rows if name and name.casefold() in known.casefold()][:3]
    if containing:
        remedy = f"did you mean {' or '.join(containing)}?"
    elif (alike := closest(name, rows)) and (sizes is None or _distance(rows[alike], *sizes) < SAME_SIZE):
        remedy = nearest(name, rows)
    elif sizes is not None and rows:
        names = ", ".join(
            f'"{row.name}"' for row in _nearest_in_size((row for row in rows.values() if not row.refusal), *sizes)
        )
        remedy = f'nearest in size: {names}; "ballscrew catalogue own" makes a nut of its catalogue numbers'
    else:
        words = "" if file is None else f" --rows {file}"
        remedy = f'see "ballscrew catalogue list{words}"'
    where = where or ("catalogue" if file is None else Path(file).name)
    raise InputError(Fault(where, "unknown row", name, remedy))


def _nearest_in_size(rows: Iterable[CatalogueRow], diameter: float, lead: float) -> list[CatalogueRow]:
    """The three rows nearest to a diameter and a lead in mm, by their ratios."""
    return sorted(rows, key=lambda row: _distance(row, diameter, lead))[:3]


def _distance(row: CatalogueRow, diameter: float, lead: float) -> float:
    """The distance of a row from a diameter and a lead in mm, by their ratios; 0 for the same."""
    return math.hypot(math.log(1e3 * row.nominal_diameter / diameter), math.log(1e3 * row.lead / lead))


# -- for people -----------------------------------------------------------------------------------


#: Where the balls of rows shipped are from that their maker does not print.
_BY_GROOVE = "an estimate, by the depth of the groove and the load ratings"


def assumed(row: CatalogueRow) -> dict[str, str]:
    """Values, in words, that stand for what a catalogue leaves out, by field."""
    angle = units.shown(row.contact_angle, FIELDS["contact_angle"])
    words = {
        "starts": "one thread start",
        "contact_angle": f"contact angle {angle}, the usual one",
        "conformity": f"conformity {row.conformity:g} ± {CONFORMITY_DOUBT:g}, as most listed root diameters imply",
    }
    values = {name: text for name, text in words.items() if getattr(row, name) == _DEFAULTS[name]}
    if row.pitch_circle_diameter is None:
        values["pitch_circle_diameter"] = (
            "pitch circle as large as the nominal diameter; those that catalogues list are mostly 1.5 to 5 % larger"
        )
    if row.ball_diameter_source == headings.ESTIMATED:
        values["ball_diameter"] = f"ball diameter: {_BY_GROOVE}"
    elif row.ball_diameter_source:
        values["ball_diameter"] = f"ball diameter: {row.ball_diameter_source}"
    values["loaded_turns"] = f"{row.turns_without_load:g} turns without load where the balls leave and enter" + (
        " (ISO 3408-5)" if row.turns_without_load == TURNS_WITHOUT_LOAD else ""
    )
    return values


def notes(row: CatalogueRow) -> list[str]:
    """Ratings that are listed but far from those by the geometry, and why no torque is computed, in words."""
    words = []
    for name, computed in zip(RATED, ratings_of(row), strict=True):
        listed = getattr(row, name)
        if listed is not None and not abs(ratio := listed / float(computed) - 1) <= RATINGS_AGREE:
            words.append(f"{name.replace('_', ' ')}: listed {ratio + 1:.2f} times that by the geometry")
    return [*words, *([f"no torque is computed: {row.refusal}"] if row.refusal else [])]


def assumed_fields(row: CatalogueRow) -> frozenset[str]:
    """The fields of the screw that stand for what the row leaves out."""
    names = {*assumed(row)} - {"loaded_turns"}
    return frozenset(names | {"screw_conformity", "nut_conformity"} if "conformity" in names else names)


def case_text(row: CatalogueRow, estimates: Sequence[Estimate] = ()) -> str:
    """A complete case file of a row: a usual oil, a tenth of the dynamic load rating, 600 rpm.

    Each number that is one of the ``estimates`` has a comment with its band and where it is from.
    """
    screw = row.screw()
    fields = fields_of(BallScrew)
    names = [
        "pitch_circle_diameter",
        "lead",
        "ball_diameter",
        "loaded_balls",
        "contact_angle",
        "screw_conformity",
        "nut_conformity",
    ]
    names += ["starts"] if screw.starts > 1 else []
    names += [one.name for one in estimates if one.name.endswith("_roughness")]
    unlisted = assumed(row)
    comments = {
        "pitch_circle_diameter": "the nominal diameter; the row lists no pitch circle"
        if row.pitch_circle_diameter is None
        else "",
        "loaded_balls": f"{row.balls_per_turn} a turn, {row.loaded_turns:g} of {row.turns:g} turns; one nut body",
        "contact_angle": "not listed, the usual one" if "contact_angle" in unlisted else "",
        "screw_conformity": f"not listed, good to {CONFORMITY_DOUBT:g}" if "conformity" in unlisted else "",
        "ball_diameter": _comment_of_ball(row),
    }
    for one in estimates:
        comments |= dict.fromkeys(_ESTIMATED_AS.get(one.name, (one.name,)), _comment(one))
    listed = [name for name in LISTED if getattr(row, name) is not None]
    rating = row.dynamic_load_rating
    load = 1000.0 if rating is None else rating / 10
    of_load = (
        "an example; the row lists no dynamic load rating"
        if rating is None
        else f"a tenth of C_a = {rating / 1000:.6g} kN"
    )
    lines = [
        f"# {row.name}: {row.source}",
        f"# The screw of a catalogue row; {'preload, ' if _has_example_preload(row) else ''}oil and operating point "
        "are examples." + (f" Nut: {row.nut}." if row.nut else ""),
        "",
        "[screw]",
        *(_setting(name, _written(getattr(screw, name), fields[name]), comments.get(name, "")) for name in names),
        *(_setting(name, _written(getattr(row, name), LISTED[name]), "as listed") for name in listed),
        "",
        "[nut]",
        *_nut(row),
        "",
        "[bodies]  # elastic screw and nut of a usual size, as ballscrew check takes them; without it they are rigid",
        *([] if is_shipped(row) else _listed_part(row, "nut_outer_diameter", "nut_outer_diameter")),
        "",
        *_seals(row),
        "[lubricant]",
        'grade = "ISO VG 100"',
        'temperature = "40 degC"',
        "",
        "[operation]",
        _setting("axial_load", f'"{load / 1000:.6g} kN"', of_load),
        _setting("screw_speed", '"600 rpm"', ""),
    ]
    # no letters that a terminal or a redirection could write in another encoding than UTF-8
    return "\n".join(lines).encode("ascii", "backslashreplace").decode()


def _comment_of_ball(row: CatalogueRow) -> str:
    if row.ball_diameter_source == headings.ESTIMATED:
        return _BY_GROOVE
    return f"estimated: {row.ball_diameter_source}" if row.ball_diameter_source else ""


#: Fields of a case that an estimate stands in, where they have other names.
_ESTIMATED_AS: Mapping[str, tuple[str, ...]] = {
    "ball_circle": ("pitch_circle_diameter",),
    "conformity": ("screw_conformity", "nut_conformity"),
}


def _comment(one: Estimate) -> str:
    """Comment beside an estimated number: its band, and where it is from."""
    band = " to ".join(units.shown(value, one.quantity, digits=4) for value in (one.low, one.high))
    # a case file is written without letters of other encodings
    return f"estimated, {band}: {one.source}".replace("\N{MICRO SIGN}", "u")


def _has_example_preload(row: CatalogueRow) -> bool:
    """Test whether the nut of a row needs a preload that the row does not list."""
    return not lists_preload(row) and "preload" in fields_of(NUTS[row.nut or "single"])


def _nut(row: CatalogueRow) -> list[str]:
    """The nut of a row, with a preload as an example where its kind has one."""
    kind = row.nut or "single"
    lines = [_setting("type", f'"{kind}"', "" if row.nut else "the row says nothing of its nut")]
    if lists_preload(row) and row.preload_share is not None:
        lines.append(
            _setting("preload", f'"{100 * row.preload_share:.12g} %"', "as listed, of the dynamic load rating")
        )
    elif lists_preload(row):
        lines += _listed_part(row, "preload", "preload")
    elif _has_example_preload(row):
        comment = "of the dynamic load rating" + ("" if row.dynamic_load_rating else ", computed from the geometry")
        lines.append(_setting("preload", f'"{EXAMPLE_PRELOADS[kind]}"', f"an example: {comment}"))
    return [*lines, *(["spacer_balls = true"] if row.spacer_balls else [])]


def _listed_part(row: CatalogueRow, name: str, key: str) -> list[str]:
    value = getattr(row, name)
    return [] if value is None else [_setting(key, _written(value, FIELDS[name]), "as listed")]


def _seals(row: CatalogueRow) -> list[str]:
    if not row.seal_torque:
        return []
    written = _written(row.seal_torque, FIELDS["seal_torque"])
    return ["[losses]", _setting("seals.seal_torque", written, row.seal_torque_source or "as listed"), ""]


def _setting(name: str, value: str, comment: str) -> str:
    setting = f"{name} = {value}"
    return f"{setting:<38}  # {comment}" if comment else setting


def _written(value: float, quantity: Quantity) -> str:
    text = units.written(value, quantity)
    return text if quantity.unit == "1" else f'"{text}"'


# -- for programs ---------------------------------------------------------------------------------


def list_document(rows: Sequence[CatalogueRow]) -> dict[str, Any]:
    """All rows, SI."""
    return _with_units({"rows": [_document(row) for row in rows]})


def show_document(row: CatalogueRow) -> dict[str, Any]:
    """One row, SI."""
    return _with_units({**_document(row), "assumed": assumed(row)})


def _document(row: CatalogueRow) -> dict[str, Any]:
    return {
        "name": row.name,
        "nut": row.nut or None,
        "source": row.source,
        "seal_torque_source": row.seal_torque_source or None,
        "ball_diameter_source": row.ball_diameter_source or None,
        "family": row.family or None,
        "computed": dict(zip(RATED, map(float, ratings_of(row)), strict=True)),
        "notes": notes(row),
        "row": {name: getattr(row, name) for name in FIELDS},
        "derived": {name: getattr(row, name) for name in DERIVED},
    }


def _with_units(document: dict[str, Any]) -> dict[str, Any]:
    parts = {"row": FIELDS, "derived": DERIVED, "computed": {name: FIELDS[name] for name in RATED}}
    values = {part: {name: quantity.unit for name, quantity in names.items()} for part, names in parts.items()}
    return document | {"units": values, "provenance": {"version": __version__}}
