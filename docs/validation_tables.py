"""Parts of the page on validation: output of the command, figure, calibration and residuals."""

from __future__ import annotations

import dataclasses
import functools
import math
import sys
from pathlib import Path

from ballscrew.basis import units
from ballscrew.basis.output.sheet import Table
from ballscrew.basis.output.sheet import words as written
from ballscrew.evidence.validation.entries import DESCRIPTORS, Conditions, trends
from ballscrew.evidence.validation.rows import ACCURACY_FACTOR
from ballscrew.faces.sheets import pictures, terminal
from ballscrew.physics.components.nut import DoubleNut, OversizeBallNut
from ballscrew.physics.friction.calibrations import calibrated, calibration, calibrations
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.sizing.catalogue import printed_rows
from ballscrew.physics.sizing.rules import RULES
from ballscrew.questions.shared.text_tables import markdown_table
from ballscrew.questions.validate import compute, sheet

sys.path.append(str(Path(__file__).parents[1] / "benchmarks"))
import fit_calibration

SYMBOLS = {"boundary_friction_coefficient": "µ₀", "share_of_load": "F_B/Q"}
#: Sets of more rows are neither printed nor drawn row by row.
MOST_ROWS = 100
#: Largest error of a rating in the standard's own tests.
C_A, C_0A = 0.015, 0.01


@functools.cache
def found():
    """All sets: the request, and the entries of each set."""
    asked = compute.request()
    return asked, [entries for entries, _ in compute.evaluate(asked)]


def parts():
    """Tables as Markdown, the command's output as text, and the figure."""
    asked, sets = found()
    drawn = [entries for entries in sets if len(entries[0].points) <= MOST_ROWS]
    return {
        "summary.md": summary(),
        "vendors.md": vendors_table(),
        "agreement.md": agreement_table(),
        "contradiction.md": contradiction_table(),
        "calibration.md": calibration_table(),
        "rivals.md": fit_calibration.rivals_table(),
        "strata.md": fit_calibration.strata_table(),
        "laws.md": fit_calibration.trends_table(),
        "trends.md": trends_table(),
        "definitions.md": definitions_table(),
        "oil.md": oil_table(),
        "makers.md": makers_table(),
        "stock.md": groups_table("hiwin-stock"),
        "bearings.md": groups_table("support-bearings"),
        "used.md": used_table(),
        "rules.md": rules_table(),
        "rule_sources.md": sources_table(),
        "rule_scatter.md": residuals_after_rules(),
        "rows.txt": "\n\n".join(_rows(entries, asked) for entries in sets) + "\n",
        "validation.svg": lambda: pictures.picture(sheet.picture(drawn, asked)),
    }


def _rows(entries, asked) -> str:
    """The rows of a set as the command prints them; of a whole catalogue the command alone."""
    text = terminal.text(sheet.sheet(entries, asked))
    if len(entries[0].points) <= MOST_ROWS:
        return text
    title, _, _ = text.partition("\n")
    return f"{title}\n  {len(entries[0].points)} rows: ballscrew validate {entries[0].data.name}"


def summary() -> str:
    """One row for each set and model."""
    lines = [["set", "model", "n", "mean ratio", "scatter", "in the vendor's band"]]
    for entry in _entries():
        share = "no band" if entry.share_in_band is None else _percent(entry.share_in_band)
        scatter = f"{entry.std_ratio:.3f}" if len(entry.counted) > 1 else "–"
        who = entry.calibration or "uncalibrated"
        is_range = entry.data.alternatives or entry.data.bound
        ratio = _spread(entry) if is_range else f"{entry.mean_ratio:.3f}"
        scatter = "alternatives" if entry.data.alternatives else "upper bounds" if is_range else scatter
        lines.append([entry.data.name, who, str(len(entry.counted)), ratio, scatter, share])
    return _table(lines)


@functools.cache
def _of_makers():
    asked, sets = found()
    return sheet.summary(asked, sets)[0]


def _of_sheet(table: Table) -> str:
    """A table of a sheet as Markdown, where a dot takes the place of an indent."""
    rows = [[written(cell, with_unit=not table.is_compact).replace("  ", "· ") for cell in row] for row in table.rows]
    return markdown_table(table.columns, rows)


def makers_table() -> str:
    """No-load torques by maker and kind of nut: the model, its calibrations, and rules."""
    return _of_sheet(next(sheet.of_makers(_of_makers()).of_kind(Table)))


