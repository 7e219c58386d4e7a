"""The README shows what the program gives today."""

import importlib.util
from pathlib import Path

ROOT = Path(__file__).parents[2]


def make_readme():
    spec = importlib.util.spec_from_file_location("make_readme", ROOT / "docs" / "make_readme.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_table_of_claims_is_up_to_date():
    """If this fails, run ``make readme``."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert make_readme().with_claims(text) == text


def test_the_python_example_runs(capsys):
    """The ten lines of the README, as they stand there."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    code = text.split("```python\n")[1].split("```")[0]
    assert len(code.splitlines()) <= 10
    exec(compile(code, "README.md", "exec"), {})
    assert "hydrodynamic_rolling" in capsys.readouterr().out
