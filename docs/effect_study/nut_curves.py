"""Curves of a nut under load and preload: loads of all balls, deflection, torque, and drag."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import Bodies, Deviations, DoubleNut, Nut, OversizeBallNut, SingleNut
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.laws.nut_losses import DOUBLE_NUT_DRAG, OVERSIZE_BALL_DRAG, JISDrag, RexrothDrag
from ballscrew.physics.sizing.catalogue import CatalogueRow, catalogue
from ballscrew.physics.solvers.load_distribution import BallLoads, ball_loads
from effect_study.cases import RPM

Values = NDArray[np.float64]

#: The screw of the curves, its preload as a share of its rating, and the scatter of its balls.
ROW, PRELOAD_SHARE, SCATTER, SEED = "rexroth-40x10x6-6-double", 0.07, 0.5e-6, 1
#: Its oil and its speed; the drag of preloads is that of vendors' tables, slow and cold.
GRADE, TEMPERATURE, SPEED = "ISO VG 100", 313.15, 600 * RPM
DRAG_TEMPERATURE, DRAG_SPEED = 298.15, 100 * RPM


def row() -> CatalogueRow:
    """The catalogue row of the curves."""
    return catalogue()[ROW]


def preload() -> float:
    """Its preload, N."""
    return PRELOAD_SHARE * float(row().dynamic_load_rating or 0.0)


class DistributionCurves(NamedTuple):
    """Load of each ball of a nut without preload, rigid and elastic, and with balls that scatter."""

    axial_load: float
    rigid: float
    #: By the ends at which screw and nut are held.
    elastic: Mapping[str, Values]
    scattered: Values


def distribution_curves() -> DistributionCurves:
    """Load distribution at a quarter of the dynamic load rating."""
    screw, load = row().screw(), 0.25 * float(row().dynamic_load_rating or 0.0)

    def loads(bodies: Bodies | None, deviations: Deviations | None = None) -> Values:
        return ball_loads(screw, SingleNut(), load, bodies=bodies, deviations=deviations).forward_load

    scatter = Deviations.scattered(int(screw.loaded_balls), seed=SEED, ball_diameter=SCATTER)
    return DistributionCurves(
        load,
        float(loads(None)[0]),
        {
            "held on the same side": loads(Bodies.of(screw)),
            "held on opposite sides": loads(Bodies.of(screw, same_side=False)),
        },
        loads(Bodies.of(screw), scatter),
    )


def nuts() -> Mapping[str, Nut]:
    """Nuts to compare, by name."""
    return {
        "single nut, no preload": SingleNut(angle_under_load=True),
        "double nut": DoubleNut(preload=preload()),
        "single nut, oversize balls": OversizeBallNut(preload=preload()),
    }


class PreloadCurves(NamedTuple):
    """Loads, deflection, torque and efficiency over the axial load, by nut."""

    axial_load: Values
    loads: Mapping[str, BallLoads]
    friction: Mapping[str, FrictionResult]


@functools.cache
def preload_curves() -> PreloadCurves:
    """Curves from no load to well beyond lift-off of the second half."""
    load = np.linspace(0.0, 4.0, 81) * preload()
    oil = Lubricant.from_grade(GRADE, temperature=TEMPERATURE)
    model = FrictionModel.reference()
    friction = {
        words: model(dataclasses.replace(row().screw(), nut=nut), oil, axial_load=load, screw_speed=SPEED)
        for words, nut in nuts().items()
    }
    return PreloadCurves(load, {words: result.loads for words, result in friction.items()}, friction)


class DragCurves(NamedTuple):
    """Drag torque of the preload over preload and nominal diameter, over lead over diameter."""

    lead_ratio: Values
    #: By kind of nut: the model, and the rules of vendors.
    model: Mapping[str, Values]
    rexroth: Mapping[str, float]
    jis: Values


def drag_curves(model: FrictionModel) -> DragCurves:
    """The screw of the curves with other leads, at the vendors' oil, temperature and speed."""
    row_, ratio = row(), np.linspace(0.1, 1.0, 37)
    d_0 = float(row_.nominal_diameter)
    leads = np.maximum(ratio * d_0, 1.02 * float(row_.ball_diameter))
    ratio = leads / d_0
    oil = Lubricant.from_grade(GRADE, temperature=DRAG_TEMPERATURE)
    found: dict[str, Values] = {}
    for words, nut in nuts().items():
        if isinstance(nut, SingleNut):
            continue
        screws = [dataclasses.replace(_with_lead(row_, lead), nut=nut) for lead in leads]
        torques = [model(screw, oil, axial_load=0.0, screw_speed=DRAG_SPEED).screw_torque for screw in screws]
        found[words] = np.array(torques) / (preload() * d_0)
    rexroth = {
        words: RexrothDrag(coefficient)(preload(), d_0, row_.ball_circle, row_.lead) / (preload() * d_0)
        for words, coefficient in zip(found, (DOUBLE_NUT_DRAG, OVERSIZE_BALL_DRAG), strict=True)
    }
    jis = JISDrag()(preload(), d_0, row_.ball_circle, leads) / (preload() * d_0)
    return DragCurves(ratio, found, rexroth, jis)


def _with_lead(row_: CatalogueRow, lead: float) -> BallScrew:
    return dataclasses.replace(row_, lead=lead).screw()
