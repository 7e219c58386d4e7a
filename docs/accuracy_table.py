"""Comparison of the models with the contact integral, by the benchmarks."""

from __future__ import annotations

import sys
from pathlib import Path

from ballscrew.questions.shared.text_tables import markdown_table

sys.path.append(str(Path(__file__).parents[1] / "benchmarks"))
import reference


def parts() -> dict[str, str]:
    """All tables of the page on accuracy, and one line of each for the page on agreement."""
    tables = reference.compared()
    whole = "\n".join(reference.as_markdown(table) for table in tables)
    rows: list[tuple[str, ...]] = []
    for table in tables:
        row = next(row for row in table.rows() if row["model"] == "reference")
        errors = f"{100 * row['median']:.1g} %", f"{100 * row['p95']:.1f} %", f"{100 * row['largest']:.1f} %"
        rows.append((table.title[0].lower() + table.title[1:], str(row["n"]), *errors))
    heading = ("reference model against the integral", "screws", "median", "95 % within", "largest")
    return {"whole.md": whole, "short.md": markdown_table(heading, rows)}
