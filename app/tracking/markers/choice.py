"""The named ways of finding the marker."""

from enum import StrEnum

from app.tracking.markers.extractor import Extractor
from app.tracking.markers.outline_centroid import OutlineCentroid
from app.tracking.markers.thesis import ThesisMarker
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import NeedleProfile, RigProfile


class ExtractorName(StrEnum):
    """How the marker is found."""

    THESIS = "thesis"  # the laboratory's published detection, for comparison
    OUTLINE_CENTROID = "outline_centroid"  # mask, then the centroid of the covered shares


DEFAULT = ExtractorName.OUTLINE_CENTROID


def extractor(
    name: ExtractorName, model: CameraModel, needle: NeedleProfile, noise_grey: float = 4.0
) -> Extractor:
    """Build the extractor of one camera.

    Args:
        name: which way.
        model: the camera.
        needle: what it looks for.
        noise_grey: standard deviation of the pictures' noise [grey levels].
    """
    if name is ExtractorName.THESIS:
        return ThesisMarker()
    return OutlineCentroid(noise_grey=noise_grey)


def extractors(rig: RigProfile, name: ExtractorName = DEFAULT) -> tuple[Extractor, Extractor]:
    """Build one extractor for each camera of a rig, in its order."""
    first, second = (extractor(name, model, rig.needle, rig.noise_grey) for model in rig.models)
    return first, second
