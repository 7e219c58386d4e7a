"""The band of the page: which inputs are uncertain and by how much, and the random numbers, as tables.

All is that of :func:`ballscrew.engine.uncertainty.bands.band` with the default distributions of a case and the
calibrations of makers, without other laws: the same Sobol' points, so the same samples. Scripts take the points from
the direction numbers, a module makes values of them, and the module of the model makes torques of these.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.basis.arrays import where
from ballscrew.basis.quantities import Info
from ballscrew.cases.case_files.case import Case
from ballscrew.compiler.tracing.merging import merged_program
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.tape import Tape
from ballscrew.engine.evaluation.outputs import inputs_of
from ballscrew.engine.uncertainty import bands
from ballscrew.engine.uncertainty.band_evaluation import DERIVED_OUTPUTS, Sample, tails
from ballscrew.engine.uncertainty.distributions import UNREACHED, allowed, standard_normal_share
from ballscrew.engine.uncertainty.uncertain_value import (
    NEAR,
    NORMAL_95,
    DefaultUncertainty,
    default_distributions,
)
from ballscrew.exports.wasm_modules import Function, KeptModule, Module, compiled, described
from ballscrew.faces.page import kinds
from ballscrew.faces.page.modules import inputs_of_module
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.questions.band.compute import LEVEL, PRESSING, of_makers

#: Samples at the operating point, as many as in the program, and at each speed of the fan; powers of two.
SAMPLES = {"point": bands.SAMPLES, "fan": 2**9}
#: The same of nuts whose balls are solved one by one, each sample anew.
SAMPLES_BY_BALL = {"point": bands.NUT_SAMPLES, "fan": 2**7}
SEED = 0
#: What is evaluated of each sample, and what its torque is moved by.
DRAWN = ("screw_torque", "ideal_torque", "drive_torque", "factor")
#: What has a band on the page, where the module of the nut gives it.
OUTPUTS = ("screw_torque", "drive_torque", "efficiency", "back_driving_efficiency")
#: A start whose oil is of a grade; that of the paper is given by its viscosity.
_OF_GRADE = next(name for name in kinds.start_tables() if name != kinds.PAPER)
#: The forms of the default uncertainties: the numbers that their functions read besides a share and a central value.
FORMS: Mapping[str, tuple[str, ...]] = {
    "half_width": ("half_width", "least", "most"),
    "share": ("share", "bound", "below", "least"),
    "limits": ("limits",),
    "between": ("low", "high"),
    "factor": ("factor",),
}


class Banding(NamedTuple):
    """The module that makes values of shares, and its functions.

    There is one for each form of uncertainty, for the ratio of two torques, and for what follows from a torque.
    """

    module: Module
    functions: Mapping[str, Function]


# -- the module -----------------------------------------------------------------------------------


def module_of_banding() -> Banding:
    """The module of the quantiles: by form, the value at a share of its distribution about a central value.

    Beside them are ``ratio``, by which a calibration moves a torque, and ``derived``, the outputs with it moved.
    """
    programs = [
        _recorded(form, ("u", "value", *numbers), functools.partial(_drawn, form)) for form, numbers in FORMS.items()
    ]
    programs += [_recorded("ratio", ("torque", "central"), _ratios), _recorded("derived", DRAWN, _derived)]
    module = compiled(programs)
    return Banding(module, {function.name: function for function in module.functions})


def _recorded(
    name: str, inputs: tuple[str, ...], of: Callable[..., Mapping[str, Any]]
) -> tuple[str, tuple[str, ...], Program]:
    """A function of inputs as a program, with its name and theirs."""
    tape = Tape(len(inputs))
    with np.errstate(all="ignore"):
        result = of(**{one: tape.value(place) for place, one in enumerate(inputs)})
    return name, inputs, merged_program(tape, result)


def _drawn(form: str, **given: Any) -> dict[str, Any]:
    return {"drawn": quantile(form, **given)}


def _ratios(torque: Any, central: Any) -> dict[str, Any]:
    return {"ratio": torque / central}


def _derived(**given: Any) -> dict[str, Any]:
    drawn = Sample(**given)
    return {name: DERIVED_OUTPUTS[name](drawn) for name in OUTPUTS}


def quantile(form: str, u: Any, value: Any, **numbers: Any) -> Any:
    """The quantile at a share ``u`` of :meth:`DefaultUncertainty.about` a value; numbers are those of its form.

    It is written for arrays and recordings, where that of the distributions is for numbers about which each decides.
    """
    if form == "half_width":
        deviation, least, most = numbers["half_width"] / NORMAL_95, numbers["least"], numbers["most"]
        below, beyond = _share_below((least - value) / deviation), _share_below((value - most) / deviation)
        drawn = value + deviation * _normal_quantile(below + (1 - beyond - below) * u)
        return where(drawn < least, least, where(drawn > most, most, drawn))
    if form == "share":
        deviation = numbers["share"] * (value - numbers["bound"]) / NORMAL_95
        within = numbers["below"] + (1 - numbers["below"]) * u
        drawn = value + deviation * _normal_quantile(within)
        return where(drawn < numbers["least"], numbers["least"], drawn)
    if form == "limits":
        low, high = value * (1 - numbers["limits"]), value * (1 + numbers["limits"])
        return low + (high - low) * u
    if form == "factor":
        return value * np.exp(np.log(numbers["factor"]) / NORMAL_95 * _normal_quantile(u))
    low, high = numbers["low"], numbers["high"]
    width, below, above = high - low, value - low, high - value
    inside = (low < value) & (value < high)
    rising = low + np.sqrt(where(inside, width * below * u, 1.0))
    falling = high - np.sqrt(where(inside, width * above * (1 - u), 1.0))
    near = value + NEAR * value / NORMAL_95 * _normal_quantile(u)
    return where(inside, where(u < below / width, rising, falling), near)


#: Coefficients of the quantile of the normal distribution (``ndtri`` of the Cephes library, which SciPy has, too): in
#: the middle, over the square of u − ½, and in the tails, over 1/√(−2 log u) for u above e⁻³²; highest power first.
_MIDDLE = (
    (
        -59.9633501014107895267, 98.0010754185999661536, -56.6762857469070293439, 13.9312609387279679503,
        -1.23916583867381258016,
    ),
    (
        1.0, 1.95448858338141759834, 4.67627912898881538453, 86.3602421390890590575, -225.462687854119370527,
        200.260212380060660359, -82.0372256168333339912, 15.9056225126211695515, -1.18331621121330003142,
    ),
)  # fmt: skip
_TAIL = (
    (
        4.05544892305962419923, 31.5251094599893866154, 57.1628192246421288162, 44.0805073893200834700,
        14.6849561928858024014, 2.18663306850790267539, -0.140256079171354495875, -0.0350424626827848203418,
        -0.000857456785154685413611,
    ),
    (
        1.0, 15.7799883256466749731, 45.3907635128879210584, 41.3172038254672030440, 15.0425385692907503408,
        2.50464946208309415979, -0.142182922854787788574, -0.0380806407691578277194, -0.000933259480895457427372,
    ),
)  # fmt: skip
_OF_TAIL = 0.13533528323661269189


def _normal_quantile(u: Any) -> Any:
    """Φ⁻¹(u) by rational functions, for recordings: that of SciPy is compiled. To 1e-14 for u from e⁻³² to 1 − 2⁻⁵³."""
    from_middle = u - 0.5
    square = from_middle * from_middle
    middle = (from_middle + from_middle * (square * _ratio(square, _MIDDLE))) * np.sqrt(2 * np.pi)
    upper = u > 0.5
    tail = where(upper, 1 - u, u)
    x = np.sqrt(-2 * np.log(tail))
    far = x - np.log(x) / x - _ratio(1 / x, _TAIL) / x
    return where(tail > _OF_TAIL, middle, where(upper, far, -far))


#: Coefficients of erfc(x) exp(x²) for x from 1 to 8, of the same library; highest power first.
_ERROR_TAIL = (
    (
        2.46196981473530512524e-10, 0.564189564831068821977, 7.46321056442269912687, 48.6371970985681366614,
        196.520832956077098242, 526.445194995477358631, 934.528527171957607540, 1027.55188689515710272,
        557.535335369399327526,
    ),
    (
        1.0, 13.2281951154744992508, 86.7072140885989742329, 354.937778887819891062, 975.708501743205489753,
        1823.90916687909736289, 2246.33760818710981792, 1656.66309194161350182, 557.535340817727675546,
    ),
)  # fmt: skip


def _share_below(x: Any) -> Any:
    """Φ(x) for x up to −√2, for recordings; nothing where it is less than any share that is drawn."""
    a = -x / np.sqrt(2)
    share = 0.5 * np.exp(-(a * a)) * _ratio(a, _ERROR_TAIL)
    return where(share > UNREACHED, share, 0.0)


def _ratio(x: Any, coefficients: tuple[Sequence[float], Sequence[float]]) -> Any:
    over, under = (_polynomial(x, each) for each in coefficients)
    return over / under


def _polynomial(x: Any, coefficients: Sequence[float]) -> Any:
    polynomial: Any = coefficients[0]
    for one in coefficients[1:]:
        polynomial = polynomial * x + one
    return polynomial


# -- the tables -----------------------------------------------------------------------------------


def contents_of_bands(
    banding: Banding, structures: Sequence[tuple[str, str]], calibrated: Mapping[tuple[str, str], KeptModule]
) -> dict[str, Any]:
    """Data that the page has of bands; structures of which some uncertain number is no input have none.

    ``calibrated`` are the modules of those whose makers ask for other torques.
    """
    tables = {f"{model}/{kind}": uncertain_of(model, kind) for model, kind in structures}
    tables = {name: table for name, table in tables.items() if table}
    makers = {f"{m}/{kind}/makers": _of_makers(m, kind, module) for (m, kind), module in calibrated.items()}
    slots = 1 if makers else 0
    counts = {d + more for table in tables.values() for d in dimensions_of(table) for more in range(slots + 1)}
    return {
        "file": banding.module.file,
        "functions": {name: described(function) for name, function in banding.functions.items()},
        "level": LEVEL,
        "tails": tails(LEVEL),
        "outputs": list(OUTPUTS),
        "drawn": list(DRAWN[:-1]),
        "makers": makers,
        "samples": {"usual": SAMPLES, "by_ball": SAMPLES_BY_BALL},
        "uncertain": tables,
        "sobol": {str(d): sobol_numbers(d, max(SAMPLES.values())) for d in sorted(counts)},
    }


def uncertain_of(model: str, kind: str) -> list[dict[str, Any]]:
    """The uncertain inputs of a structure in the order of their random numbers; none where one is no input.

    Each has its name, the form of its uncertainty with the numbers of that, where ``above`` is given the bound at which
    it is switched off, and ``oil`` where it belongs to one that is of a "grade", or given by its "viscosity".
    """
    result: dict[str, list[dict[str, Any]]] = {}
    for oil, start in (("viscosity", kinds.PAPER), ("grade", _OF_GRADE)):
        case = kinds.case_of(start, model, kind)
        known = inputs_of_module(kinds.subject_of(case))
        usual = default_distributions(case.model, case.screw, case.lubricant, exact=case.origins.exact)
        if not {*known, TEMPERATURE.name} >= usual.keys():
            return []
        result[oil] = [_entry(case, name, why) for name, (_, why) in usual.items()]
    rows: list[dict[str, Any]] = []
    for oil, entries in result.items():
        other = result["grade" if oil == "viscosity" else "viscosity"]
        rows += [entry if entry in other else {**entry, "oil": oil} for entry in entries]
    # both oils have the same order; where they part only one of them counts
    places = {name: place for entries in result.values() for place, name in enumerate(one["name"] for one in entries)}
    unique = {(row["name"], row.get("oil")): row for row in rows}
    return sorted(unique.values(), key=lambda row: places[row["name"]])


def _of_makers(model: str, kind: str, module: KeptModule) -> dict[str, Any]:
    """The calibrations that are drawn beside a structure, and its module with their numbers as inputs.

    ``of_starts`` has the names of those of a start where they are not all, and ``values`` those of inputs that say what
    the balls press with: where one has another, none is drawn.
    """
    case = kinds.case_of(kinds.PAPER, model, kind)
    numbers = {one.name: {_SHARE: float(getattr(one.model.ball_force, _SHARE_OF))} for one in of_makers(case)}
    names = {
        start: [one.name for one in of_makers(kinds.case_of(start, model, kind))] for start in kinds.start_tables()
    }
    subject = kinds.subject_of(case)
    pressing = [name for name in inputs_of_module(subject) if name.partition(".")[0] in PRESSING]
    return {
        **module.document,
        "calibrations": numbers,
        "of_starts": {start: drawn for start, drawn in names.items() if drawn != list(numbers)},
        "values": {name: float(subject.value_of(name)) for name in pressing},
    }


#: The number that a calibration of a maker sets.
_SHARE_OF = "share_of_load"
_SHARE = f"ball_force.{_SHARE_OF}"


def _entry(case: Case, name: str, why: DefaultUncertainty) -> dict[str, Any]:
    info = inputs_of(case.model, case.screw, case.lubricant)[name][1].info
    form, numbers = form_of(why, info)
    from_value, to_value = reach(why, info)
    entry: dict[str, Any] = {"name": name, "form": form, "numbers": numbers}
    if form != "half_width":
        entry |= {"above": _bound(info), "off": info.above is None}
    if from_value > max(_bound(info), _NOTHING):
        entry["from"] = from_value
    return entry if np.isinf(to_value) else {**entry, "to": to_value}


def _bound(info: Info) -> float:
    """The bound of a quantity at which it is switched off."""
    return float((info.at_least if info.above is None else info.above) or 0.0)


def form_of(why: DefaultUncertainty, info: Info) -> tuple[str, dict[str, float]]:
    """The form of an uncertainty and its numbers; a normal one is cut at its lower bound as :func:`within` cuts it."""
    if why.half_width is not None:
        return "half_width", {"half_width": why.half_width, **dict(zip(("least", "most"), allowed(info), strict=True))}
    if why.share is not None:
        below = standard_normal_share(-NORMAL_95 / why.share)  # the bound is as many deviations off for any value
        cut = below if below > UNREACHED else 0.0
        return "share", {"share": why.share, "bound": _bound(info), "below": cut, "least": allowed(info)[0]}
    if why.limits is not None:
        return "limits", {"limits": why.limits}
    if why.between is not None:
        return "between", dict(zip(("low", "high"), why.between, strict=True))
    assert why.factor is not None, why.name
    return "factor", {"factor": why.factor}


def reach(why: DefaultUncertainty, info: Info) -> tuple[float, float]:
    """The central values from and to which the function of the form is right: beyond them the page has no band.

    Only a half-width and a share are cut at bounds: others stay away from them.
    """
    low, high = allowed(info)
    deviations = _FARTHEST / NORMAL_95
    if why.half_width is not None:
        room = _NEAREST * why.half_width / NORMAL_95
        return low + room, high - room
    if why.share is not None:
        shares = deviations * why.share
        return -np.inf, (high + shares * _bound(info)) / (1 + shares)
    if why.limits is not None:
        return low / (1 - why.limits), high / (1 + why.limits)
    if why.between is not None:
        return low / (1 - deviations * NEAR), high / (1 + deviations * NEAR)
    assert why.factor is not None, why.name
    return low * why.factor**deviations, high / why.factor**deviations


#: Less than any number of a ball screw.
_NOTHING = 1e-300
#: Standard deviations within which all samples lie: farther off is less than the least share that is drawn.
_FARTHEST = 9.2
#: Standard deviations that a bound must be away for its share to be known.
_NEAREST = 1.5


def dimensions_of(table: Sequence[Mapping[str, Any]]) -> range:
    """Numbers of inputs of a table that may be uncertain at once: fewer where one is at the bound switching it off."""
    most = max(sum(row.get("oil") in (None, oil) for row in table) for oil in ("grade", "viscosity"))
    return range(max(1, most - sum(row.get("off", False) for row in table)), most + 1)


def sobol_numbers(dimensions: int, samples: int) -> dict[str, Any]:
    """Whole numbers whose combinations are :func:`~ballscrew.engine.uncertainty.monte_carlo.sobol_sequence`.

    ``first`` has the first point and ``turns`` by input what each further one is turned by, as multiples of ``unit``.
    """
    from scipy.stats import qmc  # half a second: for those only who build a page

    sequence = qmc.Sobol(dimensions, rng=np.random.default_rng(SEED))
    bits = max(1, int(np.ceil(np.log2(samples))))
    points = qmc.Sobol(dimensions, rng=np.random.default_rng(SEED)).random_base2(bits)
    unit = 0.5**sequence.bits
    whole = np.round(points / unit).astype(np.int64)
    # of points in the order of the Gray code, that after 2^k - 1 others differs by the k-th direction alone
    places = 2 ** np.arange(bits)
    turns = whole[places] ^ whole[places - 1]
    return {"unit": unit, "first": whole[0].tolist(), "turns": turns.T.tolist()}
