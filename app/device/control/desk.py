"""Where checkpoints of a loop are asked for: a buffer and two counters, no lock in the loop."""

import threading
import time
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.device.checkpoint import Checkpoint
from app.device.control import kernel
from app.device.control.kernel import ANSWERED, ASKED
from app.device.control.table import Table
from app.device.errors import LoopError

_PATIENCE: Final = 1.0
_LOOK: Final = 0.0005


class CheckpointDesk:
    """Asks the kernel for checkpoints of one table.

    Args:
        counters: of the loop's history.
        table: its stages.

    Attributes:
        buffer: what the kernel writes: the state, then every stage's array, shape (n,).
    """

    def __init__(self, counters: Any, table: Table) -> None:
        self.buffer: FloatArray = np.zeros(sv.SLOTS + sum(len(s.parameters) for s in table))
        self._counters = counters
        self._table = table
        self._lock = threading.Lock()

    def checkpoint(self, idle: tuple[Any, Any] | None) -> Checkpoint:
        """Return a checkpoint, taken by the kernel between two ticks.

        Args:
            idle: state and packed parameters of a loop that nobody runs at the moment; None of one
                that a thread runs, which answers after its present tick.

        Raises:
            LoopError: if the loop does not answer within a second.
        """
        with self._lock:
            self._counters[ASKED] += 1
            if idle is not None:
                kernel.answer_now(*idle, self._counters, self.buffer)
            self._await_answer()
            return Checkpoint.of(self.buffer, self._table)

    def _await_answer(self) -> None:
        end = time.monotonic() + _PATIENCE
        while self._counters[ANSWERED] != self._counters[ASKED]:
            if time.monotonic() > end:
                raise LoopError(
                    f"the loop has not answered within {_PATIENCE:g} s: it does not tick"
                )
            time.sleep(_LOOK)
