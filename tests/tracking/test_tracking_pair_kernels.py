"""The compiled way from two pixels to the point, against the same steps in plain numpy."""

import numpy as np
import pytest

from app.tracking.fix import FixStatus
from app.tracking.markers.extractor import Centre
from app.tracking.markers.silhouette import centroid_shift
from app.tracking.optics.rig import load_rig
from app.tracking.solver import FixSolver, SeenMarker, systematic_px
from app.tracking.stereo.epipolar import essential_matrix
from tests.tracking.pair_reference import located_reference, off_line_reference, shift_reference


def _poses(rig, fulcrum, count, seed):
    rng = np.random.default_rng(seed)
    while count:
        tilt, azimuth = np.deg2rad(rng.uniform(0.0, 39.0)), rng.uniform(0.0, 6.28)
        across = np.sin(tilt)
        axis = np.array([across * np.cos(azimuth), across * np.sin(azimuth), -np.cos(tilt)])
        band = fulcrum + rng.uniform(-0.02, 0.10) * axis
        if all(model.sees(band)[0] for model in rig.models):
            count -= 1
            yield band, axis, rng


@pytest.mark.long("statistics")
@pytest.mark.parametrize("name", ["wide", "thesis"])
def test_the_outlines_shift_is_that_of_polygons_in_numpy_and_of_opencv(name, fulcrum):
    rig = load_rig(name)
    for band, axis, _ in _poses(rig, fulcrum, 40, 1):
        for model in rig.models:
            found = centroid_shift(model, rig.needle.shape, band, axis)
            assert found == pytest.approx(
                shift_reference(model, rig.needle.shape, band, axis), abs=1e-9
            )
            assert found == pytest.approx(
                shift_reference(model, rig.needle.shape, band, axis, single=True), abs=2e-5
            )


@pytest.mark.parametrize("name", ["wide", "thesis"])
def test_fixes_are_those_of_the_steps_in_numpy(name, fulcrum):
    rig = load_rig(name)
    solver, needle = FixSolver(rig, fulcrum), rig.needle
    line, systematic = (rig.line_sd_mm * 1e-3) ** 2, systematic_px(rig) ** 2 * np.eye(2)
    essential = essential_matrix(tuple(model.T_camera_world for model in rig.models))
    focal = np.concatenate([model.intrinsics[:2] for model in rig.models])
    for band, axis, rng in _poses(rig, fulcrum, 30, 2):
        pixels = np.array([m.pixel(band) for m in rig.models]) + rng.normal(0.0, 0.3, (2, 2))
        spreads = np.array([(a := rng.normal(0.0, 0.1, (2, 2))) @ a.T for _ in range(2)])
        spreads = spreads + 1e-3 * np.eye(2)
        centres = [Centre(name) for name in rng.choice(list(Centre), 2)]
        pair = [SeenMarker(*one) for one in zip(pixels, spreads, centres, strict=True)]
        fix = solver.solve((pair[0], pair[1]), axis, 0.0)
        outlines = [centre is Centre.OUTLINE for centre in centres]
        known = located_reference(
            rig.models, needle.shape, pixels, spreads + systematic, outlines, axis
        )
        off_line, beside = off_line_reference(known, known.covariance, fulcrum, axis, line)
        assert fix.p_tip_world == pytest.approx(
            known.p_world + needle.marker_offset * axis, abs=1e-9
        )
        assert fix.covariance == pytest.approx(known.covariance, rel=1e-9, abs=1e-18)
        assert fix.beside == pytest.approx(beside, abs=1e-9)
        first, second = (np.append(xy, 1.0) for xy in known.observations)
        signed = np.copysign(np.sqrt(known.chi_square), second @ essential @ first)
        assert fix.epipolar == pytest.approx(signed, rel=1e-6, abs=1e-9)
        assert fix.residual_px == pytest.approx(
            np.sqrt(np.mean((known.residual * focal) ** 2)), abs=1e-6
        )
        assert fix.depth_variance == pytest.approx(axis @ known.covariance @ axis, rel=1e-9)
        fine = off_line <= 23.02 and known.chi_square <= 19.5
        assert (fix.status is FixStatus.VALID) is fine


def test_pixels_that_are_no_numbers_or_lie_beyond_the_fold_give_a_reason(wide, fulcrum):
    solver, axis, spread = FixSolver(wide, fulcrum), np.array([0.0, 0.0, -1.0]), np.eye(2)
    good = SeenMarker(wide.models[1].pixel(fulcrum + 0.05 * axis), spread)
    for pixel in ([np.nan, 1.0], [np.inf, 0.0], [1e300, -1e300]):
        fix = solver.solve((SeenMarker(np.array(pixel), spread), good), axis, 0.0)
        assert fix.status is FixStatus.INCONSISTENT
        assert not fix.has_point
        assert np.isfinite(fix.p_tip_world).all()
        assert fix.reason
