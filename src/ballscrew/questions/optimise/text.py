"""Text of an optimisation: one line for each member of the front."""

from __future__ import annotations

from collections.abc import Sequence

from ballscrew.basis import units
from ballscrew.basis.output.wrapping import aligned_beside, wrapped
from ballscrew.questions.optimise.compute import Member, Optimisation, Plan
from ballscrew.questions.optimise.design_model import OF_MODEL
from ballscrew.questions.optimise.design_space import VARIABLES, DesignSpace
from ballscrew.questions.select import text as selection
from ballscrew.questions.select.text import LABELS

_HEADINGS = {
    "pitch_circle_diameter": "pitch circle", "lead": "lead", "ball_diameter": "ball", "loaded_turns": "turns",
    "preload": "preload",
}  # fmt: skip
#: Share of a limit from which a check is named as one that decides.
_DECIDES = 0.9
#: Change from the search to the full model from which it is said.
_SAME = 1e-6


def title(found: Optimisation) -> str:
    """``need.toml: 24 of 100 designs on the front, 14000 evaluated``."""
    return (
        f"{found.need.name}: {found.space.nut} nut, {len(found.members)} of {len(found.front.designs)} designs on the "
        f"front, {found.evaluations} evaluated"
    )


def cost(plan: Plan) -> str:
    """``14000 designs, then at most 24 in full: some 11 s of a processor``: what it costs, before it starts."""
    designs = plan.rigid + plan.elastic
    return wrapped(f"{designs} designs, then at most {plan.members} in full: some {plan.seconds:.2g} s of a processor")


def text(found: Optimisation) -> str:
    """The front, by its first objective, and what is to be known of it."""
    if not found.members:
        lines = [
            title(found),
            "",
            "no design within the bounds passes all checks: relax the need, or widen [optimise.bounds]",
        ]
    else:
        lines = [title(found), "", *table(found.members, found.space)]
    quantile = found.space.options.quantile
    said = [*found.notes]
    if quantile is not None:
        said.append(f"q {quantile:g}: that quantile over the uncertain inputs, by the search; all else at their centre")
    change = {name: value for name, value in found.largest_change.items() if value > _SAME}
    if change:
        words = ", ".join(f"{LABELS[name]} {value:.2g}" for name, value in change.items())
        said.append(f"the full model differs from the search by shares of up to: {words}")
    spans = (
        f"{_HEADINGS[name]} {shown(name, low)} to {shown(name, high)}"
        for name, (low, high) in found.space.bounds.items()
    )
    said.append(f"within {', '.join(spans)}")
    said.append("these sizes are in no catalogue: ask a maker for the nearest, and run ballscrew check on that")
    return "\n".join([*lines, "", "notes", *(wrapped(f"  {line}") for line in said)])


def table(members: Sequence[Member], space: DesignSpace) -> list[str]:
    """A line for each: mark, variables, objectives with their quantiles, and what decides."""
    names, objectives, quantile = space.names, space.objectives, space.options.quantile
    with_quantile = () if quantile is None else tuple(name for name in objectives if name in OF_MODEL)
    heading = ["", *(_HEADINGS[name] for name in names), *(LABELS[name] for name in objectives)]
    heading += [*(f"{LABELS[name]}, q {quantile:g}" for name in with_quantile), "near its limit"]
    return aligned_beside([heading, *(_cells(each, names, objectives, with_quantile) for each in members)])


def _cells(found: Member, names: Sequence[str], objectives: Sequence[str], with_quantile: Sequence[str]) -> list[str]:
    return [
        "*" if found.pareto else "",
        *(shown(name, found.variables[name]) for name in names),
        *(selection.shown(name, found.objectives[name]) for name in objectives),
        *(selection.shown(name, found.searched[name]) for name in with_quantile),
        _limits(found),
    ]


def _limits(found: Member) -> str:
    near = [
        f"{'FAILS ' if check.holds is False else ''}{check.name.replace('_', ' ')} {check.utilisation:.1%}"
        for check in found.checks
        if check.holds is False or (check.utilisation is not None and check.utilisation > _DECIDES)
        if check.utilisation is not None
    ]
    others = [f"FAILS {c.name.replace('_', ' ')}" for c in found.checks if c.holds is False and c.utilisation is None]
    lost = ["the load takes the preload away"] if found.checked.nut.preload_is_lost else []
    words = ", ".join([*near, *others, *lost])
    return words if found.valid else f"{words}; outside the model's validity".removeprefix("; ")


def shown(name: str, value: float) -> str:
    """A variable in its display unit; a preload in per cent."""
    if name == "preload":
        return f"{100 * value:.3g} %"
    quantity = VARIABLES[name]
    return f"{value:.3g}" if quantity.unit == "1" else units.shown(value, quantity)
