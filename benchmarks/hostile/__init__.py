"""The hostile run: random, mutated and damaged input of all kinds, and a table of how it ended.

``python -m benchmarks.hostile`` from the root of the repository, or ``make hostile``.
"""

import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "benchmarks")]  # random parts, logs and requests are shared with them
