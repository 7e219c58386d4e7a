"""The uncertainty band of a case: the results, how far off they may be, and which laws could replace the model's."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

import numpy as np

from ballscrew.axis.thermal.surroundings import PREFIX
from ballscrew.axis.thermal.warm_up import equilibrium
from ballscrew.axis.thermal.warm_up_band import sampled
from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, overflow_as_input_error
from ballscrew.basis.quantities import Quantity
from ballscrew.cases.case_files import uncertain_inputs
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.named_calibration import make_of
from ballscrew.cases.case_files.uncertain_inputs import Uncertain
from ballscrew.engine.evaluation.comparison import Candidate
from ballscrew.engine.uncertainty import bands
from ballscrew.engine.uncertainty.band_evaluation import BAND_OUTPUTS
from ballscrew.engine.uncertainty.bands import Band, BandCurve
from ballscrew.engine.uncertainty.distributions import Distribution, LogNormal, Normal
from ballscrew.engine.uncertainty.monte_carlo import Joint, JointParts, JointSamples, sobol_sequence
from ballscrew.engine.uncertainty.uncertain_value import JUDGEMENT
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.friction.calibrations import PARAMETERS, calibrated, calibrations, is_of_maker
from ballscrew.physics.friction.model import LAWS, coefficients
from ballscrew.physics.laws.traits import traits_of
from ballscrew.physics.solvers.load_distribution import preload_of
from ballscrew.questions.band import BandOptions
from ballscrew.questions.compare import compute
from ballscrew.questions.shared.option_values import faults_named, flags_of
from ballscrew.questions.shared.question import Done
from ballscrew.questions.warm_up.band import inputs_of
from ballscrew.questions.warm_up.compute import SERIES
from ballscrew.questions.warm_up.self_heating import SelfHeating

#: Samples of the surroundings, and the share of them that needs a steady state.
SAMPLES, ENOUGH = 256, 0.5
_REASON = "steady states of samples of the surroundings and of the preload as it was set"
_PRELOAD = SERIES["preload"]


@dataclasses.dataclass(frozen=True, eq=False)
class HeatSamples:
    """Temperature of the oil and preload in the steady states of samples of the surroundings, as uncertain inputs."""

    samples: JointSamples
    inputs: Mapping[str, Uncertain]


def heat_samples(heating: SelfHeating, *, only_given: bool = False) -> HeatSamples:
    """The samples of a case that heats itself, about its steady state.

    The friction is that of the model: its own uncertain inputs are drawn by the band, and do not change the heat.
    Raises :class:`~ballscrew.basis.errors.InputError` where half of the samples have no steady state.
    """
    case, network = heating.given, heating.equilibrium.network
    every = inputs_of(case, network, only_given)
    names = [name for name in every if name.startswith(PREFIX) or name in ("preload", "nut.preload")]
    shares = sobol_sequence(len(names), SAMPLES) if names else np.empty((0, SAMPLES))
    drawn = {name: np.asarray(every[name].distribution.quantile(row)) for name, row in zip(names, shares, strict=True)}
    preload = drawn.get("preload", drawn.get("nut.preload"))
    ends = [
        equilibrium(
            sampled(
                network,
                {n.removeprefix(PREFIX): float(v[i]) for n, v in drawn.items() if n.startswith(PREFIX)},
                preload=None if preload is None else float(preload[i]),
                factor=None,
            )
        )
        for i in range(SAMPLES)
    ]
    known = [end for end in ends if end.exists]
    if len(known) < ENOUGH * SAMPLES:
        count = units.to_significant(100 * (1 - len(known) / SAMPLES), 2)
        problem = f"has no steady state in {count} % of samples of the surroundings"
        remedy = "give [surroundings] ball_conductance and nut_conductance with their bands, or see ballscrew warm-up"
        raise InputError(Fault("--self-heating", problem, "", remedy))
    oil = np.array([end.oil_temperature for end in known])
    inputs = {TEMPERATURE.name: Uncertain(Normal(float(np.mean(oil)), float(np.std(oil)) or 1e-9), JUDGEMENT, False,
                                          _range(oil, TEMPERATURE), _REASON)}  # fmt: skip
    if not network.preload_set:
        return HeatSamples(JointSamples((TEMPERATURE.name,), oil[None, :]), inputs)
    held = np.maximum(np.array([end.preload for end in known]), 1e-6 * network.preload_set)
    name = next((name for name in ("preload", "nut.preload") if name in every), "preload")
    spread = float(np.exp(np.std(np.log(held))))
    inputs[name] = Uncertain(
        LogNormal(float(np.median(held)), max(spread, 1 + 1e-9)), JUDGEMENT, False, _range(held, _PRELOAD), _REASON
    )
    return HeatSamples(JointSamples((TEMPERATURE.name, name), np.stack([oil, held])), inputs)


def _range(values: np.ndarray, quantity: Quantity) -> str:
    low, high = (units.shown(float(end), quantity) for end in np.quantile(values, (0.025, 0.975)))
    return f"{low} to {high} (95 %), by the heat"


#: Points of the curve, of a screw and of a whole nut, and how far it goes beyond the operating point.
_POINTS, _NUT_POINTS, _BEYOND = 25, 9, 2.0
#: Slot of the calibrations of makers among the alternatives of a band.
OF_MAKERS = "calibration"
#: What of a model says what the balls press with: who changes it is drawn no calibration beside.
PRESSING = frozenset({"ball_force", "ball_chain", "ball_to_ball_force"})
#: Share of the samples in a band by default.
LEVEL = 0.95
#: Flags of the command line by the fields in which the analysis finds faults.
FLAGS = flags_of("band", BandOptions)


@dataclasses.dataclass(frozen=True, eq=False)
class BandReport:
    """The band of a case, and the inputs that were taken as uncertain."""

    band: Band
    inputs: Mapping[str, Uncertain]
    #: The friction torque in a full bath of oil, N m, where that of the case is starved of oil; None elsewhere.
    flooded_torque: float | None = None
    #: Seals and other losses of the case at its operating point, N m.
    losses: float = 0.0

    @property
    def given(self) -> int:
        """Number of inputs whose distribution the case gives."""
        return sum(one.given for one in self.inputs.values())

    @property
    def judged(self) -> int:
        """Number of inputs whose distribution is assumed by judgement, with no source behind it."""
        return sum(one.source == JUDGEMENT for one in self.inputs.values())

    @property
    def reasons_by_share(self) -> dict[str, float]:
        """Share of the samples outside the model's validity by reason, the greatest first."""
        return dict(sorted(self.band.reasons.items(), key=lambda item: -item[1]))


