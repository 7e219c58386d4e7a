"""The reference model on a preloaded nut: its torque with a band, beside what the rules of makers give for that nut.

The paper has neither a preload nor a band, and its equations are not the ones to use: this stands beside its claims.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import NamedTuple

from ballscrew.cases.case_files import case_file, case_text
from ballscrew.cases.case_files.case_file import Case
from ballscrew.questions.band.compute import BandReport, band
from ballscrew.questions.band.document import verdicts
from ballscrew.questions.band.options import BandOptions
from ballscrew.questions.run.compute import Run, run
from ballscrew.questions.run.makers import BesideRule, beside_rules
from ballscrew.questions.run.nut_state import NutState

#: The case file that is written beside the results.
CASE_FILE = "preloaded_nut.toml"
#: The operating point without load, as the rules of makers have it.
UNLOADED = ("operation.axial_load=0 N", "operation.screw_speed=100 rpm")
#: The same as options of the command line.
UNLOADED_OPTIONS = " ".join('--set {}="{}"'.format(*setting.split("=")) for setting in UNLOADED)
CASE = f"""\
# A preloaded nut of a catalogue, for the reference model.
# Under load, with the band:   ballscrew run {CASE_FILE} --band
# Without load, makers' rules: ballscrew run {CASE_FILE} --band {UNLOADED_OPTIONS}
# Stiffness, life and limits:  ballscrew check {CASE_FILE}

[screw]
catalogue = "rexroth-40x10x6-6-double"

[nut]
preload = "7 %"                         # of the dynamic load rating

[lubricant]
grade = "ISO VG 100"
temperature = "40 degC"

[operation]
axial_load = "7 kN"
screw_speed = "600 rpm"
"""


class Banded(NamedTuple):
    """The nut at one operating point, and its band."""

    run: Run
    band: BandReport

    @property
    def case(self) -> Case:
        """The case of this operating point."""
        return self.run.case


class RuleBesideBand(NamedTuple):
    """What a rule gives for the nut, and whether the band of the model holds it."""

    beside: BesideRule
    is_in_band: bool


@dataclasses.dataclass(frozen=True, eq=False)
class PreloadedNut:
    """The nut without load and under load."""

    unloaded: Banded
    loaded: Banded

    @property
    def nut(self) -> NutState:
        """The state of the nut without load."""
        assert self.unloaded.run.nut is not None, "the case has a nut"
        return self.unloaded.run.nut

    @property
    def rules(self) -> Sequence[RuleBesideBand]:
        """The rules of makers, that of the maker of the nut first."""
        case, report = self.unloaded.case, self.unloaded.band
        held = {record.id: bool(record.holds) for record in verdicts(case, report)}
        return [RuleBesideBand(one, held[f"band.rule_{one.by_rule.rule.name}"]) for one in beside_rules(case, self.nut)]


def preloaded_nut() -> PreloadedNut:
    """Compute the nut of :data:`CASE` without load and under load."""
    return PreloadedNut(_banded(UNLOADED), _banded(()))


def _banded(settings: Sequence[str]) -> Banded:
    case = case_file.build(case_file.override(case_text.toml(CASE), settings))
    return Banded(run(case), band(case, BandOptions()))
