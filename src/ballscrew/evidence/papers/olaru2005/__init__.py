"""The paper's numerical program: its case, its figures as data, and its claims, checked."""

from __future__ import annotations

from ballscrew.evidence.papers.olaru2005.case import CHOICES, OIL, SCREW, Choice, models
from ballscrew.evidence.papers.olaru2005.claims import Claim, claims
from ballscrew.evidence.papers.olaru2005.closures import ClosureCheck, Reading, Repair, closure_checks, repairs
from ballscrew.evidence.papers.olaru2005.curves import curves
from ballscrew.evidence.papers.olaru2005.verdicts import Finding, Verdict

__all__ = [
    "CHOICES",
    "OIL",
    "SCREW",
    "Choice",
    "Claim",
    "ClosureCheck",
    "Finding",
    "Reading",
    "Repair",
    "Verdict",
    "claims",
    "closure_checks",
    "curves",
    "models",
    "repairs",
]
