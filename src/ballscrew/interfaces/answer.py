"""The answer to a case as one document: what ``run --json`` prints, the server sends and a report shows."""

from __future__ import annotations

from typing import Any, NamedTuple

from ballscrew.interfaces import nut_report, report
from ballscrew.interfaces.computable import computable
from ballscrew.interfaces.config import Case
from ballscrew.interfaces.nut_report import NutResult
from ballscrew.result import FrictionResult


class Answer(NamedTuple):
    """A case, and what came out at its operating point."""

    case: Case
    result: FrictionResult | NutResult

    @property
    def document(self) -> dict[str, Any]:
        """Inputs, results and units in SI, warnings, provenance."""
        if isinstance(self.result, NutResult):
            return nut_report.document(self.case, self.result)
        return report.document(self.case, self.result)

    @property
    def verdicts(self) -> list[str]:
        """What drives what, and whether the balls roll, in words."""
        if isinstance(self.result, NutResult):
            return nut_report.verdicts(self.result)
        return report.verdicts(self.result, report.at_rest(self.case))

    @property
    def assumed(self) -> list[str]:
        """What the result depends on and people seldom write down, and what is left out."""
        if self.case.parts is not None:
            words = [
                *nut_report.assumptions(self.case, self.case.parts),
                nut_report.left_out(self.case, self.case.parts),
            ]
        else:
            assert isinstance(self.result, FrictionResult)
            words = [
                *report.assumed(self.case, self.result).split("; "),
                *report.no_nut(self.case),
                report.left_out(self.case),
            ]
        return [*filter(None, words), *report.of_fit(self.case)]

    @property
    def title(self) -> str:
        """Load, speed, nut and model."""
        return title(self.case)

    def print(self) -> None:
        """Tables on the terminal."""
        if isinstance(self.result, NutResult):
            nut_report.print_result(self.case, self.result)
        else:
            report.print_result(self.case, self.result)


@computable()
def answer(case: Case) -> Answer:
    """Friction of a case at its operating point."""
    if case.parts is not None:
        return Answer(case, nut_report.evaluate(case, case.parts))
    load, speed = case.operation.axial_load, case.operation.screw_speed
    return Answer(case, case.model(case.screw, case.lubricant, axial_load=load, screw_speed=speed))


def title(case: Case) -> str:
    """Load, speed, nut and model."""
    nut = [] if case.parts is None else [nut_report.nut_in_words(case.parts)]
    return ", ".join([report.operating_point(case), *nut, report.model_in_words(case)])
