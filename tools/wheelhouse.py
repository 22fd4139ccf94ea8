"""Make folders from which the trainer installs without a network, zipped: `make wheelhouse`.

One for each system and version of Python, dist/acus-VERSION-SYSTEM-pyVERSION.zip: the wheels of the
trainer in the pinned versions, `SHA256SUMS`, and a script (`install.bat`, `install.sh`) that checks
them, makes an environment beside itself of these wheels alone, and says how to start.

pip reads a package's markers (such as `sys_platform == "win32"`) for the computer that it runs on;
what only the other system needs is therefore named in `ONLY_THERE`, and asked for besides.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import re
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).resolve().parents[1]
DIST: Final = ROOT / "dist"
PYTHON: Final = "3.13"
STAMP: Final = (1980, 1, 1, 0, 0, 0)


@dataclass(frozen=True, slots=True)
class System:
    """A system that a folder is for.

    Attributes:
        platforms: pip's names of it, the newest first.
        script: name of what installs.
        text: of it; {python} and {version} are filled in.
        only_there: packages that are needed there and not here.
    """

    platforms: tuple[str, ...]
    script: str
    text: str
    only_there: tuple[str, ...] = ()


BAT: Final = r"""@echo off
rem Installs Acus {version} into the folder acus-venv beside this file, without a network.
setlocal
cd /d "%~dp0"
py -{python} -c "import struct; raise SystemExit(struct.calcsize('P') != 8)" || (
    echo Acus needs Python {python}, 64 bit, with its launcher py: install it, and start this again.
    exit /b 1
)
py -{python} check.py || exit /b 1
py -{python} -m venv acus-venv || exit /b 1
acus-venv\Scripts\python.exe -m pip install --quiet --disable-pip-version-check --isolated ^
    --no-index --find-links wheels --constraint constraints.txt "acus[trainer]" || exit /b 1
echo Installed. Start it by: "%~dp0acus-venv\Scripts\acus.exe" run
"""

SHELL: Final = """#!/bin/sh
# Installs Acus {version} into the folder acus-venv beside this file, without a network.
set -eu
cd "$(dirname "$0")"
python=python{python}
command -v "$python" >/dev/null || {{
    echo "Acus needs Python {python}: install it, and start this again." >&2
    exit 1
}}
"$python" check.py
"$python" -m venv acus-venv
acus-venv/bin/python -m pip install --quiet --disable-pip-version-check --isolated \\
    --no-index --find-links wheels --constraint constraints.txt 'acus[trainer]'
echo "Installed. Start it by: $(pwd)/acus-venv/bin/acus run"
"""

CHECK: Final = '''"""Checks that the wheels here are those that were packed."""

import hashlib
import pathlib
import sys

here = pathlib.Path(__file__).resolve().parent
wrong = []
for line in (here / "SHA256SUMS").read_text(encoding="utf-8").splitlines():
    wanted, name = line.split("  ", 1)
    file = here / name
    if not file.is_file() or hashlib.sha256(file.read_bytes()).hexdigest() != wanted:
        wrong.append(name)
if wrong:
    sys.exit("damaged or missing, so nothing is installed: " + ", ".join(wrong))
'''

SYSTEMS: Final[Mapping[str, System]] = {
    "windows-x86_64": System(("win_amd64",), "install.bat", BAT, ("colorama", "tzdata")),
    "macos-arm64": System(
        tuple(f"macosx_{major}_0_arm64" for major in (14, 13, 12, 11)), "install.sh", SHELL
    ),
}


def sums(files: Mapping[str, bytes]) -> str:
    """Return a line `SHA-256, two spaces, name` of each file, as `sha256sum --check` reads it."""
    return "".join(
        f"{hashlib.sha256(content).hexdigest()}  {name}\n" for name, content in files.items()
    )


def packed(wheels: Iterable[Path], system: System, version: str, python: str, out: Path) -> Path:
    """Write the zip of a system; wheels are compressed already.

    Args:
        wheels: the program's and those of all that it needs there.
        system: that they are for.
        version: of the program.
        python: minor version that the wheels are for.
        out: the zip.
    """
    content = {f"wheels/{wheel.name}": wheel.read_bytes() for wheel in sorted(wheels)}
    content["constraints.txt"] = (ROOT / "constraints.txt").read_bytes()
    content["check.py"] = CHECK.encode()
    for name in ("LICENSE", "NOTICE"):
        content[name] = (ROOT / name).read_bytes()
    script = system.text.format(python=python, version=version)
    ends = "\r\n" if system.script.endswith(".bat") else "\n"
    content[system.script] = script.replace("\n", ends).encode()
    content["SHA256SUMS"] = sums(content).encode()
    out.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(out, "w", zipfile.ZIP_STORED) as archive:
        for name, data in content.items():
            entry = zipfile.ZipInfo(f"{out.stem}/{name}", STAMP)
            entry.external_attr = (0o755 if name.endswith(".sh") else 0o644) << 16
            archive.writestr(entry, data)
    return out


def pinned(names: Iterable[str], constraints: str) -> list[str]:
    """Return packages with their versions, where they are pinned."""
    found = dict(re.findall(r"^([A-Za-z0-9_.-]+)==(\S+)", constraints, flags=re.M))
    return [f"{name}=={found[name]}" if name in found else name for name in names]


def gathered(program: Path, system: System, python: str, folder: Path) -> list[Path]:
    """Let pip lay the program's wheel and all that it needs there, as pinned, into a folder.

    Raises:
        subprocess.CalledProcessError: if a wheel is missing; pip has said which.
    """
    pip = [sys.executable, "-m", "pip", "download", "--quiet", "--disable-pip-version-check"]
    where = [part for name in system.platforms for part in ("--platform", name)]
    pins = ["--constraint", str(ROOT / "constraints.txt"), "--only-binary=:all:"]
    also = pinned(system.only_there, (ROOT / "constraints.txt").read_text(encoding="utf-8"))
    wanted = [f"{program}[trainer]", *also]
    subprocess.run(
        [*pip, *where, "--python-version", python, *pins, "--dest", str(folder), *wanted],
        check=True,
    )
    return sorted(folder.glob("*.whl"))


def main() -> int:
    """Make the zips of the newest wheel in dist/."""
    parser = argparse.ArgumentParser(prog="python -m tools.wheelhouse")
    parser.add_argument("--system", choices=sorted(SYSTEMS), action="append", help="of these alone")
    parser.add_argument("--python", default=PYTHON, help="minor version that it is for")
    asked = parser.parse_args()
    programs = sorted(DIST.glob("acus-*.whl"), key=os.path.getmtime)
    if not programs:
        print(f"no wheel in {DIST}: make wheel", file=sys.stderr)
        return 1
    version = programs[-1].name.split("-")[1]
    for name in asked.system or SYSTEMS:
        out = DIST / f"acus-{version}-{name}-py{asked.python}.zip"
        with tempfile.TemporaryDirectory() as folder:
            wheels = gathered(programs[-1], SYSTEMS[name], asked.python, Path(folder))
            packed(wheels, SYSTEMS[name], version, asked.python, out)
        digest = hashlib.sha256(out.read_bytes()).hexdigest()
        size = out.stat().st_size // 2**20
        print(f"wrote {out}: {len(wheels)} wheels, {size} MiB, SHA-256 {digest}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
