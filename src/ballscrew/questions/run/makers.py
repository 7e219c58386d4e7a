"""The rules of makers beside the torque of a preloaded nut without load: numbers, sentences, and a verdict."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from ballscrew.basis import units
from ballscrew.basis.quantities import Ratio, fields_of
from ballscrew.basis.records import Message, Record, Value
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.makers_rules import BY_RULE, OfRule, by_rules
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.questions.run.nut_state import NutState

#: Model over rule between which nothing is said of the maker's rule: makers state their torques to a fifth or worse.
NEAR = (0.8, 1.25)
_SPEED = fields_of(OperatingState)["screw_speed"]
_LINE = Message("without load and seals {torque}; by the rules of makers: {rules}")
_OWN = Message("{rule}, its maker, {torque} (model / rule {ratio})")
_OTHER = Message("{rule} {torque} (model / rule {ratio})")
_CONTRADICTION = Message(
    "the rules of makers contradict each other here by a factor of {factor}; none of them knows oil, speed or balls"
)
_VERDICT = Message(
    "without load and seals the rule of its maker {rule} gives {drag}, the model {torque} at {speed}, {ratio} times "
    "that; range of the rule: {range}"
)


class BesideRule(NamedTuple):
    """What a rule gives for the nut, and the model over it."""

    by_rule: OfRule
    ratio: Ratio

    @property
    def values(self) -> dict[str, Value]:
        """The rule, its torque and the ratio, for messages."""
        rule, torque = self.by_rule.rule, self.by_rule.torque
        return {
            "rule": rule.label,
            "torque": units.measured(torque, BY_RULE[rule.name]),
            "ratio": units.fixed(self.ratio, 2),
        }

    @property
    def label(self) -> str:
        """``by the rule of Rexroth, its maker; model / rule 0.93``."""
        own = ", its maker" if self.by_rule.is_own else ""
        return f"by the rule of {self.by_rule.rule.label}{own}; model / rule {self.ratio:.2f}"


def beside_rules(case: Case, nut: NutState | None) -> Sequence[BesideRule]:
    """The model over each rule for a preloaded nut without load and seals, that of its maker first; none of others."""
    if nut is None or not nut.preload:
        return ()
    return [BesideRule(one, nut.drag_of_balls / one.torque) for one in by_rules(case)]


def messages(case: Case, nut: NutState | None) -> list[Message]:
    """The torque of the balls beside all rules, and by how much the rules contradict each other."""
    found = beside_rules(case, nut)
    if nut is None or not found:
        return []
    rules = [(_OWN if one.by_rule.is_own else _OTHER).of(**one.values) for one in found]
    torque = units.measured(nut.drag_of_balls, BY_RULE[found[0].by_rule.rule.name])
    return [_LINE.of(torque=torque, rules=rules), contradiction(found)]


def contradiction(found: Sequence[BesideRule]) -> Message:
    """By how much the rules contradict each other."""
    torques = [float(one.by_rule.torque) for one in found]
    return _CONTRADICTION.of(factor=units.fixed(max(torques) / min(torques), 2))


def verdicts(case: Case, nut: NutState | None) -> list[Record]:
    """What the rule of the nut's own maker gives, where the model is not :data:`NEAR` it.

    None with spacer balls: the rules are of nuts full of balls.
    """
    if nut is not None and nut.nut.spacer_balls:
        return []
    own = next((one for one in beside_rules(case, nut) if one.by_rule.is_own), None)
    if nut is None or own is None or not math.isfinite(own.ratio) or NEAR[0] <= own.ratio <= NEAR[1]:
        return []
    quantity = BY_RULE[own.by_rule.rule.name]
    drag, torque = (units.measured(value, quantity) for value in (own.by_rule.torque, nut.drag_of_balls))
    speed = units.measured(case.operation.screw_speed, _SPEED)
    values = {
        **own.values, "drag": drag, "torque": torque, "speed": speed, "range": Message(own.by_rule.rule.range),
    }  # fmt: skip
    return [
        units.record(
            _VERDICT.of(**values), id="verdict.rule_of_maker", subject="preload_drag_of_balls", severity="info",
            value=own.ratio,
        )
    ]  # fmt: skip
