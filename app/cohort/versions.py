"""What decides about the bits of a result: this program's files, and what computes under it.

Two computers that agree on it make the same rows of the same input, as far as their processors do.
"""

from __future__ import annotations

import hashlib
import platform
from collections.abc import Mapping
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Final

import app
from app.core import paths
from app.scoring.version import SCORING_VERSION

_FOLDER: Final = Path(app.__file__).parent
_SHOWN: Final = frozenset(("views", "features", "commands", "demonstrations", "site"))
"""Folders of what shows or parses, which decides about no row."""

_UNDER_IT: Final = ("numpy", "scipy", "numba", "opencv-contrib-python-headless")


@cache
def program_digest() -> str:
    """Digest of every file of the program that can decide about an attempt or its score."""
    digest = hashlib.sha256()
    aside = {_FOLDER: _SHOWN, paths.resources(): frozenset({"exercises"})}  # these are the input
    for root, left_out in aside.items():
        for file in sorted(path for path in root.rglob("*") if path.suffix in (".py", ".yaml")):
            inside = file.relative_to(root)
            if left_out.isdisjoint(inside.parts):
                digest.update(f"{inside.as_posix()}\0".encode() + file.read_bytes())
    return digest.hexdigest()[:16]


@cache
def versions() -> Mapping[str, str]:
    """Return what decides about the bits, as name -> version."""
    known = {
        "acus": app.__version__,
        "program": program_digest(),
        "scoring": str(SCORING_VERSION),
        "python": platform.python_version(),
        "machine": platform.machine(),
    }
    for package in _UNDER_IT:
        try:
            known[package] = version(package)
        except PackageNotFoundError:
            known[package] = "none"
    return known


def differences(theirs: Mapping[str, str]) -> tuple[str, ...]:
    """Return what another computer has otherwise, as "acus 0.2.0, here 0.1.0"."""
    return tuple(
        f"{name} {theirs.get(name, 'none')}, here {mine}"
        for name, mine in versions().items()
        if theirs.get(name) != mine
    )
