"""A case with the screws of a table in place of its own: oil, operating point and model are those of the case."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ballscrew.basis.quantities import fields_of
from ballscrew.cases.screw_tables.nut_kinds import LISTED
from ballscrew.physics.components.nut import Bodies
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.physics.sizing.ratings import NUTS, lists_preload

#: What a row says of the screw; the rest, as roughness and materials, is that of the case.
_OF_ROW = frozenset(
    {
        "catalogue", "catalogue_file", "pitch_circle_diameter", "lead", "ball_diameter", "loaded_balls",
        "contact_angle", "screw_conformity", "nut_conformity", "starts", *LISTED,
    }
)  # fmt: skip
#: What braces a nut: given by a row, or by the case.
_BRACING = ("preload", "oversize")


def tables_of_row(tables: Mapping[str, Any], row: CatalogueRow, file: Path | None) -> dict[str, Any]:
    """The tables of a case with the screw of a row of a file, or of one shipped, in place of its own.

    The geometry is that of the row, and so are the nut, its preload, its seals and its outer diameter where the row
    lists them; what it does not list is that of the case. Sizes of bodies of the case belong to its own screw.
    """
    made = dict(tables)
    screw = made.get("screw", {})
    if isinstance(screw, Mapping):
        kept = {name: value for name, value in screw.items() if name not in _OF_ROW}
        of_file = {} if file is None else {"catalogue_file": str(file.resolve())}
        made["screw"] = {"catalogue": row.name, **of_file, **kept}
    if isinstance(nut := made.get("nut"), Mapping):
        made["nut"] = _nut(nut, row)
    if isinstance(bodies := made.get("bodies"), Mapping):
        made["bodies"] = {name: value for name, value in bodies.items() if name not in fields_of(Bodies)}
    if isinstance(losses := made.get("losses"), Mapping) and row.seal_torque is not None:
        made["losses"] = {name: value for name, value in losses.items() if name != "seals"}
    return made


def _nut(nut: Mapping[str, Any], row: CatalogueRow) -> dict[str, Any]:
    """The section of the nut without what the row lists, and what its kind of nut does not have."""
    nut = {name: value for name, value in nut.items() if name != "spacer_balls" or row.spacer_balls is None}
    if not row.nut:
        return nut
    known = fields_of(NUTS[row.nut])
    listed = _BRACING if lists_preload(row) else ()
    # a name that no nut has stays: it is a fault of the case
    of_others = {name for kind in NUTS.values() for name in fields_of(kind)} - set(known)
    return {name: value for name, value in nut.items() if name not in {"type", *listed, *of_others}}
