"""What can go wrong with a learning record store."""

from app.exchange.errors import ExchangeError


class LrsError(ExchangeError):
    """The store refuses, or its address or answers are no store's; says what to do."""


class UnreachableLrsError(LrsError):
    """The store does not answer, or not now: what waits is sent later.

    Attributes:
        wait: seconds that the store asked for before the next try; 0 where it did not.
    """

    def __init__(self, message: str, wait: float = 0.0) -> None:
        super().__init__(message)
        self.wait = wait
