"""What a calibration of two cameras says, as its YAML file holds it.

Lengths are millimetres and angles radians in the file; what this module hands out is SI. The
routines that make one live in `tracking.calibration`.
"""

from collections.abc import Mapping
from datetime import datetime
from typing import Annotated, Any, Self

import numpy as np
from pydantic import Field, model_validator

from app.core.arrays import FloatArray, frozen
from app.core.configuration import Strict
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.lens import LensModel

PARAMETERS = LensModel.BROWN.parameters
"""Order of the parameters of a camera with the usual lens in its covariance."""

RAY_GRID = (7, 9)
"""Rows and columns of the places at which the rays' deviation is kept: the first and last lie on
the picture's edge."""

FORMAT = "acus-stereo-calibration"

Row3 = tuple[float, float, float]
Row6 = tuple[float, float, float, float, float, float]


class CameraCalibration(Strict):
    """Intrinsics of one camera with their uncertainty.

    Attributes:
        name: of the camera in the rig.
        image_size: width, height [px]; a picture of another size is refused.
        focal_px: fx, fy.
        centre_px: cx, cy; pixel (0, 0) is the centre of the upper left pixel.
        lens: model of the distortion.
        distortion: its coefficients in OpenCV's order; those that the data did not support are 0.
        estimated: which of the lens' parameters were estimated; the others are fixed.
        covariance: of the lens' parameters, as many rows as there are; zero rows for fixed ones.
        rms_px: root mean square of the reprojection error, 2D.
        views: number of pictures used.
        ray_sd_px: standard deviation of its rays over the picture, rows of
            `RAY_GRID` [px]; None in imported files.
        rolling_px: by how much the board moved while its pictures were read row by row, root mean
            square [px]; None if nothing speaks for a rolling shutter.
    """

    name: Annotated[str, Field(min_length=1)]
    image_size: tuple[int, int]
    focal_px: tuple[float, float]
    centre_px: tuple[float, float]
    lens: LensModel = LensModel.BROWN
    distortion: tuple[float, ...]
    estimated: tuple[str, ...] = PARAMETERS
    covariance: tuple[tuple[float, ...], ...] = ((0.0,) * 9,) * 9
    rms_px: Annotated[float, Field(ge=0.0)] = 0.0
    views: Annotated[int, Field(ge=0)] = 0
    ray_sd_px: tuple[tuple[Annotated[float, Field(ge=0.0)], ...], ...] | None = None

    rolling_px: Annotated[float, Field(ge=0.0)] | None = None

    @model_validator(mode="before")
    @classmethod
    def _by_lens(cls, values: Any) -> Any:
        """Fill in what the defaults of another lens than the usual one are."""
        if not isinstance(values, Mapping) or values.get("lens") not in set(LensModel):
            return values
        names = LensModel(values["lens"]).parameters
        return {"estimated": names, "covariance": ((0.0,) * len(names),) * len(names), **values}

    @model_validator(mode="after")
    def _shapes(self) -> Self:
        names = self.lens.parameters
        require_coefficients(self.lens, self.distortion)
        if np.shape(self.covariance) != (len(names), len(names)):
            raise ValueError(
                sentence(
                    "covariance needs {size} rows of {size} numbers, in the order {names}",
                    size=len(names),
                    names=names,
                )
            )
        if self.ray_sd_px is not None and np.shape(self.ray_sd_px) != RAY_GRID:
            raise ValueError(
                sentence(
                    "ray_sd_px needs {rows} rows of {columns} numbers",
                    rows=RAY_GRID[0],
                    columns=RAY_GRID[1],
                )
            )
        if unknown := set(self.estimated) - set(names):
            raise ValueError(
                sentence(
                    "estimated names {unknown}; there are {names}",
                    unknown=sorted(unknown),
                    names=names,
                )
            )
        return self

    @property
    def intrinsics(self) -> FloatArray:
        """fx, fy, cx, cy [px], shape (4,)."""
        return np.array([*self.focal_px, *self.centre_px])

    @property
    def parameter_covariance(self) -> FloatArray:
        """Covariance of the lens' parameters, shape (n, n)."""
        count = len(self.lens.parameters)
        return frozen(self.covariance, (count, count), "covariance")

    def model(self, T_world_camera: RigidTransform) -> CameraModel:
        """Return the camera at a pose."""
        return CameraModel(
            self.name,
            self.intrinsics,
            np.array(self.distortion),
            self.image_size,
            T_world_camera,
            self.lens,
        )


