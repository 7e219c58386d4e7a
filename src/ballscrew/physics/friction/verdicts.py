"""The table of verdicts on an operating point, and that of warnings, as formulas of named values.

The values, SI, by name, are outputs of a model (:func:`ballscrew.engine.evaluation.outputs.known_outputs`) and its
operating point, ``axial_load`` and ``screw_speed``. Besides them:

- ``at_rest.holding_torque`` and ``at_rest.valid``: those outputs at the same load and a speed of zero;
- ``motor_torque`` about the screw, which the motor holds at rest without current;
- ``unsupported_length`` and ``pitch_circle_diameter`` of the shaft;
- ``rolling_share`` of one ball; of a nut whose balls differ none;
- ``preload`` of a preloaded nut, ``dynamic_load_rating`` of one of its bodies, and ``implausible_preload``, a mask:
  another warning is of that number already;
- ``preload_drag_of_balls``, the torque of a preloaded nut without load and seals, and ``rule_of_maker``, the same by
  the rule of the maker of the nut.

The words are ``rule`` and ``range`` of the maker's rule, ``rating_source``, where the rating is from, and ``of_axis``,
the friction of an axis that ``motor_torque`` is compared without.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Force, Info, Mask, Quantity, fields_of, quantities_of
from ballscrew.basis.records import Judgement, Sentence, Shown, Words, at_least, is_nan
from ballscrew.physics.components.nut import PRELOAD
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.friction import directions, validity
from ballscrew.physics.friction.result import QUADRANTS, FrictionResult
from ballscrew.physics.friction.validity import IMBALANCE, PERCENT, VALIDITY
from ballscrew.physics.solvers.load_distribution import BallLoads

#: The largest share of the dynamic load rating by which vendors preload a nut (Rexroth2006: 2 to 10 %).
LARGEST_PRELOAD_SHARE = 0.1 * (1 + 1e-9)
#: Model over rule between which nothing is said of the maker's rule: makers state their torques to a fifth or worse.
NEAR = (0.8, 1.25)
#: Unsupported length over pitch circle above which a shaft is called slender: a rule of thumb.
MOST_SLENDER = 50.0

_KNOWN = quantities_of(FrictionResult)
_HOLDING, _DRIVE, _FRICTION = (_KNOWN[name] for name in ("holding_torque", "drive_torque", "screw_torque"))
_LIFT_OFF = quantities_of(BallLoads)["lift_off_load"]
_SPEED = fields_of(OperatingState)["screw_speed"]
_PRELOAD = Quantity("preload", "N", PRELOAD)
_RATING = Quantity("dynamic_load_rating", "N", Info("C_a", "dynamic axial load rating", "kN"))
_OF_RULE = Quantity("rule_of_maker", "N m", Info("M_0", "drag torque of the nut without seals"))


def preload_is_lost(preload: Force, remaining_preload: Force) -> Mask:
    """Mask: the load has lifted the balls of a preloaded nut off the other flank."""
    return (preload > 0) & (remaining_preload <= 0)


# -- starvation, load, quadrant -------------------------------------------------------------------


def _starved(of: Mapping[str, Any]) -> Mapping[str, Any]:
    given, flooded = of["screw_torque"], of["flooded_torque"]
    return {"said": validity.differs(given, flooded), "value": flooded, "limit": given}


def _no_load(of: Mapping[str, Any]) -> Mapping[str, Any]:
    return {"said": of["axial_load"] == 0, "value": abs(of["axial_load"])}


def _quadrant(of: Mapping[str, Any]) -> Mapping[str, Any]:
    load, speed, torque = of["axial_load"], of["screw_speed"], of["drive_torque"]
    xp = namespace(load, speed, torque)
    signs = {1: (load > 0, speed > 0), -1: (load < 0, speed < 0)}
    masks = {
        name.replace(" ", "_").replace("-", "_"): signs[of_load][0] & signs[of_speed][1]
        for name, (of_load, of_speed) in QUADRANTS.items()
    }
    usual = masks["drives_forward"]
    moves = (load != 0) & (speed != 0)
    return {
        **masks,
        "said": moves & xp.logical_not(usual | is_nan(torque)),
        "against_the_load": usual | masks["drives_in_reverse"],
        "holds_back": torque * speed < 0,
        "torque": abs(torque),
        "value": torque,
    }


_WORDS_OF_QUADRANT = (
    Sentence("drives forward", "drives_forward"),
    Sentence("is back-driven in reverse", "is_back_driven_in_reverse"),
    Sentence("drives in reverse", "drives_in_reverse"),
    Sentence("is back-driven forward", "is_back_driven_forward"),
)
_OF_QUADRANT = {"quadrant": _WORDS_OF_QUADRANT, "torque": Shown("torque", _DRIVE)}


# -- what holds the load --------------------------------------------------------------------------


def _held(of: Mapping[str, Any], place: str = "") -> tuple[Any, Mask, Mapping[str, Any]]:
    """Masks and numbers of a load that is held: whether there is one, whether it drives, and its numbers."""
    torque, valid = of[f"{place}holding_torque"], of[f"{place}valid"]
    xp = namespace(torque, valid)
    values = {"value": torque, "torque": abs(torque), "invalid": xp.logical_not(valid)}
    is_held = (of["axial_load"] != 0) & xp.logical_not(is_nan(torque))
    return is_held, directions.load_drives(torque, of["axial_load"]), values


def _back_drives(of: Mapping[str, Any]) -> Mapping[str, Any]:
    is_held, drives, result = _held(of)
    return {**result, "said": is_held & (of["screw_speed"] != 0) & drives}


def _held_in_motion(of: Mapping[str, Any]) -> Mapping[str, Any]:
    is_held, drives, result = _held(of)
    xp = namespace(drives)
    drives_at_rest = directions.load_drives(of["at_rest.holding_torque"], of["axial_load"])
    return {**result, "said": is_held & (of["screw_speed"] != 0) & xp.logical_not(drives) & drives_at_rest}


def _locks_itself(of: Mapping[str, Any]) -> Mapping[str, Any]:
    is_held, drives, result = _held(of)
    xp = namespace(drives)
    drives_at_rest = directions.load_drives(of["at_rest.holding_torque"], of["axial_load"])
    return {**result, "said": is_held & (of["screw_speed"] != 0) & xp.logical_not(drives | drives_at_rest)}


def _back_drives_at_rest(of: Mapping[str, Any]) -> Mapping[str, Any]:
    is_held, drives, result = _held(of, "at_rest.")
    return {**result, "said": is_held & drives}


def _locks_itself_at_rest(of: Mapping[str, Any]) -> Mapping[str, Any]:
    is_held, drives, result = _held(of, "at_rest.")
    return {**result, "said": is_held & namespace(drives).logical_not(drives)}


def _holding(template: str, **row: Any) -> Judgement:
    """A verdict on a load that is held; outside the validity of the model the sentence says so."""
    inside = Sentence(template, places={"torque": Shown("torque", _HOLDING)})
    outside = Sentence("{message} (outside the model's validity)", "invalid", {"message": (inside,)})
    return Judgement(subject="holding_torque", holds=True, unit=_HOLDING.unit, sentences=(outside, inside), **row)


def _slenderness(of: Mapping[str, Any]) -> Mapping[str, Any]:
    ratio = of["unsupported_length"] / of["pitch_circle_diameter"]
    return {"said": ratio > MOST_SLENDER, "value": ratio, "limit": MOST_SLENDER}


def _motor_holds(of: Mapping[str, Any]) -> Mapping[str, Any]:
    held, needed = of["motor_torque"], abs(of["at_rest.holding_torque"])
    drives = directions.load_drives(of["at_rest.holding_torque"], of["axial_load"])
    return {"said": drives, **at_least(held, needed)}


_IN_MOTION = ("axial_load", "screw_speed", "holding_torque", "valid")
_AT_REST = ("axial_load", "at_rest.holding_torque", "at_rest.valid")


# -- balls, preload, and the rule of the maker ----------------------------------------------------


def _skids(of: Mapping[str, Any]) -> dict[str, Any]:
    share, torque = of["rolling_share"], of["screw_torque"]
    skids = (of["axial_load"] != 0) & (share < 1) & namespace(torque).isfinite(torque)
    return {"said": skids, "value": share, "limit": 1.0, "percent": 100 * share}


def _skids_in_motion(of: Mapping[str, Any]) -> Mapping[str, Any]:
    result = _skids(of)
    return {**result, "said": result["said"] & (of["screw_speed"] != 0)}


def _skids_at_rest(of: Mapping[str, Any]) -> Mapping[str, Any]:
    result = _skids(of)
    return {**result, "said": result["said"] & (of["screw_speed"] == 0)}


def _far_from_rule(of: Mapping[str, Any]) -> Mapping[str, Any]:
    drag, torque = of["rule_of_maker"], of["preload_drag_of_balls"]
    ratio = torque / drag
    xp = namespace(ratio)
    is_near = (ratio >= NEAR[0]) & (ratio <= NEAR[1])
    return {
        "said": xp.isfinite(ratio) & xp.logical_not(is_near),
        "value": ratio,
        "drag": drag,
        "torque": torque,
        "speed": of["screw_speed"],
    }


def _preload_lost(of: Mapping[str, Any]) -> Mapping[str, Any]:
    said = preload_is_lost(of["preload"], of["remaining_preload"])
    return {"said": said, "value": abs(of["axial_load"]), "limit": of["lift_off_load"]}


def _preload_above_rating(of: Mapping[str, Any]) -> Mapping[str, Any]:
    preload, rating = of["preload"], of["dynamic_load_rating"]
    share = preload / rating
    is_new = namespace(share).logical_not(of["implausible_preload"])
    return {
        "said": (preload > 0) & (share > LARGEST_PRELOAD_SHARE) & is_new,
        "value": share,
        "limit": LARGEST_PRELOAD_SHARE,
        "preload": preload,
        "rating": rating,
    }


# -- tables ---------------------------------------------------------------------------------------

_ROLLS = ("axial_load", "screw_speed", "rolling_share", "screw_torque")

#: The rule of the nut's own maker, where the model is far from it.
RULE_OF_MAKER = Judgement(
    id="verdict.rule_of_maker",
    subject="preload_drag_of_balls",
    formula=_far_from_rule,
    needs=("rule_of_maker", "preload_drag_of_balls", "screw_speed"),
    sentences=(
        Sentence(
            "drag torque without seals: the rule of its maker {rule} gives {drag}, the model {torque} at "
            "{speed}, {ratio} times that; range of the rule: {range}",
            places={
                "rule": Words("rule"),
                "torque": Shown("torque", _OF_RULE),
                "ratio": Shown("value", decimals=2),
                "drag": Shown("drag", _OF_RULE),
                "speed": Shown("speed", _SPEED),
                "range": Words("range"),
            },
        ),
    ),
)
#: The loss of the preload.
PRELOAD_LOST = Judgement(
    id="verdict.preload_lost",
    subject="axial_load",
    formula=_preload_lost,
    needs=("axial_load", "preload", "remaining_preload", "lift_off_load"),
    severity="warning",
    holds=False,
    unit=_LIFT_OFF.unit,
    sentences=(
        Sentence(
            "preload lost: the balls lift off the other flank; they do above {load}",
            places={"load": Shown("limit", _LIFT_OFF)},
        ),
    ),
)
#: All verdicts on an operating point, in the order in which they are said.
VERDICTS: tuple[Judgement, ...] = (
    Judgement(
        id=validity.STARVED,
        subject="screw_torque",
        formula=_starved,
        needs=("screw_torque", "flooded_torque"),
        severity="warning",
        holds=False,
        unit=_FRICTION.unit,
        sentences=(
            Sentence(
                validity.OF_ONE_NUMBER,
                places={"given": Shown("limit", _FRICTION), "flooded": Shown("value", _FRICTION)},
            ),
        ),
    ),
    Judgement(
        id="verdict.no_load",
        subject="axial_load",
        formula=_no_load,
        needs=("axial_load",),
        unit="N",
        sentences=(Sentence("no axial load"),),
    ),
    Judgement(
        id="verdict.quadrant",
        subject="drive_torque",
        formula=_quadrant,
        needs=("axial_load", "screw_speed", "drive_torque"),
        unit=_DRIVE.unit,
        sentences=(
            Sentence(
                "{quadrant}: the screw moves the nut against the load; {torque} on the shaft drive it",
                "against_the_load",
                _OF_QUADRANT,
            ),
            Sentence(
                "{quadrant}: the load moves the way the screw turns; {torque} on the shaft hold it back",
                "holds_back",
                _OF_QUADRANT,
            ),
            Sentence(
                "{quadrant}: the load moves the way the screw turns, and does not suffice; {torque} on the "
                "shaft drive it",
                places=_OF_QUADRANT,
            ),
        ),
    ),
    _holding(
        "back-drives: the load turns the screw; {torque} on the shaft hold it at this speed",
        id="verdict.back_driving",
        formula=_back_drives,
        needs=_IN_MOTION,
        truths=("valid",),
    ),
    # what holds a load only while it turns is no self-locking: nobody may leave a brake out because of it
    _holding(
        "not self-locking: friction holds the load only while the screw turns at this speed; at rest the load "
        "drives: it needs a brake; {torque} on the shaft lower it at this speed",
        id="verdict.held_in_motion",
        formula=_held_in_motion,
        needs=(*_IN_MOTION, "at_rest.holding_torque"),
        truths=("valid",),
        severity="warning",
    ),
    _holding(
        "self-locking: the load alone does not turn the screw at this speed; {torque} on the shaft lower it",
        id="verdict.self_locking",
        formula=_locks_itself,
        needs=(*_IN_MOTION, "at_rest.holding_torque"),
        truths=("valid",),
        severity="warning",
    ),
    _holding(
        "back-drives: the load turns the screw; {torque} on the shaft hold it at rest",
        id="verdict.back_driving.at_rest",
        formula=_back_drives_at_rest,
        needs=_AT_REST,
        truths=("at_rest.valid",),
    ),
    _holding(
        "self-locking: the load alone does not turn the screw at rest; {torque} on the shaft lower it",
        id="verdict.self_locking.at_rest",
        formula=_locks_itself_at_rest,
        needs=_AT_REST,
        truths=("at_rest.valid",),
        severity="warning",
    ),
    Judgement(
        id="verdict.motor_holds",
        subject="motor_torque",
        formula=_motor_holds,
        needs=("axial_load", "at_rest.holding_torque", "motor_torque"),
        severity_of_failure="warning",
        unit=_HOLDING.unit,
        sentences=(
            Sentence(
                "without current the motor holds {held} on the shaft at rest, where {needed} hold the load: "
                "{stays}{counts}",
                places={
                    "held": Shown("value", _HOLDING),
                    "needed": Shown("limit", _HOLDING),
                    "stays": (Sentence("it stays until something starts it", "holds"), Sentence("it does not stay")),
                    "counts": Words("of_axis"),
                },
            ),
        ),
    ),
    Judgement(
        id="verdict.slenderness",
        subject="unsupported_length",
        formula=_slenderness,
        needs=("unsupported_length", "pitch_circle_diameter"),
        sentences=(
            Sentence(
                "slender: the unsupported length is {ratio} times the pitch circle, more than {limit} (a rule of "
                "thumb): the shaft sags, and is hard to make straight; ask its maker",
                places={"ratio": Shown("value", digits=3), "limit": Shown("limit", digits=3)},
            ),
        ),
    ),
    Judgement(
        id="verdict.skid",
        subject="rolling_share",
        formula=_skids_in_motion,
        needs=_ROLLS,
        severity="warning",
        holds=False,
        sentences=(
            Sentence(
                "skids: friction carries only {percent}% of what resists the rolling of a ball",
                places=PERCENT,
            ),
        ),
    ),
    Judgement(
        id="verdict.skid.at_rest",
        subject="rolling_share",
        formula=_skids_at_rest,
        needs=_ROLLS,
        holds=False,
        sentences=(Sentence("at rest: friction carries only {percent}% of what resists rolling", places=PERCENT),),
    ),
    RULE_OF_MAKER,
    PRELOAD_LOST,
)
#: A preload beyond what vendors give a nut of its rating.
PRELOAD_ABOVE_RATING = Judgement(
    id="run.preload_above_rating",
    subject="nut.preload",
    formula=_preload_above_rating,
    needs=("preload", "dynamic_load_rating", "implausible_preload"),
    truths=("implausible_preload",),
    severity="warning",
    holds=False,
    sentences=(
        Sentence(
            "preload {preload} is {share} times the dynamic load rating {rating}, {source}: vendors give "
            "a nut {largest} times that at most; check the number and its unit",
            places={
                "preload": Shown("preload", _PRELOAD),
                "share": Shown("value", digits=3),
                "rating": Shown("rating", _RATING),
                "source": Words("rating_source"),
                "largest": units.number(LARGEST_PRELOAD_SHARE),
            },
        ),
    ),
)
#: The conditions of the model and of its nut, each a warning where it fails, in the order in which they are said.
WARNINGS: tuple[Judgement, ...] = (IMBALANCE, *VALIDITY, PRELOAD_ABOVE_RATING)
