"""One function for each claim of the paper: from what was observed to words and a verdict."""

from __future__ import annotations

import dataclasses
import enum
from collections.abc import Mapping

from ballscrew.evidence.papers.olaru2005 import case
from ballscrew.evidence.papers.olaru2005.observations import Observations, Range, Split
from ballscrew.physics.friction.balls import MECHANISMS

#: Residuals below this are rounding.
_ROUNDING = 1e-10
#: Speeds of the minimum that the paper gives, rpm, and its band of efficiency.
_MINIMUM = Range(200.0, 300.0)
_EFFICIENCY = Range(0.90, 0.92)
#: The text's offset of the lines of pure rolling, and the film parameters where its film takes over.
_OFFSET = 0.34
_FULL_FILM = Range(2.5, 3.0)


class Verdict(enum.StrEnum):
    """Verdict on a claim."""

    HOLDS = "holds"
    FAILS = "does not hold"
    OPEN = "cannot be checked"


@dataclasses.dataclass(frozen=True)
class Finding:
    """Finding of one model for a claim, in full and in short."""

    text: str
    verdict: Verdict
    short: str


def _if(holds: bool, text: str, short: str = "") -> Finding:
    return Finding(text, Verdict.HOLDS if holds else Verdict.FAILS, short or text)


def _open(text: str, short: str) -> Finding:
    return Finding(text, Verdict.OPEN, short)


def _rpm(speed: float) -> float:
    return speed / case.RPM


def _percent(share: float) -> str:
    return f"{100 * share:.1f} %" if share < 100 else "more than 100 times"


def _band(band: Range, digits: int = 3) -> str:
    return f"{band.least:.{digits}f} to {band.most:.{digits}f}"


def _rounds_into(band: Range) -> bool:
    """True for a band of efficiencies that lies in the paper's, rounded to its two digits."""
    return _EFFICIENCY.least - 0.005 <= band.least and band.most < _EFFICIENCY.most + 0.005


def _signed(changes: Mapping[str, float]) -> str:
    return ", ".join(f"{MECHANISMS[name]} {_change(change)}" for name, change in changes.items())


def _change(value: float) -> str:
    # adding zero keeps minus zero out of the text
    return f"{round(value, 3) + 0.0:+.3f}".replace("-", "−")


def _residual(value: float) -> str:
    """Rounding differs from machine to machine: say that it is rounding, not how much."""
    return f"below {_ROUNDING:.0e}" if value < _ROUNDING else f"{value:.1e}"


def equilibrium(seen: Observations) -> Finding:
    """Abstract, §3, §9: sliding forces from equilibrium."""
    s = seen.slip
    forces, moments = _residual(s.force_residual), _residual(s.moment_residual)
    return _if(
        max(s.force_residual, s.moment_residual) < _ROUNDING,
        f"residual of forces {forces}, of moments {moments}",
        f"residuals {forces}" if forces == moments else "",
    )


def closed_form(seen: Observations) -> Finding:
    """§2.2: the integral (14) in closed form (15)."""
    error = seen.slip.quadrature_error
    return _if(error < _ROUNDING, f"relative difference {_residual(error)}", f"difference {_residual(error)}")


def offset(seen: Observations) -> Finding:
    """§8: the imposed offset against the one that equilibrium asks for."""
    Y = seen.slip.offset
    return _if(
        max(abs(Y.least - _OFFSET), abs(Y.most - _OFFSET)) <= 0.005,
        f"equilibrium asks for Y = {_band(Y, 4)}; F_S/(µQ) left over: {_residual(seen.slip.traction_residual)}",
        f"Y = {_band(Y)}",
    )


def effects(seen: Observations) -> Finding:
    """Abstract, §9: all listed effects have their share in the sliding force."""
    effects = seen.slip.effects
    shares = ", ".join(f"{name} {_percent(share)}" for name, share in effects.items())
    everything = all(share > 0 for share in effects.values()) and seen.slip.effects_residual < _ROUNDING
    return _if(everything, shares, f"{len(effects)} shares, {_percent(sum(effects.values()))}")


