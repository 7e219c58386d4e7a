"""A fingerprint of code and values: what a model computes where it cannot be recorded.

From the functions given, everything that they reach is visited: their code, with the code nested in it; defaults,
closures and attributes; the globals that the code names, and what it names in modules; and the values, classes and
methods of all objects. Of the package also the source counts, of other installed libraries the files as installed.
Code counts as bytecode, so that another version of Python has other fingerprints. Of compiled code, and of code that
uses more than values (a file, a lock, ``eval``), it cannot be known what is computed: then there is a reason, and the
fingerprint is random.
"""

from __future__ import annotations

import contextlib
import copyreg
import dataclasses
import enum
import functools
import hashlib
import importlib
import secrets
import sys
import types
from collections.abc import Iterable, Mapping
from dis import get_instructions, opmap
from pathlib import Path
from typing import Any

import numpy as np

from ballscrew.basis import version
from ballscrew.engine.evaluation.plan import library, name_in_library, origin

#: Names by which code gets at what is not among its values: files, the environment, other code.
_BEYOND_VALUES = frozenset({
    "open", "eval", "exec", "compile", "globals", "locals", "vars", "input", "__import__", "import_module",
    "environ", "getenv", "load", "loadtxt", "genfromtxt", "fromfile", "memmap", "read_text", "read_bytes",
    "read_csv", "read_excel",
})  # fmt: skip
#: More functions and classes than any law reaches, unless it reaches a whole library that is not installed.
_MOST = 20_000
#: Attributes of classes that no evaluation reads.
_ASIDE = frozenset({
    "__annotations__", "__annotate__", "__annotate_func__", "__annotations_cache__", "__dict__", "__weakref__",
    "__doc__", "__module__", "__slots__", "__firstlineno__", "__static_attributes__", "__dataclass_fields__",
    "__dataclass_params__", "__match_args__", "__hash__", "__slotnames__", "__orig_bases__", "__parameters__",
    "__abstractmethods__", "_abc_impl",
})  # fmt: skip

#: Methods that ``dataclass`` makes of the fields.
_GENERATED = frozenset({
    "__init__", "__repr__", "__eq__", "__lt__", "__le__", "__gt__", "__ge__", "__setattr__", "__delattr__",
    "__replace__",
})  # fmt: skip
#: The folder of the package, and the files in it that a recording, its kernel and its module follow from.
_FOLDER = Path(__file__).parents[2]
_OF_RECORDINGS = ("basis/**/*.py", "compiler/**/*.py", "physics/**/*.py", "engine/**/*.py",
                  "exports/wasm_modules.py", "data/*.toml")  # fmt: skip
#: How coarse the clock of files may be, in seconds.
_TICK = 0.02
_PLAIN = frozenset({type(None), bool, int, float, complex, str, bytes, type(...)})
_SLOTS = types.MemberDescriptorType, types.GetSetDescriptorType
_COMPILED = types.MethodDescriptorType, types.WrapperDescriptorType, types.ClassMethodDescriptorType
_TABLES = dict, list, set
_CONTAINERS = frozenset({list, tuple, dict, types.MappingProxyType, set, frozenset})
#: Classes whose objects are told apart by some attributes, with the name that they go by, or else that of their class.
_TOLD_BY: tuple[tuple[Any, str, tuple[str, ...]], ...] = (
    (enum.Enum, "enum", ("__class__", "name")),
    (functools.partial, "partial", ("func", "args", "keywords")),
    (np.vectorize, "vectorize", ("pyfunc", "otypes", "excluded", "signature")),
    ((classmethod, staticmethod), "", ("__func__",)),
    (property, "property", ("fget", "fset")),
    (functools.cached_property, "cached property", ("func",)),
)


@dataclasses.dataclass(frozen=True)
class Fingerprint:
    """A digest; where it is random, the reason why what is computed cannot be known."""

    digest: str
    unknown: str = ""


def fingerprint_of(values: Mapping[str, Any]) -> Fingerprint:
    """The fingerprint of functions and values: equal in all processes for equal ones."""
    visit = _Visit()
    try:
        digest = visit.digest_of(values)
    except RecursionError:
        visit.unknown.append("values that are nested too deeply")
    else:
        if not visit.unknown:
            return Fingerprint(digest)
    return Fingerprint(secrets.token_hex(32), visit.unknown[0])


