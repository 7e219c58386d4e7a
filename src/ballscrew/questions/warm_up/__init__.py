"""Temperatures over hours, growth, preload, and the torque as they change it."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.questions.shared.options import Level, OnlyGiven, Option, number_of_samples
from ballscrew.questions.shared.question import Endpoint, Question


@dataclasses.dataclass(frozen=True, kw_only=True)
class WarmUpOptions:
    """Options of a warm-up: hours of work and of rest, and a band."""

    hours: Annotated[float, Option("Hours of work.", metavar="H")] = 4.0
    cool_down: Annotated[float, Option("Hours of rest after the work; 0 if left out.", metavar="H")] = 0.0
    band: Annotated[bool, Option("Bands of all results, by uncertain surroundings and friction.")] = False
    samples: Annotated[int | None, number_of_samples("transients, 512")] = None
    level: Level = None
    only_given: OnlyGiven = False


@dataclasses.dataclass(frozen=True, kw_only=True)
class DriftOptions:
    """A cycle like that of ISO 230-3 in place of the motion of the case, which has a rest of its own."""

    hours: Annotated[float, Option("Hours of work.", metavar="H")] = 4.0
    cool_down: Annotated[float | None, Option("Hours of rest after the work; 0 if left out.", metavar="H")] = None
    drift_cycle: Annotated[
        bool, Option("A cycle like that of ISO 230-3: full stroke at a share of rapid, an hour of rest.")
    ] = False
    feed_share: Annotated[
        float | None, Option("With --drift-cycle: feed as a share of rapid; 0.5 if left out.", metavar="SHARE")
    ] = None


WARM_UP = Question(
    module="ballscrew.questions.warm_up.answer",
    name="warm-up",
    help="""Temperatures, growth and preload over hours. The output has the torque and the steady state, too.

    A case with an [axis] and a [motion] does its motion; one with an [operation] moves to and fro over half the shaft.
    [surroundings] has where the heat goes. Without a steady state the verdict says so: thermal runaway. With --band
    transients are drawn with other surroundings, among them the conduction through the balls, the least known.
    """,
    options=(DriftOptions, WarmUpOptions),
    case_texts={"settings": 'Change a value: --set surroundings.ambient="25 degC".', "calibration": None},
    files=Option(
        "Write a folder of tables and a picture; or one .csv, .xlsx, .png, .svg or .pdf; may be repeated.",
        short="-o",
        metavar="PATH",
    ),
    has_several_files=True,
    endpoint=Endpoint(options=(WarmUpOptions,)),
)
