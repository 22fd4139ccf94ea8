"""A provider that is not ours: oidc-provider-mock (Authlib), from a virtual environment of its own.

Its packages would change versions that are pinned here, so it is made once in a folder of the
user's cache. Where it cannot be made the tests are skipped with the reason; in CI they fail.
`browse` is the person and the browser: it follows what a provider sends it to.
"""

import http.client
import json
import os
import subprocess
import time
import urllib.parse
import urllib.request
import venv
from pathlib import Path

import pytest

SERVER = "oidc-provider-mock==0.3.4"
STARTS_WITHIN_S = 60.0
PROGRAM = (
    "import sys, oidc_provider_mock, json; "
    "from oidc_provider_mock._app import app; "
    "from werkzeug.serving import make_server; "
    "s = make_server('127.0.0.1', 0, app(require_nonce=True), threaded=True); "
    "print(s.server_port, flush=True); s.serve_forever()"
)


def python():
    """Return the interpreter that has the server; make its environment where there is none."""
    cache = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache"))
    place = cache / "acus-tests" / SERVER
    found = place / "bin" / "python"
    if not (place / "made").exists():
        try:
            venv.create(place, with_pip=True, clear=True)
            install = [str(found), "-m", "pip", "install", "-q", SERVER]
            subprocess.run(install, check=True, capture_output=True, timeout=300)
            (place / "made").touch()
        except (OSError, subprocess.SubprocessError) as error:
            if os.environ.get("CI"):
                pytest.fail(f"the provider cannot be installed: {error}")
            pytest.skip(f"the provider cannot be installed: {error}")
    return found


class Provider:
    """The server, with users as `user` adds them."""

    def __enter__(self):
        self._process = subprocess.Popen(
            [str(python()), "-c", PROGRAM], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
        )
        line = self._process.stdout.readline()
        if not line:
            pytest.fail("the provider did not start")
        self.issuer = f"http://127.0.0.1:{int(line)}"
        limit = time.monotonic() + STARTS_WITHIN_S
        while time.monotonic() < limit:
            try:
                urllib.request.urlopen(self.issuer, timeout=2.0).close()
                return self
            except OSError:
                time.sleep(0.05)
        pytest.fail("the provider does not answer")

    def __exit__(self, *_):
        self.stop()

    def stop(self):
        """End it, as for an update."""
        self._process.kill()
        self._process.wait()
        self._process.stdout.close()

    def user(self, sub, **claims):
        """Add somebody, or give him other claims."""
        body = json.dumps(claims).encode()
        head = {"Content-Type": "application/json"}
        where = f"{self.issuer}/users/{sub}"
        asked = urllib.request.Request(where, body, head, method="PUT")
        urllib.request.urlopen(asked, timeout=10.0).close()


def browse(address, sub="ada-at-the-hospital", **form):
    """Sign in at the form of the provider, follow it here; return status and text of the page."""
    body = urllib.parse.urlencode(form or {"sub": sub})
    head = {"Content-Type": "application/x-www-form-urlencoded"}
    status, where, _ = visit(address, "POST", body, head)
    assert status == 302, status
    return visit(where)[::2]


def visit(address, method="GET", body=None, head=None):
    """Return status, where it sends on to, and the text; sent on it does not follow."""
    parts = urllib.parse.urlsplit(address)
    link = http.client.HTTPConnection(parts.hostname, parts.port, timeout=10.0)
    try:
        link.request(method, f"{parts.path}?{parts.query}", body, head or {})
        answer = link.getresponse()
        return answer.status, answer.headers.get("Location", ""), answer.read().decode()
    finally:
        link.close()
