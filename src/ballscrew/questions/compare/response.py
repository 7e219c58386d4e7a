"""Response model of the API for a comparison of models, laws and rules."""

from __future__ import annotations

from typing import Any

from ballscrew.questions.compare.compute import ByRules, Compared
from ballscrew.questions.shared.answer_parts import Provenance, Record, Shown, Tables, field
from ballscrew.questions.shared.declared import schema

_Compared: Any = schema(Compared)
_ByRules: Any = schema(ByRules)


class Compare(_Compared, _ByRules, Shown):
    """All models and all laws side by side."""

    inputs: Tables
    units: Tables
    reasons: dict[str, str]
    verdicts: list[Record] = field(optional=True)
    checks: list[Record] = field(optional=True)
    warnings: list[Record] = field(optional=True)
    provenance: Provenance
