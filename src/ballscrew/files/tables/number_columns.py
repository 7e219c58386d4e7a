"""Columns of a table as numbers in SI, all cells at once: those that are plain numbers within their bounds."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas
from numpy.typing import NDArray

from ballscrew.basis.quantities import within_bounds
from ballscrew.files.tables import decimals
from ballscrew.files.tables.headings import NOTHING, Heading
from ballscrew.files.tables.sheets import is_error

pd: Any = pandas  # its own types know little of what comes out
#: The decimal marks of a file with decimal commas only.
COMMA = frozenset(",")
#: Marks of a missing value.
MISSING = (*NOTHING, "nan", "NaN", "NAN", "-nan", "-NaN")
#: Cells examined for a decimal mark, if the top of the file has none.
_EXAMINED = 10_000


def column_numbers(
    cells: Any, heading: Heading, decimal: frozenset[str]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """The numbers of a column in SI, and the places of cells that are not plain numbers, or out of bounds.

    :func:`~ballscrew.files.tables.cells.value_of` reads the cells at those places, one by one.
    """
    quantity = heading.column.quantity
    assert quantity is not None
    array = np.asarray(cells)
    if array.dtype.kind in "fiu":
        values = array.astype(np.float64)
        given = ~np.isnan(values)
    else:
        values = _plain_numbers(array, decimal)
        given = np.array([not is_missing(cell) for cell in array], dtype=bool)  # of no cells, too
    values = heading.offset + heading.scale * values if heading.unit else np.full(values.shape, np.nan)
    return values, np.flatnonzero(given & ~within_bounds(quantity.info, values))


def is_missing(cell: Any) -> bool:
    """Test whether a cell has no value, or an error of a spreadsheet in place of one."""
    if isinstance(cell, str):
        return cell in MISSING or is_error(cell)
    return cell is None or (isinstance(cell, float) and np.isnan(cell))


def _plain_numbers(cells: NDArray[Any], decimal: frozenset[str]) -> NDArray[np.float64]:
    """The cells that are plain numbers, whatever their decimal mark is, as long as it can be no other; else NaN."""
    texts = pd.Series([cell if isinstance(cell, str) else None for cell in cells], dtype=object)
    decimal = decimal or decimals.evidence(cell for cell in cells[:_EXAMINED] if isinstance(cell, str))
    if decimal == COMMA:
        texts = texts.where(~texts.str.contains(".", regex=False, na=False)).str.replace(",", ".", regex=False)
    values = pd.to_numeric(texts, errors="coerce").to_numpy(dtype=np.float64, copy=True)
    for place, cell in enumerate(cells):
        if isinstance(cell, int | float) and not isinstance(cell, bool):
            values[place] = cell
    return values
