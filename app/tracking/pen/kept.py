"""Pens with a measured tip, kept in the user's data; the one before stays, for undo."""

from pathlib import Path

import yaml

from app.core import paths
from app.core.files import write_atomically
from app.tracking.pen.body import PenProfile


def calibrated_path(pen: str) -> Path:
    """Where a pen with a measured tip is kept.

    Args:
        pen: name, or path of its file.
    """
    return paths.data() / "pens" / f"{Path(pen).stem}.yaml"


def before_path(pen: str) -> Path:
    """Where the one before is kept."""
    return calibrated_path(pen).parent / "before" / calibrated_path(pen).name


def save_pen(pen: PenProfile, name: str = "") -> Path:
    """Keep a pen with its measured tip; return where. It is used instead of the shipped one.

    Args:
        pen: with its tip measured.
        name: under which it is looked for; without, its own.
    """
    name = name or pen.name
    file, before = calibrated_path(name), before_path(name)
    before.unlink(missing_ok=True)
    if file.is_file():
        before.parent.mkdir(parents=True, exist_ok=True)
        file.replace(before)
    write_atomically(file, yaml.safe_dump(pen.model_dump(mode="json"), sort_keys=False))
    return file


def undo_pen(name: str) -> bool:
    """Exchange the pen that is used with the one before it, which may be the drawing's.

    Twice is as never. Returns whether a measured tip is in use now.
    """
    file, before = calibrated_path(name), before_path(name)
    aside = file.with_suffix(".aside")
    before.parent.mkdir(parents=True, exist_ok=True)
    if file.is_file():
        file.replace(aside)
    if before.is_file():
        before.replace(file)
    if aside.is_file():
        aside.replace(before)
    return file.is_file()


def can_undo(name: str) -> bool:
    """Whether a measured tip was kept before, in use or not."""
    return calibrated_path(name).is_file() or before_path(name).is_file()
