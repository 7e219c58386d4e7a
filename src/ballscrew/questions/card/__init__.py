"""A torque card: what was measured on one screw, and the model beside it."""
