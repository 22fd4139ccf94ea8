"""The Debian package, judged and installed by dpkg itself, into a root of its own."""

import os
import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest

from tools import deb

ROOT = Path(__file__).resolve().parents[1]

pytestmark = [
    pytest.mark.skipif(shutil.which("dpkg-deb") is None, reason="not a Debian system"),
]

ENTRY = """import sys
def main():
    print("acus", *sys.argv[1:])
"""


@pytest.fixture
def package(tmp_path):
    """A package of a program that says its arguments."""
    wheels = tmp_path / "wheels"
    wheels.mkdir()
    file, info = wheels / "acus-1.2-py3-none-any.whl", "acus-1.2.dist-info"
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("acus_entry.py", ENTRY)
        fields = "Metadata-Version: 2.1\nName: acus\nVersion: 1.2\nProvides-Extra: trainer\n"
        archive.writestr(f"{info}/METADATA", fields)
        tag = "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n"
        archive.writestr(f"{info}/WHEEL", tag)
        archive.writestr(f"{info}/entry_points.txt", "[console_scripts]\nacus = acus_entry:main\n")
        archive.writestr(f"{info}/RECORD", "")
    return deb.package([file], "acus[trainer]", "1.2", tmp_path / "out")


def said(*command, **more):
    return subprocess.run(command, check=True, capture_output=True, text=True, **more).stdout


def test_dpkg_reads_its_fields_and_what_it_needs(package):
    assert said("dpkg-deb", "--field", package, "Package", "Version").split()[1::2] == [
        "acus",
        "1.2",
    ]
    needs = said("dpkg-deb", "--field", package, "Depends")
    script = (ROOT / "tools" / "install-system").read_text()
    for library in ("libegl1", "libxcb-cursor0", "fonts-dejavu-core", f"python{deb.FOR}-venv"):
        assert library in needs
        assert library in script or library.startswith("python")
    for of_tests in ("xvfb", "orthanc", "openscad", "postgresql"):
        assert of_tests in script
        assert of_tests not in needs


def test_it_holds_menu_entry_icon_and_command_with_roots_rights(package):
    lines = said("dpkg-deb", "--contents", package).splitlines()
    assert all(line.split()[1] == "root/root" for line in lines)
    rights = {line.split()[-1]: line.split()[0] for line in lines}
    assert rights["./usr/bin/acus"] == "-rwxr-xr-x"
    assert rights["./usr/share/applications/acus.desktop"] == "-rw-r--r--"
    assert "./usr/share/icons/hicolor/scalable/apps/acus.svg" in rights
    assert "./usr/lib/acus/wheels/acus-1.2-py3-none-any.whl" in rights
    assert not any(name.startswith("./opt") for name in rights)  # dpkg would remove it, once empty
    assert not any("home" in name or "site-packages" in name for name in rights)


def test_what_a_trainer_needs_is_read_from_the_systems_script():
    with pytest.raises(ValueError, match="no lines"):
        deb.system_packages("#!/bin/sh\n")
    assert "make" not in deb.system_packages((ROOT / "tools" / "install-system").read_text())


@pytest.mark.long("journey")
@pytest.mark.skipif(os.geteuid() != 0, reason="dpkg installs as root only")
def test_dpkg_installs_it_without_a_network_and_removes_it_without_a_trace(package, tmp_path):
    root = tmp_path / "root"
    (root / "var/lib/dpkg/info").mkdir(parents=True)
    (root / "var/lib/dpkg/updates").mkdir()
    (root / "var/lib/dpkg/status").touch()
    (root / "opt").mkdir()  # as every Debian has it
    theirs = root / "home/somebody/.local/share/acus/attempt.mcap"
    theirs.parent.mkdir(parents=True)
    theirs.write_text("kept")
    dpkg = ("dpkg", f"--root={root}", "--force-script-chrootless", "--force-depends")
    places = [Path("/usr/bin"), Path("/usr/sbin"), Path("/sbin"), Path("/bin")]
    own = os.environ | {"PATH": ":".join([*map(str, places), os.environ["PATH"]])}
    own |= {"PIP_INDEX_URL": "http://127.0.0.1:9/", "PIP_FIND_LINKS": "/nowhere"}
    said(*dpkg, "--install", package, env=own)
    command = root / "opt/acus/venv/bin/acus"
    assert said(command, "run") == "acus run\n"
    assert said(*dpkg, "--status", "acus").splitlines()[1] == "Status: install ok installed"
    said(*dpkg, "--install", package, env=own)  # again, as an upgrade does
    assert said(command, "demo") == "acus demo\n"
    said(*dpkg, "--remove", "acus", env=own)
    assert list((root / "opt").iterdir()) == []
    assert not (root / "usr/lib/acus").exists()
    assert not (root / "usr/bin/acus").exists()
    assert theirs.read_text() == "kept"
