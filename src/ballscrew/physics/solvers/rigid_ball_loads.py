r"""The balls of a nut between rigid bodies: all balls of a kind are alike, and one displacement balances the load.

Every operation is elementwise and the number of steps is fixed, so that the solution runs on numbers and arrays and
can be recorded. Lengths are in units of the distance A of the groove centres, forces of a ball in units of
:math:`K A^{3/2}`. The springs are those of :mod:`ballscrew.physics.solvers.ball_springs`:
a flank pair displaced by :math:`\zeta` carries :math:`q = \delta^{3/2}` at the sine :math:`\sigma`,

.. math::

    s = \sqrt{1 + 2 \zeta \sin\alpha + \zeta^2}, \quad \delta = s - 1 + \varepsilon, \quad
    \sigma = (\sin\alpha + \zeta)/s, \quad g(\zeta) = \delta^{3/2} \sigma

**One flank pair** without excess satisfies
:math:`\delta^3 (\delta^2 + 2\delta + \sin^2\alpha) = g^2 (1 + \delta)^2`, in which no root
is left. In logarithms this is a line of slope 3 to 4, so that Halley's method for a power of :math:`\delta` with that
local slope converges from a start that is right in both limits and within 3 % in between.

**Two flank pairs** braced against each other satisfy :math:`g(\zeta_0 + x) - g(\zeta_0 - x) = f`. Up to the load
that lifts the other flank off, the left side bends downwards from lift-off to rest, and Newton's method starts from
the hyperbola through rest, with its slope there, and lift-off. Beyond, one flank pair is left, which bends upwards; the
start is the solution for one flank pair, with the excess made good at lift-off. What is left of the balance is
rounding, a few 1e-15 of load and preload, for halves at contact angles from 0.02° to 89.9° and for balls with an
excess from 0.2° on; ``residual`` says so. A load of the other sign is the mirror image.

Derivatives of the outcome are those of the solution, also without load; at lift-off they are those of beyond. A
preload of exactly zero is the end of its range, where those by the preload may have no limit: they are zero there.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Angle, Array, Force, Length, LoadDeflection, Mask, Ratio, Stiffness

#: Steps for one flank pair alone: from 3 % to rounding; a single one is a start for what follows.
HALLEY_STEPS = 3
#: Steps for two flank pairs, to rounding: of halves, and of balls too big for their grooves.
NEWTON_STEPS = {"halves": 4, "oversize": 5}
#: An approach that is none.
PICOMETRE = 1e-12


class KindLoads(NamedTuple):
    """Loads and contact angles of one kind of balls; elementwise, or with a last axis for balls one by one.

    Of a flank that the balls of a kind do not have, load and angle are the number zero.
    """

    #: How many balls it stands for.
    balls: Array
    forward_load: Force
    backward_load: Force
    forward_angle: Angle
    backward_angle: Angle


class RigidNut(NamedTuple):
    """Operating points of a nut between rigid bodies."""

    load: Force
    preload: Force
    contact_angle: Angle
    lead_cosine: Ratio
    centre_distance: Length
    load_deflection: LoadDeflection
    #: Those of one half.
    loaded_balls: Array

    @property
    def unit(self) -> Force:
        """Axial force of all balls of a half, each under the unit of force across the path."""
        A = self.centre_distance
        return self.loaded_balls * self.load_deflection * A * namespace(A).sqrt(A) * self.lead_cosine


class RigidLoads(NamedTuple):
    """Loads of the flanks that face forwards and backwards, and what follows from the displacement."""

    forward_load: Force
    backward_load: Force
    forward_angle: Angle
    backward_angle: Angle
    deflection: Length
    rigidity: Stiffness
    remaining_preload: Force
    lift_off_load: Force
    residual: Ratio


class Flank(NamedTuple):
    """Load of a flank pair, sine of its contact angle, force across the path, its slope, and the approach."""

    load: Ratio
    sine: Ratio
    force: Ratio
    slope: Ratio
    approach: Ratio


class Groove(NamedTuple):
    """Spring of a ball in its grooves, in units of the distance of their centres."""

    contact_angle: Angle
    constant_angle: bool
    sine: Ratio
    cosine: Ratio

    @classmethod
    def of(cls, contact_angle: Angle, constant_angle: bool) -> Groove:
        """The groove of a contact angle."""
        xp = namespace(contact_angle)
        return cls(contact_angle, constant_angle, xp.sin(contact_angle), xp.cos(contact_angle))

    def flank(self, displacement: Ratio, excess: Ratio | None, free: Mask | None = None) -> Flank:
        """A flank pair at a displacement; one that is free touches nothing, wherever it is."""
        a, zeta = self.sine, displacement
        xp = namespace(a, zeta, excess, free)
        along = a + zeta
        if self.constant_angle:
            s, approach = 1.0, a * zeta
        else:
            further = zeta * (along + a)
            s = xp.sqrt(1 + further)
            approach = further / (s + 1)
        if excess is None:
            touches = zeta > 0
        else:
            # a flank ends in the radial plane: beyond it there is none to touch
            approach = approach + excess
            touches = approach > 0
            if not self.constant_angle:
                touches = touches & (along > 0)
        if free is not None:
            touches = touches & ~free
        # the root of zero has no slope
        delta = xp.where(touches, approach, 1.0)
        root = xp.where(touches, xp.sqrt(delta) / s, 0.0)
        if self.constant_angle:
            return Flank(delta * root, a, delta * root * a, 1.5 * root * a * a, approach)
        slope = root * (1.5 * along * along + delta * self.cosine**2 / s) / s
        return Flank(delta * root * s, along / s, delta * root * along, slope, approach)

    def angle(self, displacement: Ratio) -> Angle:
        """Contact angle at a displacement."""
        if self.constant_angle:
            return self.contact_angle
        return namespace(displacement).arctan((self.sine + displacement) / self.cosine)

    def approach_alone(self, force: Ratio, steps: int) -> Ratio:
        """Approach of a flank pair without excess that carries a force by itself."""
        a, kappa = self.sine, _to_two_thirds(force)
        if self.constant_angle:
            return kappa * a ** (-2 / 3)
        xp = namespace(a, kappa)
        # delta / kappa falls from sin(alpha)^(-2/3) without load to 1; a bound between two roots saves a logarithm
        v = xp.sqrt(xp.maximum(xp.sqrt((1 + 2 * kappa) / (a ** (8 / 3) + 2 * kappa)), 1.0))
        for _ in range(steps):
            delta = kappa * v
            above, below, turning = delta * (delta + 2) + a * a, 1 + delta, delta * self.cosine**2
            result, wanted, both = v * v * v * above, below * below, above * below
            v = v + v * both * (wanted - result) / (result * (2 * both + turning) + wanted * (both + turning))
        return kappa * v

    def displacement(self, approach: Ratio) -> Ratio:
        """Displacement at which a flank pair without excess has an approach."""
        a, delta = self.sine, approach
        if self.constant_angle:
            return delta / a
        further = delta * (delta + 2)
        return further / (namespace(a, delta).sqrt(a * a + further) + a)

    def play(self, excess: Ratio) -> Ratio:
        """Displacement backwards at which a flank pair lets go, the radial plane at most."""
        a = self.sine
        if self.constant_angle:
            return excess / a
        xp = namespace(a, excess)
        behind = excess * (2 - excess)
        left = a * a - behind
        inside = left > 0
        return xp.where(inside, behind / (xp.sqrt(xp.where(inside, left, 1.0)) + a), a)


class _Bracing(NamedTuple):
    """Bracing of both flank pairs by the preload at rest, and where the load lifts one of them off."""

    #: Displacement of both flank pairs by the preload, and what it takes of it until one lets go.
    offset: Ratio
    excess: Ratio | None
    reach: Ratio
    at_rest: Flank
    at_lift_off: Flank


class _Balance(NamedTuple):
    """Displacement by the load, and both flank pairs there."""

    displacement: Ratio
    loaded: Flank
    relieved: Flank


def rigid_loads(nut: RigidNut, *, halves: int, oversize: bool, constant_angle: bool) -> RigidLoads:
    """The loads of a nut between rigid bodies, elementwise; NaN where an input is, and for a preload below zero."""
    xp = namespace(*nut)
    groove, unit = Groove.of(nut.contact_angle, constant_angle), nut.unit
    backwards = nut.load < 0
    load = xp.where(backwards, -nut.load, nut.load)
    force, preload = load / unit, nut.preload / unit
    braced = halves == 2 or oversize
    bracing = _bracing(groove, preload, oversize) if braced else None
    x, loaded, relieved = _alone(groove, force) if bracing is None else _balance(groove, bracing, force)
    offset, rest = (0.0, 0.0) if bracing is None else (bracing.offset, bracing.at_rest.force)
    # from the balance, which has a slope without load, too; at rest both flanks carry the same, to the last bit
    loaded_load = relieved.load * (relieved.sine / loaded.sine) + force / loaded.sine
    off_balance = xp.maximum(abs(loaded.force - relieved.force - force), abs(rest - preload) if braced else 0.0)
    works = load + nut.preload
    floor = nut.loaded_balls * nut.load_deflection * PICOMETRE**1.5
    residual = xp.where(works > 0, unit * off_balance / xp.maximum(works, floor), 0.0)
    of_ball = nut.load_deflection * nut.centre_distance * xp.sqrt(nut.centre_distance)
    # a choice, so that slopes of the friction by a load that vanishes, which are infinite, go no further
    loads = (of_ball * loaded_load, xp.where(relieved.load == 0, 0.0, of_ball * relieved.load))
    angles = (groove.angle(offset + x), groove.angle(offset - x) if braced else 0.0)
    travel = x * nut.centre_distance / nut.lead_cosine
    known = (force >= 0) & (preload >= 0)

    def where_known(value: Any) -> Any:
        return xp.where(known, value, np.nan)

    return RigidLoads(
        forward_load=where_known(xp.where(backwards, loads[1], loads[0])),
        backward_load=where_known(xp.where(backwards, loads[0], loads[1])),
        forward_angle=where_known(xp.where(backwards, angles[1], angles[0])),
        backward_angle=where_known(xp.where(backwards, angles[0], angles[1])),
        deflection=where_known(xp.where(backwards, -travel, travel)),
        rigidity=where_known(unit * (loaded.slope + relieved.slope) * nut.lead_cosine / nut.centre_distance),
        remaining_preload=where_known(unit * relieved.force if braced else 0.0),
        lift_off_load=where_known(0.0 if bracing is None else unit * bracing.at_lift_off.force),
        residual=where_known(residual),
    )


def rigid_lift_off_load(nut: RigidNut, *, oversize: bool, constant_angle: bool) -> Force:
    """The load that lifts the other flanks of a preloaded nut off."""
    groove, unit = Groove.of(nut.contact_angle, constant_angle), nut.unit
    return unit * _bracing(groove, nut.preload / unit, oversize).at_lift_off.force


def _alone(groove: Groove, force: Ratio) -> _Balance:
    """A flank pair that no other one braces."""
    x = groove.displacement(groove.approach_alone(force, HALLEY_STEPS))
    return _Balance(x, groove.flank(x, None), Flank(0.0, 0.0, 0.0, 0.0, 0.0))


def _bracing(groove: Groove, preload: Ratio, oversize: bool) -> _Bracing:
    """Two halves pushed apart, or balls too big by what a preload approaches them at their angle without load."""
    if oversize:
        offset, excess = 0.0, _to_two_thirds(preload) * groove.sine ** (-2 / 3)
        reach = groove.play(excess)
    else:
        offset, excess = groove.displacement(groove.approach_alone(preload, HALLEY_STEPS)), None
        reach = offset
    return _Bracing(offset, excess, reach, groove.flank(offset, excess), groove.flank(offset + reach, excess))


def _balance(groove: Groove, bracing: _Bracing, force: Ratio) -> _Balance:
    """Two flank pairs, braced against each other, under a load."""
    offset, excess, reach, at_rest, at_lift_off = bracing
    xp = namespace(force, reach)
    lifted = force >= at_lift_off.force
    # below: the hyperbola; its denominator vanishes without load and preload only
    part = force / xp.where(at_lift_off.force > 0, at_lift_off.force, 1.0)
    below = reach * force / xp.where(lifted, 1.0, 2 * at_rest.slope * reach * (1 - part) + force)
    # above: one flank pair alone
    approach = groove.approach_alone(xp.where(lifted, force, at_lift_off.force), 1)
    if excess is not None:
        without_excess = groove.approach_alone(at_lift_off.force, 1)
        approach = at_lift_off.approach - excess + (approach - without_excess)
    x = xp.where(lifted, groove.displacement(approach) - offset, below)
    loaded, relieved = _flanks(groove, bracing, x, lifted)
    for _ in range(NEWTON_STEPS["halves" if excess is None else "oversize"]):
        slope = loaded.slope + relieved.slope
        x = x - (loaded.force - relieved.force - force) / xp.where(slope > 0, slope, 1.0)
        loaded, relieved = _flanks(groove, bracing, x, lifted)
    return _Balance(x, loaded, relieved)


def _flanks(groove: Groove, bracing: _Bracing, x: Ratio, lifted: Mask) -> tuple[Flank, Flank]:
    """Both flank pairs at a displacement by the load; the one that is lifted off carries nothing."""
    offset, excess = bracing.offset, bracing.excess
    return groove.flank(offset + x, excess), groove.flank(offset - x, excess, free=lifted)


def _to_two_thirds(force: Ratio) -> Ratio:
    """The power of 2/3; that of zero has no slope."""
    xp = namespace(force)
    positive = force > 0
    return xp.where(positive, xp.where(positive, force, 1.0) ** (2 / 3), 0.0)
