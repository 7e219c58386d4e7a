"""The program of a job that starts from nothing: ``python -m ballscrew.faces.web.job_program``, as jobs start it."""

from __future__ import annotations

import os
import signal
import sys
from typing import NoReturn

from ballscrew.faces.web.job_process import answer_one
from ballscrew.faces.web.server import application


def main() -> NoReturn:
    """Answer the request on standard input by the application of the server."""
    messages = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever libraries print
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    answer_one(lambda requests: application(requests=requests), sys.stdin.buffer, messages)


if __name__ == "__main__":
    main()
