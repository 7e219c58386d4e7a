"""The documentation builds offline, and runs the program for every figure and claim it shows."""

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "_ext"))

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
exclude_patterns = ["generated/**/claims.md"]
bibtex_bibfiles = [str(HERE.parent / "src/ballscrew/data/references.bib")]
autodoc_member_order = "bysource"
autodoc_typehints = "none"
suppress_warnings = ["myst.header"]  # the included claims start with a heading of their own


def reproduce(_app):
    """Figures and claims of the paper, as ``make demo`` writes them."""
    from ballscrew.interfaces.reproduce import reproduce_olaru2005

    reproduce_olaru2005(HERE / "generated" / "olaru2005")


def setup(app):
    app.connect("builder-inited", reproduce)
