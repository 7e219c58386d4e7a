"""The named calibration ``rexroth-2006``, fitted once to the rows shipped.

Two numbers: the boundary friction coefficient, and the ball-to-ball force in units of the load of a ball. Least squares
of (model − middle) / half the band over all no-load torques of ``rexroth-double-nut`` (7 and 10 %) and
``rexroth-single-nut`` (5 %), all with the same weight. Nothing else is fitted, and nothing by hand.

    python benchmarks/fit_calibration.py            print the fit
    python benchmarks/fit_calibration.py --write    and store it in src/ballscrew/data/calibrations.toml
    python benchmarks/fit_calibration.py --rivals   other pairs and another objective beside it, as Markdown
"""

from __future__ import annotations

import argparse
import dataclasses
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import least_squares

import ballscrew
from ballscrew.friction.calibrations import PARAMETERS, with_parameters
from ballscrew.friction.model import FrictionModel
from ballscrew.studies import validation
from ballscrew.validation.entries import Conditions, Entry, Point
from ballscrew.validation.sets import SETS

NAME = "rexroth-2006"
FITTED = ("rexroth-double-nut", "rexroth-single-nut")
OBJECTIVE = "least squares of (model - middle) / half the band, every row with the same weight"
START = (0.12, 0.001)
TOML = Path(__file__).parents[1] / "src" / "ballscrew" / "data" / "calibrations.toml"


def entries(model: FrictionModel, on_four_contacts: FrictionModel | None = None) -> list[Entry]:
    """The two sets with one model, or one for each; without the rows that are told apart."""
    found: list[Entry] = []
    models = model, on_four_contacts or model
    for data, model in zip(map(SETS.__getitem__, FITTED), models, strict=True):
        rows = [
            {name: value for name, value in row.items() if name != "no_load_torque_2pct_max"}
            for row in validation.shipped_rows(data)
        ]
        points = [point for row in rows for point in data.evaluate(model, row, Conditions())]
        found.append(Entry(data=data, model=model, calibration=None, points=points))
    return found


def points(sets: Sequence[Entry]) -> list[Point]:
    """All rows of the two sets."""
    return [point for entry in sets for point in entry.points]


def in_half_bands(point: Point) -> float:
    """The declared objective."""
    assert point.deviation is not None
    return point.deviation


def relative(point: Point) -> float:
    """Another one: model / middle − 1."""
    return point.ratio - 1


class Rival(NamedTuple):
    """Numbers to fit, how they make a model, and what is to be least."""

    words: str
    names: tuple[str, ...]
    start: tuple[float, ...]
    model: Callable[..., FrictionModel]
    residual: Callable[[Point], float] = in_half_bands
    #: The model for balls on four contacts where it is another.
    on_four_contacts: Callable[..., FrictionModel] | None = None

    def entries(self, *numbers: float) -> list[Entry]:
        """The two sets with these numbers."""
        other = None if self.on_four_contacts is None else self.on_four_contacts(*numbers)
        return entries(self.model(*numbers), other)


def declared(boundary: float, share: float) -> FrictionModel:
    """The reference model with the two numbers."""
    return with_parameters(FrictionModel.reference(), boundary, share)


def _of_one_pair(boundary: float, share: float) -> FrictionModel:
    return declared(boundary, share / 2)


def _frictions(boundary: float, full_film: float) -> FrictionModel:
    return _with_full_film(FrictionModel.reference(), boundary, full_film)


def _thick(boundary: float, share: float) -> FrictionModel:
    return _with_full_film(declared(boundary, share), boundary, 0.05)


def _with_full_film(model: FrictionModel, boundary: float, full_film: float) -> FrictionModel:
    friction: Any = model.friction
    changed = dataclasses.replace(
        friction, boundary_friction_coefficient=boundary, full_film_friction_coefficient=full_film
    )
    return dataclasses.replace(model, friction=changed)


def _boundary_alone(boundary: float) -> FrictionModel:
    reference = FrictionModel.reference()
    return _with_full_film(reference, boundary, reference.friction.full_film_friction_coefficient)  # type: ignore[attr-defined]  (the slot is a protocol)


