"""The JSON document of a run: inputs, results and units in SI, verdicts, checks, warnings, provenance."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ballscrew.basis.quantities import fields_of, quantities_of
from ballscrew.basis.records import documents
from ballscrew.cases.case_files import case_file, provenance
from ballscrew.cases.case_files.named_calibration import vendor_rows_like
from ballscrew.physics.components.contact import RaceState
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.friction.result import QUADRANTS, FrictionResult
from ballscrew.questions.run.compute import Run
from ballscrew.questions.run.nut_loads import NutLoads, nut_loads
from ballscrew.questions.shared import declared

_KNOWN = quantities_of(FrictionResult)
#: Inputs, which are no results.
_OPERATION = fields_of(OperatingState)
#: The results that have the units of the fields of a quadrant.
_OF_QUADRANT = {"shaft_torque": "drive_torque", "shaft_power": "friction_power", "efficiency": "efficiency"}


def document(run: Run) -> dict[str, Any]:
    """The document of a run; with a nut it has the loads of the balls, too."""
    return {
        "inputs": case_file.inputs(run.case),
        "results": results(run),
        **({} if run.nut is None else {"loads": declared.document(nut_loads(run.nut))}),
        **vendor_rows(run),
        "units": result_units(run),
        "warnings": documents(run.warnings),
        "verdicts": documents(run.verdicts),
        "checks": [],
        "provenance": provenance.of_case(run.case),
    }


def vendor_rows(run: Run) -> dict[str, Any]:
    """The ratio model / vendor of the no-load torque for the rows most like the nut, where there are such rows."""
    near = vendor_rows_like(run.case)
    if near is None:
        return {}
    calibration = None if run.case.calibration is None else run.case.calibration.name
    ratios = {"mean_ratio": near.mean, "std_ratio": near.scatter}
    return {"vendor_rows": {"set": near.data, "calibration": calibration, **ratios, "rows": list(near.rows)}}


def list_document(runs: Mapping[str, Run]) -> list[dict[str, Any]]:
    """The documents of the screws of a table with their names, without the loads ball by ball."""
    listed: list[dict[str, Any]] = [{"name": name, **document(run)} for name, run in runs.items()]
    for each in listed:
        if "loads" in each:
            del each["loads"]["balls"], each["units"]["loads"]["balls"]
    return listed


def results(run: Run) -> dict[str, Any]:
    """All results in SI, as plain numbers and nested tables."""
    found = run.friction
    return {
        **{name: getattr(found, name) for name in run.quantities if name not in _OPERATION},
        **({} if run.nut is None else {"preload_drag": run.nut.preload_drag, **run.nut.drag_coefficients}),
        "contributions": dict(found.contributions),
        "quadrants": {name: each._asdict() for name, each in run.quadrants.items()},
        "validity": {reason: bool(mask) for reason, mask in found.validity.items()},
        **run.contacts,
    }


def result_units(run: Run) -> dict[str, Any]:
    """The units of :func:`results` and of the loads, in the same places."""
    own = {name: q.unit for name, q in run.quantities.items() if name not in (*_OPERATION, "valid")}
    torque, of_contact = _KNOWN["screw_torque"].unit, quantities_of(RaceState)
    quadrant = {name: _KNOWN[alike].unit for name, alike in _OF_QUADRANT.items()}
    return {
        **own,
        **({} if run.nut is None else {"preload_drag": torque}),
        "contributions": dict.fromkeys(run.friction.contributions, torque),
        "quadrants": dict.fromkeys(QUADRANTS, quadrant),
        **{side: {name: of_contact[name].unit for name in values} for side, values in run.contacts.items()},
        **({} if run.nut is None else {"loads": declared.units_of(NutLoads)}),
    }
