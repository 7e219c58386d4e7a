"""The kinds of nut by the names that catalogues, case files and tables use."""

from __future__ import annotations

from collections.abc import Mapping

from ballscrew.components.nut import DoubleNut, Nut, OffsetLeadNut, OversizeBallNut, SingleNut

#: The names of the kinds of nut stand here and nowhere else.
NUTS: Mapping[str, type[Nut]] = {
    "single": SingleNut,
    "oversize-balls": OversizeBallNut,
    "double": DoubleNut,
    "offset-lead": OffsetLeadNut,
}
