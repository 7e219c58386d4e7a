"""Every equation of the paper has an address, a function, and a test.

The rule: an address has one home, the function that is that equation. Another function may name it
only if it is listed here with its reason. No text in the package and no marker names an address
that does not exist.
"""

import ast
import re
from pathlib import Path

import pytest

import ballscrew
from ballscrew.basis.references import ADDRESS, addresses_in, paper_equations

PACKAGE = Path(ballscrew.__file__).parent
TESTS = Path(__file__).resolve().parents[2]

#: The paper's numbers as they stand in its sections; (22) to (26) occur twice.
SECTIONS = {
    "2.1": range(1, 14),
    "2.2": range(14, 22),
    "3": range(22, 26),
    "4": (26, 22),
    "5": range(23, 27),
    "6": range(27, 35),
    "7": (35, 36),
}

#: Functions that name an address without being its home, and why.
ALSO_NAMED_BY = {
    "Olaru2005 §2.1 (9)": {"transmission.contact_load": "the load that (9) needs and the paper does not print"},
    "Olaru2005 §2.2 (15)": {"slip.line_curvature_coefficient": "with spin; without it, it is (15)"},
    "Olaru2005 §2.2 (17)": {"slip.half_distance_of_lines": "with spin; without it, half the distance is the Y of (17)"},
    "Olaru2005 §4 (22)": {
        "film.literal_film_parameter": "(22) to the letter, next to what it must mean",
        "film.combined_roughness": "the denominator of (22) by itself",
    },
}

ADDRESSES = [equation.address for equation in paper_equations()]


def test_the_data_has_the_41_addresses():
    expected = [f"Olaru2005 §{section} ({number})" for section, numbers in SECTIONS.items() for number in numbers]
    assert expected == ADDRESSES
    assert len(set(ADDRESSES)) == 41


def test_every_equation_has_a_name_and_a_verdict():
    for equation in paper_equations():
        assert equation.what
        assert equation.verdict
        assert addresses_in(equation.address) == [equation.address]


@pytest.mark.parametrize("address", ADDRESSES)
def test_every_address_has_one_home(equation_table, address):
    named_by = set(equation_table.functions().get(address, []))
    guests = set(ALSO_NAMED_BY.get(address, {}))
    assert guests <= named_by, "listed, but does not name it"
    assert len(named_by - guests) == 1


def test_exceptions_are_of_known_addresses():
    assert set(ALSO_NAMED_BY) <= set(ADDRESSES)


def test_no_text_of_the_package_names_an_unknown_address():
    for path in sorted(PACKAGE.rglob("*.py")):
        named = addresses_in(path.read_text(encoding="utf-8"))
        assert set(named) <= set(ADDRESSES), path


def test_further_numbers_of_an_address_exist():
    # "Olaru2005 §5 (23)–(26)" and "Olaru2005 §6 (28) and (31)" name more than the first.
    further = re.compile(ADDRESS.pattern + r"(?P<more>(?:\s*(?:–|,|and)\s*\(\d+\))+)")
    for path in sorted(PACKAGE.rglob("*.py")):
        for match in further.finditer(path.read_text(encoding="utf-8")):
            for number in re.findall(r"\((\d+)\)", match["more"]):
                assert f"Olaru2005 §{match['section']} ({number})" in ADDRESSES, (path, match[0])


def test_every_section_that_is_named_exists():
    sections = {section.partition(".")[0] for section in SECTIONS} | set(SECTIONS) | {"1", "8", "9"}
    for path in sorted(PACKAGE.rglob("*.py")):
        for section in re.findall(r"Olaru2005\s+§([\d.]*\d)", path.read_text(encoding="utf-8")):
            assert section in sections, path


@pytest.mark.parametrize("address", ADDRESSES)
def test_every_address_is_checked_by_a_test(equation_table, address):
    assert equation_table.tests().get(address), f'no test is marked @pytest.mark.equation("{address}")'


def test_no_marker_names_an_unknown_address(equation_table):
    assert set(equation_table.tests()) <= set(ADDRESSES)


@pytest.mark.slow
def test_markers_stand_on_functions_only(equation_table):
    # Elsewhere (a class, a parameter, pytestmark) they would not be seen.
    for path in sorted(TESTS.rglob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        everywhere = sum(equation_table.is_marker(node) for node in ast.walk(tree))
        on_functions = sum(
            isinstance(decorator, ast.Call) and equation_table.is_marker(decorator.func)
            for node in tree.body
            if isinstance(node, ast.FunctionDef)
            for decorator in node.decorator_list
        )
        assert everywhere == on_functions, path
