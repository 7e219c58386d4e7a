"""Text of a run on the terminal: torque and efficiency, its parts, directions, loads and contacts."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from rich.console import Console
from rich.table import Table

from ballscrew.basis import units
from ballscrew.basis.quantities import quantities_of
from ballscrew.basis.records import Record
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.nut_tables import seal_torque_source
from ballscrew.physics.components.contact import RaceState
from ballscrew.physics.friction.result import MECHANISMS, FrictionResult, Quadrant
from ballscrew.physics.sizing.rigidity import RECALLED_ACCURACY_FACTORS, AxialRigidity
from ballscrew.physics.solvers.load_distribution import BallLoads
from ballscrew.questions.run.compute import Run
from ballscrew.questions.run.makers import beside_rules, contradiction
from ballscrew.questions.run.nut_state import NutState
from ballscrew.questions.shared.text_tables import shown_or_dash, table_of

#: The first results, in this order; a nut has no contact load and entrainment speed of all its balls.
SHOWN = (
    "screw_torque", "nut_torque", "ideal_torque", "drive_torque", "efficiency", "back_driving_efficiency",
    "friction_coefficient", "friction_angle", "friction_power", "contact_load", "entrainment_speed",
)  # fmt: skip
_FILM = (
    "semi_major_axis", "semi_minor_axis", "maximum_pressure", "minimum_film_thickness", "film_parameter",
    "friction_coefficient",
)  # fmt: skip
_FORCES = (
    "hydrodynamic_rolling_force", "sliding_force", "traction_limit", "tangential_force", "curvature_friction_moment",
    "elastic_resistance_moment", "friction_torque",
)  # fmt: skip
#: Results of a contact where curvature is the only slip, and elsewhere.
SHOWN_OF_CONTACT: Mapping[bool, Sequence[str]] = {
    True: (*_FILM, "pure_rolling_offset", *_FORCES),
    False: (*_FILM, "spin_parameter", "creep_speed", "lateral_slip_speed", *_FORCES),
}
_SHOWN_OF_MOST_LOADED = ("contact_load", *_FILM, "spin_parameter", "friction_torque")
#: Short labels of a contact's results.
SHORT: Mapping[str, str] = {
    "semi_major_axis": "semi-axis across the rolling direction",
    "semi_minor_axis": "semi-axis along the rolling direction",
    "spin_parameter": "spin parameter E_s",
    "creep_speed": "creep of the race",
    "lateral_slip_speed": "lateral slip",
    "traction_limit": "traction limit",
}
_BAR_WIDTH = 24
_KNOWN, _LOADS, _CONTACT = quantities_of(FrictionResult), quantities_of(BallLoads), quantities_of(RaceState)
_RIGIDITY = quantities_of(AxialRigidity)
_TORQUE, _PRESSURE = _KNOWN["screw_torque"], quantities_of(FrictionResult)["maximum_pressure"]


def print_run(run: Run) -> None:
    """Print all tables and texts of a run."""
    console = Console(highlight=False)

    def line(text: str, style: str | None = None) -> None:
        console.print(text, style=style, markup=False, soft_wrap=True)

    case, friction = run.case, run.friction
    line(f"{descriptions.title(case)}\n", "bold")
    for text in (
        descriptions.design(case, plain_text=True),
        *descriptions.assumptions(case, run.ball_to_ball_force),
    ):
        line(text, "dim")
    console.print()
    console.print(results_table(run))
    for text in rules_contradict(run):
        line(text, "dim")
    for record in run.verdicts:
        line(record.text, "bold")
    for record in _warnings(run):
        line(f"beware  {record.name}: {record.text}", "yellow")
    for text in (descriptions.left_out(case), *descriptions.of_fit(case)):
        line(text)
    if any(float(part) for part in friction.contributions.values()):
        console.print(parts_table(friction.contributions, float(friction.screw_torque), console.encoding))
    console.print(_quadrants(run.quadrants, float(friction.axial_load) != 0))
    if run.nut is not None:
        console.print(_loads(run.nut))
        console.print(_rigidity(run.nut))
        for text in run.nut.rigidity.assumed:
            line(f"rigidity: {text}", "dim")
    console.print(_contacts(run))


def _warnings(run: Run) -> list[Record]:
    """The conditions that fail; that balls skid is left out without load, and where a verdict has it."""
    unloaded = not any(flank.load for flank in run.touching)
    repeated = unloaded or any(record.id == "verdict.skid.at_rest" for record in run.verdicts)
    return [record for record in run.conditions if not (repeated and record.id == "validity.skid")]


def results_table(run: Run) -> Table:
    """The first results, with the torque of a full bath of oil beside one that is starved of it."""
    table = table_of("Torque and efficiency", "", "")
    starved = ["flooded_torque"] if run.friction.starvation else []
    for name in (SHOWN[0], *starved, *SHOWN[1:]):
        if name in run.quantities:
            known = run.quantities[name]
            table.add_row(known.info.meaning, shown_or_dash(getattr(run.friction, name), known))
    if run.nut is not None:
        for label, torque in unloaded_rows(run):
            table.add_row(label, shown_or_dash(torque, _TORQUE))
        for name, value in run.nut.drag_coefficients.items():
            if math.isfinite(value):
                table.add_row(_KNOWN[name].info.meaning, shown_or_dash(value, _KNOWN[name]))
    return table


def unloaded_rows(run: Run) -> list[tuple[str, float]]:
    """The drag torque of the nut with seals and other losses, these, and without them, as makers' rules have it."""
    nut = run.nut
    if nut is None:
        return []
    losses = [(_of_loss(name, run.case), torque) for name, torque in nut.idle_losses.items() if torque]
    rules = [(one.label, float(one.by_rule.torque)) for one in beside_rules(run.case, nut)]
    lost = [name for name, torque in nut.idle_losses.items() if torque]
    whole = [(drag_label(lost, included=True), nut.preload_drag), *losses] if lost else []
    return [*whole, (drag_label(lost, included=False), nut.drag_of_balls), *rules]


