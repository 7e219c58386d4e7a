"""The named calibrations, fitted once to the rows shipped.

``rexroth-2006-rubbing`` has one number, the force between balls in units of the load of a ball; ``rexroth-2006`` two,
that and the boundary friction coefficient. Least squares of (model − middle) / half the band over all no-load torques
of ``rexroth-double-nut`` (7 and 10 %) and ``rexroth-single-nut`` (5 %), all with the same weight.

Those of other makers are of one number, the force between balls; the torque of a nut without load is linear in it, so
least squares of model / stated − 1 have one step. ``hiwin`` is fitted on the rows of ``hiwin-stock`` that
``data/validation/splits.toml`` declares, ``jis`` on the rule of JIS B 1192 for the sizes of ``rexroth-double-nut`` and
its worked example: both are of nuts with two contacts a ball. Nothing else is fitted, and nothing by hand.

    python benchmarks/fit_calibration.py            print the fits
    python benchmarks/fit_calibration.py --write    and store them in src/ballscrew/data/calibrations.toml
    python benchmarks/fit_calibration.py --rivals   other numbers and another objective beside them, as Markdown
    python benchmarks/fit_calibration.py --left-out rows of one size class or of one kind of nut left out of the fit
                                                    and predicted, as Markdown; with --write into docs/left_out.inc
    python benchmarks/fit_calibration.py --maker-calibrations
                                                    the same of the other makers, into docs/maker_calibrations.inc
    python benchmarks/fit_calibration.py --strata   the ratios of each size class, as Markdown
    python benchmarks/fit_calibration.py --changes  the ratios of all makers with one assumption changed at a time, as
                                                    Markdown; with --write into docs/changes.inc
    python benchmarks/fit_calibration.py --trends   other laws of friction: mean ratio, scatter, and the exponents of
                                                    the ratio over diameter and lead, as Markdown
"""

from __future__ import annotations

import dataclasses
import functools
import json
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, cast

import numpy as np
from scipy.optimize import least_squares

import ballscrew
from ballscrew.evidence.validation.entries import Conditions, Entry, Point, Values, may_be_fitted, trends
from ballscrew.evidence.validation.rows import screw_of
from ballscrew.evidence.validation.sets import SETS
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.calibrations import PARAMETERS, calibrated, calibrations, with_parameters
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.laws.ball_chain import ChainBallForce, ProportionalBallForce, imposed_ball_force, two_neighbours
from ballscrew.physics.laws.conditions import ContactConditions
from ballscrew.physics.laws.friction import (
    BalanSharing,
    GreenwoodTrippSharing,
    LoadSharing,
    RunInSharing,
    arana_traction,
)
from ballscrew.physics.laws.inlet import Inlet, flooded_inlet
from ballscrew.physics.laws.nut_losses import ReturnBraking, ShearedOil, SpinUp
from ballscrew.questions.shared.text_tables import markdown_table
from ballscrew.questions.validate import compute
from harness import ROOT, asked

#: The sets that the calibrations are fitted to, and a column of each that is a maximum and no band.
FITTED = ("rexroth-double-nut", "rexroth-single-nut")
_MAXIMUM = "no_load_torque_2pct_max"
#: Ends of the size classes: nominal diameters in m.
CLASSES = {"up to 25 mm": (0.0, 0.0251), "32 to 50 mm": (0.0251, 0.0501), "63 mm and more": (0.0501, 1.0)}
#: A model for each row.
OfRow = Callable[[Values], FrictionModel]
REFERENCE = FrictionModel.reference()
OBJECTIVE = "least squares of (model - middle) / half the band, every row with the same weight"
START = (0.12, 0.0075)
DATA = ROOT / "src" / "ballscrew" / "data"


def points(name: str, model: OfRow) -> list[Point]:
    """The rows of a set against their bands, with a model for each."""
    found: list[Point] = []
    for row in compute.shipped_rows(SETS[name]):
        values = {column: value for column, value in row.items() if column != _MAXIMUM}
        found += [p for p in SETS[name].evaluate(model(values), values, Conditions()) if isinstance(p, Point)]
    return found


