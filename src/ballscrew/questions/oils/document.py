"""The JSON document of oils and greases: what their data sheets state."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ballscrew.basis.quantities import fields_of
from ballscrew.basis.version import __version__
from ballscrew.cases.case_files.oil_library import TEXTS
from ballscrew.physics.components.data_sheet import DataSheet

_FIELDS = fields_of(DataSheet)


def document(sheets: Sequence[DataSheet]) -> dict[str, Any]:
    """All oils, SI."""
    return {
        "oils": [
            {
                "name": sheet.name,
                **{name: getattr(sheet, name) for name in _FIELDS},
                "viscosity_index": sheet.viscosity_index,
                **{name: getattr(sheet, name) or None for name in TEXTS},
            }
            for sheet in sheets
        ],
        "units": {name: quantity.unit for name, quantity in _FIELDS.items()},
        "provenance": {"version": __version__},
    }
