"""Linear guides with rolling bodies, by the law of their makers."""

from __future__ import annotations

import dataclasses
from typing import Annotated

import numpy as np

from ballscrew.axis.supports import formulas
from ballscrew.axis.supports.makers_bearing import MakersFriction
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import accepts_units, faults_of, raise_if_any
from ballscrew.basis.quantities import Count, Force, Info, Ratio, Speed, Temperature
from ballscrew.physics.components.operating_state import OperatingState

Carriages = Annotated[Count, Info("n", "carriages of the table", at_least=1, at_most=100, whole=True, hint="2 or 4")]
#: Names of the parts, as those of the torque of an axis.
GUIDES, SEALS = "guides", "guide seals"


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class LinearGuide(ByValue):
    r"""The carriages of a table on their rails: :math:`F = \sum \mu \left|P_i\right| + f`.

    A :class:`~ballscrew.physics.friction.element.FrictionElement` whose effort is a force along the rail, N. Called
    with a state, its load is that of all carriages, which share it evenly, and its ``screw_speed`` stands for the
    speed along the rail, m/s; :meth:`under` takes the load of each carriage, as
    :class:`~ballscrew.axis.supports.carriage_loads.GuidedTable` has them.

    The coefficient of catalogues is 0.002 to 0.003 with balls (Thomson2024, Rollon2020) and 0.001 to 0.002 with rollers
    (Thomson2024), at a load of a fifth of the dynamic rating and without preload (NB2024). Seals have 2 N to 5 N a
    carriage (NB2024), light ones 0.15 N to 1 N by size (Rollon2020;
    :func:`~ballscrew.axis.supports.catalogue_rows.guide_rows`).
    Preload, oil, fresh grease and temperature are in neither number and add to both.
    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds.
    """

    friction_coefficient: Annotated[
        Ratio,
        Info(
            r"\mu",
            "friction coefficient of the rolling bodies",
            at_least=0,
            hint="0.002 to 0.003 with balls, 0.001 to 0.002 with rollers",
            usual=(0.0, 0.05),
        ),
    ]
    seal_force: Annotated[
        Force,
        Info("f", "force of the seals of one carriage", "N", at_least=0, hint="2 N to 5 N", usual=(0.0, 200.0)),
    ]
    carriages: Carriages = 4

    def __post_init__(self) -> None:
        raise_if_any(faults_of("guide", self))

    def __call__(self, state: OperatingState, /) -> MakersFriction:
        """Friction at a ``state``: the load of all carriages (N), shared evenly, and the speed along the rail (m/s).

        Returns :class:`~ballscrew.axis.supports.makers_bearing.MakersFriction`, whose effort is a force, N.
        """
        share = np.asarray(state.axial_load)[..., np.newaxis] / self.carriages
        return self.under(share * np.ones(int(self.carriages)), state.screw_speed)

    @accepts_units("guide")
    def under(
        self,
        loads: Force,
        speed: Speed = 0.0,
        temperature: Temperature | None = None,  # noqa: ARG002  (as the guides of an axis are called)
    ) -> MakersFriction:
        """Friction where the ``loads`` of the carriages are known, N, one for each along the last axis.

        Returns :class:`~ballscrew.axis.supports.makers_bearing.MakersFriction`. The force knows neither the ``speed``
        (m/s) nor the ``temperature`` (K). Raises :class:`~ballscrew.basis.errors.InputError` for units that do not fit.
        """
        carriages = np.shape(loads)[-1]
        rolling = np.sum(formulas.guide_friction(np.abs(loads), self.friction_coefficient, 0.0), axis=-1)
        return MakersFriction({GUIDES: rolling, SEALS: carriages * self.seal_force}, speed)
