"""Reproduce a paper into a folder: figures, their numbers, all data, the claims with their verdicts, and a real nut.

Everything is written beside its place first and moved there once complete, so that a failure or
Ctrl-C leaves the folder as it was. The same bytes come out on every run.
"""

from __future__ import annotations

import collections
import contextlib
import csv
import importlib.util
import io
import shutil
import tempfile
from collections.abc import Callable, Generator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ballscrew.basis.atomic_files import write_error
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.output.sheet import sentence
from ballscrew.basis.references import paper_equations
from ballscrew.basis.version import __version__
from ballscrew.evidence.papers import olaru2005
from ballscrew.questions.reproduce import preloaded_nut
from ballscrew.questions.shared.text_tables import markdown_table

Report = Callable[[str, int, int], None]

_MODELS = ("olaru2005", "corrected")
_LITERAL = "olaru2005-literal"
_LABELS = ("as printed", "corrected", "to the letter")
_COUNTED = (olaru2005.Verdict.HOLDS, olaru2005.Verdict.FAILS, olaru2005.Verdict.OPEN)
_WORDS = {olaru2005.Verdict.HOLDS: "yes", olaru2005.Verdict.FAILS: "no", olaru2005.Verdict.OPEN: "cannot be checked"}
#: Symbols of the claims.
_SYMBOLS = (
    ("Y", "offset of the lines of pure rolling from the middle of the contact, as a share of its semi-axis"),
    ("λ", "film parameter: film thickness over roughness"),
    ("µ_a, µ_m, µ0", "coefficients of friction: of touching asperities, of the whole contact, at rest"),
    ("F_S", "sliding force in a contact"),
    ("F_B", "force between neighbouring balls"),
    ("z", "number of loaded balls"),
    ("Q", "contact load of one ball; the paper's 4000 N on the nut are 101 N a ball"),
    ("M_S, M_N", "friction torque on the screw, on the nut"),
    ("η", "efficiency, screw driving"),
    ("d_m", "pitch circle diameter"),
)


class Reproduced(NamedTuple):
    """The files that were written, and what is said of them on the terminal."""

    files: list[Path]
    summary: list[str]


def reproduce_olaru2005(out: Path, report: Report | None = None) -> Reproduced:
    """Write figures, data and claims of Olaru2005 into a folder, and a preloaded nut by the reference model.

    ``report(what, done, total)`` is told each step. Raises
    :class:`~ballscrew.basis.errors.InputError` before any work if the folder cannot be written or the
    libraries for NetCDF are missing.
    """
    if importlib.util.find_spec("h5netcdf") is None or importlib.util.find_spec("h5py") is None:
        raise InputError(Fault("reproduce.data", "needs h5netcdf", "", 'pip install "ballscrew[data]"'))
    with _whole_folder(Path(out)) as folder:
        summary = _write(folder, report or _silent)
        names = sorted(path.name for path in folder.iterdir())
    return Reproduced([Path(out) / name for name in names], summary)


def _silent(what: str, done: int, total: int) -> None:
    """Report to nobody."""


@contextlib.contextmanager
def _whole_folder(out: Path) -> Generator[Path]:
    """A folder beside (or, where it exists, in) ``out`` whose files move to ``out`` once all went well."""
    # in the folder itself if it is there: it may be a file system of its own
    anchor = out
    while not anchor.exists() and anchor != anchor.parent:
        anchor = anchor.parent
    try:
        if not anchor.is_dir():
            raise NotADirectoryError(20, "is not a folder", str(anchor))
        temporary = Path(tempfile.mkdtemp(dir=anchor, prefix=f".{out.name}."))
    except OSError as error:
        raise write_error("reproduce.out", out, error) from None
    try:
        yield temporary
        names = sorted(path.name for path in temporary.iterdir())
        out.mkdir(parents=True, exist_ok=True)
        occupied = [name for name in names if (out / name).is_dir()]
        if occupied:
            raise IsADirectoryError(21, f"{occupied[0]} is a folder")
        for name in names:
            (temporary / name).replace(out / name)
    except OSError as error:
        raise write_error("reproduce.out", out, error) from None
    finally:
        shutil.rmtree(temporary, ignore_errors=True)


