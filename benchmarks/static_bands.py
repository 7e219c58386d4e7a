"""The bands of the page without a server beside those of ``ballscrew run --band``, which draws other laws, too.

``python benchmarks/static_bands.py`` prints the table of docs/howto/browser.md, of the torque at the operating point,
and quantiles of random cases. That the scripts of the page find the ends of ``bs.band`` with its samples and the
calibrations of makers is held by tests/faces/page/test_bands.py: so what the page shows is computed by that here.
"""

from __future__ import annotations

from collections.abc import Iterator
from random import Random

import numpy as np

from ballscrew.cases.case_files import case_file, uncertain_inputs
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.uncertainty import bands
from ballscrew.faces.page import kinds
from ballscrew.physics.sizing.catalogue import catalogue
from ballscrew.questions.band.compute import alternatives, of_makers
from ballscrew.questions.shared.text_tables import markdown_table

#: Kinds of nut with the samples of the page.
NUTS = {
    "balls alone": ("row", 16_384),
    "double, rigid": ("double", 16_384),
    "double, elastic": ("double+elastic", 1024),
}
RANDOM_CASES = 30


def both(case: Case, samples: int) -> list[tuple[float, float]]:
    """The ends of the band of the torque, N m, on the page and in the program."""
    given = {name: getattr(case, name) for name in ("model", "screw", "lubricant")}
    given |= {name: float(getattr(case.operation, name)) for name in ("axial_load", "screw_speed")}
    given["distributions"] = {name: one.distribution for name, one in uncertain_inputs.all_of(case).items()}
    return [
        bands.band(**given, alternatives=others, outputs=["screw_torque"], samples=samples)["screw_torque"].both
        for others in (of_makers(case), alternatives(case))
    ]


def random_cases() -> Iterator[Case]:
    """A start, its nut or another, a point."""
    random = Random(46)
    for _ in range(RANDOM_CASES):
        start = random.choice(list(kinds.start_tables()))
        own = "row" if start == kinds.PAPER else catalogue()[start].nut
        kind = own if random.random() < 0.7 else random.choice([*(nut for nut, _ in NUTS.values()), "single"])
        tables = kinds.tables_of(start, "reference", kind)
        load = random.choice([0.2, 0.5, 1, 2]) * kinds.case_of(start, "reference", kind).operation.axial_load
        point = {"axial_load": f"{load} N", "screw_speed": f"{random.choice([30, 120, 600, 1500])} rpm"}
        if "grade" in tables["lubricant"]:
            grade, warmth = random.choice(["ISO VG 46", "ISO VG 100", "ISO VG 220"]), random.choice([20, 40, 60])
            tables["lubricant"] = {"grade": grade, "temperature": f"{warmth} degC"}
        yield case_file.build({**tables, "operation": point}, rows=catalogue())


def table() -> str:
    """The bands on the paper's screw, and quantiles of the ends of random cases."""
    rows = [
        (
            words,
            *(f"{low:.3f} to {high:.3f}" for low, high in both(kinds.case_of(kinds.PAPER, "reference", nut), samples)),
        )
        for words, (nut, samples) in NUTS.items()
    ]
    lines = [markdown_table(("nut", "page, N m", "program, N m"), rows)]
    ratios = [np.divide(*both(case, 1024)) for case in random_cases()]
    for end, found in zip(("low", "high"), np.transpose(ratios), strict=True):
        least, lower, median, upper, most = np.quantile(found, [0, 0.25, 0.5, 0.75, 1])
        lines.append(
            f"{end} end, page over program: {median:.2f}, {lower:.2f} to {upper:.2f}, all {least:.2f} to {most:.2f}"
        )
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    print(table(), end="")
