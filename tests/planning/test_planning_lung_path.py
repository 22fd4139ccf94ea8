"""The path report in bodies whose distances and angles are known by formula."""

from dataclasses import replace

import numpy as np
import pytest
from field_rig import ball, beyond, field_of_shapes

from app.imaging.field import TissueKind
from app.imaging.series import Series
from app.imaging.volume import Volume
from app.planning.errors import PlanError
from app.planning.lung_path.reporting import LungPaths
from app.planning.lung_path.sentences import lung_sentences
from app.planning.lung_path.values import LOOK_MM, LungPathReport
from app.planning.lung_path.walls import diameter_mm

Kind = TissueKind
PLEURA, FISSURE = 25.0, 55.0
"""Depth of the pleura and, on the path straight in, of the fissure [mm]."""


def rod(y, z, radius, x=None):
    """Return a rod along x, or along z at an x."""
    if x is None:
        return lambda p: np.hypot(p[:, 1] - y, p[:, 2] - z) - radius
    return lambda p: np.hypot(p[:, 0] - x, p[:, 1] - y) - radius


def within(first, second):
    return lambda p: np.maximum(first(p), second(p))


LUNG = beyond((0, 1, 0), PLEURA)
TILTED = beyond((0, 1, 1), FISSURE / np.sqrt(2.0))


def chest(*more, lobes=True, spacing=1.0):
    """Skin at y = 0, lung from 25 mm, a fissure at 45°, feet at negative z; what is laid over."""
    lung = [(Kind.LUNG, "", LUNG)]
    if lobes:
        lung = [
            (Kind.LUNG, "right upper lobe", LUNG),
            (Kind.LUNG, "right lower lobe", within(LUNG, TILTED)),
        ]
    shapes = [
        (Kind.AIR, "", lambda p: np.full(len(p), -50.0)),
        (Kind.MUSCLE, "", beyond((0, 1, 0), 0.0)),
        *lung,
        *more,
    ]
    size = tuple(round(mm / spacing) + 1 for mm in (120.0, 120.0, 100.0))
    return field_of_shapes(shapes, (-60.31, -10.17, -50.23), size, spacing)


RIBS = (
    (Kind.BONE, "rib", rod(15.0, -12.0, 5.0)),
    (Kind.BONE, "rib", rod(15.0, 14.0, 5.0)),
)
ARTERY = (Kind.VESSEL, "intercostal artery", rod(20.0, 7.0, 1.2))
CANAL = (Kind.ORGAN, "spinal canal", rod(20.0, 0.0, 8.0, x=-50.0))
ENTRY, TARGET = np.zeros(3), np.array([0.0, 90.0, 0.0])


def test_pleura_and_fissure_are_crossed_where_and_as_steeply_as_the_planes_say():
    report = LungPaths(chest()).report(ENTRY, TARGET)
    (pleura,), (fissure,) = report.pleura, report.fissures
    assert pleura.depth_mm == pytest.approx(PLEURA, abs=0.1)
    assert pleura.angle_deg == pytest.approx(0.0, abs=1.0)
    assert pleura.goes_in
    assert fissure.depth_mm == pytest.approx(FISSURE, abs=0.1)
    assert fissure.angle_deg == pytest.approx(45.0, abs=1.0)
    assert fissure.beyond == "right lower lobe"
    assert report.lung_mm == pytest.approx(65.0, abs=0.1)


@pytest.mark.parametrize("degrees", [10.0, 30.0, 50.0])
def test_the_angle_at_the_pleura_is_that_to_its_normal(degrees):
    end = 90.0 * np.array([np.tan(np.radians(degrees)) * 0.5, 1.0, 0.0])
    report = LungPaths(chest()).report((-end[0], 0.0, 0.0), (end[0], 90.0, 0.0))
    assert report.pleural_deg == pytest.approx(degrees, abs=1.0)


def test_a_path_out_of_the_lung_and_in_again_crosses_three_pleurae():
    wall = (Kind.MUSCLE, "", within(beyond((0, 1, 0), 40.0), beyond((0, -1, 0), -48.0)))
    report = LungPaths(chest(wall)).report(ENTRY, TARGET)
    assert [one.goes_in for one in report.pleura] == [True, False, True]
    assert report.lung_mm == pytest.approx(57.0, abs=0.2)


