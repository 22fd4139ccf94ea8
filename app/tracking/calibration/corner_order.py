"""Which corner of the right picture is which of the left: found by what all pairs agree on.

The cameras stand still, so T_right_left is the same for every pair. A finder may number a
checkerboard from either end, and a board with two odd or two even counts looks alike both ways;
a wrong numbering in one picture gives that pair another T_right_left, and 30 px instead of a few
tenths. Every pair proposes one T_right_left for each way round; the one that the other pairs agree
with best, each in its better way round, is right. If another one, with other ways round, does
nearly as well, the board was hardly moved and the pairs cannot tell: that is refused.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.tracking.calibration.boards import Board, BoardKind
from app.tracking.calibration.poses import rigid_fit
from app.tracking.calibration.sightings import project
from app.tracking.calibration.views import BoardView
from app.tracking.errors import CalibrationError

AGREE_SHARE = 0.01
"""Share of the picture's width within which a pair agrees with another one's cameras."""

CLEARLY = 2.0
"""How many times worse the second best answer must be."""


@dataclass(frozen=True, eq=False)
class PosedPair:
    """A pair of views with the board's pose in both cameras, each by itself."""

    left: BoardView
    right: BoardView
    T_left_board: RigidTransform
    T_right_board: RigidTransform


@dataclass(frozen=True, eq=False)
class CornerAgreement:
    """What the pairs agree on.

    Attributes:
        T_right_left: the best proposal.
        ways: which way round the right picture of each pair is numbered; 0 as it came.
        errors: of each pair in the right picture [px].
        near: error up to which a pair agrees [px].
    """

    T_right_left: RigidTransform
    ways: tuple[int, ...]
    errors: FloatArray
    near: float

    @property
    def agreeing(self) -> NDArray[np.bool_]:
        """Return which pairs agree."""
        return self.errors <= self.near


def turns(board: Board) -> tuple[NDArray[np.int64], ...]:
    """Orders in which a finder may number a board: half turns, quarter turns of square ones."""
    ids = np.arange(board.count).reshape(board.rows, board.columns)
    if board.kind is BoardKind.CHARUCO:
        return (ids.ravel(),)
    steps = (0, 2, 1, 3) if board.columns == board.rows else (0, 2)
    return tuple(np.rot90(ids, step).ravel() for step in steps)


def agree(pairs: Sequence[PosedPair], right_camera: FloatArray) -> CornerAgreement:
    """Find the cameras' relative pose and the corner orders that the pairs agree on.

    Raises:
        CalibrationError: if another answer is nearly as good.
    """
    near = max(2.0, AGREE_SHARE * pairs[0].right.image_size[0])
    proposals = [T for pair in pairs for T in _proposals(pair)]
    tables = np.array([[_errors(T, pair, right_camera) for pair in pairs] for T in proposals])
    best_ways, best = tables.argmin(axis=2), tables.min(axis=2)
    scores = np.minimum(best, 3.0 * near).mean(axis=1)
    # Of equally good proposals the one that changes the fewest orders comes first.
    order = np.lexsort([(best_ways > 0).sum(axis=1), scores.round(1)])
    first = int(order[0])
    found = CornerAgreement(proposals[first], tuple(best_ways[first].tolist()), best[first], near)
    if pairs[0].left.board.ambiguous:
        _require_clear(found, best_ways, scores, first)
    return found


def _require_clear(
    result: CornerAgreement, ways: NDArray[np.int64], scores: FloatArray, first: int
) -> None:
    """Refuse if another answer, with other ways round, is nearly as good."""
    other = (ways != ways[first])[:, result.agreeing].any(axis=1)
    second = float(scores[other].min(initial=np.inf))
    if result.agreeing.sum() >= 1 and second < CLEARLY * float(scores[first]) + 0.5:
        raise CalibrationError(
            sentence(
                "the board looks the same after half a turn (both corner counts odd, or both "
                "even), and the pairs do not tell which way round it lies ({scores:.1f} px one "
                "way, {second:.1f} px the other): take pictures of it in more places and tilts, "
                "or use a ChArUco board or one with an odd and an even count",
                scores=scores[first],
                second=second,
            )
        )


def _proposals(pair: PosedPair) -> list[RigidTransform]:
    points = pair.left.board.points
    back = pair.T_left_board.inverse()
    return [
        pair.T_right_board @ rigid_fit(points[order], points) @ back
        for order in turns(pair.left.board)
    ]


def _errors(T_right_left: RigidTransform, pair: PosedPair, camera: FloatArray) -> list[float]:
    """Root mean square error in the right picture for each way round [px]."""
    board = pair.left.board
    p_right = T_right_left @ (pair.T_left_board @ board.points)
    if p_right[:, 2].min() <= 1e-6:
        return [np.inf] * len(turns(board))
    uv = project(p_right, camera)
    view = pair.right
    return [
        float(np.sqrt(((uv[order[view.ids]] - view.pixels) ** 2).sum(axis=1).mean()))
        for order in turns(board)
    ]
