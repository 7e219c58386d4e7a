"""Laws of rolling: the force of the film in the inlet, and the elastic resistance of steel."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import faults_of, raise_if_any
from ballscrew.basis.quantities import Force, Info, Length, Pressure, Ratio, Torque
from ballscrew.physics.equations import rolling
from ballscrew.physics.laws.conditions import ContactConditions
from ballscrew.physics.laws.traits import law_traits

# -- elastic resistance ---------------------------------------------------------------------------


@law_traits(alternative=True)
def snare_resistance(conditions: ContactConditions) -> Torque:
    """The paper's fit for steel, Olaru2005 §2.2 (20)."""
    return rolling.elastic_resistance_moment(conditions.ball_diameter, conditions.contact_load, conditions.radii_ratio)


@law_traits(alternative=True)
@dataclasses.dataclass(frozen=True, eq=False)
class Hysteresis(ByValue):
    """Elastic resistance as the part of the work of deformation that the material keeps, Johnson1985 §9.3."""

    loss_factor: Annotated[
        Ratio,
        Info(
            r"\alpha",
            "share of the elastic work lost in hysteresis",
            at_least=0,
            hint="steel has 0.01 to 0.04",
            usual=(0.0, 0.3),
        ),
    ] = 0.02

    def __post_init__(self) -> None:
        raise_if_any(faults_of("model.elastic_resistance", self))

    def __call__(self, conditions: ContactConditions) -> Torque:
        """Moment about the ball."""
        return rolling.hysteresis_moment(self.loss_factor, conditions.contact_load, conditions.semi_minor_axis)


@law_traits(alternative=True)
def olaru_rolling(conditions: ContactConditions) -> Force:
    """The paper's, Olaru2005 §2.1 (1): a moderate supply of oil, elastic regime only."""
    E, R_x, k, U, W = _groups(conditions)
    return rolling.hydrodynamic_rolling_force(E, R_x, k, conditions.material_parameter, U, W)


@law_traits(alternative=True)
def biboulet_houpert_rolling(conditions: ContactConditions) -> Force:
    """Both regimes and what lies between, fully flooded, BibouletHoupert2010 in the form of Balan2015."""
    E, R_x, k, U, W = _groups(conditions)
    return rolling.blended_rolling_force(
        rolling.rigid_rolling_force(E, R_x, k, W, U),
        rolling.elastic_rolling_force(E, R_x, k, W, U),
        rolling.rigid_regime_share(k, W, U),
    )


@law_traits(alternative=True)
def houpert_rolling(conditions: ContactConditions) -> Force:
    """The fit that the paper rounds, Houpert1987: a moderate supply of oil, elastic regime only."""
    E, R_x, _, U, W = _groups(conditions)
    kappa = conditions.hertz.ellipticity
    beta = rolling.ellipse_shape_parameter(conditions.hertz.major, conditions.hertz.minor)
    return rolling.elastic_rolling_force_houpert(E, R_x, beta, kappa, conditions.material_parameter, W, U)


@law_traits(alternative=True)
def aihara_rolling(conditions: ContactConditions) -> Force:
    """The law of Aihara1987 for rollers, on a line as long as the ellipse.

    It has the heat of the inlet in it: with the inlet law ``Inlet`` that counts twice, which matters at high speed.
    """
    _, R_x, _, U, W = _groups(conditions)
    return rolling.rolling_force_aihara(
        R_x,
        conditions.semi_major_axis,
        conditions.lubricant.pressure_viscosity_coefficient,
        conditions.material_parameter,
        U,
        rolling.line_load_parameter(conditions.hertz.major, W),
        conditions.thermal_loading_parameter,
    )


def _groups(conditions: ContactConditions) -> tuple[Pressure, Length, Ratio, Ratio, Ratio]:
    """E', R_x, k, U and W."""
    c = conditions
    return c.equivalent_modulus, c.rolling_radius, c.radii_ratio, c.speed_parameter, c.load_parameter