def used_table() -> str:
    """The choices of the model that were made with the rows of a set in sight."""
    lines = [["set", "chosen or fitted with its rows in sight"]]
    for entries in found()[1]:
        lines.append([f"`{entries[0].data.name}`", "; ".join(entries[0].used_for) or "nothing"])
    return _table(lines)


def groups_table(name: str) -> str:
    """The kinds of nut, or the makers, of a set: the model as it is and calibrated, and other definitions."""
    asked, sets = found()
    entries = next(entries for entries in sets if entries[0].data.name == name)
    return _of_sheet(next(sheet.sheet(entries, asked).of_kind(Table)))


def rules_table() -> str:
    """Rules of one line over the same rows as the model."""
    lines = [["set", "what", "mean ratio", "scatter", "in the band"]]
    for entries in found()[1]:
        if not entries[0].rules:
            continue
        name = entries[0].data.name
        own = [(entry, f"**model, {entry.calibration or 'uncalibrated'}**") for entry in entries]
        rules = [(rule, sheet.WORDS[rule.rule]) for rule in entries[0].rules]
        for one, words in [*own, *rules]:
            mean = f"{one.mean_ratio:.2f}"
            scatter = "–" if math.isnan(one.std_ratio) else f"{one.std_ratio:.2f}"
            if entries[0].data.alternatives:
                mean, scatter = "{:.2f} to {:.2f}".format(*one.range_ratio), "alternatives"
            lines.append([name, words, mean, scatter, _percent(one.share_in_band)])
            name = ""
    return _table(lines)


def sources_table() -> str:
    """The rules of one line with their formulas and sources."""
    lines = [["rule", "formula", "source", "what was checked", "range"]]
    lines += [[rule.title, rule.formula, rule.source, rule.checked, rule.range] for rule in RULES.values()]
    return _table(lines)


def residuals_after_rules() -> str:
    """Scatter of the logarithm of the ratio: what a law leaves open once a factor of its own is fitted to the set."""
    lines = [["set", "what", "factor that is left", "scatter of the ratio about it"]]
    for entries in found()[1]:
        points = entries[0].points
        if entries[0].data.alternatives or not entries[0].rules or len(points) < 3:
            continue
        name = entries[0].data.name
        columns = [(f"**model, {e.calibration or 'uncalibrated'}**", [p.ratio for p in e.points]) for e in entries]
        columns += [(sheet.WORDS[r.rule], [p.laws[r.rule] for p in points]) for r in entries[0].rules]
        for words, ratios in columns:
            factor = math.exp(sum(map(math.log, ratios)) / len(ratios))
            left = math.sqrt(sum((math.log(r / factor)) ** 2 for r in ratios) / (len(ratios) - 1))
            lines.append([name, words, f"{factor:.2f}", _percent(left)])
            name = ""
    return _table(lines)


#: Names of the sets in a short table.
SHORT = {
    "rexroth-double-nut": "Rexroth: no-load torque of double nuts",
    "rexroth-single-nut": "Rexroth: no-load torque of single nuts, oversize balls",
    "hiwin-stock": "HIWIN: drag of stocked nuts, preload not printed, nothing fitted",
    "thk-stock": "THK: drag of small stocked nuts, preload not printed, an upper bound",
    "thk-jis": "THK: no-load torque of a double nut, not fitted",
    "xjtu": "XJTU: torque of two new screws, measured, against sizes that could be theirs",
    "emps": "EMPS: torque of a whole axis, of which the screw is a part",
    "thk-kr4620a": "THK: torque of a whole actuator, of which the screw is a part",
    "chart-friction": "THK, HIWIN: friction coefficient of the thread under load",
    "balan-2015": "rolling torque of balls between rings, measured",
    "hiwin-ratings": "HIWIN: dynamic load rating by ISO 3408-5",
    "hiwin-stiffness": "HIWIN: rigidity without preload",
    "rexroth-rigidity": "Rexroth: rigidity R_nu,ar of preloaded double nuts",
    "thk-ratings": "THK: dynamic load rating by ISO 3408-5, balls estimated, nothing fitted",
    "thk-rigidity": "THK: rigidity of nuts by the same contacts, balls estimated, nothing fitted",
    "support-bearings": "NSK, IBC: axial rigidity of 60° bearings by the same contacts",
}


