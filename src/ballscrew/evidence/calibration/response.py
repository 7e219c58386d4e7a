"""The torque of a log as a model has it, and its exact derivatives by the numbers that are free."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ballscrew.basis.errors import (
    ONE_BY_ONE,
    Fault,
    InputError,
    nearest,
    raise_if_any,
)
from ballscrew.basis.records import Message
from ballscrew.engine.evaluation.derivatives import slopes_of
from ballscrew.engine.evaluation.engines import Engine
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.physics.components.materials import TEMPERATURE

#: The torques that every reading of a log is made of, in this order.
TORQUES = ("ideal_torque", "screw_torque")


def resolve_input(subject: Configuration, name: str, section: str = "fit") -> str:
    """The input of that name: its own, that of a coefficient without its law, or either with its section.

    Raises :class:`~ballscrew.basis.errors.InputError` for what no input or more than one is called.
    """
    known = subject.inputs
    bare = name.removeprefix("model.").removeprefix("screw.").removeprefix("lubricant.")
    found = [bare] if bare in known else [other for other in known if other.rpartition(".")[2] == bare]
    if len(found) > 1:
        raise InputError(
            Fault(
                f"{section}.free",
                "could be several numbers",
                name,
                Message("one of {names}", {"names": ", ".join(found)}),
            )
        )
    if not found:
        raise InputError(Fault(f"{section}.free", "unknown name", name, nearest(bare, known)))
    if found[0] in OPERATION or found[0] == TEMPERATURE.name:
        raise InputError(Fault(f"{section}.free", "is given by the log", name, "leave it out"))
    if known[found[0]][1].info.whole:
        raise InputError(Fault(f"{section}.free", "is a whole number, which cannot be fitted", name, "leave it out"))
    return found[0]


def initial_value(subject: Configuration, name: str) -> float:
    """The value that a number has before it is fitted."""
    value = subject.value_of(name)
    if value is None and name == "ball_to_ball_force":
        value = subject.model.imposed_ball_force(subject.screw)
    if value is None:
        raise InputError(Fault(f"fit.{name}", "has no value to start from", "", "set it in the case, or leave it out"))
    if np.ndim(value):
        raise InputError(Fault(f"fit.{name}", "is an array", "", "give one number"))
    return float(value)


@dataclasses.dataclass(frozen=True, eq=False)
class Response:
    """Both torques at every row of a log, and their derivatives, for any values of the free numbers.

    The formulas are recorded once, and compiled at most once.
    """

    names: tuple[str, ...]
    start: NDArray[np.float64]
    evaluation: Evaluation

    @classmethod
    def of(
        cls,
        subject: Configuration,
        names: Sequence[str],
        points: Mapping[str, NDArray[np.float64]],
        *,
        engine: Engine | None = None,
        times: int = 1,
    ) -> Response:
        """``points`` are the magnitudes of load and speed, and perhaps the temperature, all of one length.

        ``times`` says how often the whole will be evaluated. Raises :class:`~ballscrew.basis.errors.InputError` for
        a law that cannot be recorded, and for values that are refused.
        """
        if subject.nut.one_by_one:
            remedy = "leave out [bodies] and [deviations]: balls that differ are not fitted"
            raise_if_any([Fault("fit", "knows no nuts whose balls differ", "", remedy, id=ONE_BY_ONE)])
        start = np.array([initial_value(subject, name) for name in names])
        rows = {name: xr.DataArray(values, dims="row") for name, values in points.items()}
        held = dict(zip(names, start.tolist(), strict=True))
        plan = slopes_of(subject, TORQUES, list(names), {**rows, **held})
        return cls(tuple(names), start, Evaluation.of(plan, engine, times, shared=True))

    def at(self, points: Mapping[str, NDArray[np.float64]]) -> Response:
        """The same at other rows, which are not checked."""
        rows = {name: xr.DataArray(held, dims="row") for name, held in points.items()}
        return dataclasses.replace(self, evaluation=self.evaluation.at(rows))

    def fits(self, values: NDArray[np.float64]) -> bool:
        """Return whether the parts accept these values of the free numbers."""
        try:
            self.evaluation.plan.subject.changed(dict(zip(self.names, values.tolist(), strict=True)))
        except InputError:
            return False
        return True

    def __call__(self, values: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The torques, of shape (torques, rows), and their derivatives, of shape (torques, rows, numbers).

        All NaN where the numbers do not fit together, such as balls too big for the screw.
        """
        if not self.fits(values):
            shape = (len(TORQUES), self.evaluation.plan.total)
            return np.full(shape, np.nan), np.full((*shape, values.size), np.nan)
        made = self.evaluation.at(dict(zip(self.names, values.tolist(), strict=True)))
        found = made.empty(made.plan.total)
        made.fill(found, slice(0, made.plan.total))
        torques = np.stack([found[torque] for torque in TORQUES])
        slopes = [[found[f"d_{torque}_d_{name.replace('.', '_')}"] for name in self.names] for torque in TORQUES]
        return torques, np.moveaxis(np.array(slopes), 1, 2)