def entries(model: FrictionModel, on_four_contacts: FrictionModel | None = None) -> list[Entry]:
    """The two sets with one model, or one for each; without the rows that are told apart."""
    models = model, on_four_contacts or model
    return [
        Entry(data=SETS[name], model=of_set, calibration=None, points=points(name, lambda _, of_set=of_set: of_set))
        for name, of_set in zip(FITTED, models, strict=True)
    ]


class Nuts(NamedTuple):
    """A set with the reference model, and the preloaded screws of its points as one screw of arrays."""

    entry: Entry
    screws: BallScrew

    def torques(self, model: FrictionModel) -> np.ndarray[Any, Any]:
        """Torque of each point without load."""
        at = Conditions()
        return np.asarray(model(self.screws, at.lubricant, axial_load=0.0, screw_speed=at.screw_speed).screw_torque)


@functools.cache
def nuts() -> tuple[Nuts, ...]:
    """The nuts of the two sets: a fit asks for all of them hundreds of times, and so at once."""
    asked: list[BallScrew] = []

    def model(screw: BallScrew, oil: Lubricant, *, axial_load: float, screw_speed: float) -> FrictionResult:
        if axial_load == 0:
            asked.append(screw)
        return REFERENCE(screw, oil, axial_load=axial_load, screw_speed=screw_speed)

    sets = entries(cast("FrictionModel", model))
    screws = iter(asked)
    return tuple(Nuts(entry, _together([next(screws) for _ in entry.points])) for entry in sets)


def _together(screws: Sequence[BallScrew]) -> BallScrew:
    """One screw, whose numbers are arrays where those of the screws differ."""
    numbers = {field.name: [getattr(screw, field.name) for screw in screws] for field in dataclasses.fields(BallScrew)}
    nut = numbers.pop("nut")[0]
    preload = np.array([screw.nut.preload for screw in screws])
    arrays = {name: np.array(values) for name, values in numbers.items() if any(one != values[0] for one in values)}
    return dataclasses.replace(screws[0], **arrays, nut=dataclasses.replace(nut, preload=preload))


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

    def models(self, *numbers: float) -> tuple[FrictionModel, FrictionModel]:
        """The models of the two sets with these numbers."""
        return self.model(*numbers), (self.on_four_contacts or self.model)(*numbers)

    def entries(self, *numbers: float) -> list[Entry]:
        """The two sets with these numbers."""
        return entries(*self.models(*numbers))


def declared(boundary: float, share: float) -> FrictionModel:
    """The reference model with the two numbers."""
    return with_parameters(REFERENCE, boundary, share)


def rubbing(share: float) -> FrictionModel:
    """The reference model with one number."""
    return declared(BOUNDARY, share)


def _of_one_pair(boundary: float, share: float) -> FrictionModel:
    return declared(boundary, share / 2)


def _frictions(boundary: float, full_film: float) -> FrictionModel:
    return _with_full_film(REFERENCE, boundary, full_film)


def _thin(boundary: float, share: float) -> FrictionModel:
    return _with_full_film(declared(boundary, share), boundary, 0.02)


def _as_new(boundary: float, share: float) -> FrictionModel:
    return dataclasses.replace(declared(boundary, share), friction=LoadSharing(boundary))


def _braking(boundary: float, share: float) -> FrictionModel:
    return dataclasses.replace(declared(boundary, share), ball_chain=two_neighbours)


def _with_full_film(model: FrictionModel, boundary: float, full_film: float) -> FrictionModel:
    friction: Any = model.friction
    changed = dataclasses.replace(
        friction, boundary_friction_coefficient=boundary, full_film_friction_coefficient=full_film
    )
    return dataclasses.replace(model, friction=changed)


def _boundary_alone(boundary: float) -> FrictionModel:
    return _with_full_film(REFERENCE, boundary, REFERENCE.friction.full_film_friction_coefficient)  # type: ignore[attr-defined]  (the slot is a protocol)


