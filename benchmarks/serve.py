"""A server in a process of its own, and requests for it: what benchmarks, screenshots and the hostile run share."""

import contextlib
import itertools
import re
import signal
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any

import psutil

CASE = {
    "screw": {"catalogue": "rexroth-40x10x6-6-double"},
    "lubricant": {"grade": "ISO VG 100", "temperature": "40 degC"},
    "operation": {"axial_load": "7 kN", "screw_speed": "600 rpm"},
}
NUT = {**CASE, "nut": {"preload": "7 %"}, "bodies": {}}
EXAMPLES = Path(__file__).parents[1] / "examples"
MOVED = tomllib.loads((EXAMPLES / "warm_up.toml").read_text(encoding="utf-8"))
NEED = {"force": "2 kN", "feed": "15 m/min", "length": "1 m", "ends": "fixed-supported", "life": "20000 h"}
#: Seconds after which a server that was asked to end is killed.
LONGEST_END = 60.0
AXES = {"axial_load": "100:9000:20 N", "screw_speed": "1:900:20 rpm"}


@contextlib.contextmanager
def server(*options: str, errors: IO[str] | None = None) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """The process of a server, with options of Python and a file for its standard error, and its address."""
    program = [sys.executable, *options, "-m", "ballscrew.faces.cli", "serve", "--port", "0"]
    with subprocess.Popen(program, stdout=subprocess.PIPE, stderr=errors, encoding="utf-8") as process:
        assert process.stdout is not None
        line = process.stdout.readline()
        found = re.search(r"http://\S+", line)
        if found is None:
            sys.exit(f"the server does not start: {line}")
        try:
            yield process, found[0]
        finally:
            process.send_signal(signal.SIGINT)
            try:
                process.wait(LONGEST_END)
            except subprocess.TimeoutExpired:
                process.kill()


def memory_of(process: subprocess.Popen[str]) -> float:
    """What a process has of the memory, MB."""
    return psutil.Process(process.pid).memory_info().rss / 2**20


def case_number(i: int) -> dict[str, Any]:
    """A case that nobody has asked for before."""
    return {**CASE, "operation": {"axial_load": f"{1 + i % 9000} N", "screw_speed": f"{1 + i % 900}.{i} rpm"}}


def moved(i: int) -> dict[str, Any]:
    """A moving axis that nobody has asked for before."""
    mounted = {"unsupported_length": "1.2 m", "ends": "fixed-supported"}
    return {**MOVED, "installation": mounted, "axis": {**MOVED["axis"], "mass": f"{100 + i % 900} kg"}}


def requests(number: int) -> Iterator[tuple[str, Any, int]]:
    """Endless requests of all kinds, each with numbers of its own: address, body, and the status it should have."""
    for i in itertools.count(number, 1000):
        case = case_number(i)
        nut = {**NUT, "operation": case["operation"]}
        yield "run", {"case": case}, 200
        yield "sweep", {"case": case, "vary": AXES, "outputs": ["screw_torque"]}, 200
        yield "drawing", {"case": case}, 200
        yield "run", {"case": nut}, 200
        yield "compare", {"case": case}, 200
        yield "sweep", {"case": nut, "vary": {"axial_load": "1:9:9 kN"}, "outputs": ["rigidity"]}, 200
        yield "band", {"case": case, "samples": 512}, 200
        yield "check", {"case": case}, 200
        yield "duty", {"case": moved(i)}, 200
        yield "axis", {"case": moved(i)}, 200
        yield "warm-up", {"case": moved(i), "hours": 0.2}, 200
        yield "select", {"need": {**NEED, "force": f"{1000 + i % 9000} N"}, "words": "rexroth 32x10"}, 200
        yield "run", {"case": {**case, "screw": {"catalogue": f"no-such-{i}"}}}, 422
        yield "run", {"case": {**case, "screw": {**CASE["screw"], "lead": f"{i} m^{2 + i % 7}/s s"}}}, 422
        yield "sweep", {"case": case, "vary": {f"load{i}": "1:2:3 N"}}, 422
