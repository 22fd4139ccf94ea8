"""Vessels and gut of the phantom, drawn from the patient's own random numbers."""

from dataclasses import dataclass, field

import numpy as np

from app.core.arrays import FloatArray, unit
from app.imaging.phantom import organs
from app.imaging.phantom.patient import Patient
from app.imaging.phantom.thorax import emphysema, intercostals, lung_tubes
from app.imaging.phantom.trunk import diaphragm_height
from app.imaging.phantom.tubes import Tubes, joined, tube


@dataclass(frozen=True, slots=True, eq=False)
class Vasculature:
    """All tubes of a patient by what fills them; the last four of patients with lobes alone."""

    arteries: Tubes
    cava: Tubes
    portal: Tubes
    hepatic: Tubes
    lung: Tubes
    colon: Tubes
    small_bowel: Tubes
    bronchi: Tubes = field(default_factory=lambda: joined(()))
    emphysema: Tubes = field(default_factory=lambda: joined(()))
    intercostal_arteries: Tubes = field(default_factory=lambda: joined(()))
    intercostal_veins: Tubes = field(default_factory=lambda: joined(()))


def vasculature(patient: Patient) -> Vasculature:
    """Lay out every tube of a patient."""
    vessels, *others = _lobed(patient) if patient.has_lobes else (_lung(patient),)
    return Vasculature(
        _arteries(),
        _cava(),
        _portal(patient),
        _hepatic(patient),
        vessels,
        _colon(patient),
        _small_bowel(patient),
        *others,
    )


def _lobed(patient: Patient) -> tuple[Tubes, ...]:
    """Lay out lung vessels, bronchi, emphysema, intercostal arteries and veins."""
    return (*lung_tubes(patient), emphysema(patient), *intercostals(patient))


def obstacles(patient: Patient) -> dict[str, Tubes]:
    """List what a needle to the liver must not meet: gut, and vessels of 2 mm radius and more."""
    x, y, z = patient.lesion_mm

    def near(tubes: Tubes, least: float) -> Tubes:
        balls = tubes.balls[tubes.balls[:, 3] >= least]
        far = np.abs(balls[:, :3] - (x, y - 40.0, z)) > (60.0, 70.0, 60.0)
        return Tubes(balls[~far.any(axis=1)])

    return {
        "gut": near(joined([_colon(patient), _small_bowel(patient)]), 0.0),
        "vessel": near(joined([_portal(patient), _hepatic(patient)]), 2.0),
    }


def _arteries() -> Tubes:
    aorta = tube(
        [(14, 12, 340), (13, 8, 270), (9, 2, 215), (6, -1, 165), (5, -2, 110), (4, -3, 48)],
        [12.0, 11.5, 11.0, 10.0, 9.0, 8.5],
    )
    iliac = [
        tube([(4 * s, -3, 48), (20 * s, 4, 15), (38 * s, 20, -25)], [7.0, 5.8, 5.2])
        for s in (-1, 1)
    ]
    mesenteric = tube(
        [(6, -10, 158), (5, -22, 140), (2, -34, 100), (-10, -40, 60)], [3.8, 3.6, 3, 2]
    )
    coeliac = tube(
        [(8, -8, 184), (7, -20, 188), (40, -12, 190), (78, 10, 198)], [3.6, 3.4, 2.8, 2.2]
    )
    renal = [
        tube([(6, 0, 150), (20 * s, 12, 148), (44 * s, 38, 143)], [3.4, 3, 2.4]) for s in (-1, 1)
    ]
    return joined([aorta, *iliac, mesenteric, coeliac, *renal])


def _cava() -> Tubes:
    trunk = tube(
        [(-16, 8, -25), (-17, 2, 60), (-19, 2, 140), (-21, 4, 200), (-20, 0, 245), (-12, -8, 275)],
        [9.5, 10.0, 10.5, 11.5, 12.5, 13.0],
    )
    renal = [
        tube([(-17, 3, 146), (22 * s, 8, 146), (46 * s, 38, 142)], [4.5, 4.2, 3]) for s in (-1, 1)
    ]
    return joined([trunk, *renal])


def _portal(patient: Patient) -> Tubes:
    trunk = tube(
        [(8, -20, 160), (-8, -20, 174), (-28, -16, 190), (-40, -14, 198)], [6.5, 7, 7, 6.2]
    )
    splenic = tube([(8, -20, 160), (36, -10, 172), (72, 12, 190), (88, 20, 198)], [5, 4.4, 4, 3.2])
    rng = patient.generator(1)
    trees = [
        _tree(rng, (-40, -14, 198), heading, 4.6, 30.0, 6)
        for heading in ((-0.8, 0.5, -0.25), (-0.8, -0.5, 0.3), (0.65, -0.65, 0.3))
    ]
    return joined([trunk, splenic, _inside_liver(patient, joined(trees), True)])


def _hepatic(patient: Patient) -> Tubes:
    rng = patient.generator(2)
    root = (-21.0, 0.0, 238.0 + patient.dome_mm)
    headings = ((-0.85, 0.2, -0.45), (-0.5, -0.7, -0.35), (0.45, -0.75, -0.1))
    trees = [_tree(rng, root, heading, 4.8, 38.0, 5) for heading in headings]
    return _inside_liver(patient, joined(trees), False)


