"""The friction torque of nuts whose numbers are estimated, over that of the nuts as listed.

``python benchmarks/own_nut.py`` leaves numbers out of the 44 rows shipped and of 31 nuts of HIWIN's stock list (two
have ratings that do not go with their geometry), and prints the least and the largest ratio, as Markdown. The torque is
that of one nut body without preload at a tenth of the dynamic load rating, 10 rad/s and ISO VG 100 at 40 degC. How near
the estimates themselves are, each by rules that did not see its row, is held by tests/physics/sizing/test_own_nut.py.
"""

from __future__ import annotations

import dataclasses

import ballscrew as bs
from ballscrew.evidence.validation.rows import screw_of
from ballscrew.evidence.validation.sets import SETS
from ballscrew.files.tables.headings import YES
from ballscrew.physics.sizing.catalogue import CatalogueRow, printed_rows
from ballscrew.physics.sizing.own_nut import completed
from ballscrew.questions.shared.text_tables import markdown_table
from ballscrew.questions.validate.compute import shipped_rows

#: Rows whose ratings do not go with their geometry, as the head of the file says.
MISPRINTS = ("R25-4B2-FSW", "R32-8B1-OFSW")
OIL, MODEL = bs.Lubricant.from_grade("ISO VG 100", 313.15), bs.FrictionModel.reference()
#: What is no number of a screw is left out always.
KEPT = (
    "name", "nominal_diameter", "lead", "ball_diameter", "turns", "starts", "pitch_circle_diameter", "root_diameter",
    "dynamic_load_rating", "spacer_balls",
)  # fmt: skip
LEFT_OUT = {
    "ball diameter (C_a known)": ("ball_diameter",),
    "ball diameter and C_a": ("ball_diameter", "dynamic_load_rating"),
    "pitch circle": ("pitch_circle_diameter",),
    "root diameter": ("root_diameter",),
    "all of them but C_a": ("ball_diameter", "pitch_circle_diameter", "root_diameter"),
}


def stock() -> list[CatalogueRow]:
    """The nuts of HIWIN's stock list, which no rule here was fitted to."""
    return [
        dataclasses.replace(screw_of(values), spacer_balls=values["spacer_balls"] == YES)
        for values in shipped_rows(SETS["hiwin-stock"])
        if values["name"] not in MISPRINTS
    ]


def torque(row: CatalogueRow, *names: str) -> float:
    """Friction torque of one nut body without these numbers, N m."""
    listed = {name: getattr(row, name) for name in KEPT if name not in names}
    # a row keeps the groove that its root diameter has
    of = completed({name: value for name, value in listed.items() if value is not None}).row
    load = float(row.dynamic_load_rating or 0.0) / 10
    return float(MODEL(of.screw(), OIL, axial_load=load, screw_speed=10.0).screw_torque)


def table() -> str:
    """The table of docs/howto/catalogue.md."""
    sets = [[(row, torque(row)) for row in rows] for rows in (printed_rows(), stock())]
    lines: list[list[str]] = []
    for words, names in LEFT_OUT.items():
        ratios = [
            [torque(row, *names) / listed for row, listed in rows if any(getattr(row, name) for name in names)]
            for rows in sets
        ]
        lines.append([words, *(f"{min(each):.2f} to {max(each):.2f}" if each else "" for each in ratios)])
    return markdown_table(("left out", "shipped", "stock list"), lines)


if __name__ == "__main__":
    print(table(), end="")