def _write(folder: Path, report: Report) -> list[str]:
    # matplotlib takes its time: only once the folder is known to be writable
    from ballscrew.questions.reproduce import ball_figure, figure
    from ballscrew.questions.shared import charts

    total, done = len(ball_figure.PLOTS) + len(figure.PLOTS) + 5, 0

    def step(what: str) -> None:
        nonlocal done
        done += 1
        report(what, done, total)

    data = olaru2005.curves()
    # in memory first: on a full disk HDF5 ends worse than in an OSError
    (folder / "data.nc").write_bytes(data.to_netcdf(engine="h5netcdf"))
    step("curves of the figures")
    result, checks = olaru2005.claims(), olaru2005.closure_checks()
    step("claims of the paper")
    nut = preloaded_nut.preloaded_nut()
    step("a preloaded nut by the reference model")
    with charts.house_style():
        results = ball_figure.drawn_results()
        drawings: list[tuple[charts.Plot, Any]] = [(plot, results) for plot in ball_figure.PLOTS]
        drawings += [(plot, data) for plot in figure.PLOTS]
        names = [plot.name for plot, _ in drawings]
        drawings.append((figure.PLOT, nut))
        for plot, source in drawings:
            charts.save(plot.draw(source), folder, plot.name)
            _write_text(folder / f"{plot.name}.csv", _csv(plot.table(source)))
            step(plot.name)
    _write_text(folder / preloaded_nut.CASE_FILE, preloaded_nut.CASE)
    _write_text(folder / preloaded_nut.PAGE_FILE, preloaded_nut.page(nut))
    _write_text(folder / "claims.md", claims_document(result, checks, names))
    step("claims.md")
    return [f"The paper: {counts(result)}.", *preloaded_nut.lines(nut)]


