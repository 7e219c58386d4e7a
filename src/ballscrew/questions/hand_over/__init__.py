"""The files of an export, their range and their worst error."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Annotated

from ballscrew.questions.shared.options import Option


@dataclasses.dataclass(frozen=True, kw_only=True)
class HandOverOptions:
    """Options besides the target, as text: what may be asked depends on the target."""

    ranges: Annotated[
        Sequence[str],
        Option(
            'Range of tables and fits: axial_load="-5:5 kN".',
            metavar="INPUT=LEAST:GREATEST",
            flag="range",
            is_table=True,
        ),
    ] = ()
    parameters: Annotated[
        Sequence[str],
        Option("One more input, such as friction.limiting_film_parameter.", metavar="INPUT", flag="parameter"),
    ] = ()
    outputs: Annotated[Sequence[str], Option("One more output, as of sweeps.", metavar="NAME", flag="output")] = ()
    derivatives: Annotated[Sequence[str], Option("Also derive the outputs by an input.", metavar="INPUT")] = ()
    options: Annotated[
        Sequence[str], Option("A choice that the target has.", metavar="NAME=VALUE", flag="option", is_table=True)
    ] = ()
