"""What people type into the static page: numbers are read as the program reads them, parts found by sizes and codes."""

import json
import math
import subprocess

import pytest

from ballscrew.basis import units
from ballscrew.basis.errors import Fault
from ballscrew.basis.quantities import fields_of
from ballscrew.faces.web.vocabulary import vocabulary
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.sizing.catalogue import catalogue, printed_rows
from support.modules_in_node import PAGE
from support.node import node

SCRIPT = """
const [page, text] = process.argv.slice(1);
const { quantityIn } = await import(`file://${page}/words.js`);
const { screwsFor } = await import(`file://${page}/../../web/page/part_search.js`);
const { forces, quantity, units, searches, starts } = JSON.parse(text);
console.log(JSON.stringify({
  forces: forces.map((one) => String(quantityIn(one, quantity, units))),
  searches: searches.map((one) => screwsFor(one, starts)),
}));
"""
FORCES = (
    "4000", "4 kN", "4kN", "4,5 kN", "0,125", "4,000", "12,345 kN", "4 000", "1'000", "4,000.5", "4.000,5", "1e3",
    "−50", "-50 N", "900 lbf", "4 KN", "4 mm", "0x10", "Infinity", "", "four",
)  # fmt: skip
OF_40X10 = ["rexroth-40x10x6-6-double"]
#: What is typed, the rows that are meant, and whether it is an order code of none of them.
SEARCHES = {
    "40x10": (OF_40X10, False),
    "40×10": (OF_40X10, False),
    " 40 X 10 ": (OF_40X10, False),
    "rexroth 40x10x6": (OF_40X10, False),
    "BNF4010-5": (OF_40X10, True),
    "R40-10K5-FSC": (OF_40X10, True),
    "hiwin-40-16k5": (["hiwin-40-16k5"], False),
    "R1532 460 23": ([name for name in catalogue() if name.startswith("rexroth")], True),
    "47x11": ([], False),
}


@pytest.fixture(scope="module")
def answers():
    starts = {
        name: {
            "source": row.source, "kind": row.nut,
            "sizes": [float(f"{1e3 * size:.12g}") for size in (row.nominal_diameter, row.lead, row.ball_diameter)],
        }
        for name, row in ((row.name, row) for row in printed_rows())
    }  # fmt: skip
    force = {"unit": "N", "factor": 1.0, "offset": 0.0}
    asked = {"forces": FORCES, "quantity": force, "units": vocabulary()["units"], "searches": [*SEARCHES]}
    command = [node(), "--input-type=module", "-e", SCRIPT, "--", str(PAGE), json.dumps({**asked, "starts": starts})]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_a_number_is_read_as_the_program_reads_it(answers):
    load = fields_of(OperatingState)["axial_load"]
    for text, found in zip(FORCES, map(float, answers["forces"]), strict=True):
        has_unit = text[-1:].isalpha()
        expected = units.parse("", text if has_unit else f"{text} N", load)
        if isinstance(expected, Fault) or not math.isfinite(expected):
            assert math.isnan(found), text
        else:
            assert found == pytest.approx(expected, rel=1e-11), text


def test_a_part_is_found_by_sizes_parts_of_names_and_order_codes(answers):
    for (text, (names, is_code)), found in zip(SEARCHES.items(), answers["searches"], strict=True):
        assert found == {"names": names, "isCode": is_code}, text
