"""Labels of the built-in patient from what he is drawn by: his own signed distances, no CT.

Shapes are laid over each other from the outside in, as `phantom.canvas` paints them: the last one
that holds a voxel is its tissue, and the nearest surface that is to be seen its boundary.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from app.core.compiled import njit
from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.field import band
from app.imaging.field.grid import FieldGrid
from app.imaging.field.naming import BRONCHUS, EMPHYSEMA, LUNG_VESSEL, SMALL_VESSEL
from app.imaging.field.tissue_field import (
    NOBODYS,
    UNKNOWN,
    FieldTissue,
    TissueField,
    TissueKind,
)
from app.imaging.phantom import organs, skeleton, trunk
from app.imaging.phantom.canvas import Canvas
from app.imaging.phantom.grid import Box, Grid
from app.imaging.phantom.lesion import make_patient
from app.imaging.phantom.lobes import LOBES, lobes
from app.imaging.phantom.patient import Patient
from app.imaging.phantom.tubes import Tubes
from app.imaging.phantom.vessels import Vasculature, vasculature

GREAT_MM: Final = 2.0
"""Vessels of this radius and more have a name of their own; others are small."""

_KINDS: Final = (
    ("", TissueKind.AIR),
    ("", TissueKind.SKIN),
    ("", TissueKind.FAT),
    ("", TissueKind.MUSCLE),
    ("diaphragm", TissueKind.MUSCLE),
    ("cartilage", TissueKind.MUSCLE),
    ("disc", TissueKind.MUSCLE),
    ("", TissueKind.LUNG),
    (LUNG_VESSEL, TissueKind.VESSEL),
    (SMALL_VESSEL, TissueKind.VESSEL),
    ("artery", TissueKind.VESSEL),
    ("vena cava", TissueKind.VESSEL),
    ("portal vein", TissueKind.VESSEL),
    ("hepatic vein", TissueKind.VESSEL),
    ("small bowel", TissueKind.GUT),
    ("colon", TissueKind.GUT),
    ("stomach", TissueKind.GUT),
    ("", TissueKind.HEART),
    ("liver", TissueKind.ORGAN),
    ("gallbladder", TissueKind.ORGAN),
    ("pancreas", TissueKind.ORGAN),
    ("spleen", TissueKind.ORGAN),
    ("kidney", TissueKind.ORGAN),
    ("lesion", TissueKind.ORGAN),
    ("lung nodule", TissueKind.ORGAN),
    ("spinal canal", TissueKind.ORGAN),
    ("rib", TissueKind.BONE),
    ("", TissueKind.BONE),
)
_LOBED: Final = (
    *((name, TissueKind.LUNG) for name in LOBES),
    (EMPHYSEMA, TissueKind.LUNG),
    (BRONCHUS, TissueKind.LUNG),
    ("intercostal artery", TissueKind.VESSEL),
    ("intercostal vein", TissueKind.VESSEL),
)
"""What is known besides of patients who have lobes."""

_ALL_KINDS: Final = (*_KINDS, *_LOBED)
LOBED_TABLE: Final = (
    NOBODYS,
    *(
        FieldTissue(code, kind, name, 1.0, "recipe")
        for code, (name, kind) in enumerate(_ALL_KINDS, start=1)
    ),
)
TABLE: Final = LOBED_TABLE[: len(_KINDS) + 1]
_CODE: Final = {name or kind.value: code for code, (name, kind) in enumerate(_ALL_KINDS, start=1)}
_FAR_MM: Final = 6.0  # no boundary further off than this is of interest
_ALL: Final[Box] = (slice(None), slice(None))


def field_of_recipe(seed: int, grid: FieldGrid, progress: Progress) -> TissueField:
    """Label the patient of a seed.

    Args:
        seed: of the patient.
        grid: of the field, along L, P and S.
        progress: reports, and may be cancelled.

    Raises:
        Cancelled: if `progress` was cancelled.
    """
    patient = make_patient(seed)
    tubes = vasculature(patient)
    x, y, z = (
        ((grid.affine_mm[a, 3] + grid.spacing_mm * np.arange(n)) / patient.scale[a])
        for a, n in enumerate(grid.shape[::-1])
    )
    pixels = Grid(
        patient,
        x.astype(np.float32)[None, :],
        y.astype(np.float32)[:, None],
        grid.spacing_mm,
        tubes,
    )
    layers = _Layers(patient, tubes)
    labels = np.empty(grid.shape, np.uint8)
    level = np.empty(grid.shape, np.float32)
    for k, height in enumerate(z.tolist()):
        if k % 8 == 0:
            progress.report(0.7 * k / len(z), sentence("labelling the built-in patient"))
        labels[k], level[k] = layers.slice_at(pixels, height)
    if grid.beyond_reach is not None:
        labels[grid.beyond_reach] = UNKNOWN
    progress.report(0.75, sentence("placing the boundaries"))
    flat = level.ravel()

    def crossing(first: band.Indices, second: band.Indices) -> NDArray[Any]:
        return flat[first] / np.maximum(flat[first] + flat[second], 1e-6)

    distance = band.distances(labels, (grid.spacing_mm,) * 3, crossing)
    progress.report(1.0, sentence("the tissue field is made"))
    return TissueField(labels, distance, grid.affine_mm, table_of(patient))


def table_of(patient: Patient) -> tuple[FieldTissue, ...]:
    """Return the table of a patient's field."""
    return LOBED_TABLE if patient.has_lobes else TABLE


