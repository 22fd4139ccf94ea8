"""At another breath organs and lung lie elsewhere in the picture, and the wall where it was."""

import numpy as np
import pytest
from scipy import ndimage
from test_imaging_scanned import volume_of

from app.core.transform import RigidTransform
from app.imaging import breath_layers
from app.imaging.breath_layers import RIBS, BreathShares, shares_of
from app.imaging.field import FieldTissue, TissueField, TissueKind
from app.imaging.scan_look import BreathPicture, ScanLook
from app.imaging.scan_order import ScanOrder
from app.imaging.scanned import scan_image
from app.imaging.volume import Volume
from app.simulation.bound_field import BoundField

SHIFT = np.array([1.0, -3.0, -12.0])
TARGET = np.array([-20.0, 0.0, 60.0])
TISSUES = tuple(FieldTissue(code, kind) for code, kind in enumerate(TissueKind))
CODES = {tissue.kind: tissue.code for tissue in TISSUES}
HU = {TissueKind.AIR: -1000, TissueKind.MUSCLE: 50, TissueKind.ORGAN: 100, TissueKind.LUNG: -800,
      TissueKind.BONE: 700}  # fmt: skip


def patient() -> tuple[TissueField, Volume]:
    """A trunk of 2 mm voxels: wall, spine and ribs about a liver with a lesion, lung above it."""
    k, j, i = np.mgrid[0:90, 0:80, 0:90]
    x, y, z = -90.0 + 2.0 * i, -80.0 + 2.0 * j, 2.0 * k
    radius = np.hypot(x / 85.0, y / 72.0)
    kinds = np.full(x.shape, CODES[TissueKind.AIR], np.uint8)
    kinds[radius < 1.0] = CODES[TissueKind.MUSCLE]
    inside = radius < 0.8
    kinds[inside] = CODES[TissueKind.ORGAN]
    kinds[inside & (z > 100.0)] = CODES[TissueKind.LUNG]
    kinds[(np.hypot(x, y - 62.0) < 9.0)] = CODES[TissueKind.BONE]
    ribs = (np.abs(radius - 0.86) < 0.04) & (np.abs((z % 24.0) - 12.0) < 5.0)
    kinds[ribs] = CODES[TissueKind.BONE]
    hu = np.zeros(x.shape, np.int16)
    for kind, value in HU.items():
        hu[kinds == CODES[kind]] = value
    hu[np.sqrt((x + 20.0) ** 2 + y**2 + (z - 60.0) ** 2) < 9.0] = 40
    affine = np.diag([2.0, 2.0, 2.0, 1.0])
    affine[:3, 3] = (-90.0, -80.0, 0.0)
    field = TissueField(kinds, np.full(kinds.shape, 127, np.int8), affine, TISSUES)
    return field, volume_of(hu, affine)


@pytest.fixture(scope="module")
def known() -> tuple[TissueField, Volume, BreathShares]:
    field, volume = patient()
    return field, volume, shares_of(field, TARGET)


def moved_by(shares: BreathShares, points: np.ndarray) -> np.ndarray:
    return points - shares.resting(points, SHIFT)


def test_the_target_goes_along_with_all_of_the_breath(known) -> None:
    _, _, shares = known
    np.testing.assert_allclose(moved_by(shares, (TARGET + SHIFT)[None])[0], SHIFT, rtol=0.04)


def test_the_wall_rests_the_spine_too_and_ribs_go_along_a_little(known) -> None:
    _, _, shares = known
    wall = np.array([[0.0, -68.0, 60.0], [-80.0, 0.0, 60.0], [0.0, 62.0, 60.0]])
    np.testing.assert_allclose(moved_by(shares, wall), 0.0, atol=0.05)
    rib = np.array([[0.0, -0.86 * 72.0, 60.0]])
    share = float(moved_by(shares, rib)[0, 2] / SHIFT[2])
    assert 0.0 < share <= RIBS + 1e-6


def test_the_lung_goes_along_at_its_base_and_not_at_its_apex(known) -> None:
    _, _, shares = known
    heights = np.array([104.0, 130.0, 150.0, 174.0])
    points = np.column_stack([np.full(4, -20.0), np.zeros(4), heights]) + SHIFT
    share = moved_by(shares, points)[:, 2] / SHIFT[2]
    assert (np.diff(share) < 0.0).all()
    assert share[0] > 0.9
    assert share[-1] < 0.2


def test_it_moves_as_the_simulated_tissue_does(known) -> None:
    """The picture, and what a needle feels, are computed apart: away from walls they agree."""
    field, _, shares = known
    pose = RigidTransform(np.eye(3), np.zeros(3))
    bound = BoundField(field, pose, TARGET * 1e-3)
    rng = np.random.default_rng(5)
    places = rng.uniform((-50.0, -40.0, 30.0), (50.0, 35.0, 170.0), (400, 3))
    places = places[np.abs(places[:, 2] - 100.0 + 6.0) > 14.0]  # not at the diaphragm
    places = places[np.hypot(places[:, 0] / 85.0, places[:, 1] / 72.0) < 0.68]  # nor at the wall
    felt = 1e3 * bound.at_rest(places * 1e-3, np.broadcast_to(SHIFT * 1e-3, places.shape))
    seen = shares.resting(places, SHIFT)
    away = np.linalg.norm(felt - seen, axis=1)
    assert np.median(away) < 0.05
    assert away.max() < 0.5


def test_the_picture_shows_the_lesion_moved_and_the_ribs_where_they_were(
    known, monkeypatch: pytest.MonkeyPatch
) -> None:
    _, volume, shares = known
    monkeypatch.setattr(breath_layers, "shares_of_ct", lambda *_: shares)
    target = (-20.0, 0.0, 60.0)
    order = ScanOrder(60.0 + SHIFT[2], 3, 4.0)
    rest = scan_image(volume, ScanOrder(60.0, 3, 4.0))
    layers = scan_image(volume, order, shift_mm=SHIFT,
                        look=ScanLook(breath=BreathPicture.LAYERS, target_mm=target))  # fmt: skip
    whole = scan_image(volume, order, shift_mm=SHIFT)
    still = scan_image(volume, order)

    def lesion(picture: Volume) -> np.ndarray:
        dark = (picture.hu > 0) & (picture.hu < 75)
        j, i = np.mgrid[0 : dark.shape[1], 0 : dark.shape[2]]
        near = np.hypot(2.0 * i - 90.0 + 20.0, 2.0 * j - 80.0) < 20.0
        return picture.lps_mm(np.array(ndimage.center_of_mass(dark & near))[::-1])

    np.testing.assert_allclose(lesion(layers) - lesion(rest), SHIFT, atol=0.8)
    bones = still.hu > 500
    assert (layers.hu[bones] > 300).mean() > 0.98
    assert (whole.hu[bones] > 300).mean() < 0.8
    outside = still.hu < -900
    assert (layers.hu[outside] < -900).all()


def test_without_a_shift_or_a_field_nothing_is_bent(monkeypatch: pytest.MonkeyPatch) -> None:
    _, volume = patient()
    look = ScanLook(breath=BreathPicture.LAYERS, target_mm=(-20.0, 0.0, 60.0))
    order = ScanOrder(60.0, 3, 4.0)
    monkeypatch.setattr(breath_layers, "shares_of_ct", lambda *_: None)
    np.testing.assert_array_equal(
        scan_image(volume, order, look=look).hu, scan_image(volume, order).hu
    )
    np.testing.assert_array_equal(
        scan_image(volume, order, shift_mm=SHIFT, look=look).hu,
        scan_image(volume, order, shift_mm=SHIFT).hu,
    )
