"""Workflows, forms and settings of the repository: YAML that agrees with pyproject.toml and with what is here."""

import json
import re
import tomllib
from pathlib import Path

import pytest
import yaml

from ballscrew.faces.web import openapi
from ballscrew.faces.web.server import application
from support.tools import tool

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
YAML = [*sorted((ROOT / ".github").rglob("*.yml")), ROOT / ".pre-commit-config.yaml", ROOT / "CITATION.cff"]
pytestmark = pytest.mark.skipif(not WORKFLOWS, reason="a source distribution has no workflows")


def text(path):
    return path.read_text(encoding="utf-8")


def read(path):
    return yaml.safe_load(text(path))


def jobs():
    return [(path, name, job) for path in WORKFLOWS for name, job in read(path)["jobs"].items()]


def steps():
    return [(path, step) for path, _, job in jobs() for step in job["steps"]]


@pytest.fixture(scope="module")
def configuration():
    with tool("release", "configuration") as (found,):
        yield found


@pytest.mark.parametrize("path", YAML, ids=[path.name for path in YAML])
def test_it_is_yaml_without_a_key_twice(configuration, path):
    assert configuration.fault(path) == ""


@pytest.mark.parametrize(
    ("name", "written", "said"),
    [
        ("a.yml", "on: push\njobs: {}\non: pull\n", "stands twice"),
        ("a.yaml", "abstract: friction: torque\n", "mapping values are not allowed"),
        ("a.toml", "a = 1\na = 2\n", "a.toml"),
    ],
)
def test_a_file_that_cannot_be_read_is_named(configuration, tmp_path, capsys, name, written, said):
    path = tmp_path / name
    path.write_text(written, encoding="utf-8")
    assert configuration.main([str(path)]) == 1
    assert said in capsys.readouterr().err


def test_tests_run_on_the_versions_of_python_that_are_claimed_and_no_others():
    tests = read(ROOT / ".github" / "workflows" / "test.yml")["jobs"]["tests"]["strategy"]["matrix"]
    claimed = [found[1] for line in PROJECT["classifiers"] if (found := re.search(r":: (3\.\d+)$", line))]
    assert tests["python"] == claimed
    assert PROJECT["requires-python"] == f">={claimed[0]}"
    assert {name.partition("-")[0] for name in tests["system"]} == {"ubuntu", "macos", "windows"}


def test_trials_of_the_wheel_try_the_same_versions_and_all_extras():
    with tool("release", "trials") as (trials,):
        claimed = [found[1] for line in PROJECT["classifiers"] if (found := re.search(r":: (3\.\d+)$", line))]
        assert list(trials.PYTHONS) == claimed
        assert f"ballscrew[{','.join(trials.ALL)}]" in PROJECT["optional-dependencies"]["all"]
        assert {extra for probe in trials.PROBES.values() for extra in probe.extras} == set(trials.ALL)


def test_actions_are_pinned_by_digest_and_say_their_version():
    for path in WORKFLOWS:
        used = re.findall(r"uses: (\S+)(.*)", text(path))
        assert used
        for action, comment in used:
            assert re.fullmatch(r"[\w-]+/[\w-]+@[0-9a-f]{40}", action), f"{path.name}: {action}"
            assert re.fullmatch(r" # v\d+\.\d+\.\d+", comment), f"{path.name}: {action}{comment}"
    digests = [re.findall(r"uses: (\S+)@(\S+)", text(path)) for path in WORKFLOWS]
    assert len({one for each in digests for one in each}) == len({name for each in digests for name, _ in each})


def test_rights_are_given_to_jobs_alone_and_only_those_that_publish_write():
    for path in WORKFLOWS:
        assert read(path)["permissions"] == {}
    writing = {
        (path.stem, name): {right for right, kind in job["permissions"].items() if kind == "write"}
        for path, name, job in jobs()
    }
    assert {key: rights for key, rights in writing.items() if rights} == {
        ("docs", "publish"): {"pages", "id-token"},
        ("release", "build"): {"id-token", "attestations"},
        ("release", "publish"): {"id-token"},
    }


