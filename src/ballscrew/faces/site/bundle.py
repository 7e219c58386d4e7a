"""The files of the page as one script and one document, so that they run from a folder of files, too.

A browser loads no module of JavaScript from ``file://``. The modules of the page are therefore written one after the
other into one function, in the order in which they import each other. They may import by name, from each other, and
nothing else; names at the top are unique.
"""

from __future__ import annotations

import base64
import functools
import hashlib
import re
from collections.abc import Sequence
from importlib import resources

_ENTRY = "main.js"
#: Modules that the page of the server has too, and that stand there.
_SHARED = ("engine.js", "part_search.js")
#: The script that computes bands beside the page.
_WORKER = "band_worker.js"
_IMPORT = re.compile(r'^import \{[^}]*\} from "(?:\./|\.\./\.\./web/page/)([\w.]+)";\n', re.MULTILINE)
_EXPORT = re.compile(r"^export (?=const |let |function\*? |async function |class )", re.MULTILINE)
#: What no file of the page may have at its top, as the files become one.
_ELSEWISE = re.compile(r"^(?:import|export)\b", re.MULTILINE)


@functools.cache
def text_of(name: str) -> str:
    """A file of the page."""
    room = "web" if name in _SHARED else "site"
    return resources.files(f"ballscrew.faces.{room}").joinpath("page", name).read_text(encoding="utf-8")


@functools.cache
def script() -> str:
    """The modules of the page as one script."""
    return _joined(modules())


@functools.cache
def worker() -> str:
    """The script of the worker that computes bands, with the modules that it needs."""
    return _joined(_in_order(_WORKER))


def _joined(names: Sequence[str]) -> str:
    return '"use strict";\n(() => {\n' + "\n".join(map(_plain, names)) + "\n})();\n"


def modules() -> list[str]:
    """The modules of the page, each after those that it imports."""
    return _in_order(_ENTRY)


def hash_of(text: str) -> str:
    """The hash by which a Content-Security-Policy allows a script or a style in the document."""
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def policy(scripts: Sequence[str] = (), styles: Sequence[str] = ()) -> str:
    """The Content-Security-Policy of the page: its own files, or scripts and styles in the document, and modules."""
    of_scripts = " ".join(map(hash_of, scripts)) if scripts else "'self'"
    of_styles = " ".join(map(hash_of, styles)) if styles else "'self'"
    return (
        f"default-src 'none'; script-src {of_scripts} 'wasm-unsafe-eval'; style-src {of_styles}; img-src 'self' data:; "
        "connect-src 'self'; manifest-src 'self'; worker-src 'self'; base-uri 'none'; form-action 'none'"
    )


def _in_order(name: str, above: tuple[str, ...] = ()) -> list[str]:
    """A module after those that it imports. Raises :class:`ValueError` where they import each other in a circle."""
    if name in above:
        raise ValueError(f"the page imports in a circle: {' > '.join([*above, name])}")
    found: dict[str, None] = {}
    for imported in _IMPORT.findall(text_of(name)):
        found |= dict.fromkeys(_in_order(imported, (*above, name)))
    return [*found, name]


def _plain(name: str) -> str:
    """A module without imports and exports. Raises :class:`ValueError` for other ones than :data:`_IMPORT`."""
    plain = _EXPORT.sub("", _IMPORT.sub("", text_of(name)))
    other = _ELSEWISE.search(plain)
    if other is not None:
        raise ValueError(f"{name} imports or exports in another way: {plain[other.start() :].splitlines()[0]}")
    return plain
