"""Numbers of a screw fitted to a log of torques, or friction of an axis fitted to a log of its motion."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Annotated

from ballscrew.questions.shared.options import Columns, Inertia, KeepGoing, Option, Range, TorqueConstant, TorqueKind

#: The number that is fitted by default.
DEFAULT_FREE = "boundary_friction_coefficient"


@dataclasses.dataclass(frozen=True, kw_only=True)
class FitOptions:
    """Options of a fit; numbers in SI."""

    free: Annotated[
        Sequence[str],
        Option(
            "What to fit, with commas: boundary_friction_coefficient (default), constant_torque, any other input.",
            metavar="NAMES",
        ),
    ] = (DEFAULT_FREE,)
    bounds: Annotated[
        Mapping[str, Range],
        Option('Bounds of a fitted number: boundary_friction_coefficient="0.05:0.2".', metavar="NAME=LOW:HIGH"),
    ] = dataclasses.field(default_factory=dict[str, Range])
    kind: TorqueKind = "unknown"
    columns: Columns = dataclasses.field(default_factory=dict[str, str])
    torque_constant: TorqueConstant = None
    inertia: Inertia = None
    limits: Annotated[
        Mapping[str, Range], Option('Range of the next test: screw_speed="10:3000 rpm".', metavar="NAME=LOW:HIGH")
    ] = dataclasses.field(default_factory=dict[str, Range])
    holdout: Annotated[
        float, Option("Share of the operating points that is predicted and not fitted.", metavar="SHARE")
    ] = 0.2
    temperature_error: Annotated[
        float | None,
        Option(
            'Uncertainty of the oil temperature of the whole log, half the width of its 95 % interval, such as "2 K"; '
            "if left out, 2 K where it is logged, else 10 K.",
            metavar="VALUE",
            unit="K",
            at_least=0,
            is_difference=True,
        ),
    ] = None
    seed: Annotated[int, Option("Seed of the choice of held-out operating points.", metavar="N")] = 0
    keep_going: Annotated[
        bool, Option("Leave faulty rows out, and say how many; write a fit that is warned against.")
    ] = False
    self_heating: Annotated[
        bool, Option("Take the oil as warm as friction makes it in the [surroundings] of the case.")
    ] = False


@dataclasses.dataclass(frozen=True, kw_only=True)
class FitMotionOptions:
    """Options of a fit to a moving log; numbers in SI."""

    #: Empty for what is usual.
    free: Annotated[Sequence[str], Option("What to fit, with commas.", metavar="NAMES")] = ()
    columns: Columns = dataclasses.field(default_factory=dict[str, str])
    torque_constant: TorqueConstant = None
    gain: Annotated[
        float | None,
        Option(
            'Force for each volt of a control voltage, of a moving log: "35 N/V".', metavar="VALUE", unit="N/V", above=0
        ),
    ] = None
    carried_mass: Annotated[
        float | None,
        Option('Mass that the nut of a moving log carries: "20 kg".', metavar="VALUE", unit="kg", at_least=0),
    ] = None
    axis: Annotated[str, Option('Axis of a log of several: "X1", with which its headings begin.', metavar="NAME")] = ""
    period: Annotated[
        float | None,
        Option('Time between the rows of a log without a time: "0.1 s".', metavar="TIME", unit="s", above=0),
    ] = None
    steady: Annotated[
        bool,
        Option("Friction over speed of rows at constant speed, and no motion; in A without a torque constant."),
    ] = False
    seed: Annotated[int, Option("Seed of the choice of held-out operating points.", metavar="N")] = 0
    keep_going: KeepGoing = False
