"""Evidence on screws: calibration, logs of moving axes, service, validation, papers.

May import ``axis`` and below. Start with ``calibration.fit`` and ``validation.sets``.
"""
