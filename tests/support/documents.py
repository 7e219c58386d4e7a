"""Documents of the same question, compared where two engines may have answered it."""

from __future__ import annotations

import math
from typing import Any

#: NumPy and a compiled kernel round the last digits differently. Which one answers also depends on the kernels that
#: other tests of the same run have left in the cache.
ROUNDING = 1e-10


def differences(found: Any, expected: Any, at: str = "") -> list[str]:
    """Where two documents differ: numbers by more than rounding, all else at all."""
    if type(found) is not type(expected):
        kinds = {type(found), type(expected)}
        if kinds != {int, float}:  # 1.0 may be written as 1
            return [f"{at}: {found!r} is not {expected!r}"]
    if isinstance(expected, dict):
        if list(found) != list(expected):
            return [f"{at}: fields {list(found)} are not {list(expected)}"]
        return [line for name in expected for line in differences(found[name], expected[name], f"{at}.{name}")]
    if isinstance(expected, list):
        if len(found) != len(expected):
            return [f"{at}: {len(found)} entries are not {len(expected)}"]
        pairs = zip(found, expected, strict=True)
        return [line for i, (one, other) in enumerate(pairs) for line in differences(one, other, f"{at}[{i}]")]
    if isinstance(expected, float) and isinstance(found, (int, float)) and math.isfinite(expected):
        return [] if math.isclose(found, expected, rel_tol=ROUNDING) else [f"{at}: {found!r} is not {expected!r}"]
    return [] if found == expected else [f"{at}: {found!r} is not {expected!r}"]


def assert_same(found: Any, expected: Any) -> None:
    """Fail where two documents differ by more than rounding."""
    lines = differences(found, expected)
    assert not lines, "\n".join(lines[:10])
