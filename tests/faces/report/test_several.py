"""A report of several designs: side by side what each has by itself, and no page nearly blank."""

import io

import pypdf
import pytest
from tests.faces.report.test_report import (
    _EXPONENT,
    _NO_NUMBERS,
    LEAST_FILLED,
    SAMPLES,
    case_of,
    text_and_least_filled,
)

from ballscrew.basis.output.sheet import Number, words
from ballscrew.basis.quantities import quantities_of
from ballscrew.faces.report import several
from ballscrew.faces.report.pdf import pdf_bytes
from ballscrew.faces.sheets.report_blocks import as_data
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.band import compute
from ballscrew.questions.check.answer import checked
from ballscrew.questions.run.compute import run

NAMES = ("catalogue_screw", "feed_drive", "rig")
_TORQUE = quantities_of(FrictionResult)["screw_torque"]


@pytest.fixture(scope="module")
def content():
    return several.content([case_of(name) for name in NAMES], samples=SAMPLES)


def table_of(content, title):
    (section,) = (section for section in content.sections if section.title == title)
    return next(block for block in section.blocks if hasattr(block, "rows"))


@pytest.mark.slow
def test_each_column_is_what_the_design_has_by_itself(content):
    assert [section.title for section in content.sections][:3] == ["Answer", "Checks", "Side by side"]
    torque = next(row for row in table_of(content, "Side by side").rows if row[0] == "friction torque on the screw")
    verdicts = table_of(content, "Checks").rows[-1]
    first = float(run(case_of(NAMES[0])).friction.screw_torque)
    for place, name in enumerate(NAMES, start=1):
        case = case_of(name)
        value = float(run(case).friction.screw_torque)
        both = compute.band(case, compute.BandOptions(samples=SAMPLES)).band["screw_torque"].both
        change = "" if place == 1 else f", {value / first - 1:+.0%}"
        assert torque[place] == f"{words(Number(value, _TORQUE, band=both))}{change}"
        assert verdicts[place].lower() == checked("", case).verdict.lower()
    buckling = next(row for row in table_of(content, "Checks").rows if row[0] == "buckling")
    assert buckling[1].startswith("7.5%: 7 kN against ")
    assert buckling[2] == "not judged: give installation"


@pytest.mark.slow
def test_its_pages_are_few_and_none_is_nearly_blank(content):
    reader = pypdf.PdfReader(io.BytesIO(pdf_bytes(content)))
    assert 3 <= len(reader.pages) <= content.pages == 8
    text, filled = text_and_least_filled(reader)
    assert filled >= LEAST_FILLED
    assert not _NO_NUMBERS.search(text)
    assert not _EXPONENT.findall(text)
    assert "designs A, B, C" in text


@pytest.mark.slow
def test_equal_designs_give_equal_reports(content):
    again = several.content([case_of(name) for name in NAMES], samples=SAMPLES)
    assert as_data(again) == as_data(content)
