"""Options that several commands share."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

import typer

AllowCode = Annotated[
    bool, typer.Option("--allow-code", help='Let the case name laws of your own, "module:name", and run their code.')
]
Verbose = Annotated[bool, typer.Option("--verbose", help="Say on the error stream what evaluates the model, and why.")]


def say_engine(attributes: Mapping[str, Any]) -> None:
    """The engine that evaluated, and why it was that one, on the error stream."""
    reason = attributes.get("engine_reason")
    typer.echo(f"evaluated by {attributes['engine']}" + (f": {reason}" if reason else ""), err=True)
