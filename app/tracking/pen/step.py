"""One picture in, one needle out: detection, both poses, the needle, or why there is none."""

from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray, frozen
from app.core.transform import RigidTransform
from app.tracking.cameras.camera import Frame
from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.optics.camera_model import CameraModel
from app.tracking.pen.board import all_ids
from app.tracking.pen.body import PenProfile
from app.tracking.pen.detector import MarkerDetector, Sightings, grey_of
from app.tracking.pen.following import BoardFollower, Memory
from app.tracking.pen.locator import DECISIVE, BoardLocator
from app.tracking.pen.needle import PenNeedle, PenTip, solve_needle
from app.tracking.pen.pose import BoardPose, PoseStatus
from app.tracking.pen.webcam import Webcam, guessed_webcam

HOLE = 0.005
"""How far a shaft in the hole passes the entry, standard deviation [m]."""


@dataclass(frozen=True, slots=True, eq=False)
class PenObservation:
    """What one picture says.

    Attributes:
        fix: for session and loop.
        sightings: markers in the picture.
        body: pose of cube or ring in the camera's frame.
        base: pose of the sheet in the camera's frame.
        model: the camera, at the origin.
        needle: in world; None unless `fix` is valid.
        beside: how far the shaft's line passes the entry [m], shape (3,); zero without a needle.
        beside_sd: standard deviation of its length [m].
    """

    fix: NeedleFix
    sightings: Sightings
    body: BoardPose
    base: BoardPose
    model: CameraModel
    needle: PenNeedle | None
    beside: FloatArray
    beside_sd: float


