"""``--to modelica``: the screw as a component with the interfaces of the Modelica Standard Library."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import AngularSpeed, Info, Quantity, unit_of
from ballscrew.basis.records import Record
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.exports.export import Export
from ballscrew.exports.subject import HandOver
from ballscrew.exports.tables import notes
from ballscrew.exports.tables.friction_table import (
    DRIVE,
    INTERPOLATED,
    FrictionTable,
    as_export,
    friction_table,
    no_more_axes,
)
from ballscrew.exports.tables.friction_table import OPTIONS as OF_TABLES
from ballscrew.exports.tables.lossy_gear import LARGE, LossTable, loss_table
from ballscrew.exports.targets import Option

#: Speed below which friction is a slope through zero.
_SPEED_AT_REST = Quantity("speed_at_rest", unit_of(AngularSpeed) or "", Info("w_0", "speed of regularisation", "rpm"))
OPTIONS: Mapping[str, Option] = {
    **OF_TABLES,
    "speed_at_rest": Option(0.1, 'speed around rest at which friction is a slope: "1 rpm"', _SPEED_AT_REST),
}
#: Inertia of the motor of the example, kg m².
_ROTOR = 1e-3

_README = """\
BallScrewFriction.mo has the component BallScrew with an example; it needs the Modelica Standard Library, version 4.
LossyGear.txt has the parameters of the library's own gear, fitted, and says how far off it is.
"""
_FILE = """\
within;
package BallScrewFriction "A ball screw with its friction, as ballscrew computed it"
{notes}

  function frictionTorque "Size of the friction on the shaft, N m, and whether the model holds there"
    input Real load "Axial load on the nut, N: positive where a positive speed lifts it";
    input Real speed "Speed of the screw, rad/s";
    output Real torque "Friction torque, N m";
    output Real valid "1 where the model holds and load and speed are in their range, else 0";
  protected
    constant Integer n = {loads};
    constant Integer m = {speeds};
    constant Real F[n] = {F};
    constant Real W[m] = {W};
    constant Real M[n, m] = {M};
    constant Real V[n, m] = {V};
    Real f;
    Real w;
    Real a;
    Real b;
    Integer i;
    Integer j;
  algorithm
    f := min(max(load, F[1]), F[n]);
    w := min(max(speed, W[1]), W[m]);
    i := 1;
    while i < n - 1 and f > F[i + 1] loop
      i := i + 1;
    end while;
    j := 1;
    while j < m - 1 and w > W[j + 1] loop
      j := j + 1;
    end while;
    a := (f - F[i])/(F[i + 1] - F[i]);
    b := (w - W[j])/(W[j + 1] - W[j]);
    torque := (1 - a)*((1 - b)*M[i, j] + b*M[i, j + 1]) + a*((1 - b)*M[i + 1, j] + b*M[i + 1, j + 1]);
    valid := if load < F[1] or load > F[n] or speed < W[1] or speed > W[m] then 0.0
      else min(min(V[i, j], V[i, j + 1]), min(V[i + 1, j], V[i + 1, j + 1]));
  end frictionTorque;

  model BallScrew "Turns the rotation of flange_a into the travel of flange_b, with friction"
    Modelica.Mechanics.Rotational.Interfaces.Flange_a flange_a "Shaft";
    Modelica.Mechanics.Translational.Interfaces.Flange_b flange_b "Nut";
    constant Real torqueOfLoad(unit = "m/rad") = {ideal} "Torque without friction over axial load";
    constant Real travel(unit = "m/rad") = {travel} "Travel over rotation: the lead over 2 pi";
    parameter Real speedAtRest(unit = "rad/s", min = 0) = {at_rest} "Below it friction is a slope through zero";
    Real w(unit = "rad/s") "Speed of the screw";
    Real axialLoad(unit = "N") "Load on the nut";
    Real screwTorque(unit = "N.m") "Size of the friction on the shaft";
    Real valid "1 where the model holds, else 0";
  equation
    flange_b.s = travel*flange_a.phi;
    w = der(flange_a.phi);
    axialLoad = -flange_b.f;
    (screwTorque, valid) = BallScrewFriction.frictionTorque(axialLoad, w);
    flange_a.tau = torqueOfLoad*axialLoad + screwTorque*tanh(w/speedAtRest);
  end BallScrew;

  model Example "A motor lifts {mass} kg, lets it sink, and lifts it again"
    BallScrew screw;
    Modelica.Mechanics.Rotational.Components.Inertia rotor(
      J = {rotor}, phi(fixed = true, start = 0), w(fixed = true, start = 0));
    Modelica.Mechanics.Translational.Components.Mass mass(m = {mass});
    Modelica.Mechanics.Translational.Sources.ConstantForce weight(f_constant = -9.81*{mass});
    Modelica.Mechanics.Rotational.Sources.Torque motor;
    Modelica.Blocks.Sources.Sine torque(amplitude = {amplitude}, f = 1, offset = {offset});
  equation
    connect(torque.y, motor.tau);
    connect(motor.flange, rotor.flange_a);
    connect(rotor.flange_b, screw.flange_a);
    connect(screw.flange_b, mass.flange_a);
    connect(weight.flange, mass.flange_b);
  end Example;
  annotation(uses(Modelica(version = "4.0.0")));