class _Layers:
    """Lays the tissues of a patient over each other, slice by slice.

    Args:
        patient: who.
        tubes: of his vessels and gut.
    """

    def __init__(self, patient: Patient, tubes: Vasculature) -> None:
        self._patient = patient
        great = {
            "artery": tubes.arteries,
            "vena cava": tubes.cava,
            "portal vein": tubes.portal,
            "hepatic vein": tubes.hepatic,
        }
        self._great = {name: _of_radius(each, GREAT_MM, np.inf) for name, each in great.items()}
        self._small = [_of_radius(each, 0.0, GREAT_MM) for each in great.values()]
        self._tubes = tubes

    def slice_at(self, pixels: Grid, z: float) -> tuple[NDArray[np.uint8], NDArray[np.float32]]:
        """Codes of a slice at a height, and how far the nearest boundary is [mm, about]."""
        shape = (pixels.y.shape[0], pixels.x.shape[1])
        slice_ = _Slice(pixels, z, np.zeros(shape, np.float32))
        slice_.lay(slice_.canvas.skin, "skin")
        slice_.lay(slice_.canvas.skin + trunk.SKIN_MM, "fat")
        slice_.lay(slice_.canvas.muscle, "muscle")
        slice_.lay(slice_.canvas.wall, "fat")
        if z < 172.0:
            box = pixels.box(-78.0, 78.0, -12.0, 72.0)
            at = slice_.canvas.place(box)
            slice_.lay(np.maximum(organs.psoas(at), at.wall - 8.0), "muscle", box)
        if z > 150.0:
            self._lay_lungs(slice_)
        if z < 195.0:
            slice_.lay_tubes(self._tubes.small_bowel, "small bowel")
            slice_.lay_tubes(self._tubes.colon, "colon")
        self._lay_organs(slice_)
        for small in self._small:
            slice_.lay_tubes(small, SMALL_VESSEL)
        for name in ("vena cava", "portal vein", "hepatic vein", "artery"):
            slice_.lay_tubes(self._great[name], name)
        slice_.lay_tubes(self._tubes.intercostal_veins, "intercostal vein")
        slice_.lay_tubes(self._tubes.intercostal_arteries, "intercostal artery")
        self._lay_ball(slice_, self._patient.lesion_mm, self._patient.lesion_radius_mm, "lesion")
        self._lay_bones(slice_)
        return slice_.codes, slice_.level

    def _lay_lungs(self, slice_: _Slice) -> None:
        at = slice_.canvas.place(_ALL)
        slice_.lay(np.maximum(np.abs(at.above - 2.3) - 1.4, at.wall), "diaphragm")
        if self._patient.has_lobes:
            for lobe, distance in lobes(self._patient, at).items():
                slice_.lay(distance, lobe)
            slice_.lay_tubes(self._tubes.emphysema, EMPHYSEMA)
        else:
            slice_.lay(organs.lungs(self._patient, at), "lung")
        slice_.lay_tubes(self._tubes.lung, LUNG_VESSEL)
        slice_.lay_tubes(self._tubes.bronchi, BRONCHUS)
        if self._patient.nodule is not None:
            self._lay_ball(slice_, *self._patient.nodule, "lung nodule")

    def _lay_ball(self, slice_: _Slice, centre: Any, radius: float, name: str) -> None:
        """Lay the lesion, or the nodule, with its lobed rim."""
        x, y, z = centre
        reach = radius + _FAR_MM
        if abs(slice_.z - z) > reach:
            return
        box = slice_.pixels.box(x - reach, x + reach, y - reach, y + reach)
        at = slice_.canvas.place(box)
        if name == "lesion":
            distance = organs.lesion(self._patient, at)
        else:
            dx, dy, dz = at.x - x, at.y - y, at.z - z
            rim = 0.5 * np.sin(0.9 * dx + self._patient.seed) * np.cos(0.8 * dy)
            distance = np.sqrt(dx * dx + dy * dy + dz * dz) - radius - rim
        slice_.lay(distance, name, box)

    def _lay_organs(self, slice_: _Slice) -> None:
        z, patient, pixels = slice_.z, self._patient, slice_.pixels
        if z > 95.0:
            box = pixels.box(-160.0, 95.0, -115.0, 95.0)
            at = slice_.canvas.place(box)
            if z > 245.0 + patient.dome_mm:
                slice_.lay(organs.heart(patient, at) - 3.0, "fat", box)
                slice_.lay(organs.heart(patient, at), "heart", box)
            slice_.lay(organs.liver(patient, organs.touching(at)), "liver", box)
            slice_.lay(organs.gallbladder(at), "gallbladder", box)
            slice_.lay(organs.pancreas(at), "pancreas", box)
        if z > 130.0:
            box = pixels.box(-25.0, 160.0, -115.0, 95.0)
            at = organs.touching(slice_.canvas.place(box))
            slice_.lay(organs.stomach(patient, at), "stomach", box)
            slice_.lay(organs.spleen(patient, at), "spleen", box)
        for right, x0, x1 in ((True, -115.0, -12.0), (False, 12.0, 115.0)):
            box = pixels.box(x0, x1, 0.0, 90.0)
            at = slice_.canvas.place(box)
            outline = organs.kidney(patient, at, right)
            slice_.lay(outline, "kidney", box)
            sinus = np.maximum(organs.kidney_sinus(patient, at, right), outline - 1.0)
            slice_.lay(sinus, "fat", box)

    def _lay_bones(self, slice_: _Slice) -> None:
        z, pixels, wall = slice_.z, slice_.pixels, slice_.canvas.wall
        height = np.array(z, np.float32)
        if z >= 95.0:
            near = np.abs(wall - 5.0) < 11.0
            off, p = wall[near] - 5.0, pixels.p[near]
            bone, cartilage = skeleton.rib_distance(off, p, height)
            arch = skeleton.costal_arch_distance(off, p, height)
            full = np.full(wall.shape, 50.0, np.float32)
            full[near] = np.minimum(cartilage, arch)
            slice_.lay(full, "cartilage")
            full[near] = bone
            slice_.lay(full, "rib")
            box = pixels.box(-40.0, 40.0, 30.0, 90.0)
            side, y = np.abs(pixels.x[:, box[1]]), pixels.y[box[0]]
            slice_.lay(skeleton.rib_neck_distance(side, y, z), "rib", box)
        if z > 232.0:
            box = pixels.box(-30.0, 30.0, -115.0, -50.0)
            x = pixels.x[:, box[1]]
            slice_.lay(skeleton.sternum_distance(x, wall[box], z), "bone", box)
        box = pixels.box(-58.0, 58.0, -5.0, 100.0)
        x, y = pixels.x[:, box[1]], pixels.y[box[0]]
        section = skeleton.spine_section(x, y, z)
        slice_.lay(section.disc, "disc", box)
        slice_.lay(section.bone, "bone", box)
        canal = np.maximum(section.canal, 0.4 - np.minimum(section.bone, section.disc))
        slice_.lay(canal, "spinal canal", box)
        if z < 64.0:
            for x0, x1 in ((-165.0, 0.0), (0.0, 165.0)):
                box = pixels.box(x0, x1, -45.0, 95.0)
                side, y = np.abs(pixels.x[:, box[1]]), pixels.y[box[0]]
                slice_.lay(skeleton.pelvis_distance(side, y, z), "bone", box)