BOTH = ("µ₀", "F_B/Q")
BOUNDARY = float(RunInSharing().boundary_friction_coefficient)
#: What is stored, by name.
DECLARED = {
    "rexroth-2006-rubbing": Rival("F_B/Q alone", BOTH[1:], START[1:], rubbing),
    "rexroth-2006": Rival("µ₀ and F_B/Q", BOTH, START, declared),
}
FIELDS = dict(zip(BOTH, PARAMETERS, strict=True))
RIVALS = (
    *(rival._replace(words=f"declared: {rival.words}") for rival in DECLARED.values()),
    Rival("µ₀ and F_B/Q, least squares of model / middle − 1", BOTH, START, declared, relative),
    Rival("the same with a full-film friction of 0.02", BOTH, START, _thin),
    Rival("the same with surfaces as new", BOTH, START, _as_new),
    Rival("the same with a net braking force F_B beside the rubbing", BOTH, (0.12, 0.001), _braking),
    Rival(
        "the same, with the load of one flank pair on four contacts", BOTH, START, declared, in_half_bands, _of_one_pair
    ),
    Rival("µ₀ and full-film friction µ_f", ("µ₀", "µ_f"), (0.12, 0.05), _frictions),
    Rival("µ₀ alone", ("µ₀",), (0.12,), _boundary_alone),
)


class Fit(NamedTuple):
    """Outcome of a fit."""

    values: np.ndarray[Any, Any]
    covariance: np.ndarray[Any, Any]
    rows: int
    cost: float