@functools.cache
def package_digest() -> str:
    """A digest of the source and the data of this package, as installed."""
    return _digest_of(path for kind in ("py", "toml") for path in _FOLDER.rglob(f"*.{kind}"))


@functools.cache
def recorder_digest() -> str:
    """A digest of what a recording, its kernel and its module follow from: source and data, Python and NumPy.

    It is random where files have changed since the import: what runs is what they were before.
    """
    digest = _digest_of(_files_of_recordings())
    if not stands_as_imported():  # asked after reading, so that no change falls between
        digest = secrets.token_hex(32)
    return f"{digest} {sys.version} {np.__version__}"


def stands_as_imported() -> bool:
    """Return whether no file that a recording follows from has changed since the package was imported."""
    with contextlib.suppress(OSError):  # removed just now
        # whoever installs a package may set back the time of the content, but not that of the file
        changed = (max(status.st_mtime, status.st_ctime) for status in map(Path.stat, _files_of_recordings()))
        return max(changed, default=0.0) < version.IMPORTED_AT - _TICK
    return False


def _files_of_recordings() -> list[Path]:
    return [path for pattern in _OF_RECORDINGS for path in _FOLDER.glob(pattern)]


def _digest_of(paths: Iterable[Path]) -> str:
    result = hashlib.sha256()
    for path in sorted(paths):
        content = path.read_bytes()
        result.update(f"{path.relative_to(_FOLDER).as_posix()} {len(content)}\n".encode() + content)
    return result.hexdigest()


