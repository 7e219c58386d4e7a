"""Pages have what programs make for them: each mark its text, and a change of either is found.

``make pages CHECK=1``, which CI runs, compares all pages with all programs. Here is what takes no minutes.
"""

import re
import subprocess

import numpy as np
import pytest
from matplotlib.figure import Figure

from support.rules import for_each

from .pages import DOCS, name, pages

#: A page of commands alone, and one of tables.
OF_COMMANDS, OF_TABLES = "howto/back_driving", "cases"
PAGE = """# A page

<!-- command: .venv/bin/ballscrew run case.toml
show: two .. -->
<!-- end -->

It takes <!--= t_torque--><!--/--> N m.
"""
WRITTEN = """# A page

<!-- command: .venv/bin/ballscrew run case.toml
show: two .. -->
```console
$ .venv/bin/ballscrew run case.toml
…
two
```
<!-- end -->

It takes <!--= t_torque-->0.29<!--/--> N m.
"""


@pytest.fixture
def apart(writer, tmp_path, monkeypatch):
    """The writer with a folder of its own for what programs make: another run may use the usual one."""
    for module in (writer.command, writer.parts, writer.write):
        monkeypatch.setattr(module, "MADE", tmp_path)
    monkeypatch.setattr(writer.command, "KEPT", tmp_path / "commands")
    return writer.write


def of_docs():
    names = (page.relative_to(DOCS).with_suffix("").as_posix() for page in pages() if DOCS in page.parents)
    return [name for name in names if not name.startswith("decisions/")]


def test_what_is_made_comes_between_its_marks(writer):
    page = writer.write.Written("start", PAGE)
    assert page.with_all(["one\ntwo\n"], {"t_torque": "0.29"}) == WRITTEN
    again = writer.write.Written("start", WRITTEN)
    assert again.with_all(["one\ntwo\n"], {"t_torque": "0.29"}) == WRITTEN
    assert again.with_all(["one\ntwo\n"], {"t_torque": "0.30"}) != WRITTEN


@pytest.mark.parametrize(
    "fault",
    [PAGE.replace("<!-- end -->", ""), PAGE + "\n<!-- end -->\n", PAGE.replace("<!-- end -->", "") + PAGE],
    ids=["no end", "no mark", "no end before the next mark"],
)
def test_a_mark_without_an_end_is_refused(writer, fault):
    with pytest.raises(writer.write.Failed, match="start: a mark has no end, or an end no mark"):
        writer.write.Written("start", fault)


def test_an_option_that_no_mark_has_is_refused(writer):
    with pytest.raises(writer.write.Failed, match=r"start: command .*case\.toml has no option shows"):
        writer.write.Written("start", PAGE.replace("show: ", "shows: "))


def test_a_number_that_nothing_makes_is_named(writer):
    with pytest.raises(writer.write.Failed, match="start: nothing makes the number t_torque"):
        writer.write.Written("start", PAGE).with_all(["one\ntwo\n"], {})


@for_each(page={page: page for page in of_docs()})
def test_formulas_and_files_are_as_in_the_source(writer, page):
    whole = writer.write.Written(page)
    for block in whole.blocks:
        if block["kind"] == "equation" or (block["kind"] == "file" and (writer.kept.ROOT / block["what"]).is_file()):
            # what stands between the marks, without the commands of the page
            assert block["written"] == whole._written(block, iter(())), f"{block['what']}: make pages"


@for_each(page={page: page for page in of_docs()})
def test_nothing_is_left_to_a_build(page):
    text = (DOCS / f"{page}.md").read_text(encoding="utf-8")
    assert "--><!--/-->" not in text, "a number is missing: make pages"
    assert "-->\n<!-- end -->" not in text, "a text is missing: make pages"


@pytest.mark.slow
def test_commands_print_what_their_page_says(apart):
    assert apart.put([OF_COMMANDS], write=False) == ([], [])


@pytest.mark.slow
def test_tables_are_what_their_programs_make(apart):
    assert apart.put([OF_TABLES], write=False) == ([], [])


