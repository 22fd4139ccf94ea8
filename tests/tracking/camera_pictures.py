"""Stereo pairs of a marked needle as USB cameras deliver them, with truth: a renderer by itself.

Nothing here is taken from `app`: of a rig only the numbers in its YAML file. Light stays linear
through needle, background, lens and exposure; then photons are counted, the channels weighed, the
tone curve applied, and the picture handed over as PNG or through JPEG.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import yaml

from tests.tracking.ray_traced_needle import Gloss, Needle, trace

KINDS = ("clean", "cast", "specular", "motion", "defocus", "lowlight", "occlude")
DELIVERIES = ("q90-420", "q80-422", "q80-420", "q90-422", "png")
FULCRUM = np.array([0.0, 0.16056, 0.090])

FULL_WELL, READ_NOISE = 4000.0, 8.0
"""Electrons that white holds, and the standard deviation of reading one value."""

_MANY = 200.0
"""Electrons from which on their number is drawn from the normal distribution, which is faster."""

_LENS_BLUR = 0.6
_MARGIN_PX = 25.0
_SAMPLING = {"420": 0x221111, "422": 0x211111, "444": 0x111111}
_LIGHT = np.linspace(0.0, 1.0, 65536)
_CURVES = {
    "srgb": np.where(_LIGHT <= 0.0031308, 12.92 * _LIGHT, 1.055 * _LIGHT ** (1 / 2.4) - 0.055),
    "linear": _LIGHT,
    "rec709": np.where(_LIGHT < 0.018, 4.5 * _LIGHT, 1.099 * _LIGHT**0.45 - 0.099),
    "gamma1.8": _LIGHT ** (1 / 1.8),
    "gamma2.2": _LIGHT ** (1 / 2.2),
}
_TONES = {name: np.rint(255.0 * curve).astype(np.uint8) for name, curve in _CURVES.items()}
TONES = tuple(_TONES)


@dataclass(frozen=True)
class Eye:
    """A camera as OpenCV has it: x_camera = rotation @ x_world + translation."""

    name: str
    size: tuple[int, int]
    matrix: np.ndarray
    distortion: np.ndarray
    rotation: np.ndarray
    translation: np.ndarray

    @classmethod
    def of(cls, numbers: dict[str, Any]) -> "Eye":
        """Read a camera of a rig's YAML file."""
        (fx, fy), (cx, cy) = numbers["focal_px"], numbers["centre_px"]
        place, target = (1e-3 * np.array(numbers[k]) for k in ("position_mm", "looks_at_mm"))
        ahead = (target - place) / np.linalg.norm(target - place)
        right = np.cross(ahead, [0.0, 0.0, 1.0])
        right /= np.linalg.norm(right)
        down = np.cross(ahead, right)
        roll = np.deg2rad(numbers.get("roll_deg", 0.0))
        x = np.cos(roll) * right + np.sin(roll) * down
        rotation = np.stack([x, np.cross(ahead, x), ahead])
        matrix = np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])
        lens = np.array(numbers["distortion"])
        size = tuple(numbers["image_size"])
        return cls(numbers["name"], size, matrix, lens, rotation, -rotation @ place)

    def project(self, points: np.ndarray) -> np.ndarray:
        """Pixels of points of the world, (n, 2)."""
        turned, _ = cv2.Rodrigues(self.rotation)
        uv, _ = cv2.projectPoints(
            np.reshape(points, (-1, 3)), turned, self.translation, self.matrix, self.distortion
        )
        return uv.reshape(-1, 2)

    def corners(self) -> np.ndarray:
        """Normalised coordinates of the corners of all pixels, (H + 1, W + 1, 2)."""
        width, height = self.size
        v, u = np.mgrid[0 : height + 1, 0 : width + 1] - 0.5
        pixels = np.stack([u.ravel(), v.ravel()], axis=1)
        ends = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 100, 1e-12)
        rays = cv2.undistortPoints(pixels, self.matrix, self.distortion, criteria=ends)
        return np.ascontiguousarray(rays.reshape(height + 1, width + 1, 2))


@dataclass(frozen=True)
class PicturePair:
    """Two pictures (uint8, blue green red) and what is true of them.

    Attributes:
        marker_px: centre of the band's axis and its ends, the tip's first, for each picture (3, 2).
        disturbance: what was done to them.
    """

    kind: str
    delivered: str
    left: np.ndarray
    right: np.ndarray
    tip: np.ndarray
    axis: np.ndarray
    marker_centre: np.ndarray
    marker_px: tuple[np.ndarray, np.ndarray]
    disturbance: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Look:
    """Surfaces, lamp and lens of a picture."""

    albedo: np.ndarray
    gloss: Gloss
    lamp: np.ndarray
    brightness: np.ndarray
    gain: np.ndarray
    stops: float = 0.0
    disc: float = 0.0
    shift: np.ndarray | None = None


