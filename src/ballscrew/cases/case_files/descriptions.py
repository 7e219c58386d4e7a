"""Descriptions of a case as English text in display units: the messages of :mod:`case_messages`, filled."""

from __future__ import annotations

from ballscrew.basis import units
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.case_files import case_messages
from ballscrew.cases.case_files.case import Case
from ballscrew.physics.components.nut import Nut
from ballscrew.physics.components.screw import BallScrew


def title(case: Case) -> str:
    """Load, speed, nut and model."""
    return units.filled(case_messages.title(case))


def operating_point_and_nut(case: Case) -> str:
    """Load, speed and nut."""
    return units.filled(case_messages.operating_point_and_nut(case))


def operating_point(case: Case) -> str:
    """``4000 N, 600 rpm``."""
    return units.filled(case_messages.operating_point(case))


def nut_text(nut: Nut) -> str:
    """``double nut, preload 5047 N``."""
    return units.filled(case_messages.nut_with_preload(nut))


def model_text(case: Case) -> str:
    """The model, and the laws and numbers that differ from its preset."""
    return units.filled(case_messages.model(case))


def design(case: Case, plain_text: bool = False) -> str:
    """The screw in one line, for a caption or as plain text for the terminal."""
    known = fields_of(BallScrew)
    names = ("pitch_circle_diameter", "lead", "ball_diameter", "contact_angle")
    symbols = ("pitch circle", "lead", "balls", "contact angle") if plain_text else ("d$_m$", "lead", "d$_w$", "α")
    fields = dict(zip(symbols, names, strict=True))
    sizes = [f"{symbol} {units.shown(getattr(case.screw, name), known[name])}" for symbol, name in fields.items()]
    starts = f", {case.screw.starts:g} starts" if case.screw.starts > 1 else ""
    conformities = f"conformity {case.screw.screw_conformity:g} and {case.screw.nut_conformity:g}"
    return (
        f"screw {', '.join(sizes)}, {case.screw.loaded_balls:g} {'loaded ' * plain_text}balls{starts}, {conformities}"
    )


# -- assumptions and omissions --------------------------------------------------------------------


def assumptions(case: Case, ball_to_ball_force: float | None = None) -> list[str]:
    """Inputs that are seldom given and on which the result depends."""
    return [units.filled(one) for one in case_messages.assumptions(case, ball_to_ball_force)]


def common_assumptions(case: Case, ball_to_ball_force: float | None = None) -> list[str]:
    """Oil, materials, roughness and the force between balls: that of a result, or else that of the model."""
    return [units.filled(one) for one in case_messages.common_assumptions(case, ball_to_ball_force)]


def left_out(case: Case) -> str:
    """Losses that are not in the torque; of a case without a fit also that it was not compared with measurements."""
    omissions = case_messages.left_out(case)
    return "" if omissions is None else units.filled(omissions)


def of_fit(case: Case) -> list[str]:
    """The log of a fitted case."""
    return [units.filled(one) for one in case_messages.of_fit(case)]


def assumed(case: Case, ball_to_ball_force: float | None = None) -> list[str]:
    """Assumptions, omissions and the origin of a fit, one text each."""
    return [units.filled(one) for one in case_messages.assumed(case, ball_to_ball_force)]
