"""Bands of warming up of a case: over time and in the steady state, with its uncertain inputs and surroundings."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping

from ballscrew.axis.thermal.network import Network, network_of
from ballscrew.axis.thermal.surroundings import PREFIX, VARIED, Surroundings
from ballscrew.axis.thermal.warm_up_band import (
    WarmUpBand,
    uncertain_surroundings,
    warm_up_band,
)
from ballscrew.basis.errors import InputError, overflow_as_input_error
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.case_files import uncertain_inputs
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.uncertain_inputs import GIVEN, NOTHING_GIVEN, Uncertain
from ballscrew.engine.uncertainty.uncertain_value import default_uncertainties, describe_distribution
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.questions.shared.option_values import faults_named
from ballscrew.questions.warm_up.compute import HOUR, WarmUpReport, duty_of, length_of

#: Inputs of an operating point that a transient computes, or that its motion has.
_OWN = frozenset({TEMPERATURE.name, "axial_load", "screw_speed"})


@dataclasses.dataclass(frozen=True, eq=False)
class WarmUpBandReport:
    """The bands of a case that warms up, and the inputs that they come from."""

    report: WarmUpReport
    bands: WarmUpBand
    inputs: Mapping[str, Uncertain]

    @property
    def of_surroundings(self) -> Mapping[str, Uncertain]:
        """The uncertain inputs of the surroundings, by the names that they have there."""
        return {name.removeprefix(PREFIX): one for name, one in self.inputs.items() if name.startswith(PREFIX)}


@overflow_as_input_error()
def band(
    case: Case,
    hours: float = 4.0,
    cool_down: float = 0.0,
    *,
    samples: int | None = None,
    level: float | None = None,
    only_given: bool = False,
    done: Callable[[int, int], None] | None = None,
) -> WarmUpBandReport:
    """The bands of a case that warms up. Raises ``InputError`` that names options of the command line."""
    surroundings = case.surroundings or Surroundings()
    duty, stroke = duty_of(case, surroundings)
    length = length_of(case, surroundings)
    inputs = inputs_of(case, network_of(duty, surroundings, shaft_length=length), only_given)
    if only_given and not inputs:
        raise InputError(NOTHING_GIVEN)
    joint = uncertain_inputs.joint_of(case, inputs)
    together = () if joint is None else joint.names
    with faults_named({"band.": "--"}):
        result = warm_up_band(
            duty,
            surroundings,
            time=hours * HOUR,
            cool_down=cool_down * HOUR,
            shaft_length=length,
            joint=joint,
            distributions={name: one.distribution for name, one in inputs.items() if name not in together},
            samples=samples,
            level=0.95 if level is None else level,
            done=done,
        )
    return WarmUpBandReport(WarmUpReport(case, surroundings, result.warm_up, stroke), result, inputs)


def inputs_of(case: Case, network: Network, only_given: bool) -> Mapping[str, Uncertain]:
    """The uncertain inputs: those of the friction, and those of the surroundings; none that is computed here."""
    others = {name: one for name, one in case.origins.uncertain.items() if name not in _OWN}
    origins = dataclasses.replace(case.origins, exact=case.origins.exact | _OWN, uncertain=others)
    known = dataclasses.replace(case, origins=origins)
    inputs = {name: one for name, one in uncertain_inputs.all_of(known, only_given).items() if name not in _OWN}
    quantities = fields_of(Surroundings)
    given = case.origins.uncertain_surroundings
    for name, distribution in given.items():
        description = describe_distribution(distribution, quantities[name.removeprefix(PREFIX)])
        inputs[name] = Uncertain(distribution, GIVEN, True, description)
    if not only_given:
        names = [name for name in VARIED if PREFIX + name not in {*given, *case.origins.exact}]
        for name, distribution in uncertain_surroundings(network, names).items():
            why = default_uncertainties()[name]
            description = describe_distribution(distribution, quantities[name.removeprefix(PREFIX)])
            inputs[name] = Uncertain(distribution, why.source, False, description, why.reason)
    return inputs
