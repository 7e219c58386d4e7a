"""Documents of the API: those of the commands, with their sentences also as templates."""

from __future__ import annotations

import json
import threading
from collections import OrderedDict
from collections.abc import Mapping, Sequence
from typing import Any

from ballscrew.basis import units
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.descriptions import assumed, title
from ballscrew.faces.web.templates import fill_records, filled, template
from ballscrew.questions.band import compute as bands
from ballscrew.questions.band import document as band_documents
from ballscrew.questions.band import text as band_text
from ballscrew.questions.check import compute as checks
from ballscrew.questions.check import document as check_documents
from ballscrew.questions.run import compute as runs
from ballscrew.questions.run import document as run_documents

#: Runs that are kept: who has asked for the numbers of a case often asks for its drawing or its checks next.
_MOST_RUNS = 4
_runs: OrderedDict[str, runs.Run] = OrderedDict()
_runs_lock = threading.Lock()


def run_of(case: case_file.Case, tables: Mapping[str, Any]) -> runs.Run:
    """The run of a case that was made of these tables; of the same tables again it is not computed again."""
    key = json.dumps(tables, default=repr)
    with _runs_lock:
        found = _runs.get(key)
    if found is None:
        found = runs.run(case)
        with _runs_lock:
            _runs[key] = found
            if len(_runs) > _MOST_RUNS:
                _runs.popitem(last=False)
    return found


def run(found: runs.Run) -> dict[str, Any]:
    """The document of a run, and its sentences as texts and as templates."""
    case = found.case
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


def check(found: runs.Run, notes: Sequence[str] = ()) -> dict[str, Any]:
    """The document of the checks of a run, each with its text also as a template; a request has no name."""
    with units.placeholders() as quantities:
        document = check_documents.document(checks.checked("", found.case, notes, known=found))
    for one in document["checks"]:
        one["display"] = template(one["text"], quantities)
        one["words"] = filled(one["words"], quantities)
    document["assumed"] = [filled(text, quantities) for text in document["assumed"]]
    fill_records(document, quantities)
    return {key: value for key, value in document.items() if key != "name"}


def drawing(found: runs.Run) -> dict[str, Any]:
    """The ball between its grooves, as SVG whose texts are a template."""
    from ballscrew.faces.report.drawing import drawing as drawn

    with units.placeholders() as quantities:
        picture = drawn(found)
    return template(picture, quantities)


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
