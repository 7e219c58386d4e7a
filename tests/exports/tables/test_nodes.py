"""Nodes of tables: analytic errors of chords."""

import numpy as np
import pytest

from ballscrew.exports.tables.friction_table import best_nodes, chord_errors, nodes_within

POSITIONS = np.linspace(0.0, 1.0, 101)
ONES = np.ones_like(POSITIONS)
PARABOLA = chord_errors(POSITIONS, POSITIONS**2, ONES)


@pytest.mark.parametrize("width", [0.1, 0.2, 0.5])
def test_a_parabola_has_nodes_a_width_apart(width):
    """A chord of x² over a width w is off by (w/2)² at most, in its middle."""
    nodes = nodes_within(PARABOLA, (width / 2) ** 2 + 1e-12)
    assert POSITIONS[nodes] == pytest.approx(np.arange(0.0, 1.0 + width / 2, width))


def test_the_best_nodes_of_a_parabola_are_even():
    assert POSITIONS[best_nodes(PARABOLA, 6)] == pytest.approx(np.linspace(0, 1, 6))


def test_a_kink_and_what_is_kept_are_nodes():
    kinked = chord_errors(POSITIONS, np.abs(POSITIONS - 0.37), ONES)
    assert POSITIONS[nodes_within(kinked, 1e-12)] == pytest.approx([0.0, 0.37, 1.0])
    assert POSITIONS[nodes_within(kinked, 1e-12, kept=[50])] == pytest.approx([0.0, 0.37, 0.5, 1.0])


def test_every_column_is_met_by_its_scale():
    two = np.column_stack([0 * POSITIONS, POSITIONS**2])
    scaled = chord_errors(POSITIONS, two, np.column_stack([ONES, 4 * ONES]))
    assert scaled == pytest.approx(PARABOLA / 4)
