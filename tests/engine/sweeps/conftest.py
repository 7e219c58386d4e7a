"""Sweeps for tests of stores."""

import pytest

import ballscrew as bs
from support.stores import MODEL, SMALL, files


@pytest.fixture
def swept(seed_screw, seed_oil):
    def sweep(to=None, **given):
        return bs.sweep(MODEL, seed_screw, seed_oil, **(SMALL | given), **({} if to is None else {"to": to}))

    return sweep


@pytest.fixture
def whole(swept, tmp_path):
    """The files of a run that nobody stopped."""
    swept(tmp_path / "whole.zarr")
    return files(tmp_path / "whole.zarr")
