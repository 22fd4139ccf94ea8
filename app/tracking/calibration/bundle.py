"""Bundle adjustment of one or two cameras and the boards they saw: least squares on the pixels.

Unknown are the free ones of each camera's parameters (nine of the usual lens), the pose of the
second camera (T_right_left) and one pose per board (T_left_board). Poses change by twists
(translation, rotation vector) on the left: T = exp(twist) @ T_estimated. Gauss-Newton damped by
Levenberg and Marquardt; the boards' poses are eliminated first (Schur complement), so that the
system that is solved is no larger than 9, or 24 for two such cameras. Its inverse, times the
residual's variance, is the covariance: that of the estimate with the boards' poses unknown as well.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.progress import Progress
from app.core.transform import RigidTransform, exponentials
from app.tracking.calibration.sightings import AdjustedState, SeenBoard, SightedBoards
from app.tracking.errors import CalibrationError
from app.tracking.optics.lens import LensModel

_ROUNDS = 60
_GAIN = 1e-10
"""Relative fall of the cost below which the adjustment has ended."""

_LITTLE = 1.1e-7
"""Damping that no longer hides the way to parameters that make up for each other."""

Flags = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Adjusted:
    """Result of an adjustment.

    Attributes:
        state: the estimate.
        covariance: of the cameras' parameters in a row and, for two, the twist of T_right_left,
            shape (m, m) or (2 m + 6, 2 m + 6); zero rows for what was fixed.
        residuals: measured minus predicted pixels of each sighting, (n, 2) each.
        sigma_px: standard deviation of one pixel coordinate, from the residuals.
        condition: smallest eigenvalue of the eliminated system, scaled to a unit diagonal; near 0
            the views do not determine what was asked.
        promised: fall of the sum of squared residuals that one more step promises, to first order;
            about 0 at the end, and after 0 rounds what freeing more than before is worth (Rao's
            score test).
    """

    state: AdjustedState
    covariance: FloatArray
    residuals: tuple[FloatArray, ...]
    sigma_px: float
    condition: float
    promised: float

    @property
    def rms_px(self) -> float:
        """Root mean square of the distance between measured and predicted pixels, 2D."""
        return rms(np.concatenate(self.residuals))

    def sd(self, camera: int = 0) -> FloatArray:
        """Return the standard deviations of a camera's parameters, shape (m,)."""
        count = self.state.parameters.shape[1]
        block = slice(camera * count, (camera + 1) * count)
        result: FloatArray = np.sqrt(np.maximum(np.diag(self.covariance)[block], 0.0))
        return result


def rms(residuals: FloatArray) -> float:
    """Root mean square length of vectors (n, 2), as OpenCV reports it."""
    return float(np.sqrt((residuals**2).sum() / max(1, len(residuals))))


def adjust(
    sightings: Sequence[SeenBoard],
    start: AdjustedState,
    free: Flags,
    progress: Progress | None = None,
    rounds: int = _ROUNDS,
    pose_free: bool = True,
) -> Adjusted:
    """Adjust cameras and boards to what was seen.

    Args:
        sightings: at least one for every pose.
        start: first estimate.
        free: which parameters are estimated, shape (cameras, m).
        progress: asked every round; may cancel.
        rounds: at most so many steps.
        pose_free: whether T_right_left is estimated, too.

    Raises:
        CalibrationError: if there are fewer measurements than unknowns, or no finite estimate.
    """
    problem = _Problem(tuple(sightings), free, len(start.poses), pose_free)
    progress = progress or Progress()
    state, damping = _State.of(start), 1e-4
    system = problem.system(state)
    if system is None:
        raise CalibrationError(sentence("the first estimate puts a board behind a camera"))
    refused = not free.any()  # a board's pose alone has no such ways
    for _ in range(rounds):
        progress.report(0.0, sentence("adjusting"))
        moved = problem.moved(state, system, damping)
        trial = problem.system(moved) if moved is not None else None
        rise = trial.cost - system.cost if trial is not None else np.inf
        flat = abs(rise) <= _GAIN * system.cost
        if flat and (refused or damping <= _LITTLE):
            break
        if moved is not None and trial is not None and rise <= 0.0:
            state, system = moved, trial
        if flat or rise <= 0.0:
            damping = max(damping * 0.1, 1e-12)
        elif damping > 1e8:
            break
        else:
            refused, damping = True, damping * 10.0
    return problem.result(state, system)


