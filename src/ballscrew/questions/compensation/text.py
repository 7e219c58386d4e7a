"""Text of a compensation of positions on the terminal: its numbers, and the warm-up that they come from."""

from __future__ import annotations

from ballscrew.basis.output.wrapping import wrapped
from ballscrew.questions.compensation.compute import PositionCompensation
from ballscrew.questions.warm_up import verdicts as warm_up_verdicts
from ballscrew.questions.warm_up.compute import WarmUpReport


def text(found: PositionCompensation, report: WarmUpReport) -> str:
    """Points and what they miss, in which state they hold, and verdicts and assumptions of the warm-up."""
    lines = [
        f"{len(found.positions)} points from {1e3 * found.positions[0]:.6g} mm to {1e3 * found.positions[-1]:.6g} mm: "
        f"{1e6 * found.errors.min():.3g} µm to {1e6 * found.errors.max():.3g} µm; "
        f"{found.missed}",
        f"taken: {found.mounting} (--direction, --zero); if that is not so, signs and places are wrong",
        f"it holds after {found.hours:g} h of this work only; format checked against the manual, not on a control",
        "",
        *(record.text for record in warm_up_verdicts.verdicts(report)),
        *(f"beware  {record.name}: {record.text}" for record in warm_up_verdicts.warnings(report)),
        "",
        "assumed",
        *(f"  {line}" for line in report.assumed),
    ]
    return "\n".join(wrapped(line) for line in lines)
