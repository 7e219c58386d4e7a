"""Fits in less time."""

import pytest

from ballscrew.evidence.calibration import baselines


@pytest.fixture
def quick_baselines(monkeypatch):
    """No search for the baseline that a fit is compared with, for tests that look at the estimates of many fits."""
    monkeypatch.setattr(baselines, "STRIBECK_SHARES", baselines.STRIBECK_SHARES[-1:])
