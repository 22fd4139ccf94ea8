"""A memory fence for compiled code: other threads see writes in the order they were written."""

from typing import Any

from app.core.compiled import njit  # isort: skip  (sets the cache folder before numba is loaded)
from numba import types
from numba.extending import intrinsic


@intrinsic
def _fence(typing_context: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        builder.fence("seq_cst")
        return context.get_dummy_value()

    return types.void(), generate


@njit
def fence() -> None:
    """Order all reads and writes before this line against all after it, on every processor."""
    _fence()
