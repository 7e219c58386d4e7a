"""The files of the page: its scripts as one, so that they run from a folder of files, too, and its document.

A browser loads no module of JavaScript from ``file://``. The modules of the page are therefore written one after the
other, each as a function that returns its exports, in the order in which they import each other: by name, or all of a
module under one name, and nothing else.
"""

from __future__ import annotations

import base64
import functools
import hashlib
import html
import posixpath
import re
from collections.abc import Sequence
from importlib import resources

_ENTRY = "main.js"
#: The script that computes bands beside the page.
_WORKER = "band_worker.js"
_IMPORT = re.compile(r'^import (\{[^}]*\}|\* as \w+) from "(\.[\w./]+)";\n', re.MULTILINE)
#: Exports of what another module exports.
_PASSED_ON = re.compile(r'^export (\{[^}]*\}) from "(\.[\w./]+)";\n', re.MULTILINE)
_EXPORT = re.compile(r"^export (?=(?:const|function\*?|async function\*?|class) (\[[^\]]*\]|\w+))", re.MULTILINE)
#: Comments on lines of their own, which nobody reads there: two fifths of the script.
_COMMENT = re.compile(r"^[ \t]*(?:/\*\*(?:(?!\*/).)*\*/|//[^\n]*)[ \t]*$", re.MULTILINE | re.DOTALL)
#: What no file of the page may have at its top, as the files become one.
_OTHER = re.compile(r"^(?:import|export)\b", re.MULTILINE)
#: The files of the document whose names have the digest of the page.
SCRIPTS = ("contents", "page")


@functools.cache
def text_of(name: str) -> str:
    """A file of the page."""
    return resources.files("ballscrew.faces.page").joinpath(*name.split("/")).read_text(encoding="utf-8")


@functools.cache
def script() -> str:
    """The modules of the page as one script."""
    return _joined(modules())


@functools.cache
def worker() -> str:
    """The script of the worker that computes bands, with the modules that it needs."""
    return _joined(_in_order(_WORKER))


def document(digest: str, policy: str) -> str:
    """The document: no other one ever loads the scripts that have its ``digest`` in their names."""
    text = text_of("index.html").replace("POLICY", html.escape(policy, quote=True))
    for name in SCRIPTS:
        text = text.replace(f'src="{name}.js"', f'src="{name}-{digest}.js"')
    return text


def digest_of(*texts: str) -> str:
    """The digest of a page: of its files, and of what else it has."""
    files = map(text_of, ("index.html", "style.css", "service_worker.js", "icon.svg"))
    return hashlib.sha256("\n".join([*files, script(), worker(), policy(), *texts]).encode()).hexdigest()[:16]


def _joined(names: Sequence[str]) -> str:
    """Modules as one script; whoever looks from outside finds them in ``ballscrewModules``."""
    begin = '"use strict";\n(() => {\nconst ofModule = {};\nglobalThis.ballscrewModules = ofModule;'
    return "\n".join([begin, *map(_as_function, names), "})();\n"])


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
        f"default-src 'none'; script-src {of_scripts} 'wasm-unsafe-eval'; style-src {of_styles}; "
        "img-src 'self' data: blob:; connect-src 'self'; manifest-src 'self'; worker-src 'self'; base-uri 'none'; "
        "form-action 'none'"
    )


def _in_order(name: str) -> list[str]:
    """A module after those that it imports. Raises :class:`ValueError` where they import each other in a circle."""
    names: list[str] = []

    def add(one: str, above: tuple[str, ...]) -> None:
        if one in above:
            raise ValueError(f"the page imports in a circle: {' > '.join([*above, one])}")
        if one in names:
            return
        for _, address in _IMPORT.findall(text_of(one)) + _PASSED_ON.findall(text_of(one)):
            add(_name(one, address), (*above, one))
        names.append(one)

    add(name, ())
    return names


def _name(importing: str, address: str) -> str:
    """The name of a module by where another one imports it from."""
    return posixpath.normpath(posixpath.join(posixpath.dirname(importing), address))


def _as_function(name: str) -> str:
    """A module as a function. Raises :class:`ValueError` for other imports and exports than those of this page."""
    text = text_of(name)
    exports = ", ".join(exported.strip("[]") for exported in _EXPORT.findall(text))
    for names, address in _PASSED_ON.findall(text):
        source = f'ofModule["{_name(name, address)}"]'
        exports += "".join(f", {passed}: {source}.{passed}" for passed in map(str.strip, names.strip("{}").split(",")))

    def imported(match: re.Match[str]) -> str:
        names = match[1].removeprefix("* as ").replace(" as ", ": ")
        return f'const {names} = ofModule["{_name(name, match[2])}"];\n'  # in as many lines as before

    plain = _EXPORT.sub("", _PASSED_ON.sub("\n", _IMPORT.sub(imported, text)))
    plain = _COMMENT.sub(lambda comment: "\n" * comment[0].count("\n"), plain)  # lines stay where they are
    other = _OTHER.search(plain)
    if other is not None:
        raise ValueError(f"{name} imports or exports in another way: {plain[other.start() :].splitlines()[0]}")
    return f'ofModule["{name}"] = (() => {{\n{plain}return {{ {exports} }};\n}})();'
