"""A plan: what is found once for all points."""

import ballscrew as bs
from ballscrew.engine.evaluation import plan
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW


def test_the_inputs_of_a_configuration_are_found_once(monkeypatch):
    found = []
    inputs_of = plan.inputs_of
    monkeypatch.setattr(plan, "inputs_of", lambda *parts: (found.append(parts), inputs_of(*parts))[1])
    bs.sweep(bs.FrictionModel.reference(), SCREW, OIL, axial_load=[100.0, 2000.0], screw_speed=[10.0, 60.0])
    assert len({id(parts[1]) for parts in found}) == len(found) > 0
