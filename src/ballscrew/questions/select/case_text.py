"""The case file of a candidate: ``ballscrew duty``, ``axis``, ``warm-up``, ``run`` and ``report`` go on with it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.atomic_files import atomic_write
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.case_files.case_file import ASIDE, ESTIMATES
from ballscrew.cases.case_files.named_calibration import NO_CALIBRATION, with_calibration
from ballscrew.cases.case_files.opened_file import moved
from ballscrew.cases.schema.case_schema import sections
from ballscrew.cases.screw_tables.catalogue import assumed_fields
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.questions.select.candidates import Candidate, assumes_preload, case_tables
from ballscrew.questions.select.compute import Ranked, Selection
from ballscrew.questions.select.need import Need


def tables(candidate: Candidate, need: Need, model: str | None = None) -> dict[str, Any]:
    """The case file of a candidate; one that moves has its steady travel as operation, for all other questions.

    ``model`` is the name of the one that it was judged by, in place of that of the need.
    """
    known, at = fields_of(OperatingState), candidate.case.operation
    steady = {name: units.written(getattr(at, name), known[name]) for name in ("axial_load", "screw_speed")}
    made = case_tables(need, candidate.variant)
    if need.moves and "operation" not in made:
        made["operation"] = steady
    if model is not None:
        made["model"] = {**made.get("model", {}), "name": model}
    estimates = _estimates(candidate, need, made)
    if estimates:
        made[ESTIMATES] = estimates
    if candidate.case.origins.calibration is not None:
        return {**with_calibration(made, candidate.case.origins.calibration.name)}
    return {**with_calibration(made, NO_CALIBRATION)} if "calibration" in made.get("model", {}) else made


def save(to: Path, selection: Selection, chosen: Ranked, said: str) -> None:
    """Write the case of a candidate; ``said`` is what its checks say."""
    with atomic_write("--to", to) as path:
        path.write_text(text(selection, chosen, said, folder=to.parent), encoding="utf-8")


def text(selection: Selection, chosen: Ranked, said: str, *, folder: Path = Path()) -> str:
    """The case of a candidate as TOML for a file in ``folder``; what was assumed stands in its comments."""
    import tomlkit

    candidate, need = chosen.candidate, selection.need
    made = tables(candidate, need, selection.model)
    if need.folder.resolve() != folder.resolve():
        kept = made.pop(ASIDE, None)  # no command reads it
        made = {**moved(made, need.folder, folder), **({} if kept is None else {ASIDE: kept})}
    order = [name for name in (*sections(), *made) if name in made]
    ordered = {name: made[name] for name in dict.fromkeys(order)}
    head = [
        f"{candidate.variant.label}: rank {chosen.rank} of {len(selection.ranked)} for {need.name}",
        f"written by ballscrew select; checks: {said}",
        *(f"assumed: {note}" for note in _assumed(candidate, need)),
    ]
    if ESTIMATES in made:
        head.append("[estimates] repeats the values that were estimated: change one above, and it is yours")
    comments = "".join(f"# {' '.join(line.split())}\n" for line in head)
    return f"{comments}\n{tomlkit.dumps(ordered)}"


def _estimates(candidate: Candidate, need: Need, made: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """The values of a case that were estimated, by section: those of its need still hold if the case has them."""
    variant = candidate.variant
    places = [*need.assumed_oil]
    if assumes_preload(need, variant):
        places.append("nut.preload")
    if need.length_is_stroke:
        places.append("installation.unsupported_length")
    if variant.file is not None:  # the numbers of the row stand in the case
        given = need.tables.get("screw", {})
        places += [f"screw.{name}" for name in sorted(assumed_fields(variant.row)) if name not in given]
    estimates = {section: dict(values) for section, values in made.get(ESTIMATES, {}).items()}
    for place in places:
        section, _, name = place.partition(".")
        if name in made.get(section, {}):
            estimates.setdefault(section, {})[name] = made[section][name]
    return estimates


def _assumed(candidate: Candidate, need: Need) -> list[str]:
    """What was assumed of the need and of the row, once each."""
    of_run = () if candidate.run is None else candidate.run.assumed
    return [*dict.fromkeys((*need.notes, *of_run))]
