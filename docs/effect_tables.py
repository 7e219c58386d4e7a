"""Figures, tables and numbers of the page on the effects."""

from __future__ import annotations

import functools
from typing import Any

from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.questions.shared.text_tables import markdown_table
from effect_study import curves
from effect_study import effect_figures as figures
from effect_study.cases import CASES, CATALOGUE, PAPER, RPM, effects, sensitivities


def parts() -> dict[str, Any]:
    """Figures, and tables as Markdown."""
    return {
        **{f"{name}.svg": functools.partial(draw, CASES) for name, draw in figures.DRAWN.items()},
        **{f"steps_{case.name}.md": steps_table(case) for case in CASES.values()},
        "sensitivities.md": sensitivity_table(),
    }


def steps_table(case) -> str:
    """The torque, its parts and the efficiency after each effect."""
    heading = ["with", "M_S (N m)", "change", *MECHANISMS.values(), "η", "µ_m at the screw"]
    rows = [
        [
            effect.description,
            f"{effect.torque:.4f}",
            _signed(effect.added) if i else "",
            *(f"{effect.parts[mechanism]:.4f}" for mechanism in MECHANISMS),
            f"{effect.efficiency:.4f}",
            f"{effect.friction_coefficient:.3f}",
        ]
        for i, effect in enumerate(effects(case))
    ]
    return markdown_table(heading, rows, numbers=True)


def sensitivity_table() -> str:
    """Assumptions of the reference model, and the change of the torque with each."""
    every = {name: sensitivities(case) for name, case in CASES.items()}
    by_name = {name: {one.description: one for one in found} for name, found in every.items()}
    heading = ["assumption", "default", "alternatives", *(case.title for case in CASES.values())]
    rows = [
        [
            first.description,
            first.default,
            first.alternatives,
            *(_span(found[first.description]) for found in by_name.values()),
        ]
        for first in every["catalogue"]
    ]
    return markdown_table(heading, rows)


def numbers() -> dict[str, str]:
    """The numbers in the text of the pages, by their names there."""
    found: dict[str, str] = {}
    steps = {name: effects(case) for name, case in CASES.items()}
    reference, corrected = FrictionModel.reference(), FrictionModel.corrected()
    for name, case in CASES.items():
        r, c = case.result(reference), case.result(corrected)
        found[f"{name}_torque"] = f"{float(r.screw_torque):.3f}"
        found[f"{name}_corrected"] = f"{float(c.screw_torque):.3f}"
        found[f"{name}_spin_parameter"] = f"{figures.half_spin_parameter(case):.2f}"
        found[f"{name}_spin_screw"] = f"{float(r.screw.spin_parameter):.2f}"
        found[f"{name}_spin_nut"] = f"{float(r.nut.spin_parameter):.2f}"
        before = steps[name][4].parts["curvature"]
        slip = sum(steps[name][-1].parts[part] for part in ("curvature", "spin", "helix"))
        found[f"{name}_slip_ratio"] = f"{slip / before:.1f}"
        found[f"{name}_heating"] = f"{float(r.screw.inlet_film_factor):.3f}"
        found[f"{name}_film"] = f"{float(r.screw.film_parameter):.2f}"
        skid, fast = light_loads(case)[1:]
        found[f"{name}_skid"] = f"{skid:.0f}"
        found[f"{name}_skid_ball"] = f"{skid / case.axial_load * float(r.contact_load):.1f}"
        found[f"{name}_skid_fast"] = f"{fast:.0f}"
        _, steep = curves.over_lead(case)
        share = steep.contributions["helix"][-1] / steep.screw_torque[-1]
        found[f"{name}_steep"] = f"{float(share):.0%}".replace("%", " %")
    regime = light_loads(PAPER)[0]
    a_ball = float(PAPER.result(reference).contact_load) / PAPER.axial_load
    found |= {"paper_regime": f"{regime:.0f}", "paper_regime_ball": f"{regime * a_ball:.1f}"}
    found["catalogue_light_efficiency"] = f"{float(CATALOGUE.result(reference, axial_load=1.0).efficiency):.2f}"
    return found


#: Speed (rpm) of the second load at which skidding starts.
FAST = 3000


def light_loads(case) -> tuple[float, float, float]:
    """Axial loads (N) below which the film law is left, the ball skids, and the ball skids at the fast speed."""
    flagged = curves.largest_flagged_load
    return flagged(case, "elastic_regime"), flagged(case, "skid"), flagged(case, "skid", FAST * RPM)


def _signed(value: float) -> str:
    return f"{value:+.4f}".replace("-", "−")


def _span(sensitivity) -> str:
    low, high = (f"{100 * bound:+.0f}".replace("-", "−") for bound in (sensitivity.lowest, sensitivity.highest))
    return f"{low if sensitivity.lowest else '0'} to {high if sensitivity.highest else '0'} %"