def fit(rival: Rival, kept: Callable[[Entry, Point], bool] = lambda *_: True) -> Fit:
    """Least squares; the covariance is that of the linear model at the end, of what is not at its bound."""

    def residuals(x: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
        return np.array(
            [
                rival.residual(dataclasses.replace(point, value=float(torque)))
                for one, model in zip(nuts(), rival.models(*map(float, x)), strict=True)
                for point, torque in zip(one.entry.points, one.torques(model), strict=True)
                if kept(one.entry, point)
            ]
        )

    scale = np.array(rival.start)
    found = least_squares(
        residuals, scale, x_scale=scale, bounds=(0, np.inf), diff_step=1e-4, xtol=1e-8, ftol=1e-10, gtol=1e-10
    )
    n, cost = found.fun.size, float(found.fun @ found.fun)
    variance = cost / (n - found.x.size)
    return Fit(found.x, variance * np.linalg.pinv(found.jac.T @ found.jac), n, cost)


# -- makers ------------------------------------------------------------------------------------------


class Row(NamedTuple):
    """A row of a fit: its name and what it is like, the value stated, and the torque as a line over the number."""

    name: str
    group: str
    size: float
    lead: float
    stated: float
    start: float
    slope: float

    def ratio(self, share: float) -> float:
        """Model over stated."""
        return (self.start + self.slope * share) / self.stated


class Line(NamedTuple):
    """The number of a fit, its variance, the rows, and the sum of squares that is left."""

    share: float
    variance: float
    rows: Sequence[Row]
    cost: float


class MakerFit(NamedTuple):
    """A calibration of one maker: whose it is, the files with its rows, the rows, and what they state."""

    maker: str
    sets: Sequence[str]
    rows: Callable[[], Sequence[Row]]
    stated: str = "of declared rows"
    declared_rows: bool = False

    @property
    def objective(self) -> str:
        """What was least."""
        return f"least squares of model / stated - 1 {self.stated}, every row with the same weight"


def _points_at(name: str, share: float) -> Mapping[str, Point]:
    data, model = SETS[name], rubbing(share)
    found = [point for row in compute.shipped_rows(data) for point in data.evaluate(model, row, data.conditions)]
    return {point.name: point for point in found}


def _rows(name: str, stated: Callable[[Point], float], kept: Callable[[Point], bool]) -> list[Row]:
    none, some = _points_at(name, 0.0), _points_at(name, START[1])
    return [
        Row(
            point.name,
            point.group,
            point.descriptors["size"],
            point.descriptors["lead"],
            stated(point),
            point.value,
            (some[point.name].value - point.value) / START[1],
        )
        for point in none.values()
        if kept(point)
    ]


def hiwin_rows(declared: bool = True) -> list[Row]:
    """Double and offset nuts of HIWIN's stock list: those that are fitted, or those kept aside."""
    return _rows(
        "hiwin-stock",
        lambda point: point.band.middle,
        lambda point: point.group in ("double", "offset") and may_be_fitted("hiwin-stock", point) == declared,
    )


def jis_rows() -> list[Row]:
    """The rule of JIS B 1192 for the sizes and preloads of Rexroth's double nuts, and its worked example."""

    def by_rule(point: Point) -> float:
        return point.laws["jis"] * point.band.middle

    return [
        *_rows("rexroth-double-nut", by_rule, lambda _: True),
        *_rows("thk-jis", lambda point: point.band.middle, lambda _: True),
    ]


MAKERS: Mapping[str, MakerFit] = {
    "hiwin": MakerFit("HIWIN", ("hiwin-stock",), hiwin_rows, declared_rows=True),
    # of Rexroth's nuts the sizes and preloads alone
    "jis": MakerFit("THK", ("rexroth-double-nut", "thk-jis"), jis_rows, "of the rule of JIS B 1192"),
}


def line_of(rows: Sequence[Row]) -> Line:
    """The least-squares fit of rows; the variance is that of one number."""
    x = np.array([row.slope / row.stated for row in rows])
    y = np.array([1 - row.start / row.stated for row in rows])
    share = float(x @ y / (x @ x))
    left = x * share - y
    cost = float(left @ left)
    return Line(share, cost / max(len(rows) - 1, 1) / float(x @ x), rows, cost)


def _left_out_of_maker(name: str, rows: Sequence[Row]) -> list[list[str]]:
    """Rows left out of a fit and predicted by it: kind by kind, half of the sizes, half of the leads."""
    size, lead = (float(np.median([getattr(row, key) for row in rows])) for key in ("size", "lead"))
    groups: dict[str, Callable[[Row], bool]] = {
        f"diameters above {1000 * size:g} mm": lambda row: row.size > size,
        f"diameters up to {1000 * size:g} mm": lambda row: row.size <= size,
        f"leads above {1000 * lead:g} mm": lambda row: row.lead > lead,
        f"leads up to {1000 * lead:g} mm": lambda row: row.lead <= lead,
        **{f"{kind} nuts": lambda row, kind=kind: row.group == kind for kind in dict.fromkeys(r.group for r in rows)},
    }
    lines: list[list[str]] = []
    for words, group in groups.items():
        kept, out = [row for row in rows if not group(row)], [row for row in rows if group(row)]
        if len(kept) > 1 and out:
            lines.append([name, words, f"{line_of(kept).share:.3g}", *_predicted(out, line_of(kept).share)])
    return lines


def _predicted(rows: Sequence[Row], share: float) -> list[str]:
    ratios = [row.ratio(share) for row in rows]
    scatter = f" ± {np.std(ratios, ddof=1):.2f}" if len(ratios) > 1 else ""
    return [str(len(rows)), f"{np.mean(ratios):.2f}{scatter}"]


def makers_table() -> str:
    """What each calibration predicts of rows that were left out of the fit, as Markdown."""
    heading = ["calibration", "left out", "F_B/Q of the fit", "rows", "predicted / stated"]
    lines: list[list[str]] = []
    for name, fit in MAKERS.items():
        rows = fit.rows()
        lines += _left_out_of_maker(name, rows)
        if fit.declared_rows:
            share = line_of(rows).share
            lines.append([name, "the rows kept aside", f"{share:.3g}", *_predicted(hiwin_rows(declared=False), share)])
    return markdown_table(heading, lines)


# -- other laws and other assumptions: no number is fitted -------------------------------------------


@dataclasses.dataclass(frozen=True)
class ConstantShare:
    """Asperities carry the same share of the load at any film."""

    share: float

    def __call__(self, conditions: ContactConditions) -> Any:
        """Friction coefficient."""
        return 0.12 * self.share + 0.05 * (1 - self.share) + 0 * conditions.film_parameter


@dataclasses.dataclass(frozen=True)
class CappedShare:
    """The share of ZhouHoeprich1991, but no more than a cap: no rise of friction at rest."""

    cap: float

    def __call__(self, conditions: ContactConditions) -> Any:
        """Friction coefficient."""
        share = np.minimum(np.exp(-1.42 * conditions.film_parameter**0.8), self.cap)
        return 0.12 * share + 0.05 * (1 - share)


def weighting_factor(screw: BallScrew, conditions: Conditions) -> float:
    r"""Share of the boundary friction by SKF2018 in a rolling bearing as large as the pitch circle.

    .. math:: \phi_{bl} = \exp\left(-2.6 \cdot 10^{-8} (n \nu)^{1.4} d_m\right)

    with rpm, mm²/s and mm.
    """
    oil = conditions.lubricant
    viscosity, speed = 1e6 * oil.viscosity / oil.density, conditions.screw_speed * 30 / math.pi
    return math.exp(-2.6e-8 * (speed * viscosity) ** 1.4 * 1e3 * screw.pitch_circle_diameter)


def with_friction(law: Any) -> OfRow:
    """The reference model with this law of friction."""
    model = dataclasses.replace(REFERENCE, friction=law)
    return lambda _: model


def _by_weighting_factor(values: Values) -> FrictionModel:
    share = weighting_factor(screw_of(values).screw(), Conditions().of(values))
    return dataclasses.replace(REFERENCE, friction=ConstantShare(share))


def _of_0_1(_: Values) -> FrictionModel:
    """The reference model of version 0.1."""
    return dataclasses.replace(
        REFERENCE,
        inlet=Inlet(replenishment_constant=0.0),
        friction=LoadSharing(full_film_friction_coefficient=0.02),
        ball_chain=two_neighbours,
        ball_force=imposed_ball_force,
    )


LAWS: Mapping[str, OfRow] = {
    "the reference model of 0.1": _of_0_1,
    "as new: ZhouHoeprich1991 with B, C = 1.42, 0.8": with_friction(LoadSharing()),
    **{
        f"the same with {B:g}, {C:g}": with_friction(LoadSharing(decay=B, exponent=C))
        for B, C in ((2.32, 0.97), (1.90, 0.99), (2.1, 0.85), (1.42, 0.2), (1.42, 0.4), (1.42, 0.6))
    },
    "Balan2015": with_friction(BalanSharing()),
    "GreenwoodTripp1970": with_friction(GreenwoodTrippSharing()),
    "weighting factor of SKF2018": _by_weighting_factor,
    "a constant share of 0.35": with_friction(ConstantShare(0.35)),
    "a share of 0.35 at most": with_friction(CappedShare(0.35)),
    **{
        f"run in, λ_r = {worn:g}{' (the default)' if worn == RunInSharing().run_in_film_parameter else ''}":
        with_friction(RunInSharing(run_in_film_parameter=worn)) for worn in (0.4, 0.5, 0.6, 0.7, 0.8, 1.0)
    },
}  # fmt: skip


def trends_table() -> str:
    """Mean ratio, scatter and trends of each law, as Markdown: ratio ∝ d₀ ^ exponent, and P_h/d₀ ^ exponent."""
    of_set = ("mean ratio", "over d₀", "over P_h/d₀")
    lines = [["friction", *(f"{name}: {words}" for name in FITTED for words in of_set)]]
    for words, model in LAWS.items():
        cells: list[str] = []
        for name in FITTED:
            found = points(name, model)
            exponents = {trend.descriptor: trend.exponent for trend in trends(found)}
            cells.append(_judged(found)[0])
            cells += [f"{exponents[each]:+.2f}".replace("-", "−") for each in ("size", "steepness")]
        lines.append([words, *cells])
    return markdown_table(lines[0], lines[1:])


class _OfNuts:
    """A model that is asked for each nut as ``changed`` makes it."""

    def __init__(self, model: FrictionModel, changed: Callable[[BallScrew], BallScrew]) -> None:
        self._model, self._changed = model, changed

    def __call__(self, screw: BallScrew, oil: Lubricant, **operation: Any) -> FrictionResult:
        return self._model(self._changed(screw), oil, **operation)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._model, name)


