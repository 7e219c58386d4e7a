"""An axis: a mass moved by a ball screw and its drive, what a cycle asks of the motor, costs, and wears."""
