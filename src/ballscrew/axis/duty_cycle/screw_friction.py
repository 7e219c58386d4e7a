"""Friction of the ball screw along a motion: every distinct operating point is computed once."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ballscrew.axis.motion.states import Numbers
from ballscrew.basis.arrays import ByValue, compact, lazy
from ballscrew.basis.errors import faults_of, raise_if_any
from ballscrew.basis.quantities import Info, Length, Ratio
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import transmission
from ballscrew.physics.friction.loaded_balls import loads_of
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.validity import least_replenished
from ballscrew.physics.solvers.load_distribution import BallLoads

#: More balls than this in all points together, and the model is compiled.
WORTH_RECORDING = 200_000
#: The loads of the balls are kept at up to so many axial loads at a time.
FEW_LOADS = 64
#: A greater share of distinct points, and they are not sorted out.
REPEATED = 0.8
_OUTPUTS = ("screw_torque", "ideal_torque", "valid", "maximum_pressure", "minimum_film_parameter")


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
    #: Operating points that the model was asked for: those of states that were added later count anew.
    points: int

    def joined(self, more: ScrewFriction, place: NDArray[np.intp]) -> ScrewFriction:
        """The friction at states whose ``place`` is one among these states and, after them, those of ``more``."""

        def of_both(own: Any, others: Any) -> Any:
            if isinstance(own, Mapping):
                return {name: of_both(values, others[name]) for name, values in own.items()}
            return compact(np.concatenate([own, others])[place]) if isinstance(own, np.ndarray) else own + others

        names = [field.name for field in dataclasses.fields(self)]
        return ScrewFriction(**{name: of_both(getattr(self, name), getattr(more, name)) for name in names})


class Screw(Protocol):
    """Element that turns the shaft's torque into a force along the axis, with friction."""

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
    #: Evaluated by the recording that all screws of a kind share, however few the points: for one screw after another.
    recorded: bool = False

    @property
    def lead(self) -> Length:
        """Advance in one turn, m."""
        return self.screw.lead

    @lazy
    def in_full_bath(self) -> ModelledScrew:
        """The same with its balls in a full bath of oil; itself where nothing comes back late."""
        full = self.model.in_full_bath
        if full is self.model:
            return self
        modelled_screw = dataclasses.replace(self, model=full)
        vars(modelled_screw)["_solved"] = self._solved  # the loads of the balls have nothing of the oil
        return modelled_screw

    def least_replenished(self, screw_speed: Numbers, temperature: Numbers) -> Ratio:
        """Least share of the rolling force that oil coming back late leaves over."""
        oil, warm = self.lubricant, temperature
        if oil.temperature is not None:
            oil = oil.at(np.where(np.isnan(warm), oil.temperature, warm))
        return least_replenished(self.model, self.screw, oil, screw_speed)

    def along(self, axial_load: Numbers, screw_speed: Numbers, temperature: Numbers) -> ScrewFriction:
        """Friction at loads and speeds with their signs; each distinct point is computed once."""
        own = np.nan if self.lubricant.temperature is None else float(self.lubricant.temperature)
        warm = np.where(np.isnan(temperature), own, temperature)
        distinct, back = distinct_states(axial_load, screw_speed, warm)
        outputs = self._outputs([*_OUTPUTS, *self._names("contribution_")], distinct)
        valid = outputs["valid"]
        reasons = self._names("validity_")
        masks = {name: np.ones(valid.shape, dtype=bool) for name in reasons}
        if not valid.all():  # which condition fails is asked only where one does
            for name, mask in self._outputs(reasons, distinct[:, ~valid]).items():
                masks[name][~valid] = mask
        every = {name: compact(values[back]) for name, values in {**outputs, **masks}.items()}
        named = {
            kind: {name.removeprefix(kind): values for name, values in every.items() if name.startswith(kind)}
            for kind in ("contribution_", "validity_")
        }
        return ScrewFriction(
            torque=every["screw_torque"],
            contributions=named["contribution_"],
            ideal_torque=every["ideal_torque"],
            valid=every["valid"],
            validity=named["validity_"],
            maximum_pressure=every["maximum_pressure"],
            film_parameter=every["minimum_film_parameter"],
            points=distinct.shape[1],
        )

    def loads_at(self, axial_load: Numbers) -> BallLoads | None:
        """Loads of the balls that are solved one by one, kept for the next question at the same few loads; else None.

        They depend on the axial load alone, but for a preload that was set at rest: cycle, fall and start of an axis
        ask for the same ones.
        """
        if not self.screw.nut.one_by_one or self.screw.nut.set_at_rest:
            return None
        distinct, back = np.unique(axial_load, return_inverse=True)
        if distinct.size > FEW_LOADS:
            return None
        for known, solved in self._solved.items():
            if set(distinct.tolist()) <= set(known):
                return solved.at(np.searchsorted(known, axial_load))
        solved = self._solved[tuple(distinct.tolist())] = loads_of(self.screw, distinct)
        return solved.at(back)

    @lazy
    def _solved(self) -> dict[tuple[float, ...], BallLoads]:
        """Loads of the balls by axial loads."""
        return {}

    def _names(self, kind: str) -> list[str]:
        return [name for name in known_outputs(self.screw.nut) if name.startswith(kind)]

    def _outputs(self, names: Sequence[str], points: Numbers) -> dict[str, Any]:
        """Outputs at loads, speeds and temperatures, one row each; compiled where there are many points."""
        axial_load, screw_speed, temperature = points
        values: dict[str, Any] = {"axial_load": axial_load, "screw_speed": screw_speed}
        oil = self.lubricant
        if not _is_one(temperature):
            values["temperature"] = temperature
        elif not np.isnan(temperature[:1]).all() and float(temperature[0]) != oil.temperature:
            oil = oil.at(float(temperature[0]))
        balls = self.screw.nut.halves * int(self.screw.loaded_balls) if self.screw.nut.one_by_one else 1
        if self.recorded or len(axial_load) * balls > WORTH_RECORDING:
            from ballscrew.engine.evaluation.evaluator import evaluator  # loads xarray: for many points only

            return evaluator(self.model, self.screw, oil, inputs=tuple(values), outputs=names)(**values)
        result = self.model(self.screw, oil, **values, loads=self.loads_at(axial_load))
        known = known_outputs(self.screw.nut)
        return {name: np.broadcast_to(known[name].read(result), axial_load.shape) for name in names}


