"""Rules that a wheel and a source distribution obey, each of which returns what breaks it, file by file."""

from __future__ import annotations

import base64
import csv
import email.parser
import hashlib
import io
import tarfile
import zipfile
from collections.abc import Iterable, Mapping
from email.message import Message
from pathlib import Path, PurePosixPath
from typing import Any, NamedTuple
from urllib.parse import urlsplit

#: First bytes of machine code: ELF, PE, Mach-O (32 and 64 bits, both orders of bytes, and universal), WebAssembly.
MACHINE_CODE = (
    b"\x7fELF", b"MZ", b"\xfe\xed\xfa\xce", b"\xfe\xed\xfa\xcf", b"\xce\xfa\xed\xfe", b"\xcf\xfa\xed\xfe",
    b"\xca\xfe\xba\xbe", b"\x00asm",
)  # fmt: skip
#: Names that nobody can own (RFC 2606, RFC 6761): an address below one of them leads nowhere.
RESERVED = (".example", ".invalid", ".test", ".localhost", ".example.com", ".example.org", ".example.net")


class Archive(NamedTuple):
    """A distribution: its name, and its files by path."""

    name: str
    files: Mapping[str, bytes]

    @property
    def metadata(self) -> Message:
        """Its core metadata."""
        (path,) = [
            path
            for path in self.files
            if path.endswith(".dist-info/METADATA") or (path == "PKG-INFO" and self.name.endswith(".tar.gz"))
        ]
        return email.parser.Parser().parsestr(self.files[path].decode())


def of_wheel(path: Path) -> Archive:
    """The files of a wheel."""
    with zipfile.ZipFile(path) as wheel:
        return Archive(path.name, {name: wheel.read(name) for name in wheel.namelist() if not name.endswith("/")})


def of_sdist(path: Path) -> Archive:
    """The files of a source distribution, without the folder that all of them are in."""
    found: dict[str, bytes] = {}
    with tarfile.open(path) as sdist:
        for member in sdist.getmembers():
            content = sdist.extractfile(member)
            if content is not None:
                found[member.name.partition("/")[2]] = content.read()
    return Archive(path.name, found)


def differences(found: Iterable[str], expected: Iterable[str], of: str) -> list[str]:
    """Paths that are in one of both alone."""
    found, expected = set(found), set(expected)
    return [f"{of}: {path} is in it and not expected" for path in sorted(found - expected)] + [
        f"{of}: {path} is not in it" for path in sorted(expected - found)
    ]


def wheel_faults(wheel: Archive, tracked: Iterable[str], rules: Mapping[str, Any]) -> list[str]:
    """What is wrong with the contents of a wheel, by the files that git has and the declared rule."""
    package = Path(rules["of"]).name
    information = f"{'-'.join(wheel.name.split('-')[:2])}.dist-info"
    expected = {
        *(
            f"{package}/{path.removeprefix(rules['of'] + '/')}"
            for path in tracked
            if path.startswith(rules["of"] + "/")
        ),
        *(f"{information}/{name}" for name in ("METADATA", "WHEEL", "RECORD", "entry_points.txt")),
        *(f"{information}/licenses/{name}" for name in rules["licences"]),
    }
    faults = differences(wheel.files, expected, wheel.name)
    faults += [f"{wheel.name}: {path}, needed, is not in it" for path in rules["needs"] if path not in wheel.files]
    libraries = {f"{rules['libraries']['in']}/{name}" for name in rules["libraries"]["files"]}
    for path, content in wheel.files.items():
        where = f"{wheel.name}: {path}"
        suffix, name = PurePosixPath(path).suffix, PurePosixPath(path).name
        if not path.startswith(information) and suffix not in rules["suffixes"] and name not in rules["without_suffix"]:
            faults.append(f"{where} has a suffix that no rule names ({suffix or 'none'})")
        if content.startswith(MACHINE_CODE) and path not in libraries:
            faults.append(f"{where} is machine code that no rule names")
    faults += [
        f"{wheel.name}: {path} is no machine code"
        for path in sorted(libraries & set(wheel.files))
        if not wheel.files[path].startswith(MACHINE_CODE)
    ]
    size = sum(map(len, wheel.files.values()))
    if size > rules["largest_bytes"] * 4:
        faults.append(f"{wheel.name}: {size} bytes unpacked, more than four times {rules['largest_bytes']}")
    return faults + record_faults(wheel) + tag_faults(wheel, rules["tag"])


