"""What the page on the effects shows: its figures, its tables, and the numbers in its text."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ballscrew.analyses import effect_curves as curves
from ballscrew.analyses.effects import CASES, RPM, doubts, effects
from ballscrew.interfaces.figures import effect_laws, style
from ballscrew.interfaces.figures import effects as figures
from ballscrew.model import FrictionModel
from ballscrew.result import MECHANISMS


def write(folder: Path) -> None:
    """Figures as SVG and PNG, tables as Markdown."""
    folder.mkdir(parents=True, exist_ok=True)
    cases = figures.drawn_cases()
    with style.house_style():
        for plot in (*figures.PLOTS, *effect_laws.PLOTS):
            style.save(plot.draw(cases), folder, plot.name)
    for case in cases.values():
        (folder / f"steps_{case.name}.md").write_text(steps_table(case), encoding="utf-8")
    (folder / "doubts.md").write_text(doubts_table(), encoding="utf-8")


def steps_table(case) -> str:
    """The torque, its parts and the efficiency after each effect."""
    heading = ["with", "M_S (N m)", "added", *MECHANISMS.values(), "η", "µ_m at the screw"]
    rows = [
        [
            effect.words,
            f"{effect.torque:.4f}",
            _signed(effect.added) if i else "",
            *(f"{effect.parts[mechanism]:.4f}" for mechanism in MECHANISMS),
            f"{effect.efficiency:.4f}",
            f"{effect.friction_coefficient:.3f}",
        ]
        for i, effect in enumerate(effects(case))
    ]
    return _table([heading, ["---", *["---:"] * (len(heading) - 1)], *rows])


def doubts_table(rows: int | None = None) -> str:
    """What the reference model takes for granted, and how far the torque moves with it: all, or the widest."""
    every = {name: doubts(case) for name, case in CASES.items()}
    by_words = {name: {doubt.words: doubt for doubt in found} for name, found in every.items()}
    heading = ["what", "taken", "tried", *(case.title for case in CASES.values())]
    rows = [
        [first.words, first.taken, first.tried, *(_span(found[first.words]) for found in by_words.values())]
        for first in every["catalogue"][:rows]
    ]
    return _table([heading, ["---"] * len(heading), *rows])


def numbers() -> dict[str, str]:
    """What stands in the text between double braces."""
    found: dict[str, str] = {}
    steps = {name: effects(case) for name, case in CASES.items()}
    for i, key in enumerate(("rolling", "inlet", "sharing", "boundary", "spin", "ellipse", "helix"), start=1):
        found[key] = ", ".join(_step(steps[name], i, case.title) for name, case in CASES.items())
    reference, corrected = FrictionModel.reference(), FrictionModel.corrected()
    for name, case in CASES.items():
        r, c = case.result(reference), case.result(corrected)
        found[f"{name}_torque"] = f"{float(r.screw_torque):.3f}"
        found[f"{name}_corrected"] = f"{float(c.screw_torque):.3f}"
        found[f"{name}_efficiency"] = f"{float(r.efficiency):.3f}"
        found[f"{name}_spin_parameter"] = f"{effect_laws.half_spin_parameter(case):.2f}"
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
        found[f"{name}_light_efficiency"] = f"{float(case.result(reference, axial_load=1.0).efficiency):.2f}"
        _, steep = curves.over_lead(case)
        share = steep.contributions["helix"][-1] / steep.screw_torque[-1]
        found[f"{name}_steep"] = f"{float(share):.0%}".replace("%", " %")
    return found


#: Skidding is told at the speed of the case and at this one.
FAST = 3000


def light_loads(case) -> tuple[float, float, float]:
    """Axial loads (N) below which the film law is left, the ball skids, and the ball skids at the fast speed."""
    flagged = curves.largest_flagged_load
    return flagged(case, "elastic_regime"), flagged(case, "skid"), flagged(case, "skid", FAST * RPM)


def light_load_words(case) -> str:
    """The same in a sentence or two."""
    film, skid, fast = light_loads(case)
    a_ball = float(case.result(FrictionModel.reference()).contact_load) / case.axial_load
    return (
        f"At {case.title} and {case.screw_speed / RPM:.0f} rpm the film leaves the regime its law was made for below"
        f" {film:.0f} N on the nut ({film * a_ball:.1f} N a ball), and the ball skids below {skid:.0f} N"
        f" ({skid * a_ball:.1f} N a ball). Both loads grow with speed: at {FAST} rpm it skids below {fast:.0f} N."
    )


def _step(steps, i: int, title: str) -> str:
    percent = f"{steps[i].added / steps[i - 1].torque:+.1%}".replace("%", " %").replace("-", "−")
    return f"{_signed(steps[i].added)} N m ({percent}) at {title}"


def _signed(value: float) -> str:
    return f"{value:+.4f}".replace("-", "−")


def _span(doubt) -> str:
    low, high = (f"{100 * bound:+.0f}".replace("-", "−") for bound in (doubt.lowest, doubt.highest))
    return f"{low if doubt.lowest else '0'} to {high if doubt.highest else '0'} %"


def _table(lines) -> str:
    def rows() -> Iterator[str]:
        for line in lines:
            yield "| " + " | ".join(line) + " |\n"

    return "".join(rows())
