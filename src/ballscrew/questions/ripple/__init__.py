"""The friction torque over the angle of the screw, its orders, and what defects of a nut do to them."""
