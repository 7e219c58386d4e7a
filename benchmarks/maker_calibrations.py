"""Calibrations by maker: one number each, the force between balls over the load of a ball, on declared rows.

The torque of a nut without load is linear in that number, so least squares of model / stated − 1 have one step.
``hiwin`` is fitted on the rows of ``hiwin-stock`` that ``data/validation/splits.toml`` declares, ``jis`` on the rule
of JIS B 1192 for the sizes of ``rexroth-double-nut`` and its worked example. Both are of nuts with two contacts a ball.

    python benchmarks/maker_calibrations.py             what they predict of rows left out of the fit, as Markdown
    python benchmarks/maker_calibrations.py --write     the same into docs/maker_calibrations.inc
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ballscrew.evidence.validation.entries import Point, may_be_fitted
from ballscrew.evidence.validation.sets import SETS
from ballscrew.physics.friction.calibrations import with_parameters
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.questions.shared.text_tables import markdown_table
from ballscrew.questions.validate import compute
from harness import study

#: Boundary friction and the force between balls of the reference model.
BOUNDARY, SHARE = 0.12, 0.0075


class Row(NamedTuple):
    """A row of a fit: its name and what it is like, the value stated, and the torque as a line over the number."""

    name: str
    group: str
    size: float
    lead: float
    stated: float
    start: float
    slope: float

    def ratio(self, share: float) -> float:
        """Model over stated."""
        return (self.start + self.slope * share) / self.stated


class Line(NamedTuple):
    """The number of a fit, its variance, the rows, and the sum of squares that is left."""

    share: float
    variance: float
    rows: Sequence[Row]
    cost: float


class MakerFit(NamedTuple):
    """A calibration of one maker: whose it is, the files with its rows, the rows, and what they state."""

    maker: str
    sets: Sequence[str]
    rows: Callable[[], Sequence[Row]]
    stated: str = "of declared rows"

    @property
    def objective(self) -> str:
        """What was least."""
        return f"least squares of model / stated - 1 {self.stated}, every row with the same weight"


def _points(name: str, share: float) -> Mapping[str, Point]:
    data = SETS[name]
    model = with_parameters(FrictionModel.reference(), BOUNDARY, share)
    found = [point for row in compute.shipped_rows(data) for point in data.evaluate(model, row, data.conditions)]
    return {point.name: point for point in found}


def _rows(name: str, stated: Callable[[Point], float], kept: Callable[[Point], bool]) -> list[Row]:
    none, some = _points(name, 0.0), _points(name, SHARE)
    return [
        Row(
            point.name,
            point.group,
            point.descriptors["size"],
            point.descriptors["lead"],
            stated(point),
            point.value,
            (some[point.name].value - point.value) / SHARE,
        )
        for point in none.values()
        if kept(point)
    ]


def hiwin_rows(declared: bool = True) -> list[Row]:
    """Double and offset nuts of HIWIN's stock list: those that are fitted, or those kept aside."""
    return _rows(
        "hiwin-stock",
        lambda point: point.band.middle,
        lambda point: point.group in ("double", "offset") and may_be_fitted("hiwin-stock", point) == declared,
    )


def jis_rows() -> list[Row]:
    """The rule of JIS B 1192 for the sizes and preloads of Rexroth's double nuts, and its worked example."""

    def by_rule(point: Point) -> float:
        return point.laws["jis"] * point.band.middle

    return [
        *_rows("rexroth-double-nut", by_rule, lambda _: True),
        *_rows("thk-jis", lambda point: point.band.middle, lambda _: True),
    ]


FITS: Mapping[str, MakerFit] = {
    "hiwin": MakerFit("HIWIN", ("hiwin-stock",), hiwin_rows),
    # of Rexroth's nuts the sizes and preloads alone
    "jis": MakerFit("THK", ("rexroth-double-nut", "thk-jis"), jis_rows, "of the rule of JIS B 1192"),
}


#: Those that are fitted on the rows that are declared.
DECLARED_ROWS = ("hiwin",)


def line_of(rows: Sequence[Row]) -> Line:
    """The least-squares fit of rows; the variance is that of one number."""
    x = np.array([row.slope / row.stated for row in rows])
    y = np.array([1 - row.start / row.stated for row in rows])
    share = float(x @ y / (x @ x))
    left = x * share - y
    cost = float(left @ left)
    return Line(share, cost / max(len(rows) - 1, 1) / float(x @ x), rows, cost)


def _left_out(name: str, rows: Sequence[Row]) -> list[list[str]]:
    """Rows left out of a fit and predicted by it: kind by kind, half of the sizes, half of the leads."""
    size, lead = (float(np.median([getattr(row, key) for row in rows])) for key in ("size", "lead"))
    groups: dict[str, Callable[[Row], bool]] = {
        f"diameters above {1000 * size:g} mm": lambda row: row.size > size,
        f"diameters up to {1000 * size:g} mm": lambda row: row.size <= size,
        f"leads above {1000 * lead:g} mm": lambda row: row.lead > lead,
        f"leads up to {1000 * lead:g} mm": lambda row: row.lead <= lead,
        **{f"{kind} nuts": lambda row, kind=kind: row.group == kind for kind in dict.fromkeys(r.group for r in rows)},
    }
    lines: list[list[str]] = []
    for words, group in groups.items():
        kept, out = [row for row in rows if not group(row)], [row for row in rows if group(row)]
        if len(kept) > 1 and out:
            lines.append([name, words, f"{line_of(kept).share:.3g}", *_judged(out, line_of(kept).share)])
    return lines


def _judged(rows: Sequence[Row], share: float) -> list[str]:
    ratios = [row.ratio(share) for row in rows]
    scatter = f" ± {np.std(ratios, ddof=1):.2f}" if len(ratios) > 1 else ""
    return [str(len(rows)), f"{np.mean(ratios):.2f}{scatter}"]


def table() -> str:
    """What each calibration predicts of rows that were left out of the fit, as Markdown."""
    heading = ["calibration", "left out", "F_B/Q of the fit", "rows", "predicted / stated"]
    lines: list[list[str]] = []
    for name, fit in FITS.items():
        rows = fit.rows()
        lines += _left_out(name, rows)
        if name == "hiwin":
            share = line_of(rows).share
            lines.append([name, "the rows kept aside", f"{share:.3g}", *_judged(hiwin_rows(declared=False), share)])
    return markdown_table(heading, lines)


if __name__ == "__main__":
    study(__doc__, table, "maker_calibrations.inc")
