"""Logs for tests of ``ballscrew fit``."""

import sys
from types import SimpleNamespace

import pytest

from ballscrew.faces.cli import main
from support.fit_logs import PAPER, columns, text_of


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    path = tmp_path_factory.mktemp("case") / "paper.toml"
    path.write_text(PAPER, encoding="utf-8")
    return path


@pytest.fixture
def log(tmp_path):
    """Write columns as a file; without any, a good log."""

    def write(data=None, name="log.csv", **headings):
        path = tmp_path / name
        path.write_text(text_of(columns() if data is None else data, **headings), encoding="utf-8")
        return path

    return write


@pytest.fixture
def fit(case, tmp_path, monkeypatch, capfd):
    """The command as it is typed, in an empty folder of its own; in this process."""
    place = tmp_path / "here"
    place.mkdir()

    def command(path, *options, case=case):
        monkeypatch.chdir(place)
        monkeypatch.setenv("COLUMNS", "160")
        monkeypatch.setattr(sys, "argv", ["ballscrew", "fit", str(path), "--case", str(case), *map(str, options)])
        capfd.readouterr()
        try:
            main.main()
            code = 0
        except SystemExit as leaving:
            code = leaving.code or 0
        said = capfd.readouterr()
        return SimpleNamespace(returncode=code, stdout=said.out, stderr=said.err, place=place)

    return command
