"""What is to be said of a calibration beside its numbers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from ballscrew.analyses.fit_problem import CONSTANT_TORQUE
from ballscrew.analyses.robust import memory

if TYPE_CHECKING:
    from ballscrew.analyses.calibrated import CalibratedModel

#: A share of outliers beyond which they are no longer a few.
MANY_OUTLIERS = 0.1
#: Residuals depend on something if their means over its parts differ by this much of what was measured.
TREND_SHARE, TREND_ERRORS = 0.02, 4.0
#: A prior that keeps more than this share of its variance told something.
MOSTLY_PRIOR = 0.05
#: Noise that is more than this share of the torque is no noise.
WILD = 0.3
#: A description without physics that is off by less than this share of the model says that the model is another screw.
FAR_BETTER = 0.5


def warnings_of(found: CalibratedModel) -> list[str]:
    """What a person should know before using the numbers, the gravest first."""
    return [*_not_told(found), *_of_bounds(found), *_of_priors(found), *_of_rows(found), *_trends(found)]


def product(powers: Mapping[str, float]) -> str:
    """A product of powers, the largest first: ``boundary_friction_coefficient^0.98 · decay^-0.20``."""
    largest = sorted(powers.items(), key=lambda item: -abs(item[1]))
    return " · ".join(name if power == 1 else f"{name}^{power:.2f}" for name, power in largest if abs(power) >= 0.005)


def _not_told(found: CalibratedModel) -> list[str]:
    """What the log cannot tell; that a number is at its bound, or misses are large, is said elsewhere."""
    without = [name for name, e in found.estimates.items() if not e.identified and not e.at_bound and not e.one_sided]
    said: list[str] = []
    for combination in found.identifiability.combinations:
        if combination.identified:
            continue
        names = [name for name, power in combination.powers.items() if abs(power) >= 0.05]
        without = [name for name in without if name not in names]
        with_prior = [name for name in names if found.estimates[name].identified]
        if len(names) == 1:
            near = f"near {found.estimates[names[0]].value:.4g}"
            said.append(f"{names[0]} is not identified: {near} the torques of this log hardly depend on it")
        elif with_prior:
            said.append(f"{' and '.join(names)} cannot be told apart by this log: what is known of "
                        f"{' and '.join(with_prior)} is known with the help of the prior")  # fmt: skip
        else:
            said.append(
                f"{' and '.join(names)} cannot be told apart by this log: it says nothing of "
                f"{product(combination.powers)}; fix one of them, give one a prior, or measure elsewhere"
            )
    if CONSTANT_TORQUE.name in without and not found.problem.knows_zero:
        without.remove(CONSTANT_TORQUE.name)
        said.append(
            "constant_torque is not identified: friction of one sign cannot be told from a zero error of the sensor; "
            "measure in both directions"
        )
    return [*said, *(f"{name} is not identified: it is known to less than half of its size" for name in without)]


def _of_bounds(found: CalibratedModel) -> list[str]:
    said = [
        f"{estimate.name} is bounded on one side only: beyond {estimate.value:.4g} the torques hardly change"
        for estimate in found.estimates.values()
        if estimate.one_sided and not estimate.at_bound
    ]
    return said + [
        f"{estimate.name} came to rest at its bound ({estimate.value:.4g}): the model cannot follow the log any further"
        for estimate in found.estimates.values()
        if estimate.at_bound
    ]


def _of_priors(found: CalibratedModel) -> list[str]:
    return [
        f"{estimate.name} is known by its prior, too: the log leaves {estimate.prior_share:.0%} of the prior's variance"
        for estimate in found.estimates.values()
        if estimate.prior_share > MOSTLY_PRIOR
    ]


def _of_rows(found: CalibratedModel) -> list[str]:
    said: list[str] = []
    if not found.solution.converged:
        said.append("the fit did not come to rest: its numbers are not to be used")
    typical = float(np.median(np.abs(found.rows.friction)))
    scatter = float(np.median(found.rows.scatter))
    if scatter > typical or found.solution.noise.share > WILD:
        said.append(
            f"rows miss by {scatter:.2g} N m, where friction is {typical:.2g} N m: "
            "look at their signs, units and conditions"
        )
    outlying = float(np.mean(found.rows.outlying))
    if outlying > MANY_OUTLIERS:
        said.append(f"{outlying:.0%} of the rows lie far from any fit: look at their signs, units and conditions")
    if memory(found.solution.pull):
        said.append("residuals that follow each other are alike: the errors are larger for it")
    if not found.rows.held_out.any():
        said.append("too few rows to hold any out: how well the model predicts is not known")
    by_words = {score.words: score.fitted for score in found.scores}
    own = by_words.pop("the model calibrated")
    by_words.pop("the model as given")
    best = min(by_words, key=lambda words: by_words[words])
    if by_words[best] < FAR_BETTER * own:
        said.append(
            f"the description without physics ({best}) is {own / by_words[best]:.1f} times nearer to the log: look at "
            "units, kind of torque, and whether this is the screw"
        )
    if "viscosity" in found.response.names and found.rows.log.temperature is not None:
        said.append("viscosity is free: it counts for the whole log, whatever the temperatures")
    if found.rows.log.temperature is not None and found.lubricant.grade is None:
        said.append(
            "the temperatures of the log are not used: the oil has a viscosity, and no grade that changes with it"
        )
    return said


def _trends(found: CalibratedModel) -> list[str]:
    """Where residuals depend on the operating point: what the model is missing."""
    friction = float(np.median(np.abs(found.rows.friction)))
    said: list[str] = []
    for name, trend in found.rows.trends.items():
        worst = int(np.argmax(np.abs(trend.means)))
        off = float(trend.means[worst])
        if abs(off) > max(TREND_ERRORS * trend.errors[worst], TREND_SHARE * friction):
            which = ("lowest", "lower", "middle", "higher", "highest")[worst]
            said.append(
                f"friction is {'over' if off > 0 else 'under'}estimated by {abs(off) / friction:.0%} at the {which} "
                f"fifth of the {name.replace('_', ' ')}: the model misses something that depends on it"
            )
    return said
