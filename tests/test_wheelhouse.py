"""The zips for Windows and macOS: what is in them, their sums, and the script where it can run."""

import hashlib
import os
import stat
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from tools import wheelhouse

FOR = f"{sys.version_info.major}.{sys.version_info.minor}"
ENTRY = """import sys
def main():
    print("acus", *sys.argv[1:])
"""


@pytest.fixture
def program(tmp_path):
    """A wheel of a program that says its arguments."""
    file, info = tmp_path / "acus-1.2-py3-none-any.whl", "acus-1.2.dist-info"
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("acus_entry.py", ENTRY)
        fields = "Metadata-Version: 2.1\nName: acus\nVersion: 1.2\nProvides-Extra: trainer\n"
        archive.writestr(f"{info}/METADATA", fields)
        tag = "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n"
        archive.writestr(f"{info}/WHEEL", tag)
        archive.writestr(f"{info}/entry_points.txt", "[console_scripts]\nacus = acus_entry:main\n")
        archive.writestr(f"{info}/RECORD", "")
    return file


def unpacked(program, system, tmp_path):
    out = tmp_path / f"acus-1.2-{system}.zip"
    wheelhouse.packed([program], wheelhouse.SYSTEMS[system], "1.2", FOR, out)
    with zipfile.ZipFile(out) as archive:
        archive.extractall(tmp_path / "there")
    return tmp_path / "there" / out.stem


def executed(folder):
    """Run the script for macOS, whose commands this system has too."""
    own = os.environ | {"PIP_INDEX_URL": "http://127.0.0.1:9/", "PIP_FIND_LINKS": "/nowhere"}
    return subprocess.run(
        ["sh", str(folder / "install.sh")], capture_output=True, text=True, check=False, env=own
    )


@pytest.mark.parametrize("system", wheelhouse.SYSTEMS)
def test_every_file_has_its_sum_as_sha256sum_writes_it(program, system, tmp_path):
    folder = unpacked(program, system, tmp_path)
    lines = (folder / "SHA256SUMS").read_text().splitlines()
    names = {line[66:]: line[:64] for line in lines}
    files = {str(one.relative_to(folder)) for one in folder.rglob("*") if one.is_file()}
    assert set(names) == files - {"SHA256SUMS"}
    for name, digest in names.items():
        assert hashlib.sha256((folder / name).read_bytes()).hexdigest() == digest
    assert wheelhouse.SYSTEMS[system].script in names
    assert "constraints.txt" in names


def test_the_script_for_windows_takes_the_wheels_alone_and_stops_at_the_first_fault(
    program, tmp_path
):
    script = (unpacked(program, "windows-x86_64", tmp_path) / "install.bat").read_bytes()
    assert script.count(b"\n") == script.count(b"\r\n")  # cmd reads labels and blocks by these
    text = script.decode("ascii").replace("^\r\n", " ")
    lines = [line.strip() for line in text.splitlines()]
    assert f"py -{FOR} -m venv acus-venv || exit /b 1" in lines
    (pip,) = [line for line in lines if "-m pip install" in line]
    for part in ("--isolated", "--no-index", "--find-links wheels", "--constraint constraints.txt"):
        assert part in pip
    assert pip.endswith('"acus[trainer]" || exit /b 1')
    assert lines.index(f"py -{FOR} check.py || exit /b 1") < lines.index(pip)
    assert "{" not in text


def test_the_script_for_macos_is_one_of_a_posix_shell(program, tmp_path):
    folder = unpacked(program, "macos-arm64", tmp_path)
    with zipfile.ZipFile(tmp_path / "acus-1.2-macos-arm64.zip") as archive:
        entry = next(one for one in archive.infolist() if one.filename.endswith("install.sh"))
    assert stat.S_IMODE(entry.external_attr >> 16) == 0o755
    subprocess.run(["sh", "-n", folder / "install.sh"], check=True)


@pytest.mark.long("journey")
def test_the_script_installs_without_a_network_and_again(program, tmp_path):
    folder = unpacked(program, "macos-arm64", tmp_path)
    for _ in range(2):
        done = executed(folder)
        assert done.returncode == 0, done.stderr
        assert done.stdout.strip().endswith("acus-venv/bin/acus run")
    command = folder / "acus-venv/bin/acus"
    said = subprocess.run([command, "run"], capture_output=True, text=True, check=True).stdout
    assert said == "acus run\n"


@pytest.mark.parametrize("harm", ["changed", "missing"])
def test_a_wheel_that_is_damaged_or_missing_installs_nothing(program, tmp_path, harm):
    folder = unpacked(program, "macos-arm64", tmp_path)
    (wheel,) = (folder / "wheels").iterdir()
    if harm == "missing":
        wheel.unlink()
    else:
        wheel.write_bytes(wheel.read_bytes() + b"\0")
    done = executed(folder)
    assert done.returncode == 1
    assert f"damaged or missing, so nothing is installed: wheels/{wheel.name}" in done.stderr
    assert not (folder / "acus-venv").exists()


def test_a_computer_without_that_python_is_told_so(program, tmp_path):
    folder = unpacked(program, "macos-arm64", tmp_path)
    script = (folder / "install.sh").read_text().replace(f"python{FOR}", "python2.0")
    (folder / "install.sh").write_text(script)
    done = executed(folder)
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.startswith("Acus needs Python")


def test_what_only_the_other_system_needs_is_asked_for_as_pinned():
    constraints = (Path(wheelhouse.ROOT) / "constraints.txt").read_text()
    windows = wheelhouse.SYSTEMS["windows-x86_64"]
    assert wheelhouse.pinned(["b", "none"], "a==1\nb==2.5\n") == ["b==2.5", "none"]
    assert all("==" in one for one in wheelhouse.pinned(windows.only_there, constraints))
