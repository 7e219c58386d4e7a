"""The friction model: laws put together. Presets are papers.

Names of laws, as case files and tables have them.

A row here gives a law a name and no more. Whether the uncertainty band counts it as an alternative is declared beside
the law (:mod:`ballscrew.physics.laws.traits`).
"""

from __future__ import annotations

import dataclasses
import functools
import warnings
from collections.abc import Mapping
from types import SimpleNamespace
from typing import Annotated, Any

import numpy as np

from ballscrew.basis.arrays import ByValue, as_array, lazy, same
from ballscrew.basis.errors import (
    Fault,
    accepts_units,
    faults_of,
    names_keywords,
    nearest,
    overflow_as_input_error,
    raise_if_any,
)
from ballscrew.basis.quantities import AngularSpeed, Force, Info, Quantity, Ratio, Temperature, fields_of
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import Bodies, Deviations, Nut, SingleNut
from ballscrew.physics.components.operating_state import USE_SWEEP, OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations.transmission import contact_load as equal_contact_load
from ballscrew.physics.friction.across_groove import in_motion
from ballscrew.physics.friction.loaded_balls import balls_under, loads_of, row_of_balls
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.friction.validity import named_parts
from ballscrew.physics.laws import ball_chain, film, frame, friction, hertz, inlet, rolling, torque
from ballscrew.physics.laws.ball_chain import (
    CircuitForceLaw,
    ProportionalBallForce,
    imposed_ball_force,
    one_neighbour,
    opposed_neighbours,
    parted_neighbours,
    two_neighbours,
)
from ballscrew.physics.laws.contact import ContactLaws
from ballscrew.physics.laws.film import HamrockDowson, root_sum_square_film_parameter
from ballscrew.physics.laws.frame import bearing_frame, helix_frame
from ballscrew.physics.laws.friction import RunInSharing, ZhouHoeprich
from ballscrew.physics.laws.hertz import exact_hertz, houpert_hertz
from ballscrew.physics.laws.inlet import Inlet, ideal_inlet
from ballscrew.physics.laws.nut_losses import ParasiticLaw
from ballscrew.physics.laws.protocols import (
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
    usable,
)
from ballscrew.physics.laws.rolling import biboulet_houpert_rolling, olaru_rolling, snare_resistance
from ballscrew.physics.laws.torque import (
    balanced_race_torques,
    printed_ideal_torque,
    printed_race_torques,
    virtual_work_torque,
)
from ballscrew.physics.laws.traits import traits_of
from ballscrew.physics.solvers.ellipse_slip import ellipse_slip
from ballscrew.physics.solvers.line_slip import line_slip
from ballscrew.physics.solvers.load_distribution import BallLoads
from ballscrew.physics.solvers.slip import Slip, SlipLaw, curvature_slip

#: The laws of each slot by name: functions, and classes where a law has coefficients.
LAWS: Mapping[str, Mapping[str, Any]] = {
    "frame": {"bearing": frame.bearing_frame, "helix": frame.helix_frame},
    "hertz": {
        "houpert": hertz.houpert_hertz,
        "exact": hertz.exact_hertz,
        "brewe-hamrock": hertz.brewe_hamrock_hertz,
    },
    "film": {
        "hamrock-dowson": film.HamrockDowson,
        "hamrock-dowson-central": film.hamrock_dowson_central,
        "chittenden": film.chittenden,
    },
    "film_parameter": {
        "root-sum-square": film.root_sum_square_film_parameter,
        "literal": film.literal_film_parameter,
    },
    "inlet": {"ideal": inlet.ideal_inlet, "heated": inlet.Inlet, "flooded": inlet.flooded_inlet},
    "friction": {
        "zhou-hoeprich": friction.ZhouHoeprich,
        "load-sharing": friction.LoadSharing,
        "run-in": friction.RunInSharing,
        "balan": friction.BalanSharing,
        "greenwood-tripp": friction.GreenwoodTrippSharing,
    },
    "full_film": {
        "none": None,
        "arana": friction.arana_traction,
        "eyring": friction.EyringTraction,
        "limiting-shear": friction.LimitingShearTraction,
    },
    "rolling": {
        "olaru": rolling.olaru_rolling,
        "biboulet-houpert": rolling.biboulet_houpert_rolling,
        "houpert": rolling.houpert_rolling,
        "aihara": rolling.aihara_rolling,
    },
    "elastic_resistance": {"snare": rolling.snare_resistance, "hysteresis": rolling.Hysteresis},
    "slip": {"curvature": curvature_slip, "line": line_slip, "ellipse": ellipse_slip},
    "ball_chain": {
        "one-neighbour": ball_chain.one_neighbour,
        "two-neighbours": ball_chain.two_neighbours,
        "opposed-neighbours": ball_chain.opposed_neighbours,
        "parted-neighbours": ball_chain.parted_neighbours,
    },
    "ball_force": {
        "imposed": ball_chain.imposed_ball_force,
        "proportional": ball_chain.ProportionalBallForce,
        "chain": ball_chain.ChainBallForce,
    },
    "race_torques": {"printed": torque.printed_race_torques, "balanced": torque.balanced_race_torques},
    "ideal_torque": {"printed": torque.printed_ideal_torque, "virtual-work": torque.virtual_work_torque},
}


