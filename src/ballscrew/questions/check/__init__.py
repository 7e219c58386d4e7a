"""Checks of a case: life, speed, buckling, pressure and preload against their limits."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Annotated, Any

from ballscrew.questions.shared.options import Option, options_of


@dataclasses.dataclass(frozen=True, kw_only=True)
class CheckOptions:
    """Options of checks: fields of the case as texts, in place of its own or of what is usual."""

    axial_load: Annotated[
        str | None,
        Option('Axial load, "5 kN"; a tenth of C_a if left out.', metavar="FORCE", sets="operation.axial_load"),
    ] = None
    speed: Annotated[
        str | None,
        Option('Screw speed, "1500 rpm"; 600 rpm if left out.', metavar="SPEED", sets="operation.screw_speed"),
    ] = None
    nut: Annotated[
        str | None,
        Option("Kind of nut: single, oversize-balls, double or offset-lead.", metavar="TYPE", sets="nut.type"),
    ] = None
    preload: Annotated[
        str | None,
        Option(
            'Preload, "3 kN", or "7 %" of C_a; if left out, that of the row, or 7 % (oversize balls 5 %).',
            metavar="FORCE",
            sets="nut.preload",
        ),
    ] = None
    length: Annotated[
        str | None,
        Option('Unsupported length of the shaft, "1.2 m".', metavar="LENGTH", sets="installation.unsupported_length"),
    ] = None
    ends: Annotated[
        str | None,
        Option(
            "Ends of the shaft: fixed-fixed, fixed-supported, supported-supported or fixed-free.",
            metavar="ENDS",
            sets="installation.ends",
        ),
    ] = None
    grade: Annotated[
        str | None,
        Option('Grade of the oil, "ISO VG 68"; ISO VG 100 if left out.', metavar="GRADE", sets="lubricant.grade"),
    ] = None
    temperature: Annotated[
        str | None,
        Option('Temperature of the oil, "50 degC"; 40 degC if left out.', metavar="T", sets="lubricant.temperature"),
    ] = None
    keep_going: Annotated[bool, Option("Leave faulty rows out, and say which; fails if none is good.")] = False


def flags() -> dict[str, str]:
    """The flags that give a field of a case, by the field."""
    return {one.option.sets: one.flag for one in options_of(CheckOptions).values() if one.option.sets}


def given(written: Mapping[str, Any]) -> dict[str, str]:
    """The texts that were written, by the field of the case that they give."""
    texts = {one.option.sets: written[name] for name, one in options_of(CheckOptions).items() if one.option.sets}
    return {field: text for field, text in texts.items() if text is not None}