def _share_alone(share: float) -> FrictionModel:
    return declared(0.12, share)


BOTH = ("µ₀", "F_B/Q")
DECLARED = Rival("declared: µ₀ and F_B/Q", BOTH, START, declared)
RIVALS = (
    DECLARED,
    Rival("the same, least squares of model / middle − 1", BOTH, START, declared, relative),
    Rival("the same with a full-film friction of 0.05", BOTH, START, _thick),
    Rival(
        "the same, with the load of one flank pair on four contacts", BOTH, START, declared, in_half_bands, _of_one_pair
    ),
    Rival("µ₀ and full-film friction µ_f", ("µ₀", "µ_f"), (0.12, 0.05), _frictions),
    Rival("µ₀ alone", ("µ₀",), (0.12,), _boundary_alone),
    Rival("F_B/Q alone", ("F_B/Q",), (0.001,), _share_alone),
)


class Fit(NamedTuple):
    """Outcome of a fit."""

    values: np.ndarray[Any, Any]
    covariance: np.ndarray[Any, Any]
    rows: int
    cost: float


def fit(rival: Rival) -> Fit:
    """Least squares; the covariance is that of the linear model at the end, with the variance of the residuals."""

    def residuals(x: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
        return np.array([rival.residual(point) for point in points(rival.entries(*map(float, x)))])

    scale = np.array(rival.start)
    found = least_squares(
        residuals, scale, x_scale=scale, bounds=(0, np.inf), diff_step=1e-4, xtol=1e-8, ftol=1e-10, gtol=1e-10
    )
    n, cost = found.fun.size, float(found.fun @ found.fun)
    variance = cost / (n - found.x.size)
    return Fit(found.x, variance * np.linalg.inv(found.jac.T @ found.jac), n, cost)


def toml_text(found: Fit) -> str:
    """The calibration as it is stored."""
    (a, b), (c, d) = found.covariance.tolist()
    lines = [
        "# Fitted by a command and stored as it came out; nothing here is typed by hand.",
        f"[{NAME}]",
        'model = "reference"',
        *(f"{name} = {value:.9g}" for name, value in zip(PARAMETERS, found.values, strict=True)),
        "# covariance of the two, in their order",
        f"covariance = [[{a:.6e}, {b:.6e}], [{c:.6e}, {d:.6e}]]",
        f"rows = {found.rows}",
        f"cost = {found.cost:.6f}",
        f'objective = "{OBJECTIVE}"',
        f'version = "{ballscrew.__version__}"',
        'command = "python benchmarks/fit_calibration.py --write"',
        "",
        f"[{NAME}.data]",
        *(f'"{SETS[name].file}" = "{validation.fingerprint(SETS[name].file)}"' for name in FITTED),
    ]
    return "\n".join(lines) + "\n"


def rivals_table() -> str:
    """What other pairs and another objective would have given."""
    heading = ["fitted", "values", *(f"{name}: mean ratio, in band" for name in FITTED), "half bands off, rms"]
    lines = [heading, ["---"] * len(heading)]
    for rival in RIVALS:
        found = fit(rival)
        sets = rival.entries(*map(float, found.values))
        errors = np.sqrt(np.diag(found.covariance))
        values = ", ".join(
            f"{name} = {value:.3g} ± {error:.1g}"
            for name, value, error in zip(rival.names, found.values, errors, strict=True)
        )
        off = [in_half_bands(point) for entry in sets for point in entry.points]
        judged = [f"{e.mean_ratio:.3f} ± {e.std_ratio:.3f}, {e.share_in_band:.0%}".replace("%", " %") for e in sets]
        lines.append([rival.words, values, *judged, f"{np.sqrt(np.mean(np.square(off))):.3f}"])
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def main(arguments: Sequence[str] | None = None) -> None:
    """Print, and store what was asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true", help="store the fit in data/calibrations.toml")
    parser.add_argument("--rivals", action="store_true", help="other pairs beside it, as Markdown")
    chosen = parser.parse_args(arguments)
    if chosen.rivals:
        print(rivals_table(), end="")
        return
    text = toml_text(fit(DECLARED))
    print(text, end="")
    if chosen.write:
        TOML.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
