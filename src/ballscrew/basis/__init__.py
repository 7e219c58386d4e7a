"""Quantities and units, errors, records, references, arrays, files written whole: no ball screw in it.

May import NumPy; ``units`` alone imports pint. Start with ``quantities`` and ``errors``.
"""
