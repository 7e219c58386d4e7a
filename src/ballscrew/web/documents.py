"""Documents of the API: those of the commands, with their sentences also as templates."""

from __future__ import annotations

from typing import Any

from ballscrew import units
from ballscrew.cases import case_file
from ballscrew.cases.descriptions import assumed, title
from ballscrew.output.documents import band as band_documents
from ballscrew.output.documents import run as run_documents
from ballscrew.output.text import band as band_text
from ballscrew.studies import band as bands
from ballscrew.studies import run as runs
from ballscrew.web.templates import fill_records, filled, template


def run(case: case_file.Case) -> dict[str, Any]:
    """The document of a run, and its sentences as texts and as templates."""
    found = runs.run(case)
    with units.placeholders() as quantities:
        document = run_documents.document(found)
        heading, assumptions = title(case), assumed(case, found.ball_to_ball_force)
    verdicts = [record["text"] for record in document["verdicts"]]
    fill_records(document, quantities)
    return {
        **document,
        "words": {
            "title": filled(heading, quantities),
            "verdicts": [filled(text, quantities) for text in verdicts],
            "assumed": [filled(text, quantities) for text in assumptions],
        },
        "display": {
            "title": template(heading, quantities),
            "verdicts": [template(text, quantities) for text in verdicts],
            "assumed": [template(text, quantities) for text in assumptions],
        },
    }


def band(case: case_file.Case, found: bands.BandReport) -> dict[str, Any]:
    """The document of a band, and its sentences as texts and as templates."""
    answered = runs.run(case)
    with units.placeholders() as quantities:
        document = band_documents.document(answered, found)
        sentences = [verdict.text for verdict in band_documents.verdicts(case, found)]
    fill_records(document, quantities)
    return {
        **document,
        "words": {
            "sentences": [filled(text, quantities) for text in sentences],
            "inputs": band_text.input_counts(found),
        },
        "display": {"sentences": [template(text, quantities) for text in sentences]},
    }
