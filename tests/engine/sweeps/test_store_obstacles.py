"""Files in the place of folders, and files that nobody may read: named with a remedy, by the check and by the sweep."""

import io
import os

import pytest

import ballscrew as bs
from support.stores import files, times

pytest.importorskip("zarr", reason="zarr is not installed (the extra data)")


def line_of(action, *arguments):
    with pytest.raises(bs.InputError) as caught:
        action(*arguments)
    (line,) = caught.value.lines()
    return line


# -- files in the place of folders ----------------------------------------------------------------


def put_aside(folder):
    """A plain file in the place of a folder."""
    aside = next(parent for parent in folder.parents if parent.suffix == ".zarr").with_suffix(".aside")
    folder.rename(aside)
    folder.write_text("mine", encoding="utf-8")
    return aside


def put_back(folder, aside):
    folder.unlink()
    aside.rename(folder)


@pytest.mark.parametrize("name", ["efficiency", "efficiency/c", "efficiency/c/1", "axial_load"])
def test_a_file_in_the_place_of_a_folder_is_named(name, unfinished, swept, whole):
    aside = put_aside(unfinished / name)
    damaged = [str(damage) for damage in bs.verify(unfinished).damaged]
    assert any(line.endswith(f" is missing: {name} is a file and no folder") for line in damaged)
    remedy = "remove the file and run the same again"
    assert line_of(swept, unfinished) == f"sweep.to: has a file in place of a folder ({unfinished / name}) · {remedy}"
    assert (unfinished / name).read_text(encoding="utf-8") == "mine"
    put_back(unfinished / name, aside)
    swept(unfinished)
    assert files(unfinished) == whole


def test_a_file_in_the_place_of_the_rows(unfinished, swept, whole):
    folder = unfinished / ".ballscrew" / "blocks"
    aside = put_aside(folder)
    found = bs.verify(unfinished)
    assert [(str(damage), damage.block) for damage in found.damaged] == [
        (".ballscrew/blocks is a file and no folder", None)
    ]
    assert found.finished == 0
    assert f"has a file in place of a folder ({folder}) · remove the file" in line_of(swept, unfinished)
    put_back(folder, aside)
    swept(unfinished)
    assert files(unfinished) == whole


def test_a_file_in_the_place_of_the_store_or_of_its_own_folder(complete, swept, tmp_path):
    put_aside(complete / ".ballscrew")
    words = f"sweep.to: has a file in place of a folder ({complete / '.ballscrew'}) · "
    assert line_of(bs.verify, complete) == f"{words}take a copy of the store, or sweep again under another name"
    assert line_of(swept, complete) == f"{words}choose another name, or remove it"
    file = tmp_path / "thesis.tex"
    file.touch()
    words = f"sweep.to: is there and is not the store of a sweep ({file}) · "
    assert line_of(bs.verify, file) == f"{words}give the folder of a store"
    assert line_of(swept, file) == f"{words}choose another name"


# -- files that nobody may read -------------------------------------------------------------------


@pytest.fixture
def forbid(monkeypatch):
    """Let the system refuse to read a path, as it refuses nothing to who runs the tests as root."""

    def forbid(forbidden):
        def refusing(action):
            def read(path, *arguments, **options):
                if str(path) == str(forbidden):
                    raise PermissionError(13, "Permission denied", str(forbidden))
                return action(path, *arguments, **options)

            return read

        for module, name in ((io, "open"), (os, "scandir"), (os, "listdir")):
            monkeypatch.setattr(module, name, refusing(getattr(module, name)))

    return forbid


@pytest.mark.parametrize("name", ["plan.json", "blocks.csv"])
def test_a_table_that_may_not_be_read_is_named(name, complete, swept, forbid):
    path = complete / ".ballscrew" / name
    before = times(complete, files(complete))
    forbid(path)
    for action in (bs.verify, lambda store: swept(store, verify=True)):
        words = f"sweep.to: cannot be read ({path}: Permission denied) · make it readable"
        assert line_of(action, complete) == words
    assert times(complete, before) == before


def test_rows_that_may_not_be_read_are_named(unfinished, forbid):
    forbid(unfinished / ".ballscrew" / "blocks")
    assert "blocks: Permission denied) · make it readable" in line_of(bs.verify, unfinished)


@pytest.mark.parametrize(("name", "block"), [("blocks/7", 7), ("layout.json", None)])
def test_a_file_that_may_not_be_read_and_can_be_written_again_is_damage(name, block, unfinished, forbid):
    forbid(unfinished / ".ballscrew" / name)
    found = bs.verify(unfinished)
    assert [(str(damage), damage.block) for damage in found.damaged] == [
        (f".ballscrew/{name} cannot be read: Permission denied", block)
    ]
    assert found.finished == 11 + (block is None)


def test_a_folder_that_may_not_be_listed_is_named(tmp_path, forbid):
    (tmp_path / "a.zarr").mkdir()
    forbid(tmp_path / "a.zarr")
    assert line_of(bs.verify, tmp_path / "a.zarr").endswith("Permission denied) · make it readable")
