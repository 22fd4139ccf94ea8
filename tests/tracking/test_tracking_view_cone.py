"""What the two rigs see of the needle's cone."""

import numpy as np
import pytest

from app.core.transform import RigidTransform
from app.tracking.errors import RigError
from app.tracking.optics.rig import RangeProfile, view_cone

MM = 1e-3


def test_the_default_rig_sees_the_whole_cone(wide, fulcrum):
    cone = view_cone(wide.models, wide.needle, wide.range, fulcrum)
    assert cone.share == 1.0
    assert cone.losses() == ()
    for outline in cone.outlines:
        assert outline.min() >= 0.0
        assert (outline.max(axis=0) <= [639.0, 479.0]).all()


def test_the_thesis_rig_sees_its_own_range_and_a_third_of_the_needles(thesis, fulcrum):
    own = view_cone(thesis.models, thesis.needle, thesis.range, fulcrum)
    assert own.share == 1.0
    whole = RangeProfile(depth_min_mm=-30.0, depth_max_mm=120.0, tilt_max_deg=20.0)
    cone = view_cone(thesis.models, thesis.needle, whole, fulcrum)
    assert 0.25 < cone.share < 0.4
    assert cone.share_at(60 * MM, 90 * MM) == 1.0
    assert cone.share_at(-30 * MM, 25 * MM) == 0.0
    assert any("everything at -30" in text for text in cone.losses())


def test_a_camera_that_looks_away_sees_nothing_and_says_so(wide, fulcrum):
    left, right = wide.models
    away = RigidTransform(
        right.T_world_camera.rotation @ np.diag([-1.0, 1.0, -1.0]), right.T_world_camera.translation
    )
    turned = type(right)(right.name, right.intrinsics, right.distortion, right.image_size, away)
    cone = view_cone((left, turned), wide.needle, wide.range, fulcrum)
    assert cone.share == 0.0
    assert cone.shares == (1.0, 0.0)
    assert cone.outlines[1].shape == (0, 2)
    assert cone.losses() == ("right sees nothing of it: the camera looks another way",)


def test_a_range_upside_down_is_refused(wide, fulcrum):
    reach = RangeProfile(depth_min_mm=90.0, depth_max_mm=60.0, tilt_max_deg=20.0)
    with pytest.raises(RigError, match="swap depth_min_mm"):
        view_cone(wide.models, wide.needle, reach, fulcrum)
