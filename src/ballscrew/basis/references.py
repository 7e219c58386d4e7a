"""References: the bibliography, and the addresses of the equations of the paper.

A docstring names its sources by key (``HamrockDowson1977``) and its equations by address
(``Olaru2005 §5 (23)``: section and number, because the paper uses (22) to (26) twice).
"""

from __future__ import annotations

import ast
import dataclasses
import functools
import inspect
import re
import sys
import textwrap
import tomllib
from collections.abc import Mapping
from importlib import resources
from typing import Any

ADDRESS = re.compile(r"Olaru2005\s+§(?P<section>[\d.]+)\s+\((?P<number>\d+)\)")
_ENTRY = re.compile(r"@\w+\{(?P<key>[^,\s]+),.*?\n\}", re.DOTALL)


@dataclasses.dataclass(frozen=True, slots=True)
class PaperEquation:
    """One numbered equation of the paper, and the verdict on it."""

    section: str
    number: int
    what: str
    verdict: str

    @property
    def address(self) -> str:
        """The address in the paper, ``Olaru2005 §5 (23)``."""
        return f"Olaru2005 §{self.section} ({self.number})"


def _data(name: str) -> str:
    return resources.files("ballscrew").joinpath("data", name).read_text(encoding="utf-8")


@functools.cache
def paper_equations() -> tuple[PaperEquation, ...]:
    """The 41 numbered equations of the paper, in their order."""
    return tuple(PaperEquation(**row) for row in tomllib.loads(_data("olaru2005.toml"))["equations"])


@functools.cache
def bibliography() -> Mapping[str, str]:
    """BibTeX entries by key."""
    return {match["key"]: match[0] for match in _ENTRY.finditer(_data("references.bib"))}


def addresses_in(text: str | None) -> list[str]:
    """Addresses of equations of the paper that a text names, in one spelling."""
    return [f"Olaru2005 §{m['section']} ({m['number']})" for m in ADDRESS.finditer(text or "")]


@functools.cache
def keys_in(text: str | None) -> tuple[str, ...]:
    """Keys of the bibliography that a text names, in the order of the bibliography."""
    return tuple(key for key in bibliography() if re.search(rf"\b{re.escape(key)}\b", text or ""))


def documentation(documented: Any) -> str:
    """The docstring of a function or a class; of its source where the interpreter has left docstrings out (``-OO``)."""
    if sys.flags.optimize < 2:  # beyond that a dataclass makes itself a docstring of its signature
        return documented.__doc__ or ""
    try:
        (definition,) = ast.parse(textwrap.dedent(inspect.getsource(documented))).body
    except (OSError, TypeError, ValueError, SyntaxError):  # made without a source, as in a session
        return ""
    known = isinstance(definition, ast.FunctionDef | ast.ClassDef)
    return (ast.get_docstring(definition) or "") if known else ""


def citations_of(assembly: Any) -> list[str]:
    """Keys of the sources that the laws of a model name in their docstrings."""
    texts: list[str] = []
    for field in dataclasses.fields(assembly):
        law = getattr(assembly, field.name)
        documented = law if callable(law) and hasattr(law, "__name__") else type(law)
        if callable(law):
            texts.append(documentation(documented))
    result = {key for text in texts for key in keys_in(text)} | {"Olaru2005"}
    return [key for key in bibliography() if key in result]
