"""The friction torque of a nut over the angle of its screw, and its orders.

Each circuit of each half is a chain in motion (:mod:`~ballscrew.physics.moving_balls.chain`) with grooves of its own.
At each moment a ball has the friction torque that the model gives a ball of its load, and adds what it rubs on the next
one; the last loaded ball pushes the return. Halves and circuits are added up, at random places of their chains against
each other.

Left out: what the speed of a ball changes in its friction, contacts that get in and out of a defect over their length,
and inertia.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.errors import Fault, accepts_units, is_concrete, raise_if_any
from ballscrew.basis.quantities import Angle, AngularSpeed, Count, Force, Info, Length, Ratio, Torque
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import OversizeBallNut
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import SINGLE_NUT, BallScrew
from ballscrew.physics.equations import ball_chain, nut_losses
from ballscrew.physics.friction.across_groove import in_motion
from ballscrew.physics.friction.loaded_balls import loads_of
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.moving_balls.chain import (
    SETTLING,
    STEP,
    WALL_FACTOR,
    Circuit,
    MovingChain,
    chain_faults,
    chain_run,
    circuit_of,
)
from ballscrew.physics.moving_balls.loaded_zone import Groove, LoadedZone, loaded_zone

Field = NDArray[np.float64]

#: Turns of the screw, and circulations of the balls, that are looked at at least.
TURNS, CIRCULATIONS = 12.0, 2.0
#: Loads of a ball, over the nominal one, at which the model is asked for its friction.
LOADS = np.concatenate([[0.0], np.geomspace(1e-3, 8.0, 40)])
#: Loaded balls of a circuit, at least.
LEAST_BALLS = 3
#: Gap of a circuit that counts as full, in balls.
FULL = 0.003
#: Harmonics of the ball pass that have a name.
HARMONICS = 2


# -- defects --------------------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True)
class MissingBall:
    """One circuit has a ball less than the others."""


@dataclasses.dataclass(frozen=True)
class FullCircuit:
    """All circuits are filled until no ball has room."""


@dataclasses.dataclass(frozen=True)
class Spall:
    """The groove of the nut is deeper over some length in the middle of one circuit; all in m."""

    width: Length
    depth: Length


@dataclasses.dataclass(frozen=True)
class PreloadLeft:
    """A share of the preload is left."""

    share: Ratio


@dataclasses.dataclass(frozen=True)
class NutGroove:
    """The grooves of the nut deviate by a factor more."""

    factor: Ratio


Defect = MissingBall | FullCircuit | Spall | PreloadLeft | NutGroove


@dataclasses.dataclass(frozen=True, eq=False)
class SpalledGroove(Groove):
    """A groove that lies back by a depth, along the line of contact, over a length about an angle of its helix."""

    centre: Angle
    half_width: Angle
    depth: Length
    contact_angle: Angle
    flank: int

    def at(self, angle: Any) -> Field:
        """The deviations along the axis and outwards at angles of the groove, m, the direction first."""
        back = self.depth * (np.abs(np.asarray(angle) - self.centre) <= self.half_width)
        along, outwards = self.flank * math.sin(self.contact_angle), math.cos(self.contact_angle)
        return super().at(angle) - np.stack([along * back, outwards * back])


# -- what comes out -------------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True, eq=False)
class NamedOrder:
    """An order of the torque that has a cause."""

    name: Annotated[str, Info("", "cause of the order")]
    order: Annotated[Ratio, Info("o", "periods for each turn of the screw")]
    amplitude: Annotated[Torque, Info("M_o", "amplitude of the friction torque at the order", "N mm")]


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Ripple:
    """The friction torque of a nut over the angle of its screw, seals and other losses left out."""

    #: Angle of the screw, rad, and friction torque at it, N m; in steps of equal size.
    angle: Field
    torque: Field
    #: Mean torques by cause, N m: of the loaded balls, between balls, and of the return.
    parts: Mapping[str, Torque]
    #: The orders that have a cause.
    orders: Sequence[NamedOrder]
    #: Orders of the spectrum, and amplitudes of the torque at them, N m; by a window of Hann.
    spectrum: tuple[Field, Field]
    displacement: Annotated[
        Length,
        Info("x_pp", "axial displacement at constant load, peak to peak; of braced halves alone", "um"),
    ]
    share: Annotated[Ratio, Info("F_B/Q", "force between balls / load of a ball, mean of the loaded balls")]

    @property
    def mean(self) -> Annotated[Torque, Info("M_m", "mean friction torque of the balls")]:
        """Mean of the torque."""
        return float(np.mean(self.torque))

    @property
    def peak_to_peak(self) -> Annotated[Torque, Info("M_pp", "greatest less least friction torque")]:
        """Range of the torque."""
        return float(np.ptp(self.torque))

    @property
    def deviation(self) -> Annotated[Torque, Info("M_s", "standard deviation of the friction torque")]:
        """Standard deviation of the torque over the angle."""
        return float(np.std(self.torque))

    @property
    def relative(self) -> Annotated[Ratio, Info("M_pp/M_m", "greatest less least friction torque, over the mean")]:
        """Range of the torque over its mean."""
        return self.peak_to_peak / self.mean if self.mean else math.nan


@accepts_units("ripple")
def torque_ripple(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    axial_load: Force,
    screw_speed: AngularSpeed,
    gap: Ratio,
    groove_deviation: Length,
    seed: Count,
    circuits: Count = 1,
    return_balls: Count | None = None,
    wall_factor: Ratio = WALL_FACTOR,
    relief: Ratio = 1.0,
    defect: Defect | None = None,
    step: Ratio = STEP,
    turns: Ratio = TURNS,
) -> Ripple:
    """The friction torque of a nut over the angle of its screw: a :class:`Ripple`.

    ``model`` tells the friction of ``screw`` with ``lubricant`` under ``axial_load`` (N) at ``screw_speed`` (rad/s).
    ``gap``, ``groove_deviation`` (m), ``circuits``, ``return_balls``, ``wall_factor``, ``relief`` and ``step`` are
    those of :func:`~ballscrew.physics.moving_balls.chain.moving_chain`; ``circuits`` are those of one half. One
    ``seed`` gives the same grooves, each circuit its own, with a ``defect`` as without. ``turns`` of the screw are
    looked at, at least.

    Raises :class:`~ballscrew.basis.errors.InputError` as the chain does, for a defect that is impossible, and for a
    share of the preload of a nut that has none.
    """
    numbers = {
        "axial_load": axial_load, "screw_speed": screw_speed, "gap": gap, "groove_deviation": groove_deviation,
        "seed": seed, "circuits": circuits, "wall_factor": wall_factor, "relief": relief, "step": step,
        "circulations": CIRCULATIONS + SETTLING,
    }  # fmt: skip
    raise_if_any([*chain_faults(model, screw, numbers, return_balls), *_faults(screw, defect, seed, turns)])
    raise_if_any(_short(screw, circuits, relief))
    whole = screw
    if isinstance(defect, PreloadLeft):
        whole = dataclasses.replace(screw, nut=screw.nut.changed("preload", defect.share * _preload(screw)))
    if isinstance(defect, FullCircuit):
        gap = FULL
    state = OperatingState(axial_load, screw_speed, None)
    screw, whole = (in_motion(model, each, lubricant, state) for each in (screw, whole))
    result: list[_Circuit] = []
    for half, (carrier, load) in enumerate(_halves(whole, axial_load)):
        for number in range(int(circuits)):
            zone = loaded_zone(
                model,
                carrier,
                lubricant,
                axial_load=load,
                screw_speed=screw_speed,
                groove_deviation=groove_deviation,
                seed=_seed_of(int(seed), half, number),
                circuits=int(circuits),
                relief=relief,
            )
            at_defect = half == number == 0
            if at_defect or isinstance(defect, NutGroove):
                zone = with_defect(zone, defect)
            circuit = circuit_of(model, carrier, lubricant, zone, screw_speed, gap, circuits, return_balls, wall_factor)
            balls = circuit.balls  # what the orders are named by, with a missing ball as without
            if at_defect and isinstance(defect, MissingBall):
                circuit = circuit._replace(balls=balls - 1)
            result.append(_of_circuit(model, carrier, lubricant, circuit, balls, screw_speed, step, turns))
    generator = np.random.default_rng((int(seed), 2))
    return _added(result, whole, axial_load, int(circuits), generator)


def _halves(screw: BallScrew, axial_load: Force) -> list[tuple[BallScrew, Force]]:
    """The halves that carry, each as a screw and a load that gives its balls their load.

    The half that the load relieves is one without load whose preload is what is left.
    """
    halves = [(screw, axial_load)]
    if screw.nut.halves == 2:
        left = float(loads_of(screw, axial_load).remaining_preload)
        if left > 0:
            halves.append((dataclasses.replace(screw, nut=screw.nut.changed("preload", left)), 0.0))
    return halves


def with_defect(zone: LoadedZone, defect: Defect | None) -> LoadedZone:
    """A loaded zone with a defect of its nut groove, if it is one."""
    if isinstance(defect, NutGroove):
        return dataclasses.replace(zone, nut_groove=Groove(defect.factor * zone.nut_groove.harmonics))
    if not isinstance(defect, Spall):
        return zone
    L = float(zone.path_radius)
    spalled = SpalledGroove(
        zone.nut_groove.harmonics,
        centre=zone.length / 2 / L,
        half_width=defect.width / 2 / L,
        depth=float(defect.depth),
        contact_angle=float(zone.contact_angle),
        flank=zone.flank,
    )
    return dataclasses.replace(zone, nut_groove=spalled)


def kinematic_orders(zone: LoadedZone, balls: Count, circuit_length: Length) -> Mapping[str, float]:
    """The orders of a circuit by their causes; all of them are exact for pure rolling at the nominal load."""
    L, d_w = float(zone.path_radius), zone.ball_diameter
    advance = float(zone.natural_speed)
    gamma = 1 - 2 * advance / L  # as s_o = L (1 - γ) / 2
    pitch = ball_chain.loaded_ball_pitch(zone.length, circuit_length, balls, d_w)
    ball_pass = float(ball_chain.ball_pass_order(advance, pitch))
    return {
        "screw": 1.0,
        **{"ball pass" if m == 1 else f"ball pass {m}": m * ball_pass for m in range(1, HARMONICS + 1)},
        "cage": float(ball_chain.cage_order(gamma)),
        "screw over balls": float(ball_chain.over_balls_order(gamma)),
        "ball spot": float(ball_chain.ball_spot_order(nut_losses.ball_turns(L, gamma, d_w))),
        "circulation": float(ball_chain.circulation_order(ball_pass, balls)),
    }


def amplitudes_at(angle: Field, values: Field, orders: Sequence[float]) -> Field:
    """Amplitudes of values at orders, all of them at once by least squares, their mean aside.

    Orders that the length cannot tell apart share what is there.
    """
    waves = np.outer(angle, np.asarray(orders))
    basis = np.concatenate([np.cos(waves), np.sin(waves), np.ones((len(angle), 1))], axis=1)
    factors = np.linalg.lstsq(basis, values, rcond=1e-3)[0][:-1]
    return np.hypot(*factors.reshape(2, -1))


def spectrum_of(angle: Field, values: Field) -> tuple[Field, Field]:
    """Orders and amplitudes of values at angles of equal distance, by a window of Hann."""
    window = np.hanning(len(values))
    whole = np.fft.rfft(window * (values - np.average(values, weights=window)))
    orders = 2 * math.pi * np.fft.rfftfreq(len(values), angle[1] - angle[0])
    return orders, 2 * np.abs(whole) / np.sum(window)


# -- one circuit ----------------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True, eq=False)
class _Circuit:
    """A circuit over the angle: torques by cause, N m, and the axial force of its balls, N."""

    chain: MovingChain
    torques: Mapping[str, Field]
    axial_force: Field
    balls: int


def _of_circuit(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    circuit: Circuit,
    balls: int,
    screw_speed: AngularSpeed,
    step: Ratio,
    turns: Ratio,
) -> _Circuit:
    zone, omega = circuit.zone, abs(float(screw_speed))
    a_turn = 2 * math.pi * float(zone.natural_speed) / circuit.length  # circulations
    # one more turn of the screw: circuits are added up from places of their own
    chain = chain_run(circuit, omega, step, SETTLING + max(CIRCULATIONS, turns * a_turn) + a_turn)
    return _Circuit(chain, torques_of(model, screw, lubricant, chain, screw_speed), _axial_force(chain), balls)


def torques_of(
    model: FrictionModel, screw: BallScrew, lubricant: Lubricant, chain: MovingChain, screw_speed: AngularSpeed
) -> Mapping[str, Field]:
    """Friction torques of a chain on the screw at each of its moments, by cause, N m."""
    zone, loads, forces = chain.zone, chain.loads, chain.forces
    ball = ball_torques(model, screw, lubricant, zone, screw_speed)
    L = float(zone.path_radius)
    gamma = 1 - 2 * float(zone.natural_speed) / L
    turns = float(nut_losses.ball_turns(L, gamma, zone.ball_diameter))
    driven = loads > 0
    ahead = np.roll(driven, -1, axis=-1)
    # neighbours rub with their surfaces against each other: half of that where one of them does not turn
    turning = (driven.astype(float) + ahead) / 2
    lever = model.ball_friction_coefficient * zone.ball_diameter * turns
    return {
        "balls": np.sum(np.interp(loads, *ball), axis=-1),
        "rubbing": lever * np.sum(forces * turning, axis=-1),
        "return": float(zone.natural_speed) * np.sum(np.where(driven & ~ahead, forces, 0.0), axis=-1),
    }


def ball_torques(
    model: FrictionModel, screw: BallScrew, lubricant: Lubricant, zone: LoadedZone, screw_speed: AngularSpeed
) -> tuple[Field, Field]:
    """Loads of a ball, N, and what the model has for the friction torque of one ball at them, N m.

    Without what neighbours do; of balls on four contacts the load is that of both flank pairs.
    """
    sine = math.sin(float(np.arccos(_cosine(zone))))
    axial = zone.nominal_load * LOADS[1:] * screw.loaded_balls * sine * math.cos(zone.lead_angle)
    parted, omega = model.parted, abs(float(screw_speed))
    if zone.four_contacts:
        torques: list[Any] = []
        for preload in axial:
            nut: Any = OversizeBallNut(preload=float(preload))
            result = parted(dataclasses.replace(screw, nut=nut), lubricant, axial_load=0.0, screw_speed=omega)
            torques.append(result.screw_torque)
        loads, torque = 2 * LOADS, np.asarray(torques, dtype=float)
    else:
        alike = dataclasses.replace(screw, nut=SINGLE_NUT, contact_angle=math.asin(sine))
        result = parted(alike, lubricant, axial_load=axial, screw_speed=omega)
        loads, torque = LOADS, np.asarray(result.screw_torque, dtype=float)
    return zone.nominal_load * loads, np.concatenate([[0.0], torque / float(screw.loaded_balls)])


def _cosine(zone: LoadedZone) -> float:
    """Cosine of the contact angle at the nominal place."""
    A, alpha = zone.centre_distance, zone.contact_angle
    X = A * math.sin(alpha) + zone.displacement
    return A * math.cos(alpha) / math.hypot(X, A * math.cos(alpha))


def _axial_force(chain: MovingChain) -> Field:
    """Axial force of the balls of a circuit, all at the nominal contact angle."""
    zone = chain.zone
    return np.sum(chain.loads, axis=-1) * math.sqrt(1 - _cosine(zone) ** 2) * math.cos(zone.lead_angle)


# -- the nut --------------------------------------------------------------------------------------


def _added(
    result: Sequence[_Circuit], screw: BallScrew, axial_load: Force, circuits: int, generator: np.random.Generator
) -> Ripple:
    """The circuits together, over a common angle, each from a place of its own within a turn."""
    first = result[0].chain
    step = min(float(one.chain.angle[1] - one.chain.angle[0]) for one in result)
    starts = [0.0, *generator.uniform(0.0, 2 * math.pi, len(result) - 1)]
    length = min(float(np.ptp(one.chain.angle)) for one in result) - 2 * math.pi
    angle = step * np.arange(math.floor(length / step), dtype=np.float64)

    def over(one: _Circuit, start: float, values: Field) -> Field:
        return np.interp(angle + start, one.chain.angle - one.chain.angle[0], values)

    def together(fields: Sequence[Field], places: Sequence[int]) -> Field:
        return np.sum([over(result[i], starts[i], fields[i]) for i in places], axis=0)

    every = range(len(result))
    torques = {name: together([one.torques[name] for one in result], every) for name in result[0].torques}
    torque = np.sum(list(torques.values()), axis=0)
    orders = kinematic_orders(first.zone, result[0].balls, first.circuit_length)
    amplitudes = amplitudes_at(angle, torque, list(orders.values()))
    displacement = math.nan
    if screw.nut.halves == 2 and len(result) == 2 * circuits:
        pulls = [one.axial_force for one in result]
        net = together(pulls, every[:circuits]) - together(pulls, every[circuits:])
        displacement = float(np.ptp(net)) / float(loads_of(screw, axial_load).rigidity)
    return Ripple(
        angle=angle,
        torque=torque,
        parts={name: float(np.mean(values)) for name, values in torques.items()},
        orders=[NamedOrder(name, order, float(a)) for (name, order), a in zip(orders.items(), amplitudes, strict=True)],
        spectrum=spectrum_of(angle, torque),
        displacement=displacement,
        share=float(np.mean([one.chain.share for one in result])),
    )


def _seed_of(seed: int, half: int, circuit: int) -> int:
    """A seed of its own for each circuit; that of the first one is the seed."""
    return (
        seed if (half, circuit) == (0, 0) else int(np.random.SeedSequence((seed, half, circuit)).generate_state(1)[0])
    )


def _preload(screw: BallScrew) -> Any:
    preload = getattr(screw.nut, "preload", None)
    return math.nan if preload is None else preload


def _short(screw: BallScrew, circuits: Count, relief: Ratio) -> list[Fault]:
    """Faults of circuits in which no ball would have its whole load."""
    balls = float(screw.loaded_balls / circuits)
    if balls < LEAST_BALLS:
        return [Fault("ripple.circuits", "leaves too few balls to each", f"{circuits:g}", "give those of one half")]
    if 2 * relief > balls:
        return [Fault("ripple.relief", "leaves no ball its whole load", f"{relief:g}", "usual: 0.5 to 4 balls")]
    return []


def _faults(screw: BallScrew, defect: Defect | None, seed: Any, turns: Any) -> list[Fault]:
    faults: list[Fault] = []
    if not is_concrete(seed) or not seed >= 0 or seed % 1:
        faults.append(Fault("ripple.seed", "must be a whole number", f"{seed}", "give 0 or more"))
    if not is_concrete(turns) or not turns > 0:
        faults.append(Fault("ripple.turns", "must be positive", f"{turns}", "usual: 12"))
    if isinstance(defect, PreloadLeft):
        if not 0 < defect.share <= 1:
            remedy = "give the share that is left, such as 0.35"
            faults.append(Fault("ripple.defect", "must be a share of the preload", f"{defect.share:g}", remedy))
        if math.isnan(_preload(screw)):
            remedy = "take a nut with a preload"
            faults.append(Fault("ripple.defect", "is for a nut whose preload is given", "", remedy))
    if isinstance(defect, Spall) and not (0 < defect.width < math.inf and 0 <= defect.depth < math.inf):
        given = f"{defect.width:g} m x {defect.depth:g} m"
        faults.append(Fault("ripple.defect", "must have a width and a depth", given, "usual: 2 mm x 2 um"))
    if isinstance(defect, NutGroove) and not 0 <= defect.factor < math.inf:
        faults.append(Fault("ripple.defect", "must not be negative", f"{defect.factor:g}", "usual: 3"))
    return faults
