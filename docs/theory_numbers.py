"""Numbers in the text of the pages on theory."""

from __future__ import annotations

import dataclasses
import math

import ballscrew as bs
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import DoubleNut
from ballscrew.physics.equations import friction, kinematics, nut_losses, transmission
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.laws.friction import arana_traction
from effect_study.cases import CASES, CATALOGUE, PAPER

REFERENCE = FrictionModel.reference()


def numbers() -> dict[str, str]:
    """The numbers by name, formatted for the text."""
    found: dict[str, str] = {}
    for name, case in CASES.items():
        result = case.result(REFERENCE)
        s, n, screw = result.screw, result.nut, case.screw
        rolls = kinematics.ball_rotation(result.entrainment_speed, screw.ball_diameter) / case.screw_speed
        sideways = 1e3 * kinematics.torsion_speed(case.screw_speed, screw.ball_diameter, screw.lead_angle)
        found |= {
            f"t_{name}_angle": f"{math.degrees(float(screw.lead_angle)):.2f}",
            f"t_{name}_gamma": f"{float(result.frame.curvature_ratio):.3f}",
            f"t_{name}_load": f"{float(result.contact_load):.0f}",
            f"t_{name}_orbit": f"{float(kinematics.orbital_rotation(1.0, n.contact_radius) / _screw_turn(result)):.3f}",
            f"t_{name}_turns": f"{float(rolls):.1f}",
            f"t_{name}_lateral": f"{float(sideways):.1f}",
            f"t_{name}_k": f"{float(s.radii_ratio):.1f}",
            f"t_{name}_long": f"{1e3 * float(s.semi_major_axis):.2f}",
            f"t_{name}_short": f"{1e3 * float(s.semi_minor_axis):.2f}",
            f"t_{name}_pressure": f"{float(s.maximum_pressure) / 1e9:.2f}",
            f"t_{name}_film": f"{1e6 * float(s.minimum_film_thickness):.2f}",
            f"t_{name}_lambda": f"{float(s.film_parameter):.2f}",
            f"t_{name}_mu": f"{float(s.friction_coefficient):.3f}",
            f"t_{name}_power": f"{float(result.friction_power):.1f}",
            f"t_{name}_rolling": f"{_percent(result.contributions['hydrodynamic_rolling'] / result.screw_torque)}",
            f"t_{name}_steel": f"{_percent(result.contributions['elastic_hysteresis'] / result.screw_torque)}",
        }
    found |= _of_paper(PAPER.result(REFERENCE), PAPER.screw) | _of_catalogue(CATALOGUE.result(REFERENCE))
    offset = float(friction.offset_from_traction(0.0))
    plain = float(transmission.classical_efficiency(CATALOGUE.screw.lead_angle, math.atan(0.2)))
    found |= {
        "t_offset": f"{offset:.4f}",
        "t_slow_film": f"{2**0.68:.2f}",
        "t_heavy_film": f"{100 * (1 - 2**-0.073):.0f}",
        "t_lift": f"{float(nut_losses.lift_off_load(1.0)):.2f}",
        "t_plain": f"{plain:.2f}",
        "t_plain_torque": f"{float(CATALOGUE.result(REFERENCE).efficiency) / plain:.1f}",
        "t_centre": f"{1e3 * float(_centre_distance()):.2f}",
        "t_cold": _film_at(0.0),
        "t_warm": _film_at(70.0),
        **_of_oils(),
    }
    return found


def _of_paper(result, screw) -> dict[str, str]:
    """What the text has of the paper's screw alone."""
    by_chain = 1e3 * screw.loaded_balls * result.ball_to_ball_force * result.frame.path_radius
    return {
        "t_paper_approach": f"{1e6 * float(result.screw.mutual_approach):.1f}",
        "t_paper_screw_torque": f"{float(result.screw_torque):.3f}",
        "t_paper_nut_torque": f"{float(result.nut_torque):.3f}",
        "t_paper_split": f"{1e3 * float(result.screw_torque - result.nut_torque):.1f}",
        "t_paper_chain": f"{float(by_chain):.1f}",
    }


def _of_catalogue(result) -> dict[str, str]:
    """What the text has of the catalogue screw alone."""
    return {
        "t_catalogue_efficiency": f"{float(result.efficiency):.3f}",
        "t_catalogue_back": f"{float(result.back_driving_efficiency):.3f}",
        "t_catalogue_ideal": f"{float(result.ideal_torque):.2f}",
        "t_catalogue_hold": f"{float(result.holding_torque):.2f}",
    }


def _of_oils() -> dict[str, str]:
    """Viscosity under pressure with and without the pressure modulus of an oil, and torque by the law of its film."""
    hot, oil = 333.15, Lubricant.from_grade("M100 paraffinic", 333.15)
    known = oil.viscosity_under(0.8e9)
    own = dataclasses.replace(oil, pressure_modulus_slope=None).viscosity_under(0.8e9)
    of_grade = Lubricant.from_grade("ISO VG 100", hot).viscosity_under(0.8e9)
    row = bs.catalogue()["rexroth-40x10x6-6-double"]
    screw = row.screw(nut=DoubleNut(preload=0.07 * row.dynamic_load_rating))
    by_oil = dataclasses.replace(REFERENCE, full_film=arana_traction)

    def over_constant(grade: str, celsius: float) -> str:
        at = {"axial_load": 0.0, "screw_speed": 100 * math.pi / 30}
        torques = [
            float(model(screw, Lubricant.from_grade(grade, celsius + 273.15), **at).screw_torque)
            for model in (by_oil, REFERENCE)
        ]
        return f"{torques[0] / torques[1]:.2f}"

    grades = {"m": "M100 paraffinic", "pao": "PAO 100"}
    return {
        "t_roelands_own": f"{known / own:.1f}",
        "t_roelands_grade": f"{known / of_grade:.0f}",
        "t_arana_vg_25": over_constant("ISO VG 100", 25),
        **{
            f"t_arana_{name}_{celsius}": over_constant(grade, celsius)
            for name, grade in grades.items()
            for celsius in (25, 60)
        },
    }


def _screw_turn(result) -> float:
    """Speed of the screw for an entrainment speed of one."""
    return float(result.screw_speed / result.entrainment_speed)


def _centre_distance():
    """Distance of the groove centres of the catalogue screw, m."""
    screw = CATALOGUE.screw
    return (screw.screw_conformity + screw.nut_conformity - 1) * screw.ball_diameter


def _film_at(celsius: float) -> str:
    oil = Lubricant.from_grade("ISO VG 100", temperature=celsius + 273.15)
    return f"{float(dataclasses.replace(CATALOGUE, oil=oil).result(REFERENCE).screw.film_parameter):.1f}"


def _percent(share) -> str:
    return f"{100 * float(share):.0f} %"
