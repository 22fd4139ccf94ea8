"""tools/install-system takes back what it put on the system, whatever ends it."""

import os
import signal
import subprocess
import time
from pathlib import Path

import pytest

SCRIPT = Path(__file__).resolve().parents[1] / "tools" / "install-system"
STUBS = {
    "apt-get": '#!/bin/sh\n[ "$1" = update ] || { touch "$STARTED"; exec sleep 60; }\n',
    "id": "#!/bin/sh\necho 0\n",
}


@pytest.mark.long("journey")
@pytest.mark.skipif(os.name != "posix", reason="needs a shell")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_while_it_installs_leaves_no_policy(tmp_path: Path, number: int) -> None:
    policy, started = tmp_path / "policy-rc.d", tmp_path / "started"
    text = SCRIPT.read_text()
    assert text.count("/usr/sbin/policy-rc.d") == 1
    text = text.replace("/usr/sbin/policy-rc.d", str(policy))
    text = text.replace('missing=""', 'missing=" something"', 1)
    script = tmp_path / "install-system"
    script.write_text(text)
    for name, stub in STUBS.items():
        (tmp_path / name).write_text(stub)
        (tmp_path / name).chmod(0o755)
    environment = os.environ | {"PATH": f"{tmp_path}:{os.environ['PATH']}", "STARTED": str(started)}
    program = subprocess.Popen(
        ["/bin/sh", str(script)],
        env=environment,
        start_new_session=True,
        stdout=subprocess.DEVNULL,
        preexec_fn=lambda: signal.signal(number, signal.SIG_DFL),  # nohup has it ignored
    )
    try:
        end = time.monotonic() + 30.0
        while not started.exists() and time.monotonic() < end:
            time.sleep(0.02)
        assert "exit 101" in policy.read_text()
        os.killpg(program.pid, number)  # as a terminal does
        assert program.wait(timeout=30) == -number
    finally:
        if program.poll() is None:
            os.killpg(program.pid, signal.SIGKILL)
            program.wait()
    assert not policy.exists()
