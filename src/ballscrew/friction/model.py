"""The friction model: laws put together. Presets are papers."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Mapping
from types import SimpleNamespace
from typing import Annotated, Any

import numpy as np

from ballscrew._arrays import ByValue, as_array, lazy, same
from ballscrew.components.balance import Resistances, ball_forces
from ballscrew.components.conditions import Motion
from ballscrew.components.contact import Contact, ContactLaws, RaceState, rolling_contact
from ballscrew.components.frame import Frame, bearing_frame, helix_frame
from ballscrew.components.laws import (
    BallChainLaw,
    BallForceLaw,
    ContactLoadLaw,
    ElasticResistanceLaw,
    FilmLaw,
    FilmParameterLaw,
    FrameLaw,
    FrictionLaw,
    FullFilmLaw,
    HertzLaw,
    IdealTorqueLaw,
    InletLaw,
    RaceTorqueLaw,
    RollingLaw,
    balanced_race_torques,
    exact_hertz,
    houpert_hertz,
    imposed_ball_force,
    one_neighbour,
    printed_ideal_torque,
    printed_race_torques,
    snare_resistance,
    two_neighbours,
    virtual_work_torque,
)
from ballscrew.components.lubrication import (
    HamrockDowson,
    Inlet,
    biboulet_houpert_rolling,
    ideal_inlet,
    olaru_rolling,
    root_sum_square_film_parameter,
)
from ballscrew.components.lubrication import literal_film_parameter as printed_film_parameter
from ballscrew.components.materials import Lubricant
from ballscrew.components.mixed_friction import LoadSharing, ZhouHoeprich
from ballscrew.components.outside_laws import usable
from ballscrew.components.screw import BallScrew, Operation
from ballscrew.components.traits import traits_of
from ballscrew.equations import equilibrium, geometry, kinematics
from ballscrew.equations.rolling import nut_pressure_force, screw_pressure_force
from ballscrew.equations.transmission import contact_load as equal_contact_load
from ballscrew.errors import Fault, accepts_units, faults_of, raise_if_any
from ballscrew.friction.law_names import fault_of_law
from ballscrew.friction.plausibility import named_parts
from ballscrew.friction.result import FrictionResult
from ballscrew.overflow import overflow_as_input_error
from ballscrew.quantities import AngularSpeed, Force, Info, Ratio, fields_of
from ballscrew.solvers.ellipse_slip import ellipse_slip
from ballscrew.solvers.pure_rolling import curvature_slip
from ballscrew.solvers.slip import BallProblem, ContactSlip, Slip, SlipLaw

PAPER_FRICTION = ZhouHoeprich()


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class FrictionModel(ByValue):
    """A friction model of a ball screw: one law in each slot, and three numbers.

    Call it with a screw, a lubricant, a load and a speed. Change one thing with
    ``dataclasses.replace``. Raises :class:`~ballscrew.errors.InputError` for numbers out of bounds.
    """

    name: str
    frame: FrameLaw
    contact_load: ContactLoadLaw = equal_contact_load
    hertz: HertzLaw
    film: FilmLaw
    film_parameter: FilmParameterLaw = root_sum_square_film_parameter
    inlet: InletLaw = ideal_inlet
    friction: FrictionLaw = PAPER_FRICTION
    full_film: FullFilmLaw | None = None
    rolling: RollingLaw = olaru_rolling
    elastic_resistance: ElasticResistanceLaw = snare_resistance
    slip: SlipLaw = curvature_slip
    ball_chain: BallChainLaw
    ball_force: BallForceLaw = imposed_ball_force
    race_torques: RaceTorqueLaw
    ideal_torque: IdealTorqueLaw
    ball_to_ball_force: Annotated[
        Force | None,
        Info(
            "F_B",
            "net braking force between neighbouring balls; by default 1 N divided by the number of loaded balls",
            at_least=0,
            hint="the paper has 1/z and 2/z N",
            usual=(0.0, 1000.0),
        ),
    ] = None
    ball_friction_coefficient: Annotated[
        Ratio,
        Info(r"\mu_b", "friction coefficient between balls", at_least=0, hint="the paper has 0.1", usual=(0.0, 1.0)),
    ] = 0.1
    pure_rolling_offset: Annotated[
        Ratio | None,
        Info(
            "Y",
            "offset of the lines of pure rolling, at both contacts, where curvature is the only slip; "
            "if not imposed, it is solved for",
            at_least=0,
            at_most=1,
            hint="the paper imposes 0.34",
        ),
    ] = None

    def __post_init__(self) -> None:
        faults = faults_of("model", self, optional=("ball_to_ball_force", "pure_rolling_offset"))
        given = ((slot, getattr(self, slot)) for slot in SLOTS)
        faults += [fault for slot, law in given if (fault := fault_of_law(slot, law)) is not None]
        if self.pure_rolling_offset is not None and not traits_of(self.slip).curvature_alone:
            problem = "can only be imposed where curvature is the only slip"
            remedy = "leave it out, or take the slip law of the paper"
            faults.append(Fault("model.pure_rolling_offset", problem, str(self.pure_rolling_offset), remedy))
        raise_if_any(faults)

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
            film_parameter=printed_film_parameter if literal_film_parameter else root_sum_square_film_parameter,
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

    @classmethod
    def reference(cls) -> FrictionModel:
        """The physics that the paper leaves out, and the model to use unless the paper is the question.

        :meth:`corrected`, and: rolling force in all regimes, fully flooded (BibouletHoupert2010);
        heat of the inlet (Gupta1992); asperities and film that share the load (ZhouHoeprich1991);
        spin and the helix's lateral slip beside the curvature, over the whole ellipse and in
        balance; a ball that friction cannot carry along skids, in balance, and is flagged.
        """
        return cls(
            name="reference",
            frame=helix_frame,
            hertz=exact_hertz,
            film=HamrockDowson(),
            inlet=Inlet(),
            friction=LoadSharing(),
            rolling=biboulet_houpert_rolling,
            slip=ellipse_slip,
            ball_chain=two_neighbours,
            race_torques=balanced_race_torques,
            ideal_torque=virtual_work_torque,
        )

    @accepts_units("operation")
    def __call__(
        self, screw: BallScrew, lubricant: Lubricant, *, axial_load: Force, screw_speed: AngularSpeed
    ) -> FrictionResult:
        """Friction at an axial load (N) and a screw speed (rad/s); arrays broadcast.

        Array values are never refused: where they make no sense the result says so in its validity. Raises
        :class:`~ballscrew.errors.InputError` where plain numbers overflow.
        """
        operation = Operation(axial_load=as_array(axial_load), screw_speed=as_array(screw_speed))
        raise_if_any(_misfits(operation))
        with overflow_as_input_error(), np.errstate(all="ignore"):
            return self._evaluate(screw, lubricant, operation)

    @property
    def changes(self) -> tuple[str, ...]:
        """The slots and numbers that differ from the preset of the same name."""
        preset = presets().get(self.name)
        if preset is None:
            return ()
        fields = [field.name for field in dataclasses.fields(self)]
        return tuple(field for field in fields if not same(getattr(self, field), getattr(preset, field)))

    @property
    def label(self) -> str:
        """The name of the preset, and the slots and numbers that differ from it."""
        return self.name if not self.changes else f"{self.name}, changed: {', '.join(self.changes)}"

    @lazy
    def laws_with_coefficients(self) -> dict[str, Any]:
        """The laws that are dataclasses, by slot."""
        slots = {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}
        return {slot: law for slot, law in slots.items() if dataclasses.is_dataclass(law)}

    @lazy
    def laws(self) -> SimpleNamespace:
        """The laws by slot, to be called; those from outside check what they return."""
        slots = {name: usable(name, getattr(self, name), Slip if name == "slip" else None) for name in SLOTS}
        return SimpleNamespace(**slots)

    @lazy
    def contact_laws(self) -> ContactLaws:
        """The laws that one contact needs, to be called."""
        return ContactLaws(**{field.name: getattr(self.laws, field.name) for field in dataclasses.fields(ContactLaws)})

    def _evaluate(self, screw: BallScrew, lubricant: Lubricant, operation: Operation) -> FrictionResult:
        axial_load, screw_speed = operation.axial_load, operation.screw_speed
        laws = self.laws
        frame = laws.frame(screw)
        Q = laws.contact_load(axial_load, screw.loaded_balls, screw.contact_angle, frame.lead_angle)
        v = frame.entrainment_speed(screw_speed)
        d_w = screw.ball_diameter
        spin = kinematics.relative_spin(screw_speed, frame.rolling_plane_sine)
        lateral = kinematics.torsion_speed(screw_speed, d_w, frame.lead_angle)
        motion = Motion(v, spin / 2, lateral / 2)
        on_screw, on_nut = self.contacts(screw, lubricant, frame, Q, (motion, motion))
        F_B = laws.ball_force(self.imposed_ball_force(screw), Q)
        chain = laws.ball_chain(self.ball_friction_coefficient, F_B, d_w, frame)
        asked = Resistances(
            on_screw.hydrodynamic_rolling_force,
            on_nut.hydrodynamic_rolling_force,
            on_screw.elastic_resistance_moment,
            on_nut.elastic_resistance_moment,
            chain,
        )
        slip = laws.slip(BallProblem(on_screw, on_nut, asked, d_w, frame, screw_speed, self.pure_rolling_offset))
        carried = asked.scaled(slip.rolling_share)
        return FrictionResult(
            parts=named_parts(self, screw, lubricant, operation=operation),
            ball_screw=screw,
            frame=frame,
            axial_load=axial_load,
            screw_speed=screw_speed,
            contact_load=Q,
            entrainment_speed=v,
            ball_chain=carried.chain,
            ball_to_ball_force=slip.rolling_share * F_B,
            spin_moment=slip.spin_moment,
            lateral_force=slip.lateral_force,
            rolling_share=slip.rolling_share,
            race_torques=laws.race_torques,
            ideal_torque_law=laws.ideal_torque,
            converged=slip.converged,
            slip_is_curvature_alone=traits_of(self.slip).curvature_alone,
            **self._race_states(on_screw, on_nut, carried, slip, frame, d_w),
        )

    def contacts(
        self, screw: BallScrew, lubricant: Lubricant, frame: Frame, contact_load: Force, motions: tuple[Motion, Motion]
    ) -> tuple[Contact, Contact]:
        """The contacts of a ball with screw and nut under a load, in motion; what slips in them comes later."""
        d_w, gamma = screw.ball_diameter, frame.curvature_ratio
        sides = (
            (screw.screw_raceway, geometry.screw_rolling_radius(d_w, gamma)),
            (screw.nut_raceway, geometry.nut_rolling_radius(d_w, gamma)),
        )
        on_screw, on_nut = (
            rolling_contact(self.contact_laws, screw, raceway, lubricant, rolling_radius, contact_load, motion)
            for (raceway, rolling_radius), motion in zip(sides, motions, strict=True)
        )
        return on_screw, on_nut

    def imposed_ball_force(self, screw: BallScrew) -> Force:
        """The ball-to-ball force where the load does not set it: the paper's 1 N over the number of balls, or given."""
        return 1 / screw.loaded_balls if self.ball_to_ball_force is None else self.ball_to_ball_force

    def _race_states(
        self, on_screw: Contact, on_nut: Contact, carried: Resistances, slip: Slip, frame: Frame, ball_diameter: Any
    ) -> dict[str, RaceState]:
        F_Rs, F_Rn, M_ERs, M_ERn, chain = carried
        M_s = slip.screw.curvature_moment + M_ERs
        M_n = slip.nut.curvature_moment + M_ERn
        forces = ball_forces(Resistances(F_Rs, F_Rn, M_s, M_n, chain), ball_diameter, frame)
        torques = self.laws.race_torques(forces.screw_tangential_force, forces.nut_tangential_force, M_s, M_n, frame)
        through = equilibrium.spin_torque(slip.spin_moment, frame.rolling_plane_sine) + equilibrium.torsion_torque(
            slip.lateral_force, ball_diameter, frame.lead_angle
        )

        def state(contact: Contact, at_contact: ContactSlip, **changed: Any) -> RaceState:
            return contact.extended(
                RaceState,
                **changed,
                pure_rolling_offset=at_contact.pure_rolling_offset,
                curvature_friction_moment=at_contact.curvature_moment,
                creep_speed=at_contact.creep_speed,
                spin=at_contact.spin,
                lateral_slip_speed=at_contact.lateral_slip_speed,
            )

        return {
            "screw": state(
                on_screw,
                slip.screw,
                hydrodynamic_rolling_force=F_Rs,
                elastic_resistance_moment=M_ERs,
                sliding_force=forces.screw_sliding_force,
                contact_radius=frame.screw_contact_radius,
                pressure_force=screw_pressure_force(F_Rs, frame.curvature_ratio),
                tangential_force=forces.screw_tangential_force,
                friction_torque=torques.screw + through,
            ),
            "nut": state(
                on_nut,
                slip.nut,
                hydrodynamic_rolling_force=F_Rn,
                elastic_resistance_moment=M_ERn,
                sliding_force=forces.nut_sliding_force,
                contact_radius=frame.nut_contact_radius,
                pressure_force=nut_pressure_force(F_Rn, frame.curvature_ratio),
                tangential_force=forces.nut_tangential_force,
                friction_torque=torques.nut + through,
            ),
        }


#: The slots of the model: its fields that hold a law.
SLOTS = tuple(
    field.name for field in dataclasses.fields(FrictionModel) if field.name not in ("name", *fields_of(FrictionModel))
)


def _misfits(operation: Operation) -> list[Fault]:
    """Fault of arrays of loads and speeds that do not broadcast."""
    shapes = [np.shape(value) for value in vars(operation).values() if isinstance(value, np.ndarray)]
    try:
        np.broadcast_shapes(*shapes)
    except ValueError:
        given = " and ".join(map(str, shapes))
        remedy = "give one speed for each load; for every load at every speed use ballscrew.sweep"
        return [Fault("operation", "loads and speeds do not fit together", given, remedy)]
    return []


@functools.cache
def presets() -> Mapping[str, FrictionModel]:
    """The named models: papers, and what was made of them."""
    models = (
        FrictionModel.olaru2005(),
        FrictionModel.olaru2005(literal_film_parameter=True),
        FrictionModel.corrected(),
        FrictionModel.reference(),
    )
    return {model.name: model for model in models}
