"""Provenance of results: version, model and sources."""

from __future__ import annotations

from typing import Any

from ballscrew.basis.references import citations_of, documentation, keys_in
from ballscrew.basis.version import __version__
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.schema.duty_schema import CONSTANT_EFFICIENCY
from ballscrew.physics.components.materials import Lubricant


def of_case(case: Case) -> dict[str, Any]:
    """Version, model and sources of a case."""
    label = case.model.label if case.efficiency is None else CONSTANT_EFFICIENCY
    return {"version": __version__, "model": label, "references": references(case)}


def references(case: Case) -> list[str]:
    """Keys of the sources of the model, and of the oil where it was made from a grade."""
    made_by = Lubricant.from_grade if "grade" in case.oil else Lubricant.from_data_sheet
    of_oil = keys_in(documentation(made_by)) if case.oil else ()
    losses = {} if case.nut is None else case.nut.losses
    of_nut = [key for law in losses.values() for key in keys_in(documentation(type(law)))]
    of_model = citations_of(case.model) if case.efficiency is None else ()
    return list(dict.fromkeys([*of_model, *of_oil, *of_nut]))