def alternatives(case: Case) -> list[Candidate]:
    """The case's model with each law whose traits declare it an alternative, and with what makers' torques ask for.

    The other coefficients that a model has for a law of its own are not an alternative. Of a preloaded nut without a
    calibration it is not known whose rows it would meet: each calibration of a maker (:func:`of_makers`) is as likely
    as none.

    A named calibration holds for the laws that it was fitted with: those whose coefficients it sets are not exchanged.
    With any other law a fit would have found other numbers: of a case that a fit wrote none is exchanged.
    """
    if case.origins.fit:
        return []
    _, laws = compute.candidates(case)
    makers = of_makers(case)
    numbers = [] if case.origins.calibration is None else PARAMETERS.values()
    fitted = {name.partition(".")[0] for name in numbers}
    return [
        *(
            law
            for law in laws
            if law.name in LAWS[law.slot] and traits_of(getattr(law.model, law.slot)).alternative
            if law.slot not in fitted
        ),
        *makers,
    ]


def of_makers(case: Case) -> list[Candidate]:
    """The case's model with the calibration of each maker, of one number, for a preloaded nut of the kinds it is of.

    Makers contradict each other by a factor of 1.7 at equal nuts. Where the row of the nut has a make that a
    calibration is of, that one alone is drawn beside the model as it is. None with a calibration, without preload,
    where spacers part the balls, where the case says itself what the balls press with, and of a friction law that has
    no boundary friction. The force between balls that is drawn stays uncertain beside a calibration, by the same
    factor: so the upper end lies too high, by some 15 % where all makers are drawn.
    """
    nut, model = case.screw.nut, case.model
    pressed = PRESSING & set(model.changes)
    has_boundary = PARAMETERS["boundary_friction_coefficient"].rpartition(".")[2] in coefficients(model.friction)
    if case.origins.calibration is not None or case.origins.fit or pressed or not has_boundary:
        return []
    if nut.spacer_balls or not _preloaded(case):
        return []
    values = [
        one
        for one in calibrations().values()
        if one.model == model.name and tuple(one.fitted) == ("share_of_load",)
        if nut.contacts_per_ball in one.contacts_per_ball
    ]
    own = [one for one in values if is_of_maker(one.maker, make_of(case))]
    return [Candidate(one.name, calibrated(model, one), OF_MAKERS) for one in own or values]