def vendors_table() -> str:
    """Comparison with vendors and a laboratory, one row for each set, for the page on agreement."""
    lines = [
        ["stated value", "number", "uncalibrated", "calibrated", "within the vendor's band, before and after"],
    ]
    for words, entries in _lines_of_vendors():
        raw, after = entries[0], entries[-1]
        calibrated = len(entries) > 1
        shares = [_percent(entry.share_in_band) for entry in entries if entry.share_in_band is not None]
        lines.append(
            [
                words,
                str(len(raw.counted)),
                _spread(raw),
                _spread(after) if calibrated else "–",
                " and ".join(shares) if shares else "no band",
            ]
        )
    return _table(lines)


def agreement_table() -> str:
    """Who states what, what the model gives there without calibration, and the ratio, for the README."""
    of = {entries[0].data.name: entries[0] for entries in found()[1]}
    stock, screws = of["hiwin-stock"].groups, of["xjtu"]
    rows = [
        ("Rexroth, tables", "no-load torque of {} double nuts", of["rexroth-double-nut"]),
        ("HIWIN, stock list", "drag torque of {} double nuts, preload assumed as 7 %", stock["double"]),
        ("HIWIN, stock list", "drag torque of {} nuts with an offset, preload assumed as 7 %", stock["offset"]),
        ("THK, worked example", "no-load torque of a double nut", of["thk-jis"]),
        ("Balan 2015, measured", "rolling torque of balls between rings, {} states", of["balan-2015"]),
        ("XJTU, measured", "two new screws of a size not stated; ours: {} that could be these", screws),
        ("Rexroth, tables", "rigidity of {} preloaded double nuts", of["rexroth-rigidity"]),
    ]
    lines = [["who stated it", "what", "stated", "ours", "ratio"]]
    for who, what, entry in rows:
        quantity = entry.data.quantity
        ends = [(point.band.low, point.band.high) for point in entry.counted if entry.data.alternatives]
        stated = [end for pair in ends for end in pair] or [point.band.middle for point in entry.counted]
        ours = [point.value for point in entry.counted]
        words = [_from_to(stated, quantity), _from_to(ours, quantity), _spread(entry)]
        lines.append([who, what.format(len(entry.counted)), *words])
    return _table(lines)


def _from_to(values, quantity) -> str:
    """The least and the greatest of some values with their unit."""
    low, high = (units.rounded(value, quantity, 2) for value in (min(values), max(values)))
    span = low if low == high else f"{low} to {high}"
    return f"{span} {units.symbol(units.label(quantity))}"


def _lines_of_vendors():
    """The sets with their names; the kinds of nut of one that has several one by one, as a mean of all says nothing."""
    for entries in found()[1]:
        data, groups = entries[0].data, entries[0].groups
        if data.of_screws and not data.alternatives and 1 < len(groups) < len(entries[0].points) <= MOST_ROWS:
            for name in groups:
                yield f"{SHORT[data.name]}: {name}", [entry.groups[name] for entry in entries]
        else:
            yield SHORT[data.name], entries


def oil_table() -> str:
    """No-load torques at other oil temperatures, which the vendor does not state."""
    names = ("rexroth-double-nut", "rexroth-single-nut")
    lines = [["oil", *(f"{name}, {who}" for name in names for who in ("uncalibrated", "calibrated"))]]
    for temperature in ("15 degC", "25 degC", "40 degC"):
        asked = compute.request(names, temperature=temperature)
        entries = [entry for entries, _ in compute.evaluate(asked) for entry in entries]
        cells = [
            f"{entry.mean_ratio:.2f} ± {entry.std_ratio:.2f}, {_percent(entry.share_in_band)}" for entry in entries
        ]
        grade = asked.conditions_of(asked.sets[0]).grade
        lines.append([f"{grade}, {temperature.replace('degC', '°C')}", *cells])
    return _table(lines)


def definitions_table() -> str:
    """Results of other definitions of the same value."""
    lines = [["set", "definition", "mean ratio"]]
    for entry in _entries():
        if entry.mean_definitions and not (entry.calibration or entry.data.ratio_names or entry.data.bound):
            lines.append(
                [
                    entry.data.name,
                    f"as compared: {', '.join(filter(None, (entry.data.title, entry.data.details)))}",
                    _mean(entry),
                ]
            )
            lines += [["", sheet.WORDS[name], f"{value:.3f}"] for name, value in entry.mean_definitions.items()]
    return _table(lines)


