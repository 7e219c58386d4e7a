"""Change detector: the paper's screw in all models. Says that numbers moved, not that they are right.

If a change was meant: ``python tests/golden/test_numbers.py --write``, and say why in the change log.
"""

import argparse
import json
import math
from pathlib import Path

import pytest

import ballscrew as bs
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW

STORED = Path(__file__).with_name("seed_screw.json")
MODELS = {
    "olaru2005": bs.FrictionModel.olaru2005,
    "corrected": bs.FrictionModel.corrected,
    "reference": bs.FrictionModel.reference,
}
#: Axial load in N, screw speed in rpm.
POINTS = ((4000.0, 600.0), (1000.0, 60.0), (200.0, 3000.0))
#: Room for other processors and mathematical libraries.
RELATIVE = 1e-11
#: Outputs that are nothing but rounding: in units of what they are a share of.
ROUNDING = {"residual": 1e-12}


def numbers(name: str, axial_load: float, rpm: float) -> dict[str, float]:
    """Everything a result says, by name."""
    r = MODELS[name]()(SCREW, OIL, axial_load=axial_load, screw_speed=rpm * math.pi / 30)
    return {output: float(entry.read(r)) for output, entry in known_outputs().items()}


def key(name: str, axial_load: float, rpm: float) -> str:
    return f"{name}, {axial_load:g} N, {rpm:g} rpm"


@pytest.mark.parametrize("name", MODELS)
@pytest.mark.parametrize(("axial_load", "rpm"), POINTS)
def test_numbers_have_not_moved(name, axial_load, rpm):
    stored = json.loads(STORED.read_text(encoding="utf-8"))[key(name, axial_load, rpm)]
    found = numbers(name, axial_load, rpm)
    moved = {
        output: (value, found.get(output))
        for output, value in stored.items()
        if output not in found
        or not (
            math.isclose(found[output], value, rel_tol=RELATIVE, abs_tol=ROUNDING.get(output, 0))
            or (math.isnan(found[output]) and math.isnan(value))  # without meaning at this point, then and now
        )
    }
    assert not moved, "if this was meant: python tests/golden/test_numbers.py --write"


def test_every_output_is_stored():
    stored = json.loads(STORED.read_text(encoding="utf-8"))
    assert set(stored) == {key(name, *point) for name in MODELS for point in POINTS}
    for values in stored.values():
        assert set(values) == set(known_outputs()), "if this was meant: python tests/golden/test_numbers.py --write"


def main() -> None:
    """Store the present numbers."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--write", action="store_true", required=True, help="store the present numbers")
    parser.parse_args()
    stored = {key(name, *point): numbers(name, *point) for name in MODELS for point in POINTS}
    STORED.write_text(json.dumps(stored, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
