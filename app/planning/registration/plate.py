"""Fiducial plates: bodies with points at known places, as YAML gives them."""

from pathlib import Path
from typing import Annotated, Self

import numpy as np
from pydantic import Field, model_validator

from app.core import paths
from app.core.arrays import FloatArray, frozen
from app.core.configuration import Strict, load
from app.core.errors import ConfigurationError
from app.core.messages import sentence
from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.planning.registration.correspondence import likeness
from app.planning.registration.errors import RegistrationError
from app.planning.registration.rigid import checked_points, require_spread

Triple = tuple[float, float, float]


class Fiducial(Strict):
    """One fiducial in the plate's frame.

    Attributes:
        touch_mm: where the needle's tip rests when it touches it.
        bead_mm: centre of what the CT shows; `touch_mm` where it is not given.
    """

    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9_-]{1,16}$")]
    touch_mm: Triple
    bead_mm: Triple | None = None


class PlatePlacement(Strict):
    """Where a plate stands in world: translation, then the rotation vector of its frame."""

    translation_mm: Triple
    rotation_deg: Triple = (0.0, 0.0, 0.0)

    @property
    def transform(self) -> RigidTransform:
        """T_world_plate [m]."""
        return RigidTransform(
            rotation_exp(np.array(self.rotation_deg) * DEGREE),
            np.array(self.translation_mm) * MILLIMETRE,
        )


class FiducialPlate(Strict):
    """A plate and what may be expected of it.

    Attributes:
        fiducials: three at least, not on one line.
        bead_diameter_mm: of the beads in the CT.
        place: T_world_plate when it is mounted on the robot; None for one that is laid anywhere.
        place_sd_mm: how well it comes back there, standard deviation per axis.
        shared_sd_mm: what all touches share and no residual shows, standard deviation per axis: the
            tip's distance from the marker, how deep it sits in a pit, a bent needle.
        localisation_mm: error of a careful touch, root mean square in 3D.
        tolerance_mm: a residual beyond this is a mistake, not an error of measurement.
    """

    name: Annotated[str, Field(min_length=1)]
    description: str = ""
    fiducials: tuple[Fiducial, ...]
    bead_diameter_mm: float = Field(default=3.0, gt=0.0, le=20.0)
    place: PlatePlacement | None = None
    place_sd_mm: float = Field(default=0.0, ge=0.0, le=10.0)
    shared_sd_mm: float = Field(default=0.0, ge=0.0, le=10.0)
    localisation_mm: float = Field(default=0.5, gt=0.0, le=10.0)
    tolerance_mm: float = Field(default=2.0, gt=0.0, le=50.0)

    @model_validator(mode="after")
    def _usable(self) -> Self:
        names = [fiducial.name for fiducial in self.fiducials]
        if len(set(names)) < len(names):
            raise ValueError(
                sentence("two fiducials have the same name: {names}", names=", ".join(names))
            )
        for points in (self.touch, self.beads):
            require_spread(checked_points(points, "plate"), "plate")  # a ValueError too
        return self

    @property
    def names(self) -> tuple[str, ...]:
        """Of the fiducials, in order."""
        return tuple(fiducial.name for fiducial in self.fiducials)

    @property
    def touch(self) -> FloatArray:
        """Return where the tip rests in each fiducial, plate frame [m], shape (n, 3)."""
        return frozen(np.array([f.touch_mm for f in self.fiducials]) * MILLIMETRE)

    @property
    def beads(self) -> FloatArray:
        """Centres of what the CT shows, plate frame [m], shape (n, 3)."""
        return frozen(np.array([f.bead_mm or f.touch_mm for f in self.fiducials]) * MILLIMETRE)

    @property
    def likeness(self) -> float:
        """Residual of the fiducials in their best wrong order (root mean square [m]).

        Two exchanged points are found only where this is well above the error of a touch.
        """
        return likeness(self.touch)

    def rows(self, names: tuple[str, ...]) -> list[int]:
        """Positions of fiducials in the plate's list.

        Raises:
            RegistrationError: if one is not on the plate, or is named twice.
        """
        for name in names:
            if name not in self.names:
                raise RegistrationError(
                    sentence(
                        "plate {plate_name} has no fiducial {fiducial_name!r}; it has {names}",
                        plate_name=self.name,
                        fiducial_name=name,
                        names=", ".join(self.names),
                    )
                )
            if names.count(name) > 1:
                raise RegistrationError(
                    sentence("fiducial {name!r} is given twice; keep one of them", name=name)
                )
        return [self.names.index(name) for name in names]


def plate_names() -> list[str]:
    """Names of the shipped plates."""
    return sorted(path.stem for path in _folder().glob("*.yaml"))


def load_plate(name_or_path: str | Path) -> FiducialPlate:
    """Load a shipped plate by name, or any by the path of its YAML file.

    Raises:
        ConfigurationError: if there is none (names the valid ones), or the file is wrong.
    """
    text = str(name_or_path)
    if text in plate_names():
        return load(_folder() / f"{text}.yaml", FiducialPlate)
    if Path(text).suffix not in (".yaml", ".yml"):
        raise ConfigurationError(
            sentence(
                "no fiducial plate {wanted!r}; valid names: {plate_names}, "
                "or the path of a .yaml file",
                wanted=text,
                plate_names=", ".join(plate_names()),
            )
        )
    return load(Path(text), FiducialPlate)


def _folder() -> Path:
    return paths.resources() / "fiducials"
