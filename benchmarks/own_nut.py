"""How far numbers that a catalogue does not print are from those estimated in their place, and the torque with them.

``python benchmarks/own_nut.py`` leaves each number out of the 44 rows shipped and of 31 nuts of HIWIN's stock list (two
have ratings that do not go with their geometry), and prints the estimate over the number: mean, standard deviation,
least and largest. The rule of lead and diameter is fitted anew for each row shipped, to the rows of other sizes; what
follows from the rating is fitted to none. The torque is the friction
torque of one nut body without preload at a tenth of the dynamic load rating, 600 rpm and ISO VG 100 at 40 degC, over
that of the row as listed.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable

import numpy as np

import ballscrew as bs
from ballscrew.evidence.validation.rows import screw_of
from ballscrew.evidence.validation.sets import SETS
from ballscrew.files.tables.headings import YES
from ballscrew.physics.sizing.catalogue import CatalogueRow, catalogue
from ballscrew.physics.sizing.own_nut import LARGEST_PITCH, OwnNut, completed
from ballscrew.physics.sizing.ratings import ratings_of
from ballscrew.questions.validate.compute import shipped_rows

#: Rows whose ratings do not go with their geometry, as the head of the file says.
MISPRINTS = ("R25-4B2-FSW", "R32-8B1-OFSW")
OIL = bs.Lubricant.from_grade("ISO VG 100", 313.15)
MODEL = bs.FrictionModel.reference()
Numbers = Iterable[float]


def stock() -> list[CatalogueRow]:
    """The nuts of HIWIN's stock list, which no rule here was fitted to."""
    return [
        dataclasses.replace(screw_of(values), spacer_balls=values["spacer_balls"] == YES)
        for values in shipped_rows(SETS["hiwin-stock"])
        if values["name"] not in MISPRINTS
    ]


def without(row: CatalogueRow, *names: str) -> OwnNut:
    """The nut of a row without these numbers, and without what is no number of a screw."""
    fields = {field.name: getattr(row, field.name) for field in dataclasses.fields(row)}
    kept = ("name", "nominal_diameter", "lead", "ball_diameter", "turns", "starts", "pitch_circle_diameter",
            "root_diameter", "dynamic_load_rating", "spacer_balls")  # fmt: skip
    return completed({name: fields[name] for name in kept if name not in names and fields[name] is not None})


def rule(rows: list[CatalogueRow]) -> tuple[float, float]:
    """Factor and exponent of the rule of lead and diameter, by least squares of the logarithms over these rows."""
    places = [min(row.lead / row.starts / row.nominal_diameter, LARGEST_PITCH) / LARGEST_PITCH for row in rows]
    sizes = np.log([row.ball_diameter / row.nominal_diameter for row in rows])
    found, *_ = np.linalg.lstsq(np.column_stack([np.ones(len(rows)), np.log(places)]), sizes, rcond=None)
    return float(np.exp(found[0])), float(found[1])


def left_out(rows: list[CatalogueRow]) -> list[float]:
    """Ball diameter by the rule of the rows of other sizes, over that of each row."""

    def one(row: CatalogueRow) -> float:
        def size(other: CatalogueRow) -> tuple[str, float, float]:
            return other.make, other.nominal_diameter, other.lead

        factor, exponent = rule([other for other in rows if size(other) != size(row)])
        place = min(row.lead / row.starts / row.nominal_diameter, LARGEST_PITCH) / LARGEST_PITCH
        return factor * row.nominal_diameter * place**exponent / row.ball_diameter

    return [one(row) for row in rows]


def torque(row: CatalogueRow, load: float) -> float:
    """Friction torque of one nut body at this load, N m."""
    return float(MODEL(row.screw(), OIL, axial_load=load, screw_speed=10.0).screw_torque)


def torques(rows: list[CatalogueRow], *names: str) -> Numbers:
    """Torque without these numbers over that of the row as listed."""
    for row in rows:
        assert row.dynamic_load_rating is not None
        load = row.dynamic_load_rating / 10
        # a row keeps the groove that its root diameter has
        yield torque(without(row, *names).row, load) / torque(without(row).row, load)


def main() -> None:
    """Print the table."""
    shipped, others = list(catalogue().values()), stock()
    listing = [row for row in shipped if row.pitch_circle_diameter]
    show("what is left out, estimate over number", "rows", ["mean", "sd", "least", "largest"])

    def line(what: str, numbers: Numbers) -> None:
        found = np.array(list(numbers))
        cells = (found.mean(), found.std(), found.min(), found.max())
        show(what, str(len(found)), [f"{number:.3f}" for number in cells])

    def ball(row: CatalogueRow, *names: str) -> float:
        return without(row, "ball_diameter", *names).row.ball_diameter / row.ball_diameter

    line("ball, by C_a: shipped", (ball(row) for row in shipped))
    line("ball, by C_a: stock", (ball(row) for row in others))
    line("ball, by C_a, no pitch circle: stock", (ball(row, "pitch_circle_diameter") for row in others))
    line("ball, by the rule of other rows: shipped", left_out(shipped))
    line("ball, by the rule: stock", (ball(row, "dynamic_load_rating") for row in others))
    line("pitch circle: those that list it", (r.nominal_diameter / r.ball_circle for r in [*listing, *others]))
    line("conformity 0.54 over that of the root", (0.54 / without(row).row.conformity for row in listing))
    line("C_a listed over that by geometry: shipped", ratios(shipped))
    line("C_a listed over that by geometry: stock", ratios(others))
    alone = (without(row, "ball_diameter").row.loaded_balls / row.loaded_balls for row in shipped)
    line("loaded balls without the ball: shipped", alone)
    sets = {"shipped": shipped, "stock": others}
    for what, names in {
        "ball (C_a known)": ("ball_diameter",),
        "ball and C_a": ("ball_diameter", "dynamic_load_rating"),
        "pitch circle": ("pitch_circle_diameter",),
        "root diameter": ("root_diameter",),
        "all of them but C_a": ("ball_diameter", "pitch_circle_diameter", "root_diameter"),
    }.items():
        for which, rows in sets.items():
            line(f"friction torque without {what}: {which}", torques(rows, *names))


def ratios(rows: list[CatalogueRow]) -> Numbers:
    """Dynamic load rating as listed over that by the geometry."""
    for row in rows:
        assert row.dynamic_load_rating is not None
        yield row.dynamic_load_rating / float(ratings_of(row).dynamic)


def show(what: str, count: str, cells: list[str]) -> None:
    """Print a line of the table."""
    print(f"{what:<48}{count:>5}", *(f"{cell:>8}" for cell in cells))


if __name__ == "__main__":
    main()
