"""Truth: the paper of a validation has the numbers of its table and of its rows, and is written whole or not at all."""

import pytest

from ballscrew.faces.report.validation import NOT_MEASURED, report
from ballscrew.faces.sheets.report_blocks import Bullets, Picture, Table
from ballscrew.questions.validate import compute
from ballscrew.questions.validate.sheet import summary


@pytest.fixture(scope="module")
def computed():
    request = compute.request(["rexroth-double-nut", "thk-jis", "hiwin-ratings"])
    found = [entries for entries, _ in compute.evaluate(request)]
    table, _ = summary(request, found)
    return found, table, report(request, found, table)


def blocks(made, kind):
    return [block for section in made.sections for block in section.blocks if isinstance(block, kind)]


def test_the_table_is_that_of_all_makers(computed):
    _, table, made = computed
    shown = blocks(made, Table)[0]
    assert [row[0] for row in shown.rows if not row[1]] == ["Rexroth, double", "THK, double"]
    rows = [row for row in shown.rows if row[1]]
    assert [float(row[2]) for row in rows] == pytest.approx([row.mean_ratio for row in table], rel=5e-3)
    assert [row[-1] for row in rows] == ["chosen on" if row.chosen_on else "never used" for row in table]


def test_every_row_stands_there_once(computed):
    found, _, made = computed
    listed = [row[0] for table in blocks(made, Table) if table.title.startswith("Each row") for row in table.rows]
    assert listed == [point.name for entries in found for point in entries[0].points]


@pytest.mark.slow
def test_coverage_is_counted(computed):
    """By hand: how many middles lie between the ends of the band of their row."""
    found, _, made = computed
    [shown] = [table for table in blocks(made, Table) if table.title.startswith("95 % band")]
    points = found[0][0].points
    inside = sum(point.uncertainty[0] <= point.band.middle <= point.uncertainty[1] for point in points)
    halves = [row for row in shown.rows if row[:2] == ["Rexroth", "double"]]
    assert [row[2] for row in halves] == ["fitted", "kept aside"]
    assert sum(int(row[3]) for row in halves) == len(points)
    assert sum(int(row[3]) * float(row[4].removesuffix(" %")) / 100 for row in halves) == pytest.approx(inside, abs=0.2)


def test_what_is_circular_and_what_is_not_measured(computed):
    _, _, made = computed
    circular, missing, *_ = blocks(made, Bullets)
    assert "calibration rexroth-2006, fitted" in circular.entries[0]
    assert missing.entries == NOT_MEASURED
    assert len(blocks(made, Picture)) == 1


def test_a_paper_by_the_command(ballscrew, tmp_path):
    done = ballscrew("validate", "thk-jis", "--report", tmp_path / "worth.html")
    assert done.returncode == 0, done.stderr
    text = (tmp_path / "worth.html").read_text(encoding="utf-8")
    assert "What friction models of ball screws are worth" in text
    assert "BNFN4010-5" in text
