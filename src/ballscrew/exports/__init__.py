"""The model in other programs: programs and tables in rooms of their own, the parts that all targets share here.

May import ``cases`` and below. Start with ``export``: a new target is a line of its ``TARGETS``.
"""
