"""Friction of a case at its operating point, with and without a nut.

All nuts give the same fields. What only a nut has whose balls differ or are preloaded stands in :attr:`Run.nut`.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, NamedTuple

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import InputError, overflow_as_input_error
from ballscrew.basis.quantities import Info, Quantity, Ratio, Unit, quantities_of
from ballscrew.basis.records import Judgement, Record, said
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.named_calibration import BY_RULE, OfRule, by_rules
from ballscrew.cases.case_files.nut_tables import dynamic_rating
from ballscrew.physics.components.nut import Nut
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction import validity
from ballscrew.physics.friction.ball_section import most_loaded_ball, touched
from ballscrew.physics.friction.result import FrictionResult, Quadrant
from ballscrew.physics.friction.verdicts import (
    PRELOAD_ABOVE_RATING,
    PRELOAD_LOST,
    VERDICTS,
    preload_is_lost,
)
from ballscrew.physics.laws.contact import RaceState
from ballscrew.physics.laws.traits import traits_of
from ballscrew.physics.sizing.rigidity import AxialRigidity, rigidity_iso3408
from ballscrew.physics.solvers.load_distribution import BallLoads, preload_of
from ballscrew.questions.shared.declared import from_attributes, table_of


class Touching(NamedTuple):
    """A pair of flanks that a ball touches: 1 is the side that carries the load, -1 the other."""

    side: int
    angle: float
    load: float


class Flank(NamedTuple):
    """Loads and contact angles of the balls on one flank: least, mean and greatest."""

    load: tuple[float, float, float]
    angle: tuple[float, float, float]


@dataclasses.dataclass(frozen=True, eq=False)
class NutState:
    """The loads of the balls of a nut, and the torque of the nut without axial load."""

    nut: Nut
    #: Preload of the nut, N.
    preload: float
    #: Torque of the nut without load: of its balls under the preload, and of seals and other losses.
    preload_drag: float
    #: The same in a full bath of oil; equal where no oil is late.
    flooded_drag: float
    #: What of it are losses beside those of the balls, by name, N m.
    idle_losses: Mapping[str, float]
    #: That of the balls as coefficients of catalogues, by the names of the result; NaN without preload.
    drag_coefficients: Mapping[str, float]
    loads: BallLoads
    #: Rigidity by ISO 3408-4, and the deflection of the drive.
    rigidity: AxialRigidity
    #: Greatest contact pressure of all balls, Pa.
    maximum_pressure: float
    #: The flank that carries the load, and the one that it relieves; None where no ball touches.
    loaded: Flank | None
    relieved: Flank | None

    @property
    def drag_of_balls(self) -> float:
        """Torque of the balls alone without load: without seals and other losses, N m."""
        return self.preload_drag - sum(self.idle_losses.values())

    @property
    def preload_is_lost(self) -> bool:
        """The load has lifted the balls off the other flank."""
        return bool(preload_is_lost(self.preload, float(self.loads.remaining_preload)))


class BesideRule(NamedTuple):
    """Torque that a rule gives for the nut, and the model over it."""

    by_rule: OfRule
    ratio: Ratio

    @property
    def text(self) -> str:
        """``Rexroth, its maker, 0.41 N m (model / rule 0.93)``."""
        rule = self.by_rule.rule
        own = ", its maker," if self.by_rule.is_own else ""
        torque = units.shown(self.by_rule.torque, BY_RULE[rule.name])
        return f"{rule.label}{own} {torque} (model / rule {units.fixed(self.ratio, 2)})"

    @property
    def label(self) -> str:
        """``by the rule of Rexroth, its maker; model / rule 0.93``."""
        own = ", its maker" if self.by_rule.is_own else ""
        return f"by the rule of {self.by_rule.rule.label}{own}; model / rule {self.ratio:.2f}"


def beside_rules(case: Case, nut: NutState | None) -> Sequence[BesideRule]:
    """The model over each rule for a preloaded nut without load and seals, that of its maker first; none of others."""
    if nut is None or not nut.preload:
        return ()
    return [BesideRule(one, nut.drag_of_balls / one.torque) for one in by_rules(case)]


def messages(case: Case, nut: NutState | None) -> list[str]:
    """The torque of the balls beside all rules, and by how much the rules contradict each other."""
    result = beside_rules(case, nut)
    if nut is None or not result:
        return []
    rules = ", ".join(one.text for one in result)
    torque = units.shown(nut.drag_of_balls, BY_RULE[result[0].by_rule.rule.name])
    return [f"drag torque without seals {torque}; by the rules of makers: {rules}", contradiction(result)]


def contradiction(result: Sequence[BesideRule]) -> str:
    """Factor by which the rules contradict each other."""
    torques = [float(one.by_rule.torque) for one in result]
    factor = units.fixed(max(torques) / min(torques), 2)
    return (
        f"the rules of makers contradict each other here by a factor of {factor}; none of them accounts for oil, "
        "speed or balls"
    )


def _of_own_rule(case: Case, nut: NutState | None) -> tuple[dict[str, Any], dict[str, str]]:
    """The values and the words of the verdict on the rule of the nut's own maker; none with spacer balls.

    The rules are of nuts full of balls.
    """
    own = next((one for one in beside_rules(case, nut) if one.by_rule.is_own), None)
    if nut is None or own is None or nut.nut.spacer_balls:
        return {}, {}
    rule, torque = own.by_rule.rule, own.by_rule.torque
    values = {"rule_of_maker": torque, "preload_drag_of_balls": nut.drag_of_balls}
    return values, {"rule": rule.label, "range": rule.range}


#: Results that verdicts are on, the operating point among them.
_OF_RESULT = ("axial_load", "screw_speed", "screw_torque", "drive_torque", "holding_torque", "valid")
#: Results of a single ball. Those of a nut whose balls differ are of its contacts, or of all balls together.
OF_ONE_BALL = frozenset(
    {
        "contact_load", "entrainment_speed", "ball_to_ball_force", "spin_moment", "lateral_force", "rolling_share",
        "ball_friction_moment",
    }
)  # fmt: skip


#: Results of a preloaded nut without load.
OF_IDLE_NUT = ("preload_torque_coefficient", "diameter_drag_coefficient")


class Holding(NamedTuple):
    """Load that is held, and the torque that holds it."""

    axial_load: float
    holding_torque: float
    valid: bool

    @classmethod
    def of(cls, friction: FrictionResult, place: tuple[int, ...] = ()) -> Holding:
        """Values of a result, at a place of its arrays."""
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
    #: None without a nut.
    nut: NutState | None = None

    @property
    def quadrants(self) -> Mapping[str, Quadrant]:
        """The four combinations of load and rotation."""
        return self.friction.quadrants

    @property
    def quantities(self) -> Mapping[str, Quantity]:
        """The quantities of the result, by name; of a nut whose balls differ without those of a single ball."""
        known = quantities_of(type(self.friction))
        return known if self.nut is None else {n: q for n, q in known.items() if n not in OF_ONE_BALL}

    @property
    def is_starved(self) -> bool:
        """Its torque, or that of its nut without load, is another one in a full bath of oil."""
        nut = self.nut
        is_idle_starved = nut is not None and bool(validity.differs(nut.preload_drag, nut.flooded_drag))
        return bool(self.friction.starvation) or is_idle_starved

    @property
    def curvature_alone(self) -> bool:
        """Curvature is the only slip of the model."""
        return traits_of(self.case.model.slip).curvature_alone

    @property
    def judged(self) -> tuple[dict[str, Any], dict[str, str]]:
        """The values and the words of the verdicts."""
        friction, nut = self.friction, self.nut
        values = {name: getattr(friction, name) for name in _OF_RESULT}
        values |= {
            "at_rest.holding_torque": self.at_rest.holding_torque,
            "at_rest.valid": self.at_rest.valid,
            "rolling_share": self.rolling_share,
            "flooded_torque": friction.flooded_torque if friction.may_starve else friction.screw_torque,
        }
        if self.case.installation is not None:
            values["unsupported_length"] = self.case.installation.unsupported_length
            values["pitch_circle_diameter"] = self.case.screw.pitch_circle_diameter
        if self.case.motor is not None and self.case.motor.holding_torque is not None:
            gears = 1.0 if self.case.axis is None else self.case.axis.transmission_ratio
            values["motor_torque"] = self.case.motor.holding_torque * gears
        if nut is not None:
            values |= {"preload": nut.preload, "remaining_preload": nut.loads.remaining_preload}
            # a search, of which nothing is said unless the preload is lost
            values["lift_off_load"] = nut.loads.lift_off_load if nut.preload_is_lost else math.nan
        of_maker, words = _of_own_rule(self.case, nut)
        beside = "; friction of bearings and guides is not counted here, duty counts it"
        return values | of_maker, {**words, "of_axis": beside * (self.case.axis is not None)}

    def _said(self, rows: Sequence[Judgement]) -> list[Record]:
        return said(rows, *self.judged)

    @property
    def verdicts(self) -> list[Record]:
        """Starvation; the quadrant, if not the usual one; whether the load drives; skidding; the rule of the maker, if
        it is far off; loss of the preload.
        """
        return self._said(VERDICTS)

    @property
    def warnings(self) -> list[Record]:
        """The conditions of the model that fail, and the loss of the preload."""
        return [*self.conditions, *self._said([PRELOAD_LOST])]

    def _heavy_preload(self) -> list[Record]:
        """A preload beyond what vendors give a nut of this rating."""
        if self.nut is None:
            return []
        case = self.case
        try:
            rating, source = dynamic_rating(case.screw, case.origins.row, case.origins.listed)
        except InputError:  # of a geometry that no standard has ratings for
            return []
        values = {"preload": self.nut.preload, "dynamic_load_rating": rating, "implausible_preload": False}
        result = said([PRELOAD_ABOVE_RATING], values, {"rating_source": source})
        # who has been told once that the number cannot be is not told twice
        is_known = bool(result) and any(one.subject == "nut.preload" for one in case.implausible())
        return [] if is_known else result

    @property
    def conditions(self) -> list[Record]:
        """The warnings of the friction but starvation, which is a verdict, those of the case, and a heavy preload."""
        values = [record for record in self.friction.warning_records if record.id != validity.STARVED]
        return [*values, *self.case.doubts, *self._heavy_preload()]


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

    result = friction(speed)
    return Run(
        case=case,
        friction=result,
        at_rest=Holding.of(friction(0.0) if float(speed) and float(load) else result),
        contacts={
            side: {name: float(getattr(state, name)) for name in quantities_of(RaceState)}
            for side, state in (("screw", result.screw), ("nut", result.nut))
        },
        touching=[Touching(1, float(case.screw.contact_angle), float(result.contact_load))],
        rolling_share=float(result.rolling_share),
        ball_to_ball_force=float(result.ball_to_ball_force),
    )


def with_nut(case: Case, nut: Nut, known: BallLoads | None = None) -> Run:
    """The case with this nut in place of its own; the loads of its balls in motion may be ``known``."""
    load, speed = case.operation.axial_load, case.operation.screw_speed

    screw = dataclasses.replace(case.screw, nut=nut)

    def friction(load: Any, speed: Any, loads: BallLoads | None = None) -> FrictionResult:
        return case.model(screw, case.lubricant, axial_load=load, screw_speed=speed, loads=loads)

    result = friction(load, speed, known)
    # at rest and without load: together, as a call of the model takes long by itself
    beside = friction(np.array([load, 0.0]), np.array([0.0, speed]))
    loads, half = result.loads, np.shape(result.loads.balls)[-1] // nut.halves
    flanks = (
        _flank(loads.forward_load[:half], loads.forward_angle[:half], loads.balls[:half]),
        _flank(loads.backward_load[-half:], loads.backward_angle[-half:], loads.balls[-half:]),
    )
    loaded, relieved = flanks if load >= 0 else flanks[::-1]
    return Run(
        case=dataclasses.replace(case, screw=screw),
        friction=result,
        at_rest=Holding.of(beside, (0,)) if float(speed) and float(load) else Holding.of(result),
        contacts=_most_loaded(result),
        touching=_touching(result),
        rolling_share=math.nan,
        ball_to_ball_force=None,
        nut=NutState(
            nut=nut,
            preload=float(preload_of(screw, nut)),
            preload_drag=float(beside.screw_torque[1]),
            flooded_drag=float((beside.flooded_torque if beside.may_starve else beside.screw_torque)[1]),
            idle_losses={name: float(np.broadcast_to(torque, 2)[1]) for name, torque in beside.losses.items()},
            drag_coefficients={name: float(np.broadcast_to(getattr(beside, name), 2)[1]) for name in OF_IDLE_NUT},
            loads=loads,
            rigidity=_rigidity(case, screw, load),
            maximum_pressure=float(result.maximum_pressure),
            loaded=loaded,
            relieved=relieved,
        ),
    )


def _rigidity(case: Case, screw: BallScrew, load: float) -> AxialRigidity:
    """The rigidity by ISO 3408-4 of the nut of a case, and of its shaft where it is known."""
    return rigidity_iso3408(screw, axial_load=load, installation=case.installation, **case.sizes_of_nut(screw))


def _flank(load: Any, angle: Any, balls: Any) -> Flank | None:
    """Loads and angles of one flank; the angles are those of balls that touch."""
    touches = load > 0
    if not np.any(touches):
        return None

    def ends(values: Any, weights: Any) -> tuple[float, float, float]:
        return float(np.min(values)), float(np.average(values, weights=weights)), float(np.max(values))

    return Flank(ends(load, balls), ends(angle[touches], balls[touches]))


def _most_loaded(friction_result: FrictionResult) -> dict[str, dict[str, float]]:
    """The contacts of the most loaded ball, on screw and nut."""
    pair = max(friction_result.pairs, key=lambda pair: float(np.max(pair.load)))
    ball = int(np.argmax(pair.load))
    return {
        side: {name: _of_ball(getattr(contact, name), ball) for name in quantities_of(type(contact))}
        for side, contact in (("screw", pair.screw), ("nut", pair.nut))
    }


def _touching(friction_result: FrictionResult) -> list[Touching]:
    """The flanks that the most loaded ball touches; without load the one that it would touch first."""
    nominal = float(friction_result.ball_screw.contact_angle)
    sides = zip(
        (1, -1), touched(most_loaded_ball(friction_result.loads), friction_result.axial_load, nominal), strict=True
    )
    return [Touching(side, float(flank.angle), float(flank.load)) for side, flank in sides if flank.touches]


def _of_ball(value: Any, ball: int) -> float:
    array = np.asarray(value).reshape(-1)
    return float(array[ball if len(array) > 1 else 0])


_KNOWN = quantities_of(BallLoads)
_OF_BALLS = {name: _KNOWN[name] for name in ("forward_load", "backward_load", "forward_angle", "backward_angle")}
_OF_ALL_BALLS = {name: quantity for name, quantity in _KNOWN.items() if name not in _OF_BALLS}
_ENDS = ("least", "mean", "greatest")


@dataclasses.dataclass(frozen=True, eq=False)
class EachBall(table_of(_OF_BALLS, of=Sequence[float])):
    """Loads and contact angles ball by ball, or of each kind of ball."""

    #: Balls that each entry stands for.
    count: Sequence[float]


@dataclasses.dataclass(frozen=True)
class OnFlank:
    """Least, mean and greatest of the balls on one flank."""

    load: Annotated[Mapping[str, float], Unit("N"), Info("Q", "normal load: least, mean and greatest")]
    angle: Annotated[
        Mapping[str, float], Unit("rad"), Info(r"\alpha", "contact angle: least, mean and greatest", "deg")
    ]


@dataclasses.dataclass(frozen=True, eq=False)
class NutLoads(table_of(_OF_ALL_BALLS)):
    """Loads of the balls of a nut, and how far it gives way."""

    #: True where the load has lifted the balls off the other flank.
    preload_is_lost: bool
    #: The flank that carries the load; null where no ball touches it.
    loaded_flank: OnFlank | None
    #: The flank that the load relieves; null where no ball touches it.
    relieved_flank: OnFlank | None
    #: Rigidity by ISO 3408-4.
    axial_rigidity: AxialRigidity
    #: Ball by ball, or kind by kind; not in lists of screws.
    balls: EachBall


def nut_loads(nut: NutState) -> NutLoads:
    """The loads of the balls of a nut: least, mean and greatest on both flanks, then ball by ball."""
    return from_attributes(
        NutLoads,
        nut.loads,
        preload_is_lost=nut.preload_is_lost,
        loaded_flank=_on_flank(nut.loaded),
        relieved_flank=_on_flank(nut.relieved),
        axial_rigidity=nut.rigidity,
        balls=from_attributes(EachBall, nut.loads, count=nut.loads.balls),
    )


def _on_flank(flank: Flank | None) -> OnFlank | None:
    if flank is None:
        return None
    load, angle = ({name: numbers[place] for place, name in enumerate(_ENDS)} for numbers in flank)
    return OnFlank(load, angle)
