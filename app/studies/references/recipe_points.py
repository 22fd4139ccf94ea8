"""What the built-in patient's recipe has at any point: its distance functions, without a grid.

For studies: `RecipePoints(seed).codes_at(points_mm)`, codes of `from_recipe.LOBED_TABLE`. It shares
the shapes with the field of the recipe, the order in which they are laid, its table of codes and
the diameter from which a vessel is a great one; it has no voxels, no table over the angle, no rule
between neighbours, and double precision. A wrong shape or name would be wrong in both.
"""

from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.imaging.field.from_recipe import GREAT_MM, LOBED_TABLE
from app.imaging.field.naming import BRONCHUS, EMPHYSEMA, LUNG_VESSEL, SMALL_VESSEL
from app.imaging.phantom import organs, skeleton, trunk
from app.imaging.phantom.lesion import make_patient
from app.imaging.phantom.lobes import lobes
from app.imaging.phantom.vessels import vasculature

Codes = NDArray[np.intp]

_CODE: Final = {tissue.name or tissue.kind.value: tissue.code for tissue in LOBED_TABLE}
_RUN: Final = 32  # points that lie beside each other, looked up among the same balls
_CHUNK: Final = 50_000


class RecipePoints:
    """The recipe of a patient, asked at points.

    Args:
        seed: of the patient.
    """

    def __init__(self, seed: int) -> None:
        self._patient = make_patient(seed)
        tubes = vasculature(self._patient)
        self._gut = (("small bowel", tubes.small_bowel.balls), ("colon", tubes.colon.balls))
        self._lung = tubes.lung.balls
        self._airways = (EMPHYSEMA, tubes.emphysema.balls), (BRONCHUS, tubes.bronchi.balls)
        self._intercostal = (
            ("intercostal vein", tubes.intercostal_veins.balls),
            ("intercostal artery", tubes.intercostal_arteries.balls),
        )
        great = {
            "vena cava": tubes.cava.balls,
            "portal vein": tubes.portal.balls,
            "hepatic vein": tubes.hepatic.balls,
            "artery": tubes.arteries.balls,
        }
        wide = {name: balls[:, 3] >= GREAT_MM for name, balls in great.items()}
        self._great = {name: balls[wide[name]] for name, balls in great.items()}
        self._small = np.vstack([balls[~wide[name]] for name, balls in great.items()])

    def codes_at(self, points_mm: ArrayLike) -> Codes:
        """Return the codes of the tissues at patient points [mm], shape (n, 3) -> (n,)."""
        points = np.asarray(points_mm, np.float64).reshape(-1, 3)
        parts = [self._codes(points[n : n + _CHUNK]) for n in range(0, len(points), _CHUNK)]
        return np.concatenate([np.empty(0, np.intp), *parts])

    def _codes(self, points: FloatArray) -> Codes:
        patient = self._patient
        model = points / np.array(patient.scale)
        at = organs.place_of(patient, *model.T)
        codes = np.full(len(model), _CODE["air"], np.intp)

        def lay(distance: Any, name: str, among: Any = True) -> None:
            codes[(distance < 0.0) & among] = _CODE[name]

        def lay_balls(balls: FloatArray, name: str, among: Any = True) -> None:
            codes[_in_balls(model, balls, _RUN) & among] = _CODE[name]

        theta, z = np.arctan2(at.y, at.x), at.z
        fat = trunk.fat_thickness(patient, theta, z)
        lay(at.skin, "skin")
        lay(at.skin + trunk.SKIN_MM, "fat")
        lay(at.skin + trunk.SKIN_MM + fat, "muscle")
        lay(at.wall, "fat")
        psoas = (z < 172.0) & _between(at, -78.0, 78.0, -12.0, 72.0)
        lay(np.maximum(organs.psoas(at), at.wall - 8.0), "muscle", psoas)
        lay(np.maximum(np.abs(at.above - 2.3) - 1.4, at.wall), "diaphragm", z > 150.0)
        emphysema, bronchi = self._airways
        if patient.has_lobes:
            for lobe, distance in lobes(patient, at).items():
                lay(distance, lobe, z > 150.0)
            lay_balls(emphysema[1], emphysema[0], z > 150.0)
        else:
            lay(organs.lungs(patient, at), "lung", z > 150.0)
        lay_balls(self._lung, LUNG_VESSEL, z > 150.0)
        lay_balls(bronchi[1], bronchi[0], z > 150.0)
        if patient.nodule is not None:
            (x, y, height), radius = patient.nodule
            dx, dy, dz = at.x - x, at.y - y, z - height
            rim = 0.5 * np.sin(0.9 * dx + patient.seed) * np.cos(0.8 * dy)
            lay(np.sqrt(dx * dx + dy * dy + dz * dz) - radius - rim, "lung nodule")
        for name, balls in self._gut:
            lay_balls(balls, name, z < 195.0)
        self._lay_organs(at, lay)
        lay_balls(self._small, SMALL_VESSEL)
        for name, balls in self._great.items():
            lay_balls(balls, name)
        for name, balls in self._intercostal:
            lay_balls(balls, name)
        lay(organs.lesion(patient, at), "lesion")
        _lay_bones(at, codes)
        return codes

    def _lay_organs(self, at: organs.Place, lay: Any) -> None:
        z, patient, touching = at.z, self._patient, organs.touching(at)
        right = (z > 95.0) & _between(at, -160.0, 95.0, -115.0, 95.0)
        heart = organs.heart(patient, at)
        lay(heart - 3.0, "fat", right & (z > 245.0 + patient.dome_mm))
        lay(heart, "heart", right & (z > 245.0 + patient.dome_mm))
        lay(organs.liver(patient, touching), "liver", right)
        lay(organs.gallbladder(at), "gallbladder", right)
        lay(organs.pancreas(at), "pancreas", right)
        left = (z > 130.0) & _between(at, -25.0, 160.0, -115.0, 95.0)
        lay(organs.stomach(patient, touching), "stomach", left)
        lay(organs.spleen(patient, touching), "spleen", left)
        for is_right, x0, x1 in ((True, -115.0, -12.0), (False, 12.0, 115.0)):
            among = _between(at, x0, x1, 0.0, 90.0)
            outline = organs.kidney(patient, at, is_right)
            lay(outline, "kidney", among)
            sinus = organs.kidney_sinus(patient, at, is_right)
            lay(np.maximum(sinus, outline - 1.0), "fat", among)


