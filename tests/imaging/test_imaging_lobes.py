"""Patients from seed 2000 on: lobes, fissures, bronchi, emphysema and intercostal vessels."""

import hashlib

import numpy as np
import pytest

from app.core.progress import Progress
from app.imaging.field import TissueKind
from app.imaging.field.from_recipe import field_of_recipe
from app.imaging.field.grid import FieldGrid
from app.imaging.phantom import organs
from app.imaging.phantom.lesion import make_patient
from app.imaging.phantom.lobes import LOBES, RIGHT_LOWER, fissures, lobes
from app.imaging.phantom.patient import draw_patient
from app.imaging.phantom.series import Scan
from app.imaging.phantom.skeleton import RIBS
from app.imaging.phantom.thorax import ARTERY_MM, WALL_SHARE, emphysema, intercostals, lung_tubes
from app.studies.references.recipe_points import RecipePoints

BEFORE = {
    1: ("b731048b1b343dc6", "a6e83ee034b64bbd"),
    999: ("e00803d8feda693c", "9466edd2f79ec286"),
    1001: ("180f34f1867d42f0", "ec02705e0e9aef16"),
    1999: ("8fc459d97141a2d7", "40778e66c572b590"),
}
"""Digests of some slices, and of a coarse field, before there were patients with lobes."""


def place(patient, points):
    return organs.place_of(patient, *np.asarray(points, float).T)


@pytest.mark.long("statistics")
@pytest.mark.parametrize("seed", BEFORE)
def test_patients_of_smaller_seeds_are_the_same_to_the_last_bit(seed):
    scan, slices = Scan(make_patient(seed), 96, 4.0), hashlib.sha256()
    for index, z in enumerate((40.0, 130.0, 215.0, 262.0, 281.0, 297.0)):
        slices.update(scan.slice_hu(z, index).tobytes())
    affine = np.diag([4.0, 4.0, 4.0, 1.0])
    affine[:3, 3] = (-180, -120, 0)
    field = field_of_recipe(seed, FieldGrid((76, 61, 91), affine, 4.0, None, 0.0), Progress())
    assert (slices.hexdigest()[:16], field.digest[:16]) == BEFORE[seed]


@pytest.mark.long("statistics")
@pytest.mark.parametrize("seed", [2000, 2001, 2005])
def test_the_nodule_lies_in_the_lower_lobe_clear_of_every_fissure(seed):
    patient = make_patient(seed)
    centre, radius = patient.nodule
    at = place(patient, [centre])
    assert lobes(patient, at)[RIGHT_LOWER][0] < -radius - 3.0
    assert radius + 3.0 < fissures(patient).away(at)[0] < radius + 13.0


@pytest.mark.long("statistics")
@pytest.mark.parametrize("seed", [2000, 2003])
def test_vessels_and_bronchi_keep_to_one_lobe_and_bronchi_end_at_a_radius(seed):
    patient = make_patient(seed)
    for tubes in lung_tubes(patient):
        x, y, z, radius = tubes.balls.T
        deep = -np.min(list(lobes(patient, organs.place_of(patient, x, y, z)).values()), axis=0)
        assert (deep > radius).all()
    bronchi = lung_tubes(patient)[1].balls
    assert 1.4 < bronchi[:, 3].min() < 2.0 < bronchi[:, 3].max() < 3.6
    in_scan = bronchi[bronchi[:, 2] < 298.0]
    where = lobes(patient, place(patient, in_scan[:, :3]))
    assert all((where[name] < 0.0).any() for name in LOBES if "upper" not in name)


def test_emphysema_lies_in_the_scan_clear_of_nodule_and_fissures():
    patient = make_patient(2001)
    balls = emphysema(patient).balls
    x, y, z, radius = balls.T
    at = organs.place_of(patient, x, y, z)
    assert len(balls) >= 16
    assert (z < 300.0).all()
    assert (organs.lungs(patient, at) < -radius).all()
    assert (fissures(patient).away(at) > radius).all()
    away = np.linalg.norm(balls[:, :3] - patient.nodule[0], axis=1) - radius - patient.nodule[1]
    assert away.min() > 5.0


