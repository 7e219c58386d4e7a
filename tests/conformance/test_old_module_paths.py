"""Module paths of version 0.1 work for one release, each with a warning that names the new one."""

import importlib
import subprocess
import sys
import warnings

import pytest

from ballscrew._moved import moved_modules


@pytest.mark.parametrize("old", sorted(moved_modules()))
def test_an_old_path_leads_to_the_module(old):
    new = importlib.import_module(moved_modules()[old])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        importlib.import_module(old.rpartition(".")[0])  # a folder that has moved warns, too
    sys.modules.pop(old, None)
    with pytest.warns(DeprecationWarning, match=f"{old} is now {new.__name__}"):
        found = importlib.import_module(old)
    if hasattr(new, "__path__"):
        assert all(getattr(found, name) is value for name, value in vars(new).items() if not name.startswith("__"))
    else:
        assert found is new
    assert new.__spec__.name == new.__name__


def test_a_module_below_an_old_folder_hides_no_name_of_the_new_one():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        importlib.import_module("ballscrew.analyses.olaru2005.claims")
    assert callable(importlib.import_module("ballscrew.papers.olaru2005").claims)


def test_imports_from_old_folders():
    code = (
        "import warnings; warnings.simplefilter('ignore')\n"
        "from ballscrew.analyses.sweep import sweep; import ballscrew as bs; assert sweep is bs.sweep\n"
        "from ballscrew.interfaces import units; import ballscrew.model; assert units.shown\n"
        "assert ballscrew.model.FrictionModel is bs.FrictionModel\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_an_unknown_module_is_unknown():
    with pytest.raises(ModuleNotFoundError, match=r"No module named 'ballscrew\.analyses\.nonsense'"):
        importlib.import_module("ballscrew.analyses.nonsense")
