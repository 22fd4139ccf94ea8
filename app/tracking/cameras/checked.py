"""A camera whose pictures must have the size that its calibration was made at."""

from __future__ import annotations

from app.core.messages import sentence
from app.tracking.cameras.camera import Camera, CameraFrame
from app.tracking.errors import CameraError


class CheckedCamera(Camera):
    """Refuses pictures of another size; every error names camera and source.

    Args:
        camera: that delivers.
        name: of it in the rig.
        source: as people write it.
        size: width, height [px] that are needed.
        reason: whose size that is, e.g. `calibration 20261122-091244-3f2a`.
    """

    def __init__(
        self, camera: Camera, name: str, source: str, size: tuple[int, int], reason: str
    ) -> None:
        self.camera, self.name, self.source = camera, name, source
        self.may_repeat, self.simulated = camera.may_repeat, camera.simulated
        self._size, self._reason = size, reason

    def open(self) -> None:
        """Open the camera and look at its first picture.

        Raises:
            CameraError: if it cannot be opened, or its pictures have another size.
        """
        try:
            self.camera.open()
        except CameraError as error:
            raise self._error(error) from error
        try:
            self.read()
        except BaseException:
            self.camera.close()
            raise

    def read(self) -> CameraFrame:
        """Wait for the next picture.

        Raises:
            CameraError: if none comes, or it has another size.
        """
        try:
            frame = self.camera.read()
        except CameraError as error:
            raise self._error(error) from error
        height, width = frame.image.shape[:2]
        if (width, height) != self._size:
            raise CameraError(
                sentence(
                    "camera {name} ({source}) gives pictures of {width}x{height}, "
                    "not {known_width}x{known_height} ({reason}); set `size` in the camera "
                    "settings, or calibrate again at this size",
                    name=self.name,
                    source=self.source,
                    width=width,
                    height=height,
                    known_width=self._size[0],
                    known_height=self._size[1],
                    reason=self._reason,
                )
            )
        return frame

    def close(self) -> None:
        """Close the camera."""
        self.camera.close()

    def _error(self, error: CameraError) -> CameraError:
        return CameraError(
            sentence(
                "camera {name} ({source}): {error}", name=self.name, source=self.source, error=error
            )
        )
