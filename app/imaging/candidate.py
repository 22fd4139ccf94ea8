"""A series on its way into the library: read for looking at, then taken in or given up."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.imaging.series import Series

if TYPE_CHECKING:
    from app.imaging.library import Imported
    from app.imaging.pacs.taking import Fetched
    from app.imaging.privacy.burned_in import MaskBox
    from app.imaging.privacy.pictures import Pictures


@dataclass(frozen=True, slots=True, eq=False)
class Candidate:
    """What is to be taken in.

    Attributes:
        series: a usable one, or one that opens on request.
        take: `take(boxes, progress)` brings it into the library.
        give_up: deletes what was set aside for it, if anything was.
        keeper: holds its files (an unpacked archive) as long as the candidate lives.
        pictures: once they were read.
    """

    series: Series
    take: Callable[[Sequence[MaskBox], Progress], Imported]
    give_up: Callable[[], object]
    keeper: object = None
    pictures: Pictures | None = None


def of_folder(series: Series, keeper: object) -> Candidate:
    """Candidate of a series that was found on this computer."""

    def take(boxes: Sequence[MaskBox], progress: Progress) -> Any:
        with ONE_AT_A_TIME:
            from app.imaging.library import CtLibrary
        return CtLibrary().import_series(series, boxes, progress, series.remedy)

    return Candidate(series, take, lambda: None, keeper)


def of_pacs(fetched: Fetched) -> Candidate:
    """Candidate of a series that was retrieved."""

    def take(boxes: Sequence[MaskBox], progress: Progress) -> Any:
        with ONE_AT_A_TIME:
            from app.imaging.library import CtLibrary
            from app.imaging.pacs.taking import keep
        return keep(fetched, CtLibrary(), progress, boxes, fetched.series.remedy)

    return Candidate(fetched.series, take, fetched.forget)
