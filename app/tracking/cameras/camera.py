"""What a camera is to the tracker, and what a picture is."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.core.messages import sentence
from app.tracking.errors import CameraError

Image = NDArray[np.uint8]
"""Picture, shape (height, width, 3), blue green red as OpenCV has them."""


@dataclass(frozen=True, slots=True, eq=False)
class CameraFrame:
    """One picture.

    Attributes:
        image: blue, green, red, shape (height, width, 3), read-only.
        time: monotonic time of the capture [s], not of the delivery.

    Raises:
        CameraError: if the image is not of that shape and type.
    """

    image: Image
    time: float

    def __post_init__(self) -> None:
        if self.image.dtype != np.uint8 or self.image.ndim != 3 or self.image.shape[2] != 3:
            raise CameraError(
                sentence(
                    "a picture has shape {image_shape} and type {image_dtype}; "
                    "(height, width, 3) and uint8 are needed: set the camera to colour",
                    image_shape=self.image.shape,
                    image_dtype=self.image.dtype,
                )
            )
        self.image.setflags(write=False)


class Camera(ABC):
    """A camera that hands out pictures one after the other.

    Attributes:
        may_repeat: whether a picture that is the same to the last bit is nothing unusual; of a
            real sensor it never is, and means a driver that hangs.
        simulated: whether this computer draws the pictures, so that no cable can be the reason
            where none come.
    """

    may_repeat: bool = False
    simulated: bool = False

    @abstractmethod
    def open(self) -> None:
        """Start the stream.

        Raises:
            CameraError: if the camera is not there or refuses its settings.
        """

    @abstractmethod
    def read(self) -> CameraFrame:
        """Wait for the next picture; returns or raises within about half a second.

        Raises:
            CameraError: if no picture comes, or the camera is not open.
        """

    @abstractmethod
    def close(self) -> None:
        """End the stream; closing twice is fine."""
