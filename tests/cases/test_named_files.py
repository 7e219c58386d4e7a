"""Files that a case names, where the case goes to another folder."""

from ballscrew.cases.case_files.opened_file import moved


def test_every_named_file_is_the_same_from_the_other_folder(tmp_path):
    old, new = tmp_path / "needs", tmp_path / "out" / "cases"
    tables = {
        "screw": {"catalogue": "a", "catalogue_file": "own.csv", "profile": "own.csv"},
        "bearings": {"fixed": {"oil": "b", "oil_file": "../oils.toml"}},
        "motion": {"file": "cycle.csv", "segment": [{"name": "up"}]},
        "lubricant": {"oil_file": str(tmp_path / "absolute.toml")},
    }
    found = moved(tables, old, new)
    assert found["screw"] == {"catalogue": "a", "catalogue_file": "../../needs/own.csv", "profile": "own.csv"}
    assert found["bearings"]["fixed"]["oil_file"] == "../../oils.toml"
    assert found["motion"] == {"file": "../../needs/cycle.csv", "segment": [{"name": "up"}]}
    assert found["lubricant"] == tables["lubricant"], "an absolute path stays"
    assert moved(found, new, old) == {**tables, "bearings": {"fixed": {"oil": "b", "oil_file": "../oils.toml"}}}
