"""The loads of the balls of a nut, declared once: JSON, its units and its schema follow from the annotations."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Annotated

from ballscrew.basis.quantities import Info, Unit, quantities_of
from ballscrew.physics.sizing.rigidity import AxialRigidity
from ballscrew.physics.solvers.load_distribution import BallLoads
from ballscrew.questions.run.nut_state import Flank, NutState
from ballscrew.questions.shared.declared import from_attributes, table_of

_KNOWN = quantities_of(BallLoads)
_OF_BALLS = {name: _KNOWN[name] for name in ("forward_load", "backward_load", "forward_angle", "backward_angle")}
_OF_ALL_BALLS = {name: quantity for name, quantity in _KNOWN.items() if name not in _OF_BALLS}
_ENDS = ("least", "mean", "greatest")


@dataclasses.dataclass(frozen=True, eq=False)
class EachBall(table_of(_OF_BALLS, of=Sequence[float])):
    """Loads and contact angles ball by ball, or of each kind of ball."""

    #: Balls that each entry stands for.
    count: Sequence[float]


@dataclasses.dataclass(frozen=True)
class OnFlank:
    """Least, mean and greatest of the balls on one flank."""

    load: Annotated[Mapping[str, float], Unit("N"), Info("Q", "normal load: least, mean and greatest")]
    angle: Annotated[
        Mapping[str, float], Unit("rad"), Info(r"\alpha", "contact angle: least, mean and greatest", "deg")
    ]


@dataclasses.dataclass(frozen=True, eq=False)
class NutLoads(table_of(_OF_ALL_BALLS)):
    """Loads of the balls of a nut, and how far it gives way."""

    #: True where the load has lifted the balls off the other flank.
    preload_is_lost: bool
    #: The flank that carries the load; null where no ball touches it.
    loaded_flank: OnFlank | None
    #: The flank that the load relieves; null where no ball touches it.
    relieved_flank: OnFlank | None
    #: Rigidity by ISO 3408-4.
    axial_rigidity: AxialRigidity
    #: Ball by ball, or kind by kind; not in lists of screws.
    balls: EachBall


def nut_loads(nut: NutState) -> NutLoads:
    """The loads of the balls of a nut: least, mean and greatest on both flanks, then ball by ball."""
    return from_attributes(
        NutLoads,
        nut.loads,
        preload_is_lost=nut.preload_is_lost,
        loaded_flank=_on_flank(nut.loaded),
        relieved_flank=_on_flank(nut.relieved),
        axial_rigidity=nut.rigidity,
        balls=from_attributes(EachBall, nut.loads, count=nut.loads.balls),
    )


def _on_flank(flank: Flank | None) -> OnFlank | None:
    if flank is None:
        return None
    load, angle = ({name: numbers[place] for place, name in enumerate(_ENDS)} for numbers in flank)
    return OnFlank(load, angle)
