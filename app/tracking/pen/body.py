"""What is printed: the cube or ring on the pen, the sheet on the table, and their profiles.

Frames. `body`: origin in the middle of the cube, +z along the shaft towards the tip. `base`: origin
at the printed cross, x right and y up on the sheet, z out of it. Held tip down over the sheet, the
body's z is the base's -z.
"""

from math import cos, pi, sin, tan
from pathlib import Path
from typing import Annotated, Self

import numpy as np
from pydantic import Field, model_validator

from app.core import paths
from app.core.arrays import FloatArray, frozen
from app.core.configuration import Strict, load
from app.core.messages import sentence, sentence_of
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.tracking.pen.board import Marker, MarkerBoard, all_ids
from app.tracking.pen.errors import PenError

_QUIET_CELLS = 0.9
"""White that a marker needs round it, in cells of the marker (6 along its side)."""

_DOWN = np.array([0.0, 0.0, 1.0])

Length = Annotated[float, Field(gt=0.0, le=500.0)]


class BodyProfile(Strict):
    """The cube or ring: square faces round the shaft, and one on top if it is a cube.

    Attributes:
        sides: faces round the shaft, 4 for a cube; 5 to 8 make a ring.
        edge_mm: of a face.
        marker_mm: side of the black square on it.
        top: whether a face closes the upper end; only a cube can have one.
        dictionary: of ArUco.
        first_id: of the first side; the others count up to the right, the top is last.
        build_sd_mm: how far a corner is from where it should be, per axis: print, folds, glue.
    """

    sides: Annotated[int, Field(ge=3, le=12)] = 4
    edge_mm: Length = 40.0
    marker_mm: Length = 30.0
    top: bool = True
    dictionary: str = "DICT_4X4_50"
    first_id: Annotated[int, Field(ge=0)] = 0
    build_sd_mm: Annotated[float, Field(ge=0.0, le=5.0)] = 0.2

    @model_validator(mode="after")
    def _fits(self) -> Self:
        quiet = 0.5 * (self.edge_mm - self.marker_mm)
        needed = _QUIET_CELLS * self.marker_mm / 6.0
        if quiet < needed:
            raise ValueError(
                sentence(
                    "marker_mm {marker_mm:g} leaves {quiet:.1f} mm of white on an edge of "
                    "{edge_mm:g} mm; {needed:.1f} mm are needed",
                    marker_mm=self.marker_mm,
                    quiet=quiet,
                    edge_mm=self.edge_mm,
                    needed=needed,
                )
            )
        if self.top and self.sides != 4:
            raise ValueError(sentence("top needs 4 sides, not {sides}", sides=self.sides))
        return self

    @property
    def apothem(self) -> float:
        """Distance of a side face from the shaft's axis [m]."""
        return 0.5 * self.edge_mm * MILLIMETRE / tan(pi / self.sides)

    @property
    def faces(self) -> int:
        """Number of faces with a marker."""
        return self.sides + self.top

    def board(self) -> MarkerBoard:
        """Return the markers in the body's frame."""
        side, up = self.marker_mm * MILLIMETRE, -_DOWN
        normals = [
            np.array([cos(angle), sin(angle), 0.0])
            for angle in (-2.0 * pi * k / self.sides for k in range(self.sides))
        ]
        markers = [
            Marker.at(self.first_id + k, side, self.apothem * normal, up, normal)
            for k, normal in enumerate(normals)
        ]
        if self.top:
            centre = 0.5 * self.edge_mm * MILLIMETRE * up
            markers.append(Marker.at(self.first_id + self.sides, side, centre, -normals[0], up))
        name = "cube" if self.top else "ring"
        return MarkerBoard(name, self.dictionary, tuple(markers), self.build_sd_mm * MILLIMETRE)