def _preloaded(case: Case) -> bool:
    return bool(np.any(preload_of(case.screw, case.screw.nut) > 0))


@overflow_as_input_error()
def band(case: Case, options: BandOptions, done: Done | None = None, heat: HeatSamples | None = None) -> BandReport:
    """Band of a case, with what its heat leaves open where it is given.

    Raises :class:`~ballscrew.basis.errors.InputError` that names options of the command line.
    """
    inputs = uncertain_inputs.all_of(case, options.only_given)
    if heat is not None:
        # a temperature that varies has the viscosity with it
        inputs = {**{name: one for name, one in inputs.items() if name != "viscosity"}, **heat.inputs}
    with faults_named(FLAGS):
        result = bands.band(
            **_arguments(case, inputs, options, heat),
            screw_speed=case.operation.screw_speed,
            axial_load=case.operation.axial_load,
            outputs=BAND_OUTPUTS,
            samples=options.samples,
            done=done,
        )
    assert isinstance(result, Band), "an operating point is no axis"
    return BandReport(result, inputs, *_full_bath_and_losses(case))


def _full_bath_and_losses(case: Case) -> tuple[float | None, float]:
    load, speed = case.operation.axial_load, case.operation.screw_speed
    model = case.model(case.screw, case.lubricant, axial_load=load, screw_speed=speed)
    return float(model.flooded_torque) if model.starvation else None, float(sum(model.losses.values()))


def axis_of_curve(case: Case) -> str:
    """The operating condition along which the curve runs: the speed, or the load where the screw is at rest."""
    return "axial_load" if float(case.operation.screw_speed) == 0 else "screw_speed"


def curve(case: Case, report: BandReport, options: BandOptions, done: Done | None = None) -> BandCurve:
    """Band of the friction torque from rest, or no load, to twice the operating point."""
    along = axis_of_curve(case)
    here = float(getattr(case.operation, along)) or 1.0
    return bands.band_along(
        along=along,
        points=np.linspace(0.0, _BEYOND * here, _POINTS if case.nut is None else _NUT_POINTS),
        axial_load=case.operation.axial_load,
        screw_speed=case.operation.screw_speed,
        **_arguments(case, report.inputs, options),
        done=done,
    )


def _arguments(
    case: Case, inputs: Mapping[str, Uncertain], options: BandOptions, heat: HeatSamples | None = None
) -> dict[str, Any]:
    """Arguments that the band and the curve have in common."""
    uncertain, joint = distributions(case, inputs, heat)
    return {
        "model": case.model,
        "screw": case.screw,
        "lubricant": case.lubricant,
        "distributions": uncertain,
        "joint": joint,
        "alternatives": alternatives(case),
        "level": LEVEL if options.level is None else options.level,
    }


def distributions(
    case: Case, inputs: Mapping[str, Uncertain], heat: HeatSamples | None = None
) -> tuple[dict[str, Distribution], Joint | None]:
    """The distributions of the inputs that are independent, and those that depend on each other."""
    own = uncertain_inputs.joint_of(case, {n: u for n, u in inputs.items() if heat is None or n not in heat.inputs})
    parts = [one for one in (None if heat is None else heat.samples, own) if one is not None]
    joint = parts[0] if len(parts) == 1 else JointParts(tuple(parts)) if parts else None
    together = () if joint is None else joint.names
    return {name: u.distribution for name, u in inputs.items() if name not in together}, joint
