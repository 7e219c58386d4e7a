"""Lines that the commands of tests run: in forks of a process (``tests/support/fork_server.py``), each counted here.

Python imports a module of this name when it starts, if it stands in the path: in processes of tests that are measured.
"""

from __future__ import annotations

import atexit
import json
import os
import sys
from pathlib import Path
from typing import Any


def _count() -> None:
    """Count the lines of a fork until it ends."""
    import coverage

    if coverage.Coverage.current() is None:  # no fork of a fork
        counter = coverage.Coverage(data_file=None, config_file=False, include=os.environ["LINES_OF"].split(","))
        # a refusal may run none of the lines: a warning of that would stand among what the command prints
        counter.set_option("run:disable_warnings", ["no-data-collected"])
        counter.start()
        atexit.register(_write, counter)


def _write(counter: Any) -> None:
    """Write the lines, with the test that the fork finds in its environment."""
    counter.stop()
    data = counter.get_data()
    lines = {file: data.lines(file) for file in data.measured_files()}
    found = {"context": os.environ["COUNTS_FOR"], "lines": lines}
    Path(os.environ["LINES_OF_COMMANDS"], f"{os.getpid()}.json").write_text(json.dumps(found), encoding="utf-8")


if "LINES_OF_COMMANDS" in os.environ and any(one.endswith("fork_server.py") for one in sys.orig_argv):
    os.register_at_fork(after_in_child=_count)
