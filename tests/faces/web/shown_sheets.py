"""What a card of the page shows of a sheet: all of it."""

CHARTS = ("chart", "bars", "map")


def numbers_of(sheet):
    """The numbers and shares in the tables of a sheet, in their order."""
    cells = [cell for block in sheet["blocks"] if block["kind"] == "table" for row in block["rows"] for cell in row]
    return [cell.get("share", cell.get("value")) for cell in cells if isinstance(cell, dict)]


def shows(here, card, sheet):
    """Wait until a card has its answer, and assert that it shows all of this sheet; the numbers are exact."""
    here.page.wait_for_selector(f"#{card} .card-result[aria-busy=false]:not(.earlier, [hidden])", state="attached")
    shown = here.page.eval_on_selector_all(f"#{card} .sheet data", "all => all.map((one) => one.value)")
    known = [number for number in numbers_of(sheet) if number is not None]
    assert [float(one) for one in shown if one] == known
    words = here.page.locator(f"#{card} .sheet").text_content().casefold()
    lines = [line["text"] for block in sheet["blocks"] if block["kind"] == "lines" for line in block["lines"]]
    assert [line for line in [sheet["title"], *lines] if line.casefold() not in words] == []
    titles = [block["title"] for block in sheet["blocks"] if block["kind"] in CHARTS]
    assert here.page.locator(f"#{card} .sheet figcaption").all_text_contents() == titles
    saved = [block["name"] for block in sheet["blocks"] if block["kind"] == "columns"]
    assert here.page.locator(f"#{card} .sheet [data-columns]").count() == len(saved)
    return here


def drawn(here, id):
    """The plot of a chart that is scrolled to."""
    here.page.locator(f"#{id}").scroll_into_view_if_needed()
    here.page.wait_for_selector(f"#{id} .main-svg")
    return here.page.query_selector(f"#{id} .plot")