def drag_label(losses: Sequence[str], *, included: bool) -> str:
    """``drag torque without seals``; of a nut with other losses with the names of those that it has."""
    names = [MECHANISMS.get(name, name).replace("_", " ") for name in losses] or ["seals"]
    return f"drag torque {'with' if included else 'without'} {' and '.join(names)}"


def rules_contradict(run: Run) -> list[str]:
    """By how much the rules of makers contradict each other; nothing of a nut without preload."""
    found = beside_rules(run.case, run.nut)
    return [units.filled(contradiction(found))] if found else []


def _of_loss(name: str, case: Case) -> str:
    """A loss, of seals with the table that their torque is from, where it is not the row's own."""
    source = seal_torque_source(case.row, case.screw.nut) if name == "seals" else ""
    return f"of which {MECHANISMS.get(name, name)}" + (f" ({source})" if source else "")


def parts_table(contributions: Mapping[str, Any], total: float, encoding: str) -> Table:
    """The parts of the torque as numbers and bars; zero parts are left out."""
    block = "█" if "utf" in encoding.lower() else "#"
    table = table_of("\nWhere the friction torque on the screw comes from", "", "", "", "")
    table.columns[-1].justify = "left"
    for mechanism, value in contributions.items():
        part = float(value)
        if part == 0:
            continue
        share = part / total if total else 0.0
        bar = block * round(_BAR_WIDTH * max(0.0, min(share, 1.0))) if math.isfinite(share) else ""
        label = MECHANISMS.get(mechanism, mechanism)
        table.add_row(label, shown_or_dash(part, _TORQUE), f"{share:.1%}" if math.isfinite(share) else "–", bar)
    return table


def _quadrants(quadrants: Mapping[str, Quadrant], loaded: bool) -> Table:
    """The four quadrants of load and rotation; the signs are those of the first."""
    table = table_of("\nThe screw, by direction of load and rotation", "", "load", "rotation", "torque", "power", "η")
    for name, quadrant in quadrants.items():
        signs = ["+" if sign > 0 else "-" for sign in (quadrant.load_sign, quadrant.speed_sign)]
        efficiency = float(quadrant.efficiency)
        drives = efficiency > 0 or quadrant.load_sign == quadrant.speed_sign or math.isnan(efficiency)
        table.add_row(
            name,
            *signs,
            shown_or_dash(quadrant.shaft_torque, _KNOWN["drive_torque"]),
            shown_or_dash(quadrant.shaft_power, _KNOWN["friction_power"]),
            shown_or_dash(efficiency, _KNOWN["efficiency"]) if drives else "locks" if loaded else "–",
        )
    return table


def _loads(nut: NutState) -> Table:
    table = table_of("\nLoads of the balls, and stiffness of the nut", "", "least", "mean", "greatest")
    for flank, label in ((nut.loaded, "the flank that carries the load"), (nut.relieved, "the other flank")):
        if flank is not None:
            for values, name, what in ((flank.load, "forward_load", "load"), (flank.angle, "forward_angle", "angle")):
                table.add_row(f"{what} on {label}", *(units.shown(value, _LOADS[name]) for value in values))
    for name in stiffness_fields(nut):
        table.add_row(_LOADS[name].info.meaning, "", shown_or_dash(float(getattr(nut.loads, name)), _LOADS[name]))
    table.add_row(_PRESSURE.info.meaning, "", "", shown_or_dash(nut.maximum_pressure, _PRESSURE))
    return table


def _rigidity(nut: NutState) -> Table:
    table = table_of("\nRigidity by ISO 3408-4", "", "")
    for meaning, value in rigidity_rows(nut.rigidity):
        table.add_row(meaning, value)
    return table


def rigidity_rows(found: AxialRigidity) -> list[tuple[str, str]]:
    """Rigidities by ISO 3408-4 and the deflection of the drive, what is known of them."""
    rows = [
        (quantity.info.meaning, units.shown(float(getattr(found, name)), quantity))
        for name, quantity in _RIGIDITY.items()
        if math.isfinite(float(getattr(found, name)))
    ]
    if found.accuracy_factor is not None or not math.isfinite(found.nut):
        return rows
    most, least = RECALLED_ACCURACY_FACTORS
    ends = " to ".join(units.shown(factor * found.nut, _RIGIDITY["nut"]) for factor in (least, most))
    meaning = f"R_nu,ar, {least:g} to {most:g} of it by accuracy grade (values unchecked)"
    return [*rows[:3], (meaning, ends), *rows[3:]]


def stiffness_fields(nut: NutState) -> list[str]:
    """The loads that describe stiffness, and those of the preload where there is one."""
    return ["deflection", "rigidity", *(["remaining_preload", "lift_off_load"] if nut.preload else [])]


def _contacts(run: Run) -> Table:
    if run.nut is None:
        title, names = "\nContacts", SHOWN_OF_CONTACT[run.curvature_alone]
    else:
        title, names = "\nContacts of the most loaded ball", _SHOWN_OF_MOST_LOADED
    table = table_of(title, "", "screw", "nut")
    for name in names:
        if name in run.contacts["screw"]:
            cells = [shown_or_dash(side[name], _CONTACT[name]) for side in run.contacts.values()]
            table.add_row(SHORT.get(name, _CONTACT[name].info.meaning), *cells)
    return table
