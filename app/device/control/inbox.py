"""How other threads speak to the loop: named inputs, written as one change."""

import threading

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.device.control import kernel
from app.device.errors import UnknownInputError

INPUT_NAMES: tuple[str, ...] = tuple(name for name, k in sv.INDEX.items() if k < sv.INPUTS)
"""Names of the inputs: the lower-case names of the first slots of the state."""


class Inbox:
    """Inputs of a loop. Any thread may write; the loop reads without ever waiting."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self.values: FloatArray = np.zeros(sv.INPUTS)
        self.sequence = np.zeros(1, dtype=np.int64)

    def write(self, **values: float) -> None:
        """Set inputs by name, all seen by the same tick, e.g. `write(assistance=0.5, enabled=1)`.

        Raises:
            UnknownInputError: if a name is not an input; names those that are.
        """
        for name in values:
            if name not in INPUT_NAMES:
                raise UnknownInputError(
                    f"the loop has no input {name!r}; valid names: {', '.join(INPUT_NAMES)}"
                )
        slots = np.array([sv.INDEX[name] for name in values], dtype=np.int64)
        numbers = np.array(list(values.values()), dtype=np.float64)
        with self._lock:
            kernel.post(self.values, self.sequence, slots, numbers)

    def read(self) -> dict[str, float]:
        """Return what was written last, by name."""
        with self._lock:
            return {name: float(self.values[sv.INDEX[name]]) for name in INPUT_NAMES}
