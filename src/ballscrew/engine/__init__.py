"""The engine: formulas recorded once, and evaluated at the limit of the machine."""
