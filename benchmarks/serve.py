"""How the server does under load: 50 users at once, once with requests of all kinds, mixed load, the slowest requests.

python benchmarks/serve.py                  # 50 users, 50 users with all kinds of requests, 60 s of mixed load
python benchmarks/serve.py --seconds 300    # the same, for 300 s
python benchmarks/serve.py --limits         # the slowest request of each kind that is not refused
"""

import argparse
import concurrent.futures
import itertools
import json
import re
import signal
import statistics
import subprocess
import sys
import time
import tomllib
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any

import httpx
import psutil

USERS = 50
CASE = {
    "screw": {"catalogue": "rexroth-40x10x6-6-double"},
    "lubricant": {"grade": "ISO VG 100", "temperature": "40 degC"},
    "operation": {"axial_load": "7 kN", "screw_speed": "600 rpm"},
}
NUT = {**CASE, "nut": {"preload": "7 %"}, "bodies": {}}
EXAMPLES = Path(__file__).parents[1] / "examples"
MOVED = tomllib.loads((EXAMPLES / "warm_up.toml").read_text(encoding="utf-8"))
SERVICE = tomllib.loads((EXAMPLES / "service.toml").read_text(encoding="utf-8"))
OWN_NUT = {
    "d0": "40 mm", "lead": "10 mm", "turns": "5", "Ca": "52 kN", "pitch_circle_diameter": "41 mm",
    "root_diameter": "36 mm", "preload": "5 %", "nut": "double",
}  # fmt: skip
NEED = {"force": "2 kN", "feed": "15 m/min", "length": "1 m", "ends": "fixed-supported", "life": "20000 h"}
#: Requests after which the kinds come again.
KINDS = 15
#: Seconds after which a user asks again whom the server has told that it has too much to do.
AGAIN = 0.5
AXES = {"axial_load": "100:9000:20 N", "screw_speed": "1:900:20 rpm"}


def started(*options: str, errors: IO[str] | None = None) -> tuple[subprocess.Popen[str], str]:
    """The process of a server, with options of Python and a file for its standard error, and its address."""
    program = [sys.executable, *options, "-m", "ballscrew.faces.cli", "serve", "--port", "0"]
    process = subprocess.Popen(program, stdout=subprocess.PIPE, stderr=errors, encoding="utf-8")
    assert process.stdout is not None
    line = process.stdout.readline()
    found = re.search(r"http://\S+", line)
    if found is None:
        sys.exit(f"the server does not start: {line}")
    return process, found[0]


def memory_of(process: subprocess.Popen[str]) -> float:
    """What a process has of the memory, MB."""
    return psutil.Process(process.pid).memory_info().rss / 2**20


def case_number(i: int) -> dict[str, Any]:
    """A case that nobody has asked for before."""
    return {**CASE, "operation": {"axial_load": f"{1 + i % 9000} N", "screw_speed": f"{1 + i % 900}.{i} rpm"}}


def moved(i: int) -> dict[str, Any]:
    """A moving axis that nobody has asked for before."""
    mounted = {"unsupported_length": "1 m", "ends": "fixed-supported"}
    return {**MOVED, "installation": mounted, "axis": {**MOVED["axis"], "mass": f"{100 + i % 900} kg"}}


def crowd(address: str, users: int = USERS, each: int = 10) -> tuple[list[float], Counter[int]]:
    """So many users at once, each with some requests one after the other: seconds by request, and statuses."""
    seconds: list[float] = []
    statuses: Counter[int] = Counter()

    def user(number: int) -> None:
        with httpx.Client(base_url=address, timeout=60, trust_env=False) as client:
            for i in range(each):
                before = time.perf_counter()
                answer = client.post("/api/v1/run", json={"case": case_number(number * each + i)})
                seconds.append(time.perf_counter() - before)
                statuses[answer.status_code] += 1

    with concurrent.futures.ThreadPoolExecutor(users) as pool:
        list(pool.map(user, range(users)))
    return seconds, statuses


