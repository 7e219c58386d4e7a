"""Response model of the API for a sweep."""

from __future__ import annotations

from ballscrew.questions.shared.answer_parts import Said
from ballscrew.questions.shared.declared import schema
from ballscrew.questions.sweep.answer import SweepResults


class Sweep(schema(SweepResults), Said):
    """Results over ranges of the operating point or of other fields."""
