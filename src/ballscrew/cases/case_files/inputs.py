"""The inputs of a case in SI, by section."""

from __future__ import annotations

import dataclasses
from typing import Any

from ballscrew.basis.quantities import fields_of
from ballscrew.basis.references import citations_of, documentation, keys_in
from ballscrew.basis.version import __version__
from ballscrew.cases.case_files import duty_tables, support_tables
from ballscrew.cases.case_files.case import USUAL_LIMITS, Case
from ballscrew.cases.case_files.nut_tables import seal_torque_source
from ballscrew.cases.schema.case_schema import name_of_law
from ballscrew.cases.schema.duty_schema import CONSTANT_EFFICIENCY
from ballscrew.cases.screw_tables.nut_kinds import ENDS, kind_of
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import Nut
from ballscrew.physics.components.screw import MATERIALS
from ballscrew.physics.friction.law_names import LAWS
from ballscrew.physics.sizing.installation import Installation


def inputs(case: Case) -> dict[str, Any]:
    """All inputs of a case in SI, by section: what ``--json`` prints."""
    model = case.model
    of_row = {} if case.origins.row is None else {"catalogue": case.origins.row.name, "source": case.origins.row.source}
    materials = {name: _numbers(getattr(case.screw, name)) for name in MATERIALS}
    return {
        "screw": {**of_row, **_numbers(case.screw), **case.origins.listed, **materials},
        "lubricant": {**case.origins.oil, **_numbers(case.lubricant)},
        **({} if case.origins.travels else {"operation": _numbers(case.operation)}),
        "model": {
            "name": model.name,
            **_numbers(model),
            **{slot: _law(slot, getattr(model, slot)) for slot in LAWS},
        }
        if case.efficiency is None
        else {"name": CONSTANT_EFFICIENCY, "efficiency": case.efficiency},
        **({} if case.nut is None else _inputs_of_nut(case, case.nut)),
        **({} if case.installation is None else {"installation": _mounting(case.installation)}),
        **({} if case.limits is USUAL_LIMITS else {"limits": _numbers(case.limits)}),
        **duty_tables.inputs(case.axis, case.motion, case.motor, case.surroundings),
        **support_tables.inputs(case.bearings, case.axis),
    }


def _inputs_of_nut(case: Case, nut: Nut) -> dict[str, Any]:
    bodies = None if nut.bodies is None else nut.bodies.sized(case.screw)
    scatter = nut.parts.get("deviations")
    own = {name: value for name, value in _numbers(nut).items() if value is not None}
    return {
        "nut": {
            "type": kind_of(nut),
            **own,
            **{name: True for name in ("spacer_balls", "set_at_rest") if getattr(nut, name)},
        },
        **(
            {}
            if bodies is None
            else {"bodies": {**_numbers(bodies), "same_side": bodies.same_side, "swelling": bodies.swelling}}
        ),
        **({} if scatter is None else {"deviations": _numbers(scatter)}),
        **({"losses": _losses(case, nut)} if nut.losses else {}),
    }


def _losses(case: Case, nut: Nut) -> dict[str, Any]:
    """The laws of the losses, of seals with the source of their torque where the row of the screw has one."""
    values = {slot: _law(slot, law) for slot, law in nut.losses.items()}
    seals, source = values.get("seals"), seal_torque_source(case.origins.row, nut)
    return {**values, "seals": {**seals, "source": source}} if source and isinstance(seals, dict) else values


def _mounting(mounted: Installation) -> dict[str, Any]:
    numbers = {name: value for name, value in _numbers(mounted).items() if value is not None}
    return {**numbers, "ends": next(name for name, known in ENDS.items() if known is mounted.ends)}


def _law(slot: str, law: Any) -> str | dict[str, Any]:
    """A law as a file names it: by name alone, or with its coefficients."""
    name = name_of_law(slot, law)
    if not dataclasses.is_dataclass(law):
        return name
    return {"law": name, **{field.name: getattr(law, field.name) for field in dataclasses.fields(law)}}


def _numbers(part: Any) -> dict[str, Any]:
    return {name: getattr(part, name) for name in fields_of(type(part))}


def of_case(case: Case) -> dict[str, Any]:
    """Version, model and sources of a case."""
    label = case.model.label if case.efficiency is None else CONSTANT_EFFICIENCY
    return {"version": __version__, "model": label, "references": references(case)}


def references(case: Case) -> list[str]:
    """Keys of the sources of the model, and of the oil where it was made from a grade."""
    made_by = Lubricant.from_grade if "grade" in case.origins.oil else Lubricant.from_data_sheet
    of_oil = keys_in(documentation(made_by)) if case.origins.oil else ()
    losses = {} if case.nut is None else case.nut.losses
    of_nut = [key for law in losses.values() for key in keys_in(documentation(type(law)))]
    of_model = citations_of(case.model) if case.efficiency is None else ()
    return list(dict.fromkeys([*of_model, *of_oil, *of_nut]))
