"""The guard around heavy work: a process with limits on processor time and memory, whatever is asked for."""

import sys
import time
import tomllib

import psutil
import pytest

from .conftest import ROOT

pytestmark = pytest.mark.slow

NEED = {"force": "2 kN", "feed": "15 m/min", "length": "1 m", "ends": "fixed-supported", "life": "20000 h"}
#: Seconds of processor of a request here, and seconds that pass meanwhile on a busy machine.
LIMIT, PATIENCE = 2, 120
TIME, MEMORY = "server: stopped the work, which took too long", "server: stopped the work, which took too much memory"


def case_of(name):
    return tomllib.loads((ROOT / "examples" / f"{name}.toml").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def tables():
    """Cases that heavy work is asked for."""
    service = case_of("service")
    slow = {**service, "operation": {**service["operation"], "screw_speed": "6 rpm"}}
    light = {**slow, "nut": {**slow["nut"], "preload": "1 N"}}
    return {"slow": slow, "light": light, "elastic": case_of("catalogue_screw"), "warm": case_of("warm_up")}


#: Addresses with a case of those above, options that nobody can wait for, and what refuses them.
HEAVY = {
    "steps of contacts": ("reversal", "light", {}, TIME),
    "nuts": ("ripple", "slow", {"seeds": 1000}, TIME),
    "turns": ("ripple", "slow", {"turns": 1e300}, TIME),
    "balls in the return": ("ripple", "slow", {"return_balls": 10**9}, MEMORY),
    "places for balls": ("ripple", "slow", {"gap": 1e300}, TIME),
    "grooves": ("ripple", "slow", {"groove_deviation": "1 km"}, TIME),
    "a worn groove": ("ripple", "slow", {"fault": ["groove=1e9"]}, TIME),
    "a spall": ("ripple", "slow", {"fault": ["spall=1 mm x 1 m"]}, TIME),
    "transients": ("warm-up", "warm", {"band": True, "samples": 60_000}, TIME),
    "samples of all inputs": ("sensitivity", "elastic", {"samples": 65_536}, TIME),
    "samples of a band": ("band", "elastic", {"samples": 65_536}, TIME),
    "points": ("sweep", "elastic", {"vary": {"axial_load": "1:2:15000 N"}}, TIME),
    "samples of a report": ("report", "elastic", {"samples": 65_536}, TIME),
    "designs": ("optimise", None, {"need": NEED, "population": 100_000}, MEMORY),
    "generations": ("optimise", None, {"need": NEED, "generations": 100_000}, TIME),
    "choices": ("select", None, {"need": {**NEED, "preload": [f"{i} %" for i in range(1, 30)]}}, TIME),
}


@pytest.fixture(scope="module")
def limited(commands):
    from .conftest import Server

    server = Server(commands, "--time-limit", str(LIMIT))
    yield server
    assert server.end() == (0, "")


@pytest.mark.skipif(sys.platform != "linux", reason="other systems limit no memory")
@pytest.mark.parametrize("name", HEAVY)
def test_what_nobody_can_wait_for_is_stopped(limited, tables, name):
    """Within its limits, with the command to use instead; the server goes on, and nothing of the work is left."""
    address, case, options, words = HEAVY[name]
    start = time.monotonic()
    body = {**options, **({} if case is None else {"case": tables[case]})}
    refusal = limited.post(address, body)
    assert time.monotonic() - start < PATIENCE
    assert refusal.status_code == 422
    # on a busy machine the time may be over before the memory is full
    assert refusal.json()["lines"][0].startswith((words, TIME))
    assert refusal.json()["faults"][0]["remedy"].endswith(f"use ballscrew {address}")
    assert limited.post("run", {"case": tables["elastic"]}).status_code == 200
    (forks,) = psutil.Process(limited.process.pid).children()
    end = time.monotonic() + PATIENCE
    while forks.children():
        assert time.monotonic() < end
        time.sleep(0.05)
    assert limited.memory < 500
