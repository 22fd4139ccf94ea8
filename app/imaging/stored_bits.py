"""The bits of a stored value that belong to it."""

from typing import Any

import numpy as np
from numpy.typing import NDArray


def keep_bits(out: NDArray[Any], stored: int, high: int) -> None:
    """Keep the stored bits only; the others are not part of the value (PS3.5 8.1.1).

    Args:
        out: changed in place; a signed type keeps the sign of the highest stored bit.
        stored: number of bits kept.
        high: place of the highest of them.
    """
    allocated = 8 * out.itemsize
    if stored == allocated:
        return
    np.left_shift(out, allocated - 1 - high, out=out)
    np.right_shift(out, allocated - stored, out=out)
