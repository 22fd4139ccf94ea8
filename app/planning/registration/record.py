"""Registration checks as files: the points as they were found; the figures follow from them."""

from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Annotated, Self
from uuid import uuid4

import numpy as np
import yaml
from pydantic import Field, model_validator

from app.core import paths
from app.core.arrays import FloatArray
from app.core.configuration import Strict, load
from app.core.files import write_atomically
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.planning.registration.check import RegistrationCheck
from app.planning.registration.plate import FiducialPlate
from app.planning.registration.points import NamedPoints

FORMAT = "acus-registration-check"

_Row = tuple[float, float, float]


class FoundPoint(Strict):
    """A fiducial as it was found [mm], with its covariance [mm²] (zero where none is known)."""

    name: str
    point_mm: _Row
    covariance_mm2: tuple[_Row, _Row, _Row] = ((0.0,) * 3,) * 3

    @classmethod
    def all_of(cls, points: NamedPoints) -> "tuple[FoundPoint, ...]":
        """Take them from points in metres."""
        rows = zip(points.names, points.points, points.covariances, strict=True)
        return tuple(
            cls.model_validate(
                {
                    "name": name,
                    "point_mm": (point / MILLIMETRE).tolist(),
                    "covariance_mm2": (spread / MILLIMETRE**2).tolist(),
                }
            )
            for name, point, spread in rows
        )


class RegistrationRecord(Strict):
    """One saved check.

    Attributes:
        id: unique; the file's name.
        created: when, with time zone.
        plate: the plate as it was then, so that a later edit of its file changes nothing here.
        touched: in world.
        picked: in the CT (LPS); empty where none was used.
        series: pseudonym of that CT.
        frame: stands for its frame of reference (`Series.frame`); empty where it was not noted.
        calibration: id of the cameras' calibration; empty for cameras by their profile.
        rig: name of the camera rig.
        simulated: whether the robot was simulated.
    """

    format: str = FORMAT
    version: int = 1
    id: Annotated[str, Field(pattern=r"^[A-Za-z0-9._-]{1,64}$")]
    created: datetime
    plate: FiducialPlate
    touched: tuple[FoundPoint, ...]
    picked: tuple[FoundPoint, ...] = ()
    series: str = ""
    frame: str = ""
    calibration: str = ""
    rig: str = ""
    simulated: bool = False

    @model_validator(mode="after")
    def _known(self) -> Self:
        if self.format != FORMAT or self.version != 1:
            raise ValueError(
                sentence(
                    "format {format} {version} is not {known_format} 1",
                    format=self.format,
                    version=self.version,
                    known_format=FORMAT,
                )
            )
        return self

    def check(self) -> RegistrationCheck:
        """Compute the check anew from the points.

        Raises:
            RegistrationError: if the points fix no rotation or are not on the plate.
        """
        picked = points_of(self.picked) if self.picked else None
        return RegistrationCheck.of(self.plate, points_of(self.touched), picked)


def points_of(result: tuple[FoundPoint, ...]) -> NamedPoints:
    """Return them in metres."""
    return NamedPoints(
        tuple(point.name for point in result),
        np.array([point.point_mm for point in result], dtype=np.float64).reshape(-1, 3)
        * MILLIMETRE,
        _metres2([point.covariance_mm2 for point in result]),
    )


def _metres2(rows: list[tuple[_Row, _Row, _Row]]) -> FloatArray:
    result: FloatArray = np.array(rows, dtype=np.float64).reshape(-1, 3, 3) * MILLIMETRE**2
    return result


def new_id(now: datetime) -> str:
    """Return an id that sorts by time."""
    return f"{now:%Y%m%d-%H%M%S}-{uuid4().hex[:4]}"


@dataclass(frozen=True, slots=True)
class Registrations:
    """The folder of saved checks; by default the user's own.

    Attributes:
        folder: holds one YAML file per check.
    """

    folder: Path

    @classmethod
    def own(cls) -> "Registrations":
        """Return the user's."""
        return cls(paths.data() / "registrations")

    def save(self, record: RegistrationRecord) -> Path:
        """Write a check whole or not at all; returns its file."""
        path = self.folder / f"{record.id}.yaml"
        document = record.model_dump(mode="json")
        write_atomically(path, yaml.safe_dump(document, sort_keys=False, allow_unicode=True))
        return path

    def records(self) -> Iterator[RegistrationRecord]:
        """All checks, newest first.

        Raises:
            ConfigurationError: at a file that cannot be read, when it is reached.
        """
        for path in sorted(self.folder.glob("*.yaml"), reverse=True):
            yield load(path, RegistrationRecord)

    def newest(
        self,
        calibration: str,
        rig: str,
        simulated: bool,
        series: str = "",
        frame: str = "",
    ) -> RegistrationRecord | None:
        """Newest check that says something of these cameras, and of this CT where it used one.

        A check holds for the calibration it was made with: with another one the cameras' frame is
        another, and nothing was checked. `frame` is the CT's frame of reference: points of another
        one lie elsewhere.
        """
        for record in self.records():
            same = (record.calibration, record.rig, record.simulated) == (
                calibration,
                rig,
                simulated,
            )
            ours = record.series == series
            ours = ours and (not record.frame or not frame or record.frame == frame)
            if same and (not record.picked or ours):
                return record
        return None
