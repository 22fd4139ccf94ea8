"""Where things live: resources in the package, everything written in per-user folders."""

import os
from pathlib import Path

_PACKAGE = Path(__file__).resolve().parents[1]


def resources() -> Path:
    """Folder of the shipped resources: inside the wheel, or beside `app/` in a checkout."""
    inside = _PACKAGE / "resources"
    return inside if inside.is_dir() else _PACKAGE.parent / "resources"


def in_checkout() -> bool:
    """Whether the program runs from a source tree."""
    return (_PACKAGE.parent / "pyproject.toml").is_file()


def sessions() -> Path:
    """Folder of recordings: `ACUS_SESSIONS`, else `sessions/` of a checkout, else the user's."""
    if chosen := os.environ.get("ACUS_SESSIONS"):
        return Path(chosen)
    return _PACKAGE.parent / "sessions" if in_checkout() else data() / "sessions"


def data() -> Path:
    """Per-user data folder (`ACUS_DATA` overrides)."""
    return Path(os.environ.get("ACUS_DATA") or _of_user("data"))


def cache() -> Path:
    """Per-user cache folder for what can be made again (`ACUS_CACHE` overrides)."""
    return Path(os.environ.get("ACUS_CACHE") or _of_user("cache"))


def settings() -> Path:
    """Per-user settings folder (`ACUS_SETTINGS` overrides)."""
    return Path(os.environ.get("ACUS_SETTINGS") or _of_user("config"))


def laws() -> Path:
    """Per-user folder of a laboratory's own force laws (`ACUS_LAWS` overrides)."""
    return Path(os.environ.get("ACUS_LAWS") or data() / "laws")


def _of_user(kind: str) -> str:
    import platformdirs  # takes its time, and who is told the folders does without

    folder: str = getattr(platformdirs, f"user_{kind}_dir")("acus", appauthor=False)
    return folder
