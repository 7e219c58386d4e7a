"""The reference model against the contact integral: how far apart, and how much faster.

``python benchmarks/reference.py`` prints tables, and rates unless ``--no-speed``; ``--json`` one object. The cases are
random screws of a box (``box``), always the same for the same ``--seed``; all of them are used that can exist: balls
that fit, and at most the Hertz pressure at which balls keep a dent.
"""

from __future__ import annotations

import dataclasses
import functools
import json
import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np

import ballscrew as bs
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.friction.validity import LARGEST_PRESSURE
from ballscrew.physics.laws.ball_chain import ProportionalBallForce
from ballscrew.physics.laws.friction import ZhouHoeprich
from ballscrew.physics.solvers import slip
from ballscrew.physics.solvers.line_slip import line_slip
from ballscrew.physics.solvers.slip import curvature_slip
from ballscrew.questions.shared.text_tables import markdown_table
from harness import asked, in_turn, told
from oracles.contact_integral import ContactIntegral, contact_integral
from oracles.free_ball import BallResistances
from oracles.tractions import Coulomb

Numbers = np.ndarray[Any, np.dtype[np.float64]]
RPM = 2 * np.pi / 60
#: Friction of the first table, the same everywhere, and nothing else that resists.
DRY = 0.1


@dataclasses.dataclass(frozen=True)
class Box:
    """Random screws, oils and operating points, as arrays."""

    screw: BallScrew
    oil: bs.Lubricant
    axial_load: Numbers
    screw_speed: Numbers

    def one(self, i: int) -> BallScrew:
        """The screw of a case."""
        fields = {
            name: np.asarray(value) for name, value in vars(self.screw).items() if not isinstance(value, bs.Material)
        }
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", bs.ImplausibleInput)  # drawn from more than what is made
            return BallScrew(**{name: (value[i] if value.ndim else value).item() for name, value in fields.items()})


def box(size: int, seed: int) -> Box:
    """Loads 1 N to 50 kN, 0 to 5000 rpm, leads d_m/20 to d_m, conformities 0.505 to 0.56, angles 20° to 70°."""
    rng = np.random.default_rng(seed)

    def log_uniform(low: float, high: float) -> Numbers:
        return np.exp(rng.uniform(np.log(low), np.log(high), size))

    d_m = log_uniform(0.008, 0.15)
    d_w = d_m * rng.uniform(0.05, 0.2, size)
    lead = np.maximum(d_m * log_uniform(0.05, 1), 1.1 * d_w)
    screw = BallScrew(
        pitch_circle_diameter=d_m,
        lead=lead,
        ball_diameter=d_w,
        loaded_balls=rng.integers(10, 301, size).astype(float),
        contact_angle=np.radians(rng.uniform(20, 70, size)),
        screw_conformity=rng.uniform(0.505, 0.56, size),
        nut_conformity=rng.uniform(0.505, 0.56, size),
    )
    oil = bs.Lubricant(viscosity=log_uniform(0.005, 1))
    return Box(screw, oil, log_uniform(1, 5e4), rng.uniform(0, 5000, size) * RPM)


def dry(model: bs.FrictionModel) -> bs.FrictionModel:
    """A model whose slip is all that is left: the same friction everywhere, nothing else resists."""
    return dataclasses.replace(
        model,
        friction=ZhouHoeprich(boundary_friction_coefficient=DRY, full_film_friction_coefficient=DRY, decay=0.0),
        full_film=None,
        rolling=lambda conditions: 0 * conditions.contact_load,
        elastic_resistance=lambda conditions: 0 * conditions.contact_load,
        ball_force=ProportionalBallForce(0.0),
    )


def slip_torque(result: FrictionResult) -> Numbers:
    """Torque that the power of all slip asks for, creep included."""
    power = result.dissipation["curvature"] + result.dissipation["spin"] + result.dissipation["helix"]
    return power / result.screw_speed