@dataclass(frozen=True, eq=False)
class _System:
    """Normal equations at one state: global block, per board block and coupling."""

    cost: float
    gg: FloatArray
    g: FloatArray
    bb: FloatArray
    b: FloatArray
    gb: FloatArray
    residuals: tuple[FloatArray, ...]


@dataclass(frozen=True, eq=False)
class _State:
    """An `AdjustedState` on the way, its poses in a row: (poses, 3, 3) and (poses, 3)."""

    parameters: FloatArray
    T_right_left: RigidTransform
    rotations: FloatArray
    translations: FloatArray

    @classmethod
    def of(cls, state: AdjustedState) -> Self:
        """Put poses in a row."""
        rotations = np.array([T.rotation for T in state.poses]).reshape(-1, 3, 3)
        translations = np.array([T.translation for T in state.poses]).reshape(-1, 3)
        return cls(state.parameters, state.T_right_left, rotations, translations)

    def adjusted(self) -> AdjustedState:
        """Return the poses one by one again."""
        each = zip(self.rotations, self.translations, strict=True)
        return AdjustedState(
            self.parameters, self.T_right_left, tuple(RigidTransform(R, t) for R, t in each)
        )


class _Problem:
    def __init__(
        self,
        sightings: tuple[SeenBoard, ...],
        free: Flags,
        poses: int,
        relative: bool,
    ) -> None:
        self.count, self.poses = len(sightings), poses
        cameras = len(free)
        pose_free = np.full(6 if cameras == 2 else 0, relative)
        self.free = np.concatenate([free.ravel(), pose_free])
        self.columns = [np.flatnonzero(row) for row in free]  # of each camera's own parameters
        self.relative = cameras == 2 and relative
        seen = [SightedBoards(sightings, i) for i in {s.camera for s in sightings}]
        self.seen = seen
        self.cameras = cameras
        self.measured = 2 * sum(len(s.points) for s in sightings)
        unknown = int(self.free.sum()) + 6 * poses
        if self.measured <= unknown:
            raise CalibrationError(
                sentence(
                    "{measured} pixel coordinates cannot determine {unknown} unknowns; add views",
                    measured=self.measured,
                    unknown=unknown,
                )
            )
        self.dof = self.measured - unknown

    def system(self, state: _State) -> _System | None:
        """Linearise; None where a point lies behind its camera or a value is not finite."""
        size = int(self.free.sum())
        gg, g = np.zeros((size, size)), np.zeros(size)
        bb, b = np.zeros((self.poses, 6, 6)), np.zeros((self.poses, 6))
        gb = np.zeros((self.poses, size, 6))
        residuals = [np.empty((0, 2))] * self.count
        for seen in self.seen:
            linear = seen.linearised(
                state.parameters[seen.camera],
                state.rotations,
                state.translations,
                state.T_right_left,
            )
            if linear is None:
                return None
            r, by_parameter, by_board, by_right = linear
            parts = [by_parameter[:, :, self.columns[seen.camera]]]
            start = 0 if seen.camera == 0 else self.columns[0].size
            places = np.arange(start, start + self.columns[seen.camera].size)
            if by_right is not None and self.relative:
                parts.append(by_right)
                places = np.concatenate([places, np.arange(size - 6, size)])
            k = places.size
            rows = np.concatenate([*parts, r[:, :, None], by_board], axis=2)
            total = np.zeros((k, k + 1))
            for number, pose, (first, last) in zip(
                seen.numbers, seen.poses, seen.spans, strict=True
            ):
                own = rows[first:last].reshape(-1, k + 7)
                products = own.T @ own
                total += products[:k, : k + 1]
                bb[pose] += products[k + 1 :, k + 1 :]
                b[pose] += products[k, k + 1 :]
                gb[pose, places] += products[:k, k + 1 :]
                residuals[number] = r[first:last]
            gg[np.ix_(places, places)] += total[:, :k]
            g[places] += total[:, k]
        cost = float(sum((r**2).sum() for r in residuals))
        return _System(cost, gg, g, bb, b, gb, tuple(residuals))

    def moved(self, state: _State, system: _System, damping: float) -> _State | None:
        """Take one damped step, or None if the system cannot be solved."""
        bb = system.bb.copy()
        diagonal = np.einsum("kii->ki", bb)
        diagonal *= 1.0 + damping
        gg = system.gg + damping * np.diag(np.diag(system.gg))
        try:
            weights = np.linalg.solve(bb, np.swapaxes(system.gb, 1, 2))  # (poses, 6, free)
            reduced = gg - np.einsum("kgi,kih->gh", system.gb, weights)
            right = system.g - np.einsum("kig,ki->g", weights, system.b)
            step = np.linalg.solve(reduced, right) if right.size else right
            boards = np.linalg.solve(
                bb, (system.b - np.einsum("kgi,g->ki", system.gb, step))[..., None]
            )
        except np.linalg.LinAlgError:
            return None
        if not (np.isfinite(step).all() and np.isfinite(boards).all()):
            return None
        return self._stepped(state, step, boards[..., 0])

    def _stepped(self, state: _State, step: FloatArray, boards: FloatArray) -> _State | None:
        count = state.parameters.size
        full = np.zeros(self.free.size)
        full[self.free] = step
        turns = (np.abs(boards[:, 3:]).max(initial=0.0), np.abs(full[count:]).max(initial=0.0))
        if max(turns) > 3.0:
            return None  # beyond half a turn a twist means something else
        parameters = state.parameters + full[:count].reshape(state.parameters.shape)
        if parameters[:, :2].min() <= 0.0:
            return None
        pose = state.T_right_left
        if self.cameras == 2:
            pose = RigidTransform.exp(full[count:]) @ pose
        turn, shift = exponentials(boards)
        return _State(
            parameters,
            pose,
            turn @ state.rotations,
            np.einsum("kij,kj->ki", turn, state.translations) + shift,
        )

    def result(self, state: _State, system: _System) -> Adjusted:
        try:
            weights = np.linalg.solve(system.bb, np.swapaxes(system.gb, 1, 2))
        except np.linalg.LinAlgError as reason:
            raise CalibrationError(
                sentence(
                    "the views do not determine where a board was; tilt the board to different "
                    "sides by 20 to 45 degrees"
                )
            ) from reason
        reduced = system.gg - np.einsum("kgi,kih->gh", system.gb, weights)
        variance = system.cost / self.dof
        inverse, condition = _inverse(reduced)
        covariance = np.zeros((self.free.size, self.free.size))
        covariance[np.ix_(self.free, self.free)] = variance * inverse
        right = system.g - np.einsum("kig,ki->g", weights, system.b)
        return Adjusted(
            state.adjusted(),
            covariance,
            system.residuals,
            float(np.sqrt(variance)),
            condition,
            float(right @ inverse @ right),
        )


def _inverse(matrix: FloatArray) -> tuple[FloatArray, float]:
    """Inverse of a symmetric matrix, scaled to a unit diagonal first, and its least eigenvalue.

    Directions that the data do not determine at all get the variance of the least that double
    precision can tell from none, so that it shows as a huge standard deviation, never as NaN.
    """
    if not matrix.size:
        return matrix, 1.0
    scale = 1.0 / np.sqrt(np.maximum(np.diag(matrix), 1e-200))  # its square is finite
    values, vectors = np.linalg.eigh(matrix * np.outer(scale, scale))
    safe = np.maximum(values, 1e-14)
    inverse = (vectors / safe) @ vectors.T * np.outer(scale, scale)
    return inverse, float(values.min())


def with_free(names: Sequence[str], cameras: int = 1, lens: LensModel = LensModel.BROWN) -> Flags:
    """Mark the parameters named as free, for every camera alike, shape (cameras, m)."""
    row = np.array([name in names for name in lens.parameters])
    return np.tile(row, (cameras, 1))
