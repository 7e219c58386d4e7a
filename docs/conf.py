"""The documentation builds offline, and runs the program for every figure and claim it shows."""

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE / "_ext"), str(HERE)]

import ballscrew  # noqa: E402  (after the path of the extension)

project = "ballscrew"
author = "The ballscrew authors"
copyright = "2026, the ballscrew authors"
version = release = ballscrew.__version__

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinxcontrib.bibtex", "mathml"]
myst_enable_extensions = ["dollarmath", "colon_fence", "deflist"]
myst_heading_anchors = 3
html_math_renderer = "mathml"
html_theme = "furo"
html_title = "ballscrew"
html_static_path = ["_static"]
html_css_files = ["tables.css"]
exclude_patterns = ["generated/**"]
bibtex_bibfiles = [str(HERE.parent / "src/ballscrew/data/references.bib")]
autodoc_member_order = "bysource"
autodoc_typehints = "none"
suppress_warnings = ["myst.header"]  # the included claims start with a heading of their own


def reproduce(_app):
    """Figures and claims of the paper, as ``make demo`` writes them, and the fields of a case file."""
    from ballscrew.interfaces.reproduce import reproduce_olaru2005
    from field_table import field_table

    generated = HERE / "generated"
    generated.mkdir(exist_ok=True)
    (generated / "fields.md").write_text(field_table(), encoding="utf-8")
    reproduce_olaru2005(HERE / "generated" / "olaru2005")


def setup(app):
    app.connect("builder-inited", reproduce)
