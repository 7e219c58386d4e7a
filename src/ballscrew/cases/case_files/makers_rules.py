"""The rules of makers on the nut of a case: its torque without load and seals, and which rule is that of its make."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from ballscrew.basis import units
from ballscrew.basis.quantities import Info, Quantity, Torque
from ballscrew.cases.case_files.case import Case
from ballscrew.physics.sizing.rules import DRAG_RULES, RULES, Rule, Subject, drags, rule_of
from ballscrew.physics.solvers.load_distribution import preload_of


def _quantity(rule: Rule) -> Quantity:
    meaning = f"drag torque of the nut without seals by the rule of {rule.label}: {rule.formula} ({rule.range})"
    return Quantity(rule.name, "N m", Info("M_0", meaning))


#: The torque of the nut without load and seals by each rule; what a rule holds for is in its meaning.
BY_RULE = {name: _quantity(RULES[name]) for name in DRAG_RULES}


class OfRule(NamedTuple):
    """What a rule gives for a nut."""

    rule: Rule
    #: Torque of the nut without load and seals, N m.
    torque: Torque
    #: True for the rule of the maker of the nut.
    is_own: bool

    @property
    def text(self) -> str:
        """``0.8654 N m by THK (JIS B 1192)``."""
        torque = units.shown(self.torque, BY_RULE[self.rule.name])
        return f"{torque} by {self.rule.label}"


def subject_of(case: Case) -> Subject:
    """Sizes, load and preload of a case; the pitch circle stands for a nominal diameter that it does not state."""
    screw = case.screw
    nominal = screw.pitch_circle_diameter if case.origins.row is None else case.origins.row.nominal_diameter
    return Subject(
        nominal_diameter=float(nominal),
        pitch_circle_diameter=float(screw.pitch_circle_diameter),
        lead=float(screw.lead),
        axial_load=abs(float(case.operation.axial_load)),
        preload=float(preload_of(screw, screw.nut)),
        oversize_balls=screw.nut.contacts_per_ball > 2,
    )


def make_of(case: Case) -> str:
    """The make of the nut as its row gives it; empty where none is known."""
    return "" if case.origins.row is None else case.origins.row.make


def by_rules(case: Case) -> Sequence[OfRule]:
    """What the makers' rules give for the nut of a case, that of its own maker first; none without preload."""
    subject = subject_of(case)
    if not subject.preload:
        return ()
    own = rule_of(make_of(case))
    of_rules = [OfRule(RULES[name], torque, RULES[name] is own) for name, torque in drags(subject).items()]
    return sorted(of_rules, key=lambda one: not one.is_own)
