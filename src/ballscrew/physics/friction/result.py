"""Result of a friction model: torques, their parts, the contacts, and their validity."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Annotated, Any, NamedTuple

import numpy as np

from ballscrew.basis.arrays import lazy, where
from ballscrew.basis.displayed import Drawn
from ballscrew.basis.quantities import (
    AngularSpeed,
    Force,
    Info,
    Mask,
    Power,
    Pressure,
    Ratio,
    Speed,
    Torque,
    quantities_of,
)
from ballscrew.basis.records import Record
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import transmission
from ballscrew.physics.friction import directions, loaded_balls, validity
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.directions import VendorTerms
from ballscrew.physics.friction.loaded_balls import LoadedBalls, LoadedPair
from ballscrew.physics.friction.validity import (
    NUT_CONDITIONS,
    imbalance_records,
    implausible,
    input_mask,
    validity_masks,
    warning_records,
)
from ballscrew.physics.laws.contact import RaceState
from ballscrew.physics.laws.frame import Frame
from ballscrew.physics.laws.protocols import BallChain, IdealTorqueLaw
from ballscrew.physics.solvers.load_distribution import BallLoads

#: The four quadrants: directions of the load on the nut and of the rotation.
QUADRANTS: Mapping[str, tuple[int, int]] = {
    "drives forward": (1, 1),
    "is back-driven in reverse": (1, -1),
    "drives in reverse": (-1, -1),
    "is back-driven forward": (-1, 1),
}


class Quadrant(NamedTuple):
    """One of the four combinations of load and rotation."""

    #: Direction of the load on the nut, 1 or -1.
    load_sign: int
    #: Direction of the rotation, 1 or -1.
    speed_sign: int
    #: Torque on the shaft, positive the way that moves the nut against a load of +1.
    shaft_torque: Torque
    #: Power of that torque.
    shaft_power: Power
    #: Efficiency of the power that arrives, from the shaft or from the load.
    efficiency: Ratio


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class FrictionResult(VendorTerms, Drawn):
    """Friction of a ball screw at one operating point, or at an array of them.

    ``screw_torque``, ``nut_torque`` and ``contributions`` are magnitudes: friction opposes the motion. ``ideal_torque``
    and ``drive_torque`` have the sign of the torque on the shaft, positive where it turns the screw forwards.
    The equilibrium of the balls is in hand when the result is made; everything else is computed when it is
    asked for, and kept.
    """

    #: The parts of the input, by section.
    parts: Mapping[str, Any]
    #: The screw with its nut.
    ball_screw: BallScrew
    #: The frame in which the balls roll.
    frame: Frame
    axial_load: Annotated[Force, Info("F", "axial load on the nut")]
    screw_speed: Annotated[AngularSpeed, Info(r"\omega", "speed of the screw", "rpm")]
    #: The balls of each kind; of a preloaded double nut the half that carries the load comes first.
    kinds: tuple[LoadedBalls, ...]
    #: Torque on the screw besides the balls, by name, N m.
    losses: Mapping[str, Torque]
    #: The law of the drive torque without friction.
    ideal_torque_law: IdealTorqueLaw
    #: The loads of all balls; None for a row of equal balls, which needs no solver to know them.
    solved_loads: BallLoads | None = None

    def __repr__(self) -> str:
        """The few numbers one looks for first."""
        shown = {name: getattr(self, name) for name in ("screw_torque", "nut_torque", "efficiency", "valid")}
        return f"FrictionResult({', '.join(f'{name}={value}' for name, value in shown.items())})"

    # -- torques ----------------------------------------------------------------------------------

    @lazy
    def screw_torque(
        self,
    ) -> Annotated[Torque, Info("M_S", "friction torque on the screw", address="Olaru2005 §6 (33)")]:
        """Friction torque on the screw, its magnitude."""
        balls = [kind.sum_of(lambda ball: ball.screw_torque) for kind in self.kinds]
        return _sum([*balls, *self.losses.values()])

    @lazy
    def nut_torque(self) -> Annotated[Torque, Info("M_N", "friction torque on the nut", address="Olaru2005 §6 (34)")]:
        """Friction torque on the nut, the reaction and not a further loss."""
        balls = [kind.sum_of(lambda ball: ball.nut_torque) for kind in self.kinds]
        return _sum([*balls, *self.losses.values()])

    @lazy
    def flooded_torque(
        self,
    ) -> Annotated[Torque, Info("M_{S,f}", "friction torque on the screw in a full bath of oil")]:
        """The same in a full bath of oil, which is always back in the track in time.

        Equal to ``screw_torque`` where the model has no law of the inlet that starves.
        """
        return self.in_full_bath.screw_torque

    @property
    def in_full_bath(self) -> FrictionResult:
        """The result in a full bath of oil, under the same loads of the balls; itself where no oil can be late."""
        model = self.parts["model"]
        full = model.in_full_bath
        if full is model:
            return self
        with np.errstate(all="ignore"):
            return full.under(self.solved_loads, self.ball_screw, self.parts["lubricant"], self.parts["operation"])

    @lazy
    def ideal_torque(
        self,
    ) -> Annotated[Torque, Info("M_Sa", "drive torque without friction", address="Olaru2005 §7 (35)")]:
        """Drive torque without friction, with the sign of the load."""
        return self.ideal_torque_law(self.axial_load, self.ball_screw, self.frame)

    @lazy
    def drive_torque(self) -> Annotated[Torque, Info("M_Sa + M_S", "torque on the shaft, with friction")]:
        r"""Torque on the shaft in motion, :math:`M_{Sa}(F) + \operatorname{sign}(\omega) M_S`.

        At rest friction holds up to ``screw_torque`` either way, and the torque is the ideal one:
        see :attr:`holding_torque`.
        """
        return self.ideal_torque + directions.direction_of(self.screw_speed) * self.screw_torque

    @lazy
    def holding_torque(
        self,
    ) -> Annotated[Torque, Info("M_h", "torque that holds the load when it drives; negative: that lowers it")]:
        """Torque on the shaft when the load drives the screw: held where positive, self-locking where not.

        For a load below zero all signs are reversed.
        """
        return directions.holding_torque(self.ideal_torque, self.screw_torque)

    @lazy
    def self_locking(self) -> Annotated[Mask, Info("self-locking", "the load alone cannot turn the screw")]:
        """True where there is a load that cannot drive the screw back at this speed, that is with this friction."""
        return directions.locks_itself(self.ideal_torque, self.screw_torque)

    @lazy
    def _direct_efficiency(self) -> Ratio:
        """Efficiency if the screw drove the load at this speed; NaN without a load."""
        return directions.direct_efficiency(self.ideal_torque, self.screw_torque)

    @lazy
    def efficiency(
        self,
    ) -> Annotated[Ratio, Info(r"\eta", "efficiency, screw drives the nut", address="Olaru2005 §7 (36)")]:
        """Efficiency where the screw drives the nut against its load, at rest its limit.

        NaN where it drives no load: without one, and where the load has the sign of the motion.
        """
        return directions.efficiency(self.ideal_torque, self.screw_torque, directions.direction_of(self.screw_speed))

    @lazy
    def back_driving_efficiency(self) -> Annotated[Ratio, Info(r"\eta_b", "efficiency, the load drives the screw")]:
        """Efficiency if the load drives the screw; zero or less means self-locking. NaN without a load."""
        return transmission.back_driving_efficiency(self._direct_efficiency)

    def shaft_torque(self, load_sign: int, speed_sign: int) -> Torque:
        """Torque on the shaft in one of four quadrants, N m, positive the way that moves the nut against a load of +1.

        ``load_sign`` is the direction of the load on the nut, ``speed_sign`` that of the rotation;
        with equal signs the screw drives the nut against its load, with opposite signs the load
        helps. Friction opposes the rotation. It is the same in all four, except in a nut whose balls differ,
        which carries a load of the other sign on other balls.
        """
        return load_sign * abs(self.ideal_torque) + speed_sign * self._of_load(load_sign, "screw_torque")

    @lazy
    def _reversed(self) -> FrictionResult:
        """The same under the opposite load."""
        model = self.parts["model"]
        return model(
            self.ball_screw, self.parts["lubricant"], axial_load=-self.axial_load, screw_speed=self.screw_speed
        )

    def _of_load(self, load_sign: int, name: str) -> Any:
        """A number of this result where the load has that sign or is none, elsewhere of the one under that load."""
        here = getattr(self, name)
        same = load_sign * self.axial_load >= 0
        if not self.ball_screw.nut.one_by_one or np.all(same):
            return here
        return where(same, here, getattr(self._reversed, name))

    @lazy
    def quadrants(self) -> Mapping[str, Quadrant]:
        """All four quadrants of load and rotation, by name: shaft torque, its power, and the efficiency.

        The efficiency is that of the power that arrives: from the shaft where the screw drives,
        from the load where the load does. Where the load should drive and the screw locks itself,
        it is zero or less, and the shaft has to push too.
        """
        return {
            name: Quadrant(
                load,
                speed,
                self.shaft_torque(load, speed),
                self.shaft_torque(load, speed) * speed * abs(self.screw_speed),
                self._of_load(load, "_direct_efficiency" if load == speed else "back_driving_efficiency"),
            )
            for name, (load, speed) in QUADRANTS.items()
        }

    @property
    def friction_effort(self) -> Torque:
        """Generalised friction force of the element, N m: ``screw_torque``."""
        return self.screw_torque

    # -- parts and power --------------------------------------------------------------------------

    @lazy
    def contributions(self) -> Mapping[str, Torque]:
        """Friction torque on the screw by mechanism, N m, then by loss; the parts sum to ``screw_torque``."""
        balls = {
            mechanism: _sum([kind.sum_of(lambda ball, m=mechanism: ball.contributions[m]) for kind in self.kinds])
            for mechanism in MECHANISMS
        }
        return {**balls, **self.losses}

    @lazy
    def dissipation(self) -> Mapping[str, Power]:
        """Power dissipated by mechanism, W, from local forces and local speeds, then by loss."""
        balls = {
            mechanism: _sum([kind.sum_of(lambda ball, m=mechanism: ball.dissipation[m]) for kind in self.kinds])
            for mechanism in MECHANISMS
        }
        return {**balls, **{name: torque * abs(self.screw_speed) for name, torque in self.losses.items()}}

    @lazy
    def friction_power(self) -> Annotated[Power, Info("P", "power dissipated by friction")]:
        """Power dissipated by friction, summed from the local dissipations and not from the torque."""
        return sum(self.dissipation.values())

    @lazy
    def power_imbalance(self) -> Ratio:
        """Power of the torque beyond what the parts dissipate, as a share of the latter; zero in equilibrium.

        NaN at rest. The printed reactions of Olaru2005 leave a part of the sliding forces out.
        """
        taken, lost = self.screw_torque * abs(self.screw_speed), self.friction_power
        return (taken - lost) / lost

    # -- balls and contacts -----------------------------------------------------------------------

    @lazy
    def loads(self) -> BallLoads:
        """Loads and contact angles of the balls, the deflection and the rigidity of the nut.

        Of a row of equal balls those of Hertz springs, whose contact angle follows the load.
        """
        if self.solved_loads is None:
            return loaded_balls.loads_of(self.ball_screw, self.axial_load)
        return self.solved_loads

    @property
    def pairs(self) -> tuple[LoadedPair, ...]:
        """The flank pairs that balls touch, with their contacts: of each kind of balls one pair, or two."""
        return tuple(pair for kind in self.kinds for pair in kind.pairs)

    @lazy
    def screw(self) -> RaceState:
        """The contact with the screw of the most loaded ball; on four contacts without the forces of its balance."""
        return self.kinds[0].most_loaded(self.kinds[0].friction.screw)

    @lazy
    def nut(self) -> RaceState:
        """The contact with the nut of the most loaded ball; on four contacts without the forces of its balance."""
        return self.kinds[0].most_loaded(self.kinds[0].friction.nut)

    @lazy
    def _ball(self) -> Any:
        """Friction of the most loaded ball."""
        return self.kinds[0].most_loaded(self.kinds[0].friction)

    @lazy
    def contact_load(self) -> Annotated[Force, Info("Q", "normal load of each loaded ball")]:
        """Normal load of each loaded ball; of unequal ones that of the most loaded."""
        return self._ball.contact_load

    @lazy
    def entrainment_speed(self) -> Annotated[Speed, Info("v", "entrainment speed at both contacts")]:
        """Entrainment speed at both contacts."""
        return self._ball.entrainment_speed

    @lazy
    def ball_to_ball_force(self) -> Annotated[Force, Info("F_B", "force between neighbouring balls")]:
        """Force between neighbouring balls; what of it brakes the ball is a matter of the law of the ball chain."""
        return self._ball.ball_to_ball_force

    @lazy
    def net_braking_force(self) -> Annotated[Force, Info("F_net", "net braking force of the neighbours of a ball")]:
        """Net push of the neighbours of a ball against its motion: what screw and nut torque differ by."""
        return self._ball.net_braking_force

    @lazy
    def spin_moment(
        self,
    ) -> Annotated[Torque, Info("M_P", "moment about the contact normals, the same at both contacts", "N mm")]:
        """Moment about the contact normals, the same at both contacts of a ball with two."""
        return self._ball.spin_moment

    @lazy
    def lateral_force(self) -> Annotated[Force, Info("F_L", "friction across the path, the same at both contacts")]:
        """Friction across the path, the same at both contacts of a ball with two."""
        return self._ball.lateral_force

    @lazy
    def rolling_share(
        self,
    ) -> Annotated[
        Ratio, Info(r"\sigma", "share of the resistances to rolling that friction carries; below one the ball skids")
    ]:
        """Share of the resistances to rolling that friction carries; below one the ball skids."""
        return self._ball.rolling_share

    @lazy
    def ball_friction_moment(
        self,
    ) -> Annotated[
        Torque, Info("M_B", "braking moment of the neighbouring balls", "N mm", address="Olaru2005 §2.2 (21)")
    ]:
        """Braking moment of the neighbouring balls of a ball with two contacts."""
        return self._ball.ball_friction_moment

    @property
    def ball_chain(self) -> BallChain:
        """Moment and braking force of the neighbouring balls of a ball with two contacts."""
        friction: Any = self.kinds[0].friction
        return friction.ball_chain

    @property
    def converged(self) -> Mask:
        """Mask: the slip of all balls converged."""
        masks = [kind.friction.converged for kind in self.kinds]
        return masks[0] if len(masks) == 1 else masks[0] & masks[1]

    @lazy
    def largest_contact_load(self) -> Annotated[Force, Info("Q_max", "load of the most loaded contact")]:
        """Load of the most loaded contact."""
        return loaded_balls.largest_contact_load(self.kinds)

    @lazy
    def maximum_pressure(self) -> Annotated[Pressure, Info("p_0", "greatest contact pressure", "GPa")]:
        """Greatest contact pressure of all balls."""
        return loaded_balls.maximum_pressure(self.kinds)

    @lazy
    def minimum_film_parameter(self) -> Annotated[Ratio, Info(r"\lambda", "least film parameter of all contacts")]:
        """Least film parameter of all contacts that carry load."""
        return loaded_balls.minimum_film_parameter(self.kinds)

    # -- validity ---------------------------------------------------------------------------------

    @lazy
    def validity(self) -> Mapping[str, Mask]:
        """Masks of the conditions of the model, by reason; see :data:`ballscrew.physics.friction.validity.REASONS`.

        Of a nut whose balls differ, a condition may fail for contacts that carry a negligible share of the load.
        """
        if self.solved_loads is None:
            ball: Any = self.kinds[0].friction
            return validity_masks(
                self.parts.values(),
                ball.screw,
                ball.nut,
                ball.converged,
                ball.rolling_share,
                ball.slip_is_curvature_alone,
                self.drive_torque,
            )
        result = dict(loaded_balls.holds_for_most(self.kinds))
        # without any load nothing is rolled along, as with one ball
        result["skid"] = result["skid"] & (self.largest_contact_load > 0)
        result["inputs"] = input_mask(self.parts.values(), self.drive_torque)
        result["load_distribution"] = self.solved_loads.converged
        everywhere = result["inputs"] | True
        return {reason: result.get(reason, True) & everywhere for reason in NUT_CONDITIONS}

    @lazy
    def valid(self) -> Annotated[Mask, Info("valid", "all conditions of the model hold")]:
        """Mask: all conditions of the model hold."""
        masks = list(self.validity.values())
        holds = masks[0]
        for mask in masks[1:]:
            holds = holds & mask
        return holds

    @property
    def may_starve(self) -> bool:
        """Oil that comes back too late may take so much of the torque that a full bath has to be asked for, too."""
        model, oil = self.parts["model"], self.parts["lubricant"]
        left = validity.least_replenished(model, self.ball_screw, oil, self.screw_speed)
        return left < validity.NEARLY_ALL

    @property
    def starvation(self) -> list[Record]:
        """The torque where it is starved the most, beside that of a full bath; empty where they hardly differ."""
        if not self.may_starve:
            return []
        result = validity.most_starved(self.screw_torque, self.flooded_torque)
        quantity = quantities_of(FrictionResult)["screw_torque"]
        return [] if result is None else validity.records([validity.BothTorques(quantity, *result)])

    @property
    def warning_records(self) -> list[Record]:
        """Inputs that no ball screw has, an imbalance of power, and the conditions that fail somewhere, as records."""
        contacts = [contact for pair in self.pairs for contact in (pair.screw, pair.nut)]
        unbalanced = imbalance_records(self.power_imbalance, self.nut_torque)
        strange = [*implausible(self.parts), *self.starvation]
        return [*strange, *unbalanced, *warning_records(self.validity, contacts, NUT_CONDITIONS)]

    @property
    def warnings(self) -> list[str]:
        """The :attr:`warning_records` as texts: ``"reason: explanation"``."""
        return [f"{record.name}: {record.text}" for record in self.warning_records]


def _sum(values: list[Any]) -> Any:
    """A sum whose first term is not added to zero, so that one term alone keeps its bits and its type."""
    total = values[0]
    for value in values[1:]:
        total = total + value
    return total
