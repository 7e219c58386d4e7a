"""The presets and the nuts that exports are tried with."""

from collections.abc import Iterable

import ballscrew as bs

PRESETS = ("olaru2005", "corrected", "reference")
NUTS = {
    "row": bs.SingleNut(),
    "single": bs.SingleNut(angle_under_load=True),
    "double": bs.DoubleNut(preload=900.0),
    "offset": bs.OffsetLeadNut(preload=900.0),
    "oversize": bs.OversizeBallNut(preload=900.0),
}


def presets_and_nuts(nuts: Iterable[str]) -> list[tuple[str, str]]:
    """Each preset with each nut that it has: the slip of those of the paper knows no balls with four contacts."""
    return [(preset, nut) for preset in PRESETS for nut in nuts if nut != "oversize" or preset == "reference"]
