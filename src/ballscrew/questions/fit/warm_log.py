"""Temperatures of the oil in a log that has none: each row as warm as its own measured friction makes it."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence

import numpy as np

from ballscrew.axis.duty_cycle.duty import to_and_fro
from ballscrew.axis.motion.states import Numbers
from ballscrew.axis.thermal.friction_map import COLDEST, HOTTEST, FrictionMap
from ballscrew.axis.thermal.network import network_of, steady
from ballscrew.axis.thermal.surroundings import Surroundings
from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError
from ballscrew.cases.case_files.case import Case
from ballscrew.files.torque_logs.log_rows import Kind
from ballscrew.files.torque_logs.torque_log import TorqueLog
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.questions.warm_up.compute import assumed_of, bearings_of, check_oil, length_of, stroke_of

OPTION = "--self-heating"
#: Speeds between which the heat balance is interpolated.
_SPEEDS = 12


def warm_log(case: Case, log: TorqueLog, kind: Kind = "unknown") -> tuple[TorqueLog, Sequence[str]]:
    """The log with steady temperatures of the oil, and what they assume.

    The heat of a row is its measured torque times its speed, so that no model of friction is needed, and the balance is
    linear in it. That holds for a torque of friction only: of a torque that drives, the share of friction is not known
    before the fit. Raises :class:`~ballscrew.basis.errors.InputError` for such logs, for those that have temperatures,
    for an oil without one, and where a row would be warmer than the oil is known.
    """
    check_oil(case)
    if log.temperature is not None:
        raise InputError(Fault(OPTION, "is given beside a log with temperatures", "", "leave it out"))
    result = log.kind if kind == "unknown" else kind
    if result != "friction":
        problem = f"needs a log of friction torque: of a torque that is {_named(result)} the heat is not known yet"
        remedy = "log the temperature of the nut, or give a log of friction torque with --kind friction"
        raise InputError(Fault(OPTION, problem, "", remedy))
    surroundings = case.surroundings or Surroundings()
    point = dataclasses.replace(case, axis=None, motion=None)
    stroke, length = stroke_of(point, surroundings), length_of(case, surroundings)
    speed, power = np.abs(log.screw_speed), np.abs(log.torque * log.screw_speed)
    fastest = float(np.max(speed))
    speeds = np.unique(np.geomspace(max(float(np.min(speed)), 1e-3 * fastest), fastest, _SPEEDS))
    load = float(np.median(np.abs(log.axial_load)))
    nothing = FrictionMap(np.array([COLDEST, HOTTEST]), np.zeros(1), np.zeros((2, 1)))
    networks = [
        network_of(
            to_and_fro(
                case.model,
                case.screw,
                case.lubricant,
                axial_load=load,
                screw_speed=float(one),
                stroke=stroke,
                also=bearings_of(case),
            ),
            surroundings,
            shaft_length=length,
            friction=nothing,
        )
        for one in speeds
    ]
    idle: Numbers = np.array([one.of_oil @ steady(one, 0.0) for one in networks])
    rise: Numbers = np.array([one.of_oil @ (steady(one, 1.0) - steady(one, 0.0)) for one in networks])
    oil = np.interp(speed, speeds, idle) + np.interp(speed, speeds, rise) * power
    if np.max(oil) > HOTTEST:
        given = units.shown(float(np.max(oil)), TEMPERATURE)
        remedy = "log the temperature, or give [surroundings] as they are: nut_conductance, ball_conductance"
        raise InputError(Fault(OPTION, "makes a row warmer than the oil is known", given, remedy))
    ends = " to ".join(units.shown(float(end), TEMPERATURE) for end in (np.min(oil), np.max(oil)))
    assumed = [
        f"oil at {ends}, in the steady state of the measured torque of each row; the preload stays as it was set",
        *assumed_of(case, surroundings, networks[-1], stroke),
    ]
    return dataclasses.replace(log, temperature=oil), assumed


def _named(kind: Kind) -> str:
    return "not said to be one of friction" if kind == "unknown" else "that of the drive"
