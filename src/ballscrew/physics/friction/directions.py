"""Torque and efficiency in the four quadrants: what load and motion make of an ideal torque and a friction torque."""

from __future__ import annotations

from ballscrew.basis.arrays import where
from ballscrew.basis.quantities import Array, Force, Mask, Ratio, Torque
from ballscrew.physics.equations import transmission


def direction_of(screw_speed: Array) -> Array:
    """The sign of a speed: 1, -1, or 0 at rest."""
    return where(screw_speed > 0, 1.0, where(screw_speed < 0, -1.0, 0.0))


def holding_torque(ideal_torque: Torque, screw_torque: Torque) -> Torque:
    """Torque on the shaft that holds a load of either sign; of the other sign than the load's where it locks itself."""
    size = transmission.holding_torque(abs(ideal_torque), screw_torque)
    return where(ideal_torque < 0, -size, size)


def load_drives(holding_torque: Torque, axial_load: Force) -> Mask:
    """Mask: the load alone turns the screw; False where the torque is NaN."""
    return holding_torque * axial_load > 0


def locks_itself(ideal_torque: Torque, screw_torque: Torque) -> Mask:
    """Mask: there is a load, and friction holds it."""
    size = abs(ideal_torque)
    return (size > 0) & (size <= screw_torque)


def direct_efficiency(ideal_torque: Torque, screw_torque: Torque) -> Ratio:
    """Efficiency if the screw drove the load; NaN without a load."""
    size = abs(ideal_torque)
    loaded = ideal_torque != 0
    eta = transmission.efficiency(where(loaded, size, 1.0), screw_torque)
    return where(loaded, eta, float("nan"))


def efficiency(ideal_torque: Torque, screw_torque: Torque, direction: Array) -> Ratio:
    """Efficiency where the screw drives the load, at rest its limit; NaN elsewhere."""
    drives = ((ideal_torque > 0) & (direction >= 0)) | ((ideal_torque < 0) & (direction <= 0))
    return where(drives, direct_efficiency(ideal_torque, screw_torque), float("nan"))