def judge(cases: Box, result: FrictionResult, i: int, *, alone: bool) -> ContactIntegral:
    """The integral for a case, with the friction of the result; alone, or with all that resists a ball that rolls."""
    s, n = result.screw, result.nut
    share = float(np.broadcast_to(result.rolling_share, np.shape(result.contact_load))[i])
    traction = tuple(Coulomb(float(side.friction_coefficient[i])) for side in (s, n))
    carried = (
        s.hydrodynamic_rolling_force,
        n.hydrodynamic_rolling_force,
        s.elastic_resistance_moment,
        n.elastic_resistance_moment,
        result.ball_friction_moment,
        result.net_braking_force,
    )
    asked = (float(np.broadcast_to(part, np.shape(result.contact_load))[i]) / share for part in carried)
    return contact_integral(
        cases.one(i),
        float(result.contact_load[i]),
        (traction[0], traction[1]),
        resistances=BallResistances() if alone else BallResistances(*asked),
        screw_speed=float(cases.screw_speed[i]),
    )


def evaluate(model: bs.FrictionModel, cases: Box) -> FrictionResult:
    """A model at all cases."""
    return model(cases.screw, cases.oil, axial_load=cases.axial_load, screw_speed=cases.screw_speed)


def spread(error: Numbers) -> dict[str, float]:
    """Median, 95th percentile and largest of the absolute error, and the bias."""
    size = np.abs(error)
    ends = float(np.median(size)), float(np.percentile(size, 95)), float(np.max(size)), float(np.median(error))
    return dict(zip(("median", "p95", "largest", "bias"), ends, strict=True))


@dataclasses.dataclass(frozen=True)
class Table:
    """One comparison: errors by model, and what was left out."""

    title: str
    errors: Mapping[str, Numbers]
    notes: tuple[str, ...]

    def rows(self) -> list[dict[str, Any]]:
        """Errors by model."""
        return [{"model": name, "n": len(error), **spread(error)} for name, error in self.errors.items()]


def valid(result: FrictionResult) -> Numbers:
    """Where the case can exist: elastic contacts."""
    return np.asarray(
        (result.screw.maximum_pressure <= LARGEST_PRESSURE) & (result.nut.maximum_pressure <= LARGEST_PRESSURE)
    )


def left_out(elastic: Numbers) -> str:
    """How many cases cannot exist."""
    return f"{np.sum(~elastic)} of {len(elastic)} left out above {LARGEST_PRESSURE / 1e9:g} GPa"


def slip_alone(cases: Box) -> Table:
    """Slip of a ball that nothing else resists, dry friction."""
    reference = bs.FrictionModel.reference()
    models = {
        "curvature alone": dry(dataclasses.replace(reference, slip=curvature_slip)),
        "line law": dry(dataclasses.replace(reference, slip=line_slip)),
        "reference": dry(reference),
    }
    results = {name: evaluate(model, cases) for name, model in models.items()}
    exact = results["reference"]
    used = np.flatnonzero(valid(exact))
    integrals = [judge(cases, exact, i, alone=True) for i in used]
    found = np.array([integral.converged for integral in integrals])
    truth = np.array([integral.slip_torque for integral in integrals])[found]
    errors = {
        name: result.screw_torque[used][found] / result.ball_screw.loaded_balls[used][found] / truth - 1
        for name, result in results.items()
    }
    notes = (left_out(valid(exact)), f"{np.sum(~found)} without a balance")
    return Table(f"Slip torque, dry friction of {DRY:g}, nothing else resists", errors, notes)


