"""An S3-like server that is not ours: moto's, from a virtual environment of its own.

Its packages would change versions that are pinned here, so it is made once in a folder of the
user's cache. Where it cannot be made the tests are skipped with the reason; in CI they fail.
"""

from __future__ import annotations

import os
import subprocess
import time
import urllib.request
import venv
from pathlib import Path

import pytest
from postgres_rig import free_port

SERVER = "moto[server]==5.2.5"
KEYS = {"access_key_id": "acus", "secret_access_key": "secret"}


def python() -> Path:
    """Return the interpreter that has the server; make its environment where there is none."""
    cache = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache"))
    place = cache / "acus-tests" / SERVER.replace("[", "-").replace("]", "")
    found = place / "bin" / "python"
    if not (place / "made").exists():
        try:
            venv.create(place, with_pip=True, clear=True)
            install = [str(found), "-m", "pip", "install", "-q", SERVER]
            subprocess.run(install, check=True, capture_output=True, timeout=300)
            (place / "made").touch()
        except (OSError, subprocess.SubprocessError) as error:
            if os.environ.get("CI"):
                pytest.fail(f"moto's server cannot be installed: {error}")
            pytest.skip(f"moto's server cannot be installed: {error}")
    return found


class S3:
    """The server, with a bucket `school`."""

    def __init__(self, checks_keys: bool = False) -> None:
        self._checks = checks_keys
        self.port = free_port()
        self.endpoint = f"http://127.0.0.1:{self.port}"
        self._process: subprocess.Popen[bytes] | None = None

    def start(self) -> None:
        """Start it, and wait until it answers."""
        command = [
            str(python()),
            "-c",
            "from moto.server import main; import sys; main(sys.argv[1:])",
        ]
        self._process = subprocess.Popen(
            [*command, "-H", "127.0.0.1", "-p", str(self.port)],
            env=os.environ | ({"INITIAL_NO_AUTH_ACTION_COUNT": "1"} if self._checks else {}),
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        for _ in range(600):
            try:
                with urllib.request.urlopen(f"{self.endpoint}/moto-api/", timeout=1):
                    break
            except OSError:
                time.sleep(0.1)
        else:
            pytest.fail("the S3-like server did not start")
        self.make("school")

    def make(self, bucket: str) -> None:
        """Make a bucket."""
        asked = urllib.request.Request(f"{self.endpoint}/{bucket}", method="PUT")
        with urllib.request.urlopen(asked, timeout=10):
            pass

    def kill(self) -> None:
        """End it at once; what it held is gone, as it keeps everything in memory."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()
            self._process = None
