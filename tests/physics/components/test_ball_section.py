"""The section across the path of a ball: circles touch it, meet at the bottom of the groove, and end at its edge."""

import math

import numpy as np
import pytest

from ballscrew.physics.components.materials import LAND
from ballscrew.physics.equations import geometry
from ballscrew.physics.friction.ball_section import Arc, contact_width, land_height

RADIUS, CONFORMITY, ANGLE = 3e-3, 0.54, math.radians(42.0)
SIDES = [(outward, loaded) for outward in (1, -1) for loaded in (True, False)]


def arc(outward, loaded, angle=ANGLE):
    return Arc.of(RADIUS, CONFORMITY, angle, loaded=loaded, outward=outward)


@pytest.mark.parametrize(("outward", "loaded"), SIDES)
def test_the_arc_touches_the_ball(outward, loaded):
    """Ball and groove share the contact and its normal: their middles and the contact are on one line."""
    one = arc(outward, loaded)
    assert np.hypot(*one.contact) == pytest.approx(RADIUS, rel=1e-15)
    assert np.hypot(*np.subtract(one.contact, one.middle)) == pytest.approx(one.radius, rel=1e-15)
    assert np.subtract(one.contact, one.middle) == pytest.approx(one.radius * np.array(one.normal), rel=1e-12)
    assert one.radius == 2 * CONFORMITY * RADIUS
    # a nut is pressed on its right, then the screw on its left
    assert math.copysign(1, one.contact[0]) == (1 if loaded else -1) * outward
    assert math.copysign(1, one.contact[1]) == outward


@pytest.mark.parametrize("angle", [0.2, ANGLE, 1.2])
def test_the_bottom_is_that_of_the_root_diameter(angle):
    """The published diameter at the bottom of a gothic arch, from another formula."""
    pitch = 0.04
    root = geometry.groove_root_diameter(pitch, 2 * RADIUS, CONFORMITY, angle)
    for loaded in (True, False):
        across, up = arc(-1, loaded, angle).bottom
        assert (across, pitch + 2 * up) == (0.0, pytest.approx(root, rel=1e-14))


@pytest.mark.parametrize(("outward", "loaded"), SIDES)
def test_edge_and_ends_lie_on_the_arc(outward, loaded):
    one = arc(outward, loaded)
    near, far = one.around(0.8e-3)
    edge = one.edge(0.9e-3)
    for place in (near, far, edge, one.bottom):
        assert np.hypot(*np.subtract(place, one.middle)) == pytest.approx(one.radius, rel=1e-12)
    assert edge[1] == outward * 0.9e-3
    assert abs(near[0]) < abs(one.contact[0]) < abs(far[0]) < abs(edge[0])
    # along the arc, both ends are half the width from the contact
    for place in (near, far):
        chord = np.hypot(*np.subtract(place, one.contact))
        assert 2 * one.radius * math.asin(chord / (2 * one.radius)) == pytest.approx(0.8e-3, rel=1e-12)


def test_both_flanks_are_each_others_mirror_image():
    right, left = arc(1, True), arc(1, False)
    assert right.edge(1e-3) == (-left.edge(1e-3)[0], left.edge(1e-3)[1])
    assert right.bottom == left.bottom
    # the groove of the screw is that of the nut, turned by half a turn
    assert np.array(arc(-1, True).contact) == pytest.approx(-np.array(right.contact), rel=1e-15)


def test_lands_leave_the_contacts_inside_the_groove():
    for angle in (0.1, 0.8, 1.3, 1.5):
        assert 0 < land_height(RADIUS, angle) < RADIUS * math.cos(angle)
    assert land_height(RADIUS, 0.5) == LAND * RADIUS


def test_the_width_follows_the_cube_root_of_the_load():
    """Hertz: eight times the load, twice the width."""
    assert contact_width(1e-3, 100.0, 800.0) == pytest.approx(0.5e-3, rel=1e-14)
