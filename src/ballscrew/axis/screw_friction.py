"""Friction of the ball screw along a motion: every distinct operating point is computed once."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ballscrew._arrays import ByValue
from ballscrew.components.materials import Lubricant
from ballscrew.components.screw import BallScrew
from ballscrew.equations import transmission
from ballscrew.evaluation.evaluator import evaluator
from ballscrew.evaluation.outputs import known_outputs
from ballscrew.friction.model import FrictionModel
from ballscrew.motion.states import Numbers
from ballscrew.quantities import Length, Ratio

#: More balls than this in all points together, and the model is compiled.
WORTH_RECORDING = 200_000


@dataclasses.dataclass(frozen=True, eq=False)
class ScrewFriction(ByValue):
    """Friction on the screw at states of motion."""

    #: Magnitude, N m.
    torque: Numbers
    #: By mechanism; the parts sum to the torque.
    contributions: Mapping[str, Numbers]
    #: Torque without friction, with the sign of the load, N m.
    ideal_torque: Numbers
    #: Where the model may be trusted.
    valid: NDArray[np.bool_]
    #: Masks by condition, False where it fails.
    validity: Mapping[str, NDArray[np.bool_]]
    #: Largest contact pressure, Pa, and least film parameter; NaN of an element without contacts.
    maximum_pressure: Numbers
    film_parameter: Numbers
    #: Distinct operating points.
    points: int


class Screw(Protocol):
    """What turns the shaft's torque into a force along the axis, with friction."""

    @property
    def lead(self) -> Length:
        """Advance in one turn, m."""
        ...

    def along(self, axial_load: Numbers, screw_speed: Numbers, temperature: Numbers) -> ScrewFriction:
        """Friction at loads and speeds with their signs; where the temperature is NaN, it is that of the oil."""
        ...


@dataclasses.dataclass(frozen=True, eq=False)
class ModelledScrew(ByValue):
    """A ball screw with its oil and the model of its friction."""

    model: FrictionModel
    screw: BallScrew
    lubricant: Lubricant

    @property
    def lead(self) -> Length:
        """Advance in one turn, m."""
        return self.screw.lead

    def along(self, axial_load: Numbers, screw_speed: Numbers, temperature: Numbers) -> ScrewFriction:
        """Friction at loads and speeds with their signs; each distinct point is computed once."""
        own = np.nan if self.lubricant.temperature is None else float(self.lubricant.temperature)
        warm = np.where(np.isnan(temperature), own, temperature)
        table = np.stack([axial_load, screw_speed, warm])
        distinct, back = np.unique(table, axis=1, return_inverse=True)
        found = self._at(*distinct)
        places = back.reshape(-1)
        flat: dict[str, Any] = {
            name: np.broadcast_to(values, distinct.shape[1:])[places] for name, values in found.items()
        }
        named = {
            kind: {name.removeprefix(kind): values for name, values in flat.items() if name.startswith(kind)}
            for kind in ("contribution_", "validity_")
        }
        return ScrewFriction(
            torque=flat["screw_torque"],
            contributions=named["contribution_"],
            ideal_torque=flat["ideal_torque"],
            valid=flat["valid"],
            validity=named["validity_"],
            maximum_pressure=flat["maximum_pressure"],
            film_parameter=flat["minimum_film_parameter"],
            points=distinct.shape[1],
        )

    def _at(self, axial_load: Numbers, screw_speed: Numbers, temperature: Numbers) -> Mapping[str, Any]:
        known = known_outputs(self.screw.nut)
        names = ["screw_torque", "ideal_torque", "valid", "maximum_pressure", "minimum_film_parameter"]
        names += [name for name in known if name.startswith(("contribution_", "validity_"))]
        warms = bool(np.any(temperature != temperature[:1]))
        balls = self.screw.nut.halves * int(self.screw.loaded_balls) if self.screw.nut.one_by_one else 1
        values: dict[str, Any] = {"axial_load": axial_load, "screw_speed": screw_speed}
        oil = self.lubricant
        if warms:
            values["temperature"] = temperature
        elif not np.isnan(temperature[:1]).all() and float(temperature[0]) != oil.temperature:
            oil = oil.at(float(temperature[0]))
        if len(axial_load) * balls > WORTH_RECORDING:
            return evaluator(self.model, self.screw, oil, inputs=tuple(values), outputs=names)(**values)
        result = self.model(self.screw, oil, **values)
        return {name: known[name].read(result) for name in names}


@dataclasses.dataclass(frozen=True, eq=False)
class ConstantEfficiency(ByValue):
    r"""A screw of one efficiency at all loads and speeds: :math:`M_S = |M_{Sa}| (1/\eta - 1)`.

    It knows no oil, no speed and no preload. Lowering, the load drives with :math:`\eta_b = 2 - 1/\eta`: the friction
    torque is the same both ways.
    """

    lead: Length
    efficiency: Ratio

    def along(self, axial_load: Numbers, screw_speed: Numbers, temperature: Numbers) -> ScrewFriction:  # noqa: ARG002
        """Friction at loads with their signs."""
        ideal = transmission.ideal_torque(axial_load, self.lead)
        torque = np.abs(ideal) * (1 / self.efficiency - 1)
        nothing, everywhere = np.full_like(ideal, np.nan), np.ones(ideal.shape, dtype=bool)
        return ScrewFriction(torque, {"efficiency": torque}, ideal, everywhere, {}, nothing, nothing, len(ideal))
