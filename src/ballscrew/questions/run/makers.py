"""The rules of makers beside the torque of a preloaded nut without load: numbers, sentences, and a verdict."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from ballscrew.basis import units
from ballscrew.basis.judgements import said
from ballscrew.basis.quantities import Ratio
from ballscrew.basis.records import Record
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.makers_rules import BY_RULE, OfRule, by_rules
from ballscrew.physics.friction.verdicts import RULE_OF_MAKER
from ballscrew.questions.run.nut_state import NutState


class BesideRule(NamedTuple):
    """What a rule gives for the nut, and the model over it."""

    by_rule: OfRule
    ratio: Ratio

    @property
    def text(self) -> str:
        """``Rexroth, its maker, 0.41 N m (model / rule 0.93)``."""
        rule = self.by_rule.rule
        own = ", its maker," if self.by_rule.is_own else ""
        torque = units.shown(self.by_rule.torque, BY_RULE[rule.name])
        return f"{rule.label}{own} {torque} (model / rule {units.fixed(self.ratio, 2)})"

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


def messages(case: Case, nut: NutState | None) -> list[str]:
    """The torque of the balls beside all rules, and by how much the rules contradict each other."""
    result = beside_rules(case, nut)
    if nut is None or not result:
        return []
    rules = ", ".join(one.text for one in result)
    torque = units.shown(nut.drag_of_balls, BY_RULE[result[0].by_rule.rule.name])
    return [f"drag torque without seals {torque}; by the rules of makers: {rules}", contradiction(result)]


def contradiction(result: Sequence[BesideRule]) -> str:
    """By how much the rules contradict each other."""
    torques = [float(one.by_rule.torque) for one in result]
    factor = units.fixed(max(torques) / min(torques), 2)
    return (
        f"the rules of makers contradict each other here by a factor of {factor}; none of them accounts for oil, "
        "speed or balls"
    )


def judged(case: Case, nut: NutState | None) -> tuple[dict[str, Any], dict[str, str]]:
    """The values and the words of the verdict on the rule of the nut's own maker; none with spacer balls.

    The rules are of nuts full of balls.
    """
    own = next((one for one in beside_rules(case, nut) if one.by_rule.is_own), None)
    if nut is None or own is None or nut.nut.spacer_balls:
        return {}, {}
    rule, torque = own.by_rule.rule, own.by_rule.torque
    values = {"rule_of_maker": torque, "preload_drag_of_balls": nut.drag_of_balls}
    return values, {"rule": rule.label, "range": rule.range}


def verdicts(case: Case, nut: NutState | None) -> list[Record]:
    """What the rule of the nut's own maker gives, where the model is not near it."""
    values, words = judged(case, nut)
    return said([RULE_OF_MAKER], values | {"screw_speed": case.operation.screw_speed}, words)
