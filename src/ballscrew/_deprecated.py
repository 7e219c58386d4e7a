"""Old names of public attributes: they work for one release, and warn with the new name."""

from __future__ import annotations

import warnings
from typing import Any


class RenamedAttribute:
    """A descriptor that gives an attribute or a method under its ``old`` name, with a :class:`DeprecationWarning`.

    Both names are given, for a named tuple does not tell a descriptor what it is called.
    """

    def __init__(self, old: str, new: str) -> None:
        self._old, self._new = old, new

    def __get__(self, instance: Any, owner: type) -> Any:
        if instance is None:
            return self
        message = f"{owner.__name__}.{self._old} is deprecated: use {self._new}"
        warnings.warn(message, DeprecationWarning, stacklevel=2)
        return getattr(instance, self._new)
