"""Formulas recorded, merged, differentiated and compiled: no ball screw in it.

May import ``basis``, NumPy and llvmlite. Start with ``tracing.tape`` and ``kernels.kernel``.
"""
