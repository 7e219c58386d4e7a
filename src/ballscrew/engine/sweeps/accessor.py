"""What datasets of sweeps can do besides what xarray does: ``ds.ballscrew``."""

from __future__ import annotations

from typing import Any

import xarray as xr

from ballscrew.basis.displayed import notebook


@xr.register_dataset_accessor("ballscrew")
class SweepAccessor:
    """Pictures of a sweep: ``ds.ballscrew.plot_map("screw_torque")``."""

    def __init__(self, dataset: xr.Dataset) -> None:
        self._dataset = dataset

    def plot_map(self, output: str = "screw_torque") -> Any:
        """Picture of an output over the axes of the sweep: contours over two, a line over one.

        It is hatched or shaded where the model does not hold. A notebook shows the picture; its ``save(path)`` writes
        .png, .svg or .pdf. Raises :class:`~ballscrew.basis.errors.InputError` for an unknown output, and for more axes.
        """
        return notebook("pictures").sweep_map(self._dataset, output)
