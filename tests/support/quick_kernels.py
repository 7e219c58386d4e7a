"""The level at which the code of kernels is optimised: the package's, or none, for tests of what kernels compute."""

import functools

import pytest

from ballscrew.compiler.kernels import kernel

SHIPPED, UNOPTIMISED = kernel.CODE_OPTIMISATION, 0


def set_code_optimisation(patch: pytest.MonkeyPatch, level: int) -> None:
    """Compile at this level from now on; what was compiled at another one is not used."""
    patch.setattr(kernel, "CODE_OPTIMISATION", level)
    patch.setattr(kernel, "_kernels", {})
    # the level is part of a kernel's name
    patch.setattr(kernel, "_processor", functools.cache(kernel._processor.__wrapped__))
    patch.setattr(kernel, "_digest", functools.lru_cache(maxsize=64)(kernel._digest.__wrapped__))
