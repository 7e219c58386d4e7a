"""The bands of the static page against those of the program: their ends, how near they are, what they take.

``python benchmarks/static_bands.py`` prints the tables of docs/howto/browser.md, of the torque at the operating
point. ``page`` is what the scripts of the page find in node; ``program`` is the band of ``ballscrew run --band``, which
draws other laws, too. ``difference`` is the worst relative one of the ends of all outputs and of the fan from the
program with the samples and the calibrations of the page. Times are those of node: ends alone, and with the fan.
"""

from __future__ import annotations

import itertools
import math
import tempfile
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import Any

import numpy as np

import harness  # noqa: F401  (tests are found by it)
from ballscrew.cases.case_files import case_file, uncertain_inputs
from ballscrew.engine.uncertainty import bands
from ballscrew.faces.page import kinds
from ballscrew.physics.sizing.catalogue import catalogue
from ballscrew.questions.band.compute import alternatives, of_makers
from ballscrew.questions.shared.text_tables import markdown_table
from support.bands_in_node import BandsPage, arguments_of, band_of_program, fan_of_program
from support.judged_in_node import case_at

NUTS = {"balls alone": "row", "double, rigid": "double", "double, elastic": "double+elastic"}
STARTS = {"paper's screw": kinds.PAPER, "40×10": "rexroth-40x10x6-6-double"}
ENDS = "low", "high"
RANDOM_CASES = 30
HEADING = (
    "screw", "nut", "page, N m", "program, N m", "its ends lower by", "its band wider by", "difference", "ends, s",
    "with the fan, s",
)  # fmt: skip
#: The range of the fan, rad/s.
SLOWEST, FASTEST = 2.0, 150.0
#: Speeds of the fan.
SPEEDS, SPEEDS_BY_BALL = 25, 9


def _both(band: bands.OutputBand) -> Iterator[tuple[str, float]]:
    return zip(ENDS, band.both, strict=True)


def compared(page: BandsPage, start: str, structure: tuple[str, str]) -> dict[str, Any]:
    """One nut at one start."""
    by_ball = "+" in structure[1]
    speeds = np.linspace(SLOWEST, FASTEST, SPEEDS_BY_BALL if by_ball else SPEEDS)
    question = page.question(start, structure, speeds)
    (found,) = page.bands([question])
    point, fan = found["point"], found["fan"]
    same = band_of_program(start, structure, question, point["count"], list(point["ends"]))
    over = fan_of_program(start, structure, question, fan["count"])
    pairs = [
        *((ends[end], both) for name, ends in point["ends"].items() for end, both in _both(same[name])),
        *zip(fan["lows"], over.both[0], strict=True),
        *zip(fan["highs"], over.both[1], strict=True),
    ]  # fmt: skip
    given = arguments_of(start, structure, question)
    given["alternatives"] = alternatives(case_at(start, structure, question["inputs"]))
    speed = question["inputs"]["screw_speed"]
    whole = bands.band(**given, screw_speed=speed, outputs=["screw_torque"], samples=point["count"])
    ends = point["ends"]["screw_torque"]
    return {
        "page": (ends["low"], ends["high"]),
        "program": whole["screw_torque"].both,
        "difference": max(abs(one - other) / abs(other) for one, other in pairs),
        "seconds": (point["milliseconds"] / 1e3, fan["milliseconds"] / 1e3),
    }


def random_ends() -> Iterator[tuple[float, float]]:
    """The ends of the page over those of the program, of random cases: a start, its nut or another, a point."""
    random = Random(46)
    for _ in range(RANDOM_CASES):
        start = random.choice(list(kinds.start_tables()))
        own = "row" if start == kinds.PAPER else catalogue()[start].nut
        kind = own if random.random() < 0.7 else random.choice([*NUTS.values(), "single"])
        tables = kinds.tables_of(start, "reference", kind)
        load = random.choice([0.2, 0.5, 1, 2]) * kinds.case_of(start, "reference", kind).operation.axial_load
        point = {"axial_load": f"{load} N", "screw_speed": f"{random.choice([30, 120, 600, 1500])} rpm"}
        if "grade" in tables["lubricant"]:
            grade, warmth = random.choice(["ISO VG 46", "ISO VG 100", "ISO VG 220"]), random.choice([20, 40, 60])
            tables["lubricant"] = {"grade": grade, "temperature": f"{warmth} degC"}
        case = case_file.build({**tables, "operation": point}, rows=catalogue())
        given = {name: getattr(case, name) for name in ("model", "screw", "lubricant")}
        given |= {name: float(getattr(case.operation, name)) for name in point}
        given["uncertain"] = {name: one.distribution for name, one in uncertain_inputs.all_of(case).items()}
        (low, high), (least, most) = (
            bands.band(**given, alternatives=others, outputs=["screw_torque"], samples=1024)["screw_torque"].both
            for others in (of_makers(case), alternatives(case))
        )
        yield low / least, high / most


def table() -> str:
    """The bands at the starts, and quantiles of the ends of random cases."""
    rows: list[tuple[str, ...]] = []
    with tempfile.TemporaryDirectory() as folder:
        page = BandsPage(Path(folder), [("reference", kind) for kind in NUTS.values()])
        for (screw, start), (nut, kind) in itertools.product(STARTS.items(), NUTS.items()):
            found = compared(page, start, ("reference", kind))
            (low, high), (least, most), (ends, fan) = found["page"], found["program"], found["seconds"]
            lower = sorted((1 - least / low, 1 - most / high))
            wider = math.log(most / least) / math.log(high / low) - 1
            rows.append(
                (
                    screw,
                    nut,
                    f"{low:.3f} to {high:.3f}",
                    f"{least:.3f} to {most:.3f}",
                    f"{lower[0]:.0%} to {lower[1]:.0%}",
                    f"{wider:.0%}",
                    f"{found['difference']:.0e}",
                    f"{ends:.1f}",
                    f"{fan:.1f}",
                )
            )
    lines = [markdown_table(HEADING, rows)]
    for end, ratios in zip(ENDS, np.transpose(list(random_ends())), strict=True):
        least, lower, median, upper, most = np.quantile(ratios, [0, 0.25, 0.5, 0.75, 1])
        lines.append(
            f"{end} end, page over program: {median:.2f}, {lower:.2f} to {upper:.2f}, all {least:.2f} to {most:.2f}"
        )
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    print(table(), end="")
