"""A report as one HTML file that asks for nothing from outside."""

from __future__ import annotations

from importlib import resources

from ballscrew.questions.shared.report_blocks import Report, as_data


def html_bytes(report: Report) -> bytes:
    """The report as an HTML file; every text in it is escaped. Needs the extra ``report``."""
    import jinja2
    from markupsafe import Markup

    template = (
        resources.files("ballscrew.faces.report").joinpath("templates", "report.html").read_text(encoding="utf-8")
    )
    environment = jinja2.Environment(
        autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True, newline_sequence="\n"
    )
    # drawings come from this package, which escapes what is written in them
    environment.filters["drawn"] = Markup
    return environment.from_string(template).render(report=as_data(report)).encode()
