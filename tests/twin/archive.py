"""The archive: Orthanc, which keeps what it was sent across kills."""

from __future__ import annotations

import json
import os
import signal
import sys
import urllib.request
from pathlib import Path

from tests.twin.part import ROOT

sys.path.append(str(ROOT / "tests" / "imaging"))
from orthanc_rig import Orthanc


class Archive:
    """Orthanc with storage of its own, on loopback."""

    name = "archive"

    def __init__(self, folder: Path) -> None:
        self.orthanc = Orthanc(folder / "orthanc")
        self._running = False

    def start(self) -> None:
        self.orthanc.__enter__()
        self._running = True

    def kill(self) -> None:
        self.orthanc.kill()
        self._running = False

    def hang(self) -> None:
        os.kill(self.orthanc._process.pid, signal.SIGSTOP)

    def go_on(self) -> None:
        os.kill(self.orthanc._process.pid, signal.SIGCONT)

    def stop(self) -> None:
        if self._running:
            self.go_on()
            self.orthanc.__exit__()
            self._running = False

    def held(self) -> list[str]:
        """Return the UIDs of all objects that it holds."""
        where = f"http://127.0.0.1:{self.orthanc.http}/instances"
        with urllib.request.urlopen(f"{where}?expand", timeout=20.0) as answer:
            return [one["MainDicomTags"]["SOPInstanceUID"] for one in json.load(answer)]