def coefficients(law: Any) -> Mapping[str, Quantity]:
    """The coefficients of a law by name; none for a law that is a function."""
    return fields_of(law) if dataclasses.is_dataclass(law) else {}


def fault_of_law(slot: str, law: Any) -> Fault | None:
    """Fault of a value given for a law in Python; None if it can be called."""
    if callable(law) and not isinstance(law, type):
        return None
    where, known = f"model.{slot}", LAWS.get(slot, {})
    if law is None and None in known.values():
        return None
    if isinstance(law, type):
        return Fault(where, "must be a law", f"the class {law.__name__}", f"make one of it: {law.__name__}(…)")
    if not isinstance(law, str):
        return Fault(where, "must be a law", repr(law), "give a function, or a frozen dataclass with __call__")
    named = known.get(law)
    if named is None:
        remedy = f"{nearest(law, known)} in a case file; in Python give the law itself"
    else:
        made = f"{named.__name__}()" if isinstance(named, type) else named.__name__
        remedy = f"from {named.__module__} import {named.__name__}, and give {slot}={made}"
    return Fault(where, "must be a law, not its name", law, remedy)


PAPER_FRICTION = ZhouHoeprich()


@names_keywords
@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class FrictionModel(ByValue):
    """A friction model of a ball screw: one law in each slot, and three numbers.

    Call it with a screw, a lubricant, a load and a speed. Change one thing with
    ``dataclasses.replace``. Raises :class:`~ballscrew.basis.errors.InputError` for numbers out of bounds.
    """

    #: The name of the preset that it is, or was made from.
    name: str
    #: Law of the frame in which the balls roll.
    frame: FrameLaw
    #: Normal load of a ball from the axial load, N.
    contact_load: ContactLoadLaw = equal_contact_load
    #: Shape of the contact ellipse from the radii.
    hertz: HertzLaw
    #: Minimum film thickness, m, inlet cool and full.
    film: FilmLaw
    #: Film thickness against roughness.
    film_parameter: FilmParameterLaw = root_sum_square_film_parameter
    #: Heating and filling of the inlet.
    inlet: InletLaw = ideal_inlet
    #: Friction coefficient of a contact, most often from its film parameter.
    friction: FrictionLaw = PAPER_FRICTION
    #: Friction coefficient of the film itself, where it alone carries the load; None for that of ``friction``.
    full_film: FullFilmLaw | None = None
    #: Hydrodynamic rolling force, N.
    rolling: RollingLaw = olaru_rolling
    #: Elastic resistance to rolling, N m.
    elastic_resistance: ElasticResistanceLaw = snare_resistance
    #: Slip of the contacts of a ball.
    slip: SlipLaw = curvature_slip
    #: Law of the contact of a ball with its neighbours.
    ball_chain: BallChainLaw
    #: Net braking force between neighbouring balls, N.
    ball_force: BallForceLaw | CircuitForceLaw = imposed_ball_force
    #: Friction torque of one ball on screw and nut, N m.
    race_torques: RaceTorqueLaw
    #: Drive torque without friction, N m.
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

        ``literal_film_parameter`` leaves the square root out: the text to the letter.
        """
        return cls(
            name="olaru2005-literal" if literal_film_parameter else "olaru2005",
            frame=bearing_frame,
            hertz=houpert_hertz,
            film=HamrockDowson(speed_exponent=0.66),
            film_parameter=film.literal_film_parameter if literal_film_parameter else root_sum_square_film_parameter,
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

        :meth:`corrected`, and: rolling force in all regimes (BibouletHoupert2010);
        heat of the inlet (Gupta1992), and oil that flows back too late (SKF2018); asperities and film that share
        the load between run-in surfaces (ZhouHoeprich1991); neighbouring balls that press on each other in proportion
        to their load, and rub, without a net braking force;
        spin and the helix's lateral slip beside the curvature, over the whole ellipse and in
        balance; a ball that friction cannot carry along skids, in balance, and is flagged.
        """
        return cls(
            name="reference",
            frame=helix_frame,
            hertz=exact_hertz,
            film=HamrockDowson(),
            inlet=Inlet(),
            friction=RunInSharing(),
            rolling=biboulet_houpert_rolling,
            slip=ellipse_slip,
            ball_chain=opposed_neighbours,
            ball_force=ProportionalBallForce(),
            race_torques=balanced_race_torques,
            ideal_torque=virtual_work_torque,
        )

    @accepts_units("operation")
    def __call__(
        self,
        screw: BallScrew,
        lubricant: Lubricant,
        *,
        axial_load: Force,
        screw_speed: AngularSpeed,
        temperature: Temperature | None = None,
        loads: BallLoads | None = None,
    ) -> FrictionResult:
        """Friction at an axial load and a screw speed of either sign; arrays broadcast.

        Returns a :class:`~ballscrew.physics.friction.result.FrictionResult` of ``screw`` with ``lubricant`` at
        ``axial_load`` (N) and ``screw_speed`` (rad/s). A positive load is one that a positive speed lifts. What is
        nearer to zero than 1e-100 counts as no load, and as rest under friction of the same direction. With a
        ``temperature`` (K) the lubricant, which must have been made from a data sheet or a grade, is taken there.
        ``loads`` are those of the balls under this axial load, where they are known
        (:func:`~ballscrew.physics.solvers.load_distribution.ball_loads`): of a nut whose preload was set at rest, in
        motion. Array values are never refused: where they
        make no sense the result says so in its validity. Raises :class:`~ballscrew.basis.errors.InputError` where plain
        numbers overflow, for a temperature of an oil without either, and for a nut whose balls have four contacts with
        a slip law that knows two.
        """
        state = OperatingState(as_array(axial_load), as_array(screw_speed), as_array(temperature))
        raise_if_any([*_misfits(state), *self._misfits_of_nut(screw)])
        oil = lubricant if temperature is None else lubricant.at(state.temperature)
        with overflow_as_input_error(), np.errstate(all="ignore"):
            if loads is None:
                screw = in_motion(self, screw, oil, state.settled)
            known = loads_of(screw, state.axial_load) if loads is None and not screw.nut.is_row else loads
            return self.under(known, screw, oil, state)

    def knows(self, nut: Nut) -> bool:
        """Return whether the slip law knows the number of contacts that the balls of ``nut`` have."""
        return nut.contacts_per_ball in traits_of(self.slip).contacts_per_ball

    def _misfits_of_nut(self, screw: BallScrew) -> list[Fault]:
        if self.knows(screw.nut):
            return []
        remedy = 'take the model reference, or slip = "ellipse"'
        return [Fault("model.slip", "knows no balls with four contacts, as an oversize-ball nut has", "", remedy)]

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

    def under(
        self, loads: BallLoads | None, screw: BallScrew, lubricant: Lubricant, state: OperatingState
    ) -> FrictionResult:
        """Friction where the ``loads`` of the balls are known; None for a row of equal balls. Nothing is checked.

        Returns a :class:`~ballscrew.physics.friction.result.FrictionResult` of ``screw`` with ``lubricant`` at
        ``state``.
        """
        nut, laws, settled = screw.nut, self.laws, state.settled
        of_balls = self.parted if nut.spacer_balls else self
        kinds = (
            (row_of_balls(of_balls, screw, lubricant, settled),)
            if loads is None
            else balls_under(of_balls, screw, lubricant, settled, loads)
        )
        number = 1.0 * nut.halves * screw.loaded_balls
        all_balls = dataclasses.replace(screw, loaded_balls=number) if nut.losses else screw
        return FrictionResult(
            parts=named_parts(self, screw, lubricant, operation=state),
            ball_screw=screw,
            frame=laws.frame(screw),
            axial_load=settled.axial_load,
            screw_speed=state.screw_speed,
            kinds=kinds,
            losses={name: law(all_balls, lubricant, abs(settled.screw_speed)) for name, law in nut.losses.items()},
            ideal_torque_law=laws.ideal_torque,
            solved_loads=loads,
        )

    @lazy
    def in_full_bath(self) -> FrictionModel:
        """The model in a full bath of oil, which is always back in the track in time; itself where nothing is late."""
        inlet: Any = self.inlet
        constant = getattr(inlet, "replenishment_constant", None)
        if constant is None or (isinstance(constant, int | float) and constant == 0):
            return self
        return dataclasses.replace(self, inlet=dataclasses.replace(inlet, replenishment_constant=0.0))

    @lazy
    def parted(self) -> FrictionModel:
        """The model of balls that spacer balls part: none touches another that carries load."""
        apart = {"ball_chain": parted_neighbours, "ball_force": ProportionalBallForce(0.0), "ball_to_ball_force": None}
        return dataclasses.replace(self, **apart)

    def imposed_ball_force(self, screw: BallScrew) -> Force:
        """Ball force where the load does not set it, N: as given, or the paper's 1 N over the balls of ``screw``."""
        return 1 / screw.loaded_balls if self.ball_to_ball_force is None else self.ball_to_ball_force


