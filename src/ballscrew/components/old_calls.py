"""Calls of contact laws as they were in 0.1, each slot with arguments of its own: kept for one release, with a warning.

Since then all laws of a contact take :class:`~ballscrew.components.conditions.ContactConditions`.
"""

from __future__ import annotations

import dataclasses
import functools
import inspect
import warnings
from collections.abc import Callable, Mapping
from types import SimpleNamespace
from typing import Any

from ballscrew.components.conditions import ContactConditions

#: The arguments that the laws of a slot took, by the names they have in the conditions.
ARGUMENTS: Mapping[str, tuple[str, ...]] = {
    "film": ("rolling_radius", "speed_parameter", "material_parameter", "load_parameter", "ellipticity"),
    "film_parameter": ("minimum_film_thickness", "ball_roughness", "race_roughness"),
    "friction": ("film_parameter", "conditions", "full_film_friction_coefficient"),
    "elastic_resistance": ("ball_diameter", "contact_load", "radii_ratio", "semi_minor_axis"),
}
#: Those that could be left out.
_OPTIONAL = {"conditions": None, "full_film_friction_coefficient": None}


def also_with_arguments_of_0_1(slot: str) -> Callable[[Callable[[Any, ContactConditions], Any]], Callable[..., Any]]:
    """Let the ``__call__`` of a law take the old arguments of its slot, too."""

    def wrapped(call: Callable[[Any, ContactConditions], Any]) -> Callable[..., Any]:
        @functools.wraps(call)
        def either(self: Any, *given: Any, **named: Any) -> Any:
            if len(given) == 1 and not named and hasattr(given[0], ARGUMENTS[slot][0]):
                return call(self, given[0])
            _warn(f"{type(self).__name__}()({', '.join(ARGUMENTS[slot])})")
            return call(self, _conditions(slot, given, named))

        return either

    return wrapped


def of_conditions(slot: str, law: Any) -> Any:
    """A law of conditions: the one given, or around one that takes the old arguments of its slot."""
    names = ARGUMENTS.get(slot)
    if names is None or not _takes_old_arguments(law, names):
        return law
    _warn(f"a law that takes {', '.join(names)}")
    return _OldLaw(law, names)


@dataclasses.dataclass(frozen=True, eq=False, slots=True)
class _OldLaw:
    """A law of conditions around one that takes the old arguments of its slot."""

    law: Any
    names: tuple[str, ...]

    def __call__(self, conditions: ContactConditions) -> Any:
        return self.law(*(conditions if name == "conditions" else getattr(conditions, name) for name in self.names))


def _takes_old_arguments(law: Any, names: tuple[str, ...]) -> bool:
    """True for a law with as many arguments as its slot had, the first not named ``conditions``."""
    try:
        signature = inspect.signature(law)
        signature.bind(*names)
    except (TypeError, ValueError):  # of other arguments, or of something written in C
        return False
    parameters = list(signature.parameters.values())
    several = len(parameters) > 1 or parameters[0].kind is inspect.Parameter.VAR_POSITIONAL
    return several and parameters[0].name != "conditions"


def _conditions(slot: str, given: tuple[Any, ...], named: Mapping[str, Any]) -> Any:
    """Arguments of an old call, in the place of conditions."""
    names = ARGUMENTS[slot]
    values = {**_OPTIONAL, **dict(zip(names[: len(given)], given, strict=True)), **named}
    conditions = values.pop("conditions")
    return SimpleNamespace(**values) if conditions is None else conditions.extended(type(conditions), **values)


def _warn(what: str) -> None:
    """Warn where the package was called from: a warning that points into the package is shown to nobody."""
    new = "the laws of a contact take one argument, its ContactConditions"
    frame, level = inspect.currentframe(), 1
    while frame is not None and frame.f_back is not None and _is_inside(frame.f_globals.get("__name__", "")):
        frame, level = frame.f_back, level + 1
    warnings.warn(f"{what} works in this release and no longer: {new}", DeprecationWarning, stacklevel=level)


def _is_inside(module: str) -> bool:
    return module.partition(".")[0] in ("ballscrew", "functools")