def agreement(seen: Observations) -> Finding:
    """Abstract, §1: agreement with measurements."""
    m = seen.minimum
    torques = f"{m.torque:.3f} to {max(m.torque_at_rest, m.torque_at_top):.3f} N m"
    return _open(f"friction torque {torques} at 4000 N; the paper prints no value to compare it with", torques)


def literature_efficiency(seen: Observations) -> Finding:
    """Abstract, §8: agreement with the efficiencies of the literature."""
    return _open(f"{_band(seen.efficiency)}; the paper prints no value to compare it with", _band(seen.efficiency))


def film_friction(seen: Observations) -> Finding:
    """§5: friction of the film against that of the asperities."""
    rest, minimum = _percent(seen.coefficient.film_share_at_rest), _percent(seen.coefficient.film_share_at_minimum)
    return _if(
        seen.coefficient.film_share_at_minimum <= 0.1,
        f"0.02 is {rest} of µ_a at rest, {minimum} at the speed of least torque",
        f"{rest} of µ_a at rest, then {minimum}",
    )


def threshold(seen: Observations) -> Finding:
    """§5: film parameter at which the clamp takes over."""
    c = seen.coefficient
    agreed = abs(c.threshold_by_formula - c.threshold_by_bisection) < _ROUNDING
    return _if(
        agreed and _FULL_FILM.least <= c.threshold_by_formula <= _FULL_FILM.most,
        f"µ_a = 0.02 at λ = {c.threshold_by_formula:.5f} (by bisection {c.threshold_by_bisection:.5f}); "
        f"{c.asperity_at_2_5:.4f} at 2.5, {c.asperity_at_3:.4f} at 3",
        f"λ = {c.threshold_by_formula:.2f}",
    )


def first_branch(seen: Observations) -> Finding:
    """§5: the branch for very small speeds."""
    share = seen.coefficient.largest_share_of_boundary
    return _if(share >= 1, f"µ_a/µ0 is at most {share:.3f} from 1 rpm up", f"µ_a/µ0 at most {share:.3f}")


def regimes(seen: Observations) -> Finding:
    """§5: from limited to full lubrication."""
    c = seen.coefficient
    full = "full film" if c.film_parameter_at_top >= c.threshold_by_formula else "mixed throughout"
    return _if(
        c.film_parameter_thick_oil >= c.threshold_by_formula,
        f"λ from 0 to {c.film_parameter_at_top:.3g} at 0.1 Pa s ({full}), "
        f"to {c.film_parameter_thick_oil:.3g} at 0.5 Pa s",
        f"λ up to {c.film_parameter_thick_oil:.3g}",
    )


def _split_text(split: Split) -> str:
    return f"mean {_percent(split.mean)}, at most {_percent(split.most)}"


def split_one(seen: Observations) -> Finding:
    """Fig. 5: screw and nut at 1/z N."""
    return _if(seen.split_one.mean <= 0.05, _split_text(seen.split_one), f"mean {_percent(seen.split_one.mean)}")


def split_two(seen: Observations) -> Finding:
    """Fig. 5: screw and nut at 2/z N."""
    one, two = seen.split_one, seen.split_two
    return _if(two.mean > one.mean, _split_text(two), f"mean {_percent(two.mean)}")


def which_torque(seen: Observations) -> Finding:
    """(36): what the nut torque in place of the screw torque would change."""
    one, two = seen.split_one.efficiency_shift, seen.split_two.efficiency_shift
    return _if(
        one <= 0.01, f"M_N instead moves η by at most {one:.4f} (2/z: {two:.4f})", f"η moves by {one:.4f} at most"
    )


def minimum(seen: Observations) -> Finding:
    """Fig. 6: speed of least torque."""
    m = seen.minimum
    return _if(
        _MINIMUM.least <= _rpm(m.speed) <= _MINIMUM.most,
        f"{_rpm(m.speed):.0f} rpm, {m.torque:.3f} N m "
        f"({m.torque_at_rest:.3f} at rest, {m.torque_at_top:.3f} at 1000 rpm)",
        f"{_rpm(m.speed):.0f} rpm",
    )


