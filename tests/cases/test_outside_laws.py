"""Laws from outside in a case: imported where it is allowed, and each thing that can be wrong in one line."""

import dataclasses
import shutil

import pytest

from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.descriptions import inputs

MODULE = """
import dataclasses
from typing import Annotated
from ballscrew.basis.quantities import Info, Ratio

number = 3
def half(conditions):
    return 1e-4 * conditions.contact_load

@dataclasses.dataclass(frozen=True)
class Share:
    share: Annotated[Ratio, Info("s", "share", at_least=0)]
    offset: float = 0.0
    def __call__(self, conditions):
        return self.share * conditions.contact_load + self.offset
"""


@pytest.fixture
def case(example, tmp_path):
    """A case with a module of laws beside it, and one that cannot be imported."""
    (tmp_path / "laws_of_a_test.py").write_text(MODULE, encoding="utf-8")
    (tmp_path / "broken_laws_of_a_test.py").write_text("1 / 0", encoding="utf-8")
    return shutil.copy(example, tmp_path / "case.toml")


def model_of(case, law, *more, allow_code=True):
    settings = ["model.name=reference", f"model.rolling={law}", *more]
    return case_file.load(case, settings, allow_code=allow_code).model


def test_a_function(case):
    model = model_of(case, "laws_of_a_test:half")
    assert model.rolling.__name__ == "half"
    loaded = case_file.load(case, ["model.name=reference", 'model.rolling="laws_of_a_test:half"'], allow_code=True)
    assert inputs(loaded)["model"]["rolling"] == "laws_of_a_test:half"


def test_a_dataclass_with_coefficients(case):
    law = model_of(case, '{law = "laws_of_a_test:Share", share = 0.1, offset = 2}').rolling
    assert dataclasses.asdict(law) == {"share": 0.1, "offset": 2}
    other = model_of(case, "laws_of_a_test:Share", "model.rolling.share=0.2").rolling
    assert other.share == 0.2


@pytest.mark.parametrize(
    ("law", "said"),
    [
        ("laws_of_a_test:hafl", 'laws_of_a_test has no hafl (laws_of_a_test:hafl) · did you mean "half"?'),
        ("no_such_module:half", "model.rolling: there is no module no_such_module (no_such_module:half) · put "
         "no_such_module.py beside the case or into the current folder"),
        ("laws_of_a_test:number", "model.rolling: is no law: it cannot be called"),
        ("laws_of_a_test:", "model.rolling: is no law of a module (laws_of_a_test:) · write"),
        ("laws_of_a_test:Share", "model.rolling.share: missing · add share = a number"),
        ('{law = "laws_of_a_test:Share", share = -1}', "model.rolling.share: must not be negative"),
        ('{law = "laws_of_a_test:Share", share = 1, offset = "2"}', "model.rolling.offset: must be a number"),
        ('{law = "laws_of_a_test:Share", share = 1, ofset = 2}', 'no coefficient of the law · did you mean "offset"?'),
        ('{law = "laws_of_a_test:half", share = 1}', "model.rolling.share: no coefficient of the law"),
        ("broken_laws_of_a_test:x", "its module cannot be imported: ZeroDivisionError: division by zero"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said_in_one_line(case, law, said):
    with pytest.raises(InputError) as caught:
        model_of(case, law)
    (line,) = caught.value.lines()
    assert said in line


def test_without_permission_nothing_is_imported(case):
    with pytest.raises(InputError, match=r"model\.rolling: is code from outside, which is not allowed .*--allow-code"):
        model_of(case, "broken_laws_of_a_test:x", allow_code=False)


def test_on_the_command_line(case, ballscrew):
    law = ("--set", "model.rolling=laws_of_a_test:half")
    refused = ballscrew("run", case, *law)
    assert (refused.returncode, refused.stdout) == (2, "")
    assert "add --allow-code" in refused.stderr
    found = ballscrew("run", case, *law, "--allow-code")
    assert found.returncode == 0, found.stderr
    assert "changed: rolling = laws_of_a_test:half" in found.stdout
    swept = ballscrew("sweep", case, *law, "--allow-code", "--verbose")
    assert swept.returncode == 0, swept.stderr
    assert "evaluated by numpy: " in swept.stderr


def test_modules_of_one_name_beside_two_cases_are_two_laws(tmp_path, example):
    """The later case gets its own law, not the one that was imported before."""
    found = []
    for share in (1, 2):
        folder = tmp_path / str(share)
        folder.mkdir()
        (folder / "law_of_two_cases.py").write_text(
            f"def rolling(conditions):\n    return {share} * conditions.contact_load * 1e-4\n", encoding="utf-8"
        )
        shutil.copy(example, folder / "case.toml")
        case = case_file.load(
            folder / "case.toml", ["model.rolling=law_of_two_cases:rolling"], "reference", allow_code=True
        )
        load, speed = case.operation.axial_load, case.operation.screw_speed
        result = case.model(case.screw, case.lubricant, axial_load=load, screw_speed=speed)
        found.append(float(result.screw.hydrodynamic_rolling_force / result.contact_load))
    assert found[0] <= 1e-4 < found[1] <= 2e-4  # a ball that skids carries less


def test_an_error_in_a_law_is_one_line(tmp_path, ballscrew, example):
    (tmp_path / "law_with_an_error.py").write_text(
        "def rolling(conditions):\n    raise KeyError('a')\n", encoding="utf-8"
    )
    process = ballscrew(
        "run", example, "--allow-code", "--model", "reference", "--set", "model.rolling=law_with_an_error:rolling"
    )
    assert process.returncode == 2
    (line,) = process.stderr.splitlines()
    assert line.startswith("model.rolling: law_with_an_error:rolling raised KeyError: 'a'")
