"""The paper's claims, one by one, held against what its equations give.

Every number and every verdict is computed; what is written down here is the claim, the paper's
number, and the criterion.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping

from ballscrew.evidence.papers.olaru2005 import case, verdicts
from ballscrew.evidence.papers.olaru2005.observations import Observations, observe
from ballscrew.evidence.papers.olaru2005.verdicts import Finding


@dataclasses.dataclass(frozen=True, kw_only=True)
class Claim:
    """A claim of the paper in short, its number, how it is judged, and what each model gives, once it is checked."""

    section: str
    claim: str
    paper: str
    criterion: str
    remark: str = ""
    find: Callable[[Observations], Finding]
    findings: Mapping[str, Finding] = dataclasses.field(default_factory=dict[str, Finding])

    @property
    def key(self) -> str:
        """The name of the function that judges it."""
        return self.find.__name__


def claims() -> tuple[Claim, ...]:
    """Check all claims with the printed model, the corrected one and the printed one to the letter."""
    return judged({name: observe(model) for name, model in case.models().items()})


def judged(observed: Mapping[str, Observations], keys: tuple[str, ...] | None = None) -> tuple[Claim, ...]:
    """The claims (or those with these keys) for what was observed, by name."""
    return tuple(
        dataclasses.replace(claim, findings={name: claim.find(seen) for name, seen in observed.items()})
        for claim in _CLAIMS
        if keys is None or claim.key in keys
    )


_CLAIMS = (
    Claim(
        section="Abstract, §3, §9",
        claim="sliding forces follow from equilibrium, without integrating shear",
        paper="–",
        criterion="(24) and (25) close (22) and (23) of §3, relative to the sliding force",
        find=verdicts.equilibrium,
    ),
    Claim(
        section="§2.2",
        claim="the curvature moment integrates to (15)",
        paper="–",
        criterion="(15) against Gauss quadrature of (14) over the ellipse",
        remark="Exact without spin. Spin, which the paper leaves out, changes both sides.",
        find=verdicts.closed_form,
    ),
    Claim(
        section="§8",
        claim="Y may be imposed",
        paper="0.34",
        criterion="the Y that the sliding forces ask for rounds to 0.34 from 0 to 1000 rpm at 4000 N",
        remark="The same integral that gives (15) gives F_S = µQ(1 − 3Y + Y³), so equilibrium settles Y; "
        "the corrected model solves for it.",
        find=verdicts.offset,
    ),
    Claim(
        section="Abstract, §9",
        claim="the sliding force holds all listed effects",
        paper="five effects",
        criterion="each effect has a share in F_S at 4000 N and 600 rpm, and the shares make up the whole",
        remark="Complete as to the paper's list; spin, seals and the return path are not in it.",
        find=verdicts.effects,
    ),
    Claim(
        section="Abstract, §1",
        claim="good agreement with published measurements",
        paper="no value printed",
        criterion="needs the measured values",
        remark="The sources are cited, but none of their values is printed.",
        find=verdicts.agreement,
    ),
    Claim(
        section="§5",
        claim="at low speed the film's friction is negligible beside the asperities'",
        paper="below 0.01 to 0.02",
        criterion="0.02 is at most a tenth of µ_a up to the speed of least torque",
        remark="The film's own coefficient at low speed cannot be checked: no equation of the paper gives it.",
        find=verdicts.film_friction,
    ),
    Claim(
        section="§5",
        claim="µ_a falls to 0.02 at a film parameter of 2.5 to 3",
        paper="λ = 2.5 to 3",
        criterion="λ where (23) of §5 gives 0.02, by formula and by bisection",
        remark="At 2.5 to 3 the coefficient is below 0.02 indeed, but the clamp takes over much earlier.",
        find=verdicts.threshold,
    ),
    Claim(
        section="§5",
        claim="at very small speed µ_a reaches µ0 (first branch)",
        paper="µ_a ≥ µ0",
        criterion="reached at some speed above zero",
        remark="The exponential is below one for every film, so the branch is dead but at rest.",
        find=verdicts.first_branch,
    ),
    Claim(
        section="§5",
        claim="lubrication goes from limited through mixed to full film",
        paper="three regimes",
        criterion="the full-film branch is reached within the paper's speeds and viscosities",
        remark="Of the three branches the first is the limit of rest (see the claim before); full film means the clamp "
        "at 0.02, which takes over at λ = 1.83.",
        find=verdicts.regimes,
    ),
    Claim(
        section="§8, Fig. 5",
        claim="torques on screw and nut hardly differ at F_B = 1/z",
        paper="no important difference",
        criterion="mean |M_S − M_N|/M_S from 0 to 1000 rpm is at most 5 % (our reading of hardly)",
        remark="In the balanced form the difference is z F_B d_m/2 (and the chain's curvature), whatever the speed.",
        find=verdicts.split_one,
    ),
    Claim(
        section="§8, Fig. 5",
        claim="the difference grows with F_B = 2/z",
        paper="larger",
        criterion="mean |M_S − M_N|/M_S is larger than at 1/z",
        find=verdicts.split_two,
    ),
    Claim(
        section="§8, (36)",
        claim="M_S may stand for the friction in the efficiency",
        paper="–",
        criterion="M_N in its place moves η by at most 0.01, half the width of the paper's band",
        remark="M_S is right in any case: the power is supplied at the screw, and M_N is its reaction.",
        find=verdicts.which_torque,
    ),
    Claim(
        section="§8, Fig. 6",
        claim="the torque has a minimum over speed",
        paper="200 to 300 rpm",
        criterion="speed of least torque within the paper's range",
        find=verdicts.minimum,
    ),
    Claim(
        section="§8, Fig. 6",
        claim="it falls first because the friction coefficient falls",
        paper="–",
        criterion="up to the minimum only curvature slip falls, and in the ratio of µ_m (within 5 %)",
        find=verdicts.falling,
    ),
    Claim(
        section="§8, Fig. 6",
        claim="it then rises because the hydrodynamic forces rise",
        paper="–",
        criterion="past the minimum only hydrodynamic rolling rises",
        remark="Curvature slip goes on falling past the minimum; hydrodynamic rolling outgrows it.",
        find=verdicts.rising,
    ),
    Claim(
        section="§8, Fig. 7",
        claim="efficiency over speed",
        paper="0.90 to 0.92",
        criterion="all values from 0 to 1000 rpm round into the paper's band",
        find=verdicts.efficiency,
    ),
    Claim(
        section="Abstract, §8",
        claim="the efficiency agrees with the literature",
        paper="no value printed",
        criterion="needs the values of the literature",
        find=verdicts.literature_efficiency,
    ),
    Claim(
        section="§8, Fig. 8",
        claim="the torque rises with load",
        paper="rises",
        criterion="rises from each point of the load grid to the next, at 600 rpm",
        find=verdicts.load_torque,
    ),
    Claim(
        section="§8, Fig. 9",
        claim="efficiency rises from zero while Q goes from 0 to 20 N",
        paper="0 to 0.9",
        criterion="rises all the way from zero, and lies within 0.01 of 0.9 at 20 N",
        remark="The start of the rise lies outside the validity of the equations (see the last claim on Fig. 9).",
        find=verdicts.first_zone,
    ),
    Claim(
        section="§8, Fig. 9",
        claim="efficiency is constant above 20 N",
        paper="0.90 to 0.92",
        criterion="all values from 20 N to the load of Fig. 6 round into the paper's band",
        find=verdicts.second_zone,
    ),
    Claim(
        section="§8, Fig. 9",
        claim="the efficiency starts at zero",
        paper="0 at Q = 0",
        criterion="zero at Q = 0, and the model is valid there",
        remark="The equations do give zero, but where F_S exceeds µQ the ball would skid and they no longer apply.",
        find=verdicts.zero,
    ),
    Claim(
        section="§9",
        claim="torque and efficiency are realistic",
        paper="no value printed",
        criterion="needs measured values",
        find=verdicts.realistic,
    ),
)
