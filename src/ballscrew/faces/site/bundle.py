"""The files of the page as one script and one document, so that they run from a folder of files, too.

A browser loads no module of JavaScript from ``file://``. The modules of the page are therefore written one after the
other, each as a function that returns its exports, in the order in which they import each other. They may import from
each other, and from those of the page of the server, by name and nothing else.
"""

from __future__ import annotations

import base64
import functools
import hashlib
import re
from collections.abc import Sequence
from importlib import resources

_ENTRY = "site/main.js"
#: The script that computes bands beside the page.
_WORKER = "site/band_worker.js"
_IMPORT = re.compile(r'^import \{([^}]*)\} from "(\./|\.\./\.\./web/page/)([\w.]+)";\n', re.MULTILINE)
_EXPORT = re.compile(r"^export (?=(?:const|function\*?|async function|class) (\[[^\]]*\]|\w+))", re.MULTILINE)
#: What no file of the page may have at its top, as the files become one.
_OTHER = re.compile(r"^(?:import|export)\b", re.MULTILINE)


@functools.cache
def text_of(name: str) -> str:
    """A file of the page, by its room and name; one without a room is of this page alone."""
    room, _, file = name.rpartition("/")
    return resources.files(f"ballscrew.faces.{room or 'site'}").joinpath("page", file).read_text(encoding="utf-8")


@functools.cache
def style() -> str:
    """The style of the page: that of charts, which both pages have, and its own."""
    return text_of("web/charts.css") + text_of("style.css")


@functools.cache
def script() -> str:
    """The modules of the page as one script."""
    return _joined(modules())


@functools.cache
def worker() -> str:
    """The script of the worker that computes bands, with the modules that it needs."""
    return _joined(_in_order(_WORKER))


def _joined(names: Sequence[str]) -> str:
    return "\n".join(['"use strict";\n(() => {\nconst ofModule = {};', *map(_as_function, names), "})();\n"])


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
    modules: dict[str, None] = {}
    for _, folder, file in _IMPORT.findall(text_of(name)):
        modules |= dict.fromkeys(_in_order(_name(name, folder, file), (*above, name)))
    return [*modules, name]


def _name(importing: str, folder: str, file: str) -> str:
    """The name of a module by where another one imports it from."""
    room = importing.partition("/")[0] if folder == "./" else "web"
    return f"{room}/{file}"


def _as_function(name: str) -> str:
    """A module as a function. Raises :class:`ValueError` for other imports and exports than those of this page."""
    text = text_of(name)
    exports = ", ".join(exported.strip("[]") for exported in _EXPORT.findall(text))

    def imported(match: re.Match[str]) -> str:
        return f'const {{{match[1].replace(" as ", ": ")}}} = ofModule["{_name(name, match[2], match[3])}"];\n'

    plain = _EXPORT.sub("", _IMPORT.sub(imported, text))
    other = _OTHER.search(plain)
    if other is not None:
        raise ValueError(f"{name} imports or exports in another way: {plain[other.start() :].splitlines()[0]}")
    return f'ofModule["{name}"] = (() => {{\n{plain}return {{ {exports} }};\n}})();'
