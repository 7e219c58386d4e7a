"""The result at an operating point: torque, efficiency, losses and their parts."""
