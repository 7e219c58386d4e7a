"""Text of the chain of an axis on the terminal: a few places of the nut, what gives way there, and the verdicts."""

from __future__ import annotations

from ballscrew.basis import units
from ballscrew.basis.output.wrapping import aligned, wrapped
from ballscrew.cases.case_files import descriptions
from ballscrew.questions.axis.compute import FRICTION, SERIES, SPRINGS, ChainReport
from ballscrew.questions.shared.elements_text import element_lines
from ballscrew.questions.shared.text_tables import shown_or_dash

_SHORT = {"position": "nut at", "total": "rigidity", "lost_motion": "lost motion", "critical_speed": "critical speed",
          "buckling_load": "buckling load"}  # fmt: skip


def text(report: ChainReport) -> str:
    """A chain in full."""
    lines = [
        title(report),
        "",
        descriptions.design(report.case, plain_text=True),
        *element_lines(report.case),
        "",
        *_places(report),
        "",
        *_springs(report),
        "",
        *(record.text for record in report.verdicts),
        *(f"beware  {record.name}: {record.text}" for record in report.case.implausible()),
        "",
        "assumed",
        *(f"  {line}" for line in report.assumed),
    ]
    return "\n".join(line if "\n" in line else wrapped(line) for line in lines)


def title(report: ChainReport) -> str:
    """``fixed–supported shaft of 1100 mm, nut from 250 mm to 850 mm: double nut, preload 3500 N``."""
    installation, case = report.chain.installation, report.case
    length = units.shown(installation.unsupported_length, SERIES["position"])
    ends = " to ".join(units.shown(end, SERIES["position"]) for end in report.travel)
    nut = "" if case.nut is None else f": {descriptions.nut_text(case.nut)}"
    return f"{installation.ends.words} shaft of {length}, nut from {ends}{nut}"


def _places(report: ChainReport) -> list[str]:
    """One row for each place that is shown."""
    rows = place_rows(report)
    lines = aligned(rows)
    if len(rows[0]) < len(_SHORT):
        return lines
    return [*lines, note_of_lost_motion(report)]


def note_of_lost_motion(report: ChainReport) -> str:
    """What the lost motion of the table is made of; empty where the friction of the guides is not known."""
    if report.guide_friction != report.guide_friction:
        return ""
    is_preloaded = bool(getattr(report.case.nut, "preload", 0))
    backlash = "the preloaded nut has no backlash" if is_preloaded else "backlash comes on top"
    return f"lost motion from the {units.shown(report.guide_friction, FRICTION)} of the guides; {backlash}"


def place_rows(report: ChainReport) -> list[list[str]]:
    """Headings, and a row for each place that is shown."""
    names = [name for name in _SHORT if name != "lost_motion" or report.guide_friction == report.guide_friction]
    rows = [[_SHORT[name] for name in names]]
    return rows + [
        [shown_or_dash(float(report.series[name][at]), SERIES[name]) for name in names] for at in report.shown
    ]


def _springs(report: ChainReport) -> list[str]:
    """What each spring has, and its share, at the places that are shown."""
    heads, *rows = spring_rows(report)
    return aligned([heads, *([f"  {name}", *cells] for name, *cells in rows)])


def spring_rows(report: ChainReport) -> list[list[str]]:
    """Headings, and a row for each spring that is known."""
    shares = report.chain.shares
    known = [name for name in SPRINGS if shares[name].any()]
    places = (units.shown(float(report.chain.position[at]), SERIES["position"]) for at in report.shown)
    rows = [["rigidity, share of the compliance", *places]]
    for name in known:
        springs = ((float(report.series[name][at]), float(shares[name][at])) for at in report.shown)
        rows.append([name, *(f"{shown_or_dash(spring, SERIES[name])} {share:4.0%}" for spring, share in springs)])
    return rows