def contradiction_table() -> str:
    """What the model and three rules give of the torque that three makers state of a preloaded nut."""
    entries = {(entry.data.name, entry.calibration is not None): entry for entry in _entries()}
    kinds = {"HIWIN's list, double": "double", "HIWIN's list, offset": "offset"}

    def stated(fitted: bool) -> dict:
        stock = entries["hiwin-stock", fitted].groups
        return {
            "Rexroth's table, double": entries["rexroth-double-nut", fitted],
            **{name: stock[kind] for name, kind in kinds.items()},
            "THK's example, double": entries["thk-jis", fitted],
        }

    lines = [["", *stated(False)]]
    for words, fitted in (("the model", False), ("the model, calibrated to Rexroth", True)):
        lines.append([words, *map(_spread, stated(fitted).values())])
    for words, law in (
        ("Rexroth's rule", "rexroth"),
        ("HIWIN's rule", "hiwin"),
        ("JIS B 1192, as THK computes", "jis"),
    ):
        lines.append([words, *(f"{entry.mean_laws[law]:.2f}" for entry in stated(False).values())])
    return _table(lines)


def calibration_table() -> str:
    """The calibrated numbers, their errors, and what is left."""
    lines = [["calibration", "number", "where", "value", "standard error"]]
    words: list[str] = []
    for stored in calibrations().values():
        for (name, where), error in zip(stored.parameters.items(), stored.standard_errors, strict=True):
            value = f"{getattr(stored, name):.4g}"
            lines.append([f"`{stored.name}`", SYMBOLS[name], f"`{where}`", value, f"{error:.1g}"])
        alike = "" if stored.correlation is None else f", correlation of the two {stored.correlation:.2f}"
        words.append(f"`{stored.name}`: {stored.rows} rows, sum of squares {stored.cost:.2f}{alike}.")
    first = next(iter(calibrations().values()))
    said = f"\nObjective: {first.objective}. {' '.join(words)} Command: `{first.command}`."
    return _table(lines) + said + "\n"


def trends_table() -> str:
    """Trends of the ratio over properties of the rows."""
    lines = [["set", "model", "against", "exponent", "correlation"]]
    for entry in _entries():
        if entry.data.bound or not (entry.data.calibratable or entry.data.name == "balan-2015"):
            continue
        for trend in trends(entry.counted):
            words = DESCRIPTORS[trend.descriptor].description
            exponent = f"{trend.exponent:+.2f} ± {trend.half_width:.2f}".replace("-", "−")
            correlation = f"{trend.correlation:+.2f}".replace("-", "−")
            lines.append([entry.data.name, entry.calibration or "uncalibrated", words, exponent, correlation])
    return _table(lines)


def numbers() -> dict[str, str]:
    """The numbers in the text of the page, by their names there."""
    by_key = {(entry.data.name, entry.calibration is not None): entry for entry in _entries()}
    values: dict[str, str] = {}
    for key, name in (("double", "rexroth-double-nut"), ("single", "rexroth-single-nut")):
        outside = [f"{point.name} ({point.ratio:.2f})" for point in by_key[name, True].points if point.in_band is False]
        values[f"{key}_calibrated_outside"] = ", ".join(outside) or "none"
    for who, fitted in (("raw", False), ("calibrated", True)):
        limits = by_key["rexroth-single-nut", fitted].upper_limits
        values[f"single_{who}_above"] = f"{sum(apart.ratio > 1 for apart in limits)} of {len(limits)}"
    steep, fine = _steep_and_fine(by_key["rexroth-single-nut", True])
    values |= {"single_steep": f"{steep:.2f}", "single_fine": f"{fine:.2f}"}
    balan = by_key["balan-2015", False]
    slow, fast = min(p.ratio for p in balan.points), max(p.ratio for p in balan.points)
    values |= {"balan_slow": f"{slow:.2f}", "balan_fast": f"{fast:.2f}"}
    ratings = by_key["hiwin-ratings", False].points
    off = [p for p in ratings if abs(p.ratio - 1) > C_A or abs(p.definitions["static"] - 1) > C_0A]
    rigid = by_key["rexroth-rigidity", False]
    values["rigidity_scatter"] = _relative_scatter([point.ratio for point in rigid.points])
    for key, name in (("elastic", "elastic_bodies"), ("rigid", "rigid_bodies")):
        values[f"rigidity_{key}"] = f"{rigid.mean_definitions[name]:.2f}"
    values["rigidity_elastic_scatter"] = _relative_scatter([p.definitions["elastic_bodies"] for p in rigid.points])
    values["rigidity_factor"] = f"{ACCURACY_FACTOR:g}"
    values["chain_share"] = _percent(_chain_share("double", DoubleNut, (7, 10)))
    values["chain_share_single"] = _percent(_chain_share("oversize-balls", OversizeBallNut, (5,)))
    values["ratings_good"] = f"{len(ratings) - len(off)} of {len(ratings)}"
    (low, high) = {(p.band.low, p.band.high) for p in by_key["xjtu", False].points}.pop()
    values |= {"xjtu_low": f"{low:.2f}", "xjtu_high": f"{high:.2f}"}
    bearings = by_key["support-bearings", False].groups
    for maker, group in bearings.items():
        torques = [point.definitions["torque"] for point in group.points]
        values[f"bearings_{maker.lower()}_torque"] = f"{min(torques):.1f} to {max(torques):.1f}"
    values |= _numbers_of_agreement(by_key)
    double = [one.range_ratio for name, one in by_key["emps", False].groups.items() if name.startswith("double")]
    values["emps_double"] = f"{min(low for low, _ in double):.2f} to {max(high for _, high in double):.2f}"
    return {f"validation_{key}": value for key, value in values.items()}


