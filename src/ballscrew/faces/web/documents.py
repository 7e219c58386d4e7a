"""Documents of the API: those of the commands, with words beside them."""

from __future__ import annotations

import json
import threading
from collections import OrderedDict
from collections.abc import Mapping, Sequence
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.records import Message
from ballscrew.cases.case_files import case_file, case_messages
from ballscrew.cases.case_files.uncertain_inputs import path_of
from ballscrew.questions.band import compute as bands
from ballscrew.questions.band import document as band_documents
from ballscrew.questions.band.sheet import input_counts
from ballscrew.questions.check import compute as checks
from ballscrew.questions.check import document as check_documents
from ballscrew.questions.optimise import answer as optimise_documents
from ballscrew.questions.optimise.compute import Optimisation
from ballscrew.questions.run import answer as run_documents
from ballscrew.questions.run import compute as runs
from ballscrew.questions.run import makers
from ballscrew.questions.select.objectives import OBJECTIVES
from ballscrew.questions.sensitivity import answer as sensitivity_documents
from ballscrew.questions.sensitivity.compute import SensitivityReport

#: Runs that are kept: who has asked for the numbers of a case often asks for its drawing or its checks next.
_MOST_RUNS = 4
#: Shares of a distribution: the ends of 95 %, and its median between them.
_INTERVAL = (0.025, 0.5, 0.975)
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
    """The document of a run, and its sentences."""
    case, document = found.case, run_documents.document(found)
    rigidity = () if found.nut is None else found.nut.rigidity.assumed
    return {
        **document,
        "words": {
            "title": units.filled(case_messages.title(case)),
            "verdicts": [record["text"] for record in document["verdicts"]],
            "assumed": texts(case_messages.assumed(case, found.ball_to_ball_force)),
            "rigidity": list(rigidity),
            "rules": texts(makers.messages(case, found.nut)),
        },
    }


def texts(said: Sequence[Message]) -> list[str]:
    """Messages as the command line prints them."""
    return [units.filled(one) for one in said]


def check(found: runs.Run, notes: Sequence[str] = ()) -> dict[str, Any]:
    """The document of the checks of a run; a request has no name."""
    document = check_documents.document(checks.checked("", found.case, notes, known=found))
    return {key: value for key, value in document.items() if key != "name"}


def drawing(found: runs.Run) -> dict[str, Any]:
    """The ball between its grooves, as SVG."""
    from ballscrew.faces.report.drawing import drawing as drawn

    return {"text": drawn(found)}


def band(case: case_file.Case, found: bands.BandReport) -> dict[str, Any]:
    """The document of a band, and its sentences."""
    return {
        **band_documents.document(runs.run(case), found),
        "words": {
            "sentences": [verdict.text for verdict in band_documents.verdicts(case, found)],
            "inputs": units.filled(input_counts(found)),
        },
    }


def sensitivity(case: case_file.Case, report: SensitivityReport) -> dict[str, Any]:
    """The document of a sensitivity, and what people read of its inputs: meaning, field and interval."""
    result = report.result
    return {
        **sensitivity_documents.document(case, report),
        "display": {
            "meaning": result.quantity.info.meaning,
            "unit": result.quantity.unit,
            "shown_in": result.quantity.shown_in,
            "inputs": [_uncertain(case, report, name) for name in result.inputs],
        },
    }


def _uncertain(case: case_file.Case, report: SensitivityReport, name: str) -> dict[str, Any]:
    """An uncertain input: its field, and the interval that holds 95 % of it."""
    _, quantity = report.known[name]
    low, median, high = (float(report.uncertain[name].distribution.quantile(share)) for share in _INTERVAL)
    return {
        "name": name, "path": path_of(case, name), "meaning": report.describe(name), "unit": quantity.unit,
        "shown_in": quantity.shown_in, "low": low, "median": median, "high": high,
    }  # fmt: skip


def optimisation(found: Optimisation) -> dict[str, Any]:
    """The document of an optimisation, and all designs of the front by the search."""
    costs = {
        name: [OBJECTIVES[name].sign * float(one) for one in found.front.costs[:, place]]
        for place, name in enumerate(found.space.objectives)
    }
    return {
        **optimise_documents.document(found),
        "picture": {"front": costs},
    }
