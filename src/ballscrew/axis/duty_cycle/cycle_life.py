"""Mean loads and life over a cycle: each flank of the screw, or each half of a preloaded nut, by itself."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping

import numpy as np

from ballscrew.axis.duty_cycle.duty import Duty
from ballscrew.axis.motion.states import Numbers
from ballscrew.basis.arrays import ByValue, lazy
from ballscrew.basis.quantities import Force, Ratio
from ballscrew.physics.components.nut import Nut, SingleNut
from ballscrew.physics.equations import life

HOUR = 3600.0


def cubic_mean(loads: Numbers, turns: Numbers) -> Force:
    r"""The steady load that tires as much as these, :math:`F_m = \sqrt[3]{\sum q_i F_i^3 / \sum q_i}`, N.

    ISO3408-5 as recalled; the weights are turns and not times. NaN without any turn.
    """
    total = float(np.sum(turns))
    return float(np.sum(turns * np.abs(loads) ** 3) / total) ** (1 / 3) if total else math.nan


@dataclasses.dataclass(frozen=True, eq=False)
class CycleLife(ByValue):
    """Mean loads and life of a cycle.

    Without preload a load of one sign presses one flank of the thread, and the flank rests while the load has the other
    sign. With preload both halves are loaded all the time, by the formula of ISO3408-5
    (:func:`~ballscrew.physics.sizing.checks.loads_of_halves`). Turns count for all, loaded or not.
    """

    duty: Duty
    nut: Nut
    #: The axial preload, N; zero of a nut without.
    preload: Force
    #: That of one nut body or half, N; None where it is not known.
    dynamic_load_rating: Force | None = None
    #: Factor on the loads for shocks; THK514E has 1 to 1.2 for smooth motion, up to 3.5 for strong vibrations.
    load_factor: Ratio = 1.0

    @lazy
    def turns(self) -> Numbers:
        """Turns of the screw for which each state stands."""
        return self.duty.states.weight * np.abs(self.duty.screw_speed) / (2 * math.pi)

    @lazy
    def flank_loads(self) -> Mapping[str, Numbers]:
        """Axial force on each flank, or half, at the states, N."""
        load = self.duty.axial_load
        pressed = {"against positive motion": np.maximum(load, 0.0), "with positive motion": np.maximum(-load, 0.0)}
        if isinstance(self.nut, SingleNut) or not self.preload:
            return pressed
        size = np.abs(load)
        relieved = life.relieved_half_load(self.preload, life.preload_release(size, self.preload))
        return {name: np.where(part > 0, size + relieved, relieved) for name, part in pressed.items()}

    @lazy
    def mean_loads(self) -> Mapping[str, Force]:
        """Mean load of each flank, or half, over all turns of the cycle, N."""
        return {name: cubic_mean(loads, self.turns) for name, loads in self.flank_loads.items()}

    @property
    def mean_load(self) -> Force:
        """The larger of the two mean loads, N: what catalogues compute (THKGeneral)."""
        return max(self.mean_loads.values())

    @lazy
    def mean_load_of_both(self) -> Force:
        """Mean of the sizes of the axial load over all turns, N, without regard to its sign and to the preload."""
        return cubic_mean(self.duty.axial_load, self.turns)

    @lazy
    def lives(self) -> Mapping[str, Ratio]:
        """Basic rating life L10 of each flank or half, revolutions; infinite for one that is never loaded."""
        if self.dynamic_load_rating is None:
            return {}
        rated = self.dynamic_load_rating
        loads = {name: self.load_factor * load for name, load in self.mean_loads.items()}
        return {name: math.inf if load == 0 else life.basic_life(rated, load) for name, load in loads.items()}

    @property
    def revolutions(self) -> Ratio:
        """Basic rating life L10 by both flanks or halves, revolutions (ISO3408-5); NaN without a rating."""
        if not self.lives or any(math.isnan(each) for each in self.lives.values()):
            return math.nan
        worst = min(self.lives.values())
        return worst if math.isinf(worst) else float(life.combined_life(*self.lives.values()))

    @property
    def revolutions_of_the_worse(self) -> Ratio:
        """Turns by the larger mean load alone (THKGeneral); NaN without a rating."""
        values = [*self.lives.values()]
        return math.nan if any(map(math.isnan, values)) else min(values, default=math.nan)

    @property
    def cycles(self) -> Ratio:
        """Basic rating life L10 in cycles."""
        return self.revolutions / self.duty.revolutions if self.duty.revolutions else math.nan

    @property
    def time(self) -> Ratio:
        """Basic rating life L10h with one cycle after the other, s."""
        return self.cycles * self.duty.states.cycle_time