def _numbers_of_agreement(by_key) -> dict[str, str]:
    """Numbers in the text of the page on agreement."""
    double, screws = (by_key[name, False] for name in ("rexroth-double-nut", "xjtu"))
    rule = next(rule for rule in double.rules if rule.rule == "rexroth")
    ranges = {"could_be": screws, "plain": screws.groups["double"], "sealed": screws.groups["double, two wipers"]}
    return {
        "own_rule": f"{rule.mean_ratio:.3f} ± {rule.std_ratio:.3f}",
        "double_ratio": _spread(double),
        "rings": _spread(by_key["balan-2015", False]),
        "screws": str(len(screws.points)),
        "screws_within": str(sum(bool(point.in_band) for point in screws.points)),
        **{f"screws_{key}": "{:.2f} to {:.2f}".format(*one.range_ratio) for key, one in ranges.items()},
    }


def _steep_and_fine(entry) -> tuple[float, float]:
    """Mean ratio of the rows whose lead is as long as their diameter, and of the others."""
    steep = [p.ratio for p in entry.points if p.descriptors["steepness"] >= 1]
    fine = [p.ratio for p in entry.points if p.descriptors["steepness"] < 1]
    return sum(steep) / len(steep), sum(fine) / len(fine)


def _chain_share(kind, nut, percents) -> float:
    """Mean share of the force between balls in the calibrated no-load torque of the vendor's rows."""
    model, at = calibrated(FrictionModel.reference(), calibration("rexroth-2006")), Conditions()
    shares = []
    for row in printed_rows():
        if row.nut != kind:
            continue
        for percent in percents:
            screw = dataclasses.replace(row.screw(), nut=nut(preload=percent / 100 * row.dynamic_load_rating))
            r = model(screw, at.lubricant, axial_load=0.0, screw_speed=at.screw_speed)
            shares.append(float((r.contributions["ball_to_ball"] + r.contributions["chain_braking"]) / r.screw_torque))
    return sum(shares) / len(shares)


def _entries():
    return [entry for entries in found()[1] for entry in entries]


def _mean(entry) -> str:
    return f"{entry.mean_ratio:.3f}"


def _spread(entry) -> str:
    if entry.data.alternatives or entry.data.bound:
        return "{:.2f} to {:.2f}".format(*entry.range_ratio)
    return f"{entry.mean_ratio:.2f} ± {entry.std_ratio:.2f}" if len(entry.counted) > 1 else f"{entry.mean_ratio:.2f}"


def _relative_scatter(ratios) -> str:
    mean = sum(ratios) / len(ratios)
    scatter = math.sqrt(sum((ratio - mean) ** 2 for ratio in ratios) / (len(ratios) - 1)) / mean
    return f"{100 * scatter:.1f} %"


def _percent(share: float) -> str:
    return f"{share:.0%}".replace("%", " %")


def _table(lines) -> str:
    return markdown_table(lines[0], lines[1:])