def of_nuts(model: FrictionModel, changed: Callable[[BallScrew], BallScrew]) -> FrictionModel:
    """The model, asked for nuts that are changed before."""
    return cast("FrictionModel", _OfNuts(model, changed))


def set_at_rest(screw: BallScrew) -> BallScrew:
    """The screw with a preload that was set at rest, where its nut has two contacts a ball."""
    nut: Any = screw.nut
    return dataclasses.replace(screw, nut=dataclasses.replace(nut, set_at_rest=True)) if nut.halves == 2 else screw


#: Turns of a circuit and of its return, assumed for all nuts.
TURNS_OF_A_CIRCUIT, TURNS_IN_RETURN = 2.5, 0.5


def with_moving_balls(screw: BallScrew) -> BallScrew:
    """The screw with a preload set at rest, returns to push, sheared oil and balls to spin up: all of it assumed."""
    balls_of_a_turn = math.pi * float(screw.pitch_circle_diameter / screw.ball_diameter)
    circuits = screw.nut.halves * max(1, round(float(screw.loaded_balls) / balls_of_a_turn / TURNS_OF_A_CIRCUIT))
    losses = {
        "recirculation": ReturnBraking(return_balls=round(TURNS_IN_RETURN * balls_of_a_turn), returns=circuits),
        "sheared_oil": ShearedOil(oil_share=1.0),
        "spin_up": SpinUp(entries=circuits, lost_speed=0.0),
    }
    nut: Any = dataclasses.replace(screw.nut, losses={**screw.nut.losses, **losses})
    return set_at_rest(dataclasses.replace(screw, nut=nut))


