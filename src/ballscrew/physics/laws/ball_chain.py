"""Laws of the ball chain: the force between balls, and on how many neighbours a ball rubs."""

from __future__ import annotations

import dataclasses
from typing import Annotated, Any, NamedTuple, Protocol

from ballscrew.basis.arrays import ByValue, namespace, where
from ballscrew.basis.errors import faults_of, raise_if_any
from ballscrew.basis.quantities import AngularSpeed, Force, Info, Length, Ratio
from ballscrew.physics.components.materials import GRAVITY, STEEL_DENSITY
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import ball_chain, equilibrium, friction, kinematics, rigidity
from ballscrew.physics.laws.contact import Contact
from ballscrew.physics.laws.frame import Frame
from ballscrew.physics.laws.protocols import BallChain
from ballscrew.physics.laws.traits import law_traits, traits_of


@law_traits(excluded="leaves one of the two neighbours out")
def one_neighbour(
    ball_friction_coefficient: Ratio, ball_to_ball_force: Force, ball_diameter: Length, frame: Frame
) -> BallChain:
    """The paper's: one neighbour rubs, the chain is straight, Olaru2005 §2.2 (21)."""
    moment = friction.ball_friction_moment(ball_friction_coefficient, ball_to_ball_force, ball_diameter)
    return BallChain(moment, ball_to_ball_force)


@law_traits(excluded="brakes with all of the force between balls, as an imposed net force does")
def two_neighbours(
    ball_friction_coefficient: Ratio, ball_to_ball_force: Force, ball_diameter: Length, frame: Frame
) -> BallChain:
    """Both neighbours rub, and the chain is curved like the path."""
    moment = 2 * friction.ball_friction_moment(ball_friction_coefficient, ball_to_ball_force, ball_diameter)
    braking_force = equilibrium.chain_braking_force(
        ball_to_ball_force, moment, frame.path_radius, frame.rolling_plane_cosine
    )
    return BallChain(moment, braking_force, ball_to_ball_force)


@law_traits(alternative=True)
def opposed_neighbours(
    ball_friction_coefficient: Ratio, ball_to_ball_force: Force, ball_diameter: Length, frame: Frame
) -> BallChain:
    """Both neighbours rub and press equally: what the one pushes, the other holds, and no net braking is left."""
    moment = 2 * friction.ball_friction_moment(ball_friction_coefficient, ball_to_ball_force, ball_diameter)
    nothing = 0 * ball_to_ball_force
    braking_force = equilibrium.chain_braking_force(nothing, moment, frame.path_radius, frame.rolling_plane_cosine)
    return BallChain(moment, braking_force, nothing)


@law_traits(excluded="leaves the contact of the balls out: holds where spacers part them")
def parted_neighbours(
    ball_friction_coefficient: Ratio, ball_to_ball_force: Force, ball_diameter: Length, frame: Frame
) -> BallChain:
    """No ball touches another, as with a spacer ball after every loaded one."""
    nothing = 0 * ball_to_ball_force
    return BallChain(nothing * ball_diameter, nothing, nothing)


@law_traits(excluded="is the number of one screw, and no law")
def imposed_ball_force(ball_to_ball_force: Force, contact_load: Force) -> Force:
    """The same force at any load, as in the paper."""
    return ball_to_ball_force


@law_traits(excluded="how large the force is, is a matter of its uncertainty", uses_imposed_force=False)
@dataclasses.dataclass(frozen=True, eq=False)
class ProportionalBallForce(ByValue):
    """A force that grows with the load of the ball; an imposed one does not count.

    The load of a ball is that of its contacts with one race: one on two contacts, the sum of both flank
    pairs on four. No measured value is known. The default is that of a full circuit without gaps whose
    grooves are some 2 µm off their place: along the circuit the balls want to travel at speeds that differ by some
    2.4e-4, and the creep of their contacts holds them with nine to twenty times the load for each unit of it.
    With the gap of a usual fill the mechanics gives a tenth and less; the torques of makers ask for 0.012 to 0.029
    (``data/calibrations.toml``). The paper's 1 N / z is 0.0002 at the paper's load, where it is a net braking force.
    """

    share_of_load: Annotated[
        Ratio,
        Info(
            "F_B/Q",
            "force between balls / load of a ball",
            at_least=0,
            hint="0.0075, of known order only; the paper's net force is about 0.0002",
            usual=(0.0, 0.5),
        ),
    ] = 0.0075

    def __post_init__(self) -> None:
        raise_if_any(faults_of("model.ball_force", self))

    def __call__(self, ball_to_ball_force: Force, contact_load: Force) -> Force:
        """Force between balls, N."""
        return self.share_of_load * contact_load


#: Turns of balls that a return holds, and the drag of a ball in it against that in open oil, within a factor of 3.
TURNS_IN_RETURN, WALL_FACTOR = 0.5, 10.0


#: Contacts through which the last loaded balls push the return: half of the last one where the end of the zone is
#: relieved over a ball, as runs have it; up to three with longer ends.
PUSHING_CONTACTS = 0.5


#: Deviation of the natural speed below which grooves count as perfect: that of an atom.
SMALLEST_DEVIATION = 1e-9


class BallInCircuit(NamedTuple):
    """A loaded ball as a law of the force between balls may ask for it: where it rolls, and by which contacts."""

    ball_screw: BallScrew
    frame: Frame
    #: The contacts on the flanks that carry the load.
    screw: Contact
    nut: Contact
    #: Spin of both contacts together, for one rad/s of the screw.
    spin: Ratio
    screw_speed: AngularSpeed
    ball_friction_coefficient: Ratio


