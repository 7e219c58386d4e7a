"""Comparison of the models with the contact integral, as printed by the benchmarks."""

from __future__ import annotations

import contextlib
import importlib
import io
import json
import sys
from pathlib import Path

BENCHMARKS = Path(__file__).parents[1] / "benchmarks"


def printed(benchmark: str, *options: str) -> str:
    """Output of a benchmark, run in this process: what it has computed serves its next options."""
    if str(BENCHMARKS) not in sys.path:
        sys.path.append(str(BENCHMARKS))
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        importlib.import_module(benchmark).main(options)
    return said.getvalue()


def page() -> str:
    """All tables of the page on accuracy."""
    return printed("reference", "--markdown")


def short_table() -> str:
    """One line for each comparison of the reference model, for the page on agreement."""
    tables = json.loads(printed("reference", "--json", "--no-speed"))["tables"]
    lines = [["reference model against the integral", "screws", "median", "95 % within", "largest"], ["---"] * 5]
    for table in tables:
        row = next(row for row in table["rows"] if row["model"] == "reference")
        errors = [f"{100 * row['median']:.1g} %", f"{100 * row['p95']:.1f} %", f"{100 * row['largest']:.1f} %"]
        title = table["title"][0].lower() + table["title"][1:]
        lines.append([title, str(row["n"]), *errors])
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)
