"""Values as JSON can hold them."""

from math import isfinite
from typing import Any

import numpy as np


def finite(value: Any) -> Any:
    """Copy of a JSON-like value in which every number that is not finite is None.

    Arrays become lists, keys text, and what JSON does not know (paths, enumerations) its text.
    """
    if isinstance(value, float | np.floating):
        return float(value) if isfinite(value) else None
    if isinstance(value, np.integer | np.bool_ | np.ndarray):
        return finite(value.tolist())
    if isinstance(value, dict) or hasattr(value, "items"):
        return {str(key): finite(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [finite(item) for item in value]
    return value if isinstance(value, int | str | bool | None) else str(value)