def require_coefficients(lens: LensModel, given: tuple[float, ...]) -> None:
    """Refuse another number of coefficients than the lens has.

    Raises:
        ValueError: naming both.
    """
    names = lens.coefficients
    if len(given) != len(names):
        raise ValueError(
            sentence(
                "distortion: {given_numbers} numbers; lens {lens} has {needed_numbers}: ",
                given_numbers=len(given),
                lens=lens.value,
                needed_numbers=len(names),
            )
            + ", ".join(names)
        )


class PoseCalibration(Strict):
    """A rigid transform with its uncertainty.

    Attributes:
        rotation: matrix, rows.
        translation_mm: of the transform.
        covariance: 6 rows of 6, of the twist (translation [m], rotation vector [rad]) as
            `RigidTransform.exp` takes it, on the left: T = exp(twist) @ T_estimated.
    """

    rotation: tuple[Row3, Row3, Row3]
    translation_mm: Row3
    covariance: tuple[Row6, Row6, Row6, Row6, Row6, Row6] = ((0.0,) * 6,) * 6

    @classmethod
    def of(
        cls, transform: RigidTransform, covariance: FloatArray | None = None
    ) -> "PoseCalibration":
        """Take a transform [m] and its covariance."""
        spread = np.zeros((6, 6)) if covariance is None else covariance
        return cls.model_validate(
            {
                "rotation": transform.rotation.tolist(),
                "translation_mm": (transform.translation / MILLIMETRE).tolist(),
                "covariance": np.asarray(spread).tolist(),
            }
        )

    @property
    def transform(self) -> RigidTransform:
        """The transform [m]."""
        return RigidTransform(np.array(self.rotation), np.array(self.translation_mm) * MILLIMETRE)

    @property
    def pose_covariance(self) -> FloatArray:
        """Covariance of the twist (translation [m], rotation vector [rad]), shape (6, 6)."""
        return frozen(self.covariance, (6, 6), "pose covariance")


class Validation(Strict):
    """How well views that took no part in the calibration come out.

    Attributes:
        views: pairs held back.
        points: corners triangulated in them.
        rms_mm: root mean square 3D distance to the true board after a rigid fit (no scale).
        max_mm: the largest.
        scale: mean measured length over true length of neighbouring corners; 1 is right.
        scale_sd: standard deviation of `scale`.
        epipolar_px: root mean square distance from the epipolar line.
        distance_mm: mean distance of the boards from the cameras.
    """

    views: int
    points: int
    rms_mm: float
    max_mm: float
    scale: float
    scale_sd: float
    epipolar_px: float
    distance_mm: Annotated[float, Field(gt=0.0)]


class FitTogether(Strict):
    """How well pairs fit together, against each of their pictures by itself.

    Attributes:
        alone_px: root mean square residual of the left and the right pictures, each with its
            board's pose fitted to it alone, 2D.
        together_px: of both cameras estimated together.
        sd_factor: by which the standard deviations were multiplied for the lack of fit; 1 if there
            is none beyond chance.
    """

    alone_px: tuple[float, float]
    together_px: Annotated[float, Field(ge=0.0)]
    sd_factor: Annotated[float, Field(ge=1.0)] = 1.0


