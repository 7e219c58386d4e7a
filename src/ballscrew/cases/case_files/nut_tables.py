"""Parts of the nut and its surroundings, built from the sections of a case, with notes on derived numbers."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.errors import MISSING, Fault, InputError, either, nearest
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.case_files.case import PreloadNote
from ballscrew.cases.schema.case_schema import law_of
from ballscrew.cases.schema.reader import Reader
from ballscrew.cases.screw_tables import catalogue
from ballscrew.cases.screw_tables.nut_kinds import ENDS, LISTED, LOSSES, NUT_FIELDS
from ballscrew.files.tables.cells import Share
from ballscrew.physics.components.nut import NUTS, Bodies, Nut, Scatter, SingleNut
from ballscrew.physics.components.screw import SINGLE_NUT, BallScrew
from ballscrew.physics.laws.nut_losses import ParasiticLaw
from ballscrew.physics.sizing import ratings
from ballscrew.physics.sizing.catalogue import TURNS_WITHOUT_LOAD, CatalogueRow, is_shipped
from ballscrew.physics.sizing.checks import groove_bottom
from ballscrew.physics.sizing.installation import Installation, Limits
from ballscrew.physics.sizing.ratings import Ratings, lists_preload, load_ratings, ratings_of

#: The nut of a case that names one without preload.
SINGLE = SingleNut(angle_under_load=True)
#: Where a load rating is from: listed, or computed.
RATING_SOURCES = ("as listed", "computed from the geometry (ISO 3408-5)")
#: The geometry that ratings follow from.
_RATED = ("pitch_circle_diameter", "lead", "ball_diameter", "loaded_balls", "contact_angle", "starts")
#: What a screw with a nut consists of besides its balls.
_OF_NUT = ("nut", "bodies", "deviations", "losses")


def row_of(reader: Reader, table: Mapping[str, Any]) -> CatalogueRow | None:
    """The catalogue row that a table [screw] names: of ``rows``, or of its file, or of those shipped."""
    name, file = table.get("catalogue"), table.get("catalogue_file")
    if not isinstance(name, str) or not isinstance(file, str | None):
        return None
    try:
        rows = reader.rows
        if rows is None:
            rows = catalogue.load(None if file is None else reader.folder / file)[0]
        return catalogue.named(rows, name, "screw.catalogue", file)
    except InputError as error:
        reader.faults += error.faults
        return None


def screw_ratings(screw: BallScrew, row: CatalogueRow | None) -> Ratings:
    """The ratings of a screw by its geometry. Raises ``InputError`` for one that no catalogue could have."""
    made = None if row is None else row.screw()
    same = made is not None and all(getattr(made, name) == getattr(screw, name) for name in _RATED)
    if row is not None and same:
        return ratings_of(dataclasses.replace(row, spacer_balls=screw.nut.spacer_balls))
    _as_row(screw)
    return load_ratings(screw)


def _as_row(screw: BallScrew) -> CatalogueRow:
    """The row that a catalogue would have of a screw; its turns are those of its balls, which are whole."""
    d_m, d_w, phi = screw.pitch_circle_diameter, screw.ball_diameter, screw.lead_angle
    balls_per_turn = math.floor(math.pi * d_m / d_w / math.cos(phi))
    return CatalogueRow(
        name="screw",
        nominal_diameter=d_m,
        pitch_circle_diameter=d_m,
        lead=screw.lead,
        ball_diameter=d_w,
        turns=screw.loaded_balls / balls_per_turn + TURNS_WITHOUT_LOAD,
        starts=screw.starts,
        contact_angle=screw.contact_angle,
        conformity=screw.screw_conformity,
        spacer_balls=screw.nut.spacer_balls,
    )


def root_diameter(screw: BallScrew, listed: Mapping[str, float]) -> float:
    """The diameter at the bottom of the groove: listed, or from the conformity."""
    return listed.get("root_diameter") or float(groove_bottom(screw))


def faults_of_root(screw: BallScrew | None, listed: Mapping[str, float]) -> list[Fault]:
    """The fault of a listed diameter at the bottom of the groove that reaches the centres of the balls."""
    root, quantity = listed.get("root_diameter"), LISTED["root_diameter"]
    if screw is None or root is None or root < screw.pitch_circle_diameter:
        return []
    given = f"{units.shown(root, quantity)} and a pitch circle of {units.shown(screw.pitch_circle_diameter, quantity)}"
    remedy = "give the diameter at the bottom of the groove, or leave it out: it follows from the conformity"
    return [Fault("screw.root_diameter", "leaves no room for the balls", given, remedy)]


def dynamic_rating(screw: BallScrew, row: CatalogueRow | None, listed: Mapping[str, float]) -> tuple[float, str]:
    """The dynamic load rating of one nut body and where it is from. Raises ``InputError`` where there is none."""
    if "dynamic_load_rating" in listed:
        return listed["dynamic_load_rating"], RATING_SOURCES[0]
    return screw_ratings(screw, row).dynamic, RATING_SOURCES[1]


def seal_torque_source(row: CatalogueRow | None, nut: Nut) -> str:
    """Source of the torque of the seals of a nut, where it is that of its row and the row says so; else empty."""
    seals = nut.losses.get("seals")
    if row is None or getattr(seals, "seal_torque", None) != row.seal_torque:
        return ""
    return row.seal_torque_source


def nut_of(
    reader: Reader,
    screw: BallScrew | None,
    row: CatalogueRow | None,
    listed: Mapping[str, float],
) -> tuple[Nut | None, Sequence[PreloadNote]]:
    """The nut with its bodies, deviations and losses, and a note on its preload.

    None without such a section, where the row, too, lists neither preload nor seals. What a section says counts, what
    it leaves out is that of the row. The contact angle of a single nut that a case names follows the load.
    """
    of_row = None if row is None else ratings.nut_of(row)
    if of_row is None and not any(name in reader for name in _OF_NUT):
        return None, ()
    part = reader.part()
    has_preload = row is not None and lists_preload(row)
    if "nut" in reader or has_preload:
        nut, notes = _nut(reader, screw, row, listed)
    else:
        spacers = row is not None and bool(row.spacer_balls)
        nut, notes = dataclasses.replace(SINGLE_NUT, spacer_balls=spacers), ()
    bodies = _bodies(reader, row, has_preload)
    scatter = reader.values_of("deviations") if "deviations" in reader else None
    losses = {**({} if of_row is None else of_row.losses), **_losses(reader)}
    if part.is_faulty or nut is None:
        return None, ()
    made = {
        "bodies": None if bodies is None else Bodies(**bodies),
        "deviations": None if scatter is None else Scatter(**scatter),
        "losses": losses,
    }
    nut = dataclasses.replace(nut, **{name: part for name, part in made.items() if part})
    reader.faults += _faults_of_bodies(nut, screw)
    return nut, notes


def _faults_of_bodies(nut: Nut, screw: BallScrew | None) -> Sequence[Fault]:
    """Faults of bodies that do not fit the screw."""
    if screw is None or nut.bodies is None:
        return ()
    try:
        nut.bodies.sized(screw)
    except InputError as error:
        return error.faults
    return ()


def _bodies(reader: Reader, row: CatalogueRow | None, has_preload: bool) -> dict[str, Any] | None:
    """The sizes of the bodies; the outer diameter of the nut is that of the row where the section leaves it out."""
    outer: dict[str, Any] = {}
    if row is not None and row.nut_outer_diameter is not None and not is_shipped(row):
        outer = {"nut_outer_diameter": row.nut_outer_diameter}
    if "bodies" in reader:
        return {**outer, **reader.values_of("bodies")}
    return outer if outer and has_preload else None


def _nut(
    reader: Reader,
    screw: BallScrew | None,
    row: CatalogueRow | None,
    listed: Mapping[str, float],
) -> tuple[Nut | None, Sequence[PreloadNote]]:
    part = reader.part()
    table = reader.tables.get("nut", {})
    values = reader.values_of("nut") if "nut" in reader else {}
    if part.is_faulty:
        return None, ()
    kind = values.pop("type", (row.nut or "single") if row is not None else None)
    if kind not in NUTS:
        if kind is None:
            reader.refuse("nut.type", MISSING, "", f"add type = {either(NUTS)}")
        else:
            reader.refuse("nut.type", "unknown kind of nut", kind, nearest(kind, NUTS))
        return None, ()
    reader.faults += _misplaced(kind, table)
    values = _with_preload(reader, kind, values, row)
    if part.is_faulty:
        return None, ()
    if row is not None and row.spacer_balls:
        values.setdefault("spacer_balls", True)
    if screw is not None and values.get("spacer_balls"):  # ratings are of the balls that carry
        screw = _with_spacers(reader, screw)
    made: Any = values
    preload = values.get("preload")
    if kind == "single":
        return SingleNut(angle_under_load=True, **made), ()
    if not isinstance(preload, Share):
        return NUTS[kind](**made), ()
    if screw is None:
        return None, ()  # its own faults are there already
    try:
        rating, source = dynamic_rating(screw, row, listed)
    except InputError:
        remedy = 'add dynamic_load_rating = "… kN" to [screw], or give a force'
        given = str(table.get("preload", f"{100 * preload:.4g} %"))
        reader.refuse("nut.preload", "is a share of a dynamic load rating that is not known", given, remedy)
        return None, ()
    made = {**values, "preload": preload * rating}
    return NUTS[kind](**made), (PreloadNote(preload, rating, source),)


def _with_preload(reader: Reader, kind: str, values: Mapping[str, Any], row: CatalogueRow | None) -> dict[str, Any]:
    """The fields of a nut, with the preload that the row lists where the kind needs one and none is given."""
    if "preload" not in fields_of(NUTS[kind]) or {"preload", "oversize"} & set(values):
        return dict(values)
    of_row = {} if row is None else _preload_of(row)
    if not of_row:
        remedy = 'add preload = "3 kN", or "7 %" of the dynamic load rating'
        reader.refuse("nut.preload", MISSING, "", remedy)
    return {**values, **of_row}


def _with_spacers(reader: Reader, screw: BallScrew) -> BallScrew | None:
    try:
        return dataclasses.replace(screw, nut=dataclasses.replace(SINGLE, spacer_balls=True))
    except InputError as error:
        reader.faults += error.faults
        return None


def _preload_of(row: CatalogueRow) -> dict[str, float]:
    """The preload that a row lists."""
    if row.preload_share is not None:
        return {"preload": Share(row.preload_share)}
    return {} if row.preload is None else {"preload": row.preload}


def _misplaced(kind: str, table: Mapping[str, Any]) -> list[Fault]:
    """Faults of fields that another kind of nut has."""
    fields = {name: {field.name for field in dataclasses.fields(nut)} for name, nut in NUTS.items()}
    return [
        Fault(
            f"nut.{name}",
            f'a nut of type "{kind}" has none',
            str(table[name]),
            f"leave it out, or take type = {either(n for n, own in fields.items() if name in own)}",
        )
        for name in (*NUT_FIELDS, "set_at_rest")
        if name in table and name not in fields[kind]
    ]


def _losses(reader: Reader) -> dict[str, ParasiticLaw]:
    """The laws of the table, by what they are of; none without a table."""
    if "losses" not in reader:
        return {}
    part = reader.part()
    reader.values_of("losses")
    if part.is_faulty:
        return {}
    return {
        slot: law_of(slot, written, next(iter(LOSSES[slot].values()))(), reader.faults)
        for slot, written in reader.tables["losses"].items()
    }


def installation(reader: Reader) -> Installation | None:
    """Mounting of the screw."""
    part = reader.part()
    values = reader.values_of("installation")
    if not part.is_faulty:
        if "unsupported_length" not in values:
            reader.refuse("installation.unsupported_length", MISSING, "", 'add unsupported_length = "1 m"')
        ends = values.get("ends")
        if ends is None:
            reader.refuse("installation.ends", MISSING, "", f"add ends = {either(ENDS)}")
        elif ends not in ENDS:
            reader.refuse("installation.ends", "unknown kind of ends", ends, nearest(ends, ENDS))
    return None if part.is_faulty else Installation(**{**values, "ends": ENDS[values["ends"]]})


def limits(reader: Reader) -> Limits:
    """The limits of the checks."""
    part = reader.part()
    values = reader.values_of("limits")
    return Limits() if part.is_faulty else Limits(**values)
