"""One picture in, one needle out: detection, both poses, the needle, or why there is none.

While both are followed, markers are searched for in a region round the cube only, its pose
is refined from the last one, and the sheet's pose is kept as long as the webcam stands still. At
least every `FULL_EVERY` pictures, and whenever any of this fails, the whole picture is searched: so
a second cube, a moved sheet or a wrong one of two poses is seen within a third of a second.

That the webcam stands still is told from a few patches of the picture, in a fraction of the time
that measuring its sheet takes. Round corners of the sheet's markers the picture is kept. Where it
moved by d, a patch changes by d · gradient; the median over the patches of the d that fits best,
brightness left free, says how far the picture has moved. A hand before some of them does not
matter.
"""

from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray, frozen
from app.core.messages import sentence
from app.tracking.cameras.camera import CameraFrame
from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.optics.camera_model import CameraModel
from app.tracking.pen.board import MarkerBoard, all_ids
from app.tracking.pen.body import PenProfile
from app.tracking.pen.detector import MarkerDetector, MarkerSighting, Region, Sightings, grey_of
from app.tracking.pen.edges import Grey
from app.tracking.pen.locator import DECISIVE, BoardLocator
from app.tracking.pen.needle import PenNeedle, PenTip, solve_needle
from app.tracking.pen.pose import BoardPose, PoseStatus
from app.tracking.pen.problem import angle_between
from app.tracking.pen.webcam import Webcam, guessed_webcam

STILL_PX = 0.05
"""Movement of the picture [px] below which the webcam stands still."""

_HALF = 4
"""A patch reaches so many pixels to either side."""

_FEWEST = 4
_LEAST_SLOPE = 1e3
"""Sum of squared gradients of a patch that tells both directions [grey²/px²]."""


class Stillness:
    """Patches of one picture, against which others are held.

    Args:
        grey: picture, shape (height, width).
        corners: of black squares [px], shape (n, 2).
    """

    def __init__(self, grey: Grey, corners: FloatArray) -> None:
        height, width = grey.shape
        middle = np.rint(corners).astype(int).reshape(-1, 2)
        reach = _HALF + 1
        limit = np.array([width, height]) - reach
        middle = middle[((middle >= reach) & (middle < limit)).all(axis=1)]
        steps = np.arange(-reach, reach + 1)
        wide = _taken(grey, middle, steps)
        along = 0.5 * (wide[:, 1:-1, 2:] - wide[:, 1:-1, :-2])
        down = 0.5 * (wide[:, 2:, 1:-1] - wide[:, :-2, 1:-1])
        slopes = np.stack([along, down], axis=-1).reshape(len(middle), (2 * _HALF + 1) ** 2, 2)
        slopes -= slopes.mean(axis=1, keepdims=True)  # a change of brightness is no movement
        normal = slopes.transpose(0, 2, 1) @ slopes
        told = np.linalg.eigvalsh(normal)[:, 0] > _LEAST_SLOPE
        self._middle, self._kept = middle[told], wide[told, 1:-1, 1:-1]
        self._solve = np.linalg.inv(normal[told]) @ slopes[told].transpose(0, 2, 1)

    def moved(self, grey: Grey) -> float:
        """Return how far a picture has moved since [px]; infinite if there are too few patches to
        tell.
        """
        if len(self._middle) < _FEWEST:
            return float("inf")
        change = _taken(grey, self._middle, np.arange(-_HALF, _HALF + 1)) - self._kept
        shifts = (self._solve @ change.reshape(len(change), -1, 1))[..., 0]
        return float(np.linalg.norm(np.median(shifts, axis=0)))


def _taken(grey: Grey, middle: np.ndarray, steps: np.ndarray) -> FloatArray:
    """Square patches of a picture, shape (n, steps, steps)."""
    rows = middle[:, 1, None, None] + steps[:, None]
    columns = middle[:, 0, None, None] + steps
    return grey[rows, columns].astype(np.float64)


FULL_EVERY = 10
"""Pictures of which at least one is searched as a whole."""

_OLD = 0.5
"""Time [s] between two pictures from which the first says nothing about the second."""

_CERTAIN = 8.0 * DECISIVE
"""Lead of the better of two poses with which the other one need not be looked for each time."""

_TURN = 0.35
"""Turn [rad] since both poses were compared, from which they are compared again."""

_MARGIN = 0.6
"""Rim of the region, in lengths of the cube's picture."""


class BoardFollower:
    """Pose of one board from picture to picture; not for two threads at once.

    Args:
        locator: of the board.
    """

    def __init__(self, locator: BoardLocator) -> None:
        self.board = locator.board
        self._locator = locator
        self._last: BoardPose | None = None
        self._compared: BoardPose | None = None

    def forget(self) -> None:
        """Begin anew."""
        self._last = self._compared = None

    def locate(self, model: CameraModel, markers: tuple[MarkerSighting, ...]) -> BoardPose:
        """Pose in the next picture; as `BoardLocator.locate` finds it."""
        found = self._near(model, markers)
        if found is None:
            found = self._locator.locate(model, markers)
            certain = found.status is PoseStatus.FOUND and found.lead > _CERTAIN
            self._compared = found if certain else None
        self._last = found
        return found

    def _near(self, model: CameraModel, markers: tuple[MarkerSighting, ...]) -> BoardPose | None:
        if self._last is None or self._compared is None:
            return None
        found = self._locator.follow(model, markers, self._last)
        if found is None:
            return None
        turn = angle_between(found.T_camera_board, self._compared.T_camera_board)
        return found if turn < _TURN else None