_CHAIN = dataclasses.replace(REFERENCE, ball_force=ChainBallForce())
_JAMMED = dataclasses.replace(REFERENCE, ball_force=ChainBallForce(gap=0.0))
#: One assumption of the reference model changed at a time, by words.
CHANGES: Mapping[str, FrictionModel] = {
    "as it is": REFERENCE,
    "film by the oil's own limit (arana)": dataclasses.replace(REFERENCE, full_film=arana_traction),
    "film friction 0.035, the limit of PAO": dataclasses.replace(
        REFERENCE, friction=RunInSharing(full_film_friction_coefficient=0.035)
    ),
    "film friction 0.053, of naphthenic oil": dataclasses.replace(
        REFERENCE, friction=RunInSharing(full_film_friction_coefficient=0.053)
    ),
    "boundary friction 0.06, of fresh surfaces": dataclasses.replace(REFERENCE, friction=RunInSharing(0.06)),
    "a full bath of oil": dataclasses.replace(REFERENCE, inlet=flooded_inlet),
    "force between balls 0.0005 Q, a fill with gaps": dataclasses.replace(
        REFERENCE, ball_force=ProportionalBallForce(0.0005)
    ),
    "law of the chain, a gap of half a ball": _CHAIN,
    "law of the chain, no gap": _JAMMED,
    "preload set at rest, balls off their line": of_nuts(REFERENCE, set_at_rest),
    "set at rest, law of the chain": of_nuts(_CHAIN, set_at_rest),
    "the same with returns, sheared oil and spin-up": of_nuts(_CHAIN, with_moving_balls),
    "calibration rexroth-2006": calibrated(REFERENCE, calibrations()["rexroth-2006"]),
    "calibration hiwin": calibrated(REFERENCE, calibrations()["hiwin"]),
    "calibration jis": calibrated(REFERENCE, calibrations()["jis"]),
}


def changes_table() -> str:
    """Mean ratio and scatter of each set and kind of nut with one change at a time, as Markdown."""
    lines: list[list[str]] = []
    for words, model in CHANGES.items():
        groups: dict[str, list[float]] = {}
        for name in (*FITTED, "hiwin-stock", "thk-jis"):
            data = SETS[name]
            for row in compute.shipped_rows(data):
                for point in data.evaluate(model, row, data.conditions):
                    groups.setdefault(f"{data.maker}, {point.group}", []).append(point.ratio)
        if not lines:
            lines = [["change", *(f"{group} ({len(ratios)})" for group, ratios in groups.items())]]
        scatters = {group: f" ± {np.std(r, ddof=1):.2f}" if len(r) > 1 else "" for group, r in groups.items()}
        lines.append([words, *(f"{np.mean(ratios):.2f}{scatters[group]}" for group, ratios in groups.items())])
    return markdown_table(lines[0], lines[1:])