def _tree(
    rng: np.random.Generator,
    start: object,
    heading: object,
    radius: float,
    length: float,
    depth: int,
) -> Tubes:
    """Branching vessel: each branch splits in two, thinner (Murray's law) and shorter."""
    origin, direction = np.asarray(start, np.float64), unit(np.asarray(heading, np.float64))
    bend = 0.18 * rng.standard_normal(3)
    middle = origin + length * (0.5 * direction + 0.3 * bend)
    end = origin + length * unit(direction + bend)
    branch = tube([origin, middle, end], [radius, 0.92 * radius, 0.84 * radius])
    if depth == 0 or radius < 0.7:
        return branch
    axis = unit(np.cross(direction, rng.standard_normal(3)))
    parts = [branch]
    for sign, share in ((1.0, 0.84), (-1.0, 0.72)):
        turned = direction + sign * rng.uniform(0.4, 0.75) * axis
        parts.append(_tree(rng, end, turned, share * 0.84 * radius, 0.82 * length, depth - 1))
    return joined(parts)


def _inside_liver(patient: Patient, tubes: Tubes, reach_out: bool) -> Tubes:
    """Keep what runs in the liver, clear of lesion and capsule."""
    x, y, z, radius = tubes.balls.T
    at = organs.place_of(patient, x, y, z)
    margin = 1.5 if reach_out else 0.0
    keep = (organs.liver(patient, at) < -radius - 2.0 + margin) & (
        organs.lesion(patient, at) > radius
    )
    return Tubes(tubes.balls[keep])


def _lung(patient: Patient) -> Tubes:
    rng = patient.generator(3)
    parts = []
    for sign in (-1.0, 1.0):
        hilum = np.array([38.0 * sign, 2.0, 338.0])
        for _ in range(130):
            angle, reach = rng.uniform(0.0, 2.0 * np.pi), np.sqrt(rng.uniform(0.05, 1.0))
            x, y = 76.0 * sign + 58.0 * reach * np.cos(angle), 80.0 * reach * np.sin(angle)
            floor = float(diaphragm_height(patient, np.array(x), np.array(y)))
            end = np.array([x, y, floor + rng.uniform(4.0, 45.0)])
            middle = 0.5 * (hilum + end) + rng.normal(0.0, 9.0, 3)
            start = float(rng.uniform(0.9, 2.6))
            parts.append(tube([hilum, middle, end], [start, 0.7 * start, 0.5]))
    tubes = joined(parts)
    x, y, z, radius = tubes.balls.T
    keep = organs.lungs(patient, organs.place_of(patient, x, y, z)) < -radius
    return Tubes(tubes.balls[keep])


def _colon(patient: Patient) -> Tubes:
    rng = patient.generator(4)
    right = [(-98, 14, -25), (-104, 8, 30), (-106, 2, 75), (-98, -18, 104)]
    across = [(-70, -58, 98), (-20, -74, 84), (35, -72, 90), (78, -54, 128), (100, -12, 166)]
    left = [(112, 26, 158), (112, 26, 110), (110, 22, 55), (104, 10, -25)]
    knots = np.array([*right, *across, *left], np.float64)
    knots[1:-1] += rng.normal(0.0, 2.5, knots[1:-1].shape)
    base = tube(knots, [22, 22, 21, 20, 18, 17, 16, 16, 16, 14, 12, 12, 12])
    folds = np.sin(np.arange(len(base.balls)) * 0.55 + rng.uniform(0.0, 6.0))
    balls = base.balls.copy()
    balls[:, 3] *= 1.0 + 0.12 * folds  # haustra
    return _free(patient, Tubes(balls))


def _small_bowel(patient: Patient) -> Tubes:
    """Loops that wind through the middle of the abdomen, layer by layer."""
    rng = patient.generator(5)
    parts = []
    for layer, z in enumerate(range(-20, 152, 19)):
        turns = rng.permutation(5)[:4]
        t = np.linspace(0.0, 1.0, 17)
        x = 84.0 * np.cos(2.0 * np.pi * (1.5 * t + 0.13 * layer)) * (0.7 + 0.3 * t)
        y = -32.0 + 32.0 * np.sin(2.0 * np.pi * (2.4 * t + 0.21 * layer) + turns[0])
        knots = np.column_stack([x, y, z + 9.0 * np.sin(9.0 * t + turns[1])])
        knots += rng.normal(0.0, 4.0, knots.shape)
        parts.append(tube(knots, rng.uniform(9.0, 13.0, len(knots))))
    return _free(patient, joined(parts))


def _free(patient: Patient, tubes: Tubes) -> Tubes:
    """Keep what runs inside the cavity and clear of the solid organs."""
    x, y, z, radius = tubes.balls.T
    at = organs.place_of(patient, x, y, z)
    solid = np.min(
        [
            organs.liver(patient, at),
            organs.stomach(patient, at),
            organs.spleen(patient, at),
            organs.kidney(patient, at, True),
            organs.kidney(patient, at, False),
            organs.pancreas(at),
            organs.gallbladder(at),
            organs.psoas(at),
            -at.wall - 3.0,
            np.hypot(x, y - 22.0) - 30.0,
        ],
        axis=0,
    )
    shrunk: FloatArray = np.minimum(radius, solid + 1.0)
    balls = np.column_stack([x, y, z, shrunk])
    return Tubes(balls[shrunk > 5.0])