end BallScrewFriction;
"""

_LOSSY_GEAR = """\
// Parameters of Modelica.Mechanics.Rotational.Components.LossyGear, with IdealGearR2T behind it for the travel.
// The gear knows a friction that no load changes, and efficiencies. Against the table of the component BallScrew its
// friction is off by up to {error:.3g} N m, {of_largest:.2g} % of the largest friction.{advice}
// Fitted and compared from {slowest:.6g} to {fastest:.6g} rad/s; the gear takes the size of the speed, and so the other
// direction as the same. Beyond these speeds nothing was compared.
// Columns: speed in rad/s, efficiency if the screw drives, if the load does, friction torque in N m in both.
Modelica.Mechanics.Rotational.Components.LossyGear friction(
  ratio = 1,
  lossTable = {rows});
Modelica.Mechanics.Rotational.Components.IdealGearR2T lead(ratio = {ratio});
"""


def export(handed: HandOver) -> Export:
    """The component in a package with an example, and the table of a LossyGear beside it."""
    at_rest = float(handed.options["speed_at_rest"])
    if not at_rest > 0:
        raise InputError(Fault("hand_over.speed_at_rest", "must be positive", f"{at_rest:g} rad/s", 'give "1 rpm"'))
    table = friction_table(handed)
    no_more_axes(table, "the component")
    errors = table.worst_errors(handed)
    gear = loss_table(table)
    text = component(handed, table, at_rest, notes.lines(handed, table.valid_range, errors))
    files = {
        "BallScrewFriction.mo": text.encode(),
        "LossyGear.txt": _lossy_gear(handed, gear).encode(),
        "README.txt": notes.text(handed, table.valid_range, errors, _README),
    }
    return as_export(handed, table, "modelica", files, errors, [_creeps(at_rest), *_gear_is_off(gear)])


def component(handed: HandOver, table: FrictionTable, at_rest: float, about: Sequence[str]) -> str:
    """The text of the package."""
    loads, speeds = (table.axes[name] for name in OPERATION[:2])
    travel = float(handed.subject.screw.lead) / (2 * math.pi)
    per_load = _torque_of_load(table)
    mass = float(f"{_example_load(float(loads[0]), float(loads[-1])) / 9.81:.1g}")
    held = mass * 9.81 * per_load
    # the swing of the motor turns the rotor up to a third of the range, against the friction at the load
    inertia = _ROTOR + mass * travel * travel
    friction = float(np.interp(9.81 * mass, loads, table.values[INTERPOLATED[0]].max(axis=1)))
    swing = friction + math.pi * inertia * min(-speeds[0], speeds[-1]) / 3
    return _FILE.format(
        notes="\n".join(f"  // {line}" for line in about),
        loads=len(loads),
        speeds=len(speeds),
        F=_vector(loads),
        W=_vector(speeds),
        M=_matrix(table.values[INTERPOLATED[0]]),
        V=_matrix(table.valid.astype(float)),
        ideal=repr(per_load),
        travel=repr(travel),
        at_rest=repr(at_rest),
        mass=f"{mass:g}",
        rotor=f"{_ROTOR:g}",
        amplitude=f"{swing:.3g}",
        offset=f"{held:.3g}",
    )


def _example_load(least: float, greatest: float) -> float:
    """A load within the range for the example, upwards where the range has such loads."""
    if greatest <= 0:
        return 9.81
    return math.sqrt(least * greatest) if least > 0 else 0.1 * greatest


def _torque_of_load(table: FrictionTable) -> float:
    """Torque without friction over the load: every law of it is a straight line through zero."""
    load, ideal = table.axes[OPERATION[0]], table.values[INTERPOLATED[1]][:, 0]
    return float(ideal[-1] / load[-1] if abs(load[-1]) > abs(load[0]) else ideal[0] / load[0])


def _lossy_gear(handed: HandOver, gear: LossTable) -> str:
    advice = "\n// That is much: take the component BallScrew instead." if gear.of_largest > LARGE else ""
    return _LOSSY_GEAR.format(
        error=gear.error,
        of_largest=100 * gear.of_largest,
        advice=advice,
        slowest=gear.speeds[0],
        fastest=gear.speeds[1],
        rows=_rows(gear.rows),
        ratio=repr(2 * math.pi / float(handed.subject.screw.lead)),
    )


def _creeps(at_rest: float) -> Record:
    message = (
        f"friction is a slope through zero up to about {units.in_unit(at_rest, 'rad/s', 6)}: a load that friction "
        "holds creeps there; do not read holding from this component"
    )
    return Record(text=message, id="hand_over.at_rest", subject=DRIVE, severity="warning", holds=False, value=at_rest)


def _gear_is_off(gear: LossTable) -> list[Record]:
    severe = gear.of_largest > LARGE
    percent = units.to_significant(100 * gear.of_largest, 2)
    message = (
        f"the table of a LossyGear is off by up to {units.in_unit(gear.error, 'N m', 2)}, {percent} % of the largest "
        f"friction{'; take the component instead' if severe else ''}"
    )
    return [
        Record(
            text=message,
            id="hand_over.lossy_gear",
            subject=INTERPOLATED[0],
            severity="warning" if severe else "info",
            holds=not severe,
            value=gear.of_largest,
            limit=LARGE,
        )
    ]


def _vector(values: Any) -> str:
    return "{" + ", ".join(map(repr, np.asarray(values).tolist())) + "}"


def _matrix(values: Any) -> str:
    return "{" + ",\n      ".join(map(_vector, values)) + "}"


def _rows(values: Any) -> str:
    return "[" + ";\n    ".join(", ".join(f"{value:.6g}" for value in row) for row in values.tolist()) + "]"
