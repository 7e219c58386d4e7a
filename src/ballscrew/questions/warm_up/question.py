"""The question of how a screw warms up, and what that does."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ballscrew.questions.shared.options import Option
from ballscrew.questions.shared.question import Answer, Done, Endpoint, Question, Request, Work
from ballscrew.questions.warm_up.options import DriftOptions, WarmUpOptions

_TO = "--to"
#: Files that a folder gets, with the columns that they have alone.
_FILES = {
    "warm_up.csv": "over time",
    "warm_up.xlsx": "",
    "compensation.csv": "compensation",
    "warm_up_band.csv": "band",
    "warm_up.png": "",
}


def _prepare(request: Request) -> Work:
    from ballscrew.basis.errors import Fault, InputError, raise_if_any
    from ballscrew.questions.shared.option_values import read
    from ballscrew.questions.warm_up import compute
    from ballscrew.questions.warm_up.answer import document, with_band
    from ballscrew.questions.warm_up.sheet import sheet

    drift, cool_down = request.options(DriftOptions), request.written["cool_down"]
    rest = (compute.REST if drift.drift_cycle else 0.0) if cool_down is None else cool_down
    options = read(WarmUpOptions, {**request.written, "cool_down": rest})
    raise_if_any(compute.option_faults(options.band, options.samples, options.level, options.only_given))
    compute.check_hours(options.hours, options.cool_down)
    if drift.feed_share is not None and not drift.drift_cycle:
        raise InputError(Fault("--feed-share", "needs --drift-cycle", f"{drift.feed_share:g}", "add --drift-cycle"))
    case = request.load(compute.moves)
    if drift.drift_cycle:
        case = compute.drift_cycle(case, compute.FEED_SHARE if drift.feed_share is None else drift.feed_share)

    def answer(done: Done) -> Answer:
        if not options.band:
            report = compute.warmed_up(case, options.hours, options.cool_down)
            return Answer(sheet(report), lambda: document(report))
        from ballscrew.questions.warm_up.band import band  # loads xarray

        bands = band(
            case,
            options.hours,
            options.cool_down,
            samples=options.samples,
            level=options.level,
            only_given=options.only_given,
            done=done,
        )
        return Answer(sheet(bands.report, bands), lambda: with_band(bands))

    files = [file for place in request.to for file in _files(place, options.band).items()]
    return Work(answer, "band" if options.band else "", dict(files))


def _files(place: Path, has_band: bool) -> dict[Path, str]:
    """The files of a place: itself if it ends as one, or those of a folder, which is made. They can be written."""
    from ballscrew.basis.atomic_files import check_writable, write_error
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.questions.shared import every_row
    from ballscrew.questions.shared.charts import SUFFIXES

    known = (*every_row.KINDS, *SUFFIXES)
    if place.suffix and not place.is_dir():
        if place.suffix.lower() not in known:
            remedy = f"end it in {', '.join(known[:-1])} or {known[-1]}, or name a folder"
            raise InputError(Fault(_TO, "unknown kind of file", str(place), remedy))
        files = {place: ""}
    else:
        try:
            place.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise write_error(_TO, place, error) from None
        files = {place / name: columns for name, columns in _FILES.items() if has_band or columns != "band"}
    for path in files:
        if path.suffix.lower() in every_row.KINDS:
            every_row.check_path(path)
        else:
            check_writable(_TO, path)
    return files


def _response() -> Any:
    from ballscrew.questions.shared.declared import response
    from ballscrew.questions.warm_up.answer import BesideWarmUp, WarmUpResults

    return response(WarmUpResults, "WarmUp", beside=BesideWarmUp)


WARM_UP = Question(
    name="warm-up",
    help="""Temperatures, growth and preload over hours. The output has the torque and the steady state, too.

    A case with an [axis] and a [motion] does its motion; one with an [operation] moves to and fro over half the shaft.
    [surroundings] has where the heat goes. Without a steady state the verdict says so: thermal runaway. With --band
    transients are drawn with other surroundings, among them the conduction through the balls, the least known.
    """,
    options=(DriftOptions, WarmUpOptions),
    case_texts={"settings": 'Change a value: --set surroundings.ambient="25 degC".', "calibration": None},
    files=Option(
        "Write a folder of tables and a picture; or one .csv, .xlsx, .png, .svg or .pdf; may be repeated.",
        short="-o",
        metavar="PATH",
    ),
    has_several_files=True,
    prepare=_prepare,
    endpoint=Endpoint(response=_response, options=(WarmUpOptions,)),
)
