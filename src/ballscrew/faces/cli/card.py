"""``ballscrew card``: torque cards checked, described, and turned into a log and a case for a fit."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

app = typer.Typer(help="Torque cards: measured screws in files to share.", no_args_is_help=True, rich_markup_mode=None)


@app.command()
def check(
    cards: Annotated[list[Path], typer.Argument(metavar="PATH", help="Torque cards (TOML), or folders of them.")],
    as_json: Annotated[bool, typer.Option("--json", help="One JSON list, SI units.")] = False,
) -> None:
    """All faults of cards, or what each does not state.

    A card without a fault has one line, with what it does not state.
    """
    from ballscrew.basis.output import json_text
    from ballscrew.cases.torque_cards import torque_card
    from ballscrew.questions.card import compute as documents
    from ballscrew.questions.card import text

    found = torque_card.read_all(cards)
    typer.echo(json_text.as_json(documents.documents(found)) if as_json else text.text_of(found))


@app.command()
def schema() -> None:
    """JSON Schema of a torque card."""
    import json

    from ballscrew.cases.torque_cards.torque_card import json_schema

    typer.echo(json.dumps(json_schema(), indent=2, ensure_ascii=False))


@app.command()
def log(
    card: Annotated[Path, typer.Argument(metavar="FILE", help="Torque card (TOML).")],
    to: Annotated[Path, typer.Option("--to", "-o", metavar="FILE", help="The log to write, .csv.")],
    case: Annotated[Path, typer.Option("--case", metavar="FILE", help="The case file to write, .toml.")],
) -> None:
    """Write a card as a log and a case file for a fit.

    Both are as ballscrew fit takes them.
    """
    from ballscrew.cases.torque_cards import torque_card, torque_card_log

    found = torque_card.read(card)
    torque_card_log.write(found, card.parent, to, case)
    typer.echo(f"{to}: {len(torque_card.log_rows(found))} rows; {case}")
