"""A child process and the connection to it: a socket pair where a child can be given one end.

On Windows it cannot: there the program listens on the loopback for the one that brings the word
that only its child was told.
"""

from __future__ import annotations

import hmac
import os
import secrets
import socket
import subprocess
import time
from typing import Final

from app.core.child_process import environment, module_command
from app.core.messages import sentence
from app.imaging.errors import WorkerError
from app.imaging.worker.lent_memory import PASSES

_WORD: Final = "ACUS_WORKER_WORD"
"""Variable of the environment that holds what the child must say first."""

_PATIENCE_S: Final = 20.0
"""Time in which the child must take in what it is sent [s]."""

_CONNECTED_S: Final = 60.0
"""A child that has not connected by then is given up [s]; a machine may be slow."""

_LOOPBACK: Final = "127.0.0.1"


def started(module: str) -> tuple[subprocess.Popen[bytes], socket.socket]:
    """Start a child that runs a module, and return it with this end of the connection.

    Raises:
        WorkerError: if it cannot be started.
    """
    try:
        process, end = _with_pair(module) if PASSES else _with_word(module)
    except OSError as error:
        raise WorkerError(
            sentence(
                "the process that reads foreign files cannot be started: {error_strerror}",
                error_strerror=error.strerror or error,
            )
        ) from error
    end.settimeout(_PATIENCE_S)  # it is read only where something has come
    return process, end


def connected(argument: str) -> socket.socket:
    """Return the child's end of the connection.

    Args:
        argument: that it was started with.

    Raises:
        OSError: if the program is gone.
    """
    host, colon, port = argument.rpartition(":")
    if not colon:
        return socket.socket(fileno=int(argument))
    end = socket.create_connection((host, int(port)))
    end.sendall(bytes.fromhex(os.environ.pop(_WORD)))
    return end


def _with_pair(module: str) -> tuple[subprocess.Popen[bytes], socket.socket]:
    ours, theirs = socket.socketpair()
    with theirs:
        try:
            # Ctrl+C in a terminal is the program's to handle
            passed = {"pass_fds": (theirs.fileno(),), "start_new_session": True}
            return _run(module, str(theirs.fileno()), {}, passed), ours
        except BaseException:
            ours.close()
            raise


def _with_word(module: str) -> tuple[subprocess.Popen[bytes], socket.socket]:
    word = secrets.token_bytes(32)
    with socket.create_server((_LOOPBACK, 0)) as server:
        port = server.getsockname()[1]
        process = _run(module, f"{_LOOPBACK}:{port}", {_WORD: word.hex()}, {})
        until = time.monotonic() + _CONNECTED_S
        try:
            while True:
                server.settimeout(max(0.01, min(0.5, until - time.monotonic())))
                try:
                    end = server.accept()[0]
                except TimeoutError:
                    if process.poll() is not None or time.monotonic() > until:
                        raise
                    continue
                if _says(end, word):
                    return process, end
                end.close()
        except BaseException:
            process.kill()
            process.wait()
            raise


def _says(end: socket.socket, word: bytes) -> bool:
    """Return whether somebody who has connected says the word; leaves the socket blocking."""
    said = b""
    try:
        end.settimeout(1.0)
        while len(said) < len(word) and (part := end.recv(len(word) - len(said))):
            said += part
        end.settimeout(None)
    except OSError:
        return False
    return hmac.compare_digest(said, word)


def _run(
    module: str, argument: str, variables: dict[str, str], options: dict[str, object]
) -> subprocess.Popen[bytes]:
    # Each thread of a library would take its share of the memory allowed.
    own = environment(OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1", **variables)
    return subprocess.Popen(  # type: ignore[call-overload]
        module_command(module, argument),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,  # decoders grumble there, and parsers quote headers
        env=own,
        **options,
    )
