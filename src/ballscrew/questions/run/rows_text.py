"""Text of runs of the screws of a table: one line each."""

from __future__ import annotations

from collections.abc import Mapping

from ballscrew.basis import units
from ballscrew.basis.output.wrapping import aligned
from ballscrew.basis.quantities import quantities_of
from ballscrew.cases.screw_tables.nut_kinds import NUT_FIELDS, kind_of
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.run.compute import Run
from ballscrew.questions.shared.text_tables import shown_or_dash

_HEADINGS = ("name", "nut", "preload", "friction torque", "drag torque", "drive torque", "eff.", "eff. back")
_RESULT = quantities_of(FrictionResult)


def list_text(runs: Mapping[str, Run]) -> str:
    """One line a screw; below, the conditions that fail, and at which screws."""
    lines = aligned([_HEADINGS, *(_cells(name, run) for name, run in runs.items())])
    return "\n".join([*lines, *_warnings(runs)])


def _cells(name: str, run: Run) -> tuple[str, ...]:
    result, nut = run.friction, run.nut
    preload = "–" if nut is None or not nut.preload else units.shown(nut.preload, NUT_FIELDS["preload"])
    unloaded = "–" if nut is None else shown_or_dash(nut.preload_drag, _RESULT["screw_torque"])
    torques = [shown_or_dash(getattr(result, field), _RESULT[field]) for field in ("screw_torque", "drive_torque")]
    shares = (
        shown_or_dash(getattr(result, field), _RESULT[field]) for field in ("efficiency", "back_driving_efficiency")
    )
    return (name, "–" if nut is None else kind_of(nut.nut), preload, torques[0], unloaded, torques[1], *shares)


def _warnings(runs: Mapping[str, Run]) -> list[str]:
    found: dict[str, list[str]] = {}
    for name, run in runs.items():
        for record in run.warnings:
            found.setdefault(f"beware  {record.name}", []).append(f"{name}: {record.text}")
    return [f"{head}: {'; '.join(dict.fromkeys(texts))}" for head, texts in found.items()]
