"""What the calibration wizard has so far: board, views, result, world frame."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.progress import Progress
from app.core.transform import RigidTransform
from app.tracking.calibration.boards import DEFAULT_BOARD, Board, parse_board
from app.tracking.calibration.history import CalibrationHistory
from app.tracking.calibration.placed_board import PlacedBoard
from app.tracking.calibration.run import StereoResult, calibrate_pairs
from app.tracking.calibration.views import BoardView, Rejection
from app.tracking.calibration.world import WorldFrame, find_world, with_world
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import StereoCalibration

Views = tuple[BoardView | None, BoardView | None]


def last_board(spec: str) -> Board:
    """Return the board that was chosen last; the default one if none was, or it cannot be read."""
    try:
        return parse_board(spec or DEFAULT_BOARD)
    except CalibrationError:
        return parse_board(DEFAULT_BOARD)


@dataclass
class CalibrationJob:
    """One pass through the wizard.

    Attributes:
        names: of the cameras in the rig, left and right.
        history: where the result is kept.
        watched: points that both cameras are meant to see [m, world], (n, 3), or None.
        expected: rough T_world_left by the rig's design, or None.
        board: chosen board.
        views: what both cameras saw, in order.
        refused: pictures of no use.
        result: of the last calibration of these views.
        places: boards at known places, for the world frame.
        world: found from them.
        saved: what was kept of this pass.
    """

    names: tuple[str, str] = ("left", "right")
    history: CalibrationHistory = field(default_factory=CalibrationHistory)
    watched: FloatArray | None = None
    expected: RigidTransform | None = None
    board: Board = field(default_factory=lambda: parse_board(DEFAULT_BOARD))
    views: tuple[Views, ...] = ()
    refused: tuple[Rejection, ...] = ()
    result: StereoResult | None = None
    places: tuple[PlacedBoard, ...] = ()
    world: WorldFrame | None = None
    saved: StereoCalibration | None = None
    _active: StereoCalibration | None = field(default=None, repr=False)

    @property
    def pairs(self) -> int:
        """Number of views that both cameras have."""
        return sum(None not in views for views in self.views)

    @property
    def unsaved(self) -> bool:
        """Return whether there is work that closing would lose: views or a result, and nothing
        kept.
        """
        work = self.views or self.result is not None or self.world is not None
        return bool(work) and self.saved is None

    def set_board(self, board: Board) -> None:
        """Take another board: views of the old one count no more."""
        if board != self.board:
            self.board = board
            self.set_views((), ())

    def set_views(self, views: tuple[Views, ...], refused: tuple[Rejection, ...]) -> None:
        """Take views; a result of others counts no more."""
        self.views, self.refused, self.result = views, refused, None
        self.places, self.world, self.saved = (), None, None

    def calibrate(self, progress: Progress) -> StereoResult:
        """Compute, beside the window; `set_result` takes it.

        Raises:
            CalibrationError: if the views do not allow it; says why.
            Cancelled: through `progress`.
        """
        lefts, rights = [left for left, _ in self.views], [right for _, right in self.views]
        return calibrate_pairs(lefts, rights, self.names, progress=progress)

    def set_result(self, result: StereoResult) -> None:
        """Take a result."""
        self.result, self.world, self.saved = result, None, None

    def base(self) -> StereoCalibration:
        """Return the calibration that a world frame is found for: this one, or that in use.

        Raises:
            CalibrationError: if there is neither.
        """
        if self.result is not None:
            return self.result.calibration
        name = self.base_id()
        if self._active is None or self._active.id != name:
            self._active = self.history.load(name)
        return self._active

    def base_id(self) -> str:
        """Return the id of `base`; reads one small file.

        Raises:
            CalibrationError: if there is none.
        """
        if self.result is not None:
            return self.result.calibration.id
        active = next((entry.id for entry in self.history.entries() if entry.active), None)
        if active is None:
            raise CalibrationError(
                sentence("calibrate the cameras first: no calibration is in use")
            )
        return active

    def find_world(self, places: tuple[PlacedBoard, ...]) -> WorldFrame:
        """Find the world frame, beside the window; `set_world` takes it.

        Raises:
            CalibrationError: see `tracking.calibration.world.find_world`.
        """
        return find_world(self.base(), places, watched=self.watched, expected=self.expected)

    def set_world(self, places: tuple[PlacedBoard, ...], world: WorldFrame | None) -> None:
        """Take a world frame and the places behind it."""
        self.places, self.world, self.saved = places, world, None

    def outcome(self) -> StereoCalibration | None:
        """Return what would be kept: the result, with its world frame if there is one."""
        if self.world is not None:
            return with_world(self.base(), self.world, self.board.spec)
        return self.result.calibration if self.result is not None else None

    def save(self) -> Path | None:
        """Keep the outcome in the history and use it; None if there is nothing new.

        Raises:
            CalibrationError: if it cannot be written.
        """
        outcome = self.outcome()
        if outcome is None or self.saved is not None:
            return None
        path = self.history.keep(outcome)
        self.saved = outcome
        return path
