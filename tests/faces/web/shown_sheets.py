"""What a card of the page shows of a sheet: all of it, in metric units."""

import re

import pytest

from ballscrew.basis import units
from ballscrew.basis.quantities import Info, Quantity
from support.documents import ROUNDING

CHARTS = ("chart", "bars", "map")


#: A field as a case file has it: its path, or its entry.
KEY = re.compile(r"\b[a-z]+(?:\.[a-z_]+)+\b|\[[a-z]+\] [a-z_]+ = ")
#: Numbers that the page writes with a power of ten, and the command in words.
WITH_POWERS = (1e-4, 1e6)


def numbers_of(sheet):
    """The numbers and shares in the tables of a sheet, in their order: the value, and what is read of it.

    Nothing is said to be read of those that page and command write in different ways.
    """
    cells = [cell for block in sheet["blocks"] if block["kind"] == "table" for row in block["rows"] for cell in row]
    return [(cell.get("share", cell.get("value")), words_of(cell)) for cell in cells if isinstance(cell, dict)]


def words_of(cell):
    if "share" in cell:
        sign = "+" if cell["is_change"] and cell["share"] and cell["share"] > 0 else ""
        return None if cell["share"] is None else f"{sign}{100 * round(cell['share'], 3) + 0.0:.1f} %"
    if cell["value"] is None:
        return None
    unit = cell["shown_in"] if cell["unit"] != "1" else ""
    quantity = Quantity("", cell["unit"], Info("", "", unit))
    size = abs(float(units.from_si(cell["value"], quantity)))
    if size and not WITH_POWERS[0] <= size < WITH_POWERS[1]:
        return None
    number = units.rounded(cell["value"], quantity, cell["digits"], cell.get("toward", 0))
    return f"{number} {units.symbol(unit)}".strip()


def as_read(line):
    """A pattern of a sentence as the page says it: with labels for the keys of fields, and raised powers."""
    line = re.sub(r"(?<=[a-z])\^([23])", lambda power: "²³"[int(power[1]) - 2], line.casefold())
    return ".+".join(map(re.escape, KEY.split(line)))


def shows(here, card, sheet):
    """Wait until a card has its answer, and assert that it shows all of this sheet.

    The page was answered apart from whoever asks here, perhaps by the other engine: numbers are equal to rounding.
    """
    here.page.wait_for_selector(f"#{card} .card-result[aria-busy=false]:not(.earlier, [hidden])", state="attached")
    shown = here.page.eval_on_selector_all(
        f"#{card} .sheet data", "all => all.map((one) => [one.value, one.textContent])"
    )
    shown = [(float(value), text.partition(" (")[0].replace("\u00a0", " ")) for value, text in shown if value]
    known = [(number, text) for number, text in numbers_of(sheet) if number is not None]
    assert [value for value, _ in shown] == pytest.approx([value for value, _ in known], rel=ROUNDING, abs=0)
    read = [(text, wanted) for (_, text), (_, wanted) in zip(shown, known, strict=True) if wanted is not None]
    assert read
    others = [pair for pair in read if pair[0] != pair[1]]
    assert others == [], others
    words = "".join(here.page.locator(f"#{card} :is(.sheet-head, .sheet)").all_text_contents()).casefold()
    lines = [line["text"] for block in sheet["blocks"] if block["kind"] == "lines" for line in block["lines"]]
    assert [line for line in [sheet["title"], *lines] if not re.search(as_read(line), words)] == []
    titles = [block["title"] for block in sheet["blocks"] if block["kind"] in CHARTS]
    assert here.page.locator(f"#{card} .sheet figcaption").all_text_contents() == titles
    saved = [block["name"] for block in sheet["blocks"] if block["kind"] == "columns"]
    assert here.page.locator(f"#{card} .sheet [data-columns]").count() == len(saved)
    return here


def drawn(here, id):
    """The plot of a chart that is scrolled to."""
    here.page.locator(f"#{id}").scroll_into_view_if_needed()
    here.page.wait_for_selector(f"#{id} .plot[data-drawn]")
    return here.page.query_selector(f"#{id} .plot")