@pytest.mark.long("statistics")
def test_the_ct_shows_dark_emphysema_thin_fissures_and_bronchi_with_a_lumen():
    patient = make_patient(2000)
    scan, scale = Scan(patient, 512, 0.75), np.array(patient.scale)

    def around(point):
        """HU of 5 by 5 pixels about a place in its slice."""
        hu = scan.slice_hu(point[2] * scale[2], 3)
        column, row = np.rint(np.array(point[:2]) * scale[:2] / 0.75 + 255.5).astype(int)
        return hu[row - 2 : row + 3, column - 2 : column + 3].astype(float)

    widest = max(emphysema(patient).balls, key=lambda ball: ball[3] - abs(ball[2] - 280.0))
    assert around(widest[:3]).mean() < -945.0
    lung = np.array([-60.0, 45.0, 285.0])
    oblique = fissures(patient).right
    x, z = -90.0, 288.0
    heights = np.linspace(-90.0, 20.0, 2000)
    away = oblique.above(np.full(2000, x), heights, np.full(2000, z))
    y = heights[np.abs(away).argmin()]
    column = around((x, y, z))
    assert -840.0 < column.max() < -450.0  # a line, no wall
    assert column.max() > np.median(around(lung)) + 80.0
    bronchi = lung_tubes(patient)[1].balls
    inside = bronchi[(bronchi[:, 2] > 260.0) & (bronchi[:, 2] < 298.0)]
    wide = inside[inside[:, 3].argmax()]
    assert WALL_SHARE * wide[3] > 0.7
    # the lumen is darker than lung somewhere along it, its wall denser
    assert around(wide[:3]).min() < -880.0
    assert around(wide[:3]).max() > -650.0


@pytest.mark.long("statistics")
def test_the_rib_shields_the_artery_at_3_and_6_cm_as_often_as_is_published():
    """Helm et al. 2013, doi 10.1378/chest.12-1285: 17 % at 3 cm, 97 % at 6 cm."""
    shielded = {30.0: [], 60.0: []}
    for seed in range(2000, 2060):
        patient = draw_patient(seed)
        balls = intercostals(patient)[0].balls
        start = 0
        for rib in RIBS:
            length = len(np.arange(0.055, rib.end, 0.0011))
            for _ in range(2):
                part = balls[start : start + length]
                start += length
                p = np.abs(np.arctan2(part[:, 0], part[:, 1])) / np.pi
                aside = np.abs(part[:, 0]) * patient.scale[0]
                back = p < 0.5
                for at, found in shielded.items():
                    n = int(np.where(back, np.abs(aside - at), np.inf).argmin())
                    if abs(aside[n] - at) < 1.0:
                        border = float(rib.z(p[n])) - 6.4
                        found.append(part[n, 2] - ARTERY_MM > border)
    assert len(shielded[30.0]) > 900
    assert np.mean(shielded[30.0]) == pytest.approx(0.17, abs=0.04)
    assert np.mean(shielded[60.0]) == pytest.approx(0.97, abs=0.02)


@pytest.mark.long("statistics")
def test_the_field_has_lobes_emphysema_bronchi_and_intercostal_vessels_where_the_recipe_has_them():
    recipe, rng = RecipePoints(2000), np.random.default_rng(0)
    affine = np.eye(4)
    affine[:3, 3] = (-150.0, -110.0, 255.0)
    field = field_of_recipe(2000, FieldGrid((38, 180, 150), affine, 1.0, None, 0.0), Progress())
    points = affine[:3, 3] + rng.uniform(1.0, (148.0, 178.0, 36.0), (20_000, 3))
    told, right = field.codes_at(points), recipe.codes_at(points)
    assert np.mean(told == right) > 0.985
    names = {tissue.name: tissue for tissue in field.tissues}
    for name in ("emphysema", "bronchus", "intercostal artery", "intercostal vein", *LOBES[:3]):
        code = names[name].code
        assert np.mean(told[right == code] == code) > 0.6, name
    assert {names[name].kind for name in (*LOBES, "bronchus")} == {TissueKind.LUNG}
