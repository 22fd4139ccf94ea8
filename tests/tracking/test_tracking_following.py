"""An encoder that stands still or counts backwards is found by what the cameras see turn."""

import numpy as np
import pytest

from app.mechanisms.profile import load_profile
from app.tracking.discrepancy import ENCODERS, DiscrepancyCause, DiscrepancyMonitor, Evidence
from app.tracking.following import Following, following

STUCK, REVERSED = DiscrepancyCause.ENCODER_STUCK, DiscrepancyCause.ENCODER_REVERSED
MACHINES = ("icube", "tensegrity")


def directions(tilt, azimuth):
    """Needle's directions, shape (n, 3)."""
    flat = np.sin(tilt)
    return np.column_stack([flat * np.cos(azimuth), flat * np.sin(azimuth), -np.cos(tilt)])


def swept(rng, n=200, largest=0.25):
    """Directions of a hand that looks for its way, some 14° about upright."""
    time = np.linspace(0.0, 10.0, n)
    tilt = largest * (0.6 + 0.4 * np.sin(1.7 * time + rng.uniform(0.0, 6.0)))
    return directions(tilt, 0.9 * time + rng.uniform(0.0, 6.0))


def read(name, true, joint, factor, since=0):
    """Directions by encoders of which one counts `factor` times what is so, from a row on."""
    machine = load_profile(name).machine
    q = np.array([machine.usable(axis) for axis in true])
    q[since:, joint] = q[since, joint] + factor * (q[since:, joint] - q[since, joint])
    return np.array([machine.axis(angles) for angles in q])


def evidence(true, axes, rng, depths=None, off=0.0):
    """What the cameras say: the band on the true needle, 0.2 mm of noise, moved by `off` [m]."""
    depths = rng.uniform(0.05, 0.1, len(true)) if depths is None else depths
    bands = depths[:, None] * true + rng.normal(0.0, 0.2e-3, true.shape) + off
    along = np.sum(bands * axes, axis=1)
    return along, bands - along[:, None] * axes


def verdict(true, axes, rng, **more):
    monitor = DiscrepancyMonitor()
    depths, beside = evidence(true, axes, rng, **more)
    for axis, depth, away in zip(axes, depths, beside, strict=True):
        monitor.add(Evidence(depth, away, 0.2e-3, rng.normal(), np.zeros(3), axis=axis))
    return monitor.verdict()


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("joint", [0, 1])
@pytest.mark.parametrize("name", MACHINES)
@pytest.mark.parametrize(("factor", "cause"), [(0.0, STUCK), (-1.0, REVERSED)])
def test_the_encoder_is_blamed_and_not_the_camera(name, joint, factor, cause, seed):
    rng = np.random.default_rng(seed)
    true = swept(rng)
    found = verdict(true, read(name, true, joint, factor), rng)
    assert found.cause is cause
    assert "encoder" in found.words
    assert found.cause in ENCODERS


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("name", MACHINES)
def test_encoders_that_count_are_never_blamed_whatever_cameras_and_needle_do(name, seed):
    rng = np.random.default_rng(100 + seed)
    true = swept(rng)
    axes = read(name, true, 0, 1.0)
    bend = 7e-3 * np.outer(rng.uniform(-1.0, 1.0, len(true)), [1.0, 0.0, 0.0])
    turned = true + 0.1 * np.cross(true, [1.0, 0.0, 0.0])
    turned /= np.linalg.norm(turned, axis=1, keepdims=True)
    for seen, off in ((true, 0.0), (true, [0.02, -0.01, 0.0]), (true, bend), (turned, 0.0)):
        assert verdict(seen, axes, rng, off=off).cause not in ENCODERS


def test_a_needle_that_is_held_still_says_nothing_of_the_encoders():
    rng = np.random.default_rng(1)
    true = np.tile([[0.1, 0.0, -0.995]], (100, 1))
    depths, beside = evidence(true, true, rng)
    assert following(true, depths, beside) is Following.UNKNOWN


@pytest.mark.parametrize("share", [0.3, 0.6])
def test_an_encoder_that_stops_within_the_window_is_found_before_it_has_passed(share):
    rng = np.random.default_rng(2)
    true = swept(rng, n=300)
    since = round(share * 100)
    found = verdict(true, read("icube", true, 0, 0.0, since), rng)
    assert found.cause is STUCK


def test_a_band_at_the_fulcrum_says_no_direction():
    rng = np.random.default_rng(3)
    true = swept(rng)
    depths, beside = evidence(true, true, rng, depths=np.full(len(true), 0.01))
    assert following(true, depths, beside) is Following.UNKNOWN