def record_faults(wheel: Archive) -> list[str]:
    """Files whose digest or size is not the one that RECORD has."""
    (path,) = [path for path in wheel.files if path.endswith(".dist-info/RECORD")]
    rows = {row[0]: row[1:] for row in csv.reader(io.StringIO(wheel.files[path].decode()))}
    faults = differences(rows, wheel.files, path)
    for name, content in wheel.files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        if name != path and rows.get(name, []) != [f"sha256={digest}", str(len(content))]:
            faults.append(f"{path}: {name} has another digest or size")
    return faults


def tag_faults(wheel: Archive, tag: str) -> list[str]:
    """What contradicts the tag in the name of a wheel."""
    (path,) = [path for path in wheel.files if path.endswith(".dist-info/WHEEL")]
    lines = wheel.files[path].decode().splitlines()
    wanted = [f"Tag: {tag}", f"Root-Is-Purelib: {str(tag.endswith('-none-any')).lower()}"]
    faults = [f"{path}: no line {line!r}" for line in wanted if line not in lines]
    if not wheel.name.endswith(f"-{tag}.whl"):
        faults.append(f"{wheel.name}: not tagged {tag}")
    return faults


def sdist_faults(sdist: Archive, tracked: Iterable[str], rules: Mapping[str, Any]) -> list[str]:
    """What is wrong with the contents of a source distribution, by the files that git has and the declared rule."""
    kept = {path for path in tracked if not path.startswith(tuple(rules["leaves_out"]))}
    faults = differences(sdist.files, kept | {"PKG-INFO"}, sdist.name)
    return faults + [
        f"{sdist.name}: {path}, needed, is not in it" for path in rules["needs"] if path not in sdist.files
    ]


def faults_of_libraries(wheel: Archive, rules: Mapping[str, Any], rebuilt: Path) -> list[str]:
    """Libraries of a wheel that differ from those that ``rebuilt`` has, which were built again from the sources."""
    faults: list[str] = []
    for name in rules["files"]:
        path = f"{rules['in']}/{name}"
        again = rebuilt / name
        if path not in wheel.files:
            continue  # said by the rule of contents
        if not again.is_file():
            faults.append(f"{path}: not built again ({again} is not there): make dist does it")
        elif again.read_bytes() != wheel.files[path]:
            by, now = compiler(wheel.files[path]), compiler(again.read_bytes())
            remedy = f"build with {by}" if by != now else "make interpreter, and commit what it writes"
            faults.append(f"{path}: differs from what its sources give now (built by {by}, now by {now}): {remedy}")
    return faults


def compiler(library: bytes) -> str:
    """The compiler that a library names, or "zig" (which leaves none)."""
    at = library.find(b"GCC: ")
    return library[at + 5 : library.find(b"\0", at)].decode(errors="replace") if at >= 0 else "zig"


def metadata_faults(archive: Archive, project: Mapping[str, Any], version: str) -> list[str]:
    """What the metadata of a distribution lack, by the table ``[project]`` and the version of the package."""
    found, faults = archive.metadata, []
    expected = {
        "Name": project["name"],
        "Version": version,
        "Summary": project["description"],
        "Requires-Python": project["requires-python"],
        "License-Expression": project["license"],
        "Description-Content-Type": "text/markdown",
    }
    for field, value in expected.items():
        if found.get(field) != value:
            faults.append(f"{archive.name}: {field} is {found.get(field)!r}, not {value!r}")
    several = {
        "Classifier": project["classifiers"],
        "License-File": project["license-files"],
        "Project-URL": [f"{label}, {address}" for label, address in project["urls"].items()],
        "Provides-Extra": project["optional-dependencies"],
    }
    for field, values in several.items():
        faults += differences(found.get_all(field, []), values, f"{archive.name}, {field}")
    return faults


def nowhere(addresses: Mapping[str, str]) -> list[str]:
    """Addresses that lead nowhere, by their labels: their names are reserved, so that nobody can own them."""
    return [
        label
        for label, address in addresses.items()
        if f".{urlsplit(address).hostname or '.invalid'}".endswith(RESERVED)
    ]
