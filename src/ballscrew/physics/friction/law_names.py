"""Names of laws, as case files and tables have them.

A row here gives a law a name and no more. Whether the uncertainty band counts it as an alternative is declared beside
the law (:mod:`ballscrew.physics.laws.traits`).
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

from ballscrew.basis.errors import Fault, nearest
from ballscrew.basis.quantities import Quantity, fields_of
from ballscrew.physics.laws import ball_chain, film, frame, friction, hertz, inlet, rolling, torque
from ballscrew.physics.solvers.ellipse_slip import ellipse_slip
from ballscrew.physics.solvers.line_slip import line_slip
from ballscrew.physics.solvers.slip import curvature_slip

#: The laws of each slot by name: functions, and classes where a law has coefficients.
LAWS: Mapping[str, Mapping[str, Any]] = {
    "frame": {"bearing": frame.bearing_frame, "helix": frame.helix_frame},
    "hertz": {"houpert": hertz.houpert_hertz, "exact": hertz.exact_hertz, "brewe-hamrock": hertz.brewe_hamrock_hertz},
    "film": {
        "hamrock-dowson": film.HamrockDowson,
        "hamrock-dowson-central": film.hamrock_dowson_central,
        "chittenden": film.chittenden,
    },
    "film_parameter": {
        "root-sum-square": film.root_sum_square_film_parameter,
        "literal": film.literal_film_parameter,
    },
    "inlet": {"ideal": inlet.ideal_inlet, "heated": inlet.Inlet, "flooded": inlet.flooded_inlet},
    "friction": {
        "zhou-hoeprich": friction.ZhouHoeprich,
        "load-sharing": friction.LoadSharing,
        "run-in": friction.RunInSharing,
        "balan": friction.BalanSharing,
        "greenwood-tripp": friction.GreenwoodTrippSharing,
    },
    "full_film": {
        "none": None,
        "arana": friction.arana_traction,
        "eyring": friction.EyringTraction,
        "limiting-shear": friction.LimitingShearTraction,
    },
    "rolling": {
        "olaru": rolling.olaru_rolling,
        "biboulet-houpert": rolling.biboulet_houpert_rolling,
        "houpert": rolling.houpert_rolling,
        "aihara": rolling.aihara_rolling,
    },
    "elastic_resistance": {"snare": rolling.snare_resistance, "hysteresis": rolling.Hysteresis},
    "slip": {"curvature": curvature_slip, "line": line_slip, "ellipse": ellipse_slip},
    "ball_chain": {
        "one-neighbour": ball_chain.one_neighbour,
        "two-neighbours": ball_chain.two_neighbours,
        "opposed-neighbours": ball_chain.opposed_neighbours,
        "parted-neighbours": ball_chain.parted_neighbours,
    },
    "ball_force": {
        "imposed": ball_chain.imposed_ball_force,
        "proportional": ball_chain.ProportionalBallForce,
        "chain": ball_chain.ChainBallForce,
    },
    "race_torques": {"printed": torque.printed_race_torques, "balanced": torque.balanced_race_torques},
    "ideal_torque": {"printed": torque.printed_ideal_torque, "virtual-work": torque.virtual_work_torque},
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
