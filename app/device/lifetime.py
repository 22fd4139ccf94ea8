"""What is opened and closed, also by `with`."""

from abc import ABC, abstractmethod
from types import TracebackType
from typing import Self


class Lifetime(ABC):
    """Opens and closes; `with` closes it also after an exception."""

    @abstractmethod
    def open(self) -> None:
        """Begin; does nothing if it is open."""

    @abstractmethod
    def close(self) -> None:
        """End; idempotent."""

    def __enter__(self) -> Self:
        """Open it."""
        self.open()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Close it, also after an exception."""
        self.close()
