"""Bodies to try, by the names of their models: the paper's screw, and one with an elastic nut."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ballscrew.faces.page.vocabulary import vocabulary
from ballscrew.physics.sizing.catalogue import catalogue

#: Logs to try, made by the model with noise of 0.2 %: of the paper's screw, and of it with a preload of 3 kN and 2 kN.
_LOG = """speed [rpm],axial load [N],torque [N m]
50,1000,0.8456
100,1000,0.8538
200,1000,0.8655
400,1000,0.8829
50,2000,1.6943
100,2000,1.7017
200,2000,1.7134
400,2000,1.7415
50,3000,2.5455
100,3000,2.5553
200,3000,2.5708
400,3000,2.6005
"""
_NEW, _WORN = (
    "\n".join(["speed [rpm],axial load [N],friction torque [N m]", *(f"{n},0,{torque}" for n, torque in rows)])
    for rows in (
        ((20, 0.2562), (50, 0.2485), (100, 0.2441), (200, 0.2461), (300, 0.2525), (400, 0.2609), (500, 0.2708)),
        ((20, 0.15), (50, 0.15), (100, 0.1538), (200, 0.1623), (300, 0.1733), (400, 0.185), (500, 0.1961)),
    )
)

_TESTS = "date,torque [N m],speed [rpm]\n" + "".join(
    f"2026-{month:02d}-01,{torque},100\n"
    for month, torque in enumerate((0.244, 0.246, 0.243, 0.247, 0.245, 0.241, 0.222, 0.205, 0.189), start=1)
)
_NEED = {"force": "2 kN", "feed": "15 m/min", "length": "1 m", "ends": "fixed-supported", "life": "20000 h"}
_FEW = {"population": 8, "generations": 2, "members": 2}
_MOVING: Mapping[str, Any] = {
    "axis": {"mass": "400 kg", "inclination": "90 deg"},
    "motion": {"kind": "trapezoid", "stroke": "0.5 m", "speed": "10 m/min", "acceleration": "0.5 g"},
    "installation": {"unsupported_length": "1 m", "ends": "fixed-supported"},
}
_TEXT = 'lubricant.grade = "ISO VG 68"\nscrew.catalogue = "hiwin-40-20k4"\n'
#: Bodies that have no case, each with its name.
_WITHOUT_CASE: Mapping[str, tuple[str, Mapping[str, Any]]] = {
    "SelectBody": ("few", {"need": {**_NEED, "preload": "2 %"}, "words": "rexroth 32x"}),
    "OptimiseBody": ("few", {"need": {**_NEED, "optimise": {"elastic_generations": 0}}, **_FEW}),
    "OwnNutBody": ("few", {"numbers": {"d0": "40 mm", "lead": "10 mm", "turns": "2x2.5", "Ca": "52.7 kN"}}),
    "OpenBody": ("case", {"file": {"name": "case.toml", "text": _TEXT}}),
}
#: What stands beside a case.
_BESIDE: Mapping[str, Mapping[str, Any]] = {
    "BandBody": {"samples": 64, "level": 0.9},
    "SensitivityBody": {"samples": 16},
    "SweepBody": {"vary": {"axial_load": "100:4000:5 N", "screw_speed": "10, 100 rpm"}, "outputs": ["efficiency"]},
    "WarmUpBody": {"hours": 1.0, "band": True, "samples": 16},
}
#: What stands beside the paper's case; where it is the state of a nut, the screw has one with a preload.
_WITH_LOGS: Mapping[str, Mapping[str, Any]] = {
    "LogBody": {"log": {"name": "log.csv", "text": _LOG}},
    "FitBody": {"log": {"name": "log.csv", "text": _LOG}, "free": ["boundary_friction_coefficient"]},
    "HandOverBody": {"to": "linuxcnc", "options": {"joint": "1"}},
    "ServiceBody": {"new": {"name": "new.csv", "text": _NEW}, "worn": {"name": "worn.csv", "text": _WORN}},
    "ConditionBody": {"tests": [{"name": "tests.csv", "text": _TESTS}]},
}


def examples(body: str) -> dict[str, Any]:
    """Bodies to try, by name."""
    if body in _WITHOUT_CASE:
        name, example = _WITHOUT_CASE[body]
        return {name: dict(example)}
    paper: dict[str, Any] = vocabulary()["starts"]["paper"]["case"]
    nut = {
        "screw": {"catalogue": next(name for name, row in catalogue().items() if row.nut == "double")},
        "nut": {"preload": "7 %"},
        "bodies": {},
        "lubricant": {"grade": "ISO VG 100", "temperature": "40 degC"},
        "operation": {"axial_load": "2 kN", "screw_speed": "300 rpm"},
    }
    if body == "ProjectBody":
        return {"two": {"designs": [{"name": "paper", "case": paper}, {"name": "nut", "case": nut}]}}
    if body in _WITH_LOGS:
        if body in ("ServiceBody", "ConditionBody"):
            paper = {**paper, "nut": {"type": "double", "preload": "3 kN"}, "model": {"name": "olaru2005"}}
        return {"paper": {"case": paper, **_WITH_LOGS[body]}}
    if body in ("AxisBody", "DutyBody"):
        paper, nut = {**paper, **_MOVING}, {**nut, **_MOVING}
    if body == "WarmUpBody":
        paper = {**paper, "lubricant": {"grade": "ISO VG 100", "temperature": "40 degC"}}
    beside = _BESIDE.get(body, {})
    return {"paper": {"case": paper, **beside}, "nut": {"case": nut, **beside}}
