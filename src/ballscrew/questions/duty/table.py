"""A duty as tables in files: its states over time, the numbers of the cycle, torque and energy by cause, the checks."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ballscrew.axis.motion.profiles import Trapezoid
from ballscrew.basis import units
from ballscrew.basis.atomic_files import atomic_write
from ballscrew.basis.quantities import Info, Quantity, fields_of
from ballscrew.questions.duty.compute import NUMBERS, DutyReport
from ballscrew.questions.shared.check_lines import quantity_of
from ballscrew.questions.shared.row_tables import RowTable, put, write_csv, xlsx_bytes

_MOTION = fields_of(Trapezoid)
_TORQUE, _ENERGY, _TURNING = NUMBERS["torque_rms"], NUMBERS["energy_lost"], NUMBERS["mean_speed"]
_TIME, _POWER, _LOAD = NUMBERS["cycle_time"], NUMBERS["power_peak"], NUMBERS["mean_load"]
_PRESSURE = Quantity("maximum_pressure", "Pa", Info("p_0", "largest contact pressure", "MPa"))


def states(report: DutyReport) -> RowTable:
    """One row for each state of the cycle, in order of time."""
    duty, at = report.duty, report.duty.states
    columns: dict[str, Any] = {}

    def column(quantity: Quantity, values: Any, name: str) -> None:
        shown = np.asarray(units.from_si(np.asarray(values, dtype=float), quantity), dtype=float)
        columns[units.heading(quantity, name)] = [float(f"{v:.12g}") + 0.0 if np.isfinite(v) else None for v in shown]

    column(_TIME, at.time, "time")
    columns["phase"] = [at.phases[number] for number in at.phase]
    column(_TIME, at.weight, "weight")
    column(_MOTION["stroke"], at.position, "position")
    column(_MOTION["speed"], at.speed, "speed")
    column(_MOTION["acceleration"], at.acceleration, "acceleration")
    column(_LOAD, duty.axial_load, "axial load")
    column(_TURNING, duty.screw_speed, "screw speed")
    column(_TURNING, duty.motor_speed, "motor speed")
    column(_TORQUE, duty.torque, "motor torque")
    for name, part in duty.parts.items():
        if np.any(part):
            column(_TORQUE, np.broadcast_to(part, at.time.shape), name)
    column(_TORQUE, duty.rest_friction, "friction that holds at rest")
    column(_TORQUE, report.rule.torque, "motor torque by the rule of catalogues")
    column(_POWER, duty.power, "power")
    column(_PRESSURE, duty.screw.maximum_pressure, "largest contact pressure")
    columns["film parameter"] = [float(f"{v:.12g}") if np.isfinite(v) else None for v in duty.screw.film_parameter]
    columns["valid"] = [int(value) for value in duty.screw.valid]
    return RowTable(list(columns), [list(row) for row in zip(*columns.values(), strict=True)])


def numbers(report: DutyReport) -> RowTable:
    """The numbers of the cycle, one a row."""
    rows: list[list[Any]] = []
    for name, quantity in NUMBERS.items():
        cells: dict[str, Any] = {}
        put(cells, quantity, report.numbers[name])
        rows.append([quantity.info.meaning, *cells.values(), units.label(quantity)])
    return RowTable(["number", "value", "unit"], rows)


def parts(report: DutyReport) -> RowTable:
    """Torque and energy by cause."""
    rows: list[dict[str, Any]] = []
    for name, energy in report.duty.energy_by.items():
        cells: dict[str, Any] = {"part": name}
        put(cells, _TORQUE, report.torque_peak_by[name], "at the peak")
        put(cells, _TORQUE, report.torque_rms_by[name], "of the RMS")
        put(cells, _ENERGY, energy, "energy in a cycle")
        rows.append(cells)
    return RowTable(list(rows[0]), [list(cells.values()) for cells in rows])


def heat(report: DutyReport) -> RowTable:
    """Energy lost in a cycle and mean heat, by element and mechanism."""
    rows: list[dict[str, Any]] = []
    for element, parts in report.energy_lost_in.items():
        for name, energy in parts.items():
            cells: dict[str, Any] = {"element": element, "mechanism": name}
            put(cells, _ENERGY, energy, "energy in a cycle")
            put(cells, _POWER, energy / report.duty.states.cycle_time, "mean heat")
            rows.append(cells)
    headings = list(rows[0]) if rows else ["element", "mechanism"]
    return RowTable(headings, [list(cells.values()) for cells in rows])


def checks(report: DutyReport) -> RowTable:
    """The checks with their limits."""
    rows: list[list[Any]] = []
    for check in report.checks:
        shown: list[Any] = []
        for value in (check.value, check.limit):
            cells: dict[str, Any] = {}
            put(cells, quantity_of(check), value)
            shown += cells.values()
        holds = {True: "passes", False: "fails", None: "not judged"}[check.holds]
        rows.append(
            [
                check.name.replace("_", " "),
                *shown,
                units.label(quantity_of(check)),
                check.utilisation,
                holds,
                check.text,
            ]
        )
    return RowTable(["check", "value", "limit", "unit", "used", "verdict", "text"], rows)


def write(to: Path, report: DutyReport) -> None:
    """Write .csv (the states) or .xlsx (all tables), whole or not at all."""
    with atomic_write("--to", to) as path:
        if to.suffix.lower() == ".xlsx":
            tables = {
                "cycle": numbers(report),
                "torque": parts(report),
                "heat": heat(report),
                "checks": checks(report),
                "states": states(report),
            }
            path.write_bytes(xlsx_bytes(tables))
        else:
            write_csv(path, states(report))
