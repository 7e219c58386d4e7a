"""Sweeps for tests of stores, and stores that they left: a finished one, and one with 12 of its 21 blocks."""

import shutil

import pytest

import ballscrew as bs
from support.stores import MODEL, SMALL, files, stop_at


@pytest.fixture
def swept(seed_screw, seed_oil):
    def sweep(to=None, **given):
        return bs.sweep(MODEL, seed_screw, seed_oil, **(SMALL | given), **({} if to is None else {"to": to}))

    return sweep


@pytest.fixture(scope="package")
def stores(seed_screw, seed_oil, tmp_path_factory):
    folder = tmp_path_factory.mktemp("stores")
    bs.sweep(MODEL, seed_screw, seed_oil, to=folder / "complete.zarr", **SMALL)
    with pytest.MonkeyPatch.context() as patch:
        stop_at(12, KeyboardInterrupt(), patch)
        with pytest.raises(KeyboardInterrupt):
            bs.sweep(MODEL, seed_screw, seed_oil, to=folder / "unfinished.zarr", **SMALL)
    return folder


@pytest.fixture
def whole(stores, tmp_path):
    """The files of a run that nobody stopped, in the store ``whole.zarr``."""
    return files(shutil.copytree(stores / "complete.zarr", tmp_path / "whole.zarr"))


@pytest.fixture
def complete(stores, tmp_path):
    return shutil.copytree(stores / "complete.zarr", tmp_path / "map.zarr")


@pytest.fixture
def unfinished(stores, tmp_path):
    return shutil.copytree(stores / "unfinished.zarr", tmp_path / "map.zarr")
