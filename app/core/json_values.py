"""Values as JSON can hold them."""

import json
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


def compact(document: Any) -> str:
    """JSON of a document in one line, a number that is not finite as null.

    Nearly every document is JSON already and is written as it is; only one that is not is copied.
    """
    try:
        return json.dumps(document, separators=(",", ":"), allow_nan=False, default=_plain)
    except (TypeError, ValueError):
        return json.dumps(finite(document), separators=(",", ":"), allow_nan=False)


def _plain(value: Any) -> Any:
    """Return what stands for a value that JSON does not know; its contents are asked for next."""
    if isinstance(value, np.integer | np.floating | np.bool_ | np.ndarray):
        return value.tolist()
    return dict(value.items()) if hasattr(value, "items") else str(value)
