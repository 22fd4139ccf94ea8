"""What a computation depends on besides its inputs: versions, processor, compiled files."""

import platform
from importlib.metadata import PackageNotFoundError, version
from typing import Final

from app import __version__

BUILD: Final = "build"
"""Name of the metadata record that holds it."""


def build() -> dict[str, str]:
    """Return what the last digit of a result can depend on, as text by name.

    `kernels` is a digest of every file that holds compiled code; numba compiles for `cpu`, and
    sines come from `libc`. Loads numba's compiler: call it where kernels are loaded anyway.
    """
    from llvmlite.binding import get_host_cpu_name

    from app.core.compiled import kernels_digest

    return {
        "acus": __version__,
        "kernels": kernels_digest(),
        "python": platform.python_version(),
        "numpy": _version("numpy"),
        "numba": _version("numba"),
        "llvmlite": _version("llvmlite"),
        "libc": " ".join(platform.libc_ver()),
        "machine": platform.machine(),
        "cpu": get_host_cpu_name(),
    }


def changes(recorded: dict[str, str], present: dict[str, str]) -> tuple[str, ...]:
    """Name what differs between two builds, `name: recorded, now present`."""
    names = dict.fromkeys((*recorded, *present))
    return tuple(
        f"{name}: {recorded.get(name, 'unknown')}, now {present.get(name, 'unknown')}"
        for name in names
        if recorded.get(name) != present.get(name)
    )


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:  # a vendored copy without metadata
        return "unknown"