def distinct_states(axial_load: Numbers, screw_speed: Numbers, temperature: Numbers) -> tuple[Numbers, Any]:
    """Distinct operating points, one column each, and the place of every state among them; all where few repeat."""
    every = np.stack([axial_load, screw_speed, temperature])
    if _is_one(temperature):
        # load and speed as one complex number sort ten times as fast as columns of three
        pairs, back = np.unique(axial_load + 1j * screw_speed, return_inverse=True)
        values = np.stack([pairs.real, pairs.imag, np.full(pairs.size, temperature[0] if temperature.size else np.nan)])
    else:
        values, back = np.unique(every, axis=1, return_inverse=True)
    return (every, slice(None)) if values.shape[1] > REPEATED * every.shape[1] else (values, back.reshape(-1))


def _is_one(temperature: Numbers) -> bool:
    """True where all temperatures are the same; NaN, that of an oil without one, is the same as NaN."""
    return bool(np.all((temperature == temperature[:1]) | (np.isnan(temperature) & np.isnan(temperature[:1]))))


@dataclasses.dataclass(frozen=True, eq=False)
class ConstantEfficiency(ByValue):
    r"""A screw of one efficiency at all loads and speeds: :math:`M_S = |M_{Sa}| (1/\eta - 1)`.

    It knows no oil, no speed and no preload. Lowering, the load drives with :math:`\eta_b = 2 - 1/\eta`: the friction
    torque is the same both ways. Raises :class:`~ballscrew.basis.errors.InputError` for what is no efficiency.
    """

    lead: Length
    efficiency: Annotated[
        Ratio, Info(r"\eta", "efficiency at all loads and speeds", above=0, at_most=1, hint="catalogues have 0.9")
    ]

    def __post_init__(self) -> None:
        raise_if_any(faults_of("model", self))

    def along(self, axial_load: Numbers, screw_speed: Numbers, temperature: Numbers) -> ScrewFriction:  # noqa: ARG002  (as Screw)
        """Friction at loads with their signs."""
        ideal = transmission.ideal_torque(axial_load, self.lead)
        torque = np.abs(ideal) * (1 / self.efficiency - 1)
        nothing, everywhere = np.full_like(ideal, np.nan), np.ones(ideal.shape, dtype=bool)
        return ScrewFriction(torque, {"efficiency": torque}, ideal, everywhere, {}, nothing, nothing, len(ideal))
