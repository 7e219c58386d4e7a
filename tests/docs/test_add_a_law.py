"""The how-to on laws shows the file that its commands import."""

from .pages import DOCS, ROOT, blocks


def test_the_page_shows_the_file():
    page = DOCS / "howto" / "add_a_law.md"
    shown = next(block for block in blocks(page) if block.info == "python")
    law = ROOT / "examples" / "stribeck.py"
    assert shown.text == law.read_text(encoding="utf-8")
    assert f"{len(shown.text.splitlines())} lines" in page.read_text(encoding="utf-8")
