"""The balls of a circuit over time: who touches whom, with what force, and what the return costs.

A circuit is a loop of balls with a gap, one part of it the loaded zone
(:mod:`ballscrew.physics.moving_balls.loaded_zone`), the other the return, where the balls lie still until they are
pushed. At each step the loop is cut at its largest gap and solved (:mod:`ballscrew.physics.moving_balls.chain`);
the step ends early where a gap closes. So no ball is ever moved by another without a force that does the work, and what
the races put in is what creep and return take out.

Rigid balls without inertia: 1 N is 0.3 µm of Hertz contact, and a ball coasts less than a tenth of a millimetre up to
some 600 rpm. Left out: bends in which the return gets longer and shorter, the offset of a ball across its groove, and
elastic bodies.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.errors import Fault, accepts_units, is_concrete, raise_if_any
from ballscrew.basis.quantities import AngularSpeed, Count, Force, Info, Length, Power, Ratio
from ballscrew.compiler.kernels import kernel
from ballscrew.compiler.kernels.pooled_row import pooled_row
from ballscrew.physics.components.materials import GRAVITY, STEEL_DENSITY, Lubricant
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import ball_chain
from ballscrew.physics.friction.across_groove import in_motion
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.laws.ball_chain import TURNS_IN_RETURN, WALL_FACTOR
from ballscrew.physics.laws.traits import traits_of
from ballscrew.physics.moving_balls.loaded_zone import BallsInZone, LoadedZone, loaded_zone


class Pushed(NamedTuple):
    """Speeds of balls in a row, the last one first, and what each presses the next one with."""

    speed: list[float]
    #: Force between each ball and the one before it; the last is zero.
    force: list[float]
    #: Force of the races on each ball along the path.
    drive: list[float]


class Driven(NamedTuple):
    """Balls in a row, from behind: their natural speeds, slopes and limits of their drive, and their dry friction."""

    speed: Sequence[float]
    slope: Sequence[float]
    limit: Sequence[float]
    resistance: Sequence[float]


def compiled_pushed_balls(balls: NDArray[np.float64], touches: NDArray[np.bool_]) -> NDArray[np.float64]:
    """The same as :func:`pushed_balls` by a kernel, as arrays, with the fields in rows."""
    return pooled_row(np.concatenate([balls, touches[None].astype(float)]))


def pushed_balls(balls: Driven, touches: Sequence[bool]) -> Pushed:
    """The speeds of balls that touch the one before them or do not; the last entry of ``touches`` does not count."""
    count = len(balls.speed)
    starts, speeds = [0] * count, [0.0] * count  # blocks: where they begin, and their speeds
    blocks = 0
    for ball in range(count):
        start, speed = ball, _block_speed(balls, ball, ball + 1, balls.speed[ball])
        while blocks and start and touches[start - 1] and speeds[blocks - 1] > speed:
            blocks -= 1
            start = starts[blocks]
            speed = _block_speed(balls, start, ball + 1, speeds[blocks])
        starts[blocks], speeds[blocks] = start, speed
        blocks += 1
    speed, force, drive = [0.0] * count, [0.0] * count, [0.0] * count
    end = count
    for block in range(blocks - 1, -1, -1):
        for ball in range(starts[block], end):
            speed[ball] = speeds[block]
        _share_forces(balls, starts[block], end, speeds[block], force, drive)
        end = starts[block]
    return Pushed(speed, force, drive)


def _block_speed(balls: Driven, start: int, end: int, guess: float) -> float:
    """The speed at which the forces on the balls of a block add up to nothing."""
    w = guess
    while True:
        above = below = up = down = 0.0  # the sum just above and just below w, and how fast it falls there
        next_up, next_down = math.inf, -math.inf
        for j in range(start, end):
            k, limit, f = balls.slope[j], balls.limit[j], balls.resistance[j]
            if k > 0:
                slack = limit / k
                low, high = balls.speed[j] - slack, balls.speed[j] + slack
                force = limit if w <= low else -limit if w >= high else k * (balls.speed[j] - w)
                above += force
                below += force
                if w < low:
                    next_up = min(next_up, low)
                elif w < high:
                    next_up = min(next_up, high)
                    up += k
                if w > high:
                    next_down = max(next_down, high)
                elif w > low:
                    next_down = max(next_down, low)
                    down += k
            if f > 0:
                above += f if w < 0 else -f
                below -= f if w > 0 else -f
                if w < 0:
                    next_up = min(next_up, 0.0)
                elif w > 0:
                    next_down = max(next_down, 0.0)
        if above > 0:
            root = w + above / up if up > 0 else math.inf
            if root <= next_up:
                return root
            w = next_up
        elif below < 0:
            root = w + below / down if down > 0 else -math.inf
            if root >= next_down:
                return root
            w = next_down
        else:
            return w


def _share_forces(balls: Driven, start: int, end: int, w: float, force: list[float], drive: list[float]) -> None:
    """Forces between the balls of a block, and of the races on them, at its speed."""
    # what a ball must at least be pushed with, so that those in front of it can be in balance
    least = 0.0
    for j in range(end - 1, start - 1, -1):
        k, limit = balls.slope[j], balls.limit[j]
        drive[j] = min(max(k * (balls.speed[j] - w), -limit), limit) if k > 0 else 0.0
        force[j] = least
        least = max(least - drive[j] - _friction(balls.resistance[j], w, 1.0), 0.0)
    pushed = 0.0
    for j in range(start, end - 1):
        pushed = max(pushed + drive[j] + _friction(balls.resistance[j], w, -1.0), force[j])
        force[j] = pushed
    force[end - 1] = 0.0


def _friction(resistance: float, w: float, way: float) -> float:
    """Dry friction on a ball; at rest, where it may have any value within its limits, the greatest ``way``."""
    if w == 0:
        return way * resistance
    return -resistance if w > 0 else resistance


Field = NDArray[np.float64]

#: Way of a ball between two moments that are kept, in ball diameters.
STEP = 0.1
#: Circulations that are computed, and those at the beginning that do not count.
CIRCULATIONS, SETTLING = 3.0, 1.0


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class MovingChain:
    """The balls of a circuit in motion, at moments of equal distance once their order has settled.

    In the arrays each ball is followed by the next one in the direction of motion, and the last by the first. Means are
    over all of the time, not over the moments alone.
    """

    share: Annotated[Ratio, Info("F_B/Q", "force between balls / load of a ball, mean of the loaded balls")]
    contacts: Annotated[Ratio, Info("p", "share of the loaded balls that press on the next one")]
    power_in: Annotated[Power, Info("P_i", "power of the races on the balls of the circuit, against one another")]
    power_dissipated: Annotated[Power, Info("P_d", "power that creep and the return take")]
    exit_push: Annotated[
        Force, Info("F_e", "force with which the last ball of the loaded zone pushes the return, mean")
    ]
    return_resistance: Annotated[Force, Info("f", "force that a ball needs along the return")]
    #: Angle of the screw at each moment, rad, in the direction in which it turns; shape [moments].
    angle: Field
    #: Place of each ball along the circuit from where the loaded zone begins, m; shape [moments, balls].
    places: Field
    #: Load of each ball, N; shape [moments, balls].
    loads: Field
    #: Force between each ball and the next one in the direction of motion, N; shape [moments, balls].
    forces: Field
    #: The loaded zone with its grooves.
    zone: LoadedZone
    #: Length of the circuit, m.
    circuit_length: Length


class Circuit(NamedTuple):
    """A circuit as its balls meet it."""

    zone: LoadedZone
    balls: int
    length: Length
    return_resistance: Force


@accepts_units("chain")
def moving_chain(
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
    keeps_load: bool | None = None,
    step: Ratio = STEP,
    circulations: Ratio = CIRCULATIONS,
) -> MovingChain:
    """The balls of one of the equal circuits of a nut in motion: a :class:`MovingChain`.

    ``model`` tells the friction of ``screw`` with ``lubricant`` under ``axial_load`` (N) at ``screw_speed`` (rad/s),
    both of either sign. ``gap`` is the free length of a circuit in balls, above zero. ``groove_deviation`` is the
    root-mean-square deviation of the place of nut groove against screw groove, along the axis as outwards, m; the same
    ``seed`` gives the same grooves. The loaded balls of the screw are shared by ``circuits``; ``return_balls`` lie in
    the return of each, by default half a turn of them, which is assumed. ``wall_factor`` scales the drag of the oil in
    the return; the default is assumed, and a factor of three uncertain. ``relief`` is the length at either end of the
    loaded zone over which the load rises, in ball diameters. The balls ``keeps_load`` where their axial load is
    constant, as by default that of a nut without preload; otherwise the displacement of screw against nut is. ``step``
    is the way of a ball between two moments, in ball diameters, and ``circulations`` how often each ball passes the
    loaded zone; the first time does not count.

    Raises :class:`~ballscrew.basis.errors.InputError` for arrays, for numbers out of bounds, for a screw at rest,
    without load, or with spacer balls, and for a model whose slip law knows no slip but that of the curvature.
    """
    numbers = {
        "axial_load": axial_load, "screw_speed": screw_speed, "gap": gap, "groove_deviation": groove_deviation,
        "seed": seed, "circuits": circuits, "wall_factor": wall_factor, "relief": relief, "step": step,
        "circulations": circulations,
    }  # fmt: skip
    raise_if_any(chain_faults(model, screw, numbers, return_balls))
    screw = in_motion(model, screw, lubricant, OperatingState(axial_load, screw_speed, None))
    zone = loaded_zone(
        model,
        screw,
        lubricant,
        axial_load=axial_load,
        screw_speed=screw_speed,
        groove_deviation=groove_deviation,
        seed=int(seed),
        circuits=int(circuits),
        relief=relief,
        keeps_load=keeps_load,
    )
    circuit = circuit_of(model, screw, lubricant, zone, screw_speed, gap, circuits, return_balls, wall_factor)
    return chain_run(circuit, abs(float(screw_speed)), step, circulations)


def circuit_of(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    zone: LoadedZone,
    screw_speed: AngularSpeed,
    gap: Ratio,
    circuits: Count,
    return_balls: Count | None,
    wall_factor: Ratio,
) -> Circuit:
    """The circuit of a loaded zone with its return."""
    d_w = screw.ball_diameter
    resting = return_balls
    if resting is None:
        resting = math.ceil(TURNS_IN_RETURN * ball_chain.balls_of_a_turn(zone.path_radius, d_w))
    balls = max(round(screw.loaded_balls / circuits), 1) + int(resting)
    resistance = ball_chain.return_resistance(
        model.ball_friction_coefficient,
        ball_chain.ball_mass(d_w, STEEL_DENSITY),
        GRAVITY,
        lubricant.viscosity,
        d_w,
        zone.natural_speed * abs(screw_speed),
        wall_factor,
    )
    return Circuit(zone, balls, float((balls + gap) * d_w), float(resistance))


class _Sums:
    """Integrals over the angle."""

    angle = pressed = load = touching = loaded = power_in = dissipated = pushed = 0.0


def chain_run(
    circuit: Circuit,
    screw_speed: AngularSpeed,
    step: Ratio = STEP,
    circulations: Ratio = CIRCULATIONS,
    *,
    compiled: bool | None = None,
) -> MovingChain:
    """The balls of a circuit from rows with equal gaps on, at a speed of the screw without sign.

    Its steps are ``compiled`` by default where the compiler is installed, with the same result.
    """
    zone, count = circuit.zone, circuit.balls
    by_kernel = kernel.available() if compiled is None else compiled
    turned = step * zone.ball_diameter / zone.natural_speed
    moments = math.ceil(circulations * circuit.length / zone.natural_speed / turned)
    first = math.floor(SETTLING / circulations * moments)
    places = np.arange(count) * (circuit.length / count)
    ahead = (np.arange(count) + 1) % count
    touches = np.zeros(count, dtype=bool)
    kept: list[tuple[float, Field, Field, Field]] = []
    sums = _Sums()
    for moment in range(moments):
        start, left = moment * turned, turned
        fresh = moment >= first
        while left > 0:
            here = places % circuit.length
            balls = zone.at(here, start + turned - left)
            gaps = places[ahead] - places - zone.ball_diameter
            gaps[-1] += circuit.length
            speed, force, drive = _pushed(circuit, gaps, touches, balls, by_kernel)
            if fresh:
                kept.append((start, here, balls.load, force))
                fresh = False
            closing = speed - speed[ahead]
            meets = ~touches & (closing > 0)
            times = np.where(meets, np.maximum(gaps, 0.0) / np.where(meets, closing, 1.0), math.inf)
            time = min(left, float(np.min(times)))
            if moment >= first:
                _add(sums, circuit, time, here, balls, speed, force, drive)
            places = places + time * speed
            if time > 0:  # a pair that parts in no time touches until it has parted, so that no two take turns for ever
                touches = touches & (closing >= 0)
            touches = touches | (meets & (times <= time))
            left = left - time
    angle, where, loads, forces = (np.array(each) for each in zip(*kept, strict=True))
    return MovingChain(
        share=sums.pressed / sums.load,
        contacts=sums.touching / sums.loaded,
        power_in=screw_speed * sums.power_in / sums.angle,
        power_dissipated=screw_speed * sums.dissipated / sums.angle,
        exit_push=sums.pushed / sums.angle,
        return_resistance=circuit.return_resistance,
        angle=angle,
        places=where,
        loads=loads,
        forces=forces,
        zone=zone,
        circuit_length=circuit.length,
    )


def _pushed(
    circuit: Circuit, gaps: Field, touches: NDArray[np.bool_], balls: BallsInZone, by_kernel: bool
) -> tuple[Field, Field, Field]:
    """Speeds, forces between balls and forces of the races, from a loop cut at its largest gap."""
    count = gaps.size
    cut = int(np.argmax(np.where(touches, -math.inf, gaps))) + 1
    order = (np.arange(count) + cut) % count
    driven = balls.load > 0
    row = np.stack(
        [
            np.where(driven, balls.speed, 0.0),
            balls.creep,
            balls.limit,
            np.where(driven, 0.0, circuit.return_resistance),
        ]
    )[:, order]
    values = np.empty((3, count))
    values[:, order] = (
        compiled_pushed_balls(row, touches[order])
        if by_kernel
        else pushed_balls(Driven(*row.tolist()), touches[order].tolist())
    )
    speed, force, drive = values
    return speed, force, drive


def _add(
    sums: _Sums,
    circuit: Circuit,
    time: float,
    here: Field,
    balls: BallsInZone,
    speed: Field,
    force: Field,
    drive: Field,
) -> None:
    """Add a step to the integrals."""
    driven, inside = balls.load > 0, here <= circuit.zone.length
    both = (force + np.roll(force, 1)) / 2  # of the contacts in front of a ball and behind it
    leaves = inside & ~np.roll(inside, -1)
    sums.angle += time
    sums.pressed += time * float(both @ driven)
    sums.load += time * float(np.sum(balls.load))
    sums.touching += time * int(np.count_nonzero((force > 0) & driven))
    sums.loaded += time * int(np.count_nonzero(driven))
    sums.power_in += time * float(drive @ balls.speed)
    resisted = circuit.return_resistance * float(np.abs(speed) @ ~driven)
    sums.dissipated += time * (float(drive @ (balls.speed - speed)) + resisted)
    sums.pushed += time * float(force @ leaves)


def chain_faults(model: FrictionModel, screw: BallScrew, numbers: dict[str, Any], return_balls: Any) -> list[Fault]:
    """Faults of the numbers that a chain is asked for with, and of a model and a nut that have none."""
    faults = [
        Fault(f"chain.{name}", "must be one number", repr(value), "compute one case after the other")
        for name, value in numbers.items()
        if not is_concrete(value)
    ]
    if faults:
        return faults
    for name in ("gap", "step", "relief"):
        if not numbers[name] > 0:
            given = f"{numbers[name]:g}"
            faults.append(Fault(f"chain.{name}", "must be positive", given, "in ball diameters"))
    for name in ("groove_deviation", "wall_factor"):
        if not numbers[name] >= 0:
            faults.append(Fault(f"chain.{name}", "must not be negative", f"{numbers[name]:g}", "zero is none"))
    if not numbers["seed"] >= 0 or numbers["seed"] % 1:
        faults.append(Fault("chain.seed", "must be a whole number", f"{numbers['seed']:g}", "give 0 or more"))
    if not numbers["circuits"] >= 1 or numbers["circuits"] % 1:
        faults.append(Fault("chain.circuits", "must be a whole number", f"{numbers['circuits']:g}", "give 1 or more"))
    if not numbers["circulations"] > SETTLING:
        given = f"{numbers['circulations']:g}"
        faults.append(Fault("chain.circulations", "leaves nothing after the first one", given, "usual: 3"))
    if not numbers["screw_speed"]:
        faults.append(Fault("chain.screw_speed", "must not be zero", "0", "the force follows from the motion"))
    if return_balls is not None and not (is_concrete(return_balls) and return_balls >= 0 and return_balls % 1 == 0):
        given = repr(return_balls)
        faults.append(Fault("chain.return_balls", "must be a whole number", given, "give 0 or more, or leave it out"))
    if traits_of(model.slip).curvature_alone:
        remedy = 'take the model reference, or slip = "ellipse"'
        faults.append(Fault("model.slip", "knows no slip but that of the curvature", "", remedy))
    if screw.nut.spacer_balls:
        faults.append(Fault("nut.spacer_balls", "part the loaded balls", "", "they do not press on each other"))
    return faults
