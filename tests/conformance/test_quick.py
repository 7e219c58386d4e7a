"""The tests that ``make quick`` chooses, of a map made up by hand."""

import pytest

from support.tools import tool

#: Tests, the seconds of each, and which run a function of the film, or one that all of them run.
TESTS = [
    "tests/a/test_film.py::one",
    "tests/a/test_film.py::two",
    "tests/b/test_wide.py::one",
    "tests/b/test_wide.py::two",
]
FILM, ALL = "physics/equations/film.py:thickness", "basis/arrays.py:where"


@pytest.fixture(scope="module")
def quick():
    """The module that chooses."""
    with tool("mutation", "reach", "quick") as (_, found):
        yield found


@pytest.fixture
def reach(quick):
    """The tests of ``test_film.py`` run more else than those of ``test_wide.py``."""
    more = {f"physics/solvers/other.py:f{number}": [0, 1] for number in range(3)}
    return quick.Reach(TESTS, [2.0, 2.0, 2.0, 2.0], {FILM: [0, 1, 2, 3], ALL: [0, 1, 2, 3], **more})


def test_tests_named_after_the_change_come_before_those_that_run_least_else(quick, reach):
    assert quick.chosen(reach, [FILM], [], 4.0).tests == [TESTS[0], TESTS[2]]
    assert quick.chosen(reach, [ALL], [], 4.0).tests == [TESTS[2], TESTS[0]]
    # they fill half of the budget, and take their turn for the other half
    assert quick.chosen(reach, [FILM], [], 8.0).tests == TESTS
    assert quick.chosen(reach, [FILM], [], 2.0).tests == [TESTS[2]]


def test_what_is_left_out_is_counted(quick, reach):
    found = quick.chosen(reach, [FILM], [], 4.0)
    assert (found.seconds, found.left, found.seconds_left) == (4.0, 2, 4.0)


def test_changed_tests_come_first_and_whole(quick, reach):
    found = quick.chosen(reach, [FILM], ["tests/b/test_wide.py"], 6.0)
    assert found.tests == ["tests/b/test_wide.py", TESTS[0]]
    assert found.seconds == 6.0


@pytest.mark.parametrize(
    ("file", "function", "named"),
    [
        ("tests/physics/equations/test_film.py", FILM, True),
        ("tests/faces/cli/test_sweep_band.py", "questions/sweep/band.py:with_band", True),
        ("tests/faces/cli/test_sweep.py", "questions/sweep/band.py:with_band", False),
        ("tests/physics/test_films.py", FILM, False),
    ],
)
def test_names(quick, file, function, named):
    assert quick.is_named_after(file, [function]) is named


def test_functions_by_the_lines_that_they_stand_in(quick):
    lines = ["a = 1", "def f():", "    return 1", "class C:", "    b = 2", "    def g(self):", "        def h():"]
    text = "\n".join([*lines, "            pass", "        return h", ""])
    names = quick.functions_of(text)
    assert [names[line] for line in (1, 3, 5, 8, 9)] == ["<module>", "f", "<module>", "C.g.h", "C.g"]
