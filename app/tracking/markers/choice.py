"""The ways of finding the marker by name, and what the rig's geometry tells them.

Each is one file, the program's own here, the user's in the folder `extractors`; a rig profile
chooses. See 'How to add a marker extractor' in docs/extending.md.
"""

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Final

import numpy as np

from app.core.plugins import TEXT, Declaration, PluginKind
from app.core.trial import Trial
from app.core.units import MILLIMETRE
from app.tracking.errors import TrackingError
from app.tracking.markers.colour import RED, ColourModel
from app.tracking.markers.extractor import Extractor, ExtractorSetup
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import NeedleShape, RigProfile

_SPREAD = 1.5
"""By how much the band's area may differ from what distance and lean make of it."""

_LEAST_SINE = 0.3


class ExtractorName(StrEnum):
    """The program's own ways."""

    THESIS = "thesis"  # the laboratory's published detection, for comparison
    OUTLINE_CENTROID = "outline_centroid"  # mask, then the centroid of the covered shares
    ELLIPSE = "ellipse"  # contour on rays, then the centre of an ellipse through it
    MODEL_FIT = "model_fit"  # least squares of the band's whole picture


DEFAULT: Final = ExtractorName.MODEL_FIT
"""Of a rig that names none. By measurement over the workspace of rig `wide`: 0.016 px RMS before
even grey, 0.023 before the housing, less than half the centroid's, an eighth of the ellipse's; 1.01
times the joint Cramér-Rao bound before grey. The only way that notices what covers the marker; its
95 % ellipsoid of the tip held the truth in 95.8 % of clean pairs, 93.9 under fingers, 95.4 under
highlights."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclaredExtractor(Declaration):
    """What the file of an extractor says about itself."""


KIND: Final[PluginKind[DeclaredExtractor]] = PluginKind(
    noun="a marker extractor",
    declares=DeclaredExtractor,
    fields={"title": TEXT},
    error=TrackingError,
    package="app.tracking.markers",
    folder="extractors",
    functions=("extractor",),
    marks=(b"\nDECLARATION",),
    trial=Trial("app.tracking.markers.extractor_trial"),
)


def extractors(
    rig: RigProfile, name: str | None = None, colour: ColourModel = RED
) -> tuple[Extractor, Extractor]:
    """Build one extractor for each camera of a rig, in its order.

    Args:
        rig: two cameras, and by which name their marker is found.
        name: another extractor than the rig's: one of the program's or of the user's own folder.
        colour: of the marker.

    Raises:
        TrackingError: for an unknown name, listing the known ones, or a file that cannot be used.
    """
    declared = KIND.find(name or rig.extractor)
    build = KIND.load(declared).extractor
    with KIND.blamed(declared.path, "extractor() does not work"):
        return pair_by(build, rig, colour)


def pair_by(
    build: Callable[[ExtractorSetup], Extractor], rig: RigProfile, colour: ColourModel = RED
) -> tuple[Extractor, Extractor]:
    """Build one extractor for each camera of a rig by a file's `extractor`."""
    first, second = (
        build(
            ExtractorSetup(
                model,
                rig.needle.shape,
                _areas(model, rig.needle.shape, _distances(rig, model)),
                rig.noise_grey,
                rig.blur_px,
                colour,
            )
        )
        for model in rig.models
    )
    return first, second


def _areas(
    model: CameraModel, shape: NeedleShape, distances: tuple[float, float]
) -> tuple[float, float]:
    """Least and largest area of the band [px²]."""
    face = 4.0 * shape.radius * shape.half * float(np.prod(model.intrinsics[:2]))
    smallest = _LEAST_SINE * face / distances[1] ** 2 / _SPREAD
    return max(12.0, smallest), _SPREAD * face / distances[0] ** 2


def _distances(rig: RigProfile, model: CameraModel) -> tuple[float, float]:
    """Least and largest distance of the band from the camera [m].

    The middle is where both optical axes come closest; round it as far as the declared depths go.
    """
    (c1, d1), (c2, d2) = ((m.centre, m.T_world_camera.rotation[:, 2]) for m in rig.models)
    matrix = np.column_stack([d1, -d2])
    along = np.linalg.lstsq(matrix, c2 - c1, rcond=None)[0]
    middle = 0.5 * (c1 + along[0] * d1 + c2 + along[1] * d2)
    reach = (rig.range.depth_max_mm - rig.range.depth_min_mm) * MILLIMETRE
    centre = float(np.linalg.norm(middle - model.centre))
    return max(0.3 * centre, centre - reach), centre + reach