def whole_model(cases: Box) -> tuple[Table, Table]:
    """Slip torque and friction torque of the reference model as it is, with all that resists the ball."""
    result = evaluate(bs.FrictionModel.reference(), cases)
    elastic = valid(result)
    rolls = np.asarray(result.rolling_share) == 1
    used = np.flatnonzero(elastic & rolls)
    integrals = [judge(cases, result, i, alone=False) for i in used]
    found = np.array([integral.converged for integral in integrals])
    z = result.ball_screw.loaded_balls[used][found]
    kept = [integral for integral in integrals if integral.converged]
    slip_errors = slip_torque(result)[used][found] / z / np.array([i.slip_torque for i in kept]) - 1
    torque_errors = result.screw_torque[used][found] / z / np.array([i.screw_torque for i in kept]) - 1
    skids = [judge(cases, result, i, alone=False) for i in np.flatnonzero(elastic & ~rolls)]
    notes = (
        left_out(elastic),
        f"{len(skids)} skid by the model, {sum(not i.converged for i in skids)} of them by the integral",
        f"{np.sum(~found)} skid by the integral alone",
    )
    return (
        Table("Slip torque of the whole model, creep included", {"reference": slip_errors}, notes),
        Table("Friction torque of the whole model", {"reference": torque_errors}, notes),
    )


def speed(size: int = 200_000) -> dict[str, float]:
    """Points a second of the reference model on plain arrays and in a sweep, and of the integral."""
    rng = np.random.default_rng(0)
    screw, oil = box(1, 7).one(0), bs.Lubricant(viscosity=0.1)
    F, n = rng.uniform(100, 5000, size), rng.uniform(0, 1000, size) * RPM
    model = bs.FrictionModel.reference()
    loads, speeds = np.sort(rng.uniform(100, 5000, 500)), np.sort(rng.uniform(0, 1000, 400)) * RPM
    few = (1.0, 3.0, 10.0, 30.0, 100.0)
    times = in_turn(
        {
            "arrays": lambda: model(screw, oil, axial_load=F, screw_speed=n).efficiency,
            "sweep": lambda: bs.sweep(model, screw, oil, axial_load=loads, screw_speed=speeds),
            "integral": lambda: [contact_integral(screw, load, Coulomb(DRY)) for load in few],
        },
        rounds=5,
    )
    points = {"arrays": size, "sweep": loads.size * speeds.size, "integral": len(few)}
    rates = {name: points[name] / float(np.median(taken)) for name, taken in times.items()}
    return {**rates, "ratio": rates["arrays"] / rates["integral"]}


@functools.cache
def compared(number: int = 600, seed: int = 2005) -> tuple[Table, ...]:
    """The tables of random screws."""
    cases = box(number, seed)
    return slip_alone(cases), *whole_model(cases)


def in_words(row: Mapping[str, Any]) -> list[str]:
    """Errors as the documentation shows them."""
    return [f"{row['median']:.2%}", f"{row['p95']:.2%}", f"{row['largest']:.1%}", f"{row['bias']:+.2%}"]


ERRORS = "median", "95 % within", "largest", "bias"


def as_markdown(table: Table) -> str:
    """A table for the documentation."""
    rows = [[row["model"], str(row["n"]), *in_words(row)] for row in table.rows()]
    title = f"**{table.title}** ({'; '.join(table.notes)})"
    return f"{title}\n\n{markdown_table(('slip law', 'cases', *ERRORS), rows)}"


def parts() -> dict[str, str]:
    """All tables, for the page on agreement."""
    return {"whole.md": "\n".join(map(as_markdown, compared()))}


def main() -> None:
    """Print what was asked for; ``--strips`` and ``--aligned`` are those of a contact."""
    options = asked(__doc__, cases=600, seed=2005, no_speed=False, strips=slip.NUMBER_OF_STRIPS, aligned=slip.ALIGNED)
    slip.STRIPS, slip.ALIGNED = slip.strips_of(options.strips), options.aligned
    tables = compared(options.cases, options.seed)
    rates = None if options.no_speed else speed()
    if options.json:
        listed = [{"title": t.title, "rows": t.rows(), "notes": t.notes} for t in tables]
        print(json.dumps({"tables": listed, "speed": rates}, indent=2))
        return
    print("\n".join(map(as_markdown, tables)))
    if rates:
        told({"points a second": rates}, False)


if __name__ == "__main__":
    main()
