"""Damage of a store: found by sizes and checksums, said, and repaired to the last byte."""

import dataclasses
import json
import os
import pickle
import shutil
import threading

import numpy as np
import pytest
import xarray as xr

import ballscrew as bs
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.sweeps.store_plan import cells_of, read_sealed, row, sealed
from support.stores import MODEL, SMALL, files, stop_at, times

pytest.importorskip("zarr", reason="zarr is not installed (the extra data)")

CHUNK = "efficiency/c/2/1/0"
OTHER = "efficiency/c/3/0/0"
BLOCK = 7


def removed(chunk):
    chunk.unlink()


def cut(chunk):
    os.truncate(chunk, chunk.stat().st_size // 2)


def flipped(chunk):
    content = bytearray(chunk.read_bytes())
    content[len(content) // 2] ^= 0x10
    chunk.write_bytes(content)


def swapped(chunk):
    """The chunk of another block in its place, of the same size and intact in itself."""
    other = chunk.parents[4] / OTHER
    a, b = chunk.read_bytes(), other.read_bytes()
    assert len(a) == len(b), "choose others: a size shall not tell"
    chunk.write_bytes(b)
    other.write_bytes(a)


#: What was done to a chunk, whether sizes alone tell, and what is said of it.
DAMAGES = {
    "removed": (removed, True, f"{CHUNK} is missing"),
    "cut": (cut, True, f"{CHUNK} has"),
    "flipped": (flipped, False, f"{CHUNK} has another checksum"),
    "swapped": (swapped, False, f"{CHUNK} has another checksum"),
}


@pytest.mark.parametrize("kind", DAMAGES)
def test_a_damaged_block_is_computed_again_on_resume(kind, unfinished, swept, whole, caplog):
    damage, _, said = DAMAGES[kind]
    damage(unfinished / CHUNK)
    told = []
    swept(unfinished, done=lambda finished, total: told.append(finished))
    bad, words = (2, "2 blocks are") if kind == "swapped" else (1, "1 block is")
    assert told[0] == (12 - bad) * 9
    assert f"{words} computed again: " in caplog.text
    assert said in caplog.text
    assert files(unfinished) == whole


@pytest.mark.parametrize("kind", DAMAGES)
def test_a_damaged_block_of_a_finished_store_is_computed_again(kind, complete, swept, whole, caplog):
    damage, is_told_by_size, said = DAMAGES[kind]
    damage(complete / CHUNK)
    assert said in [str(d) for d in bs.verify(complete).damaged] or kind == "cut"
    opened = swept(complete, **({} if is_told_by_size else {"verify": True}))
    assert said in caplog.text
    assert opened["efficiency"].notnull().all()
    assert files(complete) == whole
    assert bs.verify(complete).holds


@pytest.mark.parametrize("kind", ["cut", "flipped"])
def test_whatever_reads_a_damaged_chunk_raises(kind, complete):
    DAMAGES[kind][0](complete / CHUNK)
    with xr.open_zarr(complete, chunks=None) as opened, pytest.raises(Exception, match=r"(?i)checksum|crc|buffer|size"):
        opened["efficiency"].load()


@pytest.mark.parametrize("name", ["efficiency/c/2/1/0", "valid/c/2/1/0", "axial_load/c/0"])
def test_reading_a_damaged_file_is_one_line_with_the_remedy(name, complete, swept, whole):
    """Without a check before: sizes are as they were."""
    flipped(complete / name)
    words = (
        rf"sweep\.to: has a file that is damaged, or of another sweep \({complete / name}\) · run the same .*--verify"
    )
    with pytest.raises(bs.InputError, match=words) as said:
        swept(complete).load()
    assert len(str(said.value).splitlines()) == 1
    swept(complete, verify=True).load()
    assert files(complete) == whole


def test_a_chunk_that_goes_while_it_is_read_is_no_empty_number(complete, swept):
    opened = swept(complete)
    removed(complete / CHUNK)
    with pytest.raises(bs.InputError, match=rf"has a file that is missing \({complete / CHUNK}\)"):
        opened["efficiency"].load()
    with pytest.raises(bs.InputError, match="is missing"):
        pickle.loads(pickle.dumps(opened)).load()


# -- stores that are mixed ------------------------------------------------------------------------


def of_a_sibling(names):
    """Take these files from the store of the same grid with another oil, as a partial copy does."""

    def take(store, sibling):
        for name in names:
            shutil.copy(sibling / name, store / name)

    return take


def all_of_a_sibling(pattern):
    def take(store, sibling):
        for path in sibling.glob(pattern):
            if path.is_file():
                target = store / path.relative_to(sibling)
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(path, target)

    return take


MIXED = {
    "a chunk": of_a_sibling([CHUNK]),
    "chunks and blocks.csv": lambda store, sibling: [
        all_of_a_sibling("*/c/*/*/*")(store, sibling), of_a_sibling([".ballscrew/blocks.csv"])(store, sibling)
    ],
    "one output and blocks.csv": lambda store, sibling: [
        all_of_a_sibling("efficiency/c/*/*/*")(store, sibling), of_a_sibling([".ballscrew/blocks.csv"])(store, sibling)
    ],
    "blocks.csv": of_a_sibling([".ballscrew/blocks.csv"]),
    "all but the plan": lambda store, sibling: [
        all_of_a_sibling(pattern)(store, sibling)
        for pattern in ("*.json", "[!.]*/**/*", ".ballscrew/layout.json", ".ballscrew/blocks.csv")
    ],
    "coordinates and layout.json": of_a_sibling(["viscosity/c/0", "viscosity/zarr.json", ".ballscrew/layout.json"]),
}  # fmt: skip


@pytest.fixture(scope="module")
def sibling(seed_screw, seed_oil, stores):
    """The same grid, where one axis has other values."""
    changed = {**SMALL, "viscosity": [0.05, 0.2, 0.4]}
    bs.sweep(MODEL, seed_screw, seed_oil, to=stores / "sibling.zarr", **changed)
    return stores / "sibling.zarr"


@pytest.mark.parametrize("kind", MIXED)
def test_files_of_another_store_do_not_pass_for_those_of_this_one(kind, complete, sibling, swept, whole):
    plan = (complete / ".ballscrew" / "plan.json").read_bytes()
    MIXED[kind](complete, sibling)
    assert (complete / ".ballscrew" / "plan.json").read_bytes() == plan
    found = bs.verify(complete)
    assert found.damaged
    assert not found.holds
    swept(complete, verify=True)
    assert files(complete) == whole


@pytest.mark.slow
@pytest.mark.parametrize("kind", MIXED)
def test_numbers_of_another_store_are_never_read(kind, complete, sibling, swept, stores):
    """Without a check of checksums either: what cannot be told by sizes is told as it is read."""
    right = xr.open_zarr(stores / "complete.zarr", chunks=None).load()
    MIXED[kind](complete, sibling)
    said = ""
    try:
        opened = swept(complete).load()
    except bs.InputError as error:
        said = str(error)
    else:
        xr.testing.assert_identical(opened, right)
    assert ("--verify" in said) == (kind == "a chunk")


def test_rows_of_another_store_are_computed_again(unfinished, sibling, swept, whole):
    """Single rows and chunks, as an unfinished store has them: taken from a sibling with as many blocks."""
    all_of_a_sibling("*/c/*/*/*")(unfinished, sibling)
    lines = (sibling / ".ballscrew" / "blocks.csv").read_bytes().splitlines(keepends=True)[1:]
    for number, line in enumerate(lines):
        (unfinished / ".ballscrew" / "blocks" / str(number)).write_bytes(line)
    assert bs.verify(unfinished).finished == 0
    swept(unfinished)
    assert files(unfinished) == whole


def test_a_complete_store_is_said_to_be_so(complete, swept, whole, caplog, monkeypatch):
    monkeypatch.setattr(Evaluation, "fill", lambda *_, **__: pytest.fail("computed again"))
    caplog.set_level("INFO")
    before = times(complete, whole)
    xr.testing.assert_identical(swept(complete).load(), xr.open_zarr(complete, chunks=None).load())
    assert f"{complete}: complete already, nothing was computed" in caplog.text
    swept(complete, verify=True)
    assert "all checksums hold, nothing was computed" in caplog.text
    assert files(complete) == whole
    assert times(complete, whole) == before


def test_a_kill_while_a_finished_store_is_repaired(complete, swept, whole, monkeypatch):
    """What only checksums tell is not forgotten: the store cannot be opened until it is repaired."""
    flipped(complete / CHUNK)
    stop_at(BLOCK, KeyboardInterrupt(), monkeypatch)
    with pytest.raises(KeyboardInterrupt):
        swept(complete, verify=True)
    monkeypatch.undo()
    with pytest.raises(FileNotFoundError):
        xr.open_zarr(complete, chunks=None)
    swept(complete)
    assert files(complete) == whole


def test_a_file_where_there_should_be_none(complete, swept, whole):
    """A chunk of nothing but the fill value has no file; one that appears there is damage, too."""
    blocks = [f"valid/c/{row}/{column}/0" for row in range(7) for column in range(3)]
    empty = next(name for name in blocks if name not in whole)
    (complete / empty).parent.mkdir(exist_ok=True)
    shutil.copy(complete / next(name for name in blocks if name in whole), complete / empty)
    assert [damage.path for damage in bs.verify(complete).damaged] == [empty]
    swept(complete)
    assert files(complete) == whole


# -- metadata -------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(
    "name",
    [
        "zarr.json", "efficiency/zarr.json", "viscosity/zarr.json", "axial_load/c/0", ".ballscrew/layout.json",
        ".ballscrew/blocks.csv",
    ],
)  # fmt: skip
@pytest.mark.parametrize("damage", [removed, cut])
def test_metadata_of_a_finished_store_are_repaired(name, damage, complete, swept, whole, caplog):
    damage(complete / name)
    swept(complete)
    if name != "zarr.json" or damage is cut:  # without it the store is an unfinished one
        assert name in caplog.text
    assert files(complete) == whole


@pytest.mark.parametrize("name", [".ballscrew/zarr.json", "efficiency/zarr.json", "axial_load/c/0"])
@pytest.mark.parametrize("damage", [removed, cut])
def test_metadata_of_an_unfinished_store_are_repaired(name, damage, unfinished, swept, whole, caplog):
    damage(unfinished / name)
    told = []
    swept(unfinished, done=lambda finished, total: told.append(finished))
    assert told[0] == 12 * 9
    assert name.removeprefix(".ballscrew/") in caplog.text
    assert files(unfinished) == whole


@pytest.mark.parametrize("change", ["heading", "more", "folder"])
def test_a_table_of_blocks_that_cannot_be_read_is_written_again(change, complete, swept, whole, caplog):
    table = complete / ".ballscrew" / "blocks.csv"
    content = table.read_bytes()
    if change == "folder":
        table.unlink()
        table.mkdir()
    else:
        table.write_bytes(content.replace(b"efficiency", b"effic1ency", 1) if change == "heading" else content + b"7,")
    found = [str(damage) for damage in bs.verify(complete).damaged]
    assert ".ballscrew/blocks.csv is damaged" in found
    assert change == "folder" or len(found) == 1
    swept(complete)
    assert "written again: .ballscrew/blocks.csv is damaged" in caplog.text
    assert files(complete) == whole


def test_a_folder_in_place_of_a_row(unfinished, swept, whole, caplog):
    marker = unfinished / ".ballscrew" / "blocks" / str(BLOCK)
    marker.unlink()
    marker.mkdir()
    found = bs.verify(unfinished)
    assert [(str(damage), damage.block) for damage in found.damaged] == [
        (f".ballscrew/blocks/{BLOCK} is not a file", BLOCK)
    ]
    assert found.finished == 11
    swept(unfinished)
    assert f"1 block is computed again: .ballscrew/blocks/{BLOCK} is not a file" in caplog.text
    assert files(unfinished) == whole


def test_a_link_to_nothing_hides_no_other_row(unfinished):
    marker = unfinished / ".ballscrew" / "blocks" / str(BLOCK)
    marker.unlink()
    marker.symlink_to(unfinished / "nowhere")
    assert bs.verify(unfinished).finished == 11


@pytest.mark.parametrize("name", [CHUNK, "efficiency/zarr.json", f".ballscrew/blocks/{BLOCK}"])
def test_a_folder_with_content_in_place_of_a_file_is_refused(name, unfinished, swept):
    """It may hold files of the user: it is named and not removed."""
    removed(unfinished / name)
    (unfinished / name).mkdir()
    (unfinished / name / "thesis.tex").touch()
    words = rf"has a folder in place of a file \({unfinished / name}\) · remove the folder and run the same again$"
    with pytest.raises(bs.InputError, match=words):
        swept(unfinished)
    assert (unfinished / name / "thesis.tex").exists()


WRONG_PLANS = {
    "no format": {"format": None},
    "no engine": {"engine": None},
    "no attributes": {"attributes": None},
    "no outputs": {"outputs": None},
    "chunks of nothing": {"chunks": [0, 0, 0]},
    "fewer chunks": {"chunks": [7]},
    "shape of text": {"shape": "7 9 3"},
}


@pytest.mark.parametrize("kind", WRONG_PLANS)
def test_a_plan_without_an_entry_is_damaged_although_its_digest_fits(kind, complete, swept):
    plan = complete / ".ballscrew" / "plan.json"
    document = read_sealed("plan", plan.read_text(encoding="utf-8")) | WRONG_PLANS[kind]
    plan.write_bytes(sealed("plan", {name: value for name, value in document.items() if value is not None}))
    for act in (bs.verify, swept):
        with pytest.raises(bs.InputError, match=r"has a damaged plan .*plan\.json"):
            act(complete)


@pytest.mark.parametrize("layout", [{"zarr.json": 5}, {"zarr.json": [1, 2, 3]}, []])
def test_a_layout_of_another_form_is_damaged_although_its_digest_fits(layout, complete):
    (complete / ".ballscrew" / "layout.json").write_bytes(
        sealed("layout", layout).replace(b'"layout":{}', b'"layout":[]')
    )
    assert [str(damage) for damage in bs.verify(complete).damaged] == [".ballscrew/layout.json is damaged"]


@pytest.mark.parametrize("number", [1, 2])
def test_a_store_of_a_layout_before_is_refused(number, complete, swept):
    plan = complete / ".ballscrew" / "plan.json"
    document = read_sealed("plan", plan.read_text(encoding="utf-8")) | {"format": number}
    plan.write_bytes(sealed("plan", document))
    with pytest.raises(bs.InputError, match=rf"holds another sweep \(format {number}, not 3\) · choose another name"):
        swept(complete)
    with pytest.raises(bs.InputError, match=rf"is a store of another version .*format {number}\) · sweep again under"):
        bs.verify(complete)


def test_a_lost_plan_is_refused_in_one_line(complete, swept):
    (complete / ".ballscrew" / "plan.json").unlink()
    before = files(complete)
    with pytest.raises(bs.InputError, match=r"has lost its plan .*plan\.json.* · choose another name, or remove it$"):
        swept(complete)
    assert files(complete) == before


def test_a_damaged_row_is_not_taken_for_a_block(unfinished, swept, whole):
    marker = unfinished / ".ballscrew" / "blocks" / "7"
    line = marker.read_bytes()
    plan = json.loads((unfinished / ".ballscrew" / "plan.json").read_text(encoding="utf-8"))["sha256"]
    assert cells_of(plan, line) is not None
    assert cells_of(plan[::-1], line) is None
    assert cells_of(plan, line.replace(b"7,", b"8,", 1)) is None
    assert cells_of(plan, line[:-3]) is None
    assert row(plan, cells_of(plan, line)) == line
    marker.write_bytes(line.replace(b"7,", b"6,", 1))
    shutil.copy(unfinished / ".ballscrew" / "blocks" / "5", unfinished / ".ballscrew" / "blocks" / "4")
    told = []
    swept(unfinished, done=lambda finished, total: told.append(finished))
    assert told[0] == 10 * 9
    assert files(unfinished) == whole


# -- verify ---------------------------------------------------------------------------------------


def test_verify_tells_all_that_is_damaged_and_changes_nothing(complete):
    found = bs.verify(complete)
    assert (found.path, found.blocks, found.finished, found.damaged) == (complete, 21, 21, ())
    assert found.holds
    removed(complete / CHUNK)
    flipped(complete / "screw_torque/c/0/0/0")
    cut(complete / "viscosity/zarr.json")
    before = files(complete)
    found = bs.verify(str(complete))
    assert {(damage.path, damage.block) for damage in found.damaged} == {
        (CHUNK, BLOCK),
        ("screw_torque/c/0/0/0", 0),
        ("viscosity/zarr.json", None),
    }
    assert not found.holds
    assert files(complete) == before


def test_verify_of_an_unfinished_store(unfinished):
    found = bs.verify(unfinished)
    assert (found.blocks, found.finished, found.damaged, found.holds) == (21, 12, (), False)


@pytest.mark.parametrize("made", [False, True])
def test_verify_of_what_is_no_store(made, tmp_path):
    if made:
        (tmp_path / "a.zarr").mkdir()
        (tmp_path / "a.zarr" / "thesis.tex").touch()
    with pytest.raises(bs.InputError, match="is not the store of a sweep"):
        bs.verify(tmp_path / "a.zarr")


def test_a_model_that_cannot_be_compared_is_never_gone_on_with(seed_screw, seed_oil, tmp_path, whole):
    """Its fingerprint is random, so that nothing is taken from a store that may be of another model."""
    lock = threading.Lock()

    def friction(conditions):
        with lock:
            return np.interp(conditions.film_parameter, [0.0, 3.0], [0.1, 0.02])

    mine = dataclasses.replace(MODEL, friction=friction)
    path = tmp_path / "mine.zarr"
    bs.sweep(mine, seed_screw, seed_oil, to=path, **SMALL)
    plan = json.loads((path / ".ballscrew" / "plan.json").read_text(encoding="utf-8"))["plan"]
    assert len(plan["formulas"]) == 64
    with pytest.raises(
        bs.InputError, match=r"it cannot be known whether the model is the same \(.*lock\) · choose"
    ) as e:
        bs.sweep(mine, seed_screw, seed_oil, to=path, **SMALL)
    assert len(str(e.value).splitlines()) == 1
