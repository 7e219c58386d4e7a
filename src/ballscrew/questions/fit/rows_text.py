"""``ballscrew fit --rows``: one line for each number of each screw."""

from __future__ import annotations

from collections.abc import Mapping

from ballscrew.basis import units
from ballscrew.basis.output.wrapping import aligned, wrapped
from ballscrew.questions.fit.compute import FitReport
from ballscrew.questions.fit.text import interval
from ballscrew.questions.shared.text_tables import spoken

_HEADINGS = ("name", "log", "rows", "number", "value", "95 % interval", "residual rms")


def list_text(reports: Mapping[str, FitReport]) -> str:
    """The numbers of all screws, and below them the warnings of each fit."""
    lines: list[tuple[str, ...]] = [_HEADINGS]
    for name, report in reports.items():
        model, (log, _) = report.model, report.model.rows.log.source or ("", "")
        first = (name, log, str(len(model.rows.log)))
        for number, estimate in enumerate(model.estimates.values()):
            unit = units.label(estimate.quantity)
            ends = interval(estimate) if estimate.identified else "not identified"
            lines.append(
                (
                    *(first if number == 0 else ("", "", "")),
                    spoken(estimate.name),
                    units.shown(estimate.value, estimate.quantity),
                    " ".join(filter(None, [ends, unit if estimate.identified else ""])),
                    f"{model.residual_rms:.3g} N m" if number == 0 else "",
                )
            )
    verdicts = [wrapped(f"{name}: {text}") for name, found in reports.items() for text in found.model.verdicts]
    warnings = [wrapped(f"beware  {name}: {text}") for name, found in reports.items() for text in found.model.warnings]
    return "\n".join([*verdicts, *aligned(lines), *warnings])
