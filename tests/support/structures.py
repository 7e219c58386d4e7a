"""Configurations of each structure, points that vary all their numbers, and the model at these."""

from __future__ import annotations

from collections import OrderedDict

import numpy as np

import ballscrew as bs
from ballscrew.engine.evaluation import structures
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.engine.evaluation.plan import Configuration

OIL = bs.Lubricant.from_grade("ISO VG 100", 313.15)
SEALS = {"seals": bs.Seals(seal_torque=0.2)}
ROW = "rexroth-40x10x6-6-double"
NUTS = {
    "single": bs.SingleNut(),
    "single with seals": bs.SingleNut(losses=SEALS),
    "double": bs.DoubleNut(preload=4326.0, losses=SEALS),
    "offset lead": bs.OffsetLeadNut(preload=4326.0),
    "oversize": bs.OversizeBallNut(preload=2000.0),
}
MODELS = {
    "olaru2005": bs.FrictionModel.olaru2005,
    "corrected": bs.FrictionModel.corrected,
    "reference": bs.FrictionModel.reference,
}
CASES = [(nut, model) for nut in NUTS for model in MODELS if nut != "oversize" or model == "reference"]
#: Differences of large numbers, which are seen against the largest value of all points.
DIFFERENCES = frozenset({"deflection", "remaining_preload", "lift_off_load", "residual"})


def case_of(nut, model):
    screw = bs.catalogue()[ROW].screw(nut=NUTS[nut])
    return Configuration(MODELS[model](), screw, OIL)


def points_of(subject, names, count=64, seed=4):
    """All numbers varied by 10 %, loads and speeds in four quadrants, and zeros of both."""
    random = np.random.default_rng(seed)
    found = {
        name: float(subject.value_of(name)) * random.uniform(0.9, 1.1, count) for name in names if name not in OPERATION
    }
    for name in {"loaded_balls", "starts"} & found.keys():
        found[name] = np.round(found[name])
    found["axial_load"] = random.uniform(-20e3, 20e3, count)
    found["screw_speed"] = random.uniform(-100.0, 100.0, count)
    found["axial_load"][:4] = 0.0, -0.0, 0.0, 3e3
    found["screw_speed"][:4] = 10.0, 10.0, 0.0, 0.0
    return {name: found[name] for name in names}


def assert_same(found, expected):
    """To 1e-12, of differences and of parts of the torque by the largest of all points; truths and NaN exactly."""
    torque = np.nanmax(np.abs(expected["screw_torque"]))
    for name, values in expected.items():
        values = np.broadcast_to(values, found[name].shape)
        assert np.array_equal(np.isfinite(found[name]), np.isfinite(values)), name
        finite = np.isfinite(values)
        if found[name].dtype == bool:
            assert np.array_equal(found[name], values), name
            continue
        assert np.array_equal(found[name][~finite], values[~finite], equal_nan=True), name
        size = np.abs(values[finite])
        if name in DIFFERENCES:
            size = np.maximum(size, np.max(size, initial=0.0))
        if name.startswith("contribution_") or name.endswith("_torque"):
            size = np.maximum(size, torque)
        assert np.all(np.abs(found[name][finite] - values[finite]) <= 1e-12 * size), name


def by_model(subject, points, wanted):
    with np.errstate(all="ignore"):
        result = subject.at(points)
        return {name: np.asarray(output.read(result)) for name, output in wanted.items()}


def forget_structures(monkeypatch, folder=None):
    """No kernel of a structure is known to this process, as to a new one; with a folder, none is on disk either."""
    if folder is not None:
        monkeypatch.setenv("BALLSCREW_CACHE", str(folder))
    # what a process has in memory is private
    for name, empty in (("_found", OrderedDict()), ("_asked", OrderedDict()), ("impossible", set())):
        monkeypatch.setattr(structures.kept, name, empty)
