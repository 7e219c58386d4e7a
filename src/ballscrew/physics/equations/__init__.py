"""The physics as plain functions: SI in, SI out, no classes, no state, no defaults.

Each function binds the paper's letters on one line, returns once, and says in its docstring where
the formula stands. The same function runs on floats, NumPy arrays, SymPy symbols and pint
quantities (``tests/conformance`` proves it).
"""
