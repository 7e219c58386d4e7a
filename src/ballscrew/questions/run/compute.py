"""Friction of a case at its operating point, with and without a nut.

All nuts give the same fields. What only a nut has whose balls differ or are preloaded stands in :attr:`Run.nut`.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import InputError
from ballscrew.basis.overflow import overflow_as_input_error
from ballscrew.basis.quantities import Quantity, quantities_of
from ballscrew.basis.records import Measured, Message, Record
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.nut_tables import dynamic_rating
from ballscrew.cases.screw_tables.nut_kinds import LISTED, NUT_FIELDS
from ballscrew.physics.components.contact import RaceState
from ballscrew.physics.components.nut import Nut
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.components.traits import traits_of
from ballscrew.physics.friction import starvation
from ballscrew.physics.friction.result import QUADRANTS, FrictionResult, Quadrant
from ballscrew.physics.sizing.rigidity import AxialRigidity, rigidity_iso3408
from ballscrew.physics.solvers.load_distribution import BallLoads, preload_of
from ballscrew.questions.run import makers
from ballscrew.questions.run.nut_state import Flank, NutState, Touching

_KNOWN = quantities_of(FrictionResult)
_TORQUE, _DRIVE, _SHARE = (_KNOWN[name] for name in ("holding_torque", "drive_torque", "rolling_share"))
_LIFT_OFF = quantities_of(BallLoads)["lift_off_load"]
#: Results of a single ball. Those of a nut whose balls differ are of its contacts, or of all balls together.
OF_ONE_BALL = frozenset(
    {
        "contact_load", "entrainment_speed", "ball_to_ball_force", "spin_moment", "lateral_force", "rolling_share",
        "ball_friction_moment",
    }
)  # fmt: skip


#: Results of a preloaded nut without load.
OF_IDLE_NUT = ("preload_torque_coefficient", "diameter_drag_coefficient")

#: The largest share of the dynamic load rating by which vendors preload a nut (Rexroth2006: 2 to 10 %).
LARGEST_PRELOAD_SHARE = 0.1 * (1 + 1e-9)


class Holding(NamedTuple):
    """What holds a load."""

    axial_load: float
    holding_torque: float
    valid: bool

    @property
    def drives(self) -> bool:
        """The load alone turns the screw."""
        return self.holding_torque * self.axial_load > 0

    @classmethod
    def of(cls, friction: FrictionResult, place: tuple[int, ...] = ()) -> Holding:
        """That of a result, at a place of its arrays."""
        read = (np.asarray(value)[place].item() for value in (friction.holding_torque, friction.valid))
        return cls(float(np.asarray(friction.axial_load)[place]), *read)


@dataclasses.dataclass(frozen=True, eq=False)
class Run:
    """Friction of a case at its operating point."""

    case: Case
    friction: FrictionResult
    #: The same at rest: the torque that a brake has to hold.
    at_rest: Holding
    #: The contacts with screw and nut of a ball, of a nut those of the most loaded one.
    contacts: Mapping[str, Mapping[str, float]]
    #: The flanks that this ball touches.
    touching: Sequence[Touching]
    #: Share of the resistances to rolling that friction carries; NaN where it is not known.
    rolling_share: float
    #: Force between neighbouring balls, N; None in a nut, whose balls have loads of their own.
    ball_to_ball_force: float | None
    #: The four combinations of load and rotation.
    quadrants: Mapping[str, Quadrant]
    #: None without a nut.
    nut: NutState | None = None

    @property
    def quantities(self) -> Mapping[str, Quantity]:
        """The quantities of the result, by name; of a nut whose balls differ without those of a single ball."""
        known = quantities_of(type(self.friction))
        return known if self.nut is None else {n: q for n, q in known.items() if n not in OF_ONE_BALL}

    @property
    def curvature_alone(self) -> bool:
        """Curvature is the only slip of the model."""
        return traits_of(self.case.model.slip).curvature_alone

    @property
    def verdicts(self) -> list[Record]:
        """Starvation; the quadrant, if not the usual one; whether the load drives; skidding; the rule of the maker, if
        it is far off; loss of the preload.
        """
        starved = units.in_display_units_of(self.friction.starvation)
        if float(self.friction.axial_load) == 0:
            none = Message("no axial load")
            found = [units.record(none, id="verdict.no_load", subject="axial_load", value=0.0, unit="N")]
            return [*starved, *found, *self._of_maker(), *self._lost()]
        moving = bool(self.friction.screw_speed)
        found = _holding(Holding.of(self.friction), "", self.at_rest.drives) if moving else []
        return [
            *starved,
            *_quadrant(self.friction),
            *found,
            *_holding(self.at_rest, "at_rest"),
            *self._skid(moving),
            *self._of_maker(),
            *self._lost(),
        ]

    @property
    def warnings(self) -> list[Record]:
        """The conditions of the model that fail, and the loss of the preload."""
        return [*self.conditions, *self._lost()]

    def _heavy_preload(self) -> list[Record]:
        """A preload beyond what vendors give a nut of this rating."""
        if self.nut is None or self.nut.preload <= 0:
            return []
        case = self.case
        try:
            rating, source = dynamic_rating(case.screw, case.row, case.listed)
        except InputError:  # of a geometry that no standard has ratings for
            return []
        share = self.nut.preload / rating
        if share <= LARGEST_PRELOAD_SHARE or any(one.subject == "nut.preload" for one in self.case.implausible()):
            return []
        message = Message(
            "preload {preload} is {share} times the dynamic load rating {rating}, {source}: "
            "vendors give a nut {largest} times that at most; check the number and its unit",
            {
                "preload": Measured(self.nut.preload, NUT_FIELDS["preload"]),
                "share": Measured(share, digits=3),
                "rating": Measured(rating, LISTED["dynamic_load_rating"]),
                "source": Message(source),
                "largest": Measured(LARGEST_PRELOAD_SHARE),
            },
        )
        return [
            units.record(
                message, id="run.preload_above_rating", subject="nut.preload", severity="warning", holds=False,
                value=share, limit=LARGEST_PRELOAD_SHARE,
            )
        ]  # fmt: skip

    @property
    def conditions(self) -> list[Record]:
        """The warnings of the friction but starvation, which is a verdict, those of the case, and a heavy preload."""
        found = [record for record in self.friction.warning_records if record.id != starvation.STARVED]
        return [*units.in_display_units_of(found), *self.case.doubts, *self._heavy_preload()]

    def _skid(self, moving: bool) -> list[Record]:
        share = self.rolling_share
        if not share < 1 or not math.isfinite(float(self.friction.screw_torque)):
            return []
        percent = {"percent": Measured(100 * share, digits=3)}
        if moving:
            found = "verdict.skid"
            message = Message("skids: friction carries only {percent}% of what resists the rolling of a ball", percent)
        else:
            found = "verdict.skid.at_rest"
            message = Message("at rest: friction carries only {percent}% of what resists rolling", percent)
        return [
            units.record(
                message, id=found, subject="rolling_share", severity="warning" if moving else "info", holds=False,
                value=share, limit=1.0, unit=_SHARE.unit,
            )
        ]  # fmt: skip

    def _of_maker(self) -> list[Record]:
        return makers.verdicts(self.case, self.nut)

    def _lost(self) -> list[Record]:
        if self.nut is None or not self.nut.preload_is_lost:
            return []
        limit = float(self.nut.loads.lift_off_load)
        message = Message(
            "preload lost: the balls lift off the other flank; between rigid bodies they do above {load}",
            {"load": Measured(limit, _LIFT_OFF)},
        )
        return [
            units.record(
                message, id="verdict.preload_lost", subject="axial_load", severity="warning", holds=False,
                value=abs(float(self.friction.axial_load)), limit=limit, unit=_LIFT_OFF.unit,
            )
        ]  # fmt: skip


def _quadrant(friction: FrictionResult) -> list[Record]:
    """The directions of load and rotation in words; empty at rest, and where both are positive as usual."""
    load, speed, torque = (float(v) for v in (friction.axial_load, friction.screw_speed, friction.drive_torque))
    if speed == 0 or (load > 0 and speed > 0) or math.isnan(torque):
        return []
    signs = (int(math.copysign(1, load)), int(math.copysign(1, speed)))
    name = next(words for words, each in QUADRANTS.items() if each == signs)
    values = {"quadrant": Message(name), "torque": Measured(abs(torque), _DRIVE)}
    if signs[0] == signs[1]:
        message = Message(
            "{quadrant}: the screw moves the nut against the load; {torque} on the shaft drive it", values
        )
    elif torque * speed < 0:
        message = Message(
            "{quadrant}: the load moves the way the screw turns; {torque} on the shaft hold it back", values
        )
    else:
        message = Message(
            "{quadrant}: the load moves the way the screw turns, and does not suffice; {torque} on the shaft drive it",
            values,
        )
    return [
        units.record(
            message, id="verdict.quadrant", subject="drive_torque", severity="info",
            value=torque, unit=_DRIVE.unit,
        )
    ]  # fmt: skip


def _holding(holding: Holding, place: str, drives_at_rest: bool = False) -> list[Record]:
    """Whether the load drives, and the torque that holds or lowers it; empty where it is NaN.

    What holds a load only while it turns is no self-locking: nobody may leave a brake out because of it.
    """
    held = holding.holding_torque
    if math.isnan(held):
        return []
    drives = holding.drives
    torque = {"torque": Measured(abs(held), _TORQUE)}
    if drives:
        name = "back_driving"
        message = (
            Message("back-drives: the load turns the screw; {torque} on the shaft hold it at rest", torque)
            if place
            else Message("back-drives: the load turns the screw; {torque} on the shaft hold it at this speed", torque)
        )
    elif drives_at_rest:
        name = "held_in_motion"
        message = Message(
            "not self-locking: friction holds the load only while the screw turns at this speed; "
            "at rest the load drives: it needs a brake; {torque} on the shaft lower it at this speed",
            torque,
        )
    else:
        name = "self_locking"
        message = (
            Message(
                "self-locking: the load alone does not turn the screw at rest; {torque} on the shaft lower it", torque
            )
            if place
            else Message(
                "self-locking: the load alone does not turn the screw at this speed; {torque} on the shaft lower it",
                torque,
            )
        )
    if not holding.valid:
        message = Message("{message} (outside the model's validity)", {"message": message})
    return [
        units.record(
            message,
            id=".".join(filter(None, ["verdict", name, place])),
            subject="holding_torque",
            severity="info" if drives else "warning",
            holds=True,
            value=held,
            unit=_TORQUE.unit,
        )
    ]


# -- evaluation -----------------------------------------------------------------------------------


@overflow_as_input_error()
def run(case: Case) -> Run:
    """Friction of a case at its operating point."""
    return _of_balls(case) if case.nut is None else with_nut(case, case.nut)


def _of_balls(case: Case) -> Run:
    """The screw as its loaded balls alone."""
    load, speed = case.operation.axial_load, case.operation.screw_speed

    def friction(speed: float) -> FrictionResult:
        return case.model(case.screw, case.lubricant, axial_load=load, screw_speed=speed)

    found = friction(speed)
    return Run(
        case=case,
        friction=found,
        at_rest=Holding.of(friction(0.0) if float(speed) and float(load) else found),
        contacts={
            side: {name: float(getattr(state, name)) for name in quantities_of(RaceState)}
            for side, state in (("screw", found.screw), ("nut", found.nut))
        },
        touching=[Touching(1, float(case.screw.contact_angle), float(found.contact_load))],
        rolling_share=float(found.rolling_share),
        ball_to_ball_force=float(found.ball_to_ball_force),
        quadrants=found.quadrants,
    )


def with_nut(case: Case, nut: Nut) -> Run:
    """The case with this nut in place of its own."""
    load, speed = case.operation.axial_load, case.operation.screw_speed

    screw = dataclasses.replace(case.screw, nut=nut)

    def friction(load: Any, speed: Any) -> FrictionResult:
        return case.model(screw, case.lubricant, axial_load=load, screw_speed=speed)

    found = friction(load, speed)
    # at rest, under the opposite load, and without load: together, as a call of the model takes long by itself
    beside = friction(np.array([load, -load, 0.0]), np.array([0.0, speed, speed]))
    loads, half = found.loads, np.shape(found.loads.balls)[-1] // nut.halves
    flanks = (
        _flank(loads.forward_load[:half], loads.forward_angle[:half], loads.balls[:half]),
        _flank(loads.backward_load[-half:], loads.backward_angle[-half:], loads.balls[-half:]),
    )
    loaded, relieved = flanks if load >= 0 else flanks[::-1]
    quadrants = found.quadrants
    if nut.one_by_one and float(load):  # another half carries a load of the other sign, and not as this one does
        reverse = {name: _at(one, 1) for name, one in beside.quadrants.items()}
        quadrants = {name: one if one.load_sign * load > 0 else reverse[name] for name, one in quadrants.items()}
    return Run(
        case=dataclasses.replace(case, screw=screw),
        friction=found,
        at_rest=Holding.of(beside, (0,)) if float(speed) and float(load) else Holding.of(found),
        contacts=_most_loaded(found),
        touching=_touching(found),
        rolling_share=math.nan,
        ball_to_ball_force=None,
        quadrants=quadrants,
        nut=NutState(
            nut=nut,
            preload=float(preload_of(screw, nut)),
            preload_drag=float(beside.screw_torque[2]),
            idle_losses={name: float(np.broadcast_to(torque, 3)[2]) for name, torque in beside.losses.items()},
            drag_coefficients={name: float(np.broadcast_to(getattr(beside, name), 3)[2]) for name in OF_IDLE_NUT},
            loads=loads,
            rigidity=_rigidity(case, screw, load),
            maximum_pressure=float(found.maximum_pressure),
            loaded=loaded,
            relieved=relieved,
        ),
    )


def _rigidity(case: Case, screw: BallScrew, load: float) -> AxialRigidity:
    """The rigidity by ISO 3408-4 of the nut of a case, and of its shaft where it is known."""
    return rigidity_iso3408(screw, axial_load=load, installation=case.installation, **case.sizes_of_nut(screw))


def _at(quadrant: Quadrant, place: int) -> Quadrant:
    """A quadrant at one of several points."""
    return Quadrant(*quadrant[:2], *(np.asarray(value)[place] for value in quadrant[2:]))


def _flank(load: Any, angle: Any, balls: Any) -> Flank | None:
    """Loads and angles of one flank; the angles are those of balls that touch."""
    touches = load > 0
    if not np.any(touches):
        return None

    def ends(values: Any, weights: Any) -> tuple[float, float, float]:
        return float(np.min(values)), float(np.average(values, weights=weights)), float(np.max(values))

    return Flank(ends(load, balls), ends(angle[touches], balls[touches]))


def _most_loaded(found: FrictionResult) -> dict[str, dict[str, float]]:
    """The contacts of the most loaded ball, on screw and nut."""
    pair = max(found.pairs, key=lambda pair: float(np.max(pair.load)))
    ball = int(np.argmax(pair.load))
    return {
        side: {name: _of_ball(getattr(contact, name), ball) for name in quantities_of(type(contact))}
        for side, contact in (("screw", pair.screw), ("nut", pair.nut))
    }


def _touching(found: FrictionResult) -> list[Touching]:
    """The flanks that the most loaded ball touches; without load the one that it would touch first."""
    loads = found.loads
    ball = int(np.argmax(np.maximum(loads.forward_load, loads.backward_load)))
    carries = 1 if found.axial_load >= 0 else -1
    sides = (
        Touching(carries, _of_ball(loads.forward_angle, ball), _of_ball(loads.forward_load, ball)),
        Touching(-carries, _of_ball(loads.backward_angle, ball), _of_ball(loads.backward_load, ball)),
    )[::carries]
    touching = [flank for flank in sides if flank.load > 0 and math.isfinite(flank.angle)]
    return touching or [Touching(1, float(found.ball_screw.contact_angle), 0.0)]


def _of_ball(value: Any, ball: int) -> float:
    array = np.asarray(value).reshape(-1)
    return float(array[ball if len(array) > 1 else 0])