def strata_table() -> str:
    """Mean ratio, scatter and share in band of the rows of each size, as they are and calibrated, as Markdown."""
    models = {"uncalibrated": REFERENCE}
    models |= {name: calibrated(REFERENCE, one) for name, one in calibrations().items()}
    lines = [["rows", "number", *models]]
    for name in FITTED:
        found = [points(name, lambda _, model=model: model) for model in models.values()]
        for words, (low, high) in {**CLASSES, "all": (0.0, math.inf)}.items():
            strata = [[point for point in of_model if low <= point.descriptors["size"] < high] for of_model in found]
            lines.append([f"{name}, {words}", str(len(strata[0])), *map(", ".join, map(_judged, strata))])
    return markdown_table(lines[0], lines[1:])


def _judged(found: Sequence[Point]) -> tuple[str, str]:
    """Mean ratio with its scatter, and the share in the band."""
    ratios, share = [point.ratio for point in found], np.mean([bool(point.in_band) for point in found])
    return f"{np.mean(ratios):.3f} ± {np.std(ratios, ddof=1):.3f}", f"{share:.0%}".replace("%", " %")


# -- what is stored, and tables -----------------------------------------------------------------------


class Stored(NamedTuple):
    """A fit with all that is stored of it."""

    maker: str
    contacts_per_ball: Sequence[int]
    symbols: Sequence[str]
    fit: Fit
    objective: str
    sets: Sequence[str]
    declared_rows: bool = False


def stored(found: Mapping[str, Fit]) -> dict[str, Stored]:
    """All calibrations: those of Rexroth's tables, then one number for each of other makers."""
    every = {
        name: Stored("Rexroth", (2, 4), DECLARED[name].names, one, OBJECTIVE, FITTED) for name, one in found.items()
    }
    for name, of_maker in MAKERS.items():
        line = line_of(of_maker.rows())
        fit = Fit(np.array([line.share]), np.array([[line.variance]]), len(line.rows), line.cost)
        every[name] = Stored(
            of_maker.maker, (2,), BOTH[1:], fit, of_maker.objective, of_maker.sets, of_maker.declared_rows
        )
    return every


def toml_text(found: Mapping[str, Fit]) -> str:
    """The calibrations as they are stored."""
    lines = ["# Fitted by a command and stored as it came out; nothing here is typed by hand."]
    for name, kept in stored(found).items():
        one, fitted = kept.fit, [FIELDS[symbol] for symbol in kept.symbols]
        values = dict(zip(PARAMETERS, (BOUNDARY, START[1]), strict=True)) | dict(zip(fitted, one.values, strict=True))
        rows = ", ".join("[" + ", ".join(f"{number:.6e}" for number in row) + "]" for row in one.covariance.tolist())
        lines += [
            f"[{name}]",
            'model = "reference"',
            f'maker = "{kept.maker}"',
            "# the kinds of nut that it was fitted to, by the contacts of a ball",
            f"contacts_per_ball = {json.dumps(kept.contacts_per_ball)}",
            *(f"{field} = {value:.9g}" for field, value in values.items()),
            f"fitted = {json.dumps(fitted)}",
            "# covariance of what was fitted, in that order",
            f"covariance = [{rows}]",
            f"rows = {one.rows}",
            f"cost = {one.cost:.6f}",
            f'objective = "{kept.objective}"',
            f'version = "{ballscrew.__version__}"',
            'command = "python benchmarks/fit_calibration.py --write"',
            *(["declared_rows = true"] if kept.declared_rows else []),
            "",
            f"[{name}.data]",
            *(f'"{SETS[one].file}" = "{compute.fingerprint(SETS[one].file)}"' for one in kept.sets),
            "",
        ]
    return "\n".join(lines[:-1]) + "\n"


def _of_class(low: float, high: float) -> Callable[[Entry, Point], bool]:
    return lambda _, point: low <= point.descriptors["size"] < high


