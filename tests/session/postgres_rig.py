"""A real PostgreSQL, started by the tests on loopback with a free port, ended by its process."""

import os
import pwd
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from pathlib import Path
from types import TracebackType

import pytest

STARTS_WITHIN_S = 60.0
USER, PASSWORD = "acus", "only-for-tests"


def binaries() -> Path | None:
    """Debian puts them where no PATH looks."""
    found = sorted(Path("/usr/lib/postgresql").glob("*/bin/initdb"))
    if found:
        return found[-1].parent
    there = shutil.which("initdb")
    return Path(there).resolve().parent if there else None


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


class Postgres:
    """One server with its own data; nobody but this computer may ask it."""

    def __init__(self) -> None:
        self.port, self._process = free_port(), None
        self._root = Path(tempfile.mkdtemp(prefix="acus-pg-"))

    def url(self, port: int = 0) -> str:
        return f"postgresql+psycopg://{USER}:{PASSWORD}@127.0.0.1:{port or self.port}/postgres"

    def __enter__(self) -> "Postgres":
        place = binaries()
        if place is None:
            if os.environ.get("CI"):
                pytest.fail("PostgreSQL is not installed: tools/install-system tests installs it")
            pytest.skip("PostgreSQL is not installed: apt-get install postgresql")
        self._place = place
        secret = self._root / "secret"
        secret.write_text(PASSWORD)
        if os.getuid() == 0:  # it refuses to run as root
            owner = pwd.getpwnam("postgres")
            for path in (self._root, secret):
                os.chown(path, owner.pw_uid, owner.pw_gid)
        made = self._run(
            "initdb", "-D", self.data, "-U", USER, "-A", "scram-sha-256", "--pwfile", secret,
            "--no-sync", "--encoding=UTF8", "--locale=C",
        )  # fmt: skip
        assert made.wait(STARTS_WITHIN_S) == 0, made
        self.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.stop(signal.SIGQUIT)
        shutil.rmtree(self._root, ignore_errors=True)

    @property
    def data(self) -> Path:
        return self._root / "data"

    def start(self) -> None:
        self._process = self._run(
            "postgres", "-D", self.data, "-p", str(self.port), "-c", "listen_addresses=127.0.0.1",
            "-c", f"unix_socket_directories={self._root}", "-c", "fsync=off",
        )  # fmt: skip
        limit = time.monotonic() + STARTS_WITHIN_S
        while self._run("pg_isready", "-q", "-h", "127.0.0.1", "-p", str(self.port)).wait():
            if self._process.poll() is not None or time.monotonic() > limit:
                pytest.fail("PostgreSQL did not start")
            time.sleep(0.05)

    @property
    def is_running(self) -> bool:
        return self._process is not None

    def put_back(self, backup: Path) -> None:
        """Let it hold what a copy of its data holds; it must be stopped."""
        shutil.rmtree(self.data)
        shutil.copytree(backup, self.data)
        if os.getuid() == 0:
            owner = pwd.getpwnam("postgres")
            for path in (self.data, *self.data.rglob("*")):
                os.chown(path, owner.pw_uid, owner.pw_gid)
        self.data.chmod(0o700)

    def stop(self, by: signal.Signals = signal.SIGINT) -> None:
        """End it; SIGKILL is a power cut."""
        if self._process is None:
            return
        if by is signal.SIGKILL:
            subprocess.run(["pkill", "-KILL", "-P", str(self._process.pid)], check=False)
        self._process.send_signal(by)
        self._process.wait(60)
        self._process = None

    def _run(self, program: str, *arguments: object) -> subprocess.Popen[bytes]:
        return subprocess.Popen(
            [str(self._place / program), *map(str, arguments)],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            cwd=self._root,
            user="postgres" if os.getuid() == 0 else None,
            group="postgres" if os.getuid() == 0 else None,
        )
