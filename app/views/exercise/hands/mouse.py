"""Mouse and keyboard on the pad: drag and arrows tilt, wheel and Page keys push and pull."""

from typing import ClassVar

from app.views.exercise.hands.source import HandSource
from app.views.exercise.pad_canvas import PadCanvas


class MouseHand(HandSource):
    """Passes on what the pad reports; the gain acts on drags only, keys have their own steps."""

    name: ClassVar[str] = "mouse"

    def __init__(self, pad: PadCanvas) -> None:
        super().__init__(pad)
        self._open = False

    def open(self) -> None:
        """Listen to the pad."""
        if not self._open:
            self._open = True
            self.pad.dragged.connect(self._drag)
            self.pad.tilted.connect(self._tilt)
            self.pad.advanced.connect(self._advance)
            self.pad.homed.connect(self.homed)

    def close(self) -> None:
        """Stop listening."""
        if self._open:
            self._open = False
            self.pad.dragged.disconnect(self._drag)
            self.pad.tilted.disconnect(self._tilt)
            self.pad.advanced.disconnect(self._advance)
            self.pad.homed.disconnect(self.homed)

    def _drag(self, right: float, up: float) -> None:
        step = (self.gain * right, self.gain * up)
        self.moved.emit(lambda hand: hand.drag(step))

    def _tilt(self, right: float, up: float) -> None:
        self.moved.emit(lambda hand: hand.tilt(right, up))

    def _advance(self, step: float) -> None:
        self.moved.emit(lambda hand: hand.advance(step))
