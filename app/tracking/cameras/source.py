"""Where pictures come from, as people write it: `usb:1-1.2`, `folder:pictures/left`."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Final

from app.core.messages import sentence
from app.tracking.errors import CameraError

FORMS: Final = "usb:PORT (`acus camera list` shows them), usb:0, folder:PATH, video:PATH, simulated"


class SourceKind(StrEnum):
    """What delivers the pictures."""

    USB = "usb"
    FOLDER = "folder"
    VIDEO = "video"
    SIMULATED = "simulated"


@dataclass(frozen=True, slots=True)
class CameraSource:
    """A source of pictures.

    Attributes:
        kind: what it is.
        place: USB port or number, or path; empty for simulated pictures.
    """

    kind: SourceKind
    place: str = ""

    def __str__(self) -> str:
        """As `parse_source` takes it."""
        return f"{self.kind.value}:{self.place}" if self.place else self.kind.value


def parse_source(text: str) -> CameraSource:
    """Read a source.

    Raises:
        CameraError: if it has another form; names the valid ones.
    """
    head, _, place = text.strip().partition(":")
    place = place.strip()
    try:
        kind = SourceKind(head.strip().lower())
    except ValueError as error:
        raise CameraError(
            sentence(
                "{source!r} is no source of pictures; valid are: {forms}", source=text, forms=FORMS
            )
        ) from error
    if (kind is SourceKind.SIMULATED) == bool(place):
        lack = "takes nothing after it" if place else "does not say where"
        raise CameraError(
            sentence(
                "the source {source!r} {lack}; valid are: {forms}",
                source=text,
                lack=lack,
                forms=FORMS,
            )
        )
    return CameraSource(kind, place)
