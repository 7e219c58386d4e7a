"""Commands that list what there is: names, sources, schemas, oils, torque cards, and a paper with its claims."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ballscrew.faces.cli.options import AsJson, file_option, print_answer
from ballscrew.questions.shared.question import CaseOptions


def list_names(
    kind: Annotated[str, typer.Argument(metavar="KIND", help="grades, laws, models, inputs or outputs.")],
    case: Annotated[
        Path | None, typer.Argument(help="A case file; inputs and outputs are then those of its model and nut.")
    ] = None,
    words: Annotated[
        list[str] | None, typer.Option("--word", metavar="WORD", help="Only lines with this word, such as film.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """List grades, laws, models, inputs or outputs. Grades are those of oils; inputs are what can be varied."""
    from ballscrew.cases.case_files import case_file
    from ballscrew.questions import names

    known = names.names(kind, None if case is None else case_file.load(case))
    known = [name for name in known if all(word.lower() in " ".join(name).lower() for word in words or ())]
    print_answer(lambda: names.text(known), lambda: names.document(kind, known), as_json=as_json)


def cite(
    case: Annotated[Path | None, typer.Argument(help="Case file; without one, all sources.")] = None,
    *,
    case_options: Annotated[CaseOptions, {"calibration": None}],
) -> None:
    """BibTeX of the sources that a case makes use of."""
    from ballscrew.basis.references import bibliography
    from ballscrew.cases.case_files.descriptions import references

    entries = bibliography()
    keys = list(entries) if case is None else references(case_options.load(case))
    typer.echo("\n\n".join(entries[key] for key in keys))


def schema(
    need: Annotated[bool, typer.Option("--need", help="Of a file of ballscrew select and optimise.")] = False,
) -> None:
    """JSON Schema of a case file."""
    if need:
        from ballscrew.questions.optimise.need_schema import json_schema
    else:
        from ballscrew.cases.schema.case_schema import json_schema

    _print_schema(json_schema())


def _print_schema(json_schema: object) -> None:
    import json

    typer.echo(json.dumps(json_schema, indent=2, ensure_ascii=False))


def reproduce(
    paper: Annotated[str, typer.Argument(help="The paper: olaru2005.")],
    out: Annotated[Path, typer.Option("--out", metavar="DIR", help="Folder for figures, data and claims.")],
) -> None:
    """Figures, data and claims of a paper. Beside them the reference model on a preloaded nut."""
    from ballscrew.basis.errors import Fault, InputError, nearest

    if paper != "olaru2005":
        raise InputError(Fault("reproduce", "unknown paper", paper, nearest(paper, ["olaru2005"])))
    from ballscrew.questions.reproduce.reproduction import reproduce_olaru2005

    def print_step(step: str, done: int, total: int) -> None:
        typer.echo(f"[{done}/{total}] {step}", err=True)

    files, summary = reproduce_olaru2005(out, print_step)
    for line in summary:
        typer.echo(line)
    typer.echo(f"{out}: {len(files)} files; read claims.md and preloaded_nut.md first")


# -- oils -----------------------------------------------------------------------------------------

oils = typer.Typer(help="Oils and greases as their makers state them.", no_args_is_help=True, rich_markup_mode=None)

OilFile = Annotated[
    Path | None,
    typer.Option("--oils", metavar="FILE", help="A file of your own, .toml, in place of the library."),
]


@oils.command("list")
def list_oils(
    words: Annotated[list[str] | None, typer.Argument(help="Only oils with these words: arcanol polyurea.")] = None,
    file: OilFile = None,
    as_json: AsJson = False,
) -> None:
    """All oils, one line each."""
    from ballscrew.cases.case_files import lubricants
    from ballscrew.questions.oils import document, list_text

    sheets = lubricants.chosen(lubricants.oils(file), " ".join(words or []))
    print_answer(lambda: list_text(sheets), lambda: document(sheets), as_json=as_json)


@oils.command("show")
def show_oil(
    name: Annotated[str, typer.Argument(help='Name of the oil: "Arcanol LOAD150".')],
    file: OilFile = None,
    as_json: AsJson = False,
) -> None:
    """One oil: its data sheet, and its viscosities.

    The viscosities are from -40 to 120 degC.
    """
    from ballscrew.cases.case_files import lubricants
    from ballscrew.questions.oils import document, show_text

    sheet = lubricants.oils(file).named(name)
    print_answer(lambda: show_text(sheet), lambda: document([sheet]), as_json=as_json)


# -- torque cards ---------------------------------------------------------------------------------

card = typer.Typer(help="Torque cards: measured screws in files to share.", no_args_is_help=True, rich_markup_mode=None)


@card.command("check")
def check_cards(
    cards: Annotated[list[Path], typer.Argument(metavar="PATH", help="Torque cards (TOML), or folders of them.")],
    as_json: Annotated[bool, typer.Option("--json", help="One JSON list, SI units.")] = False,
) -> None:
    """All faults of cards, or what each does not state.

    A card without a fault has one line, with what it does not state.
    """
    from ballscrew.cases.torque_cards import torque_card
    from ballscrew.questions.card import documents, text_of

    read = torque_card.read_all(cards)
    print_answer(lambda: text_of(read), lambda: documents(read), as_json=as_json)


@card.command("schema")
def card_schema() -> None:
    """JSON Schema of a torque card."""
    from ballscrew.cases.torque_cards.torque_card import json_schema

    _print_schema(json_schema())


@card.command("log")
def card_log(
    card: Annotated[Path, typer.Argument(metavar="FILE", help="Torque card (TOML).")],
    to: Annotated[Path, file_option("The log to write, .csv.")],
    case: Annotated[Path, typer.Option("--case", metavar="FILE", help="The case file to write, .toml.")],
) -> None:
    """Write a card as a log and a case file for a fit.

    Both are as ballscrew fit takes them.
    """
    from ballscrew.cases.torque_cards import torque_card

    read = torque_card.read(card)
    torque_card.write(read, card.parent, to, case)
    typer.echo(f"{to}: {len(torque_card.log_rows(read))} rows; {case}")
