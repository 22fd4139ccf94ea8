"""The shipped rigs keep what they promise."""

import numpy as np
import pytest

from app.core.configuration import ConfigurationError
from app.tracking.errors import RigError
from app.tracking.optics.rig import load_rig, shipped_rigs


def _whole_range(fulcrum, offset, depths, tilts):
    azimuths = np.deg2rad(np.arange(0.0, 360.0, 7.5))
    for tilt in np.deg2rad(tilts):
        axes = np.column_stack(
            [
                np.sin(tilt) * np.cos(azimuths),
                np.sin(tilt) * np.sin(azimuths),
                np.full_like(azimuths, -np.cos(tilt)),
            ]
        )
        for depth in depths:
            yield fulcrum + (depth - offset) * axes


def test_the_wide_rig_shows_the_marker_in_both_pictures_over_its_whole_declared_range(
    wide, fulcrum
):
    profile = wide.range
    assert profile.depth_min_mm <= -30.0
    assert profile.depth_max_mm >= 120.0
    assert profile.tilt_max_deg >= 39.0
    depths = np.arange(profile.depth_min_mm, profile.depth_max_mm + 0.1, 2.5) * 1e-3
    tilts = np.append(np.arange(0.0, profile.tilt_max_deg, 3.0), profile.tilt_max_deg)
    for points in _whole_range(fulcrum, wide.needle.marker_offset, depths, tilts):
        for model in wide.models:
            nearest = (model.T_camera_world @ points)[:, 2].min()
            half_band = wide.needle.shape.half + wide.needle.shape.radius
            band_px = half_band * model.intrinsics[0] / nearest
            assert model.sees(points, margin_px=band_px + 8.0).all()


def test_rays_of_the_wide_rig_meet_at_a_good_angle_everywhere(wide, fulcrum):
    for points in _whole_range(fulcrum, wide.needle.marker_offset, [-0.03, 0.05, 0.12], [0, 39]):
        rays = [points - model.centre for model in wide.models]
        rays = [ray / np.linalg.norm(ray, axis=1, keepdims=True) for ray in rays]
        angle = np.rad2deg(np.arccos((rays[0] * rays[1]).sum(axis=1)))
        assert angle.min() > 60.0
        assert angle.max() < 100.0


def test_the_thesis_rig_sees_only_part_of_the_range(thesis, fulcrum):
    offset = thesis.needle.marker_offset

    def share(depth):
        seen = [
            thesis.models[0].sees(p) & thesis.models[1].sees(p)
            for p in _whole_range(fulcrum, offset, [depth], [0, 10, 20, 30, 39])
        ]
        return np.concatenate(seen).mean()

    assert share(-0.02) == 0.0
    assert share(0.02) == 0.0
    assert share(0.075) > 0.9
    assert 0.1 < share(0.105) < 0.9


def test_the_thesis_rig_has_the_published_baseline_and_angle(thesis):
    left, right = thesis.models
    assert np.linalg.norm(left.centre - right.centre) == pytest.approx(0.2235, abs=1e-3)
    axes = [model.T_world_camera.rotation[:, 2] for model in (left, right)]
    assert np.rad2deg(np.arccos(axes[0] @ axes[1])) == pytest.approx(102.1, abs=0.2)


def test_an_unknown_rig_is_named_with_the_ones_there_are():
    assert {"wide", "thesis"} <= set(shipped_rigs())
    with pytest.raises(RigError, match=r"'narrow'.*thesis.*wide"):
        load_rig("narrow")


def test_a_camera_looking_straight_down_is_refused(tmp_path):
    from app.core import paths

    text = (paths.resources() / "cameras" / "wide.yaml").read_text()
    path = tmp_path / "down.yaml"
    path.write_text(text.replace("[270.0, 482.3, 51.0]", "[0.0, 160.56, 400.0]", 1))
    with pytest.raises(RigError, match="left"):
        load_rig(path)
    path.write_text(text.replace("rate_hz: 30.0", "rate_hz: -1.0"))
    with pytest.raises(ConfigurationError, match="rate_hz"):
        load_rig(path)
