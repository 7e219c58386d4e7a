"""The pages on theory: formulas, letters and units from the code, and no erratum without its section."""

import dataclasses
import importlib
import importlib.util
import inspect
import re
import sys

import pytest

from ballscrew.basis.quantities import unit_of
from support.rules import for_each

from .pages import DOCS, name, pages


def loaded(path):
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[path.stem] = module  # dataclasses look for their module there
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def equation(writer):
    return writer.equation


@pytest.fixture(scope="module")
def errata():
    sys.path.insert(0, str(DOCS))
    try:
        return loaded(DOCS / "errata_page.py")
    finally:
        sys.path.remove(str(DOCS))


MARK = re.compile(r"^<!-- equation: (\S+)(?:\nshow: [^\n]+)? -->$", re.MULTILINE)


def shown():
    """The functions whose formulas the pages show, by page."""
    for page in pages():
        for number, function in enumerate(MARK.findall(page.read_text(encoding="utf-8"))):
            yield f"{name(page)}:{number}", function


@pytest.mark.slow
@for_each(function=dict(shown()))
def test_formulas_have_their_letters_and_units(equation, function):
    module, _, called = function.rpartition(".")
    found = getattr(importlib.import_module(module), called)
    text = equation.as_markdown(function, "../")
    assert text.count("\n$$\n") == 2
    for parameter in inspect.signature(found).parameters:
        assert f"$ {parameter.replace('_', ' ')}" in text, parameter
    unit = unit_of(inspect.get_annotations(found, eval_str=True)["return"])
    assert unit == "1" or "the result (" in text


def test_letters_are_written_as_in_the_formula(equation):
    assert equation.tex("sigma_b", r"\sqrt{\sigma_b^2}") == r"\sigma_{b}"
    assert equation.tex("lam", "") == r"\lambda"
    assert equation.tex("E", r"\eta_0 v / E' R_x") == "E'"
    assert equation.tex("phi", r"\cos\varphi") == r"\varphi"
    assert equation.tex("F_Ss", "") == "F_{Ss}"


FILM = "ballscrew.physics.equations.film.film_parameter"


def test_a_page_chooses_what_it_shows_of_a_formula(equation):
    alone = equation.as_markdown(FILM, "../", ["formula"])
    assert alone.startswith("$$\n")
    assert "minimum film thickness" not in alone
    assert "**" not in alone
    assert "[`film.film_parameter`](../../src/" in alone
    with pytest.raises(ValueError, match="a formula has no colour"):
        equation.as_markdown(FILM, "../", ["colour"])


def test_a_letter_is_explained_once_while_it_means_the_same(equation):
    known = equation.letters(FILM)
    assert known["h"] == "minimum film thickness (m)"
    assert "$h$ minimum" not in equation.as_markdown(FILM, "../", known=known)
    assert "$h$ minimum" in equation.as_markdown(FILM, "../", known=known | {"h": "inlet film (m)"})


def test_a_section_explains_a_letter_once(writer):
    mark = f"<!-- equation: {FILM} -->\n<!-- end -->\n"
    page = writer.write.Written("theory/film", f"# A\n\n## B\n\n{mark}\n{mark}\n## C\n\n{mark}")
    # one block after the other: what a letter means depends on its place
    first, again, elsewhere = (page._written(block, iter(())) for block in page.blocks)
    assert "$h$ minimum" in first
    assert "$h$ minimum" not in again
    assert elsewhere == first


def test_a_function_without_a_formula_is_refused(equation):
    with pytest.raises(ValueError, match="no formula"):
        equation.as_markdown("ballscrew.physics.equations.hertz.ellipticity", "")


ERRATA = DOCS / "theory" / "errata.md"


def test_every_erratum_has_a_section_and_a_test(errata):
    assert errata.without_a_section() == []
    sections = ERRATA.read_text(encoding="utf-8").split("\n## ")[1:-1]
    assert len(sections) == len(errata.ERRATA)
    for section, key in zip(sections, errata.ERRATA, strict=True):
        assert f"<!--= errata_{key}_where-->" in section
        assert f"**Held by** <!--= errata_{key}_tests-->`test_" in section
        assert MARK.search(section.partition("**Right.**")[2]), key


def test_the_errata_add_up_to_the_corrected_model(errata):
    """Every repair between the two models has a section, but for the helix, which the page names before them."""
    page = ERRATA.read_text(encoding="utf-8")
    fields = {field.name for field in dataclasses.fields(errata.CORRECTED)} - {"name"}
    differ = {name for name in fields if getattr(errata.PRINTED, name) != getattr(errata.CORRECTED, name)}
    assert differ == set(errata.REPAIRS)
    assert "six of the points below, and the helix" in page
    assert len(differ) == 7
    repaired = {slot for _, slot in errata.ERRATA.values() if slot is not None}
    assert repaired == set(errata.REPAIRS) - {"frame", "ideal_torque"}
    for key, (_, slot) in errata.ERRATA.items():
        assert (f"<!--= errata_{key}_repair-->" in page) == (slot is not None)
    assert "virtual work" in page


def test_both_ellipses_lie_in_their_panel(monkeypatch):
    monkeypatch.syspath_prepend(str(DOCS))
    figure = importlib.import_module("theory_figures").ellipses()
    figure.draw_without_rendering()
    for panel in figure.axes[:2]:
        assert len(panel.patches) == 2
        low, high = panel.get_ylim()
        for ellipse in panel.patches:
            middle, height = ellipse.get_center()[1], ellipse.get_height()
            assert low < middle - height / 2 < middle + height / 2 < high
