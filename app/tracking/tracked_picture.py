"""The newest picture of a camera, for whoever looks at the tracker."""

from dataclasses import dataclass

from app.core.arrays import FloatArray
from app.tracking.cameras.camera import Image
from app.tracking.markers.extractor import MarkerFix, Miss


@dataclass(frozen=True, slots=True, eq=False)
class TrackedPicture:
    """Newest picture of a camera and where the marker is in it.

    Attributes:
        name: of the camera.
        image: read-only.
        time: of its capture [s].
        found: the marker, or why there is none.
    """

    name: str
    image: Image
    time: float
    found: MarkerFix | Miss | None

    @property
    def pixel(self) -> FloatArray | None:
        """Return where the marker is [px], shape (2,), or None."""
        return self.found.uv if isinstance(self.found, MarkerFix) else None
