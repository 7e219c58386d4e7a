"""What a release refuses: contents, machine code and metadata of distributions; versions, changelogs and trees."""

import base64
import hashlib
import subprocess
import tomllib
import zipfile
from pathlib import Path

import pytest

from ballscrew.basis.version import __version__
from support.tools import tool

ROOT = Path(__file__).parents[2]
RULES = tomllib.loads((ROOT / "tools" / "release" / "rules.toml").read_text(encoding="utf-8"))
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
DAY = "2026-11-24"
HOME = "https://code.org/us/ballscrew"


@pytest.fixture(scope="module")
def archives():
    with tool("release", "archives") as (found,):
        yield found


@pytest.fixture(scope="module")
def release():
    with tool("release", "archives", "release") as (_, found):
        yield found


# -- distributions --------------------------------------------------------------------------------

LIBRARY = "ballscrew/data/exports/linux64/ballscrew.so"
SOURCE = "src/ballscrew/data/exports/linux64/ballscrew.so"
TRACKED = [
    "src/ballscrew/__init__.py", "src/ballscrew/py.typed", "src/ballscrew/data/mass.toml", SOURCE, "tests/test_mass.py"
]  # fmt: skip
RULE = RULES["wheel"] | {"needs": ["ballscrew/py.typed"], "licences": ["LICENSE"]}


def wheel(archives, tag="py3-none-any", **changes):
    """A wheel of the files above with their digests, as they are unless something is changed afterwards."""
    files = {
        "ballscrew/__init__.py": b"",
        "ballscrew/py.typed": b"",
        "ballscrew/data/mass.toml": b"mass = 1\n",
        LIBRARY: b"\x7fELF here GCC: (Debian 12.2.0) 12.2.0\0",
        "ballscrew-1.0.0.dist-info/METADATA": b"Metadata-Version: 2.4\nName: ballscrew\nVersion: 1.0.0\n\n",
        "ballscrew-1.0.0.dist-info/WHEEL": b"Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
        "ballscrew-1.0.0.dist-info/entry_points.txt": b"",
        "ballscrew-1.0.0.dist-info/licenses/LICENSE": b"MIT",
    } | {name: content for name, content in changes.items() if content is not None}
    files = {name: content for name, content in files.items() if changes.get(name, b"") is not None}
    record = "ballscrew-1.0.0.dist-info/RECORD"
    rows = [
        f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b'=').decode()},{len(content)}"
        for name, content in files.items()
    ]
    return archives.Archive(f"ballscrew-1.0.0-{tag}.whl", files | {record: "\n".join([*rows, f"{record},,"]).encode()})


def test_a_wheel_by_the_rules_has_no_faults(archives):
    assert archives.wheel_faults(wheel(archives), TRACKED, RULE) == []


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"ballscrew/out.toml": b""}, ["ballscrew/out.toml is in it and not expected"]),
        ({"tests/test_mass.py": b""}, ["tests/test_mass.py is in it and not expected"]),
        ({"ballscrew/data/mass.toml": None}, ["ballscrew/data/mass.toml is not in it"]),
        ({"ballscrew/py.typed": None}, ["py.typed is not in it", "ballscrew/py.typed, needed, is not in it"]),
        ({"ballscrew-1.0.0.dist-info/licenses/LICENSE": None}, ["licenses/LICENSE is not in it"]),
        ({"ballscrew/data/mass.toml": b"MZ\0"}, ["mass.toml is machine code that no rule names"]),
        ({LIBRARY: b"no library"}, [f"{LIBRARY} is no machine code"]),
        ({"ballscrew/a.exe": b""}, ["a.exe is in it and not expected", "a.exe has a suffix that no rule names (.exe)"]),
        (
            {"ballscrew-1.0.0.dist-info/WHEEL": b"Root-Is-Purelib: false\nTag: py3-none-any\n"},
            ["no line 'Root-Is-Purelib: true'"],
        ),
    ],
    ids=["untracked", "tests", "data", "typed", "licence", "machine-code", "library", "suffix", "purelib"],
)
def test_a_wheel_against_the_rules_is_refused(archives, changes, said):
    found = archives.wheel_faults(wheel(archives, **changes), TRACKED, RULE)
    assert len(found) == len(said)
    for fault, part in zip(found, said, strict=True):
        assert part in fault


def test_a_file_that_changed_after_its_digest_is_refused(archives):
    good = wheel(archives)
    changed = archives.Archive(good.name, {**good.files, "ballscrew/__init__.py": b"import os\n"})
    (fault,) = archives.wheel_faults(changed, TRACKED, RULE)
    assert "ballscrew/__init__.py has another digest or size" in fault


