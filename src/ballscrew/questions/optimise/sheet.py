"""The sheet of an optimisation: the members of the front, what is to be known of them, and how they go along it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.output.sheet import (
    Axis,
    Cell,
    Cells,
    Chart,
    Colour,
    Columns,
    Curve,
    Line,
    Lines,
    Number,
    Share,
    Sheet,
    Table,
    columns_of,
    lines,
    warning_lines,
)
from ballscrew.basis.output.text import wrapped
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.questions.check.sheet import cells
from ballscrew.questions.optimise.compute import Member, Optimisation, Plan, warnings
from ballscrew.questions.optimise.design_model import OF_MODEL, VARIABLES
from ballscrew.questions.select.requirements import OBJECTIVES
from ballscrew.questions.select.sheet import LABELS, asked

_HEADINGS = {
    "pitch_circle_diameter": "pitch circle",
    "lead": "lead",
    "ball_diameter": "ball",
    "loaded_turns": "turns",
    "preload": "preload",
}
_PRELOAD = Quantity("preload_share", "1", Info("", "preload / C_a"))
_DIGITS = 3
#: Share of a limit from which a check is named as one that decides.
_DECIDES = 0.9
#: Change from the search to the full model from which it is said.
_SAME = 1e-6


def sheet(optimisation: Optimisation) -> Sheet:
    """All that people see of an optimisation."""
    nothing = "no design within the bounds passes all checks: relax the need, or widen [optimise.bounds]"
    members = optimisation.members
    return Sheet(
        title(optimisation),
        [
            Lines([] if members else [Line(nothing, "verdict", is_bad=True)]),
            warning_lines(warnings(optimisation)),
            *([_front(optimisation)] if members else []),
            lines(f"note: {note}" for note in _notes(optimisation)),
            Lines([Line(", ".join(asked(optimisation.need)), "small")], detail=True),
            *_charts(optimisation),
            of_optimisation(members),
        ],
    )


def title(optimisation: Optimisation) -> str:
    """``need.toml: single nut, 24 of 100 designs on the front, 14000 evaluated``."""
    return (
        f"{optimisation.need.name}: {optimisation.space.nut} nut, {len(optimisation.members)} of "
        f"{len(optimisation.front.designs)} designs on the front, {optimisation.evaluations} evaluated"
    )


def cost(plan: Plan) -> str:
    """``14000 designs, then at most 24 in full: some 11 s of a processor``: what it costs, before it starts."""
    designs = plan.rigid + plan.elastic
    return wrapped(f"{designs} designs, then at most {plan.members} in full: some {plan.seconds:.2g} s of a processor")


def _notes(optimisation: Optimisation) -> Iterator[str]:
    yield from optimisation.notes
    space = optimisation.space
    if space.options.quantile is not None:
        quantile = f"q {space.options.quantile:g}"
        yield f"{quantile}: that quantile over the uncertain inputs, by the search; all else at their centre"
    change = {name: value for name, value in optimisation.largest_change.items() if value > _SAME}
    if change:
        shares = ", ".join(f"{LABELS[name]} {value:.2g}" for name, value in change.items())
        yield f"the full model differs from the search by shares of up to: {shares}"
    ends = {name: [_shown(name, value) for value in bounds] for name, bounds in space.bounds.items()}
    spans = (f"{_HEADINGS[name]} {low} to {high}" for name, (low, high) in ends.items())
    yield f"within {', '.join(spans)}"
    yield "these sizes are in no catalogue: ask a maker for the nearest, and run ballscrew check on that"


def _shown(name: str, value: float) -> str:
    """A variable in its display unit; a preload in per cent."""
    if name == "preload":
        return f"{100 * value:.3g} %"
    return f"{value:.3g}" if VARIABLES[name].unit == "1" else units.shown(value, VARIABLES[name])


def _front(optimisation: Optimisation) -> Table:
    """A row for each member: variables, objectives with their quantiles, and what decides."""
    space = optimisation.space
    quantile = space.options.quantile
    with_quantile = () if quantile is None else tuple(name for name in space.objectives if name in OF_MODEL)
    rows: list[Sequence[Cell]] = []
    for place, member in enumerate(optimisation.members, start=1):
        objectives = [(name, member.objectives[name]) for name in space.objectives]
        objectives += [(name, member.searched[name]) for name in with_quantile]
        rows.append(
            [
                f"{'*' if member.pareto else ' '} {place}",
                *(_variable(name, member.variables[name]) for name in space.names),
                *(Number(value, OBJECTIVES[name].quantity, _DIGITS) for name, value in objectives),
                _limits(member),
            ]
        )
    headings = ["", *(_HEADINGS[name] for name in space.names), *(LABELS[name] for name in space.objectives)]
    headings += [*(f"{LABELS[name]}, q {quantile:g}" for name in with_quantile), "near its limit"]
    return Table("front", "design", headings, rows, ["*: no other one is better in all objectives by the full model"])


def _variable(name: str, value: float) -> Cell:
    if name == "preload":
        return Share(value, bar=False)
    return Number(value, VARIABLES[name], _DIGITS if VARIABLES[name].unit == "1" else 4)


def _limits(member: Member) -> str:
    """The checks that are near their limits, or beyond them."""
    near = [
        f"{'FAILS ' if check.holds is False else ''}{check.name.replace('_', ' ')} {check.utilisation:.1%}"
        for check in member.checks
        if check.holds is False or (check.utilisation is not None and check.utilisation > _DECIDES)
        if check.utilisation is not None
    ]
    failing = [check for check in member.checks if check.holds is False and check.utilisation is None]
    others = [f"FAILS {check.name.replace('_', ' ')}" for check in failing]
    lost = ["the load takes the preload away"] if member.checked.nut.preload_is_lost else []
    text = ", ".join([*near, *others, *lost])
    return text if member.valid else f"{text}; outside the model's validity".removeprefix("; ")


# -- files ----------------------------------------------------------------------------------------


def of_optimisation(members: Sequence[Member]) -> Columns:
    """The free variables and the objectives of each member, and what ``ballscrew check --to`` writes of a screw."""
    return columns_of("screws", lambda: (_cells(member) for member in members))


def _cells(member: Member) -> Cells:
    values: dict[str, tuple[Any, Any]] = {"holds": (int(member.holds), None), "pareto": (int(member.pareto), None)}
    for name, value in member.variables.items():
        if name == "preload":
            values["preload share [%]"] = (100 * value, None)
        else:
            values[VARIABLES[name].name] = (value, VARIABLES[name])
    for name, objective in OBJECTIVES.items():
        if name != "price_index":
            values[objective.quantity.name] = (member.objectives[name], objective.quantity)
    for check in member.checks:
        values[f"{check.name.replace('_', ' ')} utilisation"] = (check.utilisation, None)
    return {**values, **cells(member.checked)}


# -- charts ---------------------------------------------------------------------------------------


def _charts(optimisation: Optimisation) -> Iterator[Chart]:
    """The other objectives and the free variables along the first objective."""
    names = optimisation.space.objectives
    x, *others = names
    axis = Axis(OBJECTIVES[x].quantity.info.meaning, OBJECTIVES[x].quantity)
    places = {name: OBJECTIVES[name].sign * optimisation.front.costs[:, i] for i, name in enumerate(names)}
    for name in others or [x]:
        search = Curve("search", places[x], places[name], "sky", "dots")
        up = Axis(OBJECTIVES[name].quantity.info.meaning, OBJECTIVES[name].quantity)
        members = list(_members(optimisation, x, lambda member, n=name: member.objectives[n]))
        yield Chart(f"{LABELS[name]} against {LABELS[x]}", axis, up, [search, *members])
    for name in optimisation.space.bounds:
        quantity = _PRELOAD if name == "preload" else VARIABLES[name]
        along = Axis(quantity.info.meaning, quantity)
        yield Chart(_HEADINGS[name], axis, along, list(_members(optimisation, x, lambda m, n=name: m.variables[n])))


def _members(optimisation: Optimisation, x: str, value: Callable[[Member], float]) -> Iterator[Curve]:
    """The members as they are by the full model."""
    groups: Sequence[tuple[str, Colour, Sequence[Member]]] = (
        ("fails", "grey", [member for member in optimisation.members if not member.fits]),
        ("holds", "blue", [member for member in optimisation.members if member.fits and not member.pareto]),
        ("front by the full model", "red", [member for member in optimisation.members if member.pareto]),
    )
    for name, colour, members in groups:
        if members:
            places = np.array([member.objectives[x] for member in members])
            yield Curve(name, places, np.array([value(member) for member in members]), colour, "circles")