class _Visit:
    """Functions, classes and modules in the order of their first visit, and a digest of all."""

    def __init__(self) -> None:
        #: Why something cannot be known.
        self.unknown: list[str] = []
        self._reached: list[Any] = []
        self._numbers: dict[int, int] = {}
        #: Digests by identity, with the object, so that the identity is not used again.
        self._known: dict[int, tuple[Any, bytes]] = {}
        self._open: list[int] = []
        self._in_package = False

    def digest_of(self, values: Mapping[str, Any]) -> str:
        result = hashlib.sha256(self._digest(dict(values)))
        position = 0
        while position < len(self._reached):
            item = self._reached[position]
            self._in_package = origin(item) == "package"
            if position > _MOST:
                self.unknown.append(f"more than {_MOST} functions")
                break
            result.update(self._of_function(item) if isinstance(item, types.FunctionType) else self._of_class(item))
            position += 1
        return result.hexdigest()

    # -- values -----------------------------------------------------------------------------------

    def _digest(self, value: Any) -> bytes:
        """The digest of a value; of functions and classes a number, as their turn comes later."""
        kind = type(value)
        if kind in _PLAIN:
            return f"{kind.__name__} {value!r};".encode()
        if kind is types.FunctionType or isinstance(value, type):
            return self._reference(value)
        key = id(value)
        if key in self._known:
            return self._known[key][1]
        if key in self._open:
            return f"within {len(self._open) - self._open.index(key)};".encode()
        self._open.append(key)
        try:
            digest = hashlib.blake2b(self._content(value), digest_size=16).digest()
        finally:
            self._open.pop()
        self._known[key] = value, digest
        return digest

    def _content(self, value: Any) -> bytes:
        kind = type(value)
        if named := name_in_library(value):
            return named.encode()
        if kind in _CONTAINERS:
            return self._of_container(value)
        if isinstance(value, np.generic) or kind is np.ndarray:
            return self._of_array(value)
        for known, name, attributes in _TOLD_BY:
            if isinstance(value, known):
                return self._all(name or kind.__name__, [getattr(value, attribute) for attribute in attributes])
        if isinstance(value, types.MethodType):
            return self._of_method(value)
        if isinstance(value, types.BuiltinFunctionType):
            of_module = isinstance(value.__self__, types.ModuleType)
            return self._compiled(value.__name__) if of_module else self._all(value.__name__, (value.__self__,))
        if isinstance(value, types.ModuleType):
            names = [] if origin(value) != "outside" else [n for n in vars(value) if not n.startswith("__")]
            return self._of_module(value, names)
        if hasattr(value, "__wrapped__") and origin(kind) == "library":  # functools.cache and its like
            return self._all("wrapped", (value.__wrapped__,))
        if isinstance(value, np.ufunc):
            return self._compiled(value.__name__)
        return self._of_object(value)

    def _of_container(self, value: Any) -> bytes:
        """Bytes of what a container holds; in the order of its digests where it has no order that counts."""
        kind = type(value)
        if kind in (list, tuple):
            return self._all(kind.__name__, value)
        if kind in (set, frozenset):
            ordered = b"".join(sorted(map(self._digest, value)))
            return b"set" + ordered if _plain_keys(value) else self._unknown("a set of objects")
        pairs = sorted((self._digest(k), v) for k, v in value.items()) if _plain_keys(value) else value.items()
        return self._all("dict", (part for pair in pairs for part in pair))

    def _of_array(self, value: Any) -> bytes:
        """Type, shape and numbers of an array; of one of objects these."""
        if isinstance(value, np.ndarray) and value.dtype.hasobject:
            return self._all(f"objects {value.shape}", value.ravel().tolist())
        return f"{value.dtype.str} {np.shape(value)} ".encode() + value.tobytes()

    def _of_method(self, method: types.MethodType) -> bytes:
        """The object of a method, and its name or its function."""
        result = getattr(type(method.__self__), method.__name__, None)
        # a copy from another process has a function of its own beside that of its class
        is_of_class = getattr(result, "__code__", None) == method.__func__.__code__
        return self._all("method", (method.__self__, method.__name__ if is_of_class else method.__func__))

    def _all(self, kind: str, parts: Iterable[Any]) -> bytes:
        return kind.encode() + b"(" + b",".join([self._digest(part) for part in parts]) + b")"

    def _unknown(self, what: str) -> bytes:
        """Note what cannot be known; within the package it is what its source says."""
        if not self._in_package:
            self.unknown.append(what)
        return b"unknown"

    def _compiled(self, name: str) -> bytes:
        return self._unknown(f"the compiled function {name}")

    def _of_object(self, value: Any) -> bytes:
        """The class of an object, and all that it holds."""
        kind = type(value)
        if origin(kind) == "package" and dataclasses.is_dataclass(value):
            # what else it holds is computed from these
            return self._all("", (kind, *(getattr(value, field.name) for field in dataclasses.fields(value))))
        if origin(kind) == "library":
            return self._of_pickled(value)
        held: dict[str, Any] = dict(getattr(value, "__dict__", {}))
        for base in kind.__mro__:
            slots = [name for name, kept in vars(base).items() if isinstance(kept, types.MemberDescriptorType)]
            held |= {name: getattr(value, name) for name in slots if hasattr(value, name)}
            for name, attribute in vars(base).items():
                if isinstance(attribute, functools.cached_property):
                    held.pop(name, None)
        built_in = next((base for base in kind.__mro__ if origin(base) == "library"), object)
        below: Any = None
        if built_in is np.ndarray:
            below = np.asarray(value)
        elif built_in in (dict, list, tuple, set, frozenset, int, float, complex, str, bytes):
            below = built_in(value)
        elif built_in is not object and built_in.__module__ not in ("abc", "typing", "collections.abc"):
            return self._all("object", (kind, held)) + self._of_pickled(value)
        return self._all("object", (kind, held, below))

    def _of_pickled(self, value: Any) -> bytes:
        """An object of a library by what ``pickle`` would keep of it."""
        name = f"{type(value).__module__}.{type(value).__qualname__}"
        try:
            reduce = copyreg.dispatch_table.get(type(value))
            kept = value.__reduce_ex__(4) if reduce is None else reduce(value)
        except Exception:  # whatever a class raises that cannot be pickled
            return self._unknown(f"an object of the class {name}")
        if isinstance(kept, str):
            return self._unknown(f"an object of the class {name}")
        function, arguments, *others = kept
        parts = [others[0] if others else None, *(list(items) if items is not None else None for items in others[1:3])]
        return self._all("pickled", (function, arguments, *parts))

    # -- functions, classes and modules -----------------------------------------------------------

    def _reference(self, item: Any) -> bytes:
        if named := name_in_library(item):
            return named.encode()
        number = self._numbers.get(id(item))
        if number is None:
            number = self._numbers[id(item)] = len(self._reached)
            self._reached.append(item)
        return f"reached {number};".encode()

    def _of_function(self, function: types.FunctionType) -> bytes:
        names: set[str] = set()
        code = _code(function.__code__, names)
        cells = [_content_of(cell) for cell in function.__closure__ or ()]
        parts = [self._all("", (function.__defaults__, function.__kwdefaults__, cells, vars(function)))]
        space = function.__globals__
        parts += [self._of_global(name, space[name], names) for name in sorted(names & space.keys())]
        if not self._in_package:
            beyond = sorted((names & _BEYOND_VALUES) - space.keys())
            modules = [v for n in names if isinstance(v := space.get(n), types.ModuleType) and origin(v) == "outside"]
            beyond += ["getattr"] if "getattr" in names and modules else []
            parts += [self._unknown(f"{function.__qualname__}, which calls {name}") for name in beyond]
            parts += [self._of_import(name, names) for name in _imported(function.__code__)]
        return code + b"".join(parts)

    def _of_global(self, name: str, value: Any, names: set[str]) -> bytes:
        if isinstance(value, types.ModuleType):
            return name.encode() + self._of_module(value, names)
        if self._in_package and isinstance(value, _TABLES):
            return b""  # of the package these are tables, which its source has, and caches, which change no result
        return name.encode() + self._digest(value)

    def _of_module(self, module: types.ModuleType, names: Iterable[str]) -> bytes:
        """Names of a module that code reads; of a library all of it."""
        if origin(module) == "library":
            return library(module.__name__).encode()
        space = vars(module)
        key = id(module)
        if key in self._open:
            return b"module"
        self._open.append(key)
        try:
            values = [self._of_global(name, space[name], set(names)) for name in sorted({*names} & space.keys())]
        finally:
            self._open.pop()
        return b"module" + b"".join(values)

    def _of_import(self, name: str, names: set[str]) -> bytes:
        try:
            return self._of_global(name, importlib.import_module(name), names)
        except Exception:  # whatever a module raises, and names that only its package can resolve
            return self._unknown(f"the import of {name} in a function")

    def _of_class(self, kind: type) -> bytes:
        """The bases and the attributes of a class."""
        parts = [self._all("class", kind.__bases__)]
        aside = _ASIDE | _GENERATED if dataclasses.is_dataclass(kind) else _ASIDE
        for name in sorted(vars(kind).keys() - aside):
            value = vars(kind)[name]
            if isinstance(value, _COMPILED):
                parts.append(self._compiled(f"{kind.__qualname__}.{name}"))
            elif not isinstance(value, _SLOTS):
                parts.append(name.encode() + self._digest(value))
        return b"".join(parts)