def crowd_of_all(
    address: str, users: int = USERS, each: int = KINDS
) -> tuple[dict[str, list[float]], Counter[tuple[str, int]]]:
    """So many users at once who ask for everything: seconds by address, waiting and asking again among them."""
    seconds: dict[str, list[float]] = defaultdict(list)
    wrong: Counter[tuple[str, int]] = Counter()

    def user(number: int) -> None:
        with httpx.Client(base_url=address, timeout=300, trust_env=False) as client:
            asked = requests(number)
            for path, body, status in itertools.islice(asked, number % KINDS, number % KINDS + each):
                before = time.perf_counter()
                while (
                    answer := client.post(f"/api/v1/{path}", json=body)
                ).status_code == httpx.codes.TOO_MANY_REQUESTS:
                    time.sleep(AGAIN)
                seconds[path].append(time.perf_counter() - before)
                if answer.status_code != status:
                    wrong[path, answer.status_code] += 1

    with concurrent.futures.ThreadPoolExecutor(users) as pool:
        list(pool.map(user, range(users)))
    return seconds, wrong


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


def mixed(
    process: subprocess.Popen[str], address: str, seconds: float, users: int = 4, every: float = 5.0
) -> tuple[list[tuple[float, float]], Counter[tuple[str, int]], Counter[str]]:
    """Mixed load for so long: (seconds, MB) every few seconds, and answers that are not what they should be."""
    end = time.monotonic() + seconds
    wrong: Counter[tuple[str, int]] = Counter()
    counts: Counter[str] = Counter()

    def user(number: int) -> None:
        with httpx.Client(base_url=address, timeout=60, trust_env=False) as client:
            for path, body, status in requests(number):
                if time.monotonic() > end:
                    return
                answer = client.post(f"/api/v1/{path}", json=body)
                counts[path] += 1
                if answer.status_code != status:
                    wrong[path, answer.status_code] += 1

    begun = time.monotonic()
    memory: list[tuple[float, float]] = []
    with concurrent.futures.ThreadPoolExecutor(users) as pool:
        running = [pool.submit(user, number) for number in range(users)]
        while time.monotonic() < end:
            time.sleep(min(every, max(0.0, end - time.monotonic())))
            memory.append((time.monotonic() - begun, memory_of(process)))
        for one in running:
            one.result()
    return memory, wrong, counts


