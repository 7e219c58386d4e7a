function [screw_torque, drive_torque, valid] = ballscrew_friction(axial_load, screw_speed)
%BALLSCREW_FRICTION  Friction torque of a ball screw, N m, over its load in N and its speed in rad/s.
%
%   screw_torque   size of the friction on the shaft
%   drive_torque   torque on the shaft in motion, ideal_torque + sign(screw_speed) .* screw_torque
%   valid          whether the model holds there and the point is within the table
%
%   Arrays have the same size. The table is read from ballscrew_friction.mat, once. In Simulink: a 2-D Lookup Table with
%   breakpoints table.axial_load and table.screw_speed and the data table.screw_torque; in Simscape the block
%   PS Lookup Table (2D) with the same three, interpolation linear, extrapolation nearest.
%
@NOTES@
  persistent table
  if isempty(table)
    table = load(fullfile(fileparts(mfilename('fullpath')), 'ballscrew_friction.mat'));
  end
  load_at = min(max(axial_load, table.axial_load(1)), table.axial_load(end));
  speed_at = min(max(screw_speed, table.screw_speed(1)), table.screw_speed(end));
  at = @(values) interp2(table.screw_speed, table.axial_load, values, speed_at, load_at, 'linear');
  screw_torque = at(table.screw_torque);
  drive_torque = at(table.ideal_torque) + sign(screw_speed) .* screw_torque;
  valid = at(double(table.valid)) > 1 - 1e-9 & load_at == axial_load & speed_at == screw_speed;
end
