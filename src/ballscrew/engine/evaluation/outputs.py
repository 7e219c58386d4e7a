"""Inputs that can be varied and outputs that can be asked for: names, units and meanings, and axes of values to vary.

Axes are labelled arrays; faults in them are found here.
"""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.arrays import map_blocks
from ballscrew.basis.errors import Fault, fault_of, fault_of_declared_unit, without_unit
from ballscrew.basis.quantities import Info, Quantity, fields_of, quantities_of
from ballscrew.physics.components.materials import INPUTS_OF_SHEET, Lubricant
from ballscrew.physics.components.nut import Nut
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import MATERIALS, SINGLE_NUT, BallScrew
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.friction.validity import NUT_REASONS, REASONS
from ballscrew.physics.laws.contact import Contact, RaceState
from ballscrew.physics.solvers.load_distribution import BallLoads

if TYPE_CHECKING:
    import xarray as xr

#: The fields of the operating point, which every sweep needs.
OPERATION = tuple(fields_of(OperatingState))
#: Outputs of a sweep by default.
DEFAULT_OUTPUTS = (
    "screw_torque",
    "nut_torque",
    "ideal_torque",
    "efficiency",
    "back_driving_efficiency",
    "contact_load",
    "screw_film_parameter",
    "nut_film_parameter",
    "screw_friction_coefficient",
    "nut_friction_coefficient",
    "valid",
)


#: Scalar results of the loads of the balls of a nut.
OF_LOADS = ("deflection", "rigidity", "remaining_preload", "lift_off_load", "residual")
#: Results that only balls with two contacts have.
OF_TWO_CONTACTS = frozenset({"spin_moment", "lateral_force", "ball_friction_moment"})
#: Outputs of a sweep by default where the balls are preloaded or differ.
NUT_OUTPUTS = (
    "screw_torque",
    "nut_torque",
    "ideal_torque",
    "efficiency",
    "back_driving_efficiency",
    "largest_contact_load",
    "maximum_pressure",
    "deflection",
    "rigidity",
    "remaining_preload",
    "valid",
)


#: Outputs that are truth values, besides the validity.
TRUTHS = frozenset({"self_locking"})


@dataclasses.dataclass(frozen=True, eq=False)
class Output:
    """An output of a sweep: its name, its quantity, and the function that reads it from a result."""

    name: str
    quantity: Quantity
    read: Callable[[Any], Any]

    @property
    def dtype(self) -> type:
        """``bool`` for truth values, ``float`` for numbers."""
        return bool if self.name.startswith("valid") or self.name in TRUTHS else float


def known_outputs(nut: Nut = SINGLE_NUT) -> Mapping[str, Output]:
    """All outputs of a sweep by name: ``screw_torque``, ``nut_film_parameter``, ``rigidity``…

    Of balls that differ, results of a single contact are those of the most loaded ball.
    """
    return _outputs(nut.is_row, nut.contacts_per_ball, tuple(nut.losses))


@functools.cache
def _outputs(is_row: bool, contacts_per_ball: int, losses: tuple[str, ...]) -> Mapping[str, Output]:
    """The outputs of a screw whose nut has these losses."""
    outputs: dict[str, Output] = {}
    known = quantities_of(FrictionResult)
    for name, quantity in known.items():
        if name not in OPERATION and not (contacts_per_ball > 2 and name in OF_TWO_CONTACTS):
            outputs[name] = Output(name, quantity, lambda r, n=name: getattr(r, n))
    torque = known["screw_torque"]
    for mechanism, words in {**MECHANISMS, **{name: name for name in losses}}.items():
        info = dataclasses.replace(
            torque.info, symbol=f"M_S ({words})", meaning=f"friction torque on the screw by {words}"
        )
        name = f"contribution_{mechanism}"
        outputs[name] = Output(name, Quantity(name, torque.unit, info), lambda r, m=mechanism: r.contributions[m])
    mask = known["valid"]
    for reason, words in (REASONS if is_row else NUT_REASONS).items():
        name, info = f"validity_{reason}", Info(reason, f"holds where true; where false, {words}")
        outputs[name] = Output(name, Quantity(name, mask.unit, info), lambda r, n=reason: r.validity[n])
    of_loads = {name: quantities_of(BallLoads)[name] for name in OF_LOADS}
    outputs |= {n: Output(n, q, lambda r, n=n: getattr(r.loads, n)) for n, q in of_loads.items()}
    contact = RaceState if contacts_per_ball == 2 else Contact
    for side in ("screw", "nut"):
        for name, quantity in quantities_of(contact).items():
            info = dataclasses.replace(quantity.info, meaning=f"{quantity.info.meaning}, ball–{side} contact")
            full = f"{side}_{name}"
            outputs[full] = Output(
                full, Quantity(full, quantity.unit, info), lambda r, s=side, n=name: getattr(getattr(r, s), n)
            )
    return outputs


