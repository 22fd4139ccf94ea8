"""Who does the parts: this process, processes of this computer, or the workers of a scheduler."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, Self

from app.cohort.errors import CohortError
from app.cohort.running import Crew, Do, Made
from app.core.messages import sentence
from app.core.progress import Progress


class Here:
    """Work in this process, one part after the other; needs no other program."""

    workers = 1

    def __enter__(self) -> Self:
        """Begin."""
        return self

    def __exit__(self, *_: object) -> None:
        """End."""

    def results(
        self, todo: Sequence[tuple[Do, dict[str, Any]]], progress: Progress
    ) -> Iterator[tuple[int, Made]]:
        """Do the parts in their order."""
        for place, (do, given) in enumerate(todo):
            progress.check()
            yield place, do(given)


def crew_of(scheduler: str = "", local: int = 1) -> Crew:
    """Return who works.

    Args:
        scheduler: address of a Dask scheduler; empty for this computer.
        local: processes of this computer; one is this process, without Dask.

    Raises:
        CohortError: if the address cannot be used, or Dask is not installed; says what to do.
    """
    if not scheduler and local == 1:
        return Here()
    if local < 1:
        raise CohortError(sentence("--local {processes}: at least 1", processes=local))
    from app.cohort.dask_crew import LocalCrew, RemoteCrew, check_address, distributed

    distributed()
    if scheduler:
        check_address(scheduler)
        return RemoteCrew(scheduler)
    return LocalCrew(local)
