"""Every public function, method and constructor says what it takes, gives and raises.

Public is what ``ballscrew`` offers by name, with the public methods of its classes. A new one is tested here without
being listed.
"""

import dataclasses
import inspect
import re
from collections.abc import Callable, Iterator
from typing import Any, get_type_hints

import ballscrew
from ballscrew.basis.quantities import info_of, unit_of
from support.rules import for_each

#: Source by which a function raises an ``InputError`` itself, or by its decorator.
RAISES = re.compile(r"\braise InputError\(|\braise_if_any\(|@accepts_units\(")
#: Words for what is returned that are no class of the package.
WORDS = {"Dataset": "dataset", "DataArray": "array"}


@dataclasses.dataclass(frozen=True)
class Callee:
    """A public function or method, or the constructor of a public class."""

    name: str
    function: Callable[..., Any]
    owner: type | None = None

    @property
    def is_constructor(self) -> bool:
        return isinstance(self.function, type)

    @property
    def is_property(self) -> bool:
        """True for what is read like a field: its sentence says what it is."""
        return self.owner is not None and not callable(getattr(self.owner, self.name.rpartition(".")[2]))

    @property
    def doc(self) -> str:
        return inspect.getdoc(self.function) or ""

    @property
    def parameters(self) -> list[str]:
        return [name for name in inspect.signature(self.function).parameters if name not in ("self", "cls")]

    @property
    def silent(self) -> list[str]:
        """Parameters that are not in the docstring: not as a name, and not as a function that is called."""
        return [name for name in self.parameters if not re.search(rf"``{name}(``|\()", self.doc)]

    @property
    def code(self) -> str:
        """The source that runs when it is called."""
        code: Any = getattr(self.function, "__post_init__", None) if self.is_constructor else self.function
        return "" if code is None else inspect.getsource(inspect.unwrap(code))

    @property
    def returned(self) -> list[str]:
        """Words of which the docstring has to have each, for what is returned."""
        if self.is_constructor or self.is_property:
            return []
        function: Any = inspect.unwrap(self.function)
        annotation = str(inspect.signature(function).return_annotation)
        words: list[str] = []
        for word in re.findall(r"\b[A-Z]\w*", annotation.replace("Literal", "")):
            kind = function.__globals__.get(word)
            if word in WORDS:
                words.append(WORDS[word])
            elif isinstance(kind, type) and kind.__module__.startswith("ballscrew.") and not self._is_of(kind):
                words.append(word)
        return words

    def _is_of(self, kind: type) -> bool:
        """True for what a method of a class makes of the same kind: the sentence says what it is."""
        return self.owner is not None and (kind in self.owner.__mro__ or kind.__module__ == self.owner.__module__)

    @property
    def unit(self) -> str | None:
        """The unit of the number that is returned; None where there is none."""
        if self.is_constructor:
            return None
        function: Any = inspect.unwrap(self.function)
        if "return" not in getattr(function, "__annotations__", {}):
            return None
        namespace = dict(vars(__import__("typing")))
        try:
            annotation = get_type_hints(function, localns=namespace, include_extras=True)["return"]
        except NameError:  # a name for type checkers alone is no quantity
            return None
        return None if info_of(annotation) is not None else unit_of(annotation)


def public() -> Iterator[Callee]:
    """What the package offers."""
    for name in ballscrew.__all__:
        value = getattr(ballscrew, name)
        if inspect.isfunction(value) or hasattr(value, "__wrapped__"):
            yield Callee(name, value)
        elif isinstance(value, type) and not issubclass(value, BaseException | Warning):
            yield Callee(name, value)
            yield from _methods(name, value)


def _methods(name: str, owner: type) -> Iterator[Callee]:
    fields = {field.name for field in dataclasses.fields(owner)} if dataclasses.is_dataclass(owner) else set()
    for key in dir(owner):
        if key in fields or (key.startswith("_") and key != "__call__"):
            continue
        kind = next(vars(each)[key] for each in owner.__mro__ if key in vars(each))
        function: Any = kind
        if isinstance(kind, classmethod | staticmethod):
            function = getattr(owner, key)
        elif not inspect.isfunction(kind):
            function = getattr(kind, "fget", None) or getattr(kind, "func", None)
        module = getattr(inspect.unwrap(function), "__module__", "") if callable(function) else ""
        if module.startswith("ballscrew"):
            yield Callee(f"{name}.{key}", function, owner)


PUBLIC = {callee.name: callee for callee in public()}


def test_something_is_public():
    assert {"band", "BallScrew", "FrictionModel.__call__", "FrictionResult.valid", "Bodies.of"} <= set(PUBLIC)


@for_each(callee=PUBLIC)
def test_every_parameter_is_named(callee: Callee):
    assert callee.silent == []


@for_each(callee=PUBLIC)
def test_what_is_returned_is_said(callee: Callee):
    assert callee.doc
    assert [word for word in callee.returned if word not in callee.doc] == []
    if callee.unit not in (None, "1"):
        assert re.search(rf"(?<![\w/]){re.escape(callee.unit)}(?![\w/])", callee.doc)


@for_each(callee=PUBLIC)
def test_an_input_error_is_named(callee: Callee):
    if RAISES.search(callee.code):
        assert "InputError" in callee.doc