class PenStep:
    """Everything that is known about pen, sheet and lens, and where they were in the last picture.

    Pictures are taken in the order of their times; the memory only saves time, and one that is half
    a second old, or of another order, is dropped. Not for two threads at once.

    Args:
        pen: profile.
        webcam: its lens; None guesses it from the first picture's size.
        fulcrum: P_I in world [m], shape (3,): where the printed cross lies.
    """

    def __init__(self, pen: PenProfile, webcam: Webcam | None, fulcrum: FloatArray) -> None:
        self.pen = pen
        self.webcam = webcam
        self.fulcrum = frozen(fulcrum, (3,), "fulcrum")
        self.tip = PenTip.of(pen.tip)
        self.T_world_base = pen.base.pose(self.fulcrum)
        body, base = pen.body.board(), pen.base.board()
        self._wanted = all_ids((body, base))
        self._sheet = frozenset(marker.id for marker in base.markers)
        self._own = {marker.id for marker in body.markers}
        self._body = BoardFollower(BoardLocator(body, pen.systematic_px))
        self._base = BoardFollower(BoardLocator(base, pen.systematic_px))
        self._memory = Memory()
        self._detector = MarkerDetector(body.dictionary)

    def look(self, frame: Frame) -> PenObservation:
        """Find the needle in a picture; every failure is a status of the fix.

        Raises:
            PenError: if the picture has another size than the calibration.
        """
        height, width = frame.image.shape[:2]
        webcam = self.webcam or guessed_webcam((width, height))
        webcam.require_size((width, height))
        self.webcam, model = webcam, webcam.model
        sightings, body, base = self._poses(frame, model)
        if body.either and base.status is PoseStatus.FOUND:
            body = self._through_the_entry(body, base, webcam)
        status, reason = _status(sightings, body, base, self._body.board.name, self._own)
        if status is not FixStatus.VALID:
            return self._without(frame.time, status, reason, sightings, body, base, model)
        needle = solve_needle(body, base, self.T_world_base, self.tip, webcam.parameter_covariance)
        depth, variance = needle.depth(self.fulcrum)
        beside, beside_sd = needle.beside(self.fulcrum)
        centre, _ = model.project_camera(body.T_camera_board.translation[None])
        fix = NeedleFix(
            needle.p_tip, needle.tip_covariance, frame.time, FixStatus.VALID, (centre[0], None),
            float(np.hypot(body.residual_px, base.residual_px)), depth, variance, has_point=True,
        )  # fmt: skip
        return PenObservation(fix, sightings, body, base, model, needle, beside, beside_sd)

    def _poses(self, frame: Frame, model: CameraModel) -> tuple[Sightings, BoardPose, BoardPose]:
        """Find both boards: round the last find if that will do, in the whole picture if not."""
        grey, memory = grey_of(frame.image), self._memory
        region = memory.region(frame.time, grey)
        if region is not None and memory.base is not None:
            found = self._detector.find(grey, self._own, region=region)
            body = self._body.locate(model, found.markers)
            if (body.status is PoseStatus.FOUND or body.either) and not found.doubles:
                memory.keep(grey, model, self._body.board, body, full=False)
                return memory.with_sheet(found), body, memory.base
        if memory.fresh:
            self._body.forget()
            self._base.forget()
        found = self._detector.find(grey, self._wanted, self._sheet)
        body = self._body.locate(model, found.markers)
        base = self._base.locate(model, found.markers)
        memory.keep_sheet(grey, found, self._own, base)
        memory.keep(grey, model, self._body.board, body, full=True)
        return found, body, base

    def _through_the_entry(self, body: BoardPose, base: BoardPose, webcam: Webcam) -> BoardPose:
        """Of two poses that look the same the one whose shaft goes through the hole, if one does.

        They are tens of degrees apart; with the shaft in the hole the wrong one misses it by far.
        """
        needles = [
            solve_needle(one, base, self.T_world_base, self.tip, webcam.parameter_covariance)
            for one in body.either
        ]
        misses = [float(np.linalg.norm(n.beside(self.fulcrum)[0])) for n in needles]
        costs = [
            one.chi_square + (miss / HOLE) ** 2
            for one, miss in zip(body.either, misses, strict=True)
        ]
        best, other = np.argsort(costs).tolist()
        certain = (
            costs[other] - costs[best] > DECISIVE
            and misses[best] < 3.0 * HOLE
            and needles[best].axis[2] < 0.0
        )
        return body.either[best] if certain else body

    def _without(
        self,
        time: float,
        status: FixStatus,
        reason: str,
        sightings: Sightings,
        body: BoardPose,
        base: BoardPose,
        model: CameraModel,
    ) -> PenObservation:
        seen = body.status is PoseStatus.FOUND
        centre = model.project_camera(body.T_camera_board.translation[None])[0][0] if seen else None
        fix = NeedleFix(
            np.zeros(3), np.zeros((3, 3)), time, status, (centre, None), 0.0,
            missing=() if body.ids else ("webcam",), reason=reason,
        )  # fmt: skip
        return PenObservation(fix, sightings, body, base, model, None, np.zeros(3), 0.0)


def _status(
    sightings: Sightings, body: BoardPose, base: BoardPose, name: str, own: set[int]
) -> tuple[FixStatus, str]:
    """Whether there is a needle, and if not, why, the most telling reason first."""
    if sightings.mirrored:
        return FixStatus.INCONSISTENT, (
            "the picture is mirrored: switch mirroring off in the webcam's own settings"
        )
    twice = sorted(own & set(sightings.doubles))
    if twice:
        return FixStatus.INCONSISTENT, (
            f"marker {twice[0]} is in view twice: two pens, or a mirror; take one away"
        )
    if body.status is PoseStatus.UNSEEN:
        covered = sorted(own & set(sightings.unmeasured))
        why = "; it is cut off, covered or too small" if covered else ""
        return FixStatus.OUT_OF_VIEW, f"the {name} is out of view{why}"
    if body.status is not PoseStatus.FOUND:
        return FixStatus.INCONSISTENT, body.reason
    if base.status is PoseStatus.UNSEEN:
        return FixStatus.NO_ORIENTATION, (
            "the sheet is out of view, so the webcam's place is not known; show both"
        )
    if base.status is not PoseStatus.FOUND:
        return FixStatus.NO_ORIENTATION, base.reason
    return FixStatus.VALID, ""


def camera_in_world(observation: PenObservation, T_world_base: RigidTransform) -> RigidTransform:
    """T_world_camera by the sheet; only where the sheet's pose was found."""
    return T_world_base @ observation.base.T_camera_board.inverse()