def left_out_table() -> str:
    """Rows left out of a fit and predicted by it, class by class and kind by kind."""
    groups: dict[str, Callable[[Entry, Point], bool]] = {name: _of_class(*ends) for name, ends in CLASSES.items()}
    groups |= {f"all of {name}": lambda entry, _, name=name: entry.data.name == name for name in FITTED}
    heading = ["left out", "calibration", "values of the fit without it", "rows", "predicted: mean ratio", "in band"]
    lines: list[list[str]] = []
    for words, group in groups.items():
        for name, rival in DECLARED.items():
            found = fit(rival, lambda entry, point, group=group: not group(entry, point))
            sets = rival.entries(*map(float, found.values))
            for entry in sets:
                told = [point for point in entry.points if group(entry, point)]
                if told:
                    values = ", ".join(f"{n} = {_shown(v)}" for n, v in zip(rival.names, found.values, strict=True))
                    told_of = f"{words}, {entry.data.name}" if words in CLASSES else words
                    lines.append([told_of, name, values, str(len(told)), *_judged(told)])
    return markdown_table(heading, lines)


def _shown(value: float) -> str:
    """Three digits; a number at its bound is one step of the search above it, which differs between machines."""
    return f"{value:.3g}" if value > 1e-9 else "0"


def ratios_text(found: Mapping[str, Fit]) -> str:
    """Model / middle of the band, row by row, as it is stored for :mod:`ballscrew.evidence.validation.entries`."""
    models = {"uncalibrated": REFERENCE}
    models |= {name: DECLARED[name].model(*map(float, one.values)) for name, one in found.items()}
    by_model = {name: [(e, p) for e in entries(model) for p in e.points] for name, model in models.items()}
    lines = [
        "# reference model / middle of the vendor's band; no load, 100 rpm, ISO VG 100 at 25 degC; sizes in m",
        f"# written by: python benchmarks/fit_calibration.py --write, version {ballscrew.__version__}",
        ",".join(["set", "row", "size", "lead", *models]),
    ]
    for together in zip(*by_model.values(), strict=True):
        entry, point = together[0]
        place = [f"{point.descriptors[name]:.6g}" for name in ("size", "lead")]
        lines.append(",".join([entry.data.name, point.name, *place, *(f"{p.ratio:.4f}" for _, p in together)]))
    return "\n".join(lines) + "\n"


def rivals_table() -> str:
    """What other pairs and another objective would have given."""
    heading = ["fitted", "values", *(f"{name}: mean ratio, in band" for name in FITTED), "half bands off, rms"]
    lines: list[list[str]] = []
    for rival in RIVALS:
        found = fit(rival)
        sets = rival.entries(*map(float, found.values))
        errors = np.sqrt(np.diag(found.covariance))
        values = ", ".join(
            f"{name} = {_shown(value)} ± {error:.1g}"
            for name, value, error in zip(rival.names, found.values, errors, strict=True)
        )
        off = [in_half_bands(point) for entry in sets for point in entry.points]
        judged = [f"{e.mean_ratio:.3f} ± {e.std_ratio:.3f}, {e.share_in_band:.0%}".replace("%", " %") for e in sets]
        lines.append([rival.words, values, *judged, f"{np.sqrt(np.mean(np.square(off))):.3f}"])
    return markdown_table(heading, lines)


#: Tables by the flag that prints them; the last three are stored in ``docs`` with ``--write``.
TABLES: dict[str, Callable[[], str]] = {
    "rivals": rivals_table,
    "strata": strata_table,
    "trends": trends_table,
    "left_out": left_out_table,
    "changes": changes_table,
    "maker_calibrations": makers_table,
}
STORED = "left_out", "changes", "maker_calibrations"


def main() -> None:
    """Print, and store what was asked for."""
    options = asked(__doc__, write=False, **dict.fromkeys(TABLES, False))
    if name := next((name for name in TABLES if getattr(options, name)), None):
        text = TABLES[name]()
        files = {ROOT / "docs" / f"{name}.inc": text} if name in STORED else {}
    else:
        found = {name: fit(rival) for name, rival in DECLARED.items()}
        text = toml_text(found)
        files = {DATA / "calibrations.toml": text, DATA / "validation" / "ratios.csv": ratios_text(found)}
    print(text, end="")
    for path, content in files.items() if options.write else ():
        path.write_text(content, encoding="utf-8")


if __name__ == "__main__":
    main()
