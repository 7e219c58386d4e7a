"""The friction of two angular-contact ball bearings by the same contacts, beside the model of a bearing maker.

The maker's model is that of SKF2018 for the frictional moment (rolling, and sliding), with the constants of the series
72 B(E). Sizes are in millimetres, speeds in revolutions per minute, viscosities in mm²/s. What no catalogue states is
assumed: balls of 0.3 (D − d), a conformity of 0.52, the roughness of the paper.
"""

from __future__ import annotations

import dataclasses
import functools
import itertools
import math

import numpy as np
from matplotlib.figure import Figure

from ballscrew.axis.supports.bearing import SupportBearing
from ballscrew.axis.supports.makers_bearing import SKFBearing
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.laws.friction import LoadSharing, RunInSharing
from ballscrew.questions.shared import charts
from ballscrew.questions.shared.text_tables import markdown_table

DENSITY = 870.0
SPEEDS, VISCOSITIES, SHARES = (30.0, 100.0, 300.0, 1000.0, 3000.0), (20.0, 68.0, 200.0), (0.02, 0.05, 0.10)


@dataclasses.dataclass(frozen=True)
class Bearing:
    """A bearing: bore and outside diameter in mm, dynamic load rating in N."""

    name: str
    bore: float
    outside: float
    rating: float

    @property
    def mean(self) -> float:
        """Mean diameter."""
        return (self.bore + self.outside) / 2

    @property
    def sizes(self) -> dict[str, float]:
        """Sizes in metres, of one row."""
        return {"bore": 1e-3 * self.bore, "outside_diameter": 1e-3 * self.outside, "rows": 1}


BEARINGS = Bearing("7205 BE", 25, 52, 15_600), Bearing("7212 BE", 60, 110, 57_200)


@dataclasses.dataclass(frozen=True)
class Point:
    """Rolling and slip torques of both models at one point, N mm, and the film parameter of ours."""

    bearing: str
    speed: float
    viscosity: float
    share: float
    film_parameter: float
    ours: tuple[float, float]
    maker: tuple[float, float]


@functools.cache
def points(new: bool = False) -> tuple[Point, ...]:
    """All points: two bearings at 45 combinations of speed, viscosity and load; of surfaces run in, or new."""
    friction = LoadSharing() if new else RunInSharing()
    model = dataclasses.replace(FrictionModel.reference(), friction=friction)
    found: list[Point] = []
    for bearing, speed, viscosity, share in itertools.product(BEARINGS, SPEEDS, VISCOSITIES, SHARES):
        oil = Lubricant(viscosity=1e-6 * viscosity * DENSITY, density=DENSITY)
        state = OperatingState(share * bearing.rating, speed * math.pi / 30)
        balls = SupportBearing(contact_angle=math.radians(40), lubricant=oil, model=model, **bearing.sizes)(state)
        parts = {name: 1e3 * float(torque) for name, torque in balls.contributions.items()}
        ours = parts["hydrodynamic_rolling"] + parts["elastic_hysteresis"], parts["curvature"] + parts["spin"]
        printed = SKFBearing(lubricant=oil, **bearing.sizes)(state).contributions
        maker = 1e3 * float(printed["rolling"]), 1e3 * float(printed["sliding"])
        film_parameter = float(balls.balls.screw.film_parameter)
        found.append(Point(bearing.name, speed, viscosity, share, film_parameter, ours, maker))
    return tuple(found)


def _ratios(chosen: list[Point]) -> list[np.ndarray]:
    ours, maker = (np.array([getattr(point, name) for point in chosen]) for name in ("ours", "maker"))
    return [ours[:, 0] / maker[:, 0], ours[:, 1] / maker[:, 1], ours.sum(axis=1) / maker.sum(axis=1)]


def table() -> str:
    """Ratios of rolling, slip and total to those of the maker, by bearing and by film."""
    groups = {bearing.name: lambda p, name=bearing.name: p.bearing == name for bearing in BEARINGS}
    groups |= {
        "λ below 0.5": lambda p: p.film_parameter < 0.5,
        "λ from 0.5 to 2": lambda p: 0.5 <= p.film_parameter < 2,
        "λ above 2": lambda p: p.film_parameter >= 2,
        "n d_m above 50 000 mm/min": lambda p: p.speed * next(b.mean for b in BEARINGS if b.name == p.bearing) > 5e4,
    }
    lines: list[list[str]] = []
    for words, holds in groups.items():
        chosen = [i for i, point in enumerate(points()) if holds(point)]
        run_in, new = ([points(state)[i] for i in chosen] for state in (False, True))
        rolling, slip, total = _ratios(run_in)
        cells = (rolling, slip, _ratios(new)[1], total)
        spread = (f"{np.mean(each):.2f} ± {np.std(each, ddof=1):.2f}" for each in cells)
        lines.append([words, str(len(chosen)), *spread])
    heads = ("points", "number", "rolling", "slip", "slip, new surfaces", "total")
    return markdown_table(heads, lines, numbers=True)


def picture() -> Figure:
    """Ratios over the film parameter."""
    caption = (
        "Ratio of this model to that of SKF2018, bearings 7205 BE and 7212 BE, axial load 2, 5 and 10 % of C, "
        "20 to 200 mm²/s, 30 to 3000 rpm; geometry inside the bearings assumed."
    )
    figure, panels = charts.new_figure(caption, sharey=True)
    lam = np.array([point.film_parameter for point in points()])
    rolling, slip, _ = _ratios(list(points()))
    for panel, values, words in zip(np.ravel(panels), (rolling, slip), ("rolling", "slip"), strict=False):
        for bearing, marker in zip(BEARINGS, ("o", "s"), strict=True):
            own = np.array([point.bearing == bearing.name for point in points()])
            panel.plot(lam[own], values[own], marker, markersize=4, linestyle="none", label=bearing.name)
        panel.axhline(1.0, color=charts.GREY, linewidth=0.8)
        panel.set(xscale="log", xlabel="film parameter λ", title=words)
        panel.legend()
    np.ravel(panels)[0].set_ylabel("this model / bearing maker's")
    return figure
