"""What tests of analyses share stands beside them: synthetic logs."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