class CircuitForceLaw(Protocol):
    """Force between neighbouring balls that depends on more of a ball than its load; its traits say so."""

    def __call__(self, ball_to_ball_force: Force, contact_load: Force, ball: BallInCircuit, /) -> Force:
        """Force between neighbouring balls, N."""
        ...


def force_between_balls(named: Any, law: Any, imposed: Force, contact_load: Force, ball: BallInCircuit) -> Force:
    """Force that a law gives for a loaded ball: the ``law`` to be called, with the traits of the one that is ``named``.

    A law that reads the ball, which its traits say, takes it as a third argument.
    """
    return law(imposed, contact_load, ball) if traits_of(named).reads_ball else law(imposed, contact_load)


@law_traits(
    excluded="a hypothesis of gaps and grooves that no catalogue lists, beside the share of the load",
    uses_imposed_force=False,
    reads_ball=True,
)
@dataclasses.dataclass(frozen=True, eq=False)
class ChainBallForce(ByValue):
    """The force between balls by what their natural speeds differ, and by the room they have.

    The closed form of :func:`ballscrew.moving_chain`: the creep of the contacts against the deviations of the grooves,
    added up over a part of a turn (:func:`~ballscrew.physics.equations.ball_chain.chain_force_share`), a part of it
    that falls with the gap (:func:`~ballscrew.physics.equations.ball_chain.pushing_share`), and what the last balls
    push the return with. The load of a ball is that of its contacts with one race; on four contacts it creeps a tenth
    to a half as stiffly, as these spin several times as fast. No catalogue lists the coefficients, so that all defaults
    are assumed. Without load there is no force.
    """

    gap: Annotated[
        Ratio,
        Info(
            "G",
            "free length of a circuit / ball diameter",
            at_least=0,
            hint="assumed; a tenth of a ball to a whole one",
            usual=(0.0, 3.0),
        ),
    ] = 0.55
    groove_deviation: Annotated[
        Length,
        Info(
            "e",
            "root-mean-square deviation of the place of nut groove against screw groove, axially as radially",
            "um",
            at_least=0,
            hint="assumed; ground grooves have 0.5 um to 2 um",
            usual=(0.0, 2e-5),
        ),
    ] = 1e-6
    circuits: Annotated[
        Ratio,
        Info(
            "n_c",
            "circuits of a nut body, which share its loaded balls",
            above=0,
            hint="assumed; nuts have 1 to 6",
            usual=(1.0, 12.0),
        ),
    ] = 1.0
    return_turns: Annotated[
        Ratio,
        Info(
            "i_r",
            "balls in the return of a circuit / balls of a turn",
            at_least=0,
            hint="assumed; 0.25 (deflector) to 1 (tube)",
            usual=(0.0, 5.0),
        ),
    ] = TURNS_IN_RETURN
    wall_factor: Annotated[
        Ratio,
        Info(
            "k_w",
            "drag of a ball in the return / its drag in open oil",
            at_least=0,
            hint="assumed; of order 10",
            usual=(0.0, 1000.0),
        ),
    ] = WALL_FACTOR

    def __post_init__(self) -> None:
        raise_if_any(faults_of("model.ball_force", self))

    def __call__(self, ball_to_ball_force: Force, contact_load: Force, ball: BallInCircuit) -> Force:
        """Force between balls, N."""
        part, frame = ball.ball_screw, ball.frame
        d_w, L, gamma = part.ball_diameter, frame.path_radius, frame.curvature_ratio
        balls_of_a_turn = ball_chain.balls_of_a_turn(L, d_w)
        loaded, resting = part.loaded_balls / self.circuits, self.return_turns * balls_of_a_turn
        A = rigidity.groove_centre_distance(part.screw_conformity, part.nut_conformity, d_w)
        epsilon = ball_chain.rms_speed_deviation(gamma, part.contact_angle, self.groove_deviation, A)
        xp = namespace(epsilon)
        spread = ball_chain.natural_speed_range(xp.maximum(epsilon, SMALLEST_DEVIATION))
        x = ball_chain.relative_gap(self.gap, loaded + resting, spread)
        share = ball_chain.chain_force_share(self._creep(ball), epsilon, balls_of_a_turn, ball_chain.pushing_share(x))
        speed = _ball_speed(ball) * ball.screw_speed
        resistance = ball_chain.return_resistance(
            ball.ball_friction_coefficient,
            ball_chain.ball_mass(d_w, STEEL_DENSITY),
            GRAVITY,
            ball.screw.lubricant.viscosity,
            d_w,
            speed,
            self.wall_factor,
        )
        push = ball_chain.mean_return_push(resting * resistance, PUSHING_CONTACTS, loaded)
        return where(contact_load > 0, share * contact_load + push, 0.0)

    def _creep(self, ball: BallInCircuit) -> Ratio:
        """Creep coefficient, of speeds for one rad/s: it is one of geometry, at rest as well."""
        frame, d_w = ball.frame, ball.ball_screw.ball_diameter
        slip = kinematics.torsion_speed(1.0, d_w, frame.lead_angle)
        mu = (ball.screw.friction_coefficient + ball.nut.friction_coefficient) / 2
        a = (ball.screw.semi_major_axis + ball.nut.semi_major_axis) / 2
        a = where(a > 0, a, d_w)  # without load, where nothing of it counts
        return ball_chain.creep_coefficient(mu, slip, ball.spin, a, _ball_speed(ball))


def _ball_speed(ball: BallInCircuit) -> Any:
    """Speed of the ball along its path, for one rad/s of the screw."""
    frame = ball.frame
    orbit = kinematics.orbital_rotation(frame.entrainment_speed(1.0), frame.nut_contact_radius)
    return kinematics.orbital_speed(orbit, frame.path_radius)
