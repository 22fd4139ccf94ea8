"""The path report by the built-in patient's recipe alone: no grid, no labels, no rule between them.

Pleura and fissures are roots of the recipe's distance functions along the path, their normals its
gradients; lengths are counted every twentieth of a millimetre; ribs are points on their surfaces.
"""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from app.imaging.phantom import organs, skeleton
from app.imaging.phantom.lesion import make_patient
from app.imaging.phantom.lobes import LOBES, lobes
from app.imaging.phantom.trunk import cavity_radius
from app.imaging.phantom.vessels import vasculature
from app.studies.references.recipe_points import RecipePoints

STEP_MM = 0.05
LOOK_MM = 40.0


@dataclass
class Wanted:
    """What the recipe says of a path; crossings as (depth [mm], angle [deg])."""

    pleura: list
    fissures: list
    lung_mm: float
    emphysema_mm: float
    rib_below_mm: float
    rib_above_mm: float
    intercostal_mm: float
    tubes: list


class Recipe:
    """The recipe of a patient with lobes."""

    def __init__(self, seed):
        self.patient = make_patient(seed)
        self.scale = np.array(self.patient.scale)
        self.points = RecipePoints(seed)
        self.tubes = vasculature(self.patient)
        self.ribs = [self._rib(rib) for rib in skeleton.RIBS]
        both = (self.tubes.intercostal_arteries.balls, self.tubes.intercostal_veins.balls)
        self.intercostals = np.vstack(both)

    def place(self, points_mm):
        return organs.place_of(self.patient, *(np.asarray(points_mm) / self.scale).T)

    def lung(self, points_mm):
        return organs.lungs(self.patient, self.place(points_mm))

    def lobe(self, points_mm):
        each = lobes(self.patient, self.place(points_mm))
        return np.array([each[name] for name in LOBES]).argmin(axis=0)

    def _rib(self, rib):
        """Points on a rib's surface, both sides and its neck, LPS [mm]."""
        p, turn = np.meshgrid(
            np.arange(0.1, rib.cartilage_end, 0.0011),
            np.linspace(0.0, 2.0 * np.pi, 49)[:-1],
            indexing="ij",
        )
        z = rib.z(p) + 6.4 * np.sin(turn)
        clouds = []
        for sign in (-1.0, 1.0):
            theta = np.arctan2(np.cos(p * np.pi), sign * np.sin(p * np.pi))
            rho = cavity_radius(self.patient, theta, z) + 5.0 + 3.6 * np.cos(turn)
            clouds.append(np.stack([rho * np.cos(theta), rho * np.sin(theta), z], axis=-1))
            start = np.array([11.0 * sign, 47.0, rib.height + 2.0])
            end = np.array([25.0 * sign, 66.0, float(rib.z(np.array(0.1)))])
            balls = start + np.linspace(0.0, 1.0, 80)[:, None] * (end - start)
            ways = np.random.default_rng(0).normal(size=(200, 3))
            ways /= np.linalg.norm(ways, axis=1)[:, None]
            clouds.append((balls[:, None] + 4.2 * ways)[None])
        return cKDTree(np.vstack([cloud.reshape(-1, 3) for cloud in clouds]) * self.scale)

    def in_rib(self, rib, points_mm):
        at = self.place(points_mm)
        p = np.abs(np.arctan2(at.x, at.y)) / np.pi
        tube = np.hypot((at.wall - 5.0) / 3.6, (at.z - rib.z(p)) / 6.4)
        return (tube < 1.0) & (p >= 0.1) & (p <= rib.cartilage_end)

    def report(self, entry, target):
        length = np.linalg.norm(target - entry)
        way = (target - entry) / length
        depth = np.append(np.arange(0.0, length, STEP_MM), length)
        line = entry + depth[:, None] * way
        distance = self.lung(line)
        pleura = [
            self._crossing(entry, way, depth[n], depth[n + 1], lambda q: self.lung(q))
            for n in np.flatnonzero((distance[1:] < 0.0) != (distance[:-1] < 0.0))
        ]
        inside, lobe = distance < 0.0, self.lobe(line)
        fissures = []
        for n in np.flatnonzero((lobe[1:] != lobe[:-1]) & inside[1:] & inside[:-1]):
            first, second = LOBES[lobe[n]], LOBES[lobe[n + 1]]

            def parted(q, first=first, second=second):
                each = lobes(self.patient, self.place(q))
                return each[first] - each[second]

            fissures.append(self._crossing(entry, way, depth[n], depth[n + 1], parted))
        codes = self.points.codes_at(entry + 0.5 * (depth[1:] + depth[:-1])[:, None] * way)
        steps = np.diff(depth)
        names = np.array([tissue.name for tissue in TISSUES])[codes]
        wall = line[: int(np.argmax(inside)) + 1]
        below, above = self._ribs(wall)
        return Wanted(
            pleura,
            fissures,
            float(steps[np.isin(names, (*LOBES, "emphysema", "lung vessel", "bronchus"))].sum()),
            float(steps[names == "emphysema"].sum()),
            below,
            above,
            self._intercostal(wall),
            self._tubes(line[inside]),
        )

    def _crossing(self, entry, way, low, high, function):
        before = function((entry + low * way)[None])[0] < 0.0
        for _ in range(40):
            middle = 0.5 * (low + high)
            if (function((entry + middle * way)[None])[0] < 0.0) == before:
                low = middle
            else:
                high = middle
        at = entry + low * way
        h = 0.01
        ends = np.array([at + s * h * np.eye(3)[a] for a in range(3) for s in (1, -1)])
        values = function(ends)
        normal = values[::2] - values[1::2]
        cosine = abs(normal @ way) / np.linalg.norm(normal)
        return low, float(np.degrees(np.arccos(min(1.0, cosine))))

    def _ribs(self, wall):
        at = self.place(wall)
        n = int(np.abs(at.wall - 5.0).argmin())
        p = np.abs(np.arctan2(at.x[n], at.y[n])) / np.pi
        sides = ([LOOK_MM], [LOOK_MM])
        fine = wall[::4]
        for rib, cloud in zip(skeleton.RIBS, self.ribs, strict=True):
            met = self.in_rib(rib, wall).any()
            away = 0.0 if met else float(cloud.query(fine)[0].min())
            sides[int(float(rib.z(np.array(p))) > at.z[n])].append(away)
        return min(sides[0]), min(sides[1])

    def _intercostal(self, wall):
        balls = self.intercostals[:, :3] * self.scale
        start, way = wall[0], wall[-1] - wall[0]
        share = np.clip((balls - start) @ way / (way @ way), 0.0, 1.0)
        gap = np.linalg.norm(balls - start - share[:, None] * way, axis=1)
        return float(np.clip((gap - self.intercostals[:, 3]).min(), 0.0, LOOK_MM))

    def _tubes(self, line):
        """Tubes met: (kind, diameter at the ball that the path comes deepest into)."""
        found = []
        for kind, tubes in (("lung vessel", self.tubes.lung), ("bronchus", self.tubes.bronchi)):
            balls = tubes.balls
            low, high = line.min(axis=0) / self.scale - 8.0, line.max(axis=0) / self.scale + 8.0
            near = balls[((balls[:, :3] > low) & (balls[:, :3] < high)).all(axis=1)]
            if not len(near):
                continue
            away, which = cKDTree(line[::2] / self.scale).query(near[:, :3])
            for n in np.flatnonzero(away < 0.7 * near[:, 3]):
                found.append((kind, 2.0 * near[n, 3], float(which[n])))
        return found


def _tissues():
    from app.imaging.field.from_recipe import LOBED_TABLE

    return LOBED_TABLE


TISSUES = _tissues()