class StereoCalibration(Strict):
    """Two calibrated cameras.

    Attributes:
        id: unique, e.g. `20261122-091244-3f2a`; what an attempt stores.
        created: when, with time zone.
        board: specification of the board, e.g. `charuco:9x6:20mm:15mm:DICT_5X5_100`.
        cameras: left, right.
        pose: T_right_left: takes points of the left camera's frame to the right one's.
        rms_px: root mean square reprojection error over both pictures.
        misfit_px: what the lens models leave besides the corners' noise, standard deviation per
            axis; None in imported files.
        world: T_world_left; None until a board at a known place was seen. Its covariance is that
            of the board's place and corners, were the cameras known exactly.
        world_by_cameras: change of the twist of `world` with what `covariance` is of, 6 rows: the
            same cameras saw that board, and their errors move it. None in files that do not say.
        validation: on views held back; None if there were none.
        together: how well the pairs fit together; None in imported files.
        joint_covariance: of both cameras' parameters and the twist of `pose`, estimated together,
            24 rows of 24 for two usual lenses; None where only each one's own is known (imported
            files). Lenses and pose make up for each other: taken as independent they promise less
            than is true.
        notes: lines for people: coefficients dropped, views left out, corner orders mended.
    """

    format: str = FORMAT
    version: int = 1
    id: Annotated[str, Field(pattern=r"^[A-Za-z0-9._-]{1,64}$")]
    created: datetime
    board: str = ""
    cameras: tuple[CameraCalibration, CameraCalibration]
    pose: PoseCalibration
    rms_px: Annotated[float, Field(ge=0.0)] = 0.0
    misfit_px: Annotated[float, Field(ge=0.0)] | None = None
    world: PoseCalibration | None = None
    world_by_cameras: tuple[tuple[float, ...], ...] | None = None
    validation: Validation | None = None
    together: FitTogether | None = None
    joint_covariance: tuple[tuple[float, ...], ...] | None = None
    notes: tuple[str, ...] = ()

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
        size = self._sizes[-1]
        if self.joint_covariance is not None and np.shape(self.joint_covariance) != (size, size):
            raise ValueError(
                sentence(
                    "joint_covariance needs {size} rows of {size} numbers: left, right, pose",
                    size=size,
                )
            )
        if self.world_by_cameras is not None and np.shape(self.world_by_cameras) != (6, size):
            raise ValueError(
                sentence(
                    "world_by_cameras needs 6 rows of {size} numbers: left, right, pose", size=size
                )
            )
        return self

    @property
    def _sizes(self) -> tuple[int, int, int]:
        """Return where the left camera's parameters, the right one's and the pose's twist end."""
        left, right = (len(camera.lens.parameters) for camera in self.cameras)
        return left, left + right, left + right + 6

    @property
    def covariance(self) -> FloatArray:
        """Covariance of left and right parameters and the twist of `pose`, shape (n, n)."""
        left, right, size = self._sizes
        if self.joint_covariance is not None:
            return frozen(self.joint_covariance, (size, size), "joint covariance")
        result = np.zeros((size, size))
        result[:left, :left] = self.cameras[0].parameter_covariance
        result[left:right, left:right] = self.cameras[1].parameter_covariance
        result[right:, right:] = self.pose.pose_covariance
        return frozen(result, (size, size), "covariance")

    @property
    def covariance_with_world(self) -> FloatArray:
        """Covariance of what `covariance` is of and then the twist of `world`, shape (30, 30)."""
        cameras = self.covariance
        n = len(cameras)
        change = np.zeros((6, n)) if self.world_by_cameras is None else self.world_by_cameras
        whole = np.vstack([np.eye(n), change])
        result = whole @ cameras @ whole.T
        if self.world is not None:
            result[n:, n:] += self.world.pose_covariance
        return frozen(result, (n + 6, n + 6), "covariance with the world frame")

    @property
    def uncertainty_known(self) -> bool:
        """Return whether it says how sure lenses and relative pose are; files of other programs do
        not.

        Where it does not, the covariance stands as zero: what is made of it leaves out the
        calibration's own error, and must say so.
        """
        return bool(np.any(self.covariance))

    @property
    def baseline(self) -> float:
        """Distance between the cameras [m]."""
        return float(np.linalg.norm(self.pose.transform.translation))

    def models(self) -> tuple[CameraModel, CameraModel]:
        """Both cameras in world; in the left camera's frame where no world is known."""
        T_world_left = self.world.transform if self.world else RigidTransform.identity()
        left, right = self.cameras
        T_world_right = T_world_left @ self.pose.transform.inverse()
        return left.model(T_world_left), right.model(T_world_right)
