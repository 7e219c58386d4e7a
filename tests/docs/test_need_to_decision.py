"""From need to decision: few commands, one case file, one report that has what each command said."""

import re
import shlex
import shutil

import pypdf
import pytest

from .pages import DOCS, ROOT, commands

PAGE = DOCS / "howto" / "need_to_decision.md"
TYPED = [command.removeprefix(".venv/bin/ballscrew ") for _, command in commands(PAGE)]
NEED, CASE, REPORT = "examples/needs/vertical_axis.toml", "out/axis.toml", "out/report.pdf"
#: Titles of the sections of the report, and the step that each is the answer of.
SECTIONS = ("Checks over the cycle", "Over a cycle of the motion", "Stiffness over the stroke", "As it warms up",
            "How far off it may be")  # fmt: skip


def test_it_is_one_chain_of_few_commands():
    """All go on with the case that the first one writes; nothing is edited between them."""
    assert [words.split()[0] for words in TYPED] == ["select", "duty", "axis", "check", "warm-up", "report"]
    assert shlex.split(TYPED[0])[1] == NEED
    assert CASE in shlex.split(TYPED[0])
    assert {shlex.split(words)[1] for words in TYPED[1:]} == {CASE}
    assert commands(PAGE, written=True) == commands(PAGE)


@pytest.mark.long
def test_the_chain_ends_in_one_report(tmp_path, commands):
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    for words in TYPED:
        done = commands.run(shlex.split(words), folder=tmp_path)
        assert done.returncode == 0, done.stderr
    reader = pypdf.PdfReader(tmp_path / REPORT)
    said = re.sub(r"\s+", " ", " ".join(page.extract_text() for page in reader.pages))
    for title in SECTIONS:
        assert title in said
    label = (tmp_path / CASE).read_text(encoding="utf-8").splitlines()[0].removeprefix("# ").partition(",")[0]
    assert label in said
