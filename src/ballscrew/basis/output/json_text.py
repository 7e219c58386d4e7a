"""JSON of results: plain numbers, and null for what is not finite."""

from __future__ import annotations

import json
from collections.abc import Mapping
from math import isfinite
from typing import Any

import numpy as np

#: Types whose values are JSON already.
_AS_THEY_ARE = frozenset({str, int, bool, type(None)})


def as_json(document: Any) -> str:
    """A document as the text of one JSON value."""
    return json.dumps(plain(document), indent=2, ensure_ascii=False, allow_nan=False)


def plain(value: Any) -> Any:
    """Numbers JSON can say: NumPy's as Python's, what is not finite as null."""
    kind = type(value)
    if kind is float:  # nearly all that a document has
        return value + 0.0 if isfinite(value) else None
    if kind in _AS_THEY_ARE:
        return value
    if kind is list:
        return [plain(item) for item in value]
    if isinstance(value, Mapping):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, np.ndarray) and value.ndim:
        return plain(value.tolist())
    if isinstance(value, bool | np.bool_):
        return bool(value)
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.item())
    if isinstance(value, float):
        return value + 0.0 if isfinite(value) else None
    return value
