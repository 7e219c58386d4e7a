"""Commands that write, into places that are full, closed, taken or somebody else's.

Each command that writes, into a full disk, a file system that is read only, a folder whose name is a file's, a file
that is a folder, a link to nothing, a link to another file, and with a standard output that is full or closed; an older
file stands in the place.

*Wrong*: a message of several lines or none; a file that is half written, an older one that has changed, or one left
beside it; a file elsewhere that a link pointed at and that has changed.
"""

from __future__ import annotations

import dataclasses
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

from benchmarks.hostile import ROOT, workers
from benchmarks.hostile.tally import Outcome, Tally

SECONDS = 400.0

#: Seconds of one command, beside other work.
MOST_SECONDS = 120.0
OLD = b"an older file\n"
_EXAMPLES = ROOT / "examples"
#: Words of the command before the file, and the name of the file or folder that it writes.
COMMANDS: dict[str, tuple[list[str], str]] = {
    "sweep to csv": (["sweep", "olaru2005.toml", "--vary", "axial_load=100:4000:400 N", "--to"], "map.csv"),
    "sweep to xlsx": (["sweep", "olaru2005.toml", "--vary", "axial_load=100:4000:400 N", "--to"], "map.xlsx"),
    "sweep to nc": (["sweep", "olaru2005.toml", "--vary", "axial_load=100:4000:400 N", "--to"], "map.nc"),
    "sweep to zarr": (["sweep", "olaru2005.toml", "--vary", "axial_load=100:4000:400 N", "--to"], "map.zarr"),
    "duty to csv": (["duty", "vertical_axis.toml", "--to"], "cycle.csv"),
    "duty to svg": (["duty", "vertical_axis.toml", "--to"], "cycle.svg"),
    "report": (["report", "catalogue_screw.toml", "--to"], "report.html"),
    "hand-over": (["hand-over", "catalogue_screw.toml", "--to", "c", "--out"], "handed"),
    "compensation": (["compensation", "warm_up.toml", "--to", "sinumerik", "--out"], "comp.spf"),
    "warm-up": (["warm-up", "warm_up.toml", "--to"], "warm"),
}


@dataclasses.dataclass(frozen=True)
class Place:
    """A place to write into: how it is made, and what runs the command there."""

    name: str
    #: ``(folder, file)``; makes what stands there.
    make: Callable[[Path, Path], None] = lambda _folder, _file: None
    #: Lines of a shell before the command, with ``$FOLDER``.
    before: str = ""
    #: What the shell adds to the command.
    after: str = ""


def _old(_: Path, file: Path) -> None:
    if file.suffix:
        file.write_bytes(OLD)


def _file_for_folder(folder: Path, _: Path) -> None:
    folder.rmdir()
    folder.write_bytes(OLD)


def _folder_for_file(_: Path, file: Path) -> None:
    file.mkdir()
    (file / "kept.txt").write_bytes(OLD)


def _link_to_nothing(folder: Path, file: Path) -> None:
    file.symlink_to(folder.parent / "nowhere")


def _link_to_another(folder: Path, file: Path) -> None:
    (folder.parent / "thesis").write_bytes(OLD)
    file.symlink_to(folder.parent / "thesis")


#: A file system of its own over the folder, with what stands in it.
_MOUNTED = (
    'cp -a "$FOLDER" "$FOLDER.kept" && mount -t tmpfs -o size={size} none "$FOLDER" '
    '&& cp -a "$FOLDER.kept/." "$FOLDER" && rm -r "$FOLDER.kept"{more} || exit 99\n'
    'trap \'cp -a "$FOLDER/." "$FOLDER.after"\' EXIT; mkdir "$FOLDER.after"'
)
PLACES = (
    Place("a usual folder", _old),
    Place("a full disk", _old, _MOUNTED.format(size="16k", more="")),
    Place("a read-only file system", _old, _MOUNTED.format(size="1m", more=' && mount -o remount,ro none "$FOLDER"')),
    Place("a file for the folder", _file_for_folder),
    Place("a folder for the file", _folder_for_file),
    Place("a link to nothing", _link_to_nothing),
    Place("a link to another file", _link_to_another),
    Place("a full standard output", _old, after=" > /dev/full"),
    Place("a closed standard output", _old, after=" >&-"),
)
KINDS = [(command, place) for place in PLACES for command in COMMANDS]
COUNT = len(KINDS)


