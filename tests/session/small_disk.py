"""A disk of a few kilobytes that fills up for real, where this user may mount one."""

import subprocess
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest


class SmallDisk:
    """A file system in memory, of a size that can be changed, or read only."""

    def __init__(self, place: Path) -> None:
        self.place = place

    def make(self, kilobytes: int) -> None:
        self._mount("-t", "tmpfs", "-o", f"size={kilobytes}k", "tmpfs")

    def grow(self, kilobytes: int) -> None:
        """Make room."""
        self._mount("-o", f"remount,rw,size={kilobytes}k")

    def only_read(self) -> None:
        """Let nobody write, root neither."""
        self._mount("-o", "remount,ro")

    def _mount(self, *arguments: str) -> None:
        subprocess.run(["mount", *arguments, str(self.place)], check=True, capture_output=True)


@contextmanager
def small_disk(place: Path, kilobytes: int) -> Iterator[SmallDisk]:
    """Mount it; whoever may not mount has no such test."""
    place.mkdir(parents=True)
    disk = SmallDisk(place)
    try:
        disk.make(kilobytes)
    except (OSError, subprocess.CalledProcessError):
        pytest.skip("mounting a small disk needs root and the right to mount")
    try:
        yield disk
    finally:
        with suppress(OSError):
            subprocess.run(["umount", "-l", str(place)], check=False, capture_output=True)
