"""One ball screw at one operating point: equations, components, solvers, friction, sizing.

May import ``basis`` and ``compiler``; NumPy, and SciPy from the solvers up. Start with ``friction.model``.
"""
