"""``ballscrew schema``: the JSON Schema of a case file."""

from __future__ import annotations

import typer


def schema() -> None:
    """JSON Schema of a case file."""
    import json

    from ballscrew.case_schema.schema import json_schema

    typer.echo(json.dumps(json_schema(), indent=2, ensure_ascii=False))