@pytest.mark.long("statistics")
def test_vessel_nodule_and_bronchus_within_the_lung_cross_no_pleura():
    more = (
        (Kind.VESSEL, "lung vessel", rod(35.0, 0.0, 2.5)),
        (Kind.LUNG, "bronchus", rod(70.0, 0.0, 2.0)),
        (Kind.ORGAN, "lung nodule", ball((0, 90, 0), 6.0)),
    )
    report = LungPaths(chest(*more)).report(ENTRY, TARGET)
    assert len(report.pleura) == len(report.fissures) == 1
    assert report.lung_mm == pytest.approx(59.0, abs=0.3)  # up to the nodule
    (vessel,), (bronchus,) = report.vessels, report.bronchi
    assert (vessel.name, vessel.away_mm) == ("lung vessel", 0.0)
    assert vessel.diameter_mm == pytest.approx(5.0, abs=0.5)
    assert vessel.depth_mm == pytest.approx(35.0, abs=1.5)
    assert bronchus.diameter_mm == pytest.approx(4.0, abs=0.5)


@pytest.mark.long("statistics")
@pytest.mark.parametrize("radius", [1.5, 2.0, 2.5, 3.0, 4.0])
@pytest.mark.parametrize("aside", [0.0, 0.37])
def test_a_tube_is_as_wide_as_it_is(radius, aside):
    field = chest((Kind.VESSEL, "lung vessel", rod(40.3, aside, radius)), lobes=False)
    code = next(one.code for one in field.tissues if one.name == "lung vessel")
    off = np.array([0.0, 40.3 + 0.5 * radius, aside])
    assert diameter_mm(field, code, off) == pytest.approx(2.0 * radius, abs=0.5)


@pytest.mark.long("statistics")
def test_thin_vessels_are_not_named_and_wide_ones_beside_the_path_are_with_their_room():
    thin = (Kind.VESSEL, "lung vessel", rod(35.0, 0.0, 1.0))
    assert LungPaths(chest(thin)).report(ENTRY, TARGET).vessels == ()
    beside = (Kind.VESSEL, "lung vessel", rod(40.0, 4.5, 2.5))
    (near,) = LungPaths(chest(beside)).report(ENTRY, TARGET).vessels
    assert near.away_mm == pytest.approx(2.0, abs=0.4)
    far = (Kind.VESSEL, "lung vessel", rod(40.0, 7.5, 2.5))
    assert LungPaths(chest(far)).report(ENTRY, TARGET).vessels == ()


@pytest.mark.long("statistics")
def test_ribs_and_intercostal_vessels_are_as_far_as_the_rods_say():
    report = LungPaths(chest(*RIBS, ARTERY, CANAL)).report(ENTRY, TARGET)
    assert report.rib_below_mm == pytest.approx(7.0, abs=0.3)
    assert report.rib_above_mm == pytest.approx(9.0, abs=0.3)
    assert report.rib_mm == report.rib_below_mm
    assert report.rib_below_at == pytest.approx((0.0, 15.0, -7.0), abs=1.0)
    assert report.intercostal_mm == pytest.approx(5.8, abs=0.3)


@pytest.mark.long("statistics")
def test_a_rib_that_is_met_is_0_away_and_the_other_keeps_its_distance():
    report = LungPaths(chest(*RIBS)).report((0.0, 0.0, 10.5), (0.0, 90.0, 10.5))
    assert report.rib_above_mm == 0.0
    assert report.rib_below_mm == pytest.approx(17.5, abs=0.5)


@pytest.mark.long("statistics")
@pytest.mark.parametrize(("x", "protects"), [(0.0, False), (9.0, False), (12.0, True)])
def test_within_6_cm_of_the_spine_the_ribs_border_does_not_protect(x, protects):
    report = LungPaths(chest(*RIBS, CANAL)).report((x, 0.0, 0.0), (x, 90.0, 0.0))
    assert report.spine_mm == pytest.approx(50.0 + x, abs=0.5)
    assert report.is_protected is protects


@pytest.mark.long("statistics")
def test_a_spine_that_nobody_named_is_found_by_its_thick_bone():
    bone = (Kind.BONE, "", rod(20.0, 0.0, 12.0, x=-45.0))
    field = chest(bone)
    report = LungPaths(field).report(ENTRY, TARGET)
    assert report.spine_mm == pytest.approx(45.0, abs=1.0)


