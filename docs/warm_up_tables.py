"""What warms up and by how much: the coupled table with the real nut, its bands, and what a cooled nut does.

All tables take a minute. The screw is that of the shipped row
``rexroth-40x10x6-6-double`` with a preload of 3.5 kN, ISO VG 100, to and fro over half a metre of a shaft of 1.2 m
without a load, in air of 20 °C. Columns take effects in one after the other:

- *nothing*: the friction of the start, for ever.
- *oil*: the oil becomes thinner, the preload stays.
- *oil and preload*: both, which is what ``ballscrew warm-up`` computes.
- *cooled nut*: the same, with 80 W/K from the nut to its surroundings in place of 10 W/K.

*None* is where there is no steady state with the oil below 120 °C and the preload below four times that set.
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np

import ballscrew as bs
from ballscrew.axis.duty_cycle.duty import Duty
from ballscrew.axis.thermal.friction_map import FrictionMap
from ballscrew.axis.thermal.network import Network, network_of
from ballscrew.axis.thermal.surroundings import Surroundings
from ballscrew.axis.thermal.warm_up import equilibrium
from ballscrew.axis.thermal.warm_up_band import WarmUpBand
from ballscrew.questions.shared.text_tables import markdown_table

SPEEDS, PRELOAD, STROKE = (500, 1500, 3000), 3500.0, 0.5
#: From the nut to its surroundings, W/K: bolted to a table, and on a cooled plate.
BOLTED, COOLED = 10.0, 80.0
AIR = Surroundings(shaft_length=1.2, nut_conductance=BOLTED)
VARIANTS = ("nothing", "oil", "oil and preload", "cooled nut")
#: The band.
SAMPLES, SEED = 256, 20


def duty(rpm: float) -> Duty:
    """To and fro without a load."""
    screw = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=bs.DoubleNut(preload=PRELOAD))
    oil = bs.Lubricant.from_grade("ISO VG 100", AIR.ambient)
    speed = rpm * math.tau / 60
    return bs.to_and_fro(bs.FrictionModel.reference(), screw, oil, axial_load=0.0, screw_speed=speed, stroke=STROKE)


def network(rpm: float, variant: str = VARIANTS[2], **changes: float) -> Network:
    """The network of a duty, with effects left out as the variant says."""
    if variant == "cooled nut":
        changes = {"nut_conductance": COOLED, **changes}
    found = network_of(duty(rpm), dataclasses.replace(AIR, **changes))
    if variant in VARIANTS[:2]:
        found = dataclasses.replace(found, approach_per_kelvin=0.0)
    if variant == "nothing":
        start = found.friction.at(float(AIR.ambient), PRELOAD)
        temperatures = found.friction.temperatures
        friction = FrictionMap(temperatures, np.zeros(1), np.full((temperatures.size, 1), start))
        found = dataclasses.replace(found, friction=friction)
    return found


def results(found: Network, rpm: float) -> dict[str, float]:
    """Numbers of the steady state; NaN where there is none."""
    end = equilibrium(found)
    return {
        "nut": end.nut_temperature - 273.15,
        "excess": float(found.of_excess @ end.temperatures),
        "growth": 1e6 * end.growth,
        "preload": end.preload,
        "torque": end.power / (rpm * math.tau / 60),
        "margin": end.margin,
    }


def bands(rpm: float, variant: str, samples: int = SAMPLES) -> WarmUpBand:
    """Bands of the steady state, with what is the least known drawn from its usual distribution."""
    where = dataclasses.replace(AIR, nut_conductance=COOLED if variant == "cooled nut" else BOLTED)
    return bs.warm_up_band(duty(rpm), where, samples=samples, seed=SEED, outputs=2)


def table_of_effects() -> str:
    """The coupled table: nut, growth, preload and torque by what is taken in."""
    rows = [[f"{rpm} rpm", *(_cell(results(network(rpm, v), rpm)) for v in VARIANTS)] for rpm in SPEEDS]
    return markdown_table(("speed", *VARIANTS), rows, numbers=True)


def _cell(one: dict[str, float]) -> str:
    if math.isnan(one["nut"]):
        return f"none, margin {one['margin']:.2f}"
    return f"{one['nut']:.1f} °C, {one['growth']:.0f} µm, {one['preload']:.0f} N, {one['torque']:.2f} N m"


def table_of_bands() -> str:
    """Bands of the coupled numbers, and the share of samples without a steady state."""
    lines: list[list[str]] = []
    for rpm in SPEEDS:
        for variant in VARIANTS[2:]:
            found = bands(rpm, variant)
            cells = [
                f"{scale * low - zero:.{digits}f} to {scale * high - zero:.{digits}f} {unit}"
                for name, unit, digits, scale, zero in (
                    ("nut_temperature", "°C", 0, 1.0, 273.15),
                    ("growth", "µm", 0, 1e6, 0.0),
                    ("preload", "N", 0, 1.0, 0.0),
                    ("screw_torque", "N m", 2, 1.0, 0.0),
                )
                for low, high in [found.steady[name]]
            ]
            kind = "bolted" if variant == VARIANTS[2] else "cooled"
            lines.append([f"{rpm} rpm", kind, *cells, f"{1 - found.steady_share:.0%}"])
    return markdown_table(("speed", "nut", "nut", "growth", "preload", "torque", "none"), lines, numbers=True)


def table_of_cooling() -> str:
    """What the cooling of the nut alone does, for a weak and a strong contact with the shaft."""
    lines: list[list[str]] = []
    for rpm in SPEEDS:
        middle = network(rpm).ball_conductance
        for cooling in (2.0, BOLTED, 40.0, COOLED):
            cells: list[str] = []
            for factor in (1.0, 3.0, 1 / 3):
                one = results(network(rpm, nut_conductance=cooling, ball_conductance=factor * middle), rpm)
                cells.append("none" if math.isnan(one["nut"]) else f"{one['preload']:.0f} N")
            lines.append([f"{rpm} rpm", f"{cooling:g} W/K", *cells])
    heads = (f"preload, {which}" for which in ("middle", "balls × 3", "balls / 3"))
    return markdown_table(("speed", "from the nut", *heads), lines, numbers=True)


def tables() -> dict[str, str]:
    """All tables by the names of their files."""
    return {"effects.md": table_of_effects(), "bands.md": table_of_bands(), "cooling.md": table_of_cooling()}