def low_discrepancy(count: int) -> np.ndarray:
    """Places in a unit square whose shadows on both sides are even, (count, 2); `count` is 2ⁿ."""
    bits = count.bit_length() - 1
    turned = [int(f"{i:0{bits}b}"[::-1], 2) for i in range(count)]
    return (np.column_stack([np.arange(count), turned]) + 0.5) / count


class CameraPictures:
    """Makes pairs of one rig: `pair` one of a kind, `pairs` a seeded mixture of all."""

    def __init__(self, rig_file: Path, tone: str = "srgb") -> None:
        numbers = yaml.safe_load(rig_file.read_text())
        needle = numbers["needle"]
        self.eyes = tuple(Eye.of(one) for one in numbers["cameras"])
        self.range = numbers["range"]
        self.offset = 1e-3 * needle["marker_offset_mm"]
        self.half = 0.5e-3 * needle["marker_length_mm"]
        self.needle = Needle(
            0.5e-3 * needle["shaft_diameter_mm"],
            1e-3 * needle["point_length_mm"],
            1e-3 * needle["length_mm"],
            0.5e-3 * needle["marker_diameter_mm"],
            self.offset - self.half,
            self.offset + self.half,
        )
        self._corners = tuple(eye.corners() for eye in self.eyes)
        self._tone = _TONES[tone]

    def pairs(
        self,
        count: int,
        seed: int,
        kinds: tuple[str, ...] = KINDS,
        deliveries: tuple[str, ...] = DELIVERIES,
    ) -> Iterator[PicturePair]:
        """Yield `count` pairs, kinds in turn; pair i is the same whatever `count` is."""
        for i in range(count):
            rng = np.random.default_rng([seed, i])
            delivered = deliveries[(i // len(kinds)) % len(deliveries)]
            yield self.pair(kinds[i % len(kinds)], delivered, rng)

    def pair(self, kind: str, delivered: str, rng: np.random.Generator) -> PicturePair:
        """Make one pair of a kind, at a place of the needle drawn from the rig's range."""
        tip, axis = self.place(rng)
        look, disturbance = self._look(kind, rng)
        hiding = None
        if kind == "occlude":
            hiding = rng.uniform(0.1, 0.3), str(rng.choice(["an end", "a side"]))
            disturbance = {"share": hiding[0], "from": hiding[1]}
        pictures = []
        for number in range(2):
            light = self.light(number, tip, axis, look, rng, hiding)
            pictures.append(delivered_as(self.exposed(light, look, rng), delivered))
        centre = tip - self.offset * axis
        along = centre + np.outer([0.0, self.half, -self.half], axis)
        marker = tuple(eye.project(along) for eye in self.eyes)
        return PicturePair(kind, delivered, *pictures, tip, axis, centre, marker, disturbance)

    def place(self, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
        """Tip and axis of a needle whose band both cameras see whole."""
        while True:
            reach = self.range
            depth = 1e-3 * rng.uniform(reach["depth_min_mm"], reach["depth_max_mm"])
            tilt, turn = np.deg2rad(rng.uniform(0.0, reach["tilt_max_deg"])), rng.uniform(0, 6.2832)
            across = np.sin(tilt)
            axis = np.array([across * np.cos(turn), across * np.sin(turn), -np.cos(tilt)])
            tip = FULCRUM + depth * axis
            ends = tip - np.outer([self.offset - self.half, self.offset + self.half], axis)
            if all(self._inside(eye, ends) for eye in self.eyes):
                return tip, axis

    def _inside(self, eye: Eye, points: np.ndarray) -> bool:
        uv = eye.project(points)
        return bool((uv > _MARGIN_PX).all() and (uv < np.array(eye.size) - _MARGIN_PX).all())

    def _look(self, kind: str, rng: np.random.Generator) -> tuple[Look, dict[str, Any]]:
        shaft = rng.uniform(0.25, 0.5) * rng.uniform(0.95, 1.05, 3)
        band = np.array([rng.uniform(0.01, 0.05), rng.uniform(0.005, 0.03), rng.uniform(0.4, 0.75)])
        tilt, turn = np.arccos(rng.uniform(0.5, 1.0)), rng.uniform(0.0, 6.2832)
        lamp = np.array([np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)])
        brightness = rng.uniform(0.55, 1.1) * np.array([0.6, 0.4])
        gloss = Gloss(rng.uniform(0.05, 0.3), rng.uniform(0.0, 0.04), rng.uniform(15.0, 40.0))
        gain, done, more = np.ones(3), {}, {}
        if kind == "cast":
            gain = rng.uniform(0.7, 1.3, 3)
            done = {"gain_bgr": gain.tolist()}
        elif kind == "specular":
            strength, exponent = rng.uniform(0.3, 1.5), rng.uniform(20.0, 130.0)
            gloss = Gloss(strength, strength, exponent)
            done = {"highlight": strength, "exponent": exponent}
        elif kind == "lowlight":
            more = done = {"stops": rng.uniform(2.0, 3.5)}
        elif kind == "defocus":
            more, done = {"disc": 1.5}, {"radius_px": 1.5}
        elif kind == "motion":
            turn = rng.uniform(0.0, 6.2832)
            more, done = {"shift": 3.0 * np.array([np.cos(turn), np.sin(turn)])}, {"blur_px": 3.0}
        return Look(np.stack([shaft, band]), gloss, lamp, brightness, gain, **more), done

    def light(
        self,
        number: int,
        tip: np.ndarray,
        axis: np.ndarray,
        look: Look,
        rng: np.random.Generator,
        hiding: tuple[float, str] | None = None,
    ) -> np.ndarray:
        """Light on the sensor of a camera, before it is counted, linear, (H, W, 3)."""
        eye = self.eyes[number]
        needle = self.traced(number, tip, axis, look)
        behind = background(eye.size, look.brightness.sum(), rng)
        light = needle[..., :3] + (1.0 - needle[..., 3:4]) * behind
        if hiding is not None:
            along = eye.project(tip - np.outer([self.offset + self.half, 0.0], axis))
            cover(light, needle[..., 4], along[1] - along[0], *hiding, rng)
        if look.disc > 0.0:
            light = cv2.filter2D(light, -1, disc(look.disc), borderType=cv2.BORDER_REPLICATE)
        return cv2.GaussianBlur(light, (0, 0), _LENS_BLUR)

    def traced(self, number: int, tip: np.ndarray, axis: np.ndarray, look: Look) -> np.ndarray:
        """Needle alone: light, its share and the band's share of every pixel, (H, W, 5)."""
        eye = self.eyes[number]
        out = np.zeros((eye.size[1], eye.size[0], 5))
        places = [tip]
        if look.shift is not None:  # across the left camera, at the band's distance from it
            first = self.eyes[0]
            far = (first.rotation @ (tip - self.offset * axis) + first.translation)[2]
            moved = first.rotation[:2].T @ look.shift * far / first.matrix[0, 0]
            places = [tip + part * moved for part in (np.arange(12) + 0.5) / 12 - 0.5]
        offsets = low_discrepancy(32 if len(places) == 1 else 8)
        for place in places:
            trace(
                self._corners[number],
                offsets,
                eye.rotation @ place + eye.translation,
                eye.rotation @ axis,
                self.needle,
                look.albedo,
                look.gloss,
                eye.rotation @ look.lamp,
                eye.rotation @ np.array([0.0, 0.0, 1.0]),
                look.brightness,
                out,
            )
        return out / len(places)

    def exposed(self, light: np.ndarray, look: Look, rng: np.random.Generator) -> np.ndarray:
        """Count the photons, weigh the channels and apply the tone curve: uint8 (H, W, 3)."""
        share = 2.0**-look.stops
        mean = np.maximum(FULL_WELL * share * light, 0.0).astype(np.float32)
        few = mean < _MANY
        variance = READ_NOISE**2 + np.where(few, 0.0, mean).astype(np.float32)
        counted = rng.standard_normal(mean.shape, np.float32) * np.sqrt(variance) + mean
        counted[few] += rng.poisson(mean[few]) - mean[few]
        signal = (look.gain * 65535.0 / (FULL_WELL * share)).astype(np.float32) * counted
        return self._tone[np.clip(signal + 0.5, 0.0, 65535.0).astype(np.uint16)]


def delivered_as(picture: np.ndarray, delivered: str) -> np.ndarray:
    """Hand a picture over: unchanged for `png`, through the codec for `q90-420` and its like."""
    if delivered == "png":
        return picture
    quality, chroma = delivered[1:].split("-")
    options = [
        *(cv2.IMWRITE_JPEG_QUALITY, int(quality)),
        *(cv2.IMWRITE_JPEG_SAMPLING_FACTOR, _SAMPLING[chroma]),
    ]
    return cv2.imdecode(cv2.imencode(".jpg", picture, options)[1], cv2.IMREAD_COLOR)


def disc(radius: float) -> np.ndarray:
    """Weights of a disc about the middle pixel, sum 1."""
    reach = int(np.ceil(radius))
    fine = (np.arange((2 * reach + 1) * 20) + 0.5) / 20 - reach - 0.5
    inside = (fine[:, None] ** 2 + fine[None, :] ** 2 <= radius**2).astype(float)
    size = 2 * reach + 1
    kernel = inside.reshape(size, 20, size, 20).mean(axis=(1, 3))
    return kernel / kernel.sum()


def background(size: tuple[int, int], brightness: float, rng: np.random.Generator) -> np.ndarray:
    """Paint drape, boxes and cables, linear light, (H, W, 3)."""
    width, height = size
    clouds = np.zeros((height, width))
    for cells, strength in ((4, 0.5), (9, 0.25), (23, 0.12)):
        grid = rng.uniform(-1.0, 1.0, (cells, cells))
        clouds += strength * cv2.resize(grid, (width, height), interpolation=cv2.INTER_CUBIC)
    picture = (1.0 + rng.uniform(0.05, 0.35) * clouds)[..., None] * _cloth(rng)
    for _ in range(rng.integers(1, 5)):
        middle, reach = rng.uniform([0, 0], size), rng.uniform(40.0, 260.0)
        angles = np.sort(rng.uniform(0.0, 6.2832, 4))
        corners = middle + reach * np.column_stack([np.cos(angles), np.sin(angles)])
        mask = np.zeros((height, width), np.uint8)
        cv2.fillPoly(mask, [np.rint(16 * corners).astype(int)], 255, cv2.LINE_AA, 4)
        _blend(picture, mask, _cloth(rng))
    for _ in range(rng.integers(0, 4)):
        ends = rng.uniform([0, 0], size, (2, 2))
        bend = ends.mean(axis=0) + rng.normal(0.0, 60.0, 2)
        t = np.linspace(0.0, 1.0, 24)[:, None]
        curve = (1 - t) ** 2 * ends[0] + 2 * t * (1 - t) * bend + t**2 * ends[1]
        mask = np.zeros((height, width), np.uint8)
        thick = int(rng.integers(1, 9))
        cv2.polylines(mask, [np.rint(16 * curve).astype(int)], False, 255, thick, cv2.LINE_AA, 4)
        _blend(picture, mask, _cloth(rng))
    return brightness * picture


def _cloth(rng: np.random.Generator) -> np.ndarray:
    """Albedo of something that is not red: grey to pale, dark to white, blue green red."""
    level = np.exp(rng.uniform(np.log(0.03), np.log(0.7)))
    return level * (1.0 + rng.uniform(-0.35, 0.35, 3) * np.array([1.0, 0.8, 0.8]))


def _blend(picture: np.ndarray, mask: np.ndarray, colour: np.ndarray) -> None:
    rows, columns = np.nonzero(mask.any(axis=1))[0], np.nonzero(mask.any(axis=0))[0]
    if not len(rows):
        return
    part = slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
    share = mask[part][..., None] / 255.0
    picture[part] += share * (colour - picture[part])


def cover(
    light: np.ndarray,
    band: np.ndarray,
    along: np.ndarray,
    share: float,
    side: str,
    rng: np.random.Generator,
) -> None:
    """Lay a finger or a grey tool over a share of the visible band, in place.

    Args:
        light: linear, (H, W, 3).
        band: share of each pixel that is band, (H, W).
        along: from hub to tip in the picture.
        share: of the band that goes, 0 to 1.
        side: where it comes from, `an end` or `a side`.
        rng: decides the rest.
    """
    along = along / np.linalg.norm(along)
    inward = along if side == "an end" else np.array([-along[1], along[0]])
    lean = np.deg2rad(rng.uniform(-20.0, 20.0))
    turn = np.array([[np.cos(lean), -np.sin(lean)], [np.sin(lean), np.cos(lean)]])
    inward = rng.choice([-1.0, 1.0]) * (turn @ inward)
    v, u = np.mgrid[: band.shape[0], : band.shape[1]].astype(float)
    total, part = band.sum(), band > 0.0
    u, v = u - (u * band).sum() / total, v - (v * band).sum() / total
    across = inward[0] * v - inward[1] * u
    ahead = inward[0] * u + inward[1] * v + rng.uniform(0.0, 0.01) * across**2  # a round edge
    low, high = -100.0, 100.0
    for _ in range(30):
        edge = 0.5 * (low + high)
        hidden = (np.clip(edge - ahead[part] + 0.5, 0.0, 1.0) * band[part]).sum() / total
        low, high = (edge, high) if hidden < share else (low, edge)
    half = rng.uniform(25.0, 60.0)
    mask = np.clip(edge - ahead + 0.5, 0.0, 1.0) * np.clip(half - np.abs(across) + 0.5, 0.0, 1.0)
    skin = np.array([0.16, 0.26, 0.72]) * rng.uniform(0.3, 1.0)
    colour = skin if rng.random() < 0.6 else rng.uniform(0.1, 0.5) * np.ones(3)
    shade = (1.0 - 0.3 * (across / half) ** 2)[..., None] * colour * rng.uniform(0.6, 1.0)
    light += mask[..., None] * (np.maximum(shade, 0.02) - light)