def test_what_nobody_labelled_is_not_known_and_never_0():
    report = LungPaths(chest(lobes=False)).report(ENTRY, TARGET)
    for name in (
        *("fissures", "emphysema_mm", "rib_below_mm", "rib_above_mm", "intercostal_mm"),
        *("spine_mm", "is_protected", "vessels", "bronchi"),
    ):
        assert getattr(report, name) is None, name
    assert report.lung_mm == pytest.approx(65.0, abs=0.1)
    said = lung_sentences(report)
    assert sum(line.endswith(": not known") for line in said) == 9
    assert not any(": 0" in line for line in said)


def test_a_path_into_what_nobody_labelled_has_no_lengths():
    field = chest()
    labels = field.labels.copy()
    labels[:, 71:] = 0  # y from 60 mm on
    report = LungPaths(replace(field, labels=labels)).report(ENTRY, TARGET)
    assert report.unknown_mm == pytest.approx(30.0, abs=1.0)
    assert (report.pleura, report.fissures, report.lung_mm) == (None, None, None)


def test_ribs_beyond_the_end_of_the_labels_are_not_known():
    field = chest(RIBS[0])
    labels = field.labels.copy()
    labels[63:] = 0  # z from 12 mm on
    report = LungPaths(replace(field, labels=labels)).report(ENTRY, TARGET)
    assert report.rib_below_mm == pytest.approx(7.0, abs=0.3)
    assert report.rib_above_mm is None
    assert LungPaths(field).report(ENTRY, TARGET).rib_above_mm == LOOK_MM


def test_a_path_that_misses_the_lung_is_one_line():
    with pytest.raises(PlanError) as error:
        LungPaths(chest()).report(ENTRY, (0.0, 20.0, 0.0))
    assert str(error.value) == "this path does not go through the lung"
    bare = field_of_shapes([(Kind.FAT, "", LUNG)], (0.1, 0.1, 0.1), (5, 60, 5))
    with pytest.raises(PlanError, match="no lung is labelled"):
        LungPaths(bare).report((2, 30, 2), (2, 50, 2))


@pytest.mark.long("statistics")
def test_emphysema_is_by_its_label_else_by_the_values_of_the_ct():
    bulla = (Kind.LUNG, "emphysema", ball((0, 40, 0), 5.0))
    assert LungPaths(chest(bulla)).report(ENTRY, TARGET).emphysema_mm == pytest.approx(10, abs=0.3)
    z, y, x = np.mgrid[-50:51, -10:111, -60:61]
    hu = np.where(np.sqrt(x**2 + (y - 40) ** 2 + z**2) < 8.0, -975, -860)
    hu = hu + np.random.default_rng(1).normal(0.0, 25.0, hu.shape)
    affine = np.eye(4)
    affine[:3, 3] = (-60.0, -10.0, -50.0)
    volume = Volume(hu.astype(np.int16), affine, Series.__new__(Series))
    report = LungPaths(chest(lobes=False), volume).report(ENTRY, TARGET)
    # the mean over 3 mm takes about a millimetre off each end of the 16
    assert report.emphysema_mm == pytest.approx(13.7, abs=1.0)
    no_units = Volume(volume.hu, affine, volume.series, unit="")
    assert LungPaths(chest(lobes=False), no_units).report(ENTRY, TARGET).emphysema_mm is None


def test_the_nodule_that_values_take_for_a_vessel_is_neither_lung_nor_vessel():
    nodule = (Kind.VESSEL, "lung vessel", ball((0, 90, 0), 6.0))
    report = LungPaths(chest(nodule, lobes=False)).report(ENTRY, TARGET)
    assert report.lung_mm == pytest.approx(59.0, abs=0.3)
    assert all(one.depth_mm < 86.0 for one in report.vessels)


@pytest.mark.long("statistics")
def test_it_reads_back_what_it_wrote():
    for field in (chest(*RIBS, ARTERY, CANAL), chest(lobes=False)):
        report = LungPaths(field).report(ENTRY, TARGET)
        assert LungPathReport.of(report.document()) == report
    with pytest.raises(ValueError, match="inf"):
        LungPathReport.of(report.document() | {"length_mm": float("inf")})
