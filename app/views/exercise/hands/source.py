"""What every source of the simulated hand is to the pad."""

from collections.abc import Callable
from typing import ClassVar

from PySide6.QtCore import QObject, Signal

from app.session.pad.hand import PadHand
from app.views.exercise.pad_canvas import PadCanvas

HandChange = Callable[[PadHand], None]
"""One movement: what it does to the hand."""

STEP_MS = 20
"""Sources that move while something is held do it this often."""


class HandSource(QObject):
    """Moves the simulated hand between `open` and `close`; one source is open at a time.

    Attributes:
        name: as it is recorded with every attempt.
        gain: hand movement per movement of the source, as the user chose it.

    Signals:
        moved(HandChange): the user moved the hand.
        homed(): the hand shall go to where the needle is.
        noted(str): what the user should know about the source now; empty for nothing.
    """

    name: ClassVar[str] = ""

    moved = Signal(object)
    homed = Signal()
    noted = Signal(str)

    def __init__(self, pad: PadCanvas) -> None:
        super().__init__(pad)
        self.pad = pad
        self.gain = 0.5

    def open(self) -> None:
        """Begin to listen.

        Raises:
            AcusError: if this computer lacks what the source needs; says what to install.
        """
        raise NotImplementedError

    def close(self) -> None:
        """Stop listening; idempotent. The hand stays where it is."""
        raise NotImplementedError
