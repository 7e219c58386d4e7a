"""What people type into the search of the page: parts are found by sizes, parts of names and order codes."""

import json
import subprocess

import pytest

from ballscrew.physics.sizing.catalogue import catalogue, printed_rows
from support.modules_in_node import PAGE
from support.node import node

SCRIPT = """
const [page, text] = process.argv.slice(1);
const { screwsFor } = await import(`file://${page}/part_search.js`);
const { searches, starts } = JSON.parse(text);
console.log(JSON.stringify({ searches: searches.map((one) => screwsFor(one, starts)) }));
"""
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
            "source": row.source,
            "kind": row.nut,
            "sizes": [float(f"{1e3 * size:.12g}") for size in (row.nominal_diameter, row.lead, row.ball_diameter)],
        }
        for name, row in ((row.name, row) for row in printed_rows())
    }
    asked = {"searches": [*SEARCHES], "starts": starts}
    command = [node(), "--input-type=module", "-e", SCRIPT, "--", str(PAGE), json.dumps(asked)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_a_part_is_found_by_sizes_parts_of_names_and_order_codes(answers):
    for (text, (names, is_code)), found in zip(SEARCHES.items(), answers["searches"], strict=True):
        assert found == {"names": names, "isCode": is_code}, text