class Memory:
    """What is kept of the last pictures."""

    def __init__(self) -> None:
        self._time = -np.inf
        self._since_full = 0
        self._region: Region | None = None
        self._still: Stillness | None = None
        self._sheet: tuple[MarkerSighting, ...] = ()
        self.base: BoardPose | None = None

    def region(self, time: float, grey: Grey) -> Region | None:
        """Return where to look for the cube; None if the whole picture has to be searched."""
        known = 0.0 < time - self._time < _OLD
        self._time = time
        if not known:
            self._region = None
        if self._region is None or self._still is None:
            return None
        if self._since_full + 1 >= FULL_EVERY or self._still.moved(grey) > STILL_PX:
            return None
        return self._region

    @property
    def fresh(self) -> bool:
        """Return whether nothing is known."""
        return self._region is None

    def with_sheet(self, result: Sightings) -> Sightings:
        """Sightings of the cube, and those of the sheet as they were."""
        return Sightings(result.markers + self._sheet, result.doubles, result.unmeasured)

    def keep(
        self, grey: Grey, model: CameraModel, board: MarkerBoard, body: BoardPose, full: bool
    ) -> None:
        """Take what a picture said of the cube; `full`: the whole picture was searched."""
        self._since_full = 0 if full else self._since_full + 1
        self._region = _region_of(grey, model, board, body)

    def keep_sheet(self, grey: Grey, result: Sightings, own: set[int], base: BoardPose) -> None:
        """Take what a whole picture said of the sheet."""
        self._sheet = tuple(marker for marker in result.markers if marker.id not in own)
        self.base, self._still = base, None
        if base.status is PoseStatus.FOUND:
            corners = np.concatenate([marker.corners for marker in self._sheet])
            self._still = Stillness(grey, corners)


def _region_of(
    grey: Grey, model: CameraModel, board: MarkerBoard, body: BoardPose
) -> Region | None:
    """Rows and columns that all of the cube's faces take, with a rim for its motion."""
    if body.either:
        body = body.either[0]
    if body.status is not PoseStatus.FOUND:
        return None
    corners: FloatArray = np.concatenate([marker.corners for marker in board.markers])
    uv, ok = model.project_camera(body.T_camera_board @ corners)
    if not ok.all():
        return None
    low, high = uv.min(axis=0), uv.max(axis=0)
    rim = _MARGIN * float((high - low).max())
    limit = np.array(grey.shape[::-1])
    first = np.clip(np.floor(low - rim), 0, limit).astype(int)
    last = np.clip(np.ceil(high + rim), 0, limit).astype(int)
    if (last - first < 16).any():
        return None
    return slice(int(first[1]), int(last[1])), slice(int(first[0]), int(last[0]))


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

    def observe(self, frame: CameraFrame) -> PenObservation:
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
            needle.p_tip,
            needle.tip_covariance,
            frame.time,
            FixStatus.VALID,
            (centre[0], None),
            float(np.hypot(body.residual_px, base.residual_px)),
            depth,
            variance,
            has_point=True,
        )
        return PenObservation(fix, sightings, body, base, model, needle, beside, beside_sd)

    def _poses(
        self, frame: CameraFrame, model: CameraModel
    ) -> tuple[Sightings, BoardPose, BoardPose]:
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
            np.zeros(3),
            np.zeros((3, 3)),
            time,
            status,
            (centre, None),
            0.0,
            missing=() if body.ids else ("webcam",),
            reason=reason,
        )
        return PenObservation(fix, sightings, body, base, model, None, np.zeros(3), 0.0)


def _status(
    sightings: Sightings, body: BoardPose, base: BoardPose, name: str, own: set[int]
) -> tuple[FixStatus, str]:
    """Return whether there is a needle, and if not, why, the most telling reason first."""
    if sightings.mirrored:
        return FixStatus.INCONSISTENT, sentence(
            "the picture is mirrored: switch mirroring off in the webcam's own settings"
        )
    twice = sorted(own & set(sightings.doubles))
    if twice:
        return FixStatus.INCONSISTENT, sentence(
            "marker {marker_number} is in view twice: two pens, or a mirror; take one away",
            marker_number=twice[0],
        )
    if body.status is PoseStatus.UNSEEN:
        covered = sorted(own & set(sightings.unmeasured))
        why = sentence("; it is cut off, covered or too small") if covered else ""
        return FixStatus.OUT_OF_VIEW, sentence(
            "the {name} is out of view{reason}", name=name, reason=why
        )
    if body.status is not PoseStatus.FOUND:
        return FixStatus.INCONSISTENT, body.reason
    if base.status is PoseStatus.UNSEEN:
        return FixStatus.NO_ORIENTATION, sentence(
            "the sheet is out of view, so the webcam's place is not known; show both"
        )
    if base.status is not PoseStatus.FOUND:
        return FixStatus.NO_ORIENTATION, base.reason
    return FixStatus.VALID, ""
