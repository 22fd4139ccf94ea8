"""The other opinion: GDCM through SimpleITK, and pydicom, in a process of their own."""

import json
import os
import select
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.studies.errors import StudyError

PATIENCE = 300.0
"""Longest time that it may take for one image [s]."""


@dataclass(frozen=True, slots=True, eq=False)
class PeerImage:
    """What the peer made of an image.

    Attributes:
        values: shape (K, J, I).
        affine_mm: (i, j, k) -> LPS, shape (4, 4).
    """

    values: NDArray[Any]
    affine_mm: FloatArray


class Peer:
    """Started at the first question, started again when a file has crashed it. Close it."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._folder = tempfile.TemporaryDirectory(prefix="acus-peer-")

    def close(self) -> None:
        """End it; idempotent."""
        self._end()
        self._folder.cleanup()

    def facts(self, files: Sequence[Path]) -> list[dict[str, Any]]:
        """Return what pydicom says of each file; nothing if it cannot read one of them."""
        answer = self._ask({"facts": [str(file) for file in files]})
        found: list[dict[str, Any]] = answer.get("facts", [])
        return found

    def image(self, files: Sequence[Path]) -> PeerImage | str:
        """Read an image; or why it cannot be read.

        Raises:
            StudyError: if SimpleITK is not installed.
        """
        with tempfile.TemporaryDirectory(dir=self._folder.name) as links:
            for number, file in enumerate(files):
                Path(links, f"{number:05d}").symlink_to(file.absolute())
            out = Path(self._folder.name, "values.npy")
            answer = self._ask(
                {"files": [str(file) for file in files], "folder": links, "out": str(out)}
            )
        if error := answer.get("error"):
            if "No module named 'SimpleITK'" in error:
                raise StudyError("this study needs SimpleITK: pip install 'acus[bench]'")
            return " ".join(str(error).split())
        values = np.load(out, allow_pickle=False)
        out.unlink()
        if values.ndim == 2:
            values = values[None]
        return PeerImage(values, _affine(answer)) if values.ndim == 3 else "not of 3 dimensions"

    def _ask(self, request: dict[str, Any]) -> dict[str, Any]:
        process = self._process or self._start()
        if process.stdin is None or process.stdout is None:
            return {"error": "not started"}
        try:
            process.stdin.write(json.dumps(request).encode() + b"\n")
            process.stdin.flush()
            ready, _, _ = select.select([process.stdout], [], [], PATIENCE)
            line = process.stdout.readline() if ready else b""
        except OSError:
            line = b""
        if line.endswith(b"\n"):
            answer: dict[str, Any] = json.loads(line)
            return answer
        self._end()
        return {"error": "crashed" if ready else f"took longer than {PATIENCE:.0f} s"}

    def _start(self) -> "subprocess.Popen[bytes]":
        program = Path(__file__).with_name("peer_program.py")
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-W", "ignore", str(program)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=os.environ | {"ITK_GLOBAL_DEFAULT_NUMBER_OF_THREADS": "1"},
        )
        return self._process

    def _end(self) -> None:
        process, self._process = self._process, None
        if process is not None:
            for stream in (process.stdin, process.stdout):
                if stream is not None:
                    stream.close()
            process.kill()
            process.wait()


def _affine(answer: dict[str, Any]) -> FloatArray:
    affine = np.eye(4)
    direction = np.array(answer["direction"])
    turn = direction.reshape(3, 3) if direction.size == 9 else np.eye(3)
    spacing = np.ones(3)
    spacing[: len(answer["spacing"])] = answer["spacing"]
    affine[:3, :3] = turn * spacing
    affine[: len(answer["origin"]), 3] = answer["origin"]
    return affine
