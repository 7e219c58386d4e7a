"""``--to matlab``: the table as a .mat file, a function that reads it, and a component in the language of Simscape."""

from __future__ import annotations

import io
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from scipy.io import savemat

from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.exports.export import Export
from ballscrew.exports.subject import HandOver
from ballscrew.exports.tables import notes
from ballscrew.exports.tables.friction_table import INTERPOLATED, FrictionTable, as_export, friction_table, no_more_axes
from ballscrew.exports.tables.friction_table import OPTIONS as OF_TABLES
from ballscrew.exports.targets import Option
from ballscrew.exports.worst_error import WorstError

OPTIONS: Mapping[str, Option] = OF_TABLES
#: The name of the files and of the function.
NAME = "ballscrew_friction"

_README = """\
ballscrew_friction.m interpolates the table of ballscrew_friction.mat, in MATLAB and in Octave; ballscrew_friction.ssc
is a component of Simscape, written by the manual of the language and never run.
"""
_FUNCTION = """\
function [screw_torque, drive_torque, valid] = {name}(axial_load, screw_speed)
%{upper}  Friction torque of a ball screw, N m, over its load in N and its speed in rad/s.
%
%   screw_torque   size of the friction on the shaft
%   drive_torque   torque on the shaft in motion, ideal_torque + sign(screw_speed) .* screw_torque
%   valid          whether the model holds there and the point is within the table
%
%   Arrays have the same size. The table is read from {name}.mat, once. In Simulink: a 2-D Lookup Table with
%   breakpoints table.axial_load and table.screw_speed and the data table.screw_torque; in Simscape the block
%   PS Lookup Table (2D) with the same three, interpolation linear, extrapolation nearest.
%
{notes}
  persistent table
  if isempty(table)
    table = load(fullfile(fileparts(mfilename('fullpath')), '{name}.mat'));
  end
  load_at = min(max(axial_load, table.axial_load(1)), table.axial_load(end));
  speed_at = min(max(screw_speed, table.screw_speed(1)), table.screw_speed(end));
  at = @(values) interp2(table.screw_speed, table.axial_load, values, speed_at, load_at, 'linear');
  screw_torque = at(table.screw_torque);
  drive_torque = at(table.ideal_torque) + sign(screw_speed) .* screw_torque;
  valid = at(double(table.valid)) > 1 - 1e-9 & load_at == axial_load & speed_at == screw_speed;
end
"""

_SIMSCAPE = """\
component {name}
% Ball screw with friction
% Turns the rotation of R into the travel of T. Friction is a slope through zero below speed_at_rest: a load that it
% holds creeps. This text was written by the manual of the language, and was never run.
{notes}
nodes
  R = foundation.mechanical.rotational.rotational; % R:left
  T = foundation.mechanical.translational.translational; % T:right
end
parameters
  axial_load = {{{F}, 'N'}}; % Axial loads of the table
  screw_speed = {{{W}, 'rad/s'}}; % Speeds of the table
  screw_torque = {{{M}, 'N*m'}}; % Friction torque
  travel = {{{travel!r}, 'm/rad'}}; % Travel over rotation
  torque_of_load = {{{ideal!r}, 'm'}}; % Torque without friction over load
  speed_at_rest = {{0.1, 'rad/s'}}; % Below it friction is a slope
end
variables
  torque = {{0, 'N*m'}};
  force = {{0, 'N'}};
end
branches
  torque : R.t -> *;
  force : * -> T.f;
end
equations
  let
    friction = tablelookup(axial_load, screw_speed, screw_torque, force, R.w, ...
      interpolation=linear, extrapolation=nearest);
  in
    T.v == travel*R.w;
    torque == torque_of_load*force + friction*tanh(R.w/speed_at_rest);
  end
end
end
"""


def export(handed: HandOver) -> Export:
    """The table, its function, and the component."""
    table = friction_table(handed)
    no_more_axes(table, "the lookup table")
    errors = table.worst_errors(handed)
    about = notes.lines(handed, table.valid_range, errors)
    files = {
        f"{NAME}.mat": _mat(handed, table, errors),
        f"{NAME}.m": _function(about).encode(),
        f"{NAME}.ssc": _simscape(handed, table, about).encode(),
        "README.txt": notes.text(handed, table.valid_range, errors, _README),
    }
    return as_export(handed, table, "matlab", files, errors)


def _mat(handed: HandOver, table: FrictionTable, errors: Sequence[WorstError]) -> bytes:
    """Axes as columns, values with loads down and speeds across, units and errors as structures, all else as text."""
    names = [*table.axes, *table.values, "valid"]
    content: dict[str, Any] = {
        **{name: nodes[:, None] for name, nodes in table.axes.items()},
        **table.values,
        "valid": table.valid,
        "units": {name: handed.units[name] for name in names},
        "worst_error": {one.output: one.value for one in errors if one.output != "valid"},
        "fixed": dict(table.fixed),
        "about": "\n".join(notes.lines(handed, table.valid_range, errors)),
    }
    stream = io.BytesIO()
    savemat(stream, content, do_compression=True, oned_as="column")
    return stream.getvalue()


def _function(about: Sequence[str]) -> str:
    return _FUNCTION.format(name=NAME, upper=NAME.upper(), notes="\n".join(f"%   {line}" for line in about))


def _simscape(handed: HandOver, table: FrictionTable, about: Sequence[str]) -> str:
    load, speed = (table.axes[name] for name in OPERATION[:2])
    friction, ideal = (table.values[name] for name in INTERPOLATED)
    end = 0 if abs(load[0]) > abs(load[-1]) else -1
    return _SIMSCAPE.format(
        name=NAME,
        notes="\n".join(f"% {line}" for line in about),
        F=_row(load),
        W=_row(speed),
        M="[" + ";\n    ".join(_row(values)[1:-1] for values in friction) + "]",
        travel=float(handed.subject.screw.lead) / (2 * math.pi),
        ideal=float(ideal[end, 0] / load[end]),
    )


def _row(values: np.ndarray) -> str:
    return "[" + " ".join(map(repr, values.tolist())) + "]"