def _write_text(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8", newline="\n")


def _csv(columns: Mapping[str, Any]) -> str:
    """Columns as CSV, ten digits."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(zip(*([_cell(v) for v in column] for column in columns.values()), strict=True))
    return text.getvalue()


def _cell(value: Any) -> str:
    return f"{value:.10g}" if isinstance(value, float | int | np.number) else str(value)


# -- words ----------------------------------------------------------------------------------------


def claims_table(claims: Sequence[olaru2005.Claim]) -> str:
    """The claims as a table in Markdown, in the paper's order."""
    rows = [
        (claim.claim, claim.paper, *(claim.findings[name].short for name in _MODELS), _holds(claim)) for claim in claims
    ]
    return markdown_table(("claim", "paper", "as printed", "corrected", "holds?"), rows)


def _holds(claim: olaru2005.Claim) -> str:
    """One word if both models agree, else one for each."""
    printed, corrected = (_WORDS[claim.findings[name].verdict] for name in _MODELS)
    return printed if printed == corrected else f"{printed} (corrected: {corrected})"


def claims_document(
    claims: Sequence[olaru2005.Claim], checks: Sequence[olaru2005.ClosureCheck], figures: Sequence[str] = ()
) -> str:
    """All of it in words: claims, choices, other readings, and the verdict on each equation."""
    sections = [
        "# Olaru et al. 2005, reproduced\n",
        f"Written by ballscrew {__version__}. Every number and verdict below is computed from the "
        "models; the criterion of each verdict stands with the details. *As printed* is the model "
        "`olaru2005`, *corrected* is `corrected`, *to the letter* is `olaru2005-literal`, which also leaves out the "
        "square root of (22) in §4.\n",
        "No value can be read off the paper's figures, so curves are compared with its text only.\n",
        "## What holds, and what it means\n",
        f"{sentence(counts(claims))}.\n",
        _meaning(claims),
        "## Claims\n",
        claims_table(claims),
        "Numbers in brackets are equations of the paper.\n",
        markdown_table(("symbol", "meaning"), _SYMBOLS),
        "## Claims in detail\n",
        *(_detail(claim) for claim in claims),
        "## What the paper leaves open, and what was taken\n",
        markdown_table(("what", "taken", "why"), [(c.what, c.taken, c.why) for c in olaru2005.CHOICES]),
        "## Other readings of what it leaves open\n",
        "A reading under which all these claims hold is *consistent with* the text. It is not verified by that: "
        "more than one reading can be consistent, and the figures cannot be read off.\n",
        _readings(checks),
        "## One repair at a time\n",
        "Friction torque on the screw and efficiency at 4000 N and 600 rpm, each repair alone in the printed model, "
        "and all so far, down to the corrected one.\n",
        _repairs(),
        "## The numbered equations\n",
        "The numbers (22) to (26) occur twice in the paper, so the section belongs to the address.\n",
        markdown_table(
            ("address", "what", "verdict"),
            [(equation.address, equation.what, equation.verdict) for equation in paper_equations()],
        ),
    ]
    if figures:
        sections += [
            "## Figures\n",
            "Each as SVG and PNG, with its numbers as CSV; `data.nc` holds all curves in SI.\n",
            *(
                f"![{name.replace('_', ' ')}]({name}.svg)\n\n`{name}.svg`, `{name}.png`, `{name}.csv`\n"
                for name in figures
            ),
        ]
    return "\n".join(sections)


def counts(claims: Sequence[olaru2005.Claim]) -> str:
    """``as printed, 13 of 22 claims hold, 5 do not hold and 4 cannot be checked; corrected, 11, 7 and 4``."""
    tallies = [collections.Counter(claim.findings[name].verdict for claim in claims) for name in _MODELS]
    printed, corrected = ([tally[verdict] for verdict in _COUNTED] for tally in tallies)
    return (
        f"{_LABELS[0]}, {printed[0]} of {len(claims)} claims hold, {printed[1]} do not hold and {printed[2]} cannot be "
        "checked; "
        f"{_LABELS[1]}, {corrected[0]}, {corrected[1]} and {corrected[2]}"
    )


def _meaning(claims: Sequence[olaru2005.Claim]) -> str:
    """Meaning of the verdicts for a reader who wants to use the paper."""
    shown = {claim.key: [claim.findings[name].short for name in _MODELS] for claim in claims}
    stated = {claim.key: claim.paper for claim in claims}
    (minimum, corrected_minimum), (efficiency, corrected), (film, _) = (
        shown[key] for key in ("minimum", "efficiency", "threshold")
    )
    return (
        "The equations of the paper give the course of the torque that it describes over speed and load, and only some "
        f"of its numbers: the least torque lies at {minimum} as printed and {corrected_minimum} corrected "
        f"(paper: {stated['minimum']}), the efficiency is {efficiency} and {corrected} "
        f"(paper: {stated['efficiency']}), and the film takes over at {film} (paper: {stated['threshold']}). "
        "Whether they agree with measurements cannot be checked, as the paper prints no measured value: a claim that "
        "holds follows from the equations, which does not make it true of a screw. To compute a machine take the model "
        f"`reference`; `{preloaded_nut.PAGE_FILE}` beside this file has it on a preloaded nut.\n"
    )


def _detail(claim: olaru2005.Claim) -> str:
    findings = [(label, claim.findings[name]) for label, name in zip(_LABELS, (*_MODELS, _LITERAL), strict=True)]
    words = f" {claim.remark}" if claim.remark else ""
    return (
        f"**{claim.section}: {claim.claim}** (paper: {claim.paper}). Criterion: {claim.criterion}.{words}\n\n"
        + "".join(f"- {label}: {finding.text}: *{finding.verdict}*\n" for label, finding in findings)
    )


def _readings(checks: Sequence[olaru2005.ClosureCheck]) -> str:
    heading = ("reading", "minimum", "η over speed", "η at 20 N", "η above 20 N", "split 1/z", "split 2/z", "verdict")
    keys = ("minimum", "efficiency", "first_zone", "second_zone", "split_one", "split_two")
    rows = [
        (
            f"{check.reading.name}: {check.reading.description}",
            *(_marked(check.findings[key]) for key in keys),
            "consistent with the text" if check.consistent else "not consistent with all of it",
        )
        for check in checks
    ]
    return markdown_table(heading, rows)


def _repairs() -> str:
    rows = [
        (
            r.description,
            *(f"{value:.4f}" for value in (r.torque_alone, r.efficiency_alone, r.torque_so_far, r.efficiency_so_far)),
        )
        for r in olaru2005.repairs()
    ]
    return markdown_table(
        ("repair", "M_S alone (N m)", "η alone", "M_S with all so far (N m)", "η with all so far"), rows
    )


def _marked(finding: olaru2005.Finding) -> str:
    """A number, marked where the claim fails under this reading."""
    return finding.short if finding.verdict is olaru2005.Verdict.HOLDS else f"{finding.short} (no)"
