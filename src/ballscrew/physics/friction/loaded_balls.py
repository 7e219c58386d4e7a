"""The loaded balls of a nut: each kind of them with its loads, its friction, and how many they are.

The paper sums the torque over equal balls, Olaru2005 §6 (33) and (34); here the terms may differ. Balls of a single or
a double nut have two contacts, each its own load and contact angle
(:mod:`ballscrew.physics.solvers.load_distribution`); oversize balls have four
(:mod:`ballscrew.physics.friction.four_contact_balls`).
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.basis.arrays import namespace, where
from ballscrew.basis.errors import Fault, InputError, is_concrete
from ballscrew.basis.quantities import Angle, Count, Force, Mask, Pressure, Ratio
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.operating_state import OperatingState, settled
from ballscrew.physics.components.screw import SINGLE_NUT, BallScrew
from ballscrew.physics.equations import geometry
from ballscrew.physics.friction.balls import (
    BallFriction,
    BallModel,
    IdleBallFriction,
    ball_friction,
    idle_ball_friction,
)
from ballscrew.physics.friction.four_contact_balls import (
    FourContactFriction,
    four_contact_friction,
    two_contact_friction,
)
from ballscrew.physics.friction.validity import contact_masks, no_skid, slip_masks
from ballscrew.physics.laws.contact import Contact
from ballscrew.physics.solvers.load_distribution import BallLoads, KindLoads, ball_loads, ball_loads_of_each

#: A load at which the friction of lifted balls is computed, N, to have a derivative; its value is not used.
ANY_LOAD = 1.0
#: Share of the loads of all contacts below which it does not count that a condition fails.
NEGLIGIBLE_SHARE = 0.01


class LoadedPair(NamedTuple):
    """The contacts on one pair of flanks of the balls of one kind."""

    load: Force
    angle: Angle
    screw: Contact
    nut: Contact


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class LoadedBalls:
    """The balls of one kind: all alike, or each by itself along a last axis."""

    #: How many balls there are of the kind; one by one, how many each entry stands for.
    balls: Count
    one_by_one: bool
    contact_angle: Angle
    friction: BallFriction | FourContactFriction
    #: The load of balls on two contacts.
    given_load: Force | None = None
    #: Friction where a load lifts all balls of the kind off; None for balls that it does not.
    idle: IdleBallFriction | None = None

    def total(self, of_a_ball: Any) -> Any:
        """The sum over the balls of something that each has."""
        each = self.balls * of_a_ball
        return np.sum(each, axis=-1) if self.one_by_one else each

    def sum_of(self, read: Callable[[Any], Any]) -> Any:
        """The sum over the balls of a torque or a power that is read off their friction."""
        result = read(self.friction)
        return self.total(result if self.idle is None else where(self.load == 0, read(self.idle), result))

    @property
    def pairs(self) -> tuple[LoadedPair, ...]:
        """The flank pairs that the balls touch, the one that carries the load first."""
        friction = self.friction
        if isinstance(friction, FourContactFriction):
            return tuple(LoadedPair(*pair) for pair in friction.flanks)
        load = friction.contact_load if self.given_load is None else self.given_load
        return (LoadedPair(load, self.contact_angle, friction.screw, friction.nut),)

    def largest(self, values: Any) -> Any:
        """The greatest of what each ball has."""
        return np.max(values, axis=-1) if self.one_by_one else values

    def most_loaded(self, part: Any) -> Any:
        """A part of the friction as it is for the most loaded ball."""
        return _OfABall(part, np.argmax(self.load, axis=-1)) if self.one_by_one else part

    @property
    def load(self) -> Force:
        """Load of each ball on all its flanks."""
        return sum(pair.load for pair in self.pairs)

    @property
    def contact_conditions(self) -> Mapping[str, Sequence[tuple[Mask, Force]]]:
        """The conditions of the model by reason: whether each holds at each ball, and the load it concerns."""
        result: dict[str, list[tuple[Mask, Force]]] = {}
        load, friction = self.load, self.friction
        for pair in self.pairs:
            for contact in (pair.screw, pair.nut):
                for reason, mask in contact_masks(contact).items():
                    result.setdefault(reason, []).append((mask, pair.load))
        if isinstance(friction, FourContactFriction):
            result["skid"] = [(~friction.skids, load)]
        else:
            result["skid"] = [(no_skid(friction.screw) & no_skid(friction.nut) & (friction.rolling_share == 1), load)]
            if friction.slip_is_curvature_alone:  # (15) has no part in the slip of four contacts, or over an ellipse
                result["pure_rolling_offset"] = [
                    (slip_masks(friction.screw)["pure_rolling_offset"], load),
                    (slip_masks(friction.nut)["pure_rolling_offset"], load),
                ]
        result["equilibrium"] = [(friction.converged, load)]
        return result


class _OfABall:
    """The attributes of a part of the friction as one ball of each operating point has them."""

    def __init__(self, part: Any, ball: Any) -> None:
        self._part, self._place = part, ball

    def __getattr__(self, name: str) -> Any:
        values = getattr(self._part, name)
        if not isinstance(self._place, np.ndarray | np.integer):  # on a tape
            return np.take_along_axis(values, self._place, axis=-1)
        if np.ndim(values) == 0:
            return values
        along = np.broadcast_to(values, (*np.shape(self._place), np.shape(values)[-1]))
        return np.take_along_axis(along, np.asarray(self._place)[..., None], axis=-1)[..., 0][()]


def loads_of(screw: BallScrew, axial_load: Force, *, compiled: bool = False) -> BallLoads:
    """The loads of the balls of a screw with its nut. Raises :class:`~ballscrew.basis.errors.InputError` as the
    solver.
    """
    nut = screw.nut
    bodies = None if nut.bodies is None else nut.bodies.sized(screw)
    angles = ball_angles(screw) if np.any(getattr(nut.deviations, "groove", 0.0)) else None
    deviations = nut.deviations_of(screw.carrying_balls, angles)
    return ball_loads(screw, nut, settled(axial_load), bodies=bodies, deviations=deviations, compiled=compiled)


def loads_of_each(screws: Sequence[BallScrew], axial_loads: Sequence[Force]) -> list[BallLoads | InputError]:
    """The loads of the balls of each of many screws, or why one has none; those between elastic bodies together."""
    alike = [screw.nut.bodies is not None and screw.nut.deviations is None for screw in screws]
    elastic = [(screw, settled(load)) for screw, load, one in zip(screws, axial_loads, alike, strict=True) if one]
    together = iter(ball_loads_of_each(*zip(*elastic, strict=True)) if elastic else ())

    def alone(screw: BallScrew, load: Force) -> BallLoads | InputError:
        try:
            return loads_of(screw, load)
        except InputError as error:
            return error

    return [next(together) if one else alone(*of) for *of, one in zip(screws, axial_loads, alike, strict=True)]


def ball_angles(screw: BallScrew) -> Angle:
    """Angles of the balls that carry along the helix, rad: one half after the other, a turn for each lead between them.

    Raises :class:`~ballscrew.basis.errors.InputError` for several screws at once, as an array of ball diameters is.
    """
    step = geometry.ball_pitch_angle(screw.ball_diameter, screw.pitch_circle_diameter, screw.lead_angle)
    between = 2 * np.pi * getattr(screw.nut, "spacing", 0.0) / screw.lead if np.any(screw.lead) else 0.0
    numbers = (screw.carrying_balls, screw.starts, step, between)
    if not all(map(is_concrete, numbers)):
        remedy = "solve screws of different sizes one after the other, or leave deviations.groove out"
        raise InputError(Fault("deviations.groove", "must be of one screw", "an array of screws", remedy))
    balls, starts = int(screw.carrying_balls), int(screw.starts)
    of_half = np.arange(balls)
    step *= 2 if screw.nut.spacer_balls else 1
    along = of_half // starts * step + of_half % starts * (2 * np.pi / starts)
    return np.concatenate([along + half * (along[-1] + between) for half in range(screw.nut.halves)])


def row_of_balls(model: BallModel, screw: BallScrew, lubricant: Lubricant, state: OperatingState) -> LoadedBalls:
    """The balls of a nut without preload, rigid: all alike, at the nominal contact angle, Olaru2005 §2."""
    frame = model.laws.frame(screw)
    Q = model.laws.contact_load(abs(state.axial_load), screw.carrying_balls, screw.contact_angle, frame.lead_angle)
    friction = ball_friction(model, screw, lubricant, frame, Q, abs(state.screw_speed), model.imposed_ball_force(screw))
    return LoadedBalls(
        balls=screw.carrying_balls, one_by_one=False, contact_angle=screw.contact_angle, friction=friction
    )


def balls_under(
    model: BallModel, screw: BallScrew, lubricant: Lubricant, state: OperatingState, loads: BallLoads
) -> tuple[LoadedBalls, ...]:
    """The balls of a nut under loads that are known; of a braced nut the half that carries the load comes first."""
    kinds, imposed, omega = loads.kinds, model.imposed_ball_force(screw), abs(state.screw_speed)
    four = screw.nut.contacts_per_ball == 4
    # a symmetric nut is the same for loads of either sign: what carries takes the place of what is relieved
    reversed_load = state.axial_load < 0
    alone = dataclasses.replace(screw, nut=SINGLE_NUT)
    part = alone
    if loads.one_by_one:
        # each array gets a last axis for the balls
        model, part, lubricant = (_with_ball_axis(each) for each in (model, alone, lubricant))
        omega, imposed, reversed_load = (_last_axis(each) for each in (omega, imposed, reversed_load))
    if four:
        values = [_on_four_contacts(model, part, lubricant, omega, imposed, kind, reversed_load) for kind in kinds]
    else:
        touched = [_touched(kind, part.contact_angle) for kind in kinds]
        if len(touched) == 2:
            touched = [
                tuple(where(reversed_load, b, a) for a, b in zip(one, other, strict=True))
                for one, other in (touched, touched[::-1])
            ]
        return _on_two_contacts(model, part, lubricant, omega, imposed, loads, touched)
    return tuple(
        LoadedBalls(balls=kind.balls, one_by_one=loads.one_by_one, contact_angle=angle, friction=friction)
        for kind, (angle, friction) in zip(kinds, values, strict=True)
    )


def _on_two_contacts(
    model: BallModel,
    screw: BallScrew,
    lubricant: Lubricant,
    speed: Any,
    imposed_ball_force: Force,
    loads: BallLoads,
    touched: Sequence[tuple[Force, Angle]],
) -> tuple[LoadedBalls, ...]:
    """Kinds of balls with these loads and angles; a second kind may be lifted off."""
    loaded_balls: list[LoadedBalls] = []
    for place, (load, angle) in enumerate(touched):
        idle, computed = None, load
        if place == 1:
            idle = idle_ball_friction(model, screw, model.laws.frame(screw), speed, imposed_ball_force)
            computed = where(load == 0, ANY_LOAD, load)
        friction = two_contact_friction(model, screw, lubricant, computed, angle, speed, imposed_ball_force)
        loaded_balls.append(
            LoadedBalls(
                balls=loads.kinds[place].balls,
                one_by_one=loads.one_by_one,
                contact_angle=angle,
                friction=friction,
                given_load=load,
                idle=idle,
            )
        )
    return tuple(loaded_balls)


def _touched(kind: KindLoads, nominal_angle: Angle) -> tuple[Force, Angle]:
    """Load and angle of the one flank pair that the balls of a kind touch."""
    load = kind.forward_load + kind.backward_load
    angle = where(kind.forward_load > 0, kind.forward_angle, kind.backward_angle)
    return load, where(load > 0, angle, nominal_angle)


def _on_four_contacts(
    model: BallModel,
    screw: BallScrew,
    lubricant: Lubricant,
    speed: Any,
    imposed_ball_force: Force,
    kind: KindLoads,
    reversed_load: Mask,
) -> tuple[Angle, FourContactFriction]:
    forward, backward = (kind.forward_load, kind.forward_angle), (kind.backward_load, kind.backward_angle)
    carrying, relieved = (
        (where(reversed_load, there[0], here[0]), where(reversed_load, there[1], here[1]))
        for here, there in ((forward, backward), (backward, forward))
    )
    friction = four_contact_friction(model, screw, lubricant, (carrying, relieved), speed, imposed_ball_force)
    return friction.flanks[0].angle, friction


def holds_for_most(kinds: Sequence[LoadedBalls]) -> Mapping[str, Mask]:
    """Conditions by reason: true where the contacts for which one fails carry a negligible share of the load.

    A half that is about to lift off, or balls that hardly touch, say nothing about the torque.
    """
    masks: dict[str, Mask] = {}
    conditions = [(kind, kind.contact_conditions) for kind in kinds]
    for reason in conditions[0][1]:
        failing, load = 0.0, 0.0
        for kind, of_kind in conditions:
            for holds, carried in of_kind[reason]:
                each = carried + 0 * kind.load
                failing = failing + kind.total(where(holds, 0.0, each))
                load = load + kind.total(each)
        masks[reason] = failing <= NEGLIGIBLE_SHARE * load
    return masks


def largest_contact_load(kinds: Sequence[LoadedBalls]) -> Force:
    """Load of the most loaded contact."""
    return _extreme([kind.largest(pair.load) for kind in kinds for pair in kind.pairs])


def maximum_pressure(kinds: Sequence[LoadedBalls]) -> Pressure:
    """Greatest contact pressure of all balls."""
    sides = [(kind, contact) for kind in kinds for pair in kind.pairs for contact in (pair.screw, pair.nut)]
    return _extreme([kind.largest(contact.maximum_pressure) for kind, contact in sides])


def minimum_film_parameter(kinds: Sequence[LoadedBalls]) -> Ratio:
    """Least film parameter of all contacts that carry load."""
    values: list[Any] = []
    for kind in kinds:
        for pair in kind.pairs:
            for contact in (pair.screw, pair.nut):
                values.append(-kind.largest(where(pair.load == 0, -float("inf"), -contact.film_parameter)))
    return -_extreme([-each for each in values])


def _extreme(values: Sequence[Any]) -> Any:
    greatest = values[0]
    for value in values[1:]:
        greatest = namespace(greatest, value).maximum(greatest, value)
    return greatest


def _with_ball_axis(part: Any) -> Any:
    """A part with a last axis for the balls wherever it has arrays."""
    if isinstance(part, np.ndarray):
        return _last_axis(part)
    if not dataclasses.is_dataclass(part) or isinstance(part, type):
        return part
    values = {field.name: getattr(part, field.name) for field in dataclasses.fields(part)}
    changed = {name: new for name, value in values.items() if (new := _with_ball_axis(value)) is not value}
    return dataclasses.replace(part, **changed) if changed else part


def _last_axis(value: Any) -> Any:
    return value[..., None] if isinstance(value, np.ndarray) and value.ndim else value
