"""The version of the package, and when it was imported."""

import time

__version__ = "0.1.0"
#: The time at which the package was imported, in seconds since the epoch: files changed later are not what runs.
IMPORTED_AT = time.time()
