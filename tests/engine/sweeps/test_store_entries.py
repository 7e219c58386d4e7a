"""Folders that another user prepared: nothing outside the store is read for it or overwritten."""

import os
import sys

import pytest

import ballscrew as bs
from ballscrew.engine.sweeps.store_plan import Lock
from support.stores import files

pytest.importorskip("zarr", reason="zarr is not installed (the extra data)")
pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="links need rights there")

MINE = "all that I have\n"


@pytest.fixture
def target(tmp_path):
    """A file of the person who runs the sweep."""
    path = tmp_path / "mine.txt"
    path.write_text(MINE, encoding="utf-8")
    return path


@pytest.mark.parametrize("name", ["lock", "plan.json", "blocks.csv", "temporary", "layout.json"])
def test_a_link_in_the_own_folder_is_refused(name, swept, target, tmp_path):
    own = tmp_path / "map.zarr" / ".ballscrew"
    own.mkdir(parents=True)
    (own / name).symlink_to(target)
    with pytest.raises(bs.InputError) as caught:
        swept(tmp_path / "map.zarr")
    assert len(str(caught.value).splitlines()) == 1
    assert target.read_text(encoding="utf-8") == MINE
    assert list(files(tmp_path / "map.zarr")) in ([], [f".ballscrew/{name}"])


@pytest.mark.parametrize(
    "name", [".ballscrew", ".ballscrew/blocks", "efficiency", "efficiency/c", "efficiency/c/2/1/0"]
)
def test_a_link_anywhere_in_a_store_is_refused(name, swept, unfinished, tmp_path):
    path, elsewhere = unfinished, tmp_path / "elsewhere"
    (path / name).rename(elsewhere)
    (path / name).symlink_to(elsewhere)
    before = files(tmp_path)
    for trust in (False, True):
        with pytest.raises(bs.InputError, match=rf"has a link in it, which is not followed \({path / name}\) · remove"):
            swept(path, trust=trust)
    assert files(tmp_path) == before


def test_a_dangling_link_makes_no_file(swept, tmp_path):
    own = tmp_path / "map.zarr" / ".ballscrew"
    own.mkdir(parents=True)
    (own / "lock").symlink_to(tmp_path / "new.txt")
    with pytest.raises(bs.InputError, match="has a link in it"):
        swept(tmp_path / "map.zarr")
    assert not (tmp_path / "new.txt").exists()


def test_the_lock_itself_follows_no_link(target, tmp_path):
    """Also where the link came after the folder was looked through."""
    (tmp_path / "lock").symlink_to(target)
    with pytest.raises(OSError, match=r"(?i)symbolic links"):
        Lock(tmp_path / "lock", "sweep.to", tmp_path)
    assert target.read_text(encoding="utf-8") == MINE
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(OSError, match="is not a file"):
        Lock(tmp_path / "pipe", "sweep.to", tmp_path)


def test_a_link_to_a_store_of_ones_own_will_do(swept, whole, tmp_path):
    (tmp_path / "disk").mkdir()
    (tmp_path / "map.zarr").symlink_to(tmp_path / "disk")
    swept(tmp_path / "map.zarr")
    assert files(tmp_path / "disk") == whole


@pytest.mark.skipif(not hasattr(os, "geteuid"), reason="folders have no owners there")
def test_a_store_of_another_user_needs_trust(swept, whole, tmp_path, monkeypatch):
    path = tmp_path / "whole.zarr"
    owner = os.geteuid()
    monkeypatch.setattr(os, "geteuid", lambda: owner + 1)
    with pytest.raises(bs.InputError, match=rf"belongs to another user.* \({path}: user {owner}\) · .*--trust"):
        swept(path)
    assert swept(path, trust=True)["efficiency"].shape == (7, 9, 3)
    (tmp_path / "empty.zarr").mkdir()
    with pytest.raises(bs.InputError, match="belongs to another user"):
        swept(tmp_path / "empty.zarr")
    assert not list((tmp_path / "empty.zarr").iterdir())