def falling(seen: Observations) -> Finding:
    """Fig. 6: cause of the falling branch."""
    m = seen.minimum
    others = [change for name, change in m.falling.items() if name != "curvature"]
    alone = m.falling["curvature"] < 0 and min(others) > -_ROUNDING
    same = abs(m.curvature_ratio - m.friction_ratio) <= 0.05 * m.friction_ratio
    slip, coefficient = _percent(m.curvature_ratio), _percent(m.friction_ratio)
    return _if(
        alone and same and _rpm(m.speed) >= 1,
        f"N m: {_signed(m.falling)}; curvature slip to {slip} as µ_m to {coefficient}",
        f"µ_m to {coefficient}, curvature slip to {slip}",
    )


def rising(seen: Observations) -> Finding:
    """Fig. 6: cause of the rising branch."""
    m = seen.minimum
    others = [change for name, change in m.rising.items() if name != "hydrodynamic_rolling"]
    alone = m.rising["hydrodynamic_rolling"] > 0 and max(others) < _ROUNDING
    return _if(
        alone and m.torque_at_top > m.torque,
        f"N m: {_signed(m.rising)}",
        f"hydrodynamic rolling {_change(m.rising['hydrodynamic_rolling'])} N m, the rest {_change(sum(others))}",
    )


def _told_from(value: float, limit: float) -> str:
    """A value with three decimals, or with as many as show that it is not the limit that it misses."""
    places = next((n for n in range(3, 9) if value == limit or round(value, n) != round(limit, n)), 9)
    return f"{value:.{places}f}"


def efficiency(seen: Observations) -> Finding:
    """Fig. 7: efficiency over speed."""
    return _if(_rounds_into(seen.efficiency), _band(seen.efficiency))


def load_torque(seen: Observations) -> Finding:
    """Fig. 8: torque over load."""
    c = seen.load
    return _if(
        c.torque_rises,
        f"{c.torque_without_load:.3f} N m without load, {c.torque_at_top:.3f} N m at 4000 N; "
        f"grows as Q^{c.exponent_at_20:.2f} at 20 N, as Q^{c.exponent_at_top:.2f} at the end",
        f"{c.torque_without_load:.3f} to {c.torque_at_top:.3f} N m",
    )


def first_zone(seen: Observations) -> Finding:
    """Fig. 9: efficiency up to 20 N."""
    c = seen.load
    rises = c.efficiency_rises and c.efficiency_without_load == 0
    reached = _told_from(c.efficiency_at_20, 0.91)
    values = f"from {c.efficiency_without_load:.0f} to {reached} at 20 N"
    return _if(
        rises and abs(c.efficiency_at_20 - 0.9) <= 0.01,
        f"{'rises' if rises else 'does not rise'} {values}",
        f"{c.efficiency_without_load:.0f} to {reached}",
    )


def second_zone(seen: Observations) -> Finding:
    """Fig. 9: efficiency above 20 N."""
    return _if(_rounds_into(seen.load.plateau), _band(seen.load.plateau))


def zero(seen: Observations) -> Finding:
    """Fig. 9: the start from zero, and whether the model holds there."""
    c = seen.load
    text = (
        f"skids below Q = {c.skid_limit:.2f} N (η up to {c.efficiency_at_skid_limit:.2f}); "
        f"contact too light for (1) and (26) below {c.elastic_limit:.2f} N "
        f"(η up to {c.efficiency_at_elastic_limit:.2f})"
    )
    short = f"skids below {c.skid_limit:.2f} N"
    if c.efficiency_without_load == 0 and c.skid_limit > 0:
        return _open(text, short)
    return _if(c.efficiency_without_load == 0, text, short)


def realistic(seen: Observations) -> Finding:
    """§9: realistic values."""
    m = seen.minimum
    return _open(
        f"η {_band(seen.efficiency)}, torque {m.torque:.3f} N m and up at 4000 N; no measured value in the paper",
        f"η {_band(seen.efficiency)}",
    )
