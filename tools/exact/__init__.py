"""References of the hard cases in 60 digits: what mpmath makes of the same doubles.

Every function computes one or more entries of a `references.json` beside hard cases from exact
doubles, by a formula that is plain and needs no care, in so many digits that none is needed.
`tools.hard_references` writes them.
"""

from collections.abc import Callable
from typing import Any, Final

import mpmath  # type: ignore[import-untyped]

DIGITS: Final = 60
"""Digits that are kept."""

WORKING: Final = 140
"""Digits in which everything is computed."""

ENTRIES: Final[dict[str, tuple[str, tuple[float, ...], Callable[..., Any]]]] = {}
"""Name -> how it is found, the given doubles, and what computes the numbers of them."""


def exact(name: str, how: str, *given: float) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Enter a function that computes the numbers of a reference from exact doubles.

    Raises:
        ValueError: if there is one of that name.
    """
    if name in ENTRIES:
        raise ValueError(f"two references are called {name!r}")

    def enter(compute: Callable[..., Any]) -> Callable[..., Any]:
        ENTRIES[name] = how, given, compute
        return compute

    return enter


def computed(name: str) -> dict[str, Any]:
    """Compute one entry as the file holds it."""
    how, given, compute = ENTRIES[name]
    with mpmath.workdps(WORKING):
        values = [mpmath.nstr(v, DIGITS) for v in compute(*map(mpmath.mpf, given))]
    return {"how": how, "given": list(given), "value": values}