def _between(at: organs.Place, x0: float, x1: float, y0: float, y1: float) -> NDArray[np.bool_]:
    """Return which points lie in the box in which the recipe lays a shape."""
    return np.asarray((at.x >= x0) & (at.x < x1) & (at.y >= y0) & (at.y < y1))


def _lay_bones(at: organs.Place, codes: Codes) -> None:
    """Lay ribs, sternum, spine and pelvis; the last three are known slice by slice alone."""
    x, y, z, wall = at.x, at.y, at.z, at.wall
    near = np.flatnonzero((z >= 95.0) & (np.abs(wall - 5.0) < 11.0))
    p = np.abs(np.arctan2(x[near], y[near])) / np.pi
    bone, cartilage = skeleton.rib_distance(wall[near] - 5.0, p, z[near])
    arch = skeleton.costal_arch_distance(wall[near] - 5.0, p, z[near])
    codes[near[np.minimum(cartilage, arch) < 0.0]] = _CODE["cartilage"]
    codes[near[bone < 0.0]] = _CODE["rib"]
    necks = np.flatnonzero((z >= 95.0) & _between(at, -40.0, 40.0, 30.0, 90.0))
    neck = skeleton.rib_neck_distance(np.abs(x[necks]), y[necks], z[necks])  # type: ignore[arg-type]
    codes[necks[neck < 0.0]] = _CODE["rib"]
    for n in np.flatnonzero((z > 232.0) & _between(at, -30.0, 30.0, -115.0, -50.0)):
        if skeleton.sternum_distance(x[n : n + 1], wall[n : n + 1], float(z[n]))[0] < 0.0:
            codes[n] = _CODE["bone"]
    for n in np.flatnonzero(_between(at, -58.0, 58.0, -5.0, 100.0)):
        section = skeleton.spine_section(x[n : n + 1], y[n : n + 1], float(z[n]))
        disc, hard = float(section.disc[0]), float(section.bone[0])
        codes[n] = _CODE["disc"] if disc < 0.0 else codes[n]
        codes[n] = _CODE["bone"] if hard < 0.0 else codes[n]
        if max(float(section.canal[0]), 0.4 - min(hard, disc)) < 0.0:
            codes[n] = _CODE["spinal canal"]
    for n in np.flatnonzero((z < 64.0) & (np.abs(x) < 165.0) & (y >= -45.0) & (y < 95.0)):
        if skeleton.pelvis_distance(np.abs(x[n : n + 1]), y[n : n + 1], float(z[n]))[0] < 0.0:
            codes[n] = _CODE["bone"]


@njit
def _in_balls(points: Any, balls: Any, run: int) -> Any:
    """Return which points (n, 3) lie in a ball (x, y, z, r); neighbours in turn share a look."""
    inside = np.zeros(len(points), np.bool_)
    near = np.empty(len(balls), np.int64)
    for first in range(0, len(points), run):
        last = min(first + run, len(points))
        low, high = points[first].copy(), points[first].copy()
        for n in range(first, last):
            for a in range(3):
                low[a], high[a] = min(low[a], points[n, a]), max(high[a], points[n, a])
        count = 0
        for m in range(len(balls)):
            r = balls[m, 3]
            beside = False
            for a in range(3):
                if balls[m, a] + r < low[a] or balls[m, a] - r > high[a]:
                    beside = True
            if not beside:
                near[count] = m
                count += 1
        for n in range(first, last):
            for k in range(count):
                m = near[k]
                dx, dy = points[n, 0] - balls[m, 0], points[n, 1] - balls[m, 1]
                dz, r = points[n, 2] - balls[m, 2], balls[m, 3]
                if dx * dx + dy * dy + dz * dz < r * r:
                    inside[n] = True
                    break
    return inside