def test_every_figure_is_there_and_shown(writer):
    names = of_docs()
    assert writer.write.left_over(names) == []
    for page in names:
        for figure in writer.write.Written(page).figures:
            assert (writer.write.FIGURES / figure).is_file(), f"{name(DOCS / page)}: figures/{figure}: make pages"


def test_a_stamp_holds_until_a_file_changes(writer, tmp_path):
    subprocess.run(["git", "init", "--quiet"], cwd=tmp_path, check=True)
    page, source, other = (tmp_path / name for name in ("docs/page.md", "src/law.py", "out/kept.json"))
    for path in (page, source, other, tmp_path / writer.kept.STAMP):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(path.name)
    (tmp_path / ".gitignore").write_text("out/\n")
    assert not writer.kept.stamp_holds(tmp_path)
    writer.kept.stamp(tmp_path)
    other.write_text("changed")  # git ignores it
    assert writer.kept.stamp_holds(tmp_path)
    for path in (page, source):
        before = path.read_text()
        path.write_text("changed")
        assert not writer.kept.stamp_holds(tmp_path)
        path.write_text(before)
        assert writer.kept.stamp_holds(tmp_path)
    page.rename(page.with_name("other.md"))
    assert not writer.kept.stamp_holds(tmp_path)


def test_without_a_repository_no_stamp_holds(writer, tmp_path):
    writer.kept.stamp(tmp_path)
    assert not writer.kept.stamp_holds(tmp_path)
    assert not list(tmp_path.iterdir())


def test_texts_may_differ_by_rounding(writer):
    said = "0.0794 0.07940968010062376, 30 degC\nscrew_torque: 0 N m, relative 0"
    assert writer.compare.same_text(said, said.replace("062376", "062381"))
    assert writer.compare.same_text(said, said.replace(": 0 N m, relative 0", ": 2.7e-15 N m, relative 5.9e-16"))
    for one, other in (
        ("0.0794 ", "0.0795 "),
        ("0.07940968", "0.07940969"),
        (" 30 ", " 31 "),
        ("degC", "K"),
        ("0 N", "1e-11 N"),
    ):
        assert not writer.compare.same_text(said, said.replace(one, other)), other


def drawn(path, height):
    figure = Figure(figsize=(2, 2))
    figure.add_subplot().plot(np.linspace(0, 1, 50), height * np.linspace(0, 1, 50) ** 2)
    figure.gca().set_ylim(0, 2)
    figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)
    return path


@pytest.mark.slow
def test_committed_drawings_may_differ_by_what_nobody_sees(writer, tmp_path):
    """All of them, with names of clip paths that another processor may make, and with the last digits of a place."""
    drawings = sorted(writer.write.FIGURES.rglob("*.svg"))
    assert len(drawings) > 30
    for number, one in enumerate(drawings):
        text = one.read_text(encoding="utf-8")
        clip = re.search(r'<clipPath id="(\w+)"', text)
        renamed = text.replace(clip[1], "pabc123e4567") if clip else text
        place = re.search(r"\bM (\d+\.\d+) ", renamed)
        moved = [f"M {float(place[1]) + by} ".join(renamed.split(place[0], 1)) for by in (0.001, 1.0)]
        paths = [tmp_path / f"{number}_{by}.svg" for by in ("nearly", "other")]
        for path, content in zip(paths, moved, strict=True):
            path.write_text(content, encoding="utf-8")
        assert [writer.compare.same_figure(one, path) for path in paths] == [True, False], one.name


@pytest.mark.parametrize("suffix", [".svg", ".png"])
def test_figures_may_differ_by_what_nobody_sees(writer, tmp_path, suffix, monkeypatch):
    monkeypatch.setitem(__import__("matplotlib").rcParams, "svg.hashsalt", "the same")
    one = drawn(tmp_path / f"one{suffix}", 1.0)
    assert writer.compare.same_figure(one, drawn(tmp_path / f"nearly{suffix}", 1.0 + 1e-7))
    assert not writer.compare.same_figure(one, drawn(tmp_path / f"other{suffix}", 1.1))
    assert not writer.compare.same_figure(tmp_path / f"none{suffix}", one)
