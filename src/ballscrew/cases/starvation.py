"""Starvation: the friction torque beside that of a starved track, with the track full of oil."""

from __future__ import annotations

import dataclasses

from ballscrew import units
from ballscrew.cases.case import Case
from ballscrew.friction.plausibility import starved
from ballscrew.friction.result import FrictionResult
from ballscrew.quantities import quantities_of
from ballscrew.records import Record

_TORQUE = quantities_of(FrictionResult)["screw_torque"]


def flooded_torque(case: Case, found: FrictionResult) -> float | None:
    """The friction torque of a case in a full bath of oil, N m; None where its result is not starved.

    The same model with a constant of replenishment of zero. What a ball screw has is not measured: the factor that
    starves is one of bearings (:func:`~ballscrew.equations.rolling.replenishment_factor`).
    """
    inlet = case.model.laws_with_coefficients.get("inlet")
    if inlet is None or not starved(found.parts, found.entrainment_speed):
        return None
    model = dataclasses.replace(case.model, inlet=dataclasses.replace(inlet, replenishment_constant=0.0))
    load, speed = case.operation.axial_load, case.operation.screw_speed
    return float(model(found.ball_screw, case.lubricant, axial_load=load, screw_speed=speed).screw_torque)


def verdict(torque: float, flooded: float | None) -> list[Record]:
    """Both torques in one sentence; empty where the result is not starved."""
    if flooded is None:
        return []
    text = (
        f"starved: {units.shown(torque, _TORQUE)} if oil this thick comes back into the track too late, "
        f"as in bearings; {units.shown(flooded, _TORQUE)} in a full bath of oil; "
        "which of them a ball screw has is not measured"
    )
    return [
        Record(
            id="verdict.starved", subject="screw_torque", text=text, severity="warning", holds=True, value=flooded,
            unit=_TORQUE.unit,
        )
    ]  # fmt: skip


def beside_band(high: float, flooded: float | None) -> list[Record]:
    """That a band has the starved track only, and where the torque of the full bath lies; empty where none starves."""
    if flooded is None:
        return []
    where = "above it" if flooded > high else "within it"
    text = (
        "the band takes oil to come back into the track late, as in bearings; "
        f"a full bath of oil gives {units.shown(flooded, _TORQUE)}: {where}"
    )
    return [
        Record(
            id="band.flooded", subject="screw_torque", text=text, severity="warning", holds=flooded <= high,
            value=flooded, limit=high, unit=_TORQUE.unit,
        )
    ]  # fmt: skip
