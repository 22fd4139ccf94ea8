"""Which source is which camera, and how each is set up: `cameras.yaml` in the user's settings."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final

import yaml
from pydantic import Field, field_validator

from app.core import paths
from app.core.configuration import Strict, load
from app.core.files import write_atomically
from app.core.messages import sentence, sentence_of
from app.core.units import MILLISECOND
from app.tracking.cameras.source import CameraSource, SourceKind, parse_source
from app.tracking.errors import CameraError
from app.tracking.markers.colour import ColourModel

SIDES: Final = ("left", "right")

Positive = Annotated[float, Field(gt=0.0)]
Latency = Annotated[float, Field(ge=0.0, le=1000.0)]


class OneCamera(Strict):
    """One camera.

    Attributes:
        source: `usb:PORT`, `folder:PATH`, `video:PATH` or `simulated`.
        exposure_ms: held; None holds what the camera's own regulation has found when it opens.
        focus: the driver's number, held; None as above.
        white_balance_k: colour temperature, held; None as above.
        latency_ms: measured from the change on the screen to the delivery of the picture that shows
            it; taken off where the driver gives no capture times. None: not measured yet.
        latency_sd_ms: standard deviation of that.
    """

    source: str = SourceKind.SIMULATED.value
    exposure_ms: Positive | None = None
    focus: float | None = None
    white_balance_k: Positive | None = None
    latency_ms: Latency | None = None
    latency_sd_ms: Latency | None = None

    @field_validator("source")
    @classmethod
    def _readable(cls, text: str) -> str:
        try:
            return str(parse_source(text))
        except CameraError as error:
            raise ValueError(sentence_of(error)) from error

    @property
    def origin(self) -> CameraSource:
        """The source, read."""
        return parse_source(self.source)


class CameraSettings(Strict):
    """Both cameras.

    Attributes:
        rig: profile of the stand: needle, range, nominal places of the cameras.
        size: width, height of the pictures [px].
        rate_hz: pictures per second that are asked for.
        left, right: as the rig has them.
        calibration: file of one to use; None takes the active one of the history.
        marker_colour: learned by a click on the marker; None takes the usual red.
    """

    rig: str = "wide"
    size: tuple[int, int] = (640, 480)
    rate_hz: Positive = 30.0
    left: OneCamera = Field(default_factory=OneCamera)
    right: OneCamera = Field(default_factory=OneCamera)
    calibration: Path | None = None
    marker_colour: ColourModel | None = None

    @property
    def cameras(self) -> tuple[OneCamera, OneCamera]:
        """Left, right."""
        return self.left, self.right

    @property
    def simulated(self) -> bool:
        """Return whether both are simulated."""
        return all(camera.origin.kind is SourceKind.SIMULATED for camera in self.cameras)

    def check(self) -> None:
        """Refuse what cannot work.

        Raises:
            CameraError: if both sides have one source, or only one is simulated.
        """
        left, right = (camera.origin for camera in self.cameras)
        if (left.kind is SourceKind.SIMULATED) != (right.kind is SourceKind.SIMULATED):
            raise CameraError(
                sentence(
                    "one camera is real and one simulated (left {left}, right {right}); give "
                    "both a source, for example --cameras left=usb:1-1.1,right=usb:1-1.2",
                    left=left,
                    right=right,
                )
            )
        if left == right and left.kind is not SourceKind.SIMULATED:
            raise CameraError(
                sentence(
                    "left and right are the same source, {left}; the depth needs two cameras: "
                    "`acus camera list` shows what is plugged in",
                    left=left,
                )
            )


def settings_path() -> Path:
    """Return where the settings are kept."""
    return paths.settings() / "cameras.yaml"


def load_settings(path: Path | None = None) -> CameraSettings:
    """Read the settings; the defaults (simulated cameras) if there are none yet.

    Raises:
        ConfigurationError: if the file says something that cannot be used.
    """
    file = path or settings_path()
    if path is None and not file.exists():
        return CameraSettings()
    return load(file, CameraSettings)


def save_settings(settings: CameraSettings, path: Path | None = None) -> Path:
    """Write the settings, whole or not at all; return where."""
    file = path or settings_path()
    document = settings.model_dump(mode="json", exclude_none=True)
    write_atomically(file, yaml.safe_dump(document, sort_keys=False))
    return file


def parse_cameras(text: str) -> CameraSettings:
    """Read `--cameras`: `simulated`, a settings file, or `left=SOURCE,right=SOURCE`.

    The last replaces the sources of the remembered settings; what is remembered of a source stays
    only where it is the same.

    Raises:
        CameraError: if it is none of these, or the two do not go together.
        ConfigurationError: if the file cannot be used.
    """
    text = text.strip()
    if text == SourceKind.SIMULATED.value:
        return CameraSettings()
    if Path(text).suffix in {".yaml", ".yml"} and "=" not in text:
        settings = load_settings(Path(text))
        settings.check()
        return settings
    return with_sources(load_settings(), _sides(text))


def with_sources(settings: CameraSettings, sources: dict[str, str]) -> CameraSettings:
    """Return the settings with other sources.

    Raises:
        CameraError: if the sources cannot be read or do not go together.
    """
    sides = {side: getattr(settings, side) for side in SIDES}
    colour = settings.marker_colour
    for side, text in sources.items():
        source = str(parse_source(text))
        if sides[side].source != source:  # what was measured is of another camera
            sides[side] = OneCamera(source=source)
            colour = None
    changed = settings.model_copy(update=sides | {"marker_colour": colour})
    changed.check()
    return changed


def with_latency(settings: CameraSettings, side: str, median: float, sd: float) -> CameraSettings:
    """Return the settings with a measured latency [s] and its spread [s] of one side."""
    camera = getattr(settings, side).model_copy(
        update={
            "latency_ms": round(max(0.0, median) / MILLISECOND, 2),
            "latency_sd_ms": round(sd / MILLISECOND, 2),
        }
    )
    return settings.model_copy(update={side: camera})


def with_colour(settings: CameraSettings, colour: ColourModel | None) -> CameraSettings:
    """Return the settings with a learned colour of the marker; None forgets it."""
    return settings.model_copy(update={"marker_colour": colour})


def keep_colour(used: CameraSettings, colour: ColourModel) -> Path | None:
    """Remember a learned colour with the cameras that it was learned by; return where.

    Cameras that are not the remembered ones (chosen for this once, or simulated) leave the
    settings as they are: None.

    Args:
        used: settings of the cameras that run.
        colour: of the marker.
    """
    settings = load_settings()
    same = [camera.source for camera in used.cameras] == [c.source for c in settings.cameras]
    if used.simulated or not same:
        return None
    return save_settings(with_colour(settings, colour))


def _sides(text: str) -> dict[str, str]:
    sides: dict[str, str] = {}
    for part in text.split(","):
        side, equals, source = part.partition("=")
        side = side.strip()
        if not equals or side not in SIDES or side in sides:
            raise CameraError(
                sentence(
                    "{wanted!r} names no cameras; give `simulated`, a settings file (.yaml), or "
                    "left=SOURCE,right=SOURCE, for example left=usb:1-1.1,right=usb:1-1.2",
                    wanted=text,
                )
            )
        sides[side] = source
    return sides