class BaseProfile(Strict):
    """The sheet on the table: markers round a cross, which is the entry.

    Attributes:
        columns, rows: of markers; a marker whose white would reach the cross is left out.
        pitch_mm: from marker to marker.
        marker_mm: side of a black square.
        clear_mm: radius round the cross that stays free.
        dictionary: of ArUco.
        first_id: of the first marker.
        build_sd_mm: how far a corner is from where it should be, per axis: print, unevenness.
        turn_deg: turn of the sheet's x against the world's x, about the world's z.
    """

    columns: Annotated[int, Field(ge=1, le=12)] = 5
    rows: Annotated[int, Field(ge=1, le=12)] = 4
    pitch_mm: Length = 46.0
    marker_mm: Length = 34.0
    clear_mm: Annotated[float, Field(ge=0.0, le=100.0)] = 18.0
    dictionary: str = "DICT_4X4_50"
    first_id: Annotated[int, Field(ge=0)] = 20
    build_sd_mm: Annotated[float, Field(ge=0.0, le=5.0)] = 0.1
    turn_deg: Annotated[float, Field(ge=-360.0, le=360.0)] = 0.0

    @property
    def centres_mm(self) -> FloatArray:
        """Centres of the markers on the sheet [mm], shape (n, 2), row by row from the top left."""
        x = (np.arange(self.columns) - 0.5 * (self.columns - 1)) * self.pitch_mm
        y = (0.5 * (self.rows - 1) - np.arange(self.rows)) * self.pitch_mm
        grid = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
        nearest = np.abs(grid) - 0.5 * self.marker_mm
        free = np.hypot(*np.clip(nearest, 0.0, None).T) >= self.clear_mm
        return frozen(grid[free])

    def board(self) -> MarkerBoard:
        """Return the markers in the sheet's frame."""
        normal, up = np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0])
        side = self.marker_mm * MILLIMETRE
        markers = tuple(
            Marker.at(self.first_id + k, side, np.array([x, y, 0.0]) * MILLIMETRE, up, normal)
            for k, (x, y) in enumerate(self.centres_mm)
        )
        return MarkerBoard("sheet", self.dictionary, markers, self.build_sd_mm * MILLIMETRE)

    def pose(self, p_entry: FloatArray) -> RigidTransform:
        """T_world_base: the cross at the entry [m], shape (3,), the sheet level."""
        angle = self.turn_deg * DEGREE
        turn = np.array(
            [[cos(angle), -sin(angle), 0.0], [sin(angle), cos(angle), 0.0], [0.0, 0.0, 1.0]]
        )
        return RigidTransform(turn, p_entry)


class TipProfile(Strict):
    """Tip and direction of the shaft in the body's frame, and how well they are known.

    Attributes:
        position_mm: of the tip.
        covariance_mm2: of it, 3 rows of 3.
        axis: direction of the shaft towards the tip.
        axis_sd_deg: standard deviation of the direction, per axis across it.
        calibrated: whether it was measured by pivoting, or is what the drawing says.
    """

    position_mm: tuple[float, float, float] = (0.0, 0.0, 180.0)
    covariance_mm2: tuple[
        tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]
    ] = ((9.0, 0.0, 0.0), (0.0, 9.0, 0.0), (0.0, 0.0, 9.0))
    axis: tuple[float, float, float] = (0.0, 0.0, 1.0)
    axis_sd_deg: Annotated[float, Field(ge=0.0, le=45.0)] = 1.0
    calibrated: bool = False


class PenProfile(Strict):
    """Everything printed and measured about one pen.

    Attributes:
        name, description: for people.
        body: cube or ring.
        base: sheet.
        tip: of the pen.
        systematic_px: what lens model and print leave in a corner beside noise, per axis.
    """

    name: Annotated[str, Field(min_length=1)]
    description: str = ""
    body: BodyProfile = BodyProfile()
    base: BaseProfile = BaseProfile()
    tip: TipProfile = TipProfile()
    systematic_px: Annotated[float, Field(ge=0.0, le=5.0)] = 0.05

    @model_validator(mode="after")
    def _different_ids(self) -> Self:
        try:
            all_ids((self.body.board(), self.base.board()))
        except PenError as error:
            raise ValueError(sentence_of(error)) from error
        if self.body.dictionary != self.base.dictionary:
            raise ValueError(sentence("cube and sheet need one dictionary"))
        return self

    def resized(self, edge_mm: float) -> "PenProfile":
        """Return the pen with faces of another edge; markers grow with them, the tip stays."""
        body = self.body.model_dump() | {
            "edge_mm": edge_mm,
            "marker_mm": round(self.body.marker_mm * edge_mm / self.body.edge_mm, 3),
        }
        name = f"{self.name}-{edge_mm:g}mm"
        told = f"{self.description} (faces of {edge_mm:g} mm instead)" if self.description else ""
        changed = {"name": name, "description": told, "body": body}
        return PenProfile.model_validate(self.model_dump() | changed)


def shipped_pens() -> list[str]:
    """Names of the pen profiles that come with the program."""
    return sorted(path.stem for path in (paths.resources() / "pens").glob("*.yaml"))


def load_pen(name_or_path: str | Path) -> PenProfile:
    """Load a shipped profile by name, or one from a file.

    Raises:
        PenError: if no profile has that name.
        ConfigurationError: if the file is not a valid profile; names field and value.
    """
    path = Path(name_or_path)
    if path.suffix not in {".yaml", ".yml"}:
        path = paths.resources() / "pens" / f"{name_or_path}.yaml"
        if not path.is_file():
            raise PenError(
                sentence(
                    "no pen is called {name_or_path!r}; there are {shipped_pens}, "
                    "or give the path of a .yaml file",
                    name_or_path=str(name_or_path),
                    shipped_pens=", ".join(shipped_pens()),
                )
            )
    return load(path, PenProfile)
