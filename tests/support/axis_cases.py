"""Cases of axes."""

from collections.abc import Sequence
from pathlib import Path

from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case import Case
from ballscrew.questions.axis import answer


def load(path: Path, settings: Sequence[str] = ()) -> Case:
    """The case of a file as ``ballscrew axis`` reads it."""
    tables = case_file.override(case_file.read(path), settings)
    return case_file.build(tables, folder=path.parent, moves=answer.moves(tables))
