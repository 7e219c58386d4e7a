"""The two models of the figures: what stands above their panels, and what that means."""

from __future__ import annotations

from collections.abc import Mapping

#: Short labels.
LABELS: Mapping[str, str] = {"olaru2005": "as printed", "corrected": "corrected"}
#: What stands above the panels.
TITLES: Mapping[str, str] = {
    "olaru2005": f"{LABELS['olaru2005']}: the paper's equations",
    "corrected": f"{LABELS['corrected']}: without its misprints",
}
#: The same in full, for captions.
MEANING = (
    "As printed: the paper's equations, with the square root in λ that they need. Corrected: without its misprints, "
    "and with the reactions that it leaves out."
)