def inputs_of(model: FrictionModel, screw: BallScrew, lubricant: Lubricant) -> Mapping[str, tuple[str, Quantity]]:
    """All inputs that a sweep can vary: name to (part, quantity).

    Names are those of the fields; a coefficient of a law is ``law.field``, for example
    ``friction.boundary_friction_coefficient``, a number of a material ``ball_material.young_modulus``. Fields of the
    nut are ``nut.preload`` or ``preload``; those of what it loses ``losses.seals.seal_torque``. ``temperature`` is that
    of an oil made from a grade or from a data sheet, whose viscosities and density are inputs, too.
    """
    parts = {"operation": OperatingState, "screw": screw, "lubricant": lubricant, "model": model}
    inputs = {name: (part, quantity) for part, value in parts.items() for name, quantity in fields_of(value).items()}
    for body, material in zip(MATERIALS, screw.materials, strict=True):
        inputs |= {f"{body}.{name}": ("screw", quantity) for name, quantity in fields_of(material).items()}
    of_nut = fields_of(screw.nut)
    inputs |= {name: ("nut", quantity) for name, quantity in of_nut.items()}
    inputs |= {f"nut.{name}": ("nut", quantity) for name, quantity in of_nut.items()}
    for section, law in screw.nut.parts.items():
        if section.startswith("losses."):
            inputs |= {f"{section}.{name}": ("nut", quantity) for name, quantity in fields_of(law).items()}
    if lubricant.follows_temperature:
        inputs[TEMPERATURE.name] = ("lubricant", lubricant.temperature_quantity)
    if lubricant.sheet is not None:
        inputs |= {name: ("lubricant", quantity) for name, quantity in INPUTS_OF_SHEET.items()}
    for slot, law in model.laws_with_coefficients.items():
        inputs |= {f"{slot}.{name}": ("model", quantity) for name, quantity in fields_of(law).items()}
    return inputs


def slope_name(output: str, name: str) -> str:
    """The name of the derivative of an output by an input."""
    return f"d_{output}_d_{name.replace('.', '_')}"


def attributes_of(quantity: Quantity) -> dict[str, str]:
    """CF attributes of a variable, from its annotation."""
    attributes = {
        "long_name": quantity.info.meaning,
        "units": quantity.unit,
        "symbol": quantity.info.symbol,
    }
    if quantity.info.address:
        attributes["references"] = quantity.info.address
    return attributes


#: Numbers of a block: they are in the cache when they are read for the second time.
BLOCK = 2**18


def ends(values: NDArray[Any]) -> NDArray[Any]:
    """The least and the greatest element of an array with at least one; NaN as both where it has one."""
    if values.size <= 2 * BLOCK or not values.flags.c_contiguous:
        return np.array([values.min(), values.max()])
    flat = values.reshape(-1)
    result = np.empty((2, math.ceil(flat.size / BLOCK)), dtype=values.dtype)

    def of_block(block: slice) -> None:
        part = flat[block]
        result[:, block.start // BLOCK] = part.min(), part.max()

    map_blocks(of_block, flat.size, block_size=BLOCK)
    return np.array([result[0].min(), result[1].max()])


def axis_of(section: str, name: str, values: Any, quantity: Quantity) -> xr.DataArray | Fault:
    """Values as a labelled array: a sequence gets a dimension of its own name."""
    import xarray as xr  # for evaluations only

    where = f"{section}.{name}"
    numbers = without_unit(where, values.data if isinstance(values, xr.DataArray) else values, quantity.unit)
    if isinstance(numbers, Fault):
        return numbers
    if isinstance(values, xr.DataArray):
        if not all(isinstance(dimension, str) for dimension in values.dims):
            return Fault(where, "has a dimension whose name is no text", str(values.dims), "name it by a text")
        if (fault := fault_of_declared_unit(where, values, quantity.unit)) is not None:
            return fault
        numbers = values if numbers is values.data else values.copy(data=numbers)
    values = numbers
    try:
        if np.ma.isMaskedArray(values) or np.asarray(values).dtype.kind not in "fiu":
            raise TypeError("a mask would be lost, and what is no number would become one")
        if isinstance(values, xr.DataArray):
            axis = values.astype(float, copy=False)
        else:
            array = np.asarray(values, dtype=float)
            if array.ndim > 1:
                return Fault(where, "has several axes", f"shape {array.shape}", "name them: pass an xarray.DataArray")
            axis = xr.DataArray(array, dims=(name,) if array.ndim else ())
    except (TypeError, ValueError):
        return Fault(where, "must be numbers in SI", str(values), "give a number or a plain list of numbers")
    return axis if axis.size else Fault(where, "has no values", "", "give at least one")


def faults_of_axis(part: str, quantity: Quantity, values: np.ndarray, extremes: np.ndarray) -> list[Fault]:
    """Faults of an axis: its ends (NaN comes out as both) and, where whole numbers are needed, the first broken one."""
    telling = (extremes[:1] if np.isnan(extremes[0]) else extremes).tolist()
    if quantity.info.whole:
        telling += values[values != np.floor(values)].ravel()[:1].tolist()
    faults = [fault_of(part, quantity, float(value)) for value in dict.fromkeys(telling)]
    return [fault for fault in faults if fault is not None]
