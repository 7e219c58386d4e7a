"""``ballscrew schema``: the JSON Schema of a case file, or of a need."""

from __future__ import annotations

from typing import Annotated

import typer


def schema(
    need: Annotated[bool, typer.Option("--need", help="Of a file of ballscrew select and optimise.")] = False,
) -> None:
    """JSON Schema of a case file."""
    import json

    if need:
        from ballscrew.questions.optimise.need_schema import json_schema
    else:
        from ballscrew.cases.schema.case_schema import json_schema

    typer.echo(json.dumps(json_schema(), indent=2, ensure_ascii=False))
