"""Documents of the API for logs and hand-overs: those of the commands, with words, pictures and files beside them."""

from __future__ import annotations

import base64
import io
import tomllib
import zipfile
from collections.abc import Mapping
from pathlib import PurePosixPath
from typing import Any

from ballscrew.basis import units
from ballscrew.cases.case_files import fitted_case
from ballscrew.cases.case_files.case import Case
from ballscrew.evidence.service.condition_values import Condition
from ballscrew.exports.export import Export
from ballscrew.faces.web.documents import texts
from ballscrew.questions.condition import answer as condition_documents
from ballscrew.questions.condition import points as condition_points
from ballscrew.questions.fit import answer as fit_documents
from ballscrew.questions.fit import points as fit_points
from ballscrew.questions.fit import sheet as fit_sheet
from ballscrew.questions.fit.compute import FitReport
from ballscrew.questions.hand_over import document as hand_over_documents
from ballscrew.questions.hand_over import text as hand_over_text
from ballscrew.questions.service import answer as service_documents
from ballscrew.questions.service import points as service_points
from ballscrew.questions.service.compute import ServiceReport
from ballscrew.questions.service.sheet import causes, names


def fit(case: Case, tables: Mapping[str, Any], report: FitReport) -> dict[str, Any]:
    """The document of a fit, what it says in words, the rows to draw, and the case with the fitted numbers."""
    test = [] if report.next_test is None else fit_sheet.describe_next_test(report.next_test, report.model)
    calibrated = fitted_case.text_of(tables, case, report.model)
    return {
        **fit_documents.document(case, report),
        "words": {
            "title": fit_sheet.log_and_model(case, report),
            "trade_off": units.filled(fit_sheet.trade_off(report.model)),
            "next_test": texts(test),
            "rows": _of_rows(report),
        },
        "picture": fit_points.of_fit(report.model),
        "calibrated": {"toml": calibrated, "case": tomllib.loads(calibrated)},
    }


def _of_rows(report: FitReport) -> list[str]:
    """What was left out of the log and why, what is to be said of it, and what its torque was read as."""
    rows = report.model.rows
    left_out = [f"{reason}: {count}" for reason, count in rows.log.left_out.items()]
    return [*left_out, *rows.log.notes, rows.convention.description]


def service(case: Case, report: ServiceReport) -> dict[str, Any]:
    """The document of a service, what it says in words, and the curves to draw."""
    return {
        **service_documents.document(case, report),
        "words": {"title": ", ".join(names(report)), "causes": texts(causes(report))},
        "picture": service_points.of_service(report),
    }


def condition(case: Case, found: Condition) -> dict[str, Any]:
    """The document of a condition over time, and the curve of its trend."""
    trend = condition_points.trend_of(found)
    return {
        **condition_documents.document(case, found),
        "picture": {"trend": None if trend is None else trend.tolist()},
    }


def hand_over(case: Case, export: Export) -> dict[str, Any]:
    """The document of a hand-over, and its file: that of the target, or a zip archive of them all."""
    names = [PurePosixPath(name) for name in export.files]
    ranges = [line for heading, entries in hand_over_text.blocks(export) for line in (heading, *entries)]
    return {
        **hand_over_documents.document(export, case, names),
        "words": {"lines": hand_over_text.lines(export), "ranges": texts(ranges)},
        "file": _file(export),
    }


def _file(export: Export) -> dict[str, str]:
    """The only file of an export, or an archive of several."""
    if len(export.files) == 1:
        ((name, content),) = export.files.items()
        media = "application/octet-stream"
    else:
        name, media, content = f"{export.target}.zip", "application/zip", _archive(export.files)
    return {"name": name, "media_type": media, "base64": base64.b64encode(content).decode()}


def _archive(files: Mapping[str, bytes]) -> bytes:
    """A zip archive, the same bytes for the same files."""
    with io.BytesIO() as made:
        with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, content in files.items():
                archive.writestr(zipfile.ZipInfo(name), content, zipfile.ZIP_DEFLATED)
        return made.getvalue()