def _code(code: types.CodeType, names: set[str]) -> bytes:
    """Bytecode and constants, also of nested code, without places in files; ``names`` gets the names in it."""
    names.update(code.co_names)
    head = (
        code.co_argcount, code.co_posonlyargcount, code.co_kwonlyargcount, code.co_flags, code.co_names,
        code.co_varnames[: code.co_argcount + code.co_kwonlyargcount], code.co_freevars, code.co_cellvars,
    )  # fmt: skip
    constants = [_constant(constant, names) for constant in code.co_consts]
    return b"%r %b %b %r" % (head, code.co_code, code.co_exceptiontable, constants)


def _constant(value: Any, names: set[str]) -> Any:
    if isinstance(value, types.CodeType):
        return _code(value, names)
    return sorted(map(repr, value)) if isinstance(value, frozenset) else value


def _imported(code: types.CodeType) -> list[str]:
    """The modules that code imports when it runs."""
    names = [
        name for constant in code.co_consts if isinstance(constant, types.CodeType) for name in _imported(constant)
    ]
    if opmap["IMPORT_NAME"] in code.co_code[::2]:
        names += [str(step.argval) for step in get_instructions(code) if step.opname == "IMPORT_NAME"]
    return names


def _content_of(cell: types.CellType) -> Any:
    try:
        return cell.cell_contents
    except ValueError:  # not assigned yet
        return ...


def _plain_keys(value: Iterable[Any]) -> bool:
    return all(isinstance(key, str | int | float | bytes | tuple) for key in value)
