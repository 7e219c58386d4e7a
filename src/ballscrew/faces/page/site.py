"""The page as files, without a server of this program: a folder for any web server, or one HTML file."""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from ballscrew.basis.atomic_files import atomic_write, check_writable, write_error
from ballscrew.basis.errors import Fault, InputError, nearest
from ballscrew.compiler.kernels import kernel
from ballscrew.engine.evaluation.fingerprint import package_digest
from ballscrew.exports.wasm_modules import KeptModule, module_of_oils, module_of_solver, oils
from ballscrew.faces.page import bundle, kinds
from ballscrew.faces.page.banding import module_of_banding
from ballscrew.faces.page.contents import contents
from ballscrew.faces.page.judging import CHECKED_AS, module_of_judging
from ballscrew.faces.page.modules import module_of_calibrated, module_of_structure

#: Files of the folder that are as they are in the package.
_PLAIN = ("icon.svg", "style.css")
_KERNELS = "kernels"
#: Files of an earlier page, by where they stand in the folder.
_OLD = {
    "*": re.compile(r"(?:contents|page|bands)-[0-9a-f]{16}\.js"),
    f"{_KERNELS}/*": re.compile(r"[0-9a-f]{16}\.wasm(\.js)?"),
}
#: What tells a page of this program from one of somebody else.
_MARK = '<meta name="generator" content="ballscrew">'
_WORKER = "service_worker.js"
#: A worker that takes the place of one that is no more needed: browsers go on with the old one otherwise.
_NO_WORKER = """addEventListener("install", () => skipWaiting());
addEventListener("activate", (event) => event.waitUntil(registration.unregister()));
"""
#: Told of each module that is made: how many of how many.
Progress = Callable[[int, int], None]


def _silent(*_: int) -> None:
    """Nothing, for nobody looks."""


def site(
    models: Sequence[str] = (), nuts: Sequence[str] = (), *, single: bool = False, done: Progress = _silent
) -> dict[str, bytes]:
    """The files of the page by their names in the folder; a ``single`` one has all in ``index.html``.

    ``models`` and ``nuts`` name those that it knows, all by default. Raises
    :class:`~ballscrew.basis.errors.InputError` for unknown ones, and where the compiler is not installed.
    """
    if not kernel.available():
        raise InputError(Fault("site", "needs a compiler that is not installed", "", 'pip install "ballscrew[fast]"'))
    chosen = _chosen(models, nuts)
    total = len(chosen) + 1
    modules: dict[tuple[str, str], KeptModule] = {}
    calibrated: dict[tuple[str, str], KeptModule] = {}
    for place, pair in enumerate(chosen):
        done(place, total)
        modules[pair] = module_of_structure(*pair)
        beside = module_of_calibrated(*pair)
        if beside is not None:
            calibrated[pair] = beside
    grades = oils()
    of_oils = module_of_oils()
    done(total, total)
    solver, judging, banding = module_of_solver(), module_of_judging(), module_of_banding()
    all_modules = (*modules.values(), *calibrated.values(), of_oils, solver, judging.module, banding.module)
    codes = {module.file: module.code for module in all_modules}
    known = contents(modules, of_oils, grades, solver.file, judging, banding, calibrated)
    own = digest(models, nuts)
    return _single(known, codes, own) if single else _folder(known, codes, own)


