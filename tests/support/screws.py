"""Ball screws by the numbers in which they differ from an ordinary one, 40×10 mm."""

import math
from typing import Any

import ballscrew as bs

#: Steel with the equivalent modulus of the contact integral that was computed elsewhere, 2.26e11 Pa.
STEEL = bs.Material(young_modulus=2.26e11 * (1 - 0.3**2), poisson_ratio=0.3)
OF_STEEL = {"ball_material": STEEL, "screw_material": STEEL, "nut_material": STEEL}


def screw(**changes: Any) -> bs.BallScrew:
    """The ordinary screw with these changes."""
    ordinary = {
        "pitch_circle_diameter": 0.040,
        "lead": 0.010,
        "ball_diameter": 6e-3,
        "loaded_balls": 60,
        "contact_angle": math.pi / 4,
        "screw_conformity": 0.54,
        "nut_conformity": 0.54,
    }
    return bs.BallScrew(**ordinary | changes)


def with_grooves(conformity: float, **changes: Any) -> bs.BallScrew:
    """The same with grooves alike in screw and nut."""
    return screw(screw_conformity=conformity, nut_conformity=conformity, **changes)


def of_row(row: dict[str, float]) -> bs.BallScrew:
    """One ball of the screw of a row of ``data/contact_integral.json``."""
    sizes = {name: row[name] for name in ("pitch_circle_diameter", "lead", "ball_diameter")}
    return with_grooves(row["conformity"], loaded_balls=1, **sizes, **OF_STEEL)
