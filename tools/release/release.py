"""A release as one commit and one tag: ``make release VERSION=0.2.0``, which only shows it; ``DO=1`` makes it.

The version changes in its one place (``basis/version.py``) and in ``CITATION.cff``, with the day; the heading of
"Unreleased" in ``CHANGELOG.md`` becomes that of the version, below an empty one. Nothing is pushed: the last line says
what to type for that.
"""

from __future__ import annotations

import argparse
import datetime
import difflib
import re
import subprocess
import sys
import tomllib
from collections.abc import Mapping
from pathlib import Path

import archives

ROOT = Path(__file__).parents[2]
VERSION_FILE, CHANGELOG, CITATION = "src/ballscrew/basis/version.py", "CHANGELOG.md", "CITATION.cff"
_VERSION = re.compile(r"(\d+)\.(\d+)\.(\d+)(?:(a|b|rc)(\d+))?")
_STAGES = ("a", "b", "rc", None)
_ASSIGNED = re.compile(r'^__version__ = "(?P<version>[^"]+)"$', re.MULTILINE)
_UNRELEASED = "## Unreleased\n"


class Refusal(Exception):
    """What keeps a release from being made: field, problem, value, remedy in one line."""


def main() -> int:
    """Check, show, and with ``--do`` commit and tag."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("version", help="such as 0.2.0, or 0.2.0rc1")
    parser.add_argument(
        "--day", default=datetime.datetime.now(datetime.UTC).date().isoformat(), help="the date, in UTC"
    )
    parser.add_argument("--do", action="store_true", help="write, commit and tag")
    parser.add_argument("--root", type=Path, default=ROOT, help="the clone")
    given = parser.parse_args()
    try:
        before = texts(given.root)
        after = released(before, given.version, given.day, source(given.root))
        problems = obstacles(given.root, given.version)
    except Refusal as refusal:
        print(f"release: {refusal}", file=sys.stderr)
        return 2
    for path, text in after.items():
        sys.stdout.writelines(
            difflib.unified_diff(
                before[path].splitlines(keepends=True), text.splitlines(keepends=True), path, path, n=1
            )
        )
    if problems:
        print(*(f"release: {problem}" for problem in problems), sep="\n", file=sys.stderr)
        return 2
    if not given.do:
        print(f"nothing was changed: make release VERSION={given.version} DO=1 commits and tags this")
        return 0
    for path, text in after.items():
        (given.root / path).write_text(text, encoding="utf-8")
    git(given.root, "commit", "--quiet", "--message", f"chore: release {given.version}", "--", *after)
    git(given.root, "tag", "--annotate", f"v{given.version}", "--message", f"ballscrew {given.version}")
    print(f"committed and tagged; to publish it: git push --atomic origin HEAD v{given.version}")
    return 0


def texts(root: Path) -> dict[str, str]:
    """The files that a release changes, as they are."""
    return {path: (root / path).read_text(encoding="utf-8") for path in (VERSION_FILE, CHANGELOG, CITATION)}


def source(root: Path) -> str:
    """The address of the sources, which ``CITATION.cff`` repeats."""
    return tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]["urls"]["Source"]


def released(before: Mapping[str, str], version: str, day: str, sources: str) -> dict[str, str]:
    """The same files for a version, its day and the address of its sources.

    Raises ``Refusal`` where they cannot be those of a release.
    """
    assigned = _ASSIGNED.search(before[VERSION_FILE])
    if assigned is None:
        raise Refusal(f'{VERSION_FILE}: has no line __version__ = "…"')
    if order(version) <= order(assigned["version"]):
        raise Refusal(f"VERSION: is not above that of the package ({version}, {assigned['version']}): name a later one")
    try:
        datetime.date.fromisoformat(day)
    except ValueError:
        raise Refusal(f"DAY: is no date ({day}): year-month-day") from None
    changes = before[CHANGELOG]
    if changes.count(_UNRELEASED) != 1:
        raise Refusal(f"{CHANGELOG}: needs one heading {_UNRELEASED.strip()!r}")
    below = changes.partition(_UNRELEASED)[2]
    if not re.match(r"\s*(?!## )\S", below):
        raise Refusal(f"{CHANGELOG}: nothing stands under {_UNRELEASED.strip()!r}: list what has changed")
    if re.search(rf"^## {re.escape(version)}\b", changes, re.MULTILINE):
        raise Refusal(f"{CHANGELOG}: has a heading of {version} already")
    citation, versions = re.subn(r"^version: .*$", f"version: {version}", before[CITATION], flags=re.MULTILINE)
    if versions != 1:
        raise Refusal(f"{CITATION}: needs one line 'version: …' ({versions} found)")
    undated = re.sub(r"^(date-released|repository-code): .*\n", "", citation, flags=re.MULTILINE)
    return {
        VERSION_FILE: _ASSIGNED.sub(f'__version__ = "{version}"', before[VERSION_FILE]),
        CHANGELOG: changes.replace(_UNRELEASED, f"{_UNRELEASED}\n## {version} ({day})\n"),
        CITATION: re.sub(
            r"^(version: .*\n)", rf"\1date-released: {day}\nrepository-code: {sources}\n", undated, flags=re.MULTILINE
        ),
    }


def order(version: str) -> tuple[int, ...]:
    """What versions are ordered by, a release above its candidates. Raises ``Refusal`` for what is none of ours."""
    found = _VERSION.fullmatch(version)
    if found is None:
        raise Refusal(f"VERSION: is no version ({version}): three numbers, as 0.2.0, or 0.2.0rc1 for a candidate")
    return (*map(int, found.groups()[:3]), _STAGES.index(found[4]), int(found[5] or 0))


def obstacles(root: Path, version: str) -> list[str]:
    """What must be settled first: a tree with changes, a tag of the name, addresses that lead nowhere."""
    found = [
        f"{line[3:]}: not as committed: commit it, or put it away"
        for line in git(root, "status", "--porcelain").splitlines()
    ]
    if git(root, "tag", "--list", f"v{version}").strip():
        found.append(f"v{version}: this tag exists: a version is released once")
    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    return found + [
        f"pyproject.toml: project.urls.{label} leads nowhere ({project['urls'][label]}): name the home of the project"
        for label in archives.nowhere(project["urls"])
    ]


def git(root: Path, *arguments: str) -> str:
    """The output of git in a clone. Raises ``Refusal`` with its message where it fails."""
    done = subprocess.run(["git", *arguments], cwd=root, capture_output=True, text=True, check=False)
    if done.returncode:
        raise Refusal(f"git {arguments[0]}: {done.stderr.strip() or done.stdout.strip()}")
    return done.stdout


if __name__ == "__main__":
    sys.exit(main())
