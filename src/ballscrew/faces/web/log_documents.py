"""Documents of the API for logs and hand-overs: those of the commands, with files beside them."""

from __future__ import annotations

import base64
import io
import tomllib
import zipfile
from collections.abc import Mapping
from pathlib import PurePosixPath
from typing import Any

from ballscrew.cases.case_files import fitted_case
from ballscrew.cases.case_files.case import Case
from ballscrew.exports.export import Export
from ballscrew.questions.fit import answer as fit_documents
from ballscrew.questions.fit.compute import FitReport
from ballscrew.questions.hand_over import document as hand_over_documents
from ballscrew.questions.hand_over import text as hand_over_text


def fit(case: Case, tables: Mapping[str, Any], report: FitReport) -> dict[str, Any]:
    """The document of a fit, and the case with the fitted numbers."""
    calibrated = fitted_case.text_of(tables, case, report.model)
    return {
        **fit_documents.document(case, report),
        "calibrated": {"toml": calibrated, "case": tomllib.loads(calibrated)},
    }


def hand_over(case: Case, export: Export) -> dict[str, Any]:
    """The document of a hand-over, and its file: that of the target, or a zip archive of them all."""
    names = [PurePosixPath(name) for name in export.files]
    ranges = [line for heading, entries in hand_over_text.blocks(export) for line in (heading, *entries)]
    return {
        **hand_over_documents.document(export, case, names),
        "words": {"lines": hand_over_text.lines(export), "ranges": ranges},
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