class _Slice:
    """Codes of a slice and how far its nearest boundary is, tissue over tissue."""

    def __init__(self, pixels: Grid, z: float, empty: NDArray[np.float32]) -> None:
        self.pixels, self.z = pixels, z
        self.canvas = Canvas(pixels, z, empty)
        self.codes = np.full(empty.shape, _CODE["air"], np.uint8)
        self.level = np.full(empty.shape, _FAR_MM, np.float32)
        self._near = np.empty(empty.shape, np.float32)

    def lay(self, distance: NDArray[Any], name: str, box: Box = _ALL) -> None:
        """Lay a tissue over what is there by its signed distance [mm], negative inside."""
        codes, level = self.codes[box], self.level[box]
        if not codes.size or float(distance.min()) > _FAR_MM:
            return
        inside = distance < 0.0
        away = np.abs(distance)
        same = codes == _CODE[name]  # then both are one, and no boundary parts them
        joined = np.where(inside, np.maximum(level, away), level)
        level[...] = np.where(same, joined, np.where(inside, away, np.minimum(level, away)))
        codes[inside] = _CODE[name]

    def lay_tubes(self, tubes: Tubes, name: str) -> None:
        """Lay tubes over what is there."""
        balls = tubes.balls[np.abs(tubes.balls[:, 2] - self.z) < tubes.balls[:, 3] + 2.0]
        if not len(balls):
            return
        x, y = self.pixels.x[0], self.pixels.y[:, 0]
        self._near[:] = 2.0 * _FAR_MM
        steps = float(x[1] - x[0]), float(y[1] - y[0])
        _lower(self._near, float(x[0]), float(y[0]), *steps, self.z, balls, 2.0)
        self.lay(self._near, name)


def _of_radius(tubes: Tubes, least: float, most: float) -> Tubes:
    radius = tubes.balls[:, 3]
    return Tubes(tubes.balls[(radius >= least) & (radius < most)])


@njit
def _lower(
    near: Any, x0: float, y0: float, step_x: float, step_y: float, z: float, balls: Any, far: float
) -> None:
    """Lower `near` (rows, columns) to the signed distances of balls (x, y, z, r), where under
    `far`.
    """
    rows, columns = near.shape
    for n in range(balls.shape[0]):
        x, y, r = balls[n, 0], balls[n, 1], balls[n, 3]
        dz = balls[n, 2] - z
        reach = r + far
        first, last = int((y - reach - y0) / step_y), int((y + reach - y0) / step_y) + 2
        for row in range(max(0, first), min(rows, last)):
            dy = y0 + row * step_y - y
            left, right = int((x - reach - x0) / step_x), int((x + reach - x0) / step_x) + 2
            for column in range(max(0, left), min(columns, right)):
                dx = x0 + column * step_x - x
                distance = np.sqrt(dx * dx + dy * dy + dz * dz) - r
                if distance < near[row, column]:
                    near[row, column] = distance
