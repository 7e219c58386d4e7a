"""The wheel of ``dist/`` installed into empty environments, and tried there: ``make trials``.

Wheels only (``--no-build``), and commands run without a compiler on PATH. An environment has no extra, or one, or all
of them; its packages are those of ``constraints.txt``, those of ``floors.txt``, or the newest. Without an extra, the
commands that need none must end well, and one of each extra with exit code 2 and a line that names the extra. With
extras, what they are for must end well. The table goes to standard output and to ``out/release/trials.md``; exit code 1
if anything is otherwise.
"""

from __future__ import annotations

import argparse
import contextlib
import re
import shutil
import subprocess
import sys
import time
import urllib.request
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]
WORK = ROOT / "out" / "release" / "trials"
EXAMPLES = ROOT / "examples"
PYTHONS = ("3.11", "3.12", "3.13", "3.14")
ALL = ("calibrate", "cluster", "data", "fast", "jax", "optimise", "report", "web")
#: The versions that the oldest packages have wheels for: for later ones they would be compiled.
WITH_OLDEST = ("3.11", "3.12")
#: The extras that floors.txt has the oldest versions of.
WITH_FLOORS = ("calibrate", "cluster", "data", "fast", "report", "web")
SET_OF = {"pinned": "constraints.txt", "oldest": "floors.txt"}
_SWEEP = ("sweep", "{case}", "--vary", "axial_load=1000:4000:3 N")
_BY_JAX = """
import math, ballscrew as bs
screw = bs.BallScrew(pitch_circle_diameter=0.04, lead=0.005, ball_diameter=3.175e-3, loaded_balls=56,
                     contact_angle=math.pi / 4, screw_conformity=0.515, nut_conformity=0.515)
oil = bs.Lubricant.from_grade("ISO VG 100", temperature=313.15)
bs.derivatives(bs.FrictionModel.corrected(), screw, oil, by=["axial_load"], method="jax",
               axial_load=4000.0, screw_speed=60.0)
"""
_POSTERIOR = """
import pathlib
from ballscrew.cases.case_files import case_file
from ballscrew.files.torque_logs import reading
import ballscrew as bs
folder = pathlib.Path({examples!r})
case, log = case_file.load(folder / "rig.toml"), reading.read(folder / "rig_log.csv")
free = ["boundary_friction_coefficient", "constant_torque"]
bs.fit(case.model, case.screw, case.lubricant, log, free).posterior(steps=20)
"""
#: Of Python, a refusal ends a script as it ends a command.
_REFUSAL = """
import sys, ballscrew as bs
try:
    exec(sys.argv[1])
except bs.InputError as error:
    print(error, file=sys.stderr)
    sys.exit(2)
"""


class Trial(NamedTuple):
    """An environment: version of Python, extras, and which versions of packages."""

    python: str
    extras: tuple[str, ...]
    packages: str

    @property
    def name(self) -> str:
        """What it is called in the table."""
        return f"{self.python}, {' '.join(self.extras) or 'no extra'}, {self.packages}"


class Probe(NamedTuple):
    """A command that needs one of these extras, or none; of several, each has what it needs."""

    extras: tuple[str, ...]
    command: tuple[str, ...]
    #: The program of the environment.
    program: str = "ballscrew"
    #: Extras that it may name, too: what it needs first.
    first: tuple[str, ...] = ()


PROBES = {
    "version": Probe((), ("--version",)),
    "run": Probe((), ("run", "{case}")),
    "check": Probe((), ("check", "rexroth-40x10x6-6-double", "--axial-load", "7 kN", "--preload", "7 %")),
    "sweep to .csv": Probe((), (*_SWEEP, "--to", "{out}/map.csv")),
    "picture": Probe((), ("compare", "{case}", "--to", "{out}/spread.png")),
    "hand-over": Probe((), ("hand-over", "{case}", "--to", "c", "--out", "{out}/c")),
    "sweep to .xlsx": Probe(("data",), (*_SWEEP, "--to", "{out}/map.xlsx")),
    "sweep to .nc": Probe(("data",), (*_SWEEP, "--to", "{out}/map.nc")),
    "sweep to .zarr": Probe(("data", "cluster"), (*_SWEEP, "--to", "{out}/map.zarr")),
    "sweep on a cluster": Probe(
        ("cluster",), (*_SWEEP, "--to", "{out}/c.zarr", "--scheduler", "tcp://127.0.0.1:9"), first=("data",)
    ),
    "report": Probe(("report", "web"), ("report", "{case}", "--to", "{out}/report.pdf")),
    "optimise": Probe(
        ("optimise",),
        ("optimise", "{needs}/feed_axis.toml", "--population", "8", "--generations", "2", "--members", "2"),
    ),
    "site": Probe(("fast",), ("site", "{out}/site", "--model", "olaru2005", "--nut", "row")),
    "serve": Probe(("web",), ("serve", "--port", "0")),
    "derivatives by JAX": Probe(("jax",), ("-c", _REFUSAL, _BY_JAX), "python"),
    "posterior of a fit": Probe(("calibrate",), ("-c", _REFUSAL, _POSTERIOR), "python"),
}


def trials(pythons: Sequence[str], only: str) -> list[Trial]:
    """No extra and all of them for every Python; each alone, for the first."""
    none = [Trial(python, (), packages) for python in pythons for packages in ("pinned", "newest")]
    each = [Trial(pythons[0], (extra,), "pinned") for extra in ALL]
    together = [Trial(python, ALL, packages) for python in pythons for packages in ("pinned", "newest")]
    together += [Trial(python, WITH_FLOORS, "oldest") for python in pythons if python in WITH_OLDEST]
    return {"none": none, "each": each, "together": together, "": [*none, *each, *together]}[only]


