"""Make a Debian package of the trainer: `make deb`, dist/acus_VERSION_ARCHITECTURE.deb.

In it lie the wheels of the trainer in the pinned versions, a menu entry with its icon, and a
command `acus`. On installing, `/opt/acus/venv` is made of these wheels alone, without a network;
removing the package removes it. What people did (attempts, settings, CTs) stays. Nothing that the
package holds lies in `/opt`: with it dpkg would take that folder away, which the system made.

The package is for the minor version of Python that makes it, as compiled wheels are.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).resolve().parents[1]
DIST: Final = ROOT / "dist"
HOME: Final = "usr/lib/acus"
FOR: Final = f"{sys.version_info.major}.{sys.version_info.minor}"

CONTROL: Final = """Package: acus
Version: {version}
Architecture: {architecture}
Maintainer: the authors of Acus <acus@localhost>
Installed-Size: {size}
Depends: {needs}
Section: science
Priority: optional
Description: trainer for CT-guided needle insertion
 A desktop trainer with a haptic pantograph, on real or simulated hardware.
 Training only: not a medical device, not for diagnosis or patient care.
"""

POSTINST: Final = """#!/bin/sh
set -e
[ "$1" = configure ] || exit 0
given="${DPKG_ROOT:-}/usr/lib/acus"
home="${DPKG_ROOT:-}/opt/acus"
rm -rf "$home/venv"
trap 'rm -rf "$home"' EXIT
mkdir -p "$home"
python@FOR@ -m venv "$home/venv"
"$home/venv/bin/python" -m pip install --quiet --disable-pip-version-check --isolated \\
    --no-index --no-compile --find-links "$given/wheels" \\
    --constraint "$given/constraints.txt" '@WANTED@'
"$home/venv/bin/python" -m compileall -q "$home/venv/lib" >/dev/null || true
trap - EXIT
"""

PRERM: Final = """#!/bin/sh
set -e
[ "$1" = upgrade ] || rm -rf "${DPKG_ROOT:-}/opt/acus"
"""

COMMAND: Final = '#!/bin/sh\nexec /opt/acus/venv/bin/acus "$@"\n'


def system_packages(script: str) -> list[str]:
    """Return what tools/install-system lets a trainer need, by Debian's names."""
    head = script.partition("if [ ")[0]
    found = re.findall(r"^need (\S+) (\S+)", script.partition("= tests ]; then")[0], flags=re.M)
    fonts = re.findall(r'missing="\$missing (fonts-\S+)"', script)
    if not found or "need()" not in head:
        raise ValueError("tools/install-system has no lines `need LIBRARY PACKAGE`")
    return [package for _, package in found if not package.startswith("python3")] + fonts


def _write(path: Path, text: str, mode: int = 0o644) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    path.chmod(mode)


def tree(folder: Path, wheels: Iterable[Path], wanted: str, version: str, machine: str) -> None:
    """Lay out what the package holds.

    Args:
        folder: empty; becomes the package's root.
        wheels: the program's and those of all that it needs.
        wanted: what pip installs of them, such as `acus[trainer]`.
        version: of the program.
        machine: Debian's name of the architecture.
    """
    home = folder / HOME
    (home / "wheels").mkdir(parents=True)
    for wheel in wheels:
        shutil.copyfile(wheel, home / "wheels" / wheel.name)
    shutil.copyfile(ROOT / "constraints.txt", home / "constraints.txt")
    _write(folder / "usr/bin/acus", COMMAND, 0o755)
    menu = (ROOT / "resources" / "acus.desktop").read_text(encoding="utf-8")
    _write(folder / "usr/share/applications/acus.desktop", menu)
    icon = (ROOT / "resources" / "icons" / "acus.svg").read_text(encoding="utf-8")
    _write(folder / "usr/share/icons/hicolor/scalable/apps/acus.svg", icon)
    rights = "\n\n".join((ROOT / name).read_text("utf-8") for name in ("NOTICE", "LICENSE"))
    _write(folder / "usr/share/doc/acus/copyright", rights)
    major, minor = FOR.split(".")
    system = system_packages((ROOT / "tools" / "install-system").read_text(encoding="utf-8"))
    needs = [f"python{FOR}", f"python{FOR}-venv", f"python3 (>= {FOR})"]
    needs.append(f"python3 (<< {major}.{int(minor) + 1})")
    needs += [f"{name} | {name}t64" if name == "libglib2.0-0" else name for name in system]
    size = sum(file.stat().st_size for file in folder.rglob("*") if file.is_file()) // 1024
    control = CONTROL.format(
        version=version, architecture=machine, size=size, needs=", ".join(needs)
    )
    _write(folder / "DEBIAN/control", control)
    script = POSTINST.replace("@FOR@", FOR).replace("@WANTED@", wanted)
    _write(folder / "DEBIAN/postinst", script, 0o755)
    _write(folder / "DEBIAN/prerm", PRERM, 0o755)
    for path in folder.rglob("*"):
        if path.is_dir():
            path.chmod(0o755)


def architecture() -> str:
    """Return Debian's name of this computer's architecture."""
    asked = ["dpkg", "--print-architecture"]
    return subprocess.run(asked, check=True, capture_output=True, text=True).stdout.strip()


def package(wheels: Iterable[Path], wanted: str, version: str, target: Path) -> Path:
    """Make the package in a folder and return its file; wheels are compressed already.

    Raises:
        subprocess.CalledProcessError: if `dpkg-deb` cannot; it has said why.
    """
    machine = architecture()
    file = target / f"acus_{version}_{machine}.deb"
    target.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as place:
        root = Path(place) / "acus"
        root.mkdir()
        tree(root, wheels, wanted, version, machine)
        command = ["dpkg-deb", "--build", "--root-owner-group", "-Znone", str(root), str(file)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return file


def gathered(program: Path, folder: Path) -> list[Path]:
    """Let pip lay the program's wheel and all that it needs, as pinned, into a folder."""
    pip = [sys.executable, "-m", "pip", "download", "--quiet", "--disable-pip-version-check"]
    pinned = ["--constraint", str(ROOT / "constraints.txt"), "--only-binary=:all:"]
    subprocess.run([*pip, *pinned, "--dest", str(folder), f"{program}[trainer]"], check=True)
    return sorted(folder.glob("*.whl"))


def main() -> int:
    """Make the package of the newest wheel in dist/."""
    argparse.ArgumentParser(prog="python -m tools.deb").parse_args()
    programs = sorted(DIST.glob("acus-*.whl"), key=os.path.getmtime)
    if not programs:
        print(f"no wheel in {DIST}: make wheel", file=sys.stderr)
        return 1
    with tempfile.TemporaryDirectory() as folder:
        wheels = gathered(programs[-1], Path(folder))
        version = programs[-1].name.split("-")[1]
        file = package(wheels, "acus[trainer]", version, DIST)
    print(f"wrote {file}: {len(wheels)} wheels, {file.stat().st_size // 2**20} MiB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