def slowest(address: str) -> Iterator[tuple[str, str, int, float]]:
    """Seconds of the slowest requests that are let through, alone."""
    from ballscrew.faces.web.bodies import MOST_BALLS
    from ballscrew.faces.web.limits import MOST_POINTS, MOST_SAMPLES, USUAL_BALLS_IN_ALL
    from ballscrew.questions.condition.question import MOST_LOGS

    deviations = {"ball_diameter": "2 um", "lead": "3 um"}
    ball = {**CASE, "model": {"name": "reference"}}
    two = ["screw_torque", "efficiency"]
    rigid = {**CASE, "nut": {"preload": "7 %"}}
    many = {**CASE["screw"], "loaded_balls": MOST_BALLS}
    double = {**NUT, "screw": many, "deviations": deviations}
    oversize = {**double, "nut": {"type": "oversize-balls", "preload": "3 kN"}}
    log = (EXAMPLES / "nut_new.csv").read_text(encoding="utf-8")
    logs = [{"name": f"{i}.csv", "text": f"{log}\n# {i}\n"} for i in range(MOST_LOGS)]
    points = {"two nuts": USUAL_BALLS_IN_ALL // (2 * MOST_BALLS), "oversize": USUAL_BALLS_IN_ALL // (3 * MOST_BALLS)}
    asked = [
        ("run", f"{2 * MOST_BALLS} balls one by one", {"case": double}),
        ("sweep", f"{MOST_POINTS} points",
         {"case": ball, "vary": {"axial_load": f"1:9000:{MOST_POINTS} N"}, "outputs": two}),
        ("sweep", "2000 points, nut",
         {"case": rigid, "vary": {"axial_load": "1:9000:2000 N"}}),
        ("sweep", f"{USUAL_BALLS_IN_ALL} balls, two nuts",
         {"case": double, "vary": {"axial_load": f"1:9000:{points['two nuts']} N"}}),
        ("sweep", f"{USUAL_BALLS_IN_ALL} balls, oversize",
         {"case": oversize, "vary": {"axial_load": f"1:9000:{points['oversize']} N"}}),
        ("compare", "two nuts", {"case": double}),
        ("compare", "oversize", {"case": oversize}),
        ("band", f"{MOST_SAMPLES} samples", {"case": ball, "samples": MOST_SAMPLES}),
        ("band", f"{USUAL_BALLS_IN_ALL} balls, two nuts", {"case": double, "samples": points["two nuts"]}),
        ("band", f"{USUAL_BALLS_IN_ALL} balls, oversize", {"case": oversize, "samples": points["oversize"]}),
        ("report", "a ball", {"case": ball}),
        ("report", f"{USUAL_BALLS_IN_ALL} balls, two nuts", {"case": double}),
        ("axis", "a moving axis", {"case": moved(0)}),
        ("own-nut", "all numbers", {"numbers": OWN_NUT}),
        ("condition", f"{MOST_LOGS} logs", {"case": SERVICE, "tests": logs, "keep_going": True}),
    ]  # fmt: skip
    with httpx.Client(base_url=address, timeout=60, trust_env=False) as client:
        for what, case, samples in (("a ball", ball, 65_536), ("two nuts", double, 128)):
            asked.append(("sensitivity", f"{what}, {samples} samples", {"case": case, "samples": samples}))
        for path, what, body in asked:
            before = time.perf_counter()
            answer = client.post(f"/api/v1/{path}", json=body)
            yield path, what, answer.status_code, time.perf_counter() - before
        body = {"need": NEED, "generations": 200}
        before = time.perf_counter()
        status = as_job(client, "optimise", body)
        yield "optimise", f"{body['generations']} generations, a job", status, time.perf_counter() - before


def as_job(client: httpx.Client, path: str, body: dict[str, Any]) -> int:
    """The status of the answer of a job, once it has ended."""
    started = client.post(f"/api/v1/jobs/{path}", json=body).json()["id"]
    while client.get(f"/api/v1/jobs/{started}", params={"wait": 30}).json()["state"] in ("waiting", "running"):
        pass
    return client.get(f"/api/v1/jobs/{started}/answer").status_code


def main() -> None:
    """Run what is asked for, and print a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--limits", action="store_true")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    process, address = started()
    try:
        if options.limits:
            for path, what, status, seconds in slowest(address):
                print(f"{path:11} {what:32} {status} {seconds:6.2f} s")
            return
        seconds, statuses = crowd(address)
        shares = statistics.quantiles(seconds, n=20)
        print(f"{USERS} users, {len(seconds)} requests: {dict(statuses)}")
        print(f"  median {1000 * statistics.median(seconds):.0f} ms, 95 % {1000 * shares[-1]:.0f} ms")
        by_address, wrong_ones = crowd_of_all(address)
        print(f"{USERS} users who ask for everything; not as it should be: {dict(wrong_ones) or 'none'}")
        for path, times in sorted(by_address.items()):
            print(
                f"  {path:8} {len(times):4} times: median {statistics.median(times):6.2f} s, most {max(times):6.2f} s"
            )
        memory, wrong, counts = mixed(process, address, options.seconds)
        print(f"mixed load for {options.seconds:g} s: {dict(counts)}; not as they should be: {dict(wrong) or 'none'}")
        print("\n".join(f"  {at:6.0f} s {mb:8.1f} MB" for at, mb in memory))
        if options.json:
            options.json.write_text(json.dumps({"seconds": seconds, "memory": memory}))
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(20)


if __name__ == "__main__":
    main()
