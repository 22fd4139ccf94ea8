"""The tracker's kernels, compiled in a process of their own while the program compiles the others.

Numba compiles on one core at a time in a process. On a first start half of the time goes into
kernels that only the tracker calls: a child finds the marker in a picture once, which compiles them
into the cache (`app.core.compiled`) that this process then loads them from.

    python -m app.compose.first_start
"""

from __future__ import annotations

import atexit
import contextlib
import gc
import os
import subprocess
import sys
import threading
import time
from collections.abc import Sequence
from pathlib import Path
from typing import IO, Final

from app.core.child_process import environment, module_command
from app.core.loading import ONE_AT_A_TIME
from app.core.messages import sentence
from app.core.progress import Progress

ABOUT: Final = 285
"""Kernels that a child compiles, numba's own among them; only a bar goes by it."""

COMMAND: Final = tuple(module_command("app.compose.first_start", options=("-W", "ignore")))

PARENT_ENDED: Final = 75
"""The child ends with this code where whoever started it has ended: another start tries again."""

_LOOK: Final = 0.1
DEFAULT: Final = "model_fit"


def rehearse_tracking(extractor: str) -> None:
    """Render a needle and find its marker: compiles what is built for the arguments of the search.

    Args:
        extractor: how the marker's place is found, by its name in `tracking.markers.choice`.
    """
    import numpy as np

    from app.tracking.markers.choice import ExtractorName, extractors
    from app.tracking.optics.rig import load_rig
    from app.tracking.simulated.cameras import NeedleRenderer
    from app.tracking.simulated.delivery import Tone, develop
    from app.tracking.simulated.scene import MarkerScene
    from app.tracking.solver import FixSolver
    from app.tracking.tracker import rehearse

    rig = load_rig("wide")
    fulcrum, axis = np.array([0.0, 0.16, 0.09]), np.array([0.0, 0.0, -1.0])
    scene = MarkerScene.from_tip(fulcrum + 0.05 * axis, axis, rig.needle.marker_offset)
    pair = extractors(rig, ExtractorName(extractor))
    sensor = Tone.of(np.array([0.0, 4000.0, 8.0]))
    light = NeedleRenderer(rig.models[0], rig.needle, rig.blur_px, 0, light=True).render(scene)
    picture = develop(light, sensor, np.random.default_rng(0))
    pair[0].search(picture)
    rehearse(rig, fulcrum, pair, FixSolver(rig, fulcrum))


def rehearsed_file() -> Path:
    """Return the file in the cache that says that it holds the tracker's kernels."""
    from app.core.compiled import complete_file

    return complete_file("rehearsed")


class TrackerKernels:
    """The child that compiles the tracker's kernels; none where the cache holds them already.

    Args:
        command: that the child runs; it prints a line for each kernel.
    """

    def __init__(self, command: Sequence[str] = COMMAND) -> None:
        self._command = command
        self._child: subprocess.Popen[bytes] | None = None
        self._compiled = 0

    def start(self) -> None:
        """Start the child if the kernels are not in the cache; starting twice is fine."""
        with ONE_AT_A_TIME:
            if self._child is not None or rehearsed_file().exists():
                return
            self._child = subprocess.Popen(
                self._command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                env=environment(),
            )
        atexit.register(self.close)
        output = self._child.stdout
        threading.Thread(target=self._count, args=(output,), daemon=True).start()

    def _count(self, output: IO[bytes]) -> None:
        for _ in output:
            self._compiled += 1

    def wait(self, progress: Progress) -> None:
        """Wait until the child has ended; what it could not compile is compiled where it is called.

        Raises:
            Cancelled: if `progress` was cancelled.
        """
        while self._child is not None and self._child.poll() is None:
            share = min(self._compiled / ABOUT, 0.99)
            progress.report(share, sentence("the first start compiles what follows the marker"))
            time.sleep(_LOOK)

    def load(self, progress: Progress) -> None:
        """Wait for the child, then load what it compiled, so that no scene has to.

        Raises:
            Cancelled: if `progress` was cancelled.
        """
        self.wait(progress)
        with ONE_AT_A_TIME:
            rehearse_tracking(DEFAULT)

    def close(self) -> None:
        """End the child if it still compiles; closing twice is fine."""
        if self._child is not None:
            self._child.kill()
            self._child.wait()
            for pipe in (self._child.stdin, self._child.stdout):
                if pipe is not None:
                    pipe.close()
            self._child = None


def _end_with_parent() -> None:
    """End when whoever started this process has ended: its end of the pipe closes with it."""
    with contextlib.suppress(OSError):
        while os.read(sys.stdin.fileno(), 1):
            pass
    os._exit(PARENT_ENDED)


def main() -> None:
    """Compile, and print an empty line for each kernel."""
    threading.Thread(target=_end_with_parent, daemon=True).start()
    gc.disable()  # what the compiler makes lives on or dies without help; the process is short
    from app.core import loading

    loading.COMPILED.listen(lambda: os.write(sys.stdout.fileno(), b"\n"))
    rehearse_tracking(DEFAULT)
    rehearsed_file().touch()


if __name__ == "__main__":
    main()
