"""The bands of the static page against those of the program: their ends, how near they are, what they take.

``python benchmarks/static_bands.py`` prints the tables of docs/howto/static_page.md, of the torque at the operating
point. ``page`` is what the scripts of the page find in node; ``program`` is the band of ``ballscrew run --band``, which
draws other laws, too. ``difference`` is the worst relative one of the ends of all outputs and of the fan from the
program with the samples and the calibrations of the page. Times are those of node: ends alone, and with the fan.
"""

from __future__ import annotations

import math
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from ballscrew.engine.uncertainty import bands
from ballscrew.faces.site import banding, kinds
from ballscrew.questions.band.compute import alternatives

sys.path.append(str(Path(__file__).parents[1] / "tests"))
from support.bands_in_node import BandsPage, arguments_of, band_of_program, fan_of_program
from support.judged_in_node import case_at

NUTS = {"balls alone": "row", "double, rigid": "double", "double, elastic": "double+elastic"}
STARTS = {"paper's screw": kinds.PAPER, "40×10": "rexroth-40x10x6-6-double"}
ENDS = "low", "high"
HEADING = (
    "screw", "nut", "page, N m", "program, N m", "its ends lower by", "its band wider by", "difference", "ends, s",
    "with the fan, s",
)  # fmt: skip
#: The range of the fan, rad/s.
SLOWEST, FASTEST = 2.0, 150.0


def _both(band: bands.OutputBand) -> Iterator[tuple[str, float]]:
    return zip(ENDS, band.both, strict=True)


def compared(page: BandsPage, start: str, structure: tuple[str, str]) -> dict[str, Any]:
    """One nut at one start."""
    by_ball = "+" in structure[1]
    speeds = np.linspace(SLOWEST, FASTEST, banding.SPEEDS_BY_BALL if by_ball else banding.SPEEDS)
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


def main() -> None:
    """Print the table."""
    print(f"| {' | '.join(HEADING)} |")
    print("|---" * len(HEADING) + "|")
    with tempfile.TemporaryDirectory() as folder:
        page = BandsPage(Path(folder), [("reference", kind) for kind in NUTS.values()])
        for screw, start in STARTS.items():
            for nut, kind in NUTS.items():
                found = compared(page, start, ("reference", kind))
                (low, high), (least, most) = found["page"], found["program"]
                lower = sorted((1 - least / low, 1 - most / high))
                wider = math.log(most / least) / math.log(high / low) - 1
                ends, fan = found["seconds"]
                cells = (
                    screw, nut, f"{low:.3f} to {high:.3f}", f"{least:.3f} to {most:.3f}",
                    f"{lower[0]:.0%} to {lower[1]:.0%}", f"{wider:.0%}", f"{found['difference']:.0e}", f"{ends:.1f}",
                    f"{fan:.1f}",
                )  # fmt: skip
                print(f"| {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