def test_a_wheel_of_one_platform_is_refused(archives):
    (fault,) = archives.wheel_faults(wheel(archives, tag="cp311-cp311-linux_x86_64"), TRACKED, RULE)
    assert "not tagged py3-none-any" in fault


def test_a_library_that_its_sources_do_not_give_is_named_with_both_compilers(archives, tmp_path):
    rule = RULES["wheel"]["libraries"] | {"files": ["linux64/ballscrew.so"]}
    (tmp_path / "linux64").mkdir()
    again = tmp_path / "linux64" / "ballscrew.so"
    again.write_bytes(wheel(archives).files[LIBRARY])
    assert archives.faults_of_libraries(wheel(archives), rule, tmp_path) == []
    again.write_bytes(b"\x7fELF there GCC: (Ubuntu 13.3.0) 13.3.0\0")
    (fault,) = archives.faults_of_libraries(wheel(archives), rule, tmp_path)
    assert fault == (
        f"{LIBRARY}: differs from what its sources give now (built by (Debian 12.2.0) 12.2.0, now by (Ubuntu 13.3.0) "
        "13.3.0): build with (Debian 12.2.0) 12.2.0"
    )
    again.write_bytes(b"\x7fELF here GCC: (Debian 12.2.0) 12.2.0\0\0")
    (fault,) = archives.faults_of_libraries(wheel(archives), rule, tmp_path)
    assert fault.endswith("make interpreter, and commit what it writes")
    again.unlink()
    (fault,) = archives.faults_of_libraries(wheel(archives), rule, tmp_path)
    assert f"{LIBRARY}: not built again" in fault


def test_a_source_distribution_has_what_git_has(archives):
    kept = {"pyproject.toml": b"", "tests/test_mass.py": b"", "PKG-INFO": b""}
    rule = RULES["sdist"] | {"needs": ["pyproject.toml"]}
    tracked = ["pyproject.toml", "tests/test_mass.py", ".github/workflows/test.yml", ".ci/run"]
    assert archives.sdist_faults(archives.Archive("a.tar.gz", kept), tracked, rule) == []
    more = archives.Archive("a.tar.gz", {**kept, ".ci/run": b"", "mine.txt": b""})
    assert [fault.split()[1] for fault in archives.sdist_faults(more, tracked, rule)] == [".ci/run", "mine.txt"]


def test_metadata_are_those_of_pyproject(archives):
    found = archives.metadata_faults(wheel(archives), PROJECT, "1.0.1")
    assert "ballscrew-1.0.0-py3-none-any.whl: Version is '1.0.0', not '1.0.1'" in found
    assert any("Project-URL: Source, " in fault and "is not in it" in fault for fault in found)
    assert not any(": Name is" in fault for fault in found)


def test_the_package_of_this_tree_obeys_the_rules(archives, tmp_path):
    # What is not installed here (digests, entry points) is the build's, and make dist looks at it.
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=False)
    if listed.returncode:
        pytest.skip("no clone")
    tracked = listed.stdout.splitlines()
    built = tmp_path / f"ballscrew-{__version__}-py3-none-any.whl"
    with zipfile.ZipFile(built, "w") as packed:
        for path in tracked:
            if path.startswith("src/ballscrew/"):
                packed.write(ROOT / path, path.removeprefix("src/"))
    found = archives.of_wheel(built)
    information = f"ballscrew-{__version__}.dist-info"
    packed = {f"{information}/{name}": b"" for name in ("METADATA", "entry_points.txt")}
    packed |= {f"{information}/licenses/{name}": b"" for name in RULES["wheel"]["licences"]}
    packed |= {f"{information}/WHEEL": b"Root-Is-Purelib: true\nTag: py3-none-any\n", f"{information}/RECORD": b""}
    whole = archives.Archive(found.name, {**found.files, **packed})
    faults = archives.wheel_faults(whole, tracked, RULES["wheel"])
    assert [fault for fault in faults if "RECORD" not in fault] == []
    assert sum(map(len, found.files.values())) < 4 * RULES["wheel"]["largest_bytes"]


@pytest.mark.parametrize(
    ("address", "leads_nowhere"),
    [
        ("https://ballscrew.example/docs", True),
        ("https://example.org", True),
        ("https://www.example.com/a", True),
        ("not an address", True),
        ("https://code.org/us/ballscrew", False),
        ("https://myexample.org", False),
    ],
)
def test_addresses_that_nobody_can_own(archives, address, leads_nowhere):
    assert archives.nowhere({"Source": address}) == (["Source"] if leads_nowhere else [])


# -- versions and changelogs ----------------------------------------------------------------------