def install(uv: str, wheel: Path, trial: Trial) -> tuple[Path, str]:
    """The environment of a trial, and what went wrong, if anything."""
    place = WORK / re.sub(r"\W+", "-", trial.name)
    done = run([uv, "venv", "--quiet", "--clear", "--no-python-downloads", "--python", trial.python, place])
    if done.returncode:
        return place, "no such Python here"
    named = f"ballscrew[{','.join(trial.extras)}] @ {wheel.as_uri()}" if trial.extras else str(wheel)
    command = [uv, "pip", "install", "--quiet", "--no-build", "--python", place / "bin" / "python", named]
    if trial.packages in SET_OF:
        command += ["--constraint", without_hashes(ROOT / SET_OF[trial.packages])]
    done = run(command)
    return place, " ".join(done.stderr.split())[-300:] if done.returncode else ""


def without_hashes(path: Path) -> Path:
    """The same versions without their hashes, with which nothing could be installed that is not in the file."""
    text = re.sub(r" \\\n\s+--hash=\S+", "", path.read_text(encoding="utf-8"))
    WORK.mkdir(parents=True, exist_ok=True)
    (WORK / path.name).write_text(text, encoding="utf-8")
    return WORK / path.name


def tried(place: Path, trial: Trial) -> dict[str, str]:
    """What each command did: ``works``, ``says what to install``, or what it did in place of these."""
    out = place / "tried"
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    # nothing but the environment: no compiler, no other Python, no home
    environment = {
        "PATH": str(place / "bin"),
        "HOME": str(out),
        "MPLCONFIGDIR": str(out),
        "NO_COLOR": "1",
        "COLUMNS": "200",
    }
    found: dict[str, str] = {}
    for name, probe in PROBES.items():
        if trial.extras and name != "run" and not set(probe.extras) & set(trial.extras):
            continue  # what needs no extra, and what is refused, is tried where there is none
        names = {
            "case": EXAMPLES / "feed_drive.toml",
            "needs": EXAMPLES / "needs",
            "out": out,
            "examples": str(EXAMPLES),
        }
        parts = [part.format(**names) for part in probe.command]
        has = not probe.extras or bool(set(probe.extras) & set(trial.extras))
        command = [place / "bin" / probe.program, *parts]
        code, said = served(command, environment) if name == "serve" and has else ended(command, environment)
        remedies = [f"ballscrew[{extra}]" for extra in (*probe.extras, *probe.first)]
        if name == "sweep on a cluster" and has:  # nobody listens there: it must say that, and nothing of an extra
            good = code == 2 and "ballscrew[" not in said
            found[name] = "works" if good else f"{code}: {said}"
        elif has:
            found[name] = "works" if code == 0 else f"{code}: {said}"
        else:
            good = code == 2 and any(remedy in said for remedy in remedies) and "Traceback" not in said
            found[name] = "says what to install" if good else f"{code}: {said}"
    return found


def ended(command: Sequence[str | Path], environment: Mapping[str, str]) -> tuple[int, str]:
    """The exit code of a command, and what it said last on standard error."""
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=600)
    return done.returncode, done.stderr.strip()[-300:]


def served(command: Sequence[str | Path], environment: Mapping[str, str]) -> tuple[int, str]:
    """Zero if the server says where it is, and has its page there."""
    with subprocess.Popen(
        command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as server:
        assert server.stdout is not None
        assert server.stderr is not None
        try:
            address = re.search(r"http://\S+", server.stdout.readline())
            if address is None:
                return 1, server.stderr.read()[-300:]
            with contextlib.closing(urllib.request.urlopen(f"{address[0]}/api/v1/catalogue", timeout=60)) as answer:
                return (0, "") if answer.status == 200 else (1, str(answer.status))
        finally:
            server.terminate()


def run(command: Sequence[str | Path]) -> subprocess.CompletedProcess[str]:
    """A command that may fail."""
    return subprocess.run(command, capture_output=True, text=True, check=False)


def main() -> int:
    """Try all, print the table."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--uv", default="uv")
    parser.add_argument("--only", choices=("none", "each", "together"), default="", help="which extras, of all trials")
    parser.add_argument("--python", action="append", choices=PYTHONS, help="one version alone; may be repeated")
    given = parser.parse_args()
    wheels = sorted((ROOT / "dist").glob("*.whl"))
    if len(wheels) != 1:
        print(f"trials: dist/: needs one wheel ({len(wheels)} there): make dist", file=sys.stderr)
        return 2
    uv = shutil.which(given.uv) or shutil.which(ROOT / given.uv)
    if uv is None:
        print(f"trials: --uv: no program {given.uv}: make trials, which gets one, or --uv PATH", file=sys.stderr)
        return 2
    lines = [
        "| environment | seconds to install | commands that work | that say what to install | otherwise |",
        "|---|---|---|---|---|",
    ]
    print(*lines, sep="\n", flush=True)
    wrong = 0
    for trial in trials(given.python or PYTHONS, given.only):
        start = time.monotonic()
        place, problem = install(uv, wheels[0], trial)
        seconds = time.monotonic() - start
        if problem:
            wrong += problem != "no such Python here"
            lines.append(f"| {trial.name} | | | | {problem} |")
        else:
            found = tried(place, trial)
            others = {name: did for name, did in found.items() if did not in ("works", "says what to install")}
            wrong += bool(others)
            counts = [sum(did == wanted for did in found.values()) for wanted in ("works", "says what to install")]
            said = "; ".join(f"{name}: {' '.join(did.split())}" for name, did in others.items())
            lines.append(f"| {trial.name} | {seconds:.0f} | {counts[0]} | {counts[1]} | {said} |")
        shutil.rmtree(place, ignore_errors=True)
        print(lines[-1], flush=True)
    (WORK.parent / "trials.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
