"""A SYNTHETIC torque card, ``torque_cards/synthetic_40x10.toml``: written by a model, no screw was measured for it.

    python examples/make_torque_card.py            fail if the card is not what this script makes
    python examples/make_torque_card.py --write    write it

The same bytes every time.
"""

import argparse
from pathlib import Path

import numpy as np

from ballscrew.cases.case_files import case_file

CARD = Path(__file__).parent / "torque_cards" / "synthetic_40x10.toml"
HEAD = """\
# SYNTHETIC: made by examples/make_torque_card.py; no screw was measured. True boundary friction coefficient 0.10,
# an offset of 4 mN m between the directions, noise of 2 mN m. A card of a screw of yours: docs/howto/torque_card.md

[card]
format = 1
title = "40 x 10, double nut at 5 %"
made_by = "model"
who = "nobody"
when = 2026-11-22
licence = "CC0-1.0"
notes = "An example of the format."

[screw]
catalogue = "rexroth-40x10x6-6-double"

[nut]
preload = "5 %"

[lubricant]
grade = "ISO VG 68"
temperature = "24 degC"

[setup]
wipers = false
instrument = "torque flange 5 N m between motor and screw, nut held by a rod"
torque_uncertainty = "4 mN m"
nut_outer_diameter = "63 mm"
lubrication = "oil, 5 ml through the nut, excess wiped off"
run_in = "20 h at 500 rpm without load"
"""
SPEEDS = (10, 30, 100, 300, 1000)


def text() -> str:
    """The card."""
    tables = {
        "screw": {"catalogue": "rexroth-40x10x6-6-double"},
        "nut": {"preload": "5 %"},
        "lubricant": {"grade": "ISO VG 68", "temperature": "24 degC"},
        "operation": {"axial_load": "0 N", "screw_speed": "100 rpm"},
        "model": {"friction": {"boundary_friction_coefficient": 0.10}},
    }
    case, noise, lines = case_file.build(tables), np.random.default_rng(5), []
    for rpm in SPEEDS:
        temperature = 24 + rpm / 250
        true = float(
            case.model(
                case.screw,
                case.lubricant,
                axial_load=0.0,
                screw_speed=rpm * np.pi / 30,
                temperature=temperature + 273.15,
            ).screw_torque
        )
        forward, backward = (true + sign * 2e-3 + noise.normal(0, 2e-3) for sign in (1, -1))
        lines += [
            "\n[[points]]",
            f'screw_speed = "{rpm} rpm"',
            f'torque_forward = "{forward:.4f} N m"',
            f'torque_backward = "{backward:.4f} N m"',
            f'temperature = "{temperature:.1f} degC"',
        ]
    return HEAD + "\n".join(lines) + "\n"


def main() -> None:
    """Compare or write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true", help="write examples/torque_cards/synthetic_40x10.toml")
    made = text().encode()
    if parser.parse_args().write:
        CARD.write_bytes(made)
    elif CARD.read_bytes() != made:
        raise SystemExit(f"{CARD.name} is not what this script makes; --write writes it anew")


if __name__ == "__main__":
    main()
