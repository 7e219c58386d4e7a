"""The reference model on a preloaded nut: its torque with a band, beside what the rules of makers give for that nut.

The paper has neither a preload nor a band, and its equations are not the ones to use: this stands beside its claims.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import NamedTuple

from ballscrew.basis.output.sheet import sentence
from ballscrew.basis.output.text import aligned
from ballscrew.basis.quantities import Quantity
from ballscrew.cases.case_files import case_file, case_text
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.descriptions import nut_text, operating_point
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.questions.band import BandOptions
from ballscrew.questions.band.answer import verdicts
from ballscrew.questions.band.compute import BandReport, band
from ballscrew.questions.band.sheet import input_counts
from ballscrew.questions.run.compute import BesideRule, NutState, Run, beside_rules, contradiction, run
from ballscrew.questions.shared.text_tables import ends_or_dashes, markdown_table, shown_or_dash

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
    """Torque that a rule gives for the nut, and whether the band of the model holds it."""

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


_TORQUE = "screw_torque"
#: The file of the page, and of its picture without the ending.
PAGE_FILE, PICTURE = "preloaded_nut.md", "preloaded_nut"
#: What is shown under load.
_SHOWN = (_TORQUE, "drive_torque", "efficiency")
#: The torque that rules of makers are of.
DRAG = "drag torque without seals"
_PAGE = """\
# The reference model on a preloaded nut

The claims of the paper are checked with its own equations, as printed and corrected. Use the model `reference`, not
those of the paper. Most machines have a preloaded nut, which the paper has not. Here is the model `reference` on one:
row `{row}` of the catalogue, {nut}. The case is in `{file}`.

## Without load

{drag}
At {point}, without seals, because the makers' rules leave them out. {contradiction}.

![The band of the model, and the rules of makers]({picture}.svg)

## Under load

{loaded}
At {loaded_point}. {counts}. The band is of what is uncertain in inputs and laws; it is no tolerance for acceptance.

## The same case again

```console
$ ballscrew run {file} --band {options}
$ ballscrew run {file} --band
$ ballscrew check {file}
```

```toml
{case}```
"""


def lines(preloaded_nut: PreloadedNut) -> list[str]:
    """The nut, the model without load with its band, each rule, and the nut under load."""
    here, loaded = preloaded_nut.unloaded, preloaded_nut.loaded
    rows = [
        (f"{DRAG}, {operating_point(here.case)}", "", f"{level(here)} band"),
        (" reference model", *value_and_band(here, _TORQUE)),
        *((f" {label_of(one)}", torque_of(one, here), _is_held(one)) for one in preloaded_nut.rules),
        (f"under load, {operating_point(loaded.case)}", "", ""),
        *((f" {_quantity(loaded, name).info.meaning}", *value_and_band(loaded, name)) for name in _SHOWN),
    ]
    return [
        f"The model reference on a preloaded nut ({_row(preloaded_nut)}, {nut_text(loaded.case.screw.nut)}):",
        *(f"  {line}" for line in aligned(rows)),
        f"  {contradiction_of(preloaded_nut)}",
    ]


def page(preloaded_nut: PreloadedNut) -> str:
    """The page, in Markdown."""
    here, loaded = preloaded_nut.unloaded, preloaded_nut.loaded
    drag = [
        ("**reference model**", *value_and_band(here, _TORQUE), "", ""),
        *(
            (
                label_of(one), torque_of(one, here), _is_held(one), f"{one.beside.ratio:.2f}",
                one.beside.by_rule.rule.range,
            )
            for one in preloaded_nut.rules
        ),
    ]  # fmt: skip
    of_load = [(_quantity(loaded, name).info.meaning, *value_and_band(loaded, name)) for name in _SHOWN]
    return _PAGE.format(
        row=_row(preloaded_nut),
        nut=nut_text(loaded.case.screw.nut),
        file=CASE_FILE,
        picture=PICTURE,
        drag=markdown_table(
            (DRAG, "value", f"{level(here)} band", "model / rule", "range or tolerance, as stated"), drag, numbers=True
        ),
        point=operating_point(here.case),
        contradiction=sentence(contradiction_of(preloaded_nut)),
        loaded=markdown_table(("", "value", f"{level(loaded)} band"), of_load, numbers=True),
        loaded_point=operating_point(loaded.case),
        counts=input_counts(loaded.band),
        options=UNLOADED_OPTIONS,
        case=CASE,
    )


def label_of(one: RuleBesideBand) -> str:
    """``rule of Rexroth, its maker``."""
    by_rule = one.beside.by_rule
    return f"rule of {by_rule.rule.label}{', its maker' if by_rule.is_own else ''}"


def torque_of(one: RuleBesideBand, here: Banded) -> str:
    """Torque that a rule gives, with its unit."""
    return shown_or_dash(float(one.beside.by_rule.torque), _quantity(here, _TORQUE))


def level(banded: Banded) -> str:
    """``95 %``."""
    return f"{100 * banded.band.band.level:.4g} %"


def value_and_band(banded: Banded, name: str) -> tuple[str, str]:
    """An output at the values of the case, and the ends of its band."""
    quantity, one = _quantity(banded, name), banded.band.band[name]
    return shown_or_dash(one.value, quantity), " to ".join(ends_or_dashes(*one.both, quantity))


def contradiction_of(preloaded_nut: PreloadedNut) -> str:
    """Factor by which the rules contradict each other."""
    return contradiction([one.beside for one in preloaded_nut.rules])


def _is_held(one: RuleBesideBand) -> str:
    return "within it" if one.is_in_band else "outside it"


def _quantity(banded: Banded, name: str) -> Quantity:
    return known_outputs(banded.case.screw.nut)[name].quantity


def _row(preloaded_nut: PreloadedNut) -> str:
    row = preloaded_nut.loaded.case.origins.row
    assert row is not None, "the case has a row"
    return row.name