#: The slots of the model: its fields that hold a law.
SLOTS = tuple(
    field.name for field in dataclasses.fields(FrictionModel) if field.name not in ("name", *fields_of(FrictionModel))
)


def _misfits(state: OperatingState) -> list[Fault]:
    """Fault of arrays of loads and speeds that do not broadcast."""
    shapes = [np.shape(value) for value in vars(state).values() if isinstance(value, np.ndarray)]
    try:
        np.broadcast_shapes(*shapes)
    except ValueError:
        given = " and ".join(map(str, shapes))
        return [Fault("operation", "loads and speeds do not fit together", given, USE_SWEEP)]
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


def nut_friction(
    model: FrictionModel,
    screw: BallScrew,
    nut: Nut,
    lubricant: Lubricant,
    *,
    axial_load: Force,
    screw_speed: AngularSpeed,
    bodies: Bodies | None = None,
    deviations: Deviations | None = None,
    losses: Mapping[str, ParasiticLaw] | None = None,
) -> FrictionResult:
    """Deprecated: call the model with ``dataclasses.replace(screw, nut=nut)``.

    Returns the :class:`~ballscrew.physics.friction.result.FrictionResult` of ``model`` for ``screw`` with another
    ``nut`` and with ``lubricant``, at ``axial_load`` (N) and ``screw_speed`` (rad/s); arrays broadcast. ``bodies``,
    ``deviations`` and ``losses`` take the place of those of the nut, where they are given. The contact angle of a
    single nut follows its load here, as with ``SingleNut(angle_under_load=True)``.

    Raises what the model raises (:class:`~ballscrew.basis.errors.InputError`).
    """
    warnings.warn(
        "nut_friction is deprecated: a ball screw has its nut, model(BallScrew(…, nut=…), oil, …)",
        DeprecationWarning,
        stacklevel=2,
    )
    parts = {"bodies": bodies, "deviations": deviations, "losses": losses}
    nut = dataclasses.replace(nut, **{name: part for name, part in parts.items() if part is not None})
    if isinstance(nut, SingleNut):
        nut = dataclasses.replace(nut, angle_under_load=True)
    return model(dataclasses.replace(screw, nut=nut), lubricant, axial_load=axial_load, screw_speed=screw_speed)
