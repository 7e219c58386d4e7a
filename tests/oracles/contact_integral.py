r"""The friction of one ball by integrating the slip over its contacts: the judge of the closed laws.

Unknown are the rotation of the ball and its orbital rotation (:mod:`oracles.free_ball`); the
three moments on the ball and the force along its path must vanish. As every local law of traction has
a convex potential :math:`\psi(p, s)`, that balance is the minimum of one convex function,

.. math:: \Phi(\Omega, \Omega_m) = \sum_i \int \psi(p, |s_i|)\,\mathrm{d}A + P(\Omega, \Omega_m)

over all contacts i, with P the power of what else resists the ball. So there is one solution, or
none: where the resistances exceed what friction can carry, :math:`\Phi` falls for ever and the ball
skids.

Model: each contact is a patch (:mod:`oracles.contact_patch`) with a circle of radius
:math:`R_d = 2 d_w f/(2f + 1)` as common surface, local normals, and Hertz pressure on the exact
ellipse; its middle lies one ball radius from the centre of the ball. The helix enters exactly, in its
Frenet frame: the rotation of the screw leans against the path, and the two contacts share a lateral
slip of :math:`\omega (d_w/2) \sin\varphi` that no rolling can avoid.

Left out: lateral forces are reported, not fed back into contact loads and angles; inertia; heat; what
the patch leaves out. Contact loads and films are given, the same at all contacts of a race.

The friction torque on the screw is its drive torque less :math:`F P_h/2\pi`, so that friction torque
times speed is the power dissipated.

scipy.optimize would do, but worse: minimize("trust-exact") judges a step by the potential, whose
rounding stops it at imbalances of 1e-9, in three times the time; root("hybr") needs six times the time.
The steps here are judged by slopes, which rounding spares, down to 1e-15.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Annotated, Any, NamedTuple

import numpy as np

from ballscrew.basis.quantities import AngularSpeed, Force, Info, Power, Ratio, Speed, Torque, fields_of
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import geometry
from ballscrew.physics.laws.frame import Frame, helix_frame
from oracles.contact_patch import ContactPatch, Ellipse, SlipField, hertz_ellipse
from oracles.free_ball import ALONG, LATERAL, SPIN, BallResistances, FreeBall, Imbalance
from oracles.tractions import Field, TractionLaw

#: Blurs of the sliding speed in units of the slip of the rolling ball: a round of steps for each.
BLURS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
#: The largest blur that a solution may have: it changes torques by a millionth or less.
LARGEST_BLUR = 1e-4
#: Imbalances, in units of what friction can carry: what ends a round, the last round, and what still
#: counts as balanced where rounding is in the way.
CLOSE, CLOSED, BALANCED = 1e-10, 1e-14, 1e-9
#: Newton steps in a round, and doublings or halvings of a step.
STEPS, CUTS = 100, 100
#: What a step must leave of the slope along it, at most.
LEFT_OVER = 0.9
#: Sliding this many times faster than rolling is skidding, whatever the law.
RUNAWAY = 1e9
#: Points across and along the path; how much finer the grid is that checks them.
RESOLUTION, FINER = (64, 16), 7 / 4

SKIDS = "the ball skids: what resists it exceeds what friction can carry; raise contact_load or the traction"
SLIDES = "the ball slides along its path faster than it rolls"
TOO_LARGE = "the contact is too large for its groove: check contact_load, ball_diameter and conformity"
NO_LOAD = "no load, no contact: give a contact_load above zero"
NOT_FOUND = (
    "the balance of the ball was not found: most likely one race sticks while the film of the other carries "
    "next to nothing; if not, please report the case"
)
#: How far the drive torque's power may be from what is dissipated; beyond, the balance is none.
LARGEST_POWER_ERROR = 1e-6


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class RaceContact:
    """One contact in the balance of the ball. Forces are those of the race on the ball."""

    traction_ratio: Annotated[
        Ratio, Info("T", "net traction / sum of its magnitudes; positive: the screw drives the ball, the nut brakes it")
    ]
    lateral_force: Annotated[Force, Info("F_c", "traction across the path, towards nut normal × path")]
    sliding_speed: Annotated[Speed, Info("u_t", "speed along the path of race against ball, middle of the contact")]
    spin: Annotated[AngularSpeed, Info("w_N", "rotation of race against ball about the outward normal of the ball")]
    slip_power: Annotated[Power, Info("P", "power dissipated by slip")]
    ellipse: Ellipse
    #: Pressure, slip and shear at every point, for pictures and other sums; "across" is outward normal × path.
    field: SlipField = dataclasses.field(repr=False)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class ContactIntegral:
    """Outcome: the friction of one ball, how the ball moves, and how well the balance closes.

    Without a balance all numbers are NaN, ``contacts`` is empty, and ``message`` says why.
    """

    slip_torque: Annotated[Torque, Info("M_P", "slip power of one ball / speed of the screw", "N mm")]
    screw_torque: Annotated[Torque, Info("M_S", "friction torque of one ball on the screw", "N mm")]
    nut_torque: Annotated[Torque, Info("M_N", "friction torque of one ball on the nut", "N mm")]
    slip_power: Annotated[Power, Info("P", "power dissipated by slip, summed point by point")]
    resistance_power: Annotated[Power, Info("P_R", "power of the other resistances")]
    power_balance_error: Annotated[Ratio, Info(r"\epsilon_P", "power in less power dissipated / power dissipated")]
    force_residual: Annotated[Ratio, Info(r"\epsilon_F", "force left along the path / what friction can carry")]
    moment_residual: Annotated[Ratio, Info(r"\epsilon_M", "largest moment left / what friction can carry on its lever")]
    rotation_along: Annotated[AngularSpeed, Info(r"\Omega_t", "rotation of the ball about its path")]
    rotation_across: Annotated[AngularSpeed, Info(r"\Omega_c", "rotation of the ball about nut normal × path")]
    rotation_normal: Annotated[AngularSpeed, Info(r"\Omega_N", "rotation of the ball about the nut's contact normal")]
    orbital_rotation: Annotated[AngularSpeed, Info(r"\Omega_m", "rotation of the ball about the screw axis")]
    screw_spin_share: Annotated[
        Ratio, Info("S", "share of the spin at the screw contact, the rest at the nut; beyond 1 on four contacts")
    ]
    resolution_error: Annotated[
        Ratio | None, Info(r"\epsilon_h", "relative change of the slip torque on a finer grid, if asked for")
    ] = None
    iterations: int
    converged: bool
    message: str = ""
    #: The contacts with screw and nut of each flank pair in turn.
    contacts: tuple[RaceContact, ...] = dataclasses.field(default=(), repr=False)

    @property
    def screw(self) -> RaceContact:
        """The contact with the screw, of the first flank pair."""
        return self.contacts[0]

    @property
    def nut(self) -> RaceContact:
        """The contact with the nut, of the first flank pair."""
        return self.contacts[1]


def contact_integral(
    screw: BallScrew,
    contact_load: Force,
    traction: TractionLaw | tuple[TractionLaw, TractionLaw],
    *,
    flank_pairs: int = 1,
    second_load: Force | None = None,
    resistances: BallResistances | None = None,
    screw_speed: AngularSpeed = 1.0,
    frame: Frame | None = None,
    resolution: tuple[int, int] = RESOLUTION,
    check_resolution: bool = False,
) -> ContactIntegral:
    """The friction of one ball of a screw by the full integral over its contacts.

    ``traction`` is the law of both races, or a pair (screw, nut). ``flank_pairs=2`` is an oversize
    ball: four contacts, each with the contact load, or with ``second_load`` on the second pair.
    ``frame`` is the screw's helix unless given; with ``bearing_frame(screw)`` it is a plain bearing.
    ``resolution`` counts points across and along the path; ``check_resolution`` solves again on a
    finer grid.

    Takes one screw and one number for each quantity. Physics never raises: where the ball skids or outgrows its
    groove, the outcome says so.
    """
    laws = traction if isinstance(traction, tuple) else (traction, traction)
    resistances = BallResistances() if resistances is None else resistances
    frame = helix_frame(screw) if frame is None else frame
    d_w, gamma = screw.ball_diameter, frame.curvature_ratio
    sides = (
        (screw.screw_raceway, geometry.screw_rolling_radius(d_w, gamma)),
        (screw.nut_raceway, geometry.nut_rolling_radius(d_w, gamma)),
    )
    loads = (contact_load, contact_load if second_load is None else second_load)[:flank_pairs]
    ellipses = [
        tuple(
            hertz_ellipse(load, screw.equivalent_modulus(raceway), d_w, raceway.conformity, R_x)
            for raceway, R_x in sides
        )
        for load in loads
    ]
    if min(loads) == 0:
        return _without_balance(NO_LOAD)
    if not all(ellipse.fits for pair in ellipses for ellipse in pair):
        return _without_balance(TOO_LARGE)

    def outcome(points: tuple[int, int]) -> ContactIntegral:
        patches = [
            (ContactPatch.of(at_screw, laws[0], points), ContactPatch.of(at_nut, laws[1], points))
            for at_screw, at_nut in ellipses
        ]
        ball = FreeBall.of(screw, frame, patches, resistances, float(screw_speed))
        found = balance(ball)
        if not found.converged:
            return _without_balance(SKIDS if found.skids else NOT_FOUND, found.iterations)
        result = _with_balance(ball, found, [ellipse for pair in ellipses for ellipse in pair])
        closes = abs(result.power_balance_error) <= LARGEST_POWER_ERROR
        return result if closes else _without_balance(NOT_FOUND, found.iterations)

    coarse = outcome(resolution)
    if not (check_resolution and coarse.converged):
        return coarse
    fine = outcome((round(FINER * resolution[0]), round(FINER * resolution[1])))
    return dataclasses.replace(coarse, resolution_error=abs(fine.slip_torque / coarse.slip_torque - 1))


class Balance(NamedTuple):
    """How a ball moves in balance: the change against the rolling ball, the blur, and how it was found."""

    change: Field
    blur: Speed
    iterations: int
    converged: bool
    skids: bool


def balance(ball: FreeBall) -> Balance:
    """The minimum of the ball's potential, by Newton's method.

    Each step is stretched or cut until the slope along it is mostly gone, which a convex function
    always allows, unless it falls for ever: then the ball skids. Dry friction jumps where the slip
    changes sign; the jump is blurred, and the blur reduced from round to round, as long as rounding
    lets the balance close.
    """
    scale, change, iterations = ball.mean_slip, np.zeros(4), 0
    kept = Balance(change, math.inf, 0, converged=False, skids=False)
    for blur in (scale * share for share in BLURS):
        now = ball.imbalance(change, blur)
        for _ in range(STEPS):
            left = now.share(ball.levers)
            if left <= (CLOSED if blur == scale * BLURS[-1] else CLOSE):
                break
            step = _newton_step(now)
            trial, stretch, iterations = _along(ball, change, step, now, blur, iterations)
            if trial is None and math.isinf(stretch):
                return Balance(change, blur, iterations, converged=False, skids=True)
            if trial is None or (left <= CLOSE and trial.share(ball.levers) >= left):
                break
            change, now = change + stretch * step, trial
            if ball.sliding_speed(change) > RUNAWAY * ball.rolling_speed:
                return Balance(change, blur, iterations, converged=False, skids=True)
        if now.share(ball.levers) > BALANCED:
            break
        kept = Balance(change, blur, iterations, converged=blur <= LARGEST_BLUR * scale, skids=False)
    return kept._replace(iterations=iterations)


def _newton_step(now: Imbalance) -> Field:
    """The step that would end in balance if slopes did not change."""
    unit = 1 / np.sqrt(np.diag(now.slope))
    return -unit * np.linalg.solve(now.slope * np.outer(unit, unit), unit * now.forces)


def _along(
    ball: FreeBall, start: Field, step: Field, now: Imbalance, blur: Speed, iterations: int
) -> tuple[Imbalance | None, float, int]:
    """Where along a step the slope is mostly gone, and how much of the step that is.

    Without such a place the stretch is infinite where the potential falls for ever, finite where
    rounding hides it.
    """
    falls = abs(float(now.forces @ step))
    short, long, stretch = 0.0, math.inf, 1.0
    for _ in range(CUTS):
        iterations += 1
        trial = ball.imbalance(start + stretch * step, blur)
        slope = float(trial.forces @ step)
        if abs(slope) <= LEFT_OVER * falls:
            return trial, stretch, iterations
        short, long = (stretch, long) if slope < 0 else (short, stretch)
        stretch = 2 * stretch if math.isinf(long) else (short + long) / 2
    return None, long, iterations


def _with_balance(ball: FreeBall, found: Balance, ellipses: Sequence[Ellipse]) -> ContactIntegral:
    """The outcome where the ball is in balance."""
    omega, unknowns = ball.screw_speed, ball.rolling + found.change
    contacts: list[RaceContact] = []
    torques = {True: ball.screw_resistance, False: ball.nut_resistance}
    for side, ellipse in zip(ball.sides, ellipses, strict=True):
        twist = side.twist(found.change)
        wrench, _, capacity = side.patch.answer(twist, found.blur)
        field = side.patch.field(twist, found.blur)
        sign = 1 if side.on_screw else -1
        torques[side.on_screw] += sign * float(side.of_race @ wrench)
        contacts.append(
            RaceContact(
                traction_ratio=float(sign * wrench[ALONG]) / capacity,
                lateral_force=float(-sign * wrench[LATERAL]),
                sliding_speed=float(twist[ALONG]),
                spin=float(twist[SPIN]),
                slip_power=field.dissipation,
                ellipse=ellipse,
                field=field,
            )
        )
    slip_power = sum(contact.slip_power for contact in contacts)
    resistance_power = float(ball.resistance @ unknowns) + ball.screw_resistance * omega
    left = ball.imbalance(found.change, found.blur)
    residuals = np.abs(left.forces / ball.levers) / left.capacity
    return ContactIntegral(
        slip_torque=slip_power / omega,
        screw_torque=torques[True],
        nut_torque=torques[False],
        slip_power=slip_power,
        resistance_power=resistance_power,
        power_balance_error=(torques[True] * omega - slip_power - resistance_power)
        / (slip_power + abs(resistance_power)),
        force_residual=float(residuals[3]),
        moment_residual=float(max(residuals[:3])),
        rotation_along=float(unknowns[0]),
        rotation_across=float(unknowns[1]),
        rotation_normal=float(unknowns[2]),
        orbital_rotation=float(unknowns[3]),
        screw_spin_share=1 - float(unknowns[2]) / ball.spin,
        iterations=found.iterations,
        converged=True,
        message=SLIDES if ball.sliding_speed(found.change) > ball.rolling_speed else "",
        contacts=tuple(contacts),
    )


def _without_balance(message: str, iterations: int = 0) -> ContactIntegral:
    """The outcome where there is no balance: no numbers."""
    no_number: dict[str, Any] = {name: math.nan for name in fields_of(ContactIntegral) if name != "resolution_error"}
    return ContactIntegral(**no_number, iterations=iterations, converged=False, message=message)
