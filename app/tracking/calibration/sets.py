"""Pictures of one or two cameras on disk: read at, then calibrated."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from app.core.messages import sentence
from app.core.progress import Progress
from app.tracking.calibration.boards import Board
from app.tracking.calibration.mono import MonoResult, calibrate_mono
from app.tracking.calibration.pair_fit import matched
from app.tracking.calibration.pairing import Pair
from app.tracking.calibration.pictures import read_views
from app.tracking.calibration.run import StereoResult, calibrate_pairs
from app.tracking.calibration.stereo import LEAST_PAIRS, StereoEstimate
from app.tracking.calibration.validation import ViewPair
from app.tracking.calibration.views import BoardView, Rejection
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import StereoCalibration
from app.tracking.optics.lens import LensModel

Seen = BoardView | Rejection


@dataclass(frozen=True, eq=False)
class MonoSet:
    """One camera's pictures.

    Attributes:
        read: every picture, as it was seen.
        result: the calibration.
    """

    read: tuple[Seen, ...]
    result: MonoResult


@dataclass(frozen=True, eq=False)
class StereoSet:
    """Two cameras' pictures.

    Attributes:
        read: every picture, left and right of the pairs in turn, then those of one camera alone.
        result: the calibration.
    """

    read: tuple[Seen, ...]
    result: StereoResult

    @property
    def calibration(self) -> StereoCalibration:
        """Return what is kept."""
        return self.result.calibration


def mono_set(
    name: str,
    paths: Sequence[Path],
    board: Board,
    hold_back: int | None = None,
    window: int | None = None,
    progress: Progress | None = None,
    lens: LensModel | None = None,
) -> MonoSet:
    """Calibrate one camera from its pictures; see `calibrate_mono`.

    Raises:
        CalibrationError: if too few pictures show the board, with the commonest reasons; see
            `calibrate_mono`.
        Cancelled: through `progress`.
    """
    progress = progress or Progress()
    read = read_views(paths, board, progress.part(0.0, 0.6), window)
    views = [view for view in read if isinstance(view, BoardView)]
    if not views:
        raise CalibrationError(none_seen(read))
    result = calibrate_mono(views, name, hold_back, progress.part(0.6, 1.0), lens)
    return MonoSet(tuple(read), result)


def stereo_set(
    pairs: Sequence[Pair],
    board: Board,
    names: tuple[str, str] = ("left", "right"),
    hold_back: int | None = None,
    window: int | None = None,
    progress: Progress | None = None,
    alone: tuple[Sequence[Path], Sequence[Path]] = ((), ()),
    lens: LensModel | None = None,
) -> StereoSet:
    """Calibrate two cameras from pairs of pictures.

    Args:
        pairs: taken together.
        board: which board.
        names: of the cameras in the rig.
        hold_back: pairs that take no part; see `calibrate_pairs`.
        window: half the sub-pixel window [px]; chosen if None.
        progress: reports, and may cancel.
        alone: pictures of the left and of the right camera by themselves; they help its own lens.
        lens: model of both lenses; by what the views ask for if None.

    Raises:
        CalibrationError: see `mono_set` and `calibrate_pairs`.
        Cancelled: through `progress`.
    """
    progress = progress or Progress()
    paths = [path for pair in pairs for path in (pair.left, pair.right)]
    count = len(paths)
    paths += [path for side in alone for path in side]
    read = read_views(paths, board, progress.part(0.0, 0.6), window)
    found = [view if isinstance(view, BoardView) else None for view in read]
    if not any(found):
        raise CalibrationError(none_seen(read))
    views, lone = found[:count], found[count:]
    both = sum(
        a is not None and b is not None for a, b in zip(views[0::2], views[1::2], strict=True)
    )
    if both < LEAST_PAIRS:
        raise CalibrationError(
            sentence(
                "{both} of {pairs} pairs show the board to both cameras; at least "
                "{least_pairs} are needed, 15 to 30 are good; {common_reasons}",
                both=both,
                pairs=len(pairs),
                least_pairs=LEAST_PAIRS,
                common_reasons=common_reasons(read),
            )
        )
    lefts, rights = lone[: len(alone[0])], lone[len(alone[0]) :]
    result = calibrate_pairs(
        [*views[0::2], *lefts, *(None for _ in rights)],
        [*views[1::2], *(None for _ in lefts), *rights],
        names,
        hold_back,
        progress.part(0.6, 1.0),
        lens=lens,
    )
    return StereoSet(tuple(read), result)


def seen_by_both(pairs: Sequence[Pair], board: Board, estimate: StereoEstimate) -> list[ViewPair]:
    """Find a board in pairs of pictures; match corner orders by cameras that are known.

    Raises:
        CalibrationError: if no pair shows it to both.
    """
    read = read_views([path for pair in pairs for path in (pair.left, pair.right)], board)
    found = [
        matched((left, right), estimate.adjusted)
        for left, right in zip(read[0::2], read[1::2], strict=True)
        if isinstance(left, BoardView) and isinstance(right, BoardView)
    ]
    if not found:
        raise CalibrationError(none_seen(read))
    return found


def none_seen(read: Sequence[Seen]) -> str:
    """Say that no picture shows the board, and the commonest reasons."""
    return sentence(
        "the board is usable in none of {pictures} pictures (or pairs); {common_reasons}",
        pictures=len(read),
        common_reasons=common_reasons(read),
    )


def common_reasons(read: Sequence[Seen]) -> str:
    """Name a picture for each of the commonest reasons, three at most, and the reason."""
    refused = [view for view in read if isinstance(view, Rejection)]
    common = Counter(view.text for view in refused).most_common(3)
    return "; ".join(
        f"{next(view.name for view in refused if view.text == text)}: {text}" for text, _ in common
    )
