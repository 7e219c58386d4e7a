"""Checks of a screw: from a catalogue row or a case to friction, ratings, life and limits; their document."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Annotated, Any, NamedTuple

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import Angle, Force, Length, Pressure, quantities_of
from ballscrew.basis.records import Record, Severity, documents
from ballscrew.cases.case_files import case_file, descriptions, nut_tables
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.schema.reader import OPTIONS, Reader, in_options
from ballscrew.cases.screw_tables import catalogue
from ballscrew.cases.screw_tables.nut_kinds import LISTED, kind_of
from ballscrew.physics.components.nut import PRELOADED, Nut, OversizeBallNut
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.physics.sizing.checks import Check, all_hold, checks, half_loads, judged, verdict_at_point
from ballscrew.physics.sizing.makers_tables import speed_limit_of
from ballscrew.physics.sizing.ratings import Ratings, lists_preload, ratings_of
from ballscrew.questions.check import flags
from ballscrew.questions.run import answer as run
from ballscrew.questions.run.answer import results
from ballscrew.questions.run.compute import NutState, Run, with_nut
from ballscrew.questions.shared.check_lines import source_document, with_unlikely
from ballscrew.questions.shared.declared import numbers
from ballscrew.questions.shared.every_row import OfRows, copied, each, place_of, tables_of_row
from ballscrew.questions.shared.question import Done

#: Defaults of what neither row nor options give.
GRADE, TEMPERATURE, SPEED, SHARE_OF_RATING = "ISO VG 100", "40 degC", "600 rpm", 0.1
#: The fields of the ratings, by the names of the case file.
RATINGS: Mapping[str, str] = {"dynamic_load_rating": "dynamic", "static_load_rating": "static"}


class Options(NamedTuple):
    """Options of the command line: values by section.field, settings, and the names of a model and a calibration."""

    given: Mapping[str, str]
    settings: Sequence[str]
    model: str | None
    calibration: str | None = None
    allow_code: bool = False
    self_heating: bool = False


class Geometry(NamedTuple):
    """Sizes of the screw that follow from others."""

    lead_angle: Annotated[Angle, quantities_of(BallScrew)["lead_angle"].info]
    root_diameter: Annotated[Length, LISTED["root_diameter"].info]


class Rated(NamedTuple):
    """The load ratings of a screw; None is what is not known."""

    dynamic_load_rating: Annotated[Force | None, LISTED["dynamic_load_rating"].info]
    static_load_rating: Annotated[Force | None, LISTED["static_load_rating"].info]


class BothRatings(NamedTuple):
    """The load ratings as they are listed, and by the geometry."""

    #: As the row or the case lists them.
    listed: Rated
    #: By ISO 3408-5; None for a geometry that it has no ratings for.
    computed: Rated | None


@dataclasses.dataclass(frozen=True, eq=False)
class Checked:
    """A screw, its friction, ratings and checks, and the assumptions made."""

    name: str
    #: The case as it is given; without a nut it is checked as a single one.
    case: Case
    run: Run
    nut: NutState
    #: Ratings by the geometry; None for a screw that no catalogue has.
    computed: Ratings | None
    checks: Sequence[Check]
    assumed: Sequence[str]
    #: What self-heating did (:class:`~ballscrew.questions.warm_up.self_heating.SelfHeating`), where it was asked for;
    #: the case is then the warm one. Its room is loaded for those who ask.
    heating: Any = None

    @property
    def geometry(self) -> Geometry:
        """Sizes that follow from others."""
        return Geometry(self.case.screw.lead_angle, nut_tables.root_diameter(self.case.screw, self.case.origins.listed))

    @property
    def ratings(self) -> BothRatings:
        """The load ratings."""
        listed, computed = (self.case.origins.listed.get(name) for name in RATINGS), self.computed
        return BothRatings(Rated(*listed), None if computed is None else Rated(computed.dynamic, computed.static))

    @property
    def moves(self) -> bool:
        """The case has a cycle, which ``ballscrew duty`` judges: here its operating point is judged, for ever."""
        return self.case.axis is not None and self.case.motion is not None

    @property
    def verdict(self) -> str:
        """All checks in a few words; of what, where the case has a cycle too."""
        verdict = verdict_at_point(self.checks, valid=bool(self.run.friction.valid), has_cycle=self.moves)
        return with_unlikely(verdict, self.case)

    @property
    def holds(self) -> bool:
        """All checks were judged and hold."""
        return all(check.holds for check in self.checks)

    @property
    def verdicts(self) -> list[Record]:
        """The verdict on all checks, then those on the operating point."""
        holds = all_hold(self.checks)
        severity: Severity = "error" if holds is False else "warning" if self.case.unlikely else "info"
        whole = Record("verdict.checks", "checks", self.verdict, severity=severity, holds=holds)
        return [whole, *self.run.verdicts]

    def check(self, name: str) -> Check:
        """The check of that name."""
        return next(check for check in self.checks if check.name == name)


def one(name: str, path: Path | None, options: Options, keep_going: bool) -> tuple[Checked, Sequence[str]]:
    """The checks of a case file or of the row of that name, and notes on rows left out."""
    if path is None and Path(name).suffix.lower() in (".csv", ".xlsx"):
        raise InputError(Fault(name, "is a table, not a case", "", f"write --rows {name}"))
    if path is None and is_case(name):
        return _of_case(Path(name), options), ()
    rows, notes = catalogue.load(path, keep_going)
    return _of_row(catalogue.named(rows, name, file=path), options), notes


def every_row(
    name: str | None,
    path: Path | None,
    options: Options,
    keep_going: bool,
    *,
    row: str | None = None,
    done: Done | None = None,
) -> OfRows[Checked]:
    """The checks of all rows, or of those with these words, and notes on rows left out.

    A case file in place of the words is checked with the screw of each row, or of one ``row``, in place of its own.
    Raises :class:`~ballscrew.basis.errors.InputError` if there is any fault; with ``keep_going`` only if no row is
    good.
    """
    rows, notes = catalogue.load(path, keep_going)
    case = Path(name) if path is not None and name is not None and is_case(name) else None
    if row is not None:
        chosen = [catalogue.named(rows, row, file=path)]
    else:
        chosen = catalogue.chosen(rows, "" if case is not None else name or "", path)
    chosen, refused = catalogue.computable(chosen)
    tables = None if case is None else case_file.read(case)

    def work(row: CatalogueRow) -> Checked:
        return _of_row(row, options, (tables, case, path) if tables and case and path else None)

    result = each({place_of(row): row for row in chosen}, work, keep_going=keep_going, done=done)
    return dataclasses.replace(result, notes=[*notes, *refused, *result.notes])


def is_case(name: str) -> bool:
    """Test whether a name is that of a case file, not of a row."""
    file = name.partition("#")[0]  # a design of a project
    return Path(file).suffix in (".toml", ".json") or "/" in name or Path(name).is_file()


# -- tables ---------------------------------------------------------------------------------------


def _of_case(path: Path, options: Options) -> Checked:
    tables, notes = with_nut_named(case_file.read(path), path.parent, options.given)
    return _warm(path.name, _built(_put(tables, options), options, path.parent), notes, options)


def with_nut_named(
    tables: Mapping[str, Any], folder: Path = Path(), others: Mapping[str, str] = MappingProxyType({})
) -> tuple[dict[str, Any], Sequence[str]]:
    """Tables of a case with the nut that they lack, and notes on it: that of the row, or a single one.

    ``others`` are fields that will be put in by ``section.field``: a kind of nut among them counts.
    """
    if "nut" in tables:
        return dict(tables), ()
    screw = tables.get("screw")
    if not isinstance(screw, dict) or "catalogue" not in screw:
        return {**tables, "nut": {"type": "single"}}, ("no [nut] given: a single nut",)
    row = nut_tables.row_of(Reader({}, folder), screw)  # where there is none, the case is refused for it
    kind = others.get("nut.type", "single" if row is None else row.nut or "single")
    nut = {"preload": "0 N"} if kind in PRELOADED else {}
    return {**tables, "nut": nut}, ("no [nut] given: the nut of the row, without preload",)


def _of_row(row: CatalogueRow, options: Options, case: tuple[dict[str, Any], Path, Path] | None = None) -> Checked:
    """The row with the given options, and defaults elsewhere; or with what a case says, its tables, path and rows."""
    tables: dict[str, Any] = {"screw": {"catalogue": row.name}, "bodies": {}}
    folder = Path()
    if case is not None:
        tables, folder = copied(tables_of_row(case[0], row, case[2])), case[1].parent
    tables = _put({**tables, **{name: tables.get(name, {}) for name in ("nut", "lubricant", "operation")}}, options)
    notes = _filled(tables, row)
    notes += [text for name, text in catalogue.assumed(row).items() if name != "loaded_turns"]
    return _warm(row.name, _built(tables, options, folder, rows={row.name: row}), notes, options)


def _warm(name: str, case: Case, notes: Sequence[str], options: Options) -> Checked:
    """The checks of a case, with self-heating where the options ask for it."""
    if not options.self_heating:
        return checked(name, case, notes)
    from ballscrew.questions.warm_up.self_heating import self_heating

    heating = self_heating(case)
    return dataclasses.replace(checked(name, heating.warm, notes), heating=heating)


def _built(
    tables: dict[str, Any], options: Options, folder: Path = Path(), rows: Mapping[str, CatalogueRow] | None = None
) -> Case:
    """The case of tables; faults of fields that options gave name the options."""
    try:
        return case_file.build(
            tables, options.model, folder, rows, calibration=options.calibration, allow_code=options.allow_code
        )
    except InputError as error:
        model = () if options.model is None else ("model.name",)
        raise InputError(*in_options(error.faults, (*options.given, *model), {**flags(), **OPTIONS})) from None


def _put(tables: dict[str, Any], options: Options) -> dict[str, Any]:
    """Tables with the options put in."""
    for place, text in options.given.items():
        section, _, field = place.partition(".")
        table = tables.setdefault(section, {})
        if isinstance(table, dict):
            table[field] = text
    return case_file.override(tables, options.settings)


def _filled(tables: dict[str, Any], row: CatalogueRow) -> list[str]:
    """Put defaults into tables where nothing is given; return a note on each."""
    notes: list[str] = []

    def fill(section: str, field: str, value: str, text: str) -> None:
        if isinstance(tables[section], dict) and field not in tables[section]:
            tables[section][field] = value
            notes.append(text)

    listed = row.dynamic_load_rating
    load = SHARE_OF_RATING * (ratings_of(row).dynamic if listed is None else listed)
    force = units.shown(load, LISTED["dynamic_load_rating"])
    fill("operation", "axial_load", f"{load!r} N", f"axial load {force}: a tenth of C_a")
    fill("operation", "screw_speed", SPEED, f"speed {SPEED}")
    if isinstance(tables["lubricant"], dict) and "viscosity" not in tables["lubricant"]:
        fill("lubricant", "grade", GRADE, f"oil {GRADE}: none was given")
        fill("lubricant", "temperature", TEMPERATURE, f"oil at {TEMPERATURE}: no temperature was given")
    kind = row.nut or "single"
    fill("nut", "type", kind, f"{kind} nut, {'as listed' if row.nut else 'as the row lists none'}")
    usual = catalogue.EXAMPLE_PRELOADS.get(str(tables["nut"].get("type")))
    if usual is not None and not lists_preload(row) and "oversize" not in tables["nut"]:
        fill("nut", "preload", usual, f"preload {usual} of C_a, usual for such a nut: none was given")
    return notes


# -- evaluation -----------------------------------------------------------------------------------


def checked(name: str, case: Case, notes: Sequence[str] = (), known: Run | None = None) -> Checked:
    """The checks of a case; without a nut, of a single one.

    ``notes`` are further assumptions, ``known`` is the run of the case where it is there already.
    """
    run = with_nut(case, case.nut or nut_tables.SINGLE) if known is None or known.nut is None else known
    assert run.nut is not None
    computed = _computed(case)
    rated, stand_ins = _rated(case, computed)
    result = _judged(
        case,
        _of_known_preload(run.case.screw.nut, run.nut.preload),
        rated,
        float(run.nut.loads.remaining_preload),
        run.nut.maximum_pressure,
        stand_ins,
    )
    of_ratings = [f"{name.replace('_', ' ')} computed from the geometry: none is listed" for name in stand_ins]
    of_rigidity = [f"rigidity: {text}" for text in run.nut.rigidity.assumed]
    of_life = ["life: by the loads of both flanks in the model; a duty has those of ISO 3408-5"] * (run.nut.preload > 0)
    assumptions = [*notes, *descriptions.assumptions(run.case), *of_ratings, *of_life, *of_rigidity]
    assumptions += [descriptions.left_out(run.case), *descriptions.of_weight(case)]
    return Checked(name, case, run, run.nut, computed, result, list(dict.fromkeys(filter(None, assumptions))))


def checks_by_loads(case: Case, preload: Force, left: Force) -> Sequence[Check]:
    """The checks of a case that friction has no part in: those of :func:`checked` without the pressure.

    Its nut has this preload, of which the load leaves so much.
    """
    rated, stand_ins = _rated(case, _computed(case))
    nut = _of_known_preload(case.screw.nut, preload)
    return [check for check in _judged(case, nut, rated, left, None, stand_ins) if check.name != "contact_pressure"]


def _judged(
    case: Case,
    nut: Nut,
    rated: Mapping[str, float | None],
    left: Force,
    pressure: Pressure | None,
    stand_ins: Sequence[str],
) -> tuple[Check, ...]:
    """The checks under a load that leaves so much of the preload."""
    # the checks are of magnitudes: a screw wears and buckles the same in either direction
    load = abs(float(case.operation.axial_load))
    return checks(
        case.screw,
        axial_load=load,
        screw_speed=abs(float(case.operation.screw_speed)),
        nut=nut,
        **rated,
        half_loads=half_loads(load, left),
        maximum_pressure=pressure,
        root_diameter=case.origins.listed.get("root_diameter"),
        installation=case.installation,
        limits=case.limits,
        speed_limit=speed_limit_of(case.origins.row),
        computed_ratings=stand_ins,
    )


def _rated(case: Case, computed: Ratings | None) -> tuple[dict[str, float | None], list[str]]:
    """The ratings of a case, those of the geometry where it lists none, and the names of these."""
    rated = {name: case.origins.listed.get(name) for name in RATINGS}
    stand_ins = [name for name, value in rated.items() if value is None and computed is not None]
    return rated | {name: getattr(computed, RATINGS[name]) for name in stand_ins}, stand_ins


def _of_known_preload(nut: Nut, preload: Force) -> Nut:
    """The nut with its preload as a number, also where the case gives the oversize of the balls."""
    return nut.changed("preload", preload) if isinstance(nut, OversizeBallNut) else nut


def _computed(case: Case) -> Ratings | None:
    try:
        return nut_tables.screw_ratings(case.screw, case.origins.row)
    except InputError:
        return None


def document(checked: Checked) -> dict[str, Any]:
    """The document of one screw, in SI."""
    whole = _document(checked)
    return whole if checked.heating is None else checked.heating.within(whole)


def _document(checked: Checked) -> dict[str, Any]:
    case, beside = checked.case, {**run.beside(checked.run), "geometry": checked.geometry, "ratings": checked.ratings}
    return {
        "name": checked.name,
        "nut": kind_of(checked.nut.nut),
        "inputs": descriptions.inputs(case),
        **numbers(results=results(checked.run), **beside),
        "checks": [check_document(check) for check in checked.checks],
        "judged": judged(checked.checks),
        "holds": checked.holds,
        "verdict": checked.verdict,
        "verdicts": documents(checked.verdicts),
        "assumed": list(checked.assumed),
        "warnings": documents(checked.run.warnings),
        "provenance": descriptions.of_case(case),
    }


def list_document(results: Sequence[Checked]) -> list[dict[str, Any]]:
    """The documents of many screws, without the loads ball by ball."""
    listed = [document(screw) for screw in results]
    for result in listed:
        del result["loads"]["balls"], result["units"]["loads"]["balls"]
    return listed


def check_document(check: Check) -> dict[str, Any]:
    """A check as a record, what it lacks, its source, and ``name``, ``utilisation``, ``passes`` and ``words``."""
    older = {"name": check.name, "utilisation": check.utilisation, "passes": check.holds, "words": check.text}
    return {**check.record.document(), "missing": check.missing, **source_document(check), **older}
