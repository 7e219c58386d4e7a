"""ballscrew: what a ball screw loses to friction, and why, term by term.

The front door. Names are loaded when they are first used, so that ``import ballscrew`` costs
little more than NumPy.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ballscrew.analyses.calibrated import CalibratedModel as CalibratedModel
    from ballscrew.analyses.calibration import fit as fit
    from ballscrew.analyses.derivatives import derivatives as derivatives
    from ballscrew.analyses.distributions import LogNormal as LogNormal
    from ballscrew.analyses.distributions import Normal as Normal
    from ballscrew.analyses.distributions import Triangular as Triangular
    from ballscrew.analyses.distributions import Uniform as Uniform
    from ballscrew.analyses.monte_carlo import monte_carlo as monte_carlo
    from ballscrew.analyses.sensitivity import sensitivity as sensitivity
    from ballscrew.analyses.sweep import sweep as sweep
    from ballscrew.analyses.torque_log import TorqueLog as TorqueLog
    from ballscrew.analyses.uncertainty import band as band
    from ballscrew.assembly import nut_friction as nut_friction
    from ballscrew.components.catalogue import catalogue as catalogue
    from ballscrew.components.lubrication import HamrockDowson as HamrockDowson
    from ballscrew.components.materials import Lubricant as Lubricant
    from ballscrew.components.materials import Material as Material
    from ballscrew.components.mixed_friction import ZhouHoeprich as ZhouHoeprich
    from ballscrew.components.nut import Bodies as Bodies
    from ballscrew.components.nut import Deviations as Deviations
    from ballscrew.components.nut import DoubleNut as DoubleNut
    from ballscrew.components.nut import OffsetLeadNut as OffsetLeadNut
    from ballscrew.components.nut import OversizeBallNut as OversizeBallNut
    from ballscrew.components.nut import SingleNut as SingleNut
    from ballscrew.components.nut_losses import Seals as Seals
    from ballscrew.components.screw import BallScrew as BallScrew
    from ballscrew.faults import InputError as InputError
    from ballscrew.model import FrictionModel as FrictionModel
    from ballscrew.result import FrictionResult as FrictionResult

__version__ = "0.1.0"

_HOMES = {
    "BallScrew": "ballscrew.components.screw",
    "Bodies": "ballscrew.components.nut",
    "CalibratedModel": "ballscrew.analyses.calibrated",
    "Deviations": "ballscrew.components.nut",
    "DoubleNut": "ballscrew.components.nut",
    "FrictionModel": "ballscrew.model",
    "FrictionResult": "ballscrew.result",
    "HamrockDowson": "ballscrew.components.lubrication",
    "InputError": "ballscrew.faults",
    "LogNormal": "ballscrew.analyses.distributions",
    "Lubricant": "ballscrew.components.materials",
    "Material": "ballscrew.components.materials",
    "Normal": "ballscrew.analyses.distributions",
    "OffsetLeadNut": "ballscrew.components.nut",
    "OversizeBallNut": "ballscrew.components.nut",
    "Seals": "ballscrew.components.nut_losses",
    "SingleNut": "ballscrew.components.nut",
    "TorqueLog": "ballscrew.analyses.torque_log",
    "Triangular": "ballscrew.analyses.distributions",
    "Uniform": "ballscrew.analyses.distributions",
    "ZhouHoeprich": "ballscrew.components.mixed_friction",
    "band": "ballscrew.analyses.uncertainty",
    "catalogue": "ballscrew.components.catalogue",
    "derivatives": "ballscrew.analyses.derivatives",
    "fit": "ballscrew.analyses.calibration",
    "monte_carlo": "ballscrew.analyses.monte_carlo",
    "nut_friction": "ballscrew.assembly",
    "sensitivity": "ballscrew.analyses.sensitivity",
    "sweep": "ballscrew.analyses.sweep",
}

__all__ = [
    "BallScrew",
    "Bodies",
    "CalibratedModel",
    "Deviations",
    "DoubleNut",
    "FrictionModel",
    "FrictionResult",
    "HamrockDowson",
    "InputError",
    "LogNormal",
    "Lubricant",
    "Material",
    "Normal",
    "OffsetLeadNut",
    "OversizeBallNut",
    "Seals",
    "SingleNut",
    "TorqueLog",
    "Triangular",
    "Uniform",
    "ZhouHoeprich",
    "__version__",
    "band",
    "catalogue",
    "derivatives",
    "fit",
    "monte_carlo",
    "nut_friction",
    "sensitivity",
    "sweep",
]


def __getattr__(name: str) -> Any:
    home = _HOMES.get(name)
    if home is None:
        raise AttributeError(f"module 'ballscrew' has no attribute {name!r}")
    value = getattr(importlib.import_module(home), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
