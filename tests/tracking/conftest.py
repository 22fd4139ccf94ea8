"""Needles in front of simulated cameras, rendered once per test session."""

from collections.abc import Callable

import numpy as np
import pytest

from app.tracking.optics.rig import RigProfile, load_rig
from app.tracking.simulated.cameras import NeedleRenderer
from app.tracking.simulated.scene import MarkerScene

FULCRUM = np.array([0.0, 0.16056, 0.090])

SceneAt = Callable[[float, float, float], MarkerScene]


@pytest.fixture(scope="session")
def fulcrum() -> np.ndarray:
    return FULCRUM


@pytest.fixture(scope="session")
def wide() -> RigProfile:
    return load_rig("wide")


@pytest.fixture(scope="session")
def thesis() -> RigProfile:
    return load_rig("thesis")


@pytest.fixture(scope="session")
def wide_renderers(wide: RigProfile) -> tuple[NeedleRenderer, NeedleRenderer]:
    first, second = (
        NeedleRenderer(m, wide.needle, wide.blur_px, i) for i, m in enumerate(wide.models)
    )
    return first, second


@pytest.fixture(scope="session")
def scene_at(wide: RigProfile) -> SceneAt:
    """Scene of a needle through the fulcrum at (depth [m], tilt [deg], azimuth [deg])."""

    def make(depth: float, tilt_deg: float, azimuth_deg: float) -> MarkerScene:
        tilt, azimuth = np.deg2rad([tilt_deg, azimuth_deg])
        across = np.sin(tilt)
        axis = np.array([across * np.cos(azimuth), across * np.sin(azimuth), -np.cos(tilt)])
        return MarkerScene.from_tip(FULCRUM + depth * axis, axis, wide.needle.marker_offset)

    return make