def check_place(out: Path, *, single: bool) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` where the page cannot be written, before it is made.

    A document that is not of this program is not replaced.
    """
    if out.suffix == ".html":
        if not single:
            raise InputError(Fault("site.out", "is the name of a file", str(out), "name a folder, or add --single"))
        check_writable("site.out", out)
        return
    if out.is_file():
        raise InputError(Fault("site.out", "is a file", str(out), "name a folder, or a file .html with --single"))
    document = out / "index.html"
    if document.exists() and _MARK not in document.read_text(encoding="utf-8", errors="replace"):
        raise InputError(Fault("site.out", "has a page of its own", str(document), "name another folder"))
    check_writable("site.out", document)


def write(out: Path, files: Mapping[str, bytes]) -> list[Path]:
    """Write the files of the page into a folder, the document last; then those of an earlier page are removed.

    One file may have a name of its own that ends in ``.html``. Raises :class:`~ballscrew.basis.errors.InputError`
    where it cannot be written.
    """
    single = len(files) == 1
    check_place(out, single=single)
    if out.suffix == ".html":
        return [_written(out, *files.values())]
    if not single:
        try:
            (out / _KERNELS).mkdir(exist_ok=True)
        except OSError as error:
            raise write_error("site.out", out, error) from None
    paths = [_written(out / name, content) for name, content in files.items()]
    for place, names in _OLD.items():
        for old in out.glob(place):
            if names.fullmatch(old.name) and old.relative_to(out).as_posix() not in files:
                old.unlink(missing_ok=True)
    if single and (out / _WORKER).exists():
        _written(out / _WORKER, _NO_WORKER.encode())
    return paths


def _written(path: Path, content: bytes) -> Path:
    with atomic_write("site.out", path) as temporary:
        temporary.write_bytes(content)
    return path


def _chosen(models: Sequence[str], nuts: Sequence[str]) -> list[tuple[str, str]]:
    """The models and kinds of nut of the page. Raises :class:`~ballscrew.basis.errors.InputError` for unknown ones."""
    known = {"model": kinds.MODELS, "nut": tuple(kinds.KINDS)}
    faults = [
        Fault(f"site.{what}", "unknown", name, nearest(name, known[what]))
        for what, names in (("model", models), ("nut", nuts))
        for name in names
        if name not in known[what]
    ]
    if faults:
        raise InputError(*faults)
    pairs = [pair for pair in kinds.structures() if (not models or pair[0] in models) and (not nuts or pair[1] in nuts)]
    # a screw without a nut is judged with one
    judged = [(model, CHECKED_AS[kind]) for model, kind in pairs if kind in CHECKED_AS]
    pairs += [pair for pair in judged if pair not in pairs]
    if not pairs:
        given = f"{', '.join(models)} with {', '.join(nuts)}"
        raise InputError(Fault("site", "no such model has such a nut", given, "leave one of them out"))
    return pairs


def digest(models: Sequence[str] = (), nuts: Sequence[str] = ()) -> str:
    """The digest of a page: of its files, and of the sources and data that its modules and contents follow from."""
    return bundle.digest_of(package_digest(), json.dumps(_chosen(models, nuts)))


def served() -> dict[str, bytes]:
    """The files of the page where a server of this program answers, by their names in its root."""
    own = digest()
    texts = {
        "": bundle.document(own, bundle.policy()),
        "style.css": bundle.text_of("style.css"),
        "icon.svg": bundle.text_of("icon.svg"),
        "manifest.webmanifest": _json(_manifest()),
        f"contents-{own}.js": _contents({"digest": own}),
        f"page-{own}.js": bundle.script(),
    }
    return {name: text.encode() for name, text in texts.items()}


def _json(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False)


def _contents(held: Mapping[str, Any]) -> str:
    """The script that holds what the document is given."""
    return f"globalThis.ballscrewSite={_json(held)};\n"


def _in_text(code: bytes) -> str:
    return base64.b64encode(code).decode()


def _folder(known: Mapping[str, Any], codes: Mapping[str, bytes], own: str) -> dict[str, bytes]:
    # from file:// nothing can be fetched: there a module is a script that holds its bytes
    scripts = {
        f"{_KERNELS}/{name}.js": f'globalThis.ballscrewSite.embedded["{name}"]="{_in_text(code)}";\n'
        for name, code in codes.items()
    }
    texts = {
        **scripts,
        **{name: bundle.text_of(name) for name in _PLAIN},
        f"contents-{own}.js": _contents(
            {"digest": own, "worker": f"bands-{own}.js", "embedded": {}, "contents": known}
        ),
        f"page-{own}.js": bundle.script(),
        f"bands-{own}.js": bundle.worker(),
        "manifest.webmanifest": _json(_manifest()),
    }
    files = {f"{_KERNELS}/{name}": code for name, code in codes.items()} | {n: t.encode() for n, t in texts.items()}
    kept = [name for name in files if name not in scripts]
    worker = bundle.text_of("service_worker.js").replace('"DIGEST"', f'"{own}"')
    files["service_worker.js"] = worker.replace('["FILES"]', _json(["./", "index.html", *kept])).encode()
    return {**files, "index.html": bundle.document(own, bundle.policy()).encode()}


def _manifest() -> dict[str, Any]:
    return {
        "name": "ballscrew",
        "short_name": "ballscrew",
        "start_url": "./",
        "display": "standalone",
        "icons": [{"src": "icon.svg", "sizes": "any", "type": "image/svg+xml"}],
    }


def _single(known: Mapping[str, Any], codes: Mapping[str, bytes], own: str) -> dict[str, bytes]:
    script, style = bundle.script(), bundle.text_of("style.css")
    embedded = {name: _in_text(code) for name, code in codes.items()}
    held = _contents({"digest": own, "worker": "", "embedded": embedded, "contents": known}).replace("</", "<\\/")
    icon = f"data:image/svg+xml;base64,{_in_text(bundle.text_of('icon.svg').encode())}"
    document = bundle.document(own, bundle.policy([held, script], [style]))
    for reference, content in (
        ('<link rel="stylesheet" href="style.css">', f"<style>{style}</style>"),
        ('<link rel="icon" href="icon.svg" type="image/svg+xml">', f'<link rel="icon" href="{icon}">'),
        ('<link rel="manifest" href="manifest.webmanifest">', ""),
        (f'<script src="contents-{own}.js"></script>', f"<script>{held}</script>"),
        (f'<script src="page-{own}.js"></script>', f"<script>{script}</script>"),
    ):
        if document.count(reference) != 1:
            raise ValueError(f"the document has not once {reference}")
        document = document.replace(reference, content)
    return {"index.html": document.encode()}
