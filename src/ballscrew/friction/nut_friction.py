"""A friction model on a whole nut: its preload, the load on every ball, and what it loses besides its balls.

The paper sums the torque over the balls, Olaru2005 §6 (33) and (34); here the terms are unequal. Balls of a
single or a double nut have two contacts, each ball its own load and contact angle
(:mod:`ballscrew.solvers.load_distribution`); oversize balls have four
(:mod:`ballscrew.solvers.four_point_slip`).
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, NamedTuple

import numpy as np

from ballscrew._arrays import as_array, lazy
from ballscrew.components.conditions import Motion
from ballscrew.components.contact import Contact
from ballscrew.components.materials import Lubricant
from ballscrew.components.nut import Bodies, Deviations, Nut, OversizeBallNut
from ballscrew.components.nut_losses import ParasiticLaw
from ballscrew.components.screw import BallScrew, Operation
from ballscrew.components.traits import traits_of
from ballscrew.equations import kinematics, transmission
from ballscrew.errors import Fault, accepts_units, raise_if_any
from ballscrew.friction.model import FrictionModel
from ballscrew.friction.plausibility import implausible, named_parts
from ballscrew.friction.result import MECHANISMS
from ballscrew.friction.validity import (
    CONDITIONS,
    Condition,
    contact_masks,
    input_mask,
    warning_records,
)
from ballscrew.overflow import overflow_as_input_error
from ballscrew.quantities import AngularSpeed, Force, Info, Mask, Power, Pressure, Ratio, Torque
from ballscrew.records import Record
from ballscrew.solvers.four_point_slip import FlankPair, FourPointBall, four_point_slip
from ballscrew.solvers.load_distribution import BallLoads, ball_loads

#: Share of the loads of all contacts below which it does not count that a condition fails.
NEGLIGIBLE_SHARE = 0.01
#: The conditions of a ball, and those of a nut.
NUT_CONDITIONS: Mapping[str, Condition] = {
    **CONDITIONS,
    "load_distribution": Condition("load_distribution", "the loads of the balls did not converge"),
}
#: The texts alone, by reason.
NUT_REASONS: Mapping[str, str] = {reason: condition.text for reason, condition in NUT_CONDITIONS.items()}


class LoadedPair(NamedTuple):
    """The contacts on one pair of flanks of all balls, the ball axis last."""

    load: Force
    screw: Contact
    nut: Contact


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class NutFriction:
    """Friction of a ball screw with its nut at one operating point, or at an array of them."""

    #: The parts of the input, by section.
    parts: Mapping[str, Any]
    model: FrictionModel
    ball_screw: BallScrew
    nut: Nut
    axial_load: Annotated[Force, Info("F", "axial load on the nut")]
    screw_speed: Annotated[AngularSpeed, Info(r"\omega", "speed of the screw", "rpm")]
    loads: BallLoads
    pairs: tuple[LoadedPair, ...]
    #: Torque on the screw by mechanism: those of the balls, then those of the nut, N m. They sum to ``screw_torque``.
    contributions: Mapping[str, Torque]
    nut_torque: Annotated[Torque, Info("M_N", "friction torque on the nut")]
    validity: Mapping[str, Mask]

    def __repr__(self) -> str:
        """The few numbers one looks for first."""
        shown = {name: getattr(self, name) for name in ("screw_torque", "efficiency", "valid")}
        return f"NutFriction({', '.join(f'{name}={value}' for name, value in shown.items())})"

    @lazy
    def screw_torque(self) -> Annotated[Torque, Info("M_S", "friction torque on the screw")]:
        """Friction torque on the screw."""
        return sum(self.contributions.values())

    @lazy
    def ideal_torque(self) -> Annotated[Torque, Info("M_Sa", "drive torque without friction")]:
        """Drive torque without friction."""
        laws = self.model.laws
        return laws.ideal_torque(self.axial_load, self.ball_screw, laws.frame(self.ball_screw))

    @lazy
    def drive_torque(self) -> Annotated[Torque, Info("M_Sa + M_S", "drive torque with friction")]:
        """Torque that drives the screw against the load."""
        return self.ideal_torque + self.screw_torque

    @lazy
    def efficiency(self) -> Annotated[Ratio, Info(r"\eta", "efficiency, screw drives the nut")]:
        """Efficiency when the screw drives the nut. Zero without load."""
        drive = self.drive_torque
        # without any torque the divisor is 1; NaN stays NaN
        return transmission.efficiency(self.ideal_torque, np.where(drive == 0, 1.0, drive) - self.ideal_torque)

    @lazy
    def back_driving_efficiency(self) -> Annotated[Ratio, Info(r"\eta_b", "efficiency, the load drives the screw")]:
        """Efficiency when the load drives the screw; zero or less means self-locking. NaN without load."""
        eta = self.efficiency
        none = eta == 0
        return np.where(none, np.nan, transmission.back_driving_efficiency(np.where(none, 1.0, eta)))[()]

    @lazy
    def holding_torque(
        self,
    ) -> Annotated[Torque, Info("M_h", "torque that holds the load when it drives; negative: that lowers it")]:
        """Torque on the shaft when the load drives the screw: held where positive, self-locking where not."""
        return transmission.holding_torque(self.ideal_torque, self.screw_torque)

    @lazy
    def self_locking(self) -> Annotated[Mask, Info("self-locking", "the load alone cannot turn the screw")]:
        """True where there is a load that cannot drive the screw back at this speed, that is with this friction."""
        return (self.ideal_torque > 0) & (self.holding_torque <= 0)

    @lazy
    def friction_power(self) -> Annotated[Power, Info("P", "power dissipated by friction")]:
        """Power dissipated by friction."""
        return self.screw_torque * self.screw_speed

    @lazy
    def largest_contact_load(self) -> Annotated[Force, Info("Q_max", "load of the most loaded contact")]:
        """Load of the most loaded contact."""
        return np.max([np.max(pair.load, axis=-1) for pair in self.pairs], axis=0)

    @lazy
    def maximum_pressure(self) -> Annotated[Pressure, Info("p_0", "greatest contact pressure", "GPa")]:
        """Greatest contact pressure of all balls."""
        contacts = [contact for pair in self.pairs for contact in (pair.screw, pair.nut)]
        return np.max([np.max(contact.maximum_pressure, axis=-1) for contact in contacts], axis=0)

    @lazy
    def minimum_film_parameter(self) -> Annotated[Ratio, Info(r"\lambda", "least film parameter of all contacts")]:
        """Least film parameter of all contacts that carry load."""
        contacts = [(pair.load, contact) for pair in self.pairs for contact in (pair.screw, pair.nut)]
        found = [np.min(np.where(load > 0, contact.film_parameter, np.inf), axis=-1) for load, contact in contacts]
        return np.min(found, axis=0)

    @lazy
    def valid(self) -> Annotated[Mask, Info("valid", "all conditions of the model hold")]:
        """Mask: all conditions of the model hold."""
        return np.all(np.stack(np.broadcast_arrays(*self.validity.values())), axis=0)

    @property
    def warning_records(self) -> list[Record]:
        """Inputs that no ball screw has, and the conditions that fail somewhere, as records."""
        contacts = [contact for pair in self.pairs for contact in (pair.screw, pair.nut)]
        return [*implausible(self.parts), *warning_records(self.validity, contacts, NUT_CONDITIONS)]

    @property
    def warnings(self) -> list[str]:
        """The :attr:`warning_records` as texts: ``"reason: explanation"``."""
        return [f"{record.name}: {record.text}" for record in self.warning_records]


@accepts_units("operation")
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
) -> NutFriction:
    """Friction of a screw with its nut at an axial load (N) and a screw speed (rad/s); arrays broadcast.

    The loaded balls of the screw are those of one nut body or half. ``bodies`` and ``deviations`` make balls of a kind
    unequal; ``losses`` are further laws by name, such as ``{"seals": Seals(seal_torque=0.2)}``.
    Raises :class:`~ballscrew.errors.InputError` for numbers out of bounds, and for a model that knows no four
    contacts where the nut has them.
    """
    operation = Operation(axial_load=as_array(axial_load), screw_speed=as_array(screw_speed))
    four = isinstance(nut, OversizeBallNut)
    if four and 4 not in traits_of(model.slip).contacts_per_ball:
        remedy = 'take the model reference, or slip = "ellipse"'
        raise_if_any(
            [Fault("model.slip", "knows no balls with four contacts, as an oversize-ball nut has", "", remedy)]
        )
    loads = ball_loads(screw, nut, operation.axial_load, bodies=bodies, deviations=deviations)
    model = dataclasses.replace(model, ball_to_ball_force=model.imposed_ball_force(screw))
    ball = _Ball(
        model=_per_ball(model),
        screw=dataclasses.replace(_per_ball(screw), loaded_balls=1),
        lubricant=_per_ball(lubricant),
        screw_speed=_per_ball(operation.screw_speed),
    )
    with overflow_as_input_error(), np.errstate(all="ignore"):
        balls = _on_four_contacts(ball, loads) if four else _on_two_contacts(ball, loads)
        all_balls = dataclasses.replace(screw, loaded_balls=np.sum(loads.balls, axis=-1)[()])
        further = {name: law(all_balls, lubricant, operation.screw_speed) for name, law in (losses or {}).items()}
    contributions = {
        **{name: np.sum(loads.balls * balls.contributions[name], axis=-1) for name in MECHANISMS},
        **further,
    }
    # without any load nothing is rolled along, as with one ball
    loaded = np.any(loads.forward_load + loads.backward_load > 0, axis=-1)
    of_losses = {f"losses.{name}": law for name, law in (losses or {}).items()}
    parts = named_parts(model, screw, lubricant, operation=operation, nut=nut, bodies=bodies, **of_losses)
    return NutFriction(
        parts=parts,
        model=model,
        ball_screw=screw,
        nut=nut,
        axial_load=operation.axial_load,
        screw_speed=operation.screw_speed,
        loads=loads,
        pairs=balls.pairs,
        contributions=contributions,
        nut_torque=np.sum(loads.balls * balls.nut_torque, axis=-1) + sum(further.values()),
        validity={
            **{reason: _holds_for_most(condition, loads.balls) for reason, condition in balls.validity.items()},
            "skid": _holds_for_most(balls.validity["skid"], loads.balls) & loaded,
            "inputs": input_mask(parts.values(), sum(contributions.values())),
            "load_distribution": loads.converged,
        },
    )


class _Ball(NamedTuple):
    """Input of the model for each ball; arrays have a last axis for the balls."""

    model: FrictionModel
    screw: BallScrew
    lubricant: Lubricant
    screw_speed: AngularSpeed


class _Condition(NamedTuple):
    """Mask of a condition for each ball, with the load of the contact it belongs to."""

    holds: Mask
    load: Force


class _Balls(NamedTuple):
    """Result of the model for each ball."""

    contributions: Mapping[str, Torque]
    nut_torque: Torque
    pairs: tuple[LoadedPair, ...]
    validity: Mapping[str, Sequence[_Condition]]


def _holds_for_most(conditions: Sequence[_Condition], balls: Any) -> Mask:
    """True where the contacts for which a condition fails carry a negligible share of the load.

    A half that is about to lift off, or balls that hardly touch, say nothing about the torque.
    """
    failing = sum(np.sum(np.where(each.holds, 0.0, balls * each.load), axis=-1) for each in conditions)
    load = sum(np.sum(balls * each.load, axis=-1) for each in conditions)
    return failing <= NEGLIGIBLE_SHARE * load


def _given_load(axial_load: Force, *_: Any) -> Force:
    """The load of a ball where it is known: it is what the model is called with."""
    return axial_load


def _on_two_contacts(ball: _Ball, loads: BallLoads) -> _Balls:
    """Balls that touch one flank pair each, this or that."""
    load = loads.forward_load + loads.backward_load
    angle = np.where(loads.forward_load > 0, loads.forward_angle, loads.backward_angle)
    angle = np.where(load > 0, angle, ball.screw.contact_angle)
    screw = dataclasses.replace(ball.screw, contact_angle=angle)
    one = dataclasses.replace(ball.model, contact_load=_given_load)
    result = one(screw, ball.lubricant, axial_load=load, screw_speed=ball.screw_speed)
    pair = LoadedPair(load, result.screw, result.nut)
    validity = {reason: [_Condition(mask, load)] for reason, mask in result.validity.items()}
    return _Balls(result.contributions, result.nut_torque, (pair,), validity)


def _on_four_contacts(ball: _Ball, loads: BallLoads) -> _Balls:
    """Balls that touch both flanks; where a flank is relieved of its load, it takes no part."""
    model, screw, omega = ball.model, ball.screw, ball.screw_speed
    sides = ((loads.forward_load, loads.forward_angle), (loads.backward_load, loads.backward_angle))
    pairs: list[LoadedPair] = []
    validity: dict[str, list[_Condition]] = {}
    both = loads.forward_load + loads.backward_load
    for load, angle in sides:
        at_angle = dataclasses.replace(screw, contact_angle=np.where(load > 0, angle, screw.contact_angle))
        frame = model.laws.frame(at_angle)
        lateral = kinematics.torsion_speed(omega, screw.ball_diameter, frame.lead_angle) / 2
        v = frame.entrainment_speed(omega)
        # between equally loaded flanks the ball turns about the binormal; what of its rotation does not roll spins, at
        # the screw more than at the nut. The more one pair carries, the nearer its contacts are to those of a ball that
        # touches no other, which halves the relative spin between screw and nut.
        spin = kinematics.relative_spin(omega, frame.rolling_plane_sine)
        about_binormal = kinematics.ball_rotation(v, screw.ball_diameter) * np.tan(at_angle.contact_angle)
        leaning = np.where(both > 0, np.maximum(2 * load - both, 0.0) / np.where(both > 0, both, 1.0), 0.0)
        at_nut = (1 - leaning) * about_binormal - leaning * spin / 2
        motions = (Motion(v, at_nut + spin, lateral), Motion(v, np.abs(at_nut), lateral))
        contacts = model.contacts(at_angle, ball.lubricant, frame, load, motions)
        pairs.append(LoadedPair(load, *contacts))
        for contact in contacts:
            for reason, mask in contact_masks(contact).items():
                validity.setdefault(reason, []).append(_Condition(mask, load))
    frame = model.laws.frame(screw)
    F_B = model.laws.ball_force(model.imposed_ball_force(screw), loads.forward_load + loads.backward_load)
    moment = model.laws.ball_chain(model.ball_friction_coefficient, F_B, screw.ball_diameter, frame).moment
    forward, backward = (
        FlankPair(pair.screw, pair.nut, np.where(pair.load > 0, angle, screw.contact_angle))
        for pair, (_, angle) in zip(pairs, sides, strict=True)
    )
    slip = four_point_slip(
        FourPointBall(forward, backward, moment, F_B, screw.ball_diameter, frame.lead_angle, frame.path_radius)
    )
    contributions, nut_torque, skids, settled = (
        slip.contributions,
        slip.nut_torque,
        slip.rolling_share != 1,
        slip.converged,
    )
    lifted = (loads.forward_load == 0) | (loads.backward_load == 0)
    if np.any(lifted):  # a ball that has left one flank pair has two contacts
        two = _on_two_contacts(ball, loads)
        contributions = {name: np.where(lifted, two.contributions[name], part) for name, part in contributions.items()}
        nut_torque = np.where(lifted, two.nut_torque, nut_torque)
        skids = np.where(lifted, ~two.validity["skid"][0].holds, skids)
        settled = np.where(lifted, two.validity["equilibrium"][0].holds, settled)
    validity["skid"] = [_Condition(~skids, both)]
    validity["equilibrium"] = [_Condition(settled, both)]
    # (15) has no part in the slip of four contacts
    validity["pure_rolling_offset"] = [_Condition(np.full(np.shape(both), True), both)]
    return _Balls(contributions, nut_torque, tuple(pairs), validity)


def _per_ball(part: Any) -> Any:
    """A part with a last axis for the balls wherever it has arrays."""
    if isinstance(part, np.ndarray):
        return _last_axis(part)
    if not dataclasses.is_dataclass(part) or isinstance(part, type):
        return part
    values = {field.name: getattr(part, field.name) for field in dataclasses.fields(part)}
    changed = {name: new for name, value in values.items() if (new := _per_ball(value)) is not value}
    return dataclasses.replace(part, **changed) if changed else part


def _last_axis(value: Any) -> Any:
    return value[..., None] if np.ndim(value) else value
