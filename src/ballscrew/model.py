"""The friction model: laws put together. Presets are papers."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Mapping
from typing import Annotated, Any

import numpy as np

from ballscrew._arrays import as_array, lazy
from ballscrew.components.balance import Resistances, ball_balance
from ballscrew.components.contact import Contact, ContactLaws, RaceState, rolling_contact
from ballscrew.components.frame import Frame, bearing_frame, helix_frame
from ballscrew.components.laws import (
    BallChain,
    BallChainLaw,
    ContactLoadLaw,
    ElasticResistanceLaw,
    FilmLaw,
    FilmParameterLaw,
    FrameLaw,
    FrictionLaw,
    HamrockDowson,
    HertzLaw,
    IdealTorqueLaw,
    RaceTorqueLaw,
    RollingLaw,
    ZhouHoeprich,
    balanced_race_torques,
    exact_hertz,
    houpert_hertz,
    one_neighbour,
    printed_ideal_torque,
    printed_race_torques,
    two_neighbours,
    virtual_work_torque,
)
from ballscrew.components.materials import Lubricant
from ballscrew.components.screw import BallScrew, Operation
from ballscrew.equations import geometry
from ballscrew.equations.film import film_parameter as rms_film_parameter
from ballscrew.equations.film import literal_film_parameter as printed_film_parameter
from ballscrew.equations.rolling import (
    elastic_resistance_moment,
    hydrodynamic_rolling_force,
    nut_pressure_force,
    screw_pressure_force,
)
from ballscrew.equations.transmission import contact_load as equal_contact_load
from ballscrew.faults import faults_of, is_concrete, raise_if_any
from ballscrew.quantities import AngularSpeed, Force, Info, Ratio
from ballscrew.result import FrictionResult
from ballscrew.solvers import pure_rolling

PAPER_FRICTION = ZhouHoeprich()


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class FrictionModel:
    """A friction model of a ball screw: one law in each slot, and three numbers.

    Call it with a screw, a lubricant, a load and a speed. Change one thing with
    ``dataclasses.replace``. Raises :class:`~ballscrew.faults.InputError` for numbers out of bounds.
    """

    name: str
    frame: FrameLaw
    contact_load: ContactLoadLaw = equal_contact_load
    hertz: HertzLaw
    film: FilmLaw
    film_parameter: FilmParameterLaw = rms_film_parameter
    friction: FrictionLaw = PAPER_FRICTION
    rolling: RollingLaw = hydrodynamic_rolling_force
    elastic_resistance: ElasticResistanceLaw = elastic_resistance_moment
    ball_chain: BallChainLaw
    race_torques: RaceTorqueLaw
    ideal_torque: IdealTorqueLaw
    ball_to_ball_force: Annotated[
        Force | None,
        Info(
            "F_B",
            "net braking force between neighbouring balls; by default 1 N divided by the number of loaded balls",
            at_least=0,
            hint="the paper has 1/z and 2/z N",
        ),
    ] = None
    ball_friction_coefficient: Annotated[
        Ratio, Info(r"\mu_b", "friction coefficient between balls", at_least=0, hint="the paper has 0.1")
    ] = 0.1
    pure_rolling_offset: Annotated[
        Ratio | None,
        Info(
            "Y",
            "offset of the lines of pure rolling, at both contacts; if not imposed, it is solved for",
            at_least=0,
            at_most=1,
            hint="the paper imposes 0.34",
        ),
    ] = None

    def __post_init__(self) -> None:
        raise_if_any(faults_of("model", self, optional=("ball_to_ball_force", "pure_rolling_offset")))

    @classmethod
    def olaru2005(cls, *, literal_film_parameter: bool = False) -> FrictionModel:
        """The paper as printed, with Q = F/(z sin α) and the square root that (22) of §4 needs.

        ``literal_film_parameter=True`` leaves the square root out: the text to the letter.
        """
        return cls(
            name="olaru2005-literal" if literal_film_parameter else "olaru2005",
            frame=bearing_frame,
            hertz=houpert_hertz,
            film=HamrockDowson(speed_exponent=0.66),
            film_parameter=printed_film_parameter if literal_film_parameter else rms_film_parameter,
            ball_chain=one_neighbour,
            race_torques=printed_race_torques,
            ideal_torque=printed_ideal_torque,
            pure_rolling_offset=0.34,
        )

    @classmethod
    def corrected(cls) -> FrictionModel:
        """The paper with its misprints and its missing reactions put right, and nothing added.

        Film exponent 0.68, exact Hertz contact, helix kinematics, the offset Y from equilibrium,
        two neighbours in a curved chain, contact moments on the races, and F P_h/2π. Still without
        spin; (1), (20) and the clamp of §5 stay as printed.
        """
        return cls(
            name="corrected",
            frame=helix_frame,
            hertz=exact_hertz,
            film=HamrockDowson(),
            ball_chain=two_neighbours,
            race_torques=balanced_race_torques,
            ideal_torque=virtual_work_torque,
        )

    def __call__(
        self, screw: BallScrew, lubricant: Lubricant, *, axial_load: Force, screw_speed: AngularSpeed
    ) -> FrictionResult:
        """Friction at an axial load (N) and a screw speed (rad/s); arrays broadcast.

        Array values are never refused: where they make no sense the result says so in its validity.
        """
        operation = Operation(axial_load=as_array(axial_load), screw_speed=as_array(screw_speed))
        with np.errstate(all="ignore"):
            return self._evaluate(screw, lubricant, operation)

    @property
    def label(self) -> str:
        """The name of the preset, and the slots and numbers that are not as there."""
        preset = presets().get(self.name)
        if preset is None:
            return self.name
        fields = [field.name for field in dataclasses.fields(self)]
        changed = [field for field in fields if not _same(getattr(self, field), getattr(preset, field))]
        return self.name if not changed else f"{self.name}, changed: {', '.join(changed)}"

    @lazy
    def laws_with_coefficients(self) -> dict[str, Any]:
        """The laws that are dataclasses, by slot."""
        slots = {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}
        return {slot: law for slot, law in slots.items() if dataclasses.is_dataclass(law)}

    def _evaluate(self, screw: BallScrew, lubricant: Lubricant, operation: Operation) -> FrictionResult:
        axial_load, screw_speed = operation.axial_load, operation.screw_speed
        frame = self.frame(screw)
        Q = self.contact_load(axial_load, screw.loaded_balls, screw.contact_angle, frame.lead_angle)
        v = frame.entrainment_speed(screw_speed)
        d_w, gamma = screw.ball_diameter, frame.curvature_ratio
        laws = ContactLaws(
            self.hertz, self.film, self.film_parameter, self.friction, self.rolling, self.elastic_resistance
        )
        on_screw = rolling_contact(
            laws, screw, screw.screw_raceway, lubricant, geometry.screw_rolling_radius(d_w, gamma), Q, v
        )
        on_nut = rolling_contact(
            laws, screw, screw.nut_raceway, lubricant, geometry.nut_rolling_radius(d_w, gamma), Q, v
        )
        F_B = 1 / screw.loaded_balls if self.ball_to_ball_force is None else self.ball_to_ball_force
        chain = self.ball_chain(self.ball_friction_coefficient, F_B, d_w, frame)
        lines = self._pure_rolling(on_screw, on_nut, chain, frame, d_w)
        laws_and_numbers = (self, *self.laws_with_coefficients.values())
        return FrictionResult(
            parts=(screw, *screw.materials, lubricant, operation, *laws_and_numbers),
            ball_screw=screw,
            frame=frame,
            axial_load=axial_load,
            screw_speed=screw_speed,
            contact_load=Q,
            entrainment_speed=v,
            ball_chain=chain,
            ball_to_ball_force=F_B,
            race_torques=self.race_torques,
            ideal_torque_law=self.ideal_torque,
            converged=lines.converged,
            **self._race_states(on_screw, on_nut, chain, lines, frame, d_w),
        )

    def _pure_rolling(
        self, on_screw: Contact, on_nut: Contact, chain: BallChain, frame: Frame, ball_diameter: Any
    ) -> pure_rolling.PureRolling:
        if self.pure_rolling_offset is not None:
            return pure_rolling.imposed(on_screw, on_nut, self.pure_rolling_offset)
        without_curvature = Resistances(
            on_screw.hydrodynamic_rolling_force,
            on_nut.hydrodynamic_rolling_force,
            on_screw.elastic_resistance_moment,
            on_nut.elastic_resistance_moment,
            chain,
        )
        balance = ball_balance(without_curvature, ball_diameter, frame, self.race_torques)
        return pure_rolling.solve(
            on_screw, on_nut, balance.screw_sliding_force, balance.nut_sliding_force, ball_diameter
        )

    def _race_states(
        self,
        on_screw: Contact,
        on_nut: Contact,
        chain: BallChain,
        lines: pure_rolling.PureRolling,
        frame: Frame,
        ball_diameter: Any,
    ) -> dict[str, RaceState]:
        F_Rs, F_Rn = on_screw.hydrodynamic_rolling_force, on_nut.hydrodynamic_rolling_force
        M_s = lines.screw_moment + on_screw.elastic_resistance_moment
        M_n = lines.nut_moment + on_nut.elastic_resistance_moment
        balance = ball_balance(Resistances(F_Rs, F_Rn, M_s, M_n, chain), ball_diameter, frame, self.race_torques)
        return {
            "screw": RaceState(
                **vars(on_screw),
                pure_rolling_offset=lines.screw_offset,
                curvature_friction_moment=lines.screw_moment,
                sliding_force=balance.screw_sliding_force,
                contact_radius=frame.screw_contact_radius,
                pressure_force=screw_pressure_force(F_Rs, frame.curvature_ratio),
                tangential_force=balance.screw_tangential_force,
                friction_torque=balance.torques.screw,
            ),
            "nut": RaceState(
                **vars(on_nut),
                pure_rolling_offset=lines.nut_offset,
                curvature_friction_moment=lines.nut_moment,
                sliding_force=balance.nut_sliding_force,
                contact_radius=frame.nut_contact_radius,
                pressure_force=nut_pressure_force(F_Rn, frame.curvature_ratio),
                tangential_force=balance.nut_tangential_force,
                friction_torque=balance.torques.nut,
            ),
        }


@functools.cache
def presets() -> Mapping[str, FrictionModel]:
    """The named models: papers, and what was made of them."""
    models = (
        FrictionModel.olaru2005(),
        FrictionModel.olaru2005(literal_film_parameter=True),
        FrictionModel.corrected(),
    )
    return {model.name: model for model in models}


def _same(one: Any, other: Any) -> bool:
    """Whether two entries of a slot are the same law with the same coefficients, or the same number."""
    if dataclasses.is_dataclass(one) and type(one) is type(other):
        return all(_same(value, vars(other)[name]) for name, value in vars(one).items())
    return one is other or (is_concrete(one) and is_concrete(other) and bool(one == other))
