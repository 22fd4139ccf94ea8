"""What people look at: the newest pictures with everything the tracker makes of them."""

from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.markers.extractor import Extractor, Mask, Miss
from app.tracking.optics.rig import RigProfile
from app.tracking.stereo.epipolar import epipolar_curve
from app.tracking.tracked_picture import TrackedPicture

Region = tuple[float, float, float, float]
"""Left, top, right, bottom [px]."""


@dataclass(frozen=True, slots=True, eq=False)
class InspectedPicture:
    """A camera's newest picture and what belongs to it.

    Attributes:
        picture: as the tracker has it.
        why: why there is no marker in it, one line; empty with one.
        epipolar: where the other camera's marker may lie in this picture [px], shape (n, 2);
            empty without a marker there.
        mask: what counts as the marker's colour, shape (height, width); None if not asked for.
        region: where the marker is looked for in the next picture; None for the whole picture.
        drawn: whether what was looked for was found and is no single pixel (a pen).
    """

    picture: TrackedPicture
    why: str
    epipolar: FloatArray
    mask: Mask | None
    region: Region | None
    drawn: bool = False

    @property
    def found(self) -> bool:
        """Return whether what was looked for is in the picture."""
        return self.drawn or self.picture.pixel is not None


@dataclass(frozen=True, slots=True, eq=False)
class Inspection:
    """Both pictures and the newest fix.

    Attributes:
        pictures: in the order of the rig; a camera without a picture is left out.
        fix: newest; None before the first.
        rate_hz: pictures a second that the rig's profile promises; 0 where nobody tells.
        rig: name of the rig's profile.
        calibration: id of the cameras' calibration; empty for cameras by their profile.
        uncertainty_known: whether the calibration says how sure it is; if not, `radius` leaves
            its error out.
        cameras: how many there are; one for a pen, which has no coloured marker either.
    """

    pictures: tuple[InspectedPicture, ...]
    fix: NeedleFix | None
    rate_hz: float = 0.0
    rig: str = ""
    calibration: str = ""
    uncertainty_known: bool = True
    cameras: int = 2

    @property
    def radius(self) -> float | None:
        """Radius round the tip that holds the true one with 95 % [m]; None without a tip."""
        return self.fix.radius() if self.fix is not None and self.fix.usable else None

    @property
    def status(self) -> FixStatus | None:
        """Of the newest fix."""
        return self.fix.status if self.fix is not None else None


def inspected(
    fix: NeedleFix | None,
    pictures: tuple[TrackedPicture, ...],
    rig: RigProfile,
    extractors: tuple[Extractor, Extractor],
    masks: bool,
    lines: bool,
) -> Inspection:
    """Return what two cameras show.

    Args:
        fix: newest; None before the first.
        pictures: newest of each camera that has given one.
        rig: profile of the cameras.
        extractors: how the marker is found in each, in the order of the rig.
        masks: whether to compute what counts as the marker's colour (1 ms a picture).
        lines: whether to compute the epipolar curves (0.1 ms a picture).
    """
    used = rig.calibration
    return Inspection(
        tuple(_inspected(one, pictures, rig, extractors, masks, lines) for one in pictures),
        fix,
        rig.rate_hz,
        rig.name,
        used.id if used is not None else "",
        used is None or used.uncertainty_known,
    )


def _inspected(
    picture: TrackedPicture,
    pictures: tuple[TrackedPicture, ...],
    rig: RigProfile,
    extractors: tuple[Extractor, Extractor],
    masks: bool,
    lines: bool,
) -> InspectedPicture:
    models = rig.models
    own = [model.name for model in models].index(picture.name)
    other = next((one for one in pictures if one.name != picture.name), None)
    epipolar = np.empty((0, 2))
    if lines and other is not None and other.pixel is not None:
        epipolar = epipolar_curve(models[1 - own], other.pixel, models[own])
    mask = extractors[own].mask(picture.image) if masks else None
    why = picture.found.reason.words if isinstance(picture.found, Miss) else ""
    region = _region(picture, extractors[own].region)
    return InspectedPicture(picture, why, epipolar, mask, region)


def _region(picture: TrackedPicture, half: int) -> Region | None:
    if picture.pixel is None or not half:
        return None
    (u, v), (height, width) = picture.pixel.tolist(), picture.image.shape[:2]
    return max(0.0, u - half), max(0.0, v - half), min(width, u + half), min(height, v + half)
