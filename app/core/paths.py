"""Where things live: resources in the package, everything written in per-user folders."""

import os
from contextlib import suppress
from pathlib import Path

_PACKAGE = Path(__file__).resolve().parents[1]


def resources() -> Path:
    """Folder of the shipped resources: inside the wheel, or beside `app/` in a checkout."""
    inside = _PACKAGE / "resources"
    return inside if inside.is_dir() else _PACKAGE.parent / "resources"


def in_checkout() -> bool:
    """Return whether the program runs from a source tree."""
    return (_PACKAGE.parent / "pyproject.toml").is_file()


def tree_sessions() -> Path | None:
    """Return `sessions/` of the source tree that the program runs from; None where it is installed.

    Nothing is written there unless `ACUS_SESSIONS` names it, as `make run` does.
    """
    return _PACKAGE.parent / "sessions" if in_checkout() else None


def keep_private() -> None:
    """Keep what this program writes from other accounts of the computer (0700 and 0600).

    Folders of earlier versions are closed too; one that was chosen by a variable of the environment
    belongs to whoever chose it, and keeps the rights that it has.
    """
    os.umask(0o077)
    own = {"ACUS_DATA": data, "ACUS_SETTINGS": settings, "ACUS_SESSIONS": sessions}
    for variable, folder in own.items():
        if not os.environ.get(variable) and folder().is_dir():
            with suppress(OSError):
                folder().chmod(0o700)


def sessions() -> Path:
    """Return the folder of recordings: `ACUS_SESSIONS`, else the user's own."""
    return Path(os.environ.get("ACUS_SESSIONS") or own_sessions())


def own_sessions() -> Path:
    """Return the folder of recordings in the user's data folder."""
    return data() / "sessions"


def data() -> Path:
    """Per-user data folder (`ACUS_DATA` overrides)."""
    return Path(os.environ.get("ACUS_DATA") or _of_user("data"))


def cache() -> Path:
    """Per-user cache folder for what can be made again (`ACUS_CACHE` overrides)."""
    return Path(os.environ.get("ACUS_CACHE") or _of_user("cache"))


def settings() -> Path:
    """Per-user settings folder (`ACUS_SETTINGS` overrides)."""
    return Path(os.environ.get("ACUS_SETTINGS") or _of_user("config"))


def plugin_places(kind: str) -> tuple[Path, ...]:
    """Return the folders of a laboratory's own files: `laws`, `effects`, `mechanisms` or the like.

    `ACUS_LAWS`, `ACUS_EFFECTS`, `ACUS_METRICS`, `ACUS_STUDIES`, `ACUS_EXTRACTORS`, `ACUS_REMEDIES`,
    `ACUS_NEEDLE_SOURCES`, `ACUS_MECHANISMS` and `ACUS_TRANSLATIONS` list others in the place of the
    per-user one, as PATH lists folders.
    """
    return _listed(f"ACUS_{kind.upper()}") or (data() / kind,)


def plugin_folders() -> tuple[Path, ...]:
    """Return the folders of plug-ins that `ACUS_PLUGINS` lists, as PATH lists folders."""
    return tuple(path.absolute() for path in _listed("ACUS_PLUGINS"))


def _listed(variable: str) -> tuple[Path, ...]:
    return tuple(map(Path, filter(None, os.environ.get(variable, "").split(os.pathsep))))


def _of_user(kind: str) -> str:
    import platformdirs  # takes its time, and who is told the folders does without

    folder: str = getattr(platformdirs, f"user_{kind}_dir")("acus", appauthor=False)
    return folder
