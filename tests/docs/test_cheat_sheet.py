"""The cheat sheet: one page, with every command, each name of which is one that exists."""

import importlib.util
import io
import re

import pytest
from pypdf import PdfReader

import ballscrew as bs

from .pages import DOCS

pytest.importorskip("typst", reason='needs the extra report: pip install "ballscrew[report]"')


@pytest.fixture(scope="module")
def cheat_sheet():
    spec = importlib.util.spec_from_file_location("make_cheat_sheet", DOCS / "make_cheat_sheet.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_it_is_one_page_with_all_that_it_lists(cheat_sheet, tmp_path):
    cheat_sheet.main(tmp_path / "cheat_sheet.pdf")
    pages = PdfReader(io.BytesIO((tmp_path / "cheat_sheet.pdf").read_bytes())).pages
    assert len(pages) == 1
    text = re.sub(r"\s", "", pages[0].extract_text())
    for heading, rows in cheat_sheet.contents():
        assert rows, heading
        assert [name for name, _ in rows if re.sub(r"\s", "", name) not in text] == [], heading


def test_names_of_python_exist(cheat_sheet):
    for name in cheat_sheet.PYTHON:
        for used in re.findall(r"bs\.(\w+)", name):
            assert hasattr(bs, used), name