def test_no_job_runs_forever_or_keeps_a_token_in_its_clone():
    assert all(job["timeout-minutes"] <= 90 for _, _, job in jobs())
    clones = [step for _, step in steps() if step.get("uses", "").startswith("actions/checkout@")]
    assert clones
    assert all(step["with"] == {"persist-credentials": False} for step in clones)


def test_no_step_puts_what_others_write_into_a_shell():
    assert [step["run"] for _, step in steps() if "${{" in step.get("run", "")] == []


def test_targets_of_make_that_workflows_call_exist():
    makefile = text(ROOT / "Makefile")
    called = {
        target
        for path in WORKFLOWS
        for line in re.findall(r"(?:run: |^\s+)make ([^\n&|]+)", text(path), re.MULTILINE)
        for target in line.split()
        if "=" not in target
    }
    assert called >= {"dist", "docs", "floors", "workflows"}
    for target in called:
        assert re.search(rf"^{re.escape(target)}:", makefile, re.MULTILINE), target


def test_a_release_is_built_where_its_library_was_built():
    tests, release = (read(ROOT / ".github" / "workflows" / f"{name}.yml")["jobs"] for name in ("test", "release"))
    assert tests["distribution"]["container"] == release["build"]["container"] == "python:3.11-bookworm"
    library = ROOT / "src" / "ballscrew" / "data" / "exports" / "linux64" / "ballscrew.so"
    assert b"GCC: (Debian 12." in library.read_bytes()  # Debian 12 is bookworm


def test_forms_ask_for_something_and_each_question_has_a_name_of_its_own():
    forms = [path for path in (ROOT / ".github" / "ISSUE_TEMPLATE").glob("*.yml") if path.name != "config.yml"]
    assert {path.stem for path in forms} == {"bug", "torque_card", "validation_row"}
    for path in forms:
        asked = [part for part in read(path)["body"] if part["type"] != "markdown"]
        assert len({part["id"] for part in asked}) == len(asked) > 2
        assert any(part.get("validations", {}).get("required") for part in asked)


def test_the_image_serves_as_nobody_and_is_asked_at_an_address_that_exists():
    steps = text(ROOT / "Containerfile")
    (user,) = re.findall(r"^USER (\d+):\d+$", steps, re.MULTILINE)
    assert int(user) > 0
    (asked,) = re.findall(r"urlopen\('http://127\.0\.0\.1:8017/api/v1(/[a-z-]+)'", steps)
    assert f"/api/v1{asked}" in openapi.document(application())["paths"]
    assert re.findall(r"^EXPOSE (\d+)$", steps, re.MULTILINE) == ["8017"]


def test_the_image_has_the_versions_of_the_tests():
    def pins(path):
        return set(re.findall(r"^([\w.-]+==\S+)", text(ROOT / path), re.MULTILINE))

    image = pins("tools/container/requirements.txt")
    assert {pin.partition("==")[0] for pin in image} >= {"numpy", "fastapi", "uvicorn", "llvmlite", "typst"}
    assert image <= pins("constraints.txt")


def test_the_container_to_develop_in_has_the_first_python():
    found = json.loads(text(ROOT / ".devcontainer" / "devcontainer.json"))
    assert PROJECT["requires-python"].removeprefix(">=") in found["image"]
    assert found["updateContentCommand"] == "make .venv/.ready"
    assert (ROOT / "Makefile").is_file()


def test_hooks_call_what_the_environment_has():
    (local,) = read(ROOT / ".pre-commit-config.yaml")["repos"]
    named = {hook["entry"].split()[0] for hook in local["hooks"]}
    assert named == {f".venv/bin/{name}" for name in ("ruff", "basedpyright", "lint-imports", "python")}


def test_the_citation_has_the_version_of_the_package():
    from ballscrew.basis.version import __version__

    found = read(ROOT / "CITATION.cff")
    assert found["version"] == __version__
    assert found.get("repository-code", PROJECT["urls"]["Source"]) == PROJECT["urls"]["Source"]
