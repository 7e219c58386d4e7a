"""Rules of one line that people use in place of a model: efficiencies and preload drags of vendors and simulators.

Each rule is a function of the sizes, the load and the preload of a screw, and gives the friction torque under the load,
the efficiency that belongs to it, and the torque without load; NaN where the rule has no answer. None of them knows
oil, speed, balls or roughness.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping
from typing import NamedTuple, TypeAlias

from ballscrew.basis.arrays import where
from ballscrew.basis.errors import plain
from ballscrew.basis.quantities import Angle, Force, Length, Ratio, Torque
from ballscrew.basis.records import is_nan
from ballscrew.physics.equations import geometry, nut_losses, transmission
from ballscrew.physics.friction.calibrations import is_of_maker
from ballscrew.physics.laws.nut_losses import DOUBLE_NUT_DRAG, OVERSIZE_BALL_DRAG, EfficiencyDrag, JISDrag, RexrothDrag

#: The efficiency that THKGeneral computes its examples with; it states 0.9 to 0.95, HIWIN2017 0.85 to 0.95.
USUAL_EFFICIENCY = 0.9
#: The best of the three friction coefficients in the charts of THKGeneral and HIWIN2017 (0.003, 0.005, 0.01).
CHART_FRICTION = 0.003
#: The three lines of those charts.
CHART_LINES = (0.003, 0.005, 0.01)
#: Friction angle of the worked example of HIWIN2016, which is the line 0.005 of its chart.
HIWIN_FRICTION_ANGLE = math.radians(0.286)
#: Default friction angle of the ball screw in Ozdemir2015.
FEED_DRIVE_FRICTION_ANGLE = math.radians(0.2)


class Subject(NamedTuple):
    """Sizes, load and preload of a screw, as far as rules take them."""

    nominal_diameter: Length
    pitch_circle_diameter: Length
    lead: Length
    #: Magnitude of the axial load; zero without.
    axial_load: Force = 0.0
    #: Zero for a nut without preload.
    preload: Force = 0.0
    #: Whether the preload comes from oversize balls, with four contacts each.
    oversize_balls: bool = False

    @property
    def lead_angle(self) -> Angle:
        """Lead angle on the pitch circle."""
        return geometry.lead_angle(self.lead, self.pitch_circle_diameter)

    @property
    def ideal_torque(self) -> Torque:
        """Drive torque without friction."""
        return transmission.ideal_torque(self.axial_load, self.lead)


class Estimate(NamedTuple):
    """Answers of a rule; NaN where it has none."""

    #: Friction torque on the screw under the load; with the drag of the preload where the rule adds it.
    screw_torque: Torque
    #: Torque of the preloaded nut without load.
    drag_torque: Torque = math.nan

    def efficiency(self, ideal_torque: Torque) -> Ratio:
        """Efficiency that belongs to the friction torque; NaN without load."""
        return float(transmission.efficiency(ideal_torque, self.screw_torque)) if ideal_torque else math.nan


RuleFunction: TypeAlias = Callable[[Subject], Estimate]


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Rule:
    """A rule with its name, its formula in a line, its source, and the range for which the source states it."""

    name: str
    title: str
    formula: str
    source: str
    #: What was read of the source.
    checked: str
    range: str
    estimate: RuleFunction
    #: The maker that computes the drag of its nuts so, and the rule as it is called beside a torque; empty of rules
    #: that no maker has for a drag of its own.
    maker: str = ""
    label: str = ""


def _of_efficiency(subject: Subject, efficiency: Ratio, drag: Torque = math.nan) -> Estimate:
    """Friction torque that an efficiency means, and with it a drag where there is one."""
    friction = subject.ideal_torque * (1 / efficiency - 1)
    return Estimate(plain(where(is_nan(drag), friction, friction + drag)), drag)


def _drag(subject: Subject, law: Callable[..., Torque]) -> Torque:
    """Drag by a law of the preload; NaN for a nut without preload, of which such laws say nothing."""
    size = (subject.nominal_diameter, subject.pitch_circle_diameter, subject.lead)
    return plain(where(subject.preload != 0, law(subject.preload, *size), math.nan))


def constant_efficiency(subject: Subject) -> Estimate:
    """A constant efficiency: M_S = M_Sa (1/η − 1) with η = 0.9 (THKGeneral, A-717, where it is 0.9 to 0.95)."""
    return _of_efficiency(subject, USUAL_EFFICIENCY)


def lead_angle_rule(subject: Subject) -> Estimate:
    """An inclined plane, η = tan φ / tan(φ + ρ), with µ = tan ρ = 0.003 (chart of THKGeneral, A-664)."""
    rho = math.atan(CHART_FRICTION)
    return _of_efficiency(subject, transmission.classical_efficiency(subject.lead_angle, rho))


def feed_drive_library(subject: Subject) -> Estimate:
    """An inclined plane with a friction angle of 0.2° on the nominal diameter (defaults of Ozdemir2015)."""
    phi = geometry.lead_angle(subject.lead, subject.nominal_diameter)
    return _of_efficiency(subject, transmission.classical_efficiency(phi, FEED_DRIVE_FRICTION_ANGLE))


def jis_drag(subject: Subject) -> Estimate:
    """The drag of the preload by JISB1192: T = 0.05 (tan φ)^−0.5 F_pr P_h / 2π; nothing under load."""
    return Estimate(math.nan, _drag(subject, JISDrag()))


def rexroth_drag(subject: Subject) -> Estimate:
    """The drag behind the tables of Rexroth2006: T = c F_pr d_0, c = 0.004, with oversize balls 0.010."""
    return Estimate(
        math.nan, _drag(subject, RexrothDrag(OVERSIZE_BALL_DRAG if subject.oversize_balls else DOUBLE_NUT_DRAG))
    )


def thk(subject: Subject) -> Estimate:
    """The sum of THKGeneral, A-717: F P_h / (2π η) with η = 0.9, and the drag of the preload by JISB1192."""
    return _of_efficiency(subject, USUAL_EFFICIENCY, _drag(subject, JISDrag()))


def hiwin(subject: Subject) -> Estimate:
    """The sum of HIWIN2017, 3.7.3: an inclined plane of ρ = 0.286°, and a drag T = (1/η − η_b) F_pr P_h / 2π."""
    phi, rho = subject.lead_angle, HIWIN_FRICTION_ANGLE
    eta = plain(transmission.classical_efficiency(phi, rho))
    K_p = nut_losses.preload_torque_coefficient_of_halves(eta, transmission.classical_back_driving_efficiency(phi, rho))
    drag = where(subject.preload != 0, nut_losses.preload_torque(K_p, subject.preload, subject.lead), math.nan)
    return _of_efficiency(subject, eta, plain(drag))


def of_model(subject: Subject, efficiency: Ratio) -> Torque:
    """Drag of a double nut whose halves have this efficiency at the preload, with the same friction in both."""
    return _drag(subject, EfficiencyDrag(float(efficiency)))


_PLANE = "charts for lead angles of 1° to 10°; load, speed and oil are not stated"

RULES: Mapping[str, Rule] = {
    rule.name: rule
    for rule in (
        Rule(
            name="constant-efficiency",
            title="constant efficiency 0.9",
            formula="η = 0.9",
            source="THK General Catalog, A-717; HIWIN BS-08-2-EN-1704-K, 3.7.3",
            checked="read: THK has 0.9 to 0.95 and computes with 0.9, HIWIN has 0.85 to 0.95",
            range="any ball screw; load, speed and oil are not stated",
            estimate=constant_efficiency,
        ),
        Rule(
            name="lead-angle",
            title="lead angle, µ = 0.003",
            formula="η = tan φ / tan(φ + ρ), tan ρ = 0.003",
            source="THK General Catalog, A-664 to A-666; HIWIN BS-08-2-EN-1704-K, Fig. 2.1",
            checked="read: charts with the lines 0.003, 0.005 and 0.01; 0.003 in THK's worked example",
            range=_PLANE,
            estimate=lead_angle_rule,
        ),
        Rule(
            name="feed-drive-library",
            title="Modelica FeedDriveLibrary, ρ = 0.2°",
            formula="η = tan φ / tan(φ + ρ), φ on the nominal diameter",
            source="Özdemir et al., Modelica Library for Feed Drive Systems (2015)",
            checked="read: default of the model BallScrewDrive; its preload causes no friction",
            range="a default, to be replaced by a vendor's number",
            estimate=feed_drive_library,
        ),
        Rule(
            name="thk",
            title="THK, with load and preload",
            formula="M_Sa / 0.9 + 0.05 (tan φ)^−0.5 F_pr P_h / 2π",
            source="THK General Catalog, A-688 and A-717",
            checked="read, with its worked example",
            range="preloads up to a tenth of the dynamic load rating",
            estimate=thk,
        ),
        Rule(
            name="hiwin",
            title="HIWIN, ρ = 0.286°",
            formula="M_Sa / η + (1/η − η_b) F_pr P_h / 2π",
            source="HIWIN BS-08-2-EN-1704-K, F 3.2 and 3.7.3; ρ of the example in S99TE20-1610",
            checked="read, but for the example with ρ, which is taken from a copy of its numbers",
            range="100 rpm, ISO VG 68, no wipers; its (1/η − η_b) is said to be 0.1 to 0.3",
            estimate=hiwin,
            maker="HIWIN",
            label="HIWIN",
        ),
        Rule(
            name="jis",
            title="JIS B 1192, drag of the preload",
            formula="0.05 (tan φ)^−0.5 F_pr P_h / 2π",
            source="THK General Catalog, A-688, which names JIS B 1192-1997",
            checked="read as the catalogue prints it; the standard itself was not read",
            range="a tolerance of 10 to 65 % on both sides by size and accuracy grade",
            estimate=jis_drag,
            maker="THK",
            label="THK (JIS B 1192)",
        ),
        Rule(
            name="rexroth",
            title="Rexroth, drag of the preload",
            formula="c F_pr d_0, c = 0.004, with oversize balls 0.010",
            source="Bosch Rexroth R310RU 3301 (2006.02)",
            checked="the coefficients are those behind the tables; the vendor does not print them",
            range="diameters of 16 to 125 mm, 100 rpm, no wipers",
            estimate=rexroth_drag,
            maker="Rexroth",
            label="Rexroth",
        ),
    )
}

#: The rules that give a drag of their own, not one that another of the list has, too.
DRAG_RULES = ("jis", "rexroth", "hiwin")
#: The rules that give a friction under load without preload, each once.
LOADED_RULES = ("constant-efficiency", "lead-angle", "feed-drive-library", "hiwin")


def drags(subject: Subject) -> dict[str, Torque]:
    """Torque of a preloaded nut without load or seals by each of :data:`DRAG_RULES`; NaN without preload.

    Elementwise: numbers, and values that are recorded.
    """
    return {name: plain(RULES[name].estimate(subject).drag_torque) for name in DRAG_RULES}


def rule_of(make: str) -> Rule | None:
    """The rule for the drag of the maker that a text names, in any letters; None of other makers."""
    return next((rule for rule in RULES.values() if is_of_maker(rule.maker, make)), None)
