"""Commands of the page on calibration with their output, figures and files, run as on a command line."""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path

from support import fork_server

ROOT = Path(__file__).parents[1]
EXAMPLES = "rig.toml", "rig_log.csv"
FIT = ["fit", "examples/rig_log.csv", "--case", "examples/rig.toml"]
BOTH = "boundary_friction_coefficient,constant_torque"
LIMITS = [
    "--limits", "axial_load=0.5:12 kN", "--limits", "screw_speed=5:1000 rpm", "--limits", "temperature=20:60 degC",
]  # fmt: skip
ROUGH = [*FIT, "--free", f"{BOTH},screw_roughness,nut_roughness", *LIMITS]
#: Commands by name, in order: later ones read files that earlier ones write.
COMMANDS = {
    "first": [*FIT, "--picture", "first.png"],
    "second": [*FIT, "--free", BOTH, *LIMITS, "--picture", "second.png", "-o", "rig-calibrated.toml"],
    "rough": ROUGH,
    "prior": [*ROUGH, "--set", "screw.nut_roughness=0.3 ± 0.05 um"],
    "run": ["run", "rig-calibrated.toml"],
    "band": ["run", "rig-calibrated.toml", "--band"],
    "sweep": ["sweep", "rig-calibrated.toml", "--output", "screw_torque"],
}
#: Commands of which the page shows only the fitted numbers and the next test.
SHORTENED = "rough", "prior"
WRITTEN = "first.png", "second.png", "rig-calibrated.toml"
WIDTH = "110"


def write(folder: Path) -> None:
    """Commands with their output as text, and the files that they write."""
    folder.mkdir(parents=True, exist_ok=True)
    place = Path(tempfile.mkdtemp())  # a TemporaryDirectory would be removed at the end of each fork
    try:
        _write(folder, place)
    finally:
        shutil.rmtree(place)


def _write(folder: Path, place: Path) -> None:
    (place / "examples").mkdir()
    for example in EXAMPLES:
        shutil.copy(ROOT / "examples" / example, place / "examples")
    for name, arguments in COMMANDS.items():
        output = _output("ballscrew.faces.cli", arguments, place)
        output = _shortened(output) if name in SHORTENED else output
        (folder / f"{name}.txt").write_text(f"$ {_typed(arguments)}\n{output}", encoding="utf-8")
    for name in WRITTEN:
        shutil.copy(place / name, folder)
    (folder / "python.txt").write_text(_output("calibration_example", [], place), encoding="utf-8")


def _output(module: str, arguments: list[str], place: Path) -> str:
    """What a program prints, run in a fork of this process; what it complains about is the last thing seen."""
    with tempfile.TemporaryFile() as output, Path(os.devnull).open("rb") as nothing:
        process = os.fork()
        if process == 0:
            asked = {
                "module": module,
                "arguments": arguments,
                "folder": str(place),
                "environment": {**os.environ, "COLUMNS": WIDTH},
                "errors": [],
                "lines": False,
            }
            fork_server.become(asked, [nothing.fileno(), output.fileno(), os.dup(2)])
        code = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
        if code:
            raise RuntimeError(f"{module} {' '.join(arguments)} ended with {code}")
        output.seek(0)
        return "\n".join(line.rstrip() for line in output.read().decode().splitlines()) + "\n"


def _shortened(output: str) -> str:
    before, scores, _ = output.partition("Error, root mean square")
    _, next_test, after = output.partition("next test:")
    assert scores
    assert next_test
    return f"{before}[…]\n\n{next_test}{after}"


def _typed(arguments: list[str]) -> str:
    """The command line, with long options on lines of their own."""
    words: list[str] = []
    for argument in arguments:
        name, equals, value = argument.partition("=")
        words.append(f'{name}="{value}"' if equals and " " in value else argument)
    lines = [f".venv/bin/ballscrew {words[0]} {words[1]}"]
    for word in words[2:]:
        if word.startswith("-") and len(lines[-1]) > 60:
            lines[-1] += " \\"
            lines.append(f"      {word}")
        else:
            lines[-1] += f" {word}"
    return "\n".join(lines)
