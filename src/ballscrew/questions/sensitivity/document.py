"""``ballscrew sensitivity --json``: the document of a sensitivity analysis; all in SI."""

from __future__ import annotations

import dataclasses
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.errors import each_of
from ballscrew.basis.records import Message, Named, Record, documents
from ballscrew.basis.version import __version__
from ballscrew.cases.case_files import case_file
from ballscrew.engine.uncertainty.sensitivity import HALF
from ballscrew.questions.sensitivity.compute import SensitivityReport

CORRELATED = "the numbers of the calibration vary one by one, too, though the fit left them correlated"


def document(case: case_file.Case, report: SensitivityReport) -> dict[str, Any]:
    """Inputs, indices, what to measure next, units and provenance."""
    result = report.result
    halve = result.to_halve
    return {
        "inputs": case_file.inputs(case),
        "sensitivity": {
            "output": result.output,
            "method": result.method,
            "mean": result.mean,
            "standard_deviation": result.deviation,
            "inputs": [_row(report, name) for name in result.inputs],
            "knowing": [_left_if_known(inputs, left) for inputs, left in result.explained_variance],
            "to_halve": None if halve is None else _left_if_known(*halve),
            "level": result.level,
            "samples": result.samples,
            "left_out": result.left_out,
            "evaluations": result.evaluations,
            "seed": result.seed,
        },
        "units": {
            result.output: result.quantity.unit,
            **{name: report.known[name][1].unit for name in result.inputs},
        },
        "verdicts": documents(verdicts(report)),
        "checks": [],
        "warnings": documents(warnings(case, report)),
        "provenance": {"version": __version__, "model": case.model.label, "references": case_file.references(case)},
    }


def _left_if_known(inputs: tuple[str, ...], left: float) -> dict[str, Any]:
    return {"inputs": list(inputs), "left": left}


def _row(report: SensitivityReport, name: str) -> dict[str, Any]:
    result, uncertain = report.result, report.uncertain[name]
    distribution = uncertain.distribution
    return {
        "name": name,
        "distribution": {"kind": type(distribution).__name__.lower(), **dataclasses.asdict(distribution)},
        "given": uncertain.given,
        "source": uncertain.source,
        **{measure: of_input[name]._asdict() for measure, of_input in result.measures.items()},
        "left_if_known": result.left_if_known(name),
    }


def verdicts(report: SensitivityReport) -> list[Record]:
    """The inputs to measure next in order to halve the band."""
    result, meaning = report.result, Message(report.result.quantity.info.meaning)

    def verdict(
        name: str, subject: str, message: Message, value: float | None = None, holds: bool | None = None
    ) -> Record:
        limit = None if value is None else HALF
        return units.record(message, id=f"sensitivity.{name}", subject=subject, value=value, limit=limit, holds=holds)

    if result.is_constant:
        message = Message("the {meaning} does not depend on any of these inputs", {"meaning": meaning})
        return [verdict("constant", result.output, message)]
    if result.method == "morris":
        message = Message("screening ranks the inputs; what to find out next: --method sobol")
        return [verdict("screening", result.output, message)]
    if result.to_halve is None:
        message = Message("to know all of these inputs would not halve the band of the {meaning}", {"meaning": meaning})
        return [verdict("not_halved", result.output, message, holds=False)]
    inputs, left = result.to_halve
    names = [Named(name, report.describe(name)) for name in inputs]
    message = Message(
        "to halve the band of the {meaning}, find out: {names} (leaves {left})",
        {"meaning": meaning, "names": each_of(names), "left": units.percent(left)},
    )
    records = [verdict("to_halve", ",".join(inputs), message, left, True)]
    if len(names) > 1:
        alone = result.explained_variance[0].remaining
        message = Message("{name} alone leaves {left}", {"name": names[0], "left": units.percent(alone)})
        records.append(verdict("first_input", inputs[0], message, alone, False))
    return records


def warnings(case: case_file.Case, report: SensitivityReport) -> list[Record]:
    """Implausible inputs, samples without a number, and the correlation of a calibration, which is not sampled."""
    records = case.implausible()
    result = report.result
    if result.left_out:
        message = Message(
            "{samples} samples or trajectories are left out as they have no number",
            {"samples": units.fixed(result.left_out)},
        )
        records.append(
            units.record(
                message, id="sensitivity.left_out", subject=result.output, severity="warning", holds=False,
                value=float(result.left_out), limit=0.0,
            )
        )  # fmt: skip
    if case.calibration is not None:
        records.append(
            units.record(Message(CORRELATED), id="sensitivity.correlated", subject="calibration", severity="warning")
        )
    return records
