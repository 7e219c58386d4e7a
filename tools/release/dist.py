"""A wheel and a source distribution, built twice and checked: ``make dist``.

Leaves them in ``dist/``, and a list of their files in ``out/release/contents.txt``. Ends with exit code 1, and without
them, if anything is wrong:

- two builds differ by a byte, or the wheel of the source distribution is not that of the working tree;
- a file is missing, or one is there that git does not have or ``rules.toml`` does not allow;
- machine code differs from what its sources give when they are compiled again;
- the metadata are not those of ``pyproject.toml``, or ``twine check --strict`` finds fault;
- with ``--publish`` also: the tree differs from the last commit, or an address leads nowhere.
"""

from __future__ import annotations

import argparse
import ast
import hashlib
import os
import shutil
import subprocess
import sys
import tarfile
import tomllib
from collections import Counter
from pathlib import Path, PurePosixPath

import archives

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
WORK = ROOT / "out" / "release"


def main() -> int:
    """Build, check, list."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--to", type=Path, default=ROOT / "dist", help="where they go")
    parser.add_argument("--rebuilt", type=Path, default=ROOT / "out" / "interpreter", help="libraries built once more")
    parser.add_argument("--twine", default="", help="the command of twine")
    parser.add_argument("--publish", action="store_true", help="refuse also what must not be published")
    given = parser.parse_args()
    rules = tomllib.loads((HERE / "rules.toml").read_text(encoding="utf-8"))
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    tracked = git("ls-files", "-z").rstrip("\0").split("\0")
    environment = os.environ | {
        "SOURCE_DATE_EPOCH": os.environ.get("SOURCE_DATE_EPOCH") or git("log", "-1", "--format=%ct").strip()
    }
    shutil.rmtree(given.to, ignore_errors=True)
    built, again = WORK / "built", WORK / "again"
    paths = build(ROOT, built, environment)
    faults = [f"{name}: two builds differ" for name in differing(paths, build(ROOT, again, environment))]
    faults += [f"{name}: that of the source distribution differs" for name in of_sources(paths, environment)]

    wheel, sdist = (
        of(next(path for path in paths if path.name.endswith(end)))
        for of, end in ((archives.of_wheel, ".whl"), (archives.of_sdist, ".tar.gz"))
    )
    faults += archives.wheel_faults(wheel, tracked, rules["wheel"])
    faults += archives.sdist_faults(sdist, tracked, rules["sdist"])
    faults += archives.faults_of_libraries(wheel, rules["wheel"]["libraries"], given.rebuilt)
    version = version_of(ROOT / "src" / "ballscrew" / "basis" / "version.py")
    for archive in (wheel, sdist):
        faults += archives.metadata_faults(archive, project, version)
    for path, rule in zip(sorted(paths, key=lambda path: path.suffix), ("sdist", "wheel"), strict=True):
        if path.stat().st_size > (most := rules[rule]["largest_bytes"]):
            faults.append(f"{path.name}: {path.stat().st_size} bytes, more than {most}")
    if given.twine:
        done = subprocess.run(
            [*given.twine.split(), "check", "--strict", *paths], capture_output=True, text=True, check=False
        )
        faults += [f"twine: {done.stdout.strip()} {done.stderr.strip()}"] if done.returncode else []
    leads_nowhere = archives.nowhere(project["urls"])
    if given.publish:
        faults += [
            f"pyproject.toml: project.urls.{label} leads nowhere: name the home of the project"
            for label in leads_nowhere
        ]
        faults += [
            f"{line[3:]}: not as committed: commit it, or put it away"
            for line in git("status", "--porcelain").splitlines()
        ]
    WORK.joinpath("contents.txt").write_text(
        "".join(
            f"{len(content):>9} {archive.name} {path}\n"
            for archive in (wheel, sdist)
            for path, content in sorted(archive.files.items())
        ),
        encoding="utf-8",
    )
    if faults:
        print(*(f"dist: {fault}" for fault in faults), sep="\n", file=sys.stderr)
        return 1
    given.to.mkdir(parents=True)
    for path in paths:
        shutil.copyfile(path, given.to / path.name)
        print(f"{given.to.name}/{path.name}: {path.stat().st_size} bytes, sha256 {digest(path)}")
    for archive in (wheel, sdist):
        kinds = Counter(PurePosixPath(path).suffix or PurePosixPath(path).name for path in archive.files)
        print(
            f"{len(archive.files)} files, {sum(map(len, archive.files.values()))} bytes: "
            + ", ".join(f"{number} {kind}" for kind, number in kinds.most_common())
        )
    print(f"machine code, the same bytes when built again: {', '.join(rules['wheel']['libraries']['files'])}")
    print(
        f"twine check --strict: {'passes' if given.twine else 'not run'}; files: {WORK.relative_to(ROOT)}/contents.txt"
    )
    if leads_nowhere:
        print(f"not to be published: these addresses of pyproject.toml lead nowhere yet: {', '.join(leads_nowhere)}")
    return 0


def build(tree: Path, into: Path, environment: dict[str, str]) -> list[Path]:
    """A source distribution and a wheel of a tree, by the build backend that this environment has."""
    shutil.rmtree(into, ignore_errors=True)
    into.mkdir(parents=True)
    command = [sys.executable, "-m", "hatchling", "build", "--directory", into, "--target"]
    for target in ("sdist", "wheel"):
        done = subprocess.run(
            [*command, target], cwd=tree, env=environment, check=False, capture_output=True, text=True
        )
        if done.returncode:
            raise SystemExit(f"dist: the {target} of {tree} cannot be built:\n{done.stdout}{done.stderr}")
    return sorted(into.iterdir())


def of_sources(paths: list[Path], environment: dict[str, str]) -> list[str]:
    """The names of distributions that the unpacked source distribution gives with other bytes."""
    folder = WORK / "sources"
    shutil.rmtree(folder, ignore_errors=True)
    sdist = next(path for path in paths if path.name.endswith(".tar.gz"))
    with tarfile.open(sdist) as packed:
        packed.extractall(folder, filter="data")
    (tree,) = folder.iterdir()
    wheels = [path for path in build(tree, WORK / "of_sources", environment) if path.suffix == ".whl"]
    return differing([path for path in paths if path.suffix == ".whl"], wheels)


def differing(paths: list[Path], others: list[Path]) -> list[str]:
    """Names of files that are not the same in both folders."""
    one, other = ({path.name: digest(path) for path in each} for each in (paths, others))
    return sorted(name for name in one.keys() | other.keys() if one.get(name) != other.get(name))


def digest(path: Path) -> str:
    """The SHA-256 of a file."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def version_of(path: Path) -> str:
    """``__version__`` of a module, read without running it."""
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__version__":
            return ast.literal_eval(node.value)
    raise SystemExit(f"dist: {path}: has no __version__")


def git(*arguments: str) -> str:
    """The output of git here. A distribution is compared with what git has, so that a tree without it has none."""
    done = subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"dist: git {arguments[0]}: {done.stderr.strip()}: run it in a clone")
    return done.stdout


if __name__ == "__main__":
    sys.exit(main())
