"""Names of laws, as case files and tables have them.

A row here gives a law a name and no more. Whether the uncertainty band counts it as an alternative is declared beside
the law (:mod:`ballscrew.physics.components.traits`).
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

from ballscrew.basis.errors import Fault, nearest
from ballscrew.basis.quantities import Quantity, fields_of
from ballscrew.physics.components import chain_force, film_laws, frame, laws, mixed_friction, rolling_laws
from ballscrew.physics.solvers.ellipse_slip import ellipse_slip
from ballscrew.physics.solvers.line_slip import line_slip
from ballscrew.physics.solvers.pure_rolling import curvature_slip

#: The laws of each slot by name: functions, and classes where a law has coefficients.
LAWS: Mapping[str, Mapping[str, Any]] = {
    "frame": {"bearing": frame.bearing_frame, "helix": frame.helix_frame},
    "hertz": {"houpert": laws.houpert_hertz, "exact": laws.exact_hertz, "brewe-hamrock": laws.brewe_hamrock_hertz},
    "film": {
        "hamrock-dowson": film_laws.HamrockDowson,
        "hamrock-dowson-central": film_laws.hamrock_dowson_central,
        "chittenden": film_laws.chittenden,
    },
    "film_parameter": {
        "root-sum-square": film_laws.root_sum_square_film_parameter,
        "literal": film_laws.literal_film_parameter,
    },
    "inlet": {"ideal": film_laws.ideal_inlet, "heated": film_laws.Inlet, "flooded": film_laws.flooded_inlet},
    "friction": {
        "zhou-hoeprich": mixed_friction.ZhouHoeprich,
        "load-sharing": mixed_friction.LoadSharing,
        "run-in": mixed_friction.RunInSharing,
        "balan": mixed_friction.BalanSharing,
        "greenwood-tripp": mixed_friction.GreenwoodTrippSharing,
    },
    "full_film": {
        "none": None,
        "arana": mixed_friction.arana_traction,
        "eyring": mixed_friction.EyringTraction,
        "limiting-shear": mixed_friction.LimitingShearTraction,
    },
    "rolling": {
        "olaru": rolling_laws.olaru_rolling,
        "biboulet-houpert": rolling_laws.biboulet_houpert_rolling,
        "houpert": rolling_laws.houpert_rolling,
        "aihara": rolling_laws.aihara_rolling,
    },
    "elastic_resistance": {"snare": laws.snare_resistance, "hysteresis": laws.Hysteresis},
    "slip": {"curvature": curvature_slip, "line": line_slip, "ellipse": ellipse_slip},
    "ball_chain": {
        "one-neighbour": laws.one_neighbour,
        "two-neighbours": laws.two_neighbours,
        "opposed-neighbours": laws.opposed_neighbours,
        "parted-neighbours": laws.parted_neighbours,
    },
    "ball_force": {
        "imposed": laws.imposed_ball_force,
        "proportional": laws.ProportionalBallForce,
        "chain": chain_force.ChainBallForce,
    },
    "race_torques": {"printed": laws.printed_race_torques, "balanced": laws.balanced_race_torques},
    "ideal_torque": {"printed": laws.printed_ideal_torque, "virtual-work": laws.virtual_work_torque},
}


def coefficients(law: Any) -> Mapping[str, Quantity]:
    """The coefficients of a law by name; none for a law that is a function."""
    return fields_of(law) if dataclasses.is_dataclass(law) else {}


def fault_of_law(slot: str, law: Any) -> Fault | None:
    """Fault of a value given for a law in Python; None if it can be called."""
    if callable(law) and not isinstance(law, type):
        return None
    where, known = f"model.{slot}", LAWS.get(slot, {})
    if law is None and None in known.values():
        return None
    if isinstance(law, type):
        return Fault(where, "must be a law", f"the class {law.__name__}", f"make one of it: {law.__name__}(…)")
    if not isinstance(law, str):
        return Fault(where, "must be a law", repr(law), "give a function, or a frozen dataclass with __call__")
    named = known.get(law)
    if named is None:
        remedy = f"{nearest(law, known)} in a case file; in Python give the law itself"
    else:
        made = f"{named.__name__}()" if isinstance(named, type) else named.__name__
        remedy = f"from {named.__module__} import {named.__name__}, and give {slot}={made}"
    return Fault(where, "must be a law, not its name", law, remedy)