@pytest.fixture
def before(release):
    return {
        release.VERSION_FILE: '"""Version."""\n\n__version__ = "0.1.0"\n',
        release.CHANGELOG: "# Changelog\n\n## Unreleased\n\n### Added\n\n- More.\n\n## 0.1.0\n\n- All.\n",
        release.CITATION: "cff-version: 1.2.0\nversion: 0.1.0\ndate-released: 2020-01-01\nlicense: MIT\n",
    }


def test_a_release_dates_the_changelog_and_names_its_version_everywhere(release, before):
    after = release.released(before, "0.2.0", DAY, HOME)
    assert after == {
        release.VERSION_FILE: '"""Version."""\n\n__version__ = "0.2.0"\n',
        release.CHANGELOG: (
            f"# Changelog\n\n## Unreleased\n\n## 0.2.0 ({DAY})\n\n### Added\n\n- More.\n\n## 0.1.0\n\n- All.\n"
        ),
        release.CITATION: (
            f"cff-version: 1.2.0\nversion: 0.2.0\ndate-released: {DAY}\nrepository-code: {HOME}\nlicense: MIT\n"
        ),
    }
    with pytest.raises(release.Refusal, match="nothing stands under"):  # two releases of the same changes
        release.released(after, "0.3.0", DAY, HOME)


@pytest.mark.parametrize(
    ("version", "day", "said"),
    [
        ("0.1.0", DAY, "not above"),
        ("0.0.9", DAY, "not above"),
        ("0.1.0rc1", DAY, "not above"),
        ("v0.2.0", DAY, "no version"),
        ("0.2", DAY, "no version"),
        ("0.2.0", "24.11.2026", "no date"),
    ],
)
def test_no_release(release, before, version, day, said):
    with pytest.raises(release.Refusal, match=said):
        release.released(before, version, day, HOME)


def test_candidates_come_before_their_release(release):
    ascending = ["0.1.0", "0.2.0a1", "0.2.0b1", "0.2.0rc1", "0.2.0rc2", "0.2.0", "0.2.1", "0.10.0", "1.0.0a1"]
    assert sorted(ascending[::2] + ascending[1::2], key=release.order) == ascending


@pytest.fixture
def clone(tmp_path, before):
    """A repository with what a release changes, all committed."""

    def git(*arguments):
        subprocess.run(["git", *arguments], cwd=tmp_path, check=True, capture_output=True)

    for path, text in before.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text, encoding="utf-8")
    (tmp_path / "pyproject.toml").write_text(f'[project.urls]\nSource = "{HOME}"\n', encoding="utf-8")
    git("init", "--quiet")
    git("config", "user.name", "Somebody")
    git("config", "user.email", "somebody@example.org")
    git("add", ".")
    git("commit", "--quiet", "--message", "start")
    return tmp_path


def release_of(release, monkeypatch, clone, *arguments):
    monkeypatch.setattr("sys.argv", ["release.py", *arguments, "--day", DAY, "--root", str(clone)])
    return release.main()


def git_in(clone, *arguments):
    return subprocess.run(["git", *arguments], cwd=clone, check=True, capture_output=True, text=True).stdout


def test_a_release_is_shown_until_it_is_asked_for(release, monkeypatch, clone, capsys, before):
    assert release_of(release, monkeypatch, clone, "0.2.0") == 0
    assert "+## 0.2.0" in capsys.readouterr().out
    assert git_in(clone, "status", "--porcelain") == git_in(clone, "tag") == ""
    assert release_of(release, monkeypatch, clone, "0.2.0", "--do") == 0
    assert git_in(clone, "log", "--format=%s", "-1").strip() == "chore: release 0.2.0"
    assert git_in(clone, "tag", "--points-at", "HEAD").strip() == "v0.2.0"
    assert git_in(clone, "status", "--porcelain") == ""
    assert set(git_in(clone, "show", "--name-only", "--format=").split()) == set(before)


def test_what_stands_in_the_way_of_a_release_is_named(release, monkeypatch, clone, capsys):
    git_in(clone, "tag", "v0.2.0")
    (clone / "pyproject.toml").write_text('[project.urls]\nSource = "https://git.example/us"\n', encoding="utf-8")
    assert release_of(release, monkeypatch, clone, "0.2.0", "--do") == 2
    said = capsys.readouterr().err.splitlines()
    assert [line.split(": ")[1] for line in said] == ["pyproject.toml", "v0.2.0", "pyproject.toml"]
    assert git_in(clone, "log", "--format=%s").split() == ["start"]
    assert 'version__ = "0.1.0"' in (clone / release.VERSION_FILE).read_text(encoding="utf-8")