def can_mount() -> bool:
    """Whether a process may mount file systems of its own here."""
    command = ["unshare", "--user", "--map-root-user", "--mount", "mount", "-t", "tmpfs", "none", "/mnt"]
    try:
        return subprocess.run(command, capture_output=True, check=False).returncode == 0
    except OSError:
        return False


def run(tally: Tally, seed: int) -> None:
    """Try all places."""
    if not can_mount():
        tally.notes.append("No file systems of one's own here: no full disk and no read-only one was tried.")
    workers.run(attempt, tally, seed)


def _files(folder: Path) -> dict[str, bytes | str]:
    """What stands in a folder: files by content, links by target."""
    found: dict[str, bytes | str] = {}
    for path in folder.rglob("*"):
        if path.is_symlink():
            found[path.relative_to(folder).as_posix()] = str(path.readlink())
        elif path.is_file():
            found[path.relative_to(folder).as_posix()] = path.read_bytes()
    return found


def attempt(_: int, number: int, __: int) -> Outcome:
    """One command in one place."""
    name, place = KINDS[number % COUNT]
    words, file_name = COMMANDS[name]
    mounts = "mount" in place.before
    if mounts and not can_mount():
        return Outcome(refused=1)
    root = workers.folder() / str(number)
    folder = root / "folder"
    folder.mkdir(parents=True)
    file = folder / file_name
    place.make(folder, file)
    before = _files(root)
    program = f'cd "{_EXAMPLES}" && "{sys.executable}" -m ballscrew.faces.cli "$@"{place.after}'
    shell = ["sh", "-c", f"{place.before}\n{program}" if place.before else program, "sh", *words, str(file)]
    command = ["unshare", "--user", "--map-root-user", "--mount", *shell] if mounts else shell
    environment = {**os.environ, "FOLDER": str(folder)}
    try:
        done = subprocess.run(
            command, capture_output=True, check=False, env=environment, encoding="utf-8", timeout=MOST_SECONDS
        )
    except subprocess.TimeoutExpired:
        return Outcome(wrong=[f"{name}, {place.name}: silent for {MOST_SECONDS:g} s"])
    if mounts:
        after = root / "folder.after"
        shutil.rmtree(folder, ignore_errors=True)
        after.rename(folder)
    wrong = _wrong(done, before, _files(root), file.relative_to(root).as_posix(), can_write=bool(place.after))
    shutil.rmtree(root, ignore_errors=True)
    if wrong:
        return Outcome(wrong=[f"{name}, {place.name}: {'; '.join(wrong)}"])
    return Outcome(answered=int(done.returncode == 0), refused=int(done.returncode != 0))


def _wrong(
    done: subprocess.CompletedProcess[str],
    before: dict[str, bytes | str],
    after: dict[str, bytes | str],
    file: str,
    *,
    can_write: bool,
) -> list[str]:
    """Words on what a command has done wrong; where it ``can_write``, the file may be there before it is refused."""
    stopped = done.returncode == 1 and "stopped" in done.stderr and "Traceback" not in done.stderr
    found = [] if stopped else workers.faults_of_command(done.returncode, done.stderr)
    own = {name for name in {*before, *after} if name == file or name.startswith(f"{file}/")}
    elsewhere = {name for name in {*before, *after} - own if before.get(name) != after.get(name)}
    if elsewhere:
        found.append(f"left or changed beside it: {', '.join(sorted(elsewhere))}")
    if (
        done.returncode == 2
        and not can_write
        and {name: before.get(name) for name in own} != {name: after.get(name) for name in own}
    ):
        found.append(f"refused, and {', '.join(sorted(own))} changed")
    if done.returncode == 0 and not any(after.get(name) not in (None, b"", OLD) for name in own):
        found.append("accepted, and nothing written")
    return found
