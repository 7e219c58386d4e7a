"""The glossary has the words that people search for, and every name in it exists in the program."""

import re

import pytest

import ballscrew as bs
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.schema.case_schema import coefficients_of, sections
from ballscrew.cases.screw_tables.nut_kinds import LOSSES
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.faces.cli.main import COMMANDS, command_line, typer_command
from ballscrew.faces.web import openapi
from ballscrew.faces.web.server import application
from ballscrew.physics.components.nut import NUTS, DoubleNut
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.model import LAWS
from ballscrew.physics.friction.validity import STARVED
from ballscrew.physics.sizing.checks import CHECKS
from ballscrew.questions.select.need import SHORT_NAMES
from ballscrew.questions.select.requirements import Requirements
from support.rules import for_each

from .pages import DOCS

TEXT = (DOCS / "glossary.md").read_text(encoding="utf-8")
ROWS = [
    [cell.strip() for cell in line.strip("|").split(" | ")] for line in TEXT.splitlines() if line.startswith("| **")
]
#: Words that people search for.
SEARCHED = ("L10", "C_a", "Backlash", "Drag torque", "Preload class", "NLGI", "DN value")
NAMES = sorted({name for row in ROWS for name in re.findall(r"`([^`]+)`", row[2])})


def names_in(schema, found):
    """The names of properties of a schema, however deep."""
    if isinstance(schema, dict):
        properties = schema.get("properties")
        if isinstance(properties, dict):
            found.update(properties)
        for inner in schema.values():
            names_in(inner, found)
    elif isinstance(schema, list):
        for inner in schema:
            names_in(inner, found)
    return found


@pytest.fixture(scope="module")
def known():
    """Names that stand alone: keys of answers, outputs, checks, parts of the torque, laws and kinds of nuts."""
    answers = names_in(openapi.document(application()), set())
    laws = {law for slot in (*LAWS.values(), *LOSSES.values()) for law in slot}
    return {
        *answers,
        *known_outputs(),
        *known_outputs(DoubleNut(preload=1000.0)),
        *MECHANISMS,
        *laws,
        *NUTS,
        *SHORT_NAMES,
        *(row.name for row in CHECKS),
        STARVED,
    }


def fields_in(section):
    """The fields of a section of a case file; of the model and of losses also their slots and coefficients."""
    if section == "need":
        return {*fields_of(Requirements), "back_driving", "accuracy"}
    if section in LAWS:
        return {field for law in LAWS[section] for field in coefficients_of(section, law)}
    return {*sections()[section].model_fields}


def exists(name, known):
    if name in known:
        return True
    if name.startswith("ballscrew "):
        command, *flags = name.split()[1:]
        known_flags = (
            {flag for one in typer_command(command, COMMANDS[command]).params for flag in one.opts} if flags else ()
        )
        return command in command_line().commands and set(flags) <= {*known_flags}
    if name.startswith("bs."):
        return hasattr(bs, name.removeprefix("bs."))
    if name.startswith("["):
        return name.strip("[]") in sections()
    section, _, field = name.partition(".")
    return (
        bool(field) and (section == "need" or section in LAWS or section in sections()) and field in fields_in(section)
    )


def test_the_words_of_catalogues_are_entries():
    terms = [row[0] for row in ROWS]
    for word in SEARCHED:
        assert any(term.startswith(f"**{word}") for term in terms), word
    assert 40 <= len(terms) <= 75
    assert len(set(terms)) == len(terms)


def test_every_row_has_a_term_a_meaning_a_name_and_a_page():
    for row in ROWS:
        assert len(row) == 4, row
        assert all(row), row
        (page,) = re.findall(r"\]\(([^)#]+\.md)(?:#[^)]*)?\)", row[3])
        assert (DOCS / page).is_file(), page


@for_each(name={name: name for name in NAMES})
def test_every_name_exists(name, known):
    assert exists(name, known), name
