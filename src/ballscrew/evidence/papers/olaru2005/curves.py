"""The data of the paper's Figs 5 to 9, and of the influences its text names without plotting them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from ballscrew.engine.sweeps.sweep import sweep
from ballscrew.evidence.papers.olaru2005 import case
from ballscrew.physics.equations.transmission import efficiency
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.validity import REASONS

#: The models whose figures are drawn.
DRAWN = ("olaru2005", "corrected")
_PARTS = tuple(f"contribution_{mechanism}" for mechanism in MECHANISMS)


def curves() -> xr.Dataset:
    """All curves in one dataset, in SI, with a dimension ``model``.

    Names begin with the figure (``fig6_screw_torque``), with ``parts_`` for the torque by mechanism,
    or with the influence (``viscosity_efficiency``). Loads are axial loads; ``fig8_contact_load`` is
    the paper's abscissa of Figs 8 and 9, and differs between the models as their Q(F) does.
    """
    known = case.models()
    parts = [_of_model(known[name]) for name in DRAWN]
    data = xr.concat(
        parts, xr.DataArray(list(DRAWN), dims="model", attrs={"long_name": "friction model"}), join="exact"
    )
    data.attrs = {
        "title": "The numerical program of Olaru2005, as printed and corrected",
        "Conventions": "CF-1.11",
        "source": parts[0].attrs["source"].partition(",")[0],
        "references": "; ".join(dict.fromkeys("; ".join(p.attrs["references"] for p in parts).split("; "))),
        "comment": "; ".join(f"{choice.what}: {choice.taken}" for choice in case.CHOICES),
    }
    return data


def _of_model(model: FrictionModel) -> xr.Dataset:
    def over_speed(*outputs: str, **varied: Any) -> xr.Dataset:
        return sweep(
            model,
            case.SCREW,
            case.OIL,
            outputs=outputs,
            axial_load=case.AXIAL_LOAD,
            **varied,
            screw_speed=case.SPEEDS,
        ).drop_vars("axial_load")

    conformity = xr.DataArray(case.CONFORMITIES, dims="conformity")
    chain = over_speed("screw_torque", "nut_torque", "efficiency", ball_to_ball_force=case.BALL_TO_BALL_FORCES)
    pair = chain.isel(ball_to_ball_force=[1, 2]).rename(ball_to_ball_force="fig5_ball_to_ball_force")
    speed = over_speed(
        "screw_torque",
        "efficiency",
        "screw_film_parameter",
        "nut_film_parameter",
        "screw_friction_coefficient",
        "nut_friction_coefficient",
        *_PARTS,
    )
    conformities = over_speed("screw_torque", "efficiency", screw_conformity=conformity, nut_conformity=conformity)
    groups: Mapping[str, xr.Dataset] = {
        "fig5": pair[["screw_torque", "nut_torque"]],
        "fig6": speed[["screw_torque"]],
        "fig7": speed[["efficiency"]],
        "parts": speed.drop_vars(["screw_torque", "efficiency"]),
        "viscosity": over_speed("screw_torque", "efficiency", viscosity=case.VISCOSITIES),
        "conformity": conformities.drop_vars(["screw_conformity", "nut_conformity"]).assign_coords(
            conformity=("conformity", case.CONFORMITIES, {"long_name": "conformity of both races", "units": "1"})
        ),
        "ball_friction": over_speed(
            "screw_torque", "efficiency", ball_friction_coefficient=case.BALL_FRICTION_COEFFICIENTS
        ),
        "ball_force": chain[["screw_torque", "efficiency"]],
        **_over_load(model),
    }
    merged = xr.merge(
        [group.rename({name: f"{label}_{name}" for name in group.data_vars}) for label, group in groups.items()],
        join="exact",
        combine_attrs="override",
    )
    return merged.assign_attrs(chain.attrs)


def _over_load(model: FrictionModel) -> Mapping[str, xr.Dataset]:
    """Figs 8 and 9, with the range in which the ball would skid and that in which the contact is too light."""
    load = sweep(
        model,
        case.SCREW,
        case.OIL,
        outputs=("screw_torque", "ideal_torque", "efficiency", "contact_load"),
        axial_load=case.LOADS,
        screw_speed=case.SCREW_SPEED,
    ).drop_vars("screw_speed")
    # by (36) as it is printed, which begins at zero, where a result has none
    load["efficiency"] = load["efficiency"].copy(data=efficiency(load["ideal_torque"], load["screw_torque"]))
    result = model(case.SCREW, case.OIL, axial_load=case.LOADS, screw_speed=case.SCREW_SPEED)
    for reason in ("skid", "elastic_regime"):
        fails = ~np.asarray(result.validity[reason])
        load[reason] = ("axial_load", fails, {"long_name": REASONS[reason], "units": "1"})
    return {
        "fig8": load[["screw_torque", "contact_load", "skid", "elastic_regime"]],
        "fig9": load[["efficiency"]],
    }
