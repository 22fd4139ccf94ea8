"""One slice of the phantom while it is painted: tissue over tissue, from the outside in."""

from typing import Final

import numpy as np

from app.imaging.phantom import organs, skeleton, trunk
from app.imaging.phantom.grid import ANGLES, Box, Grid
from app.imaging.phantom.lobes import fissure_lines
from app.imaging.phantom.shapes import Field, cover, smoothstep
from app.imaging.phantom.thorax import WALL_SHARE
from app.imaging.phantom.tubes import Tubes, cover_discs

AIR, FAT, MUSCLE, SKIN = -1000.0, -104.0, 60.0, 35.0
EMPHYSEMA, FISSURE = -972.0, -350.0

_ALL: Final[Box] = (slice(None), slice(None))


class Canvas:
    """One slice while it is painted."""

    def __init__(self, grid: Grid, z: float, image: Field) -> None:
        self.grid, self.patient, self.z, self.image = grid, grid.patient, z, image
        self._coverage: Field = np.zeros(image.shape, np.float32)
        theta = np.linspace(-np.pi, np.pi, ANGLES)
        height = np.array(z)
        skin = trunk.skin_radius(theta, height)
        flesh = skin - trunk.SKIN_MM - trunk.fat_thickness(self.patient, theta, height)
        self.skin = self._around(skin)
        self.muscle = self._around(flesh)
        self.wall = self._around(flesh - trunk.wall_thickness(theta, height))
        self.texture = grid.texture_at(z)

    def _around(self, radius: Field) -> Field:
        return self.grid.rho - radius.astype(np.float32)[self.grid.angle]

    def paint(self, distance: Field, hu: float | Field, box: Box = _ALL) -> None:
        """Lay a tissue over what is there, edges by partial volume."""
        share = cover(distance, self.grid.pixel_mm)
        part = self.image[box]
        part += share * (hu - part)

    def paint_tubes(self, tubes: Tubes, hu: float | Field, shrink: float = 0.0) -> None:
        """Lay tubes over what is there."""
        discs = tubes.discs(self.z, shrink)
        if not len(discs):
            return
        x, y = self.grid.x[0], self.grid.y[:, 0]
        self._coverage[:] = 0.0
        cover_discs(
            self._coverage, float(x[0]), float(y[0]), float(x[1] - x[0]), float(y[1] - y[0]), discs
        )
        self.image += self._coverage * (hu - self.image)

    def place(self, box: Box) -> organs.Place:
        """Points of a part of the slice."""
        rows, columns = box
        return organs.Place(
            self.grid.x[:, columns],
            self.grid.y[rows],
            np.array(self.z, np.float32),
            self.skin[box],
            self.wall[box],
            np.float32(self.z) - self.grid.dome[box],
        )

    def paint_all(self) -> None:
        """Paint the slice from the outside in."""
        self._layers()
        self._lungs()
        self._bowel()
        self._organs()
        self._vessels()
        self._bones()

    def _layers(self) -> None:
        fat = FAT + 6.0 * self.texture
        flesh = MUSCLE + 9.0 * self.texture
        self.paint(self.skin, SKIN)
        self.paint(self.skin + trunk.SKIN_MM, fat)
        self.paint(self.muscle, flesh)
        self._fascia()
        self.paint(self.wall, fat)
        if self.z < 172.0:
            box = self.grid.box(-78.0, 78.0, -12.0, 72.0)
            psoas = np.maximum(organs.psoas(self.place(box)), self.wall[box] - 8.0)
            self.paint(psoas, flesh[box], box)

    def _fascia(self) -> None:
        """Fat between the muscles of the wall: flat layers at the side, long muscles behind."""
        ring = np.flatnonzero((self.muscle < 0.5) & (self.wall > -0.5))
        x, y = (
            np.broadcast_to(a, self.image.shape).ravel()[ring] for a in (self.grid.x, self.grid.y)
        )
        muscle, wall = self.muscle.ravel()[ring], self.wall.ravel()[ring]
        side, span = smoothstep((np.abs(x) - 62.0) / 30.0), np.maximum(wall - muscle, 4.0)
        half = 0.55 * side * (0.6 + 0.5 * self.texture.ravel()[ring]) + 9.0 * np.minimum(
            side - 0.1, 0.0
        )
        sheets = [np.abs(share * span + muscle) - half for share in (0.34, 0.68)]
        long_muscles = np.abs(np.hypot((np.abs(x) - 33.0) / 31.0, (y - 66.0) / 23.0) - 1.0)
        parts = [
            *sheets,
            np.maximum(long_muscles * 25.0 - 0.8, 40.0 - y),
            np.maximum(np.abs(x) - 1.2, 66.0 - y),  # cleft between the long muscles
        ]
        if self.z < 215.0:
            parts.append(np.maximum(np.abs(x) - 4.0, y + 60.0))  # linea alba
        share = cover(np.min(parts, axis=0), self.grid.pixel_mm)
        pixels = np.unravel_index(ring, self.image.shape)
        self.image[pixels] += share * (FAT + 18.0 - self.image[pixels])

    def _lungs(self) -> None:
        if self.z < 150.0:
            return
        at = self.place(_ALL)
        distance = organs.lungs(self.patient, at)
        gradient = 60.0 * smoothstep((self.grid.y + 40.0) / 120.0)  # blood sinks to the back
        self.paint(self._diaphragm(at), MUSCLE)
        self.paint(distance, -885.0 + gradient + 14.0 * self.texture)
        tubes = self.grid.tubes
        if self.patient.has_lobes:
            self.paint_tubes(tubes.emphysema, EMPHYSEMA + 6.0 * self.texture)
            self.paint(fissure_lines(self.patient, at), FISSURE)
        self.paint_tubes(tubes.lung, 35.0)
        if self.patient.has_lobes:
            balls = tubes.bronchi.balls.copy()
            self.paint_tubes(tubes.bronchi, 35.0)
            balls[:, 3] *= 1.0 - WALL_SHARE
            self.paint_tubes(Tubes(balls), AIR + 10.0)
        self._nodule()

    def _nodule(self) -> None:
        """Round and solid, with a slightly lobed rim; most patients have none."""
        if self.patient.nodule is None:
            return
        (x, y, z), radius = self.patient.nodule
        if abs(self.z - z) > radius + 2.0:
            return
        reach = radius + 3.0
        box = self.grid.box(x - reach, x + reach, y - reach, y + reach)
        at = self.place(box)
        dx, dy, dz = at.x - x, at.y - y, at.z - z
        rim = 0.5 * np.sin(0.9 * dx + self.patient.seed) * np.cos(0.8 * dy)
        self.paint(np.sqrt(dx * dx + dy * dy + dz * dz) - radius - rim, 42.0, box)

    def _diaphragm(self, at: organs.Place) -> Field:
        """Thin muscle between lung and abdomen."""
        return np.maximum(np.abs(at.above - 2.3) - 1.4, at.wall)

    def _organs(self) -> None:
        z, patient = self.z, self.patient
        if z > 95.0:
            box = self.grid.box(-160.0, 95.0, -115.0, 95.0)
            at = self.place(box)
            texture = self.texture[box]
            if z > 245.0 + patient.dome_mm:
                self.paint(organs.heart(patient, at) - 3.0, FAT, box)
                self.paint(organs.heart(patient, at), 105.0 + 4.0 * texture, box)
                self.paint(organs.heart_chambers(patient, at), 158.0 + 4.0 * texture, box)
            self.paint(organs.liver(patient, organs.touching(at)), 110.0 + 5.0 * texture, box)
            self.paint(organs.gallbladder(at), 55.0, box)
            self.paint(organs.gallbladder(at) + 1.6, 9.0, box)
            self.paint(organs.pancreas(at), 98.0 + 14.0 * texture, box)
        if z > 130.0:
            self._left_side(self.grid.box(-25.0, 160.0, -115.0, 95.0))
        self._kidneys()

    def _left_side(self, box: Box) -> None:
        at, texture = organs.touching(self.place(box)), self.texture[box]
        stomach = organs.stomach(self.patient, at)
        self.paint(stomach, 72.0, box)
        content = np.where(at.y < -48.0 + 0.0 * at.x, AIR + 20.0, 28.0 + 22.0 * texture)
        self.paint(stomach + 4.5, content, box)
        self.paint(organs.spleen(self.patient, at), 122.0 + 5.0 * texture, box)

    def _kidneys(self) -> None:
        for right, x0, x1 in ((True, -115.0, -12.0), (False, 12.0, 115.0)):
            box = self.grid.box(x0, x1, 0.0, 90.0)
            at = self.place(box)
            outline = organs.kidney(self.patient, at, right)
            if float(outline.min()) > 0.5:
                continue
            texture = self.texture[box]
            self.paint(outline, 192.0 + 6.0 * texture, box)
            inner = np.maximum(organs.kidney_medulla(self.patient, at, right), outline + 4.0)
            self.paint(inner, 148.0 + 6.0 * texture, box)
            sinus = np.maximum(organs.kidney_sinus(self.patient, at, right), outline - 1.0)
            self.paint(sinus, -55.0 + 30.0 * texture, box)

    def _bowel(self) -> None:
        tubes, y = self.grid.tubes, self.grid.y
        if self.z < 168.0:
            self.paint_tubes(tubes.small_bowel, 78.0)
            self.paint_tubes(tubes.small_bowel, 28.0 + 18.0 * self.texture, shrink=2.2)
        if self.z < 195.0:
            self.paint_tubes(tubes.colon, 65.0)
            stool = -20.0 + 75.0 * self.texture
            gas = y < -8.0 + 8.0 * np.sin(0.03 * self.z + 0.02 * self.grid.x)
            self.paint_tubes(tubes.colon, np.where(gas, AIR + 30.0, stool), shrink=2.4)

    def _vessels(self) -> None:
        tubes = self.grid.tubes
        self.paint_tubes(tubes.cava, 128.0)
        self.paint_tubes(tubes.portal, 172.0)
        self.paint_tubes(tubes.hepatic, 165.0)
        self.paint_tubes(tubes.arteries, 178.0)
        if self.patient.has_lobes:
            self.paint_tubes(tubes.intercostal_veins, 128.0)
            self.paint_tubes(tubes.intercostal_arteries, 178.0)
        radius = self.patient.lesion_radius_mm + 3.0
        x, y, z = self.patient.lesion_mm
        if abs(self.z - z) < radius:
            box = self.grid.box(x - radius, x + radius, y - radius, y + radius)
            at = self.place(box)
            distance = organs.lesion(self.patient, at)
            self.paint(distance, 88.0, box)
            core = np.clip(-distance / self.patient.lesion_radius_mm, 0.0, 1.0)
            self.paint(distance + 1.6, 62.0 - 16.0 * core + 6.0 * self.texture[box], box)

    def _bones(self) -> None:
        self._ribs()
        self._spine()
        if self.z < 64.0:
            for x0, x1 in ((-165.0, 0.0), (0.0, 165.0)):
                box = self.grid.box(x0, x1, -45.0, 95.0)
                side, y = np.abs(self.grid.x[:, box[1]]), self.grid.y[box[0]]
                self._bone(skeleton.pelvis_distance(side, y, self.z), 2.2, box)

    def _ribs(self) -> None:
        if self.z < 95.0:
            return
        near = np.abs(self.wall - 5.0) < 9.0
        off, p = self.wall[near] - 5.0, self.grid.p[near]
        bone, cartilage = skeleton.rib_distance(off, p, np.array(self.z, np.float32))
        full = np.full(self.image.shape, 9.0, np.float32)
        arch = skeleton.costal_arch_distance(off, p, np.array(self.z, np.float32))
        full[near] = np.minimum(cartilage, arch)
        self.paint(full, 105.0 + 12.0 * self.texture)
        full[near] = bone
        self._bone(full, 1.9)
        box = self.grid.box(-40.0, 40.0, 30.0, 90.0)
        side, y = np.abs(self.grid.x[:, box[1]]), self.grid.y[box[0]]
        self._bone(skeleton.rib_neck_distance(side, y, self.z), 1.9, box)
        if self.z > 232.0:
            box = self.grid.box(-30.0, 30.0, -115.0, -50.0)
            self._bone(
                skeleton.sternum_distance(self.grid.x[:, box[1]], self.wall[box], self.z), 2.0, box
            )

    def _spine(self) -> None:
        box = self.grid.box(-58.0, 58.0, -5.0, 100.0)
        x, y = self.grid.x[:, box[1]], self.grid.y[box[0]]
        section = skeleton.spine_section(x, y, self.z)
        self.paint(section.disc, 82.0 + 8.0 * self.texture[box], box)
        self._bone(section.bone, 2.2, box, section.end_plate)
        canal = np.maximum(section.canal, 0.4 - np.minimum(section.bone, section.disc))
        self.paint(canal, -40.0, box)
        self.paint(section.canal + 2.0, 28.0, box)
        self.paint(np.hypot(x, y - skeleton.SPINE_Y - 25.0) - 4.5, 42.0, box)

    def _bone(self, distance: Field, shell_mm: float, box: Box = _ALL, dense: float = 0.0) -> None:
        """Cortex around spongy bone; `dense` 1 makes the whole cut as dense as an end plate."""
        texture = self.texture[box]
        self.paint(distance, 680.0 + 60.0 * texture, box)
        self.paint(distance + shell_mm, 215.0 + 230.0 * dense + 55.0 * texture, box)
