"""The duty of an axis: torque of the motor, energy and life over a cycle."""
