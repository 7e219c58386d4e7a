"""The axis that the screw stands in: motion, bearings and guides, the duty of the axis, heat.

May import ``engine`` and below. Start with ``duty_cycle.duty`` and ``thermal.network``.
"""
