"""A real learning record store: Ralph (OpenFUN), in a virtual environment of its own.

Its pins (fastapi, pydantic) are not ours. `ACUS_RALPH` names the folder of such an environment that
is there already. Its backend of files takes one request in its life, because it creates its file:
here it adds to it, and the server is the one process; rules, models and answers are Ralph's.
"""

import json
import os
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from contextlib import suppress
from pathlib import Path

import pytest

WANTED = "ralph-malph[full]==5.1.0"
STARTS_WITHIN_S = 90.0
ADDING = (
    "from ralph.backends.data.fs import BaseOperationType, FSDataBackend as backend; "
    "backend.default_operation_type = BaseOperationType.APPEND; "
    "import sys, uvicorn; "
    "uvicorn.run('ralph.api:app', host='127.0.0.1', port=int(sys.argv[1]))"
)


def program(root: Path) -> Path:
    """Return Ralph's environment, made under `root` if nothing else is named."""
    if named := os.environ.get("ACUS_RALPH"):
        return Path(named)
    made = root / "ralph"
    try:
        subprocess.run([sys.executable, "-m", "venv", made], check=True, capture_output=True)
        pip = [made / "bin" / "python", "-m", "pip", "install", "--quiet", WANTED]
        subprocess.run(pip, check=True, capture_output=True, timeout=600)
    except (OSError, subprocess.SubprocessError) as error:
        said = getattr(error, "stderr", b"") or b""
        why = f"Ralph cannot be installed here: {said.decode(errors='replace')[-300:] or error}"
        (pytest.fail if os.environ.get("CI") else pytest.skip)(why)
    return made


class Ralph:
    """One store that keeps its statements in a file below `root`."""

    user, password = "acus", "correct horse"

    def __init__(self, ralph: Path, root: Path) -> None:
        self._ralph, self.root = ralph, root
        with socket.create_server(("127.0.0.1", 0)) as free:
            self.port = free.getsockname()[1]
        self.url = f"http://127.0.0.1:{self.port}/xAPI"
        self._environment = os.environ | {
            "RALPH_APP_DIR": str(root / "app"),
            "RALPH_RUNSERVER_BACKEND": "fs",
            "RALPH_AUTH_FILE": str(root / "auth.json"),
            "RALPH_BACKENDS__LRS__FS__DEFAULT_DIRECTORY_PATH": str(root / "data"),
        }

    def __enter__(self) -> "Ralph":
        (self.root / "app").mkdir(parents=True)
        who = ["-u", self.user, "-p", self.password, "-s", "all", "-M", "mailto:lrs@b.example"]
        self._run("auth", *who, "-w")
        self._start()
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    def stop(self) -> None:
        """End it, as for an update."""
        self._process.terminate()
        self._process.wait(20)
        self._log.close()

    def start_again(self) -> None:
        """Start it with what it held."""
        self._start()

    def held(self) -> list[dict[str, object]]:
        """Return all that it holds, from its file."""
        files = sorted((self.root / "data").glob("*.jsonl"))
        return [json.loads(line) for file in files for line in file.read_text().splitlines()]

    def _run(self, *words: str) -> None:
        command = [self._ralph / "bin" / "ralph", *words]
        subprocess.run(command, check=True, capture_output=True, env=self._environment)

    def _start(self) -> None:
        self._log = (self.root / "log.txt").open("ab")
        self._process = subprocess.Popen(
            [self._ralph / "bin" / "python", "-c", ADDING, str(self.port)],
            stdout=self._log, stderr=subprocess.STDOUT, env=self._environment, cwd=self.root,
        )  # fmt: skip
        limit = time.monotonic() + STARTS_WITHIN_S
        while time.monotonic() < limit and self._process.poll() is None:
            with suppress(OSError, urllib.error.URLError):
                heart = f"http://127.0.0.1:{self.port}/__heartbeat__"
                urllib.request.urlopen(heart, timeout=2.0).close()
                return
            time.sleep(0.2)
        said = (self.root / "log.txt").read_text(errors="replace")[-2000:]
        pytest.fail(f"Ralph did not start:\n{said}")
