"""Sphinx configuration: builds offline; the program computes every figure, table and claim."""

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE / "_ext"), str(HERE), str(HERE.parent / "tests")]

import ballscrew  # noqa: E402  (after the path of the extension)
import bearing_comparison  # noqa: E402  (likewise)
import duty_examples  # noqa: E402  (likewise)
import effect_tables  # noqa: E402  (likewise)
import theory_numbers  # noqa: E402  (likewise)
import validation_tables  # noqa: E402  (likewise)

project = "ballscrew"
author = "The ballscrew authors"
copyright = "2026, the ballscrew authors"
version = release = ballscrew.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
    "sphinxcontrib.bibtex",
    "mathml",
    "command",
    "equation",
]
myst_enable_extensions = ["dollarmath", "colon_fence", "deflist", "substitution"]
myst_heading_anchors = 3
myst_substitutions = {**effect_tables.numbers(), **validation_tables.numbers(), **theory_numbers.numbers()}
html_math_renderer = "mathml"
html_theme = "furo"
html_title = "ballscrew"
html_static_path = ["_static"]
html_css_files = ["tables.css", "theory.css"]
exclude_patterns = ["generated/**"]
bibtex_bibfiles = [str(HERE.parent / "src/ballscrew/data/references.bib")]
autodoc_member_order = "bysource"
autodoc_typehints = "none"
suppress_warnings = ["myst.header"]  # the included claims start with a heading of their own


def generate(_app):
    """Write included parts: claims and figures of the paper, effects, laws, fields, accuracy, bands, heat, fits."""
    import accuracy_table
    import api_tables
    import calibration_pages
    import errata_page
    import law_tables
    import nut_tables
    import sensitivity_figures
    import starvation_tables
    import theory_figures
    import uncertainty_tables
    import warm_up_tables
    from ballscrew.faces.cli.reproduction import reproduce_olaru2005
    from card_table import tables as card_tables
    from column_table import column_table
    from field_table import field_table

    generated = HERE / "generated"
    generated.mkdir(exist_ok=True)
    pages = {
        "cards.md": card_tables(),
        "columns.md": column_table(),
        "fields.md": field_table(),
        "slots.md": law_tables.slots_table(),
        "laws.md": law_tables.laws_table(),
        "accuracy.md": accuracy_table.page(),
        "duty_examples.md": duty_examples.table(),
    }
    for name, text in pages.items():
        (generated / name).write_text(text, encoding="utf-8")
    effect_tables.write(generated / "effects")
    nut_tables.write(generated / "nuts")
    validation_tables.write(generated / "validation")
    bearing_comparison.write(generated / "validation")
    uncertainty_tables.write(generated / "uncertainty")
    warm_up_tables.write(generated / "warm_up")
    starvation_tables.write(generated / "starvation")
    sensitivity_figures.write(generated / "sensitivity")
    calibration_pages.write(generated / "calibration")
    theory_figures.write(generated / "theory")
    api_tables.write(generated / "api")
    errata_page.write(generated / "theory")
    reproduce_olaru2005(generated / "olaru2005")


def setup(app):
    app.connect("builder-inited", generate)
