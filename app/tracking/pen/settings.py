"""Which webcam and which pen: `pen.yaml` in the user's settings.

Pens with a measured tip are kept in the user's data; the one before stays, for undo.
"""

from pathlib import Path
from typing import Annotated

import yaml
from pydantic import Field, field_validator

from app.core import paths
from app.core.configuration import Strict, load, read_yaml
from app.core.files import write_atomically
from app.core.messages import sentence, sentence_of
from app.tracking.cameras.source import SourceKind, parse_source
from app.tracking.errors import CameraError
from app.tracking.optics.calibration import CameraCalibration, StereoCalibration
from app.tracking.pen.body import PenProfile, load_pen
from app.tracking.pen.webcam import Webcam


def calibrated_path(pen: str) -> Path:
    """Return where a pen with a measured tip is kept.

    Args:
        pen: name, or path of its file.
    """
    return paths.data() / "pens" / f"{Path(pen).stem}.yaml"


def before_path(pen: str) -> Path:
    """Return where the one before is kept."""
    return calibrated_path(pen).parent / "before" / calibrated_path(pen).name


def save_pen(pen: PenProfile, name: str = "") -> Path:
    """Keep a pen with its measured tip; return where. It is used instead of the shipped one.

    Args:
        pen: with its tip measured.
        name: under which it is looked for; without, its own.
    """
    name = name or pen.name
    file, before = calibrated_path(name), before_path(name)
    before.unlink(missing_ok=True)
    if file.is_file():
        before.parent.mkdir(parents=True, exist_ok=True)
        file.replace(before)
    write_atomically(file, yaml.safe_dump(pen.model_dump(mode="json"), sort_keys=False))
    return file


def undo_pen(name: str) -> bool:
    """Exchange the pen that is used with the one before it, which may be the drawing's.

    Twice is as never. Returns whether a measured tip is in use now.
    """
    file, before = calibrated_path(name), before_path(name)
    aside = file.with_suffix(".aside")
    before.parent.mkdir(parents=True, exist_ok=True)
    if file.is_file():
        file.replace(aside)
    if before.is_file():
        before.replace(file)
    if aside.is_file():
        aside.replace(before)
    return file.is_file()


def can_undo(name: str) -> bool:
    """Return whether a measured tip was kept before, in use or not."""
    return calibrated_path(name).is_file() or before_path(name).is_file()


class PenSettings(Strict):
    """The webcam and the pen.

    Attributes:
        source: `usb:PORT`, `folder:PATH`, `video:PATH` or `simulated`.
        size: width, height of the pictures [px].
        rate_hz: pictures per second that are asked for.
        pen: name or path of a pen profile.
        edge_mm: edge of a face of another size than the profile's; None for the profile's.
        calibration: file with the webcam's lens: one camera, or two of which `camera` is one; None
            guesses it from the size of the picture.
        camera: name of the camera in a calibration of two.
    """

    source: str = SourceKind.SIMULATED.value
    size: tuple[int, int] = (1280, 720)
    rate_hz: Annotated[float, Field(gt=0.0, le=1000.0)] = 30.0
    pen: str = "cube"
    edge_mm: Annotated[float, Field(ge=10.0, le=200.0)] | None = None
    calibration: Path | None = None
    camera: str = "left"

    @field_validator("source")
    @classmethod
    def _readable(cls, text: str) -> str:
        try:
            return str(parse_source(text))
        except CameraError as error:
            raise ValueError(sentence_of(error)) from error

    @property
    def simulated(self) -> bool:
        """Return whether the pictures are drawn."""
        return parse_source(self.source).kind is SourceKind.SIMULATED

    @property
    def kept_name(self) -> str:
        """Name under which this pen is kept once its tip is measured: another size is another."""
        return self.pen if self.edge_mm is None else f"{Path(self.pen).stem}-{self.edge_mm:g}mm"

    def profile(self) -> PenProfile:
        """Return the pen in its size, as calibrated if it was.

        Raises:
            PenError: if there is none of that name.
            ConfigurationError: if its file cannot be used.
        """
        kept = calibrated_path(self.kept_name)
        if kept.is_file():
            return load_pen(kept)
        pen = load_pen(self.pen)
        return pen if self.edge_mm is None else pen.resized(self.edge_mm)

    def webcam(self) -> Webcam | None:
        """Return the lens; None if it has to be guessed.

        Raises:
            ConfigurationError: if the calibration's file cannot be used.
        """
        return None if self.calibration is None else load_webcam(self.calibration, self.camera)


def load_webcam(path: Path, camera: str = "left") -> Webcam:
    """Read the lens from a calibration of one camera, or of two.

    Raises:
        ConfigurationError: if the file is neither, or has no camera of that name.
    """
    document = read_yaml(path)
    if isinstance(document, dict) and "cameras" in document:
        pair = load(path, StereoCalibration).cameras
        found = next((one for one in pair if one.name == camera), None)
        if found is None:
            names = ", ".join(one.name for one in pair)
            raise CameraError(
                sentence(
                    "{path} has no camera {camera!r}; there are {names}",
                    path=path,
                    camera=camera,
                    names=names,
                )
            )
        return Webcam(found)
    return Webcam(load(path, CameraCalibration))


def settings_path() -> Path:
    """Return where the settings are kept."""
    return paths.settings() / "pen.yaml"


def load_settings(path: Path | None = None) -> PenSettings:
    """Read the settings; the defaults (a simulated webcam) if there are none yet.

    Raises:
        ConfigurationError: if the file says something that cannot be used.
    """
    file = path or settings_path()
    return PenSettings() if path is None and not file.exists() else load(file, PenSettings)


def save_settings(settings: PenSettings, path: Path | None = None) -> Path:
    """Write the settings, whole or not at all; return where."""
    file = path or settings_path()
    document = settings.model_dump(mode="json", exclude_none=True)
    write_atomically(file, yaml.safe_dump(document, sort_keys=False))
    return file


def with_source(settings: PenSettings, text: str) -> PenSettings:
    """Return the settings with another source of pictures.

    Raises:
        CameraError: if the source cannot be read; names the valid forms.
    """
    return settings.model_copy(update={"source": str(parse_source(text))})
