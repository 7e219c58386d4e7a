"""Screws, oils and operating points to try the laws on: everything that is sold, and a little more."""

import dataclasses
import math

import numpy as np
from hypothesis import strategies as st

import ballscrew as bs
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.laws.ball_chain import imposed_ball_force, opposed_neighbours, two_neighbours

RPM = math.pi / 30

MODELS = {
    "olaru2005": bs.FrictionModel.olaru2005(),
    "corrected": bs.FrictionModel.corrected(),
    "reference": bs.FrictionModel.reference(),
}
all_models = st.sampled_from(sorted(MODELS)).map(MODELS.get)
both_models = st.sampled_from(["corrected", "olaru2005"]).map(MODELS.get)
#: Those in which action is reaction, and all power in is dissipated.
balanced_models = st.sampled_from(["corrected", "reference"]).map(MODELS.get)
corrected = MODELS["corrected"]
olaru2005 = MODELS["olaru2005"]
reference = MODELS["reference"]


def floats(low: float, high: float) -> st.SearchStrategy[float]:
    """Finite numbers in an interval."""
    return st.floats(low, high, allow_nan=False, allow_infinity=False, allow_subnormal=False)


def powers(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers spread evenly over the orders of magnitude of an interval."""
    return floats(math.log(low), math.log(high)).map(math.exp)


@st.composite
def screws(draw: st.DrawFn) -> bs.BallScrew:
    """Any ball screw: pitch circles of 10 to 125 mm, fine and steep leads, grooves wide and close."""
    starts = draw(st.integers(1, 4))
    lead_ratio = draw(floats(max(1 / 20, 0.066 * starts), 1.0))
    room = lead_ratio * math.cos(math.atan(lead_ratio / math.pi)) / starts
    d_m = draw(floats(0.010, 0.125))
    materials = st.builds(bs.Material, floats(1.9e11, 3.2e11), floats(0.24, 0.32))
    conformities, roughnesses = floats(0.505, 0.56), floats(0.05e-6, 0.6e-6)
    return bs.BallScrew(
        pitch_circle_diameter=d_m,
        lead=d_m * lead_ratio,
        ball_diameter=d_m * draw(floats(0.06, min(0.25, 0.98 * room))),
        loaded_balls=draw(st.integers(5, 300)),
        contact_angle=math.radians(draw(floats(20, 70))),
        screw_conformity=draw(conformities),
        nut_conformity=draw(conformities),
        ball_roughness=draw(floats(0.02e-6, 0.1e-6)),
        screw_roughness=draw(roughnesses),
        nut_roughness=draw(roughnesses),
        starts=starts,
        ball_material=draw(materials),
        screw_material=draw(materials),
        nut_material=draw(materials),
    )


oils = st.builds(bs.Lubricant, powers(0.005, 1.0), floats(1e-8, 2.5e-8))
loads = powers(1.0, 50e3)
speeds = st.just(0.0) | powers(1e-6, 5000.0).map(lambda rpm: rpm * RPM)
moving = powers(0.1, 5000.0).map(lambda rpm: rpm * RPM)
ball_forces = st.none() | st.just(0.0) | powers(1e-3, 1.0)


@dataclasses.dataclass(frozen=True)
class Case:
    """A screw, an oil and an operating point."""

    screw: bs.BallScrew
    oil: bs.Lubricant
    axial_load: float
    screw_speed: float

    def __call__(self, model: bs.FrictionModel, **changed: object) -> FrictionResult:
        """What a model says; ``changed`` replaces a field of the case, the screw or the oil."""
        parts = {"screw": self.screw, "oil": self.oil}
        operation = {"axial_load": self.axial_load, "screw_speed": self.screw_speed}
        for name, value in changed.items():
            if name in operation:
                operation[name] = value
            else:
                part = "screw" if hasattr(self.screw, name) else "oil"
                parts[part] = dataclasses.replace(parts[part], **{name: value})
        return model(parts["screw"], parts["oil"], **operation)


cases = st.builds(Case, screws(), oils, loads, speeds)
moving_cases = st.builds(Case, screws(), oils, loads, moving)


@st.composite
def fitting_cases(draw: st.DrawFn) -> Case:
    """In motion, with a contact that fits its groove: pressures that a screw survives."""
    screw, oil = draw(screws()), draw(oils)
    # N on a ball of 1 m: beyond the static rating of any screw
    per_ball = draw(powers(1e5, 1.5e8)) * screw.ball_diameter**2
    load = per_ball * screw.loaded_balls * math.sin(screw.contact_angle)
    return Case(screw, oil, load, draw(moving))


#: N/m²: a load per ball in units of its diameter squared, beyond the static rating of any screw.
HEAVIEST = 1.5e8


def box(size: int, seed: int, *, heaviest: float = HEAVIEST, at_rest: float = 0.05) -> Case:
    """Random screws, oils and operating points as one case of arrays: no constructor looks at them.

    All that is sold and a little more, with loads from next to nothing, and a share of it at rest.
    """
    rng = np.random.default_rng(seed)

    def powers(low: float, high: float) -> np.ndarray:
        return np.exp(rng.uniform(math.log(low), math.log(high), size))

    d_m = powers(0.008, 0.150)
    lead = d_m * powers(1 / 20, 1.0)
    room = lead * np.cos(np.arctan(lead / (math.pi * d_m)))
    d_w = np.minimum(d_m * rng.uniform(0.03, 0.3, size), 0.98 * room)
    z = rng.integers(10, 301, size).astype(float)
    alpha = np.radians(rng.uniform(20, 70, size))
    screw = bs.BallScrew(
        pitch_circle_diameter=d_m,
        lead=lead,
        ball_diameter=d_w,
        loaded_balls=z,
        contact_angle=alpha,
        screw_conformity=rng.uniform(0.505, 0.56, size),
        nut_conformity=rng.uniform(0.505, 0.56, size),
        ball_roughness=rng.uniform(0.02e-6, 0.1e-6, size),
        screw_roughness=rng.uniform(0.05e-6, 0.6e-6, size),
        nut_roughness=rng.uniform(0.05e-6, 0.6e-6, size),
    )
    oil = bs.Lubricant(powers(0.005, 1.0), rng.uniform(1e-8, 2.5e-8, size))
    load = np.minimum(powers(1.0, 50e3), heaviest * d_w**2 * z * np.sin(alpha))
    # most of them anywhere up to 5000 rpm, some creeping
    rpm = np.where(rng.random(size) < 0.25, powers(1e-3, 5000), rng.uniform(0, 5000, size))
    return Case(screw, oil, load, rpm * RPM * (rng.random(size) >= at_rest))


def torque_scale(r: FrictionResult) -> float:
    """The size of the torques that were added and subtracted on the way to a sum."""
    parts = sum(abs(part) for part in r.contributions.values())
    return parts + abs(r.screw_torque) + abs(r.nut_torque)


def close(found: object, expected: object, relative: float = 1e-12, scale: object = None) -> bool:
    """Equal within rounding: relative to ``scale``, or else to the expected value. NaN where NaN is expected."""
    found, expected = np.asarray(found, float), np.asarray(expected, float)
    size = np.abs(expected) if scale is None else np.abs(np.asarray(scale, float))
    with np.errstate(invalid="ignore"):  # equal infinities
        same = (found == expected) | (np.isnan(found) & np.isnan(expected))
        return bool(np.all(same | (np.abs(found - expected) <= relative * size)))


# -- laws for isolating one mechanism -------------------------------------------------------------


def no_rolling_resistance(conditions):
    """Rolling law: none."""
    return 0 * conditions.contact_load


def no_elastic_resistance(conditions):
    """Elastic resistance: none."""
    return 0 * conditions.contact_load


def constant_friction(coefficient):
    """Friction law: the same coefficient, whatever the film."""
    return lambda c: coefficient + 0 * c.film_parameter


def without_losses_of_rolling(model: bs.FrictionModel) -> bs.FrictionModel:
    """A model in which only sliding in the contacts is left."""
    alone = dataclasses.replace(model, rolling=no_rolling_resistance, elastic_resistance=no_elastic_resistance)
    return with_ball_force(alone, 0.0)


def with_ball_force(model: bs.FrictionModel, force) -> bs.FrictionModel:
    """A model whose neighbouring balls rub and brake with an imposed force."""
    chain = two_neighbours if model.ball_chain is opposed_neighbours else model.ball_chain
    return dataclasses.replace(model, ball_force=imposed_ball_force, ball_chain=chain, ball_to_ball_force=force)
