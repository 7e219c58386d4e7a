"""Documents of the same question, compared where two engines may have answered it."""

from __future__ import annotations

import math
from typing import Any

#: NumPy and a compiled kernel round the last digits differently. Which one answers also depends on the kernels that
#: other tests of the same run have left in the cache.
ROUNDING = 1e-10
#: Where numbers come out of iterations, which stop a little elsewhere.
ITERATED = 1e-6


def differences(found: Any, expected: Any, relative: float = ROUNDING, at: str = "", largest: float = 0.0) -> list[str]:
    """Where two documents differ: numbers by more than rounding, all else at all.

    The numbers of a curve are rounded by the size of its largest: where it goes through zero, those beside it are not.
    """
    if type(found) is not type(expected):
        kinds = {type(found), type(expected)}
        if kinds != {int, float}:  # 1.0 may be written as 1
            return [f"{at}: {found!r} is not {expected!r}"]
    if isinstance(expected, dict):
        if list(found) != list(expected):
            return [f"{at}: fields {list(found)} are not {list(expected)}"]
        return [
            line for name in expected for line in differences(found[name], expected[name], relative, f"{at}.{name}")
        ]
    if isinstance(expected, list):
        if len(found) != len(expected):
            return [f"{at}: {len(found)} entries are not {len(expected)}"]
        sizes = [abs(one) for one in expected if isinstance(one, float) and math.isfinite(one)]
        return [
            line
            for i, (one, other) in enumerate(zip(found, expected, strict=True))
            for line in differences(one, other, relative, f"{at}[{i}]", max(sizes, default=0.0))
        ]
    if isinstance(expected, float) and isinstance(found, (int, float)) and math.isfinite(expected):
        same = math.isclose(found, expected, rel_tol=relative, abs_tol=relative * largest)
        return [] if same else [f"{at}: {found!r} is not {expected!r}"]
    return [] if found == expected else [f"{at}: {found!r} is not {expected!r}"]


def assert_same(found: Any, expected: Any, relative: float = ROUNDING) -> None:
    """Fail where two documents differ by more than rounding."""
    lines = differences(found, expected, relative)
    assert not lines, "\n".join(lines[:10])
