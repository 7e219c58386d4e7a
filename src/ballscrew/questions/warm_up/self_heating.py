"""Self-heating of a case: the operating point at the temperature and preload in which it ends."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ballscrew.axis.thermal.friction_map import friction_map
from ballscrew.axis.thermal.surroundings import Surroundings
from ballscrew.axis.thermal.warm_up import Equilibrium, equilibrium, steady_heat
from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import Force, Info, Length, Quantity, Ratio, Temperature, Torque, quantities_of
from ballscrew.basis.records import Record, documents
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.descriptions import inputs
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.friction import validity
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.shared import declared
from ballscrew.questions.shared.declared import from_attributes
from ballscrew.questions.warm_up.compute import (
    EQUILIBRIUM,
    assumed_of,
    check_oil,
    duty_of,
    length_of,
    stroke_of,
)

if TYPE_CHECKING:
    import xarray as xr

OPTION = "--self-heating"
_TORQUE = quantities_of(FrictionResult)["screw_torque"]
#: The friction torques that a starved one has beside it, warm and as given.
WARM, GIVEN = (
    Quantity(f"self_heating.{name}", "N m", Info("M_S", meaning))
    for name, meaning in (
        ("screw_torque", "friction torque once warm"),
        ("screw_torque_given", "friction torque at the oil that is given"),
    )
)


class SelfHeatingNumbers(NamedTuple):
    """The steady state that self-heating ends in, beside what the case gives."""

    oil_temperature: Temperature
    oil_temperature_given: Temperature
    nut_temperature: Temperature
    #: In the mean.
    shaft_temperature: Temperature
    #: 1 less the gain of the thermal loop.
    margin: Ratio
    gain: Ratio
    preload: Force
    preload_given: Force
    #: Friction torque at the operating point.
    screw_torque: Torque
    screw_torque_given: Torque
    #: The same in a full bath of oil, in the steady state of its own.
    flooded_torque: Torque
    flooded_torque_given: Torque
    flooded_oil_temperature: Temperature
    #: Of the shaft between its bearings.
    growth: Length


@dataclasses.dataclass(frozen=True, eq=False)
class SelfHeating:
    """A case as it was given, and as it is once it is warm."""

    given: Case
    warm: Case
    equilibrium: Equilibrium
    #: The steady state in a full bath of oil, of heat of its own; the same where nothing is starved of oil.
    flooded: Equilibrium
    #: Friction torque of the screw at the operating point, as given and warm, and each in a full bath of oil, N m.
    torque_given: float
    torque: float
    flooded_torque_given: float
    flooded_torque: float
    #: The way to and fro, m.
    stroke: float

    @property
    def assumed(self) -> Sequence[str]:
        """Numbers that the case does not give, and what stands in for them."""
        network = self.equilibrium.network
        return assumed_of(self.given, network.surroundings, network, self.stroke)

    @property
    def numbers(self) -> SelfHeatingNumbers:
        """Values taken, and what they stand for."""
        end, oil = self.equilibrium, self.given.lubricant.temperature
        return from_attributes(
            SelfHeatingNumbers,
            end,
            oil_temperature_given=float(oil or "nan"),
            gain=1 - end.margin,
            preload_given=end.network.preload_set,
            screw_torque=self.torque,
            screw_torque_given=self.torque_given,
            flooded_torque=self.flooded_torque,
            flooded_torque_given=self.flooded_torque_given,
            flooded_oil_temperature=self.flooded.oil_temperature,
        )

    def within(self, document: Mapping[str, Any]) -> dict[str, Any]:
        """A document with the numbers of self-heating; its inputs are those of the case as it was given."""
        return {
            **document,
            "inputs": inputs(self.given),
            "results": {**document.get("results", {}), "self_heating": declared.document(self.numbers)},
            "units": {**document.get("units", {}), "self_heating": declared.units(self.numbers)},
            "assumed": [*document.get("assumed", ()), *self.assumed],
            "verdicts": [*documents(self.records), *document["verdicts"]],
        }

    @property
    def records(self) -> list[Record]:
        """Records of what was taken in place of what and what it does, and starvation."""
        return [self._record, *self._starved]

    @property
    def _starved(self) -> list[Record]:
        """Both torques warm and as given, each warm one at the oil of its own steady state."""
        given = (self.torque, self.torque_given)
        flooded = (self.flooded_torque, self.flooded_torque_given)
        if not np.any(validity.differs(given, flooded)):
            return []
        numbers = [
            validity.BothTorques(quantity, *both)
            for quantity, *both in zip((WARM, GIVEN), given, flooded, strict=True)
            if np.isfinite(both).all()
        ]
        return validity.records(numbers)

    @property
    def _record(self) -> Record:
        end, result = self.equilibrium, self.numbers
        oil, given, nut = (
            units.shown(temperature, TEMPERATURE)
            for temperature in (result.oil_temperature, result.oil_temperature_given, end.nut_temperature)
        )
        preload = ""
        if end.network.preload_set:
            now, before = (
                units.shown(force, EQUILIBRIUM["preload"]) for force in (end.preload, end.network.preload_set)
            )
            preload = f", preload {now} in place of {before}"
        message = (
            f"self-heating: oil at {oil} in place of {given} (nut {nut}){preload}; friction torque "
            f"{units.shown(self.torque, _TORQUE)}, not {units.shown(self.torque_given, _TORQUE)}; stability margin of "
            f"the thermal loop {end.shown_margin}, thermal runaway at 0"
        )
        return Record(
            "verdict.self_heating",
            "lubricant.temperature",
            message,
            holds=True,
            value=end.oil_temperature,
            unit="K",
        )


def self_heating(case: Case) -> SelfHeating:
    """The case at the steady state of its operating point, going to and fro in its surroundings.

    Raises :class:`~ballscrew.basis.errors.InputError` where there is none, and as
    :func:`~ballscrew.questions.warm_up.compute.duty_of` does.
    """
    surroundings = case.surroundings or Surroundings()
    duty, stroke = duty_of(_point_of(case), surroundings)
    end = steady_heat(duty, surroundings, shaft_length=length_of(case, surroundings))
    if not end.exists:
        remedy = "see when with ballscrew warm-up; cool the shaft, turn slower, or preload less"
        raise InputError(
            Fault(OPTION, "finds no steady state in the range of oil and preload", f"margin {end.margin:.3g}", remedy)
        )
    warm = _warm(case, end)
    given, result = _friction(case), _friction(warm)
    flooded, flooded_torque = end, float(result.flooded_torque)
    if result.starvation:  # friction that is larger makes heat of its own, which takes some of it away
        flooded = equilibrium(dataclasses.replace(end.network, friction=friction_map(duty.flooded)))
        flooded_torque = float(_friction(_warm(case, flooded)).flooded_torque) if flooded.exists else math.nan
    return SelfHeating(
        case,
        warm,
        end,
        flooded,
        float(given.screw_torque),
        float(result.screw_torque),
        float(given.flooded_torque),
        flooded_torque,
        float(stroke or 0.0),
    )


def _warm(case: Case, end: Equilibrium) -> Case:
    """The case at the oil and the preload of a steady state."""
    screw, oil = case.screw, case.lubricant.at(end.oil_temperature)
    if end.network.preload_set:
        screw = dataclasses.replace(screw, nut=screw.nut.changed("preload", end.preload))
    of_oil = {**case.origins.oil, "temperature": end.oil_temperature}
    return dataclasses.replace(case, screw=screw, lubricant=oil, origins=dataclasses.replace(case.origins, oil=of_oil))


def _point_of(case: Case) -> Case:
    """The operating point alone."""
    return dataclasses.replace(case, axis=None, motion=None)


def swept(
    case: Case, outputs: Sequence[str], varied: Mapping[str, Any], done: Callable[[int, int], None] | None = None
) -> xr.Dataset:
    """A sweep whose points are each in their own steady state; ``assumed`` is among its attributes.

    Raises :class:`~ballscrew.basis.errors.InputError` as :func:`~ballscrew.axis.thermal.warm_sweep.warm_sweep` does.
    """
    from ballscrew.axis.thermal import warm_sweep  # loads xarray
    from ballscrew.engine.evaluation.plan import Configuration

    check_oil(case)
    surroundings, point = case.surroundings or Surroundings(), _point_of(case)
    stroke = stroke_of(point, surroundings)
    result, steady = warm_sweep.swept(
        Configuration(case.model, case.screw, case.lubricant),
        surroundings,
        varied,
        stroke=stroke,
        shaft_length=length_of(case, surroundings),
        outputs=outputs,
        done=done,
        also=point.bearings_by_name,
    )
    network = steady.network
    assumed = [] if network is None else assumed_of(case, surroundings, network, stroke)
    return result.assign_attrs(assumed="\n".join(assumed))


def _friction(case: Case) -> FrictionResult:
    point = case.operation
    return case.model(case.screw, case.lubricant, axial_load=point.axial_load, screw_speed=point.screw_speed)
