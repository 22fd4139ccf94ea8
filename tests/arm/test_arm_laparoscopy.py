"""Tool, trocar and table: room for a shaft aslant, holes wide enough, tools long enough."""

import numpy as np
import pytest

from app.arm.laparoscopy import (
    CLEAR_OF_SKIN,
    FLATTEST,
    LEAN,
    RING_HALF,
    SURROUNDINGS,
    ToolBody,
    TrocarRing,
)
from app.core.arrays import angle_between
from app.mechanisms.errors import MechanismError

P = np.array([0.16, 0.0, 0.002])


def leaning(tilt, azimuth=0.3):
    across = np.sin(tilt) * np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
    return across - np.cos(tilt) * np.array([0.0, 0.0, 1.0])


def test_the_room_in_the_ring_is_that_of_points_on_the_shaft():
    ring = TrocarRing(P, [0.1, -0.2, 1.0])
    first = np.cross(ring.normal_world, [1.0, 0.0, 0.0])
    first /= np.linalg.norm(first)
    second = np.cross(ring.normal_world, first)
    for tilt in (0.0, 0.2, 0.5):
        axis, radius = leaning(tilt), 0.005
        u = np.cross(axis, [0.0, 1.0, 0.0])
        u /= np.linalg.norm(u)
        v = np.cross(axis, u)
        turn = np.linspace(0.0, 2.0 * np.pi, 20_001)[:, None]
        rim = radius * (np.cos(turn) * u + np.sin(turn) * v)
        farthest = 0.0
        for height in (-RING_HALF, RING_HALF):
            # where the lines of the shaft cross either face of the ring
            along = (height - rim @ ring.normal_world) / float(axis @ ring.normal_world)
            places = rim + along[:, None] * axis
            aside = np.hypot(places @ first, places @ second)
            farthest = max(farthest, float(aside.max()))
        assert ring.room(axis, 2.0 * radius) == pytest.approx(ring.inner - farthest, abs=1e-8)


def test_a_shaft_in_the_rings_plane_has_no_room():
    assert TrocarRing(P, [0.0, 0.0, 1.0]).room(np.array([1.0, 0.0, 0.0]), 0.01) == -np.inf


def test_the_ring_lies_flat_and_leans_only_by_what_a_path_leans_too_much():
    for tilt in (0.0, 0.5 * LEAN, LEAN):
        assert TrocarRing.guiding(P, leaning(tilt)).normal_world.tolist() == [0.0, 0.0, 1.0]
    for tilt in (LEAN + 1e-9, LEAN + 0.1, 1.0):
        axis = leaning(tilt)
        ring = TrocarRing.guiding(P, axis)
        assert angle_between(-axis, ring.normal_world) == pytest.approx(LEAN, abs=1e-12)
        assert angle_between([0.0, 0.0, 1.0], ring.normal_world) == pytest.approx(
            tilt - LEAN, abs=1e-12
        )
        assert ring.room(axis, 0.010) > 0.001


def test_a_tool_is_long_enough_that_the_hand_stays_clear_of_the_skin():
    plain = ToolBody()
    assert plain.grip == pytest.approx(0.120)
    assert plain.reaching(0.05).length == pytest.approx(plain.length)
    assert plain.reaching(0.02).length == plain.length
    assert plain.reaching(0.02).mass == pytest.approx(plain.mass)
    deep = plain.reaching(0.12)
    assert deep.length - deep.grip == pytest.approx(0.12 + CLEAR_OF_SKIN)
    assert deep.grip == plain.grip
    volume = [
        body.handle_diameter**2 * body.handle_length
        + body.shaft_diameter**2 * (body.length - body.point_length - body.handle_length)
        for body in (plain, deep)
    ]
    assert deep.mass / plain.mass == pytest.approx(volume[1] / volume[0])


def test_holes_let_the_shaft_through_and_a_flatter_path_is_refused():
    holed = [box for box in SURROUNDINGS if box.hole]
    assert {box.name for box in holed} == {"skin", "table"}
    for tilt in (0.0, 0.4, FLATTEST):
        for box in holed:
            hole = box.open_for(P, leaning(tilt), 0.005).hole
            deep = P[2] - box.low[2]
            assert hole >= deep * np.tan(tilt) + 0.005 / np.cos(tilt) + 0.0039
            assert hole >= box.hole
    solid = next(box for box in SURROUNDINGS if not box.hole)
    assert solid.open_for(P, leaning(1.5), 0.005) is solid
    with pytest.raises(MechanismError, match="leans 61° from straight down"):
        holed[0].open_for(P, leaning(np.radians(61.0)), 0.005)
