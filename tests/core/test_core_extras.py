"""Where a package of an extra is missing, the error names package and extra, in one wording."""

import re
import subprocess
import sys
import tomllib
from functools import partial
from pathlib import Path

import pytest

from app.arm.motion import import_ompl, import_ruckig
from app.arm.studies.references.programs import import_pinocchio
from app.core.errors import AcusError
from app.core.extras import install_command, not_installed
from app.imaging.pacs.association import network
from app.imaging.structures.extras import extra
from app.simulation.mjcf import import_mujoco
from app.studies import plot
from app.studies.findings import Figure
from app.views.sounds.feature import MixerSpeaker

ROOT = Path(__file__).resolve().parents[2]
FIGURE = Figure("x", lambda _: None, (1.0, 1.0))
NEEDED = [
    ("ompl.base", import_ompl, "OMPL", "arm"),
    ("ruckig", import_ruckig, "Ruckig", "arm"),
    ("mujoco", partial(import_mujoco, "arm"), "MuJoCo", "arm"),
    ("pinocchio", import_pinocchio, "Pinocchio", "arm"),
    ("pynetdicom", network, "pynetdicom", "pacs"),
    ("nrrd", partial(extra, "nrrd", ".seg.nrrd files"), "nrrd", "structures"),
    ("highdicom", partial(extra, "highdicom", "DICOM SEG files"), "highdicom", "structures"),
    ("nibabel", partial(extra, "nibabel", "NIfTI files"), "nibabel", "nifti"),
    ("matplotlib", partial(plot.draw_figure, FIGURE, Path("x.png")), "matplotlib", "plots"),
    ("pygame", MixerSpeaker, "pygame-ce", "gamepad"),
]


@pytest.mark.parametrize(
    ("module", "use", "package", "name"), NEEDED, ids=[case[0] for case in NEEDED]
)
def test_a_missing_package_is_named_with_its_extra(monkeypatch, module, use, package, name):
    for one in [one for one in sys.modules if one.split(".")[0] == module.split(".")[0]]:
        monkeypatch.delitem(sys.modules, one)
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises((AcusError, OSError)) as refused:
        use()
    said = str(refused.value)
    assert said.startswith(package)
    assert said.endswith(f" is not installed; install the extra `{name}`: make extra NAME={name}")


def test_what_can_be_done_without_it_is_said_last():
    said = str(not_installed(AcusError, "pygame-ce", "gamepad", "choose mouse or tablet"))
    assert said.endswith("make extra NAME=gamepad, or choose mouse or tablet")


def test_every_extra_that_is_named_exists():
    known = set(
        tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    )
    assert {name for *_, name in NEEDED} <= known


def test_nothing_says_that_a_package_index_has_acus():
    """No distribution of that name is published: `pip install 'acus[arm]'` cannot work."""
    places = [ROOT / "README.md", ROOT / "Makefile"]
    for folder, kind in (("app", "*.py"), ("docs", "*.md"), ("resources", "*.yaml")):
        places += (ROOT / folder).rglob(kind)
    said = [
        f"{place.relative_to(ROOT)}: {found}"
        for place in places
        for found in re.findall(r"acus\[\w+\]|pip install acus", place.read_text(encoding="utf-8"))
    ]
    assert said == []


def test_make_installs_an_extra_that_is_named():
    done = subprocess.run(
        ["make", "--dry-run", "extra", "NAME=arm"], cwd=ROOT, capture_output=True, text=True,
        check=True,
    )  # fmt: skip
    assert "--editable '.[arm]'" in done.stdout


def test_outside_a_source_folder_the_packages_of_an_extra_are_named(monkeypatch):
    monkeypatch.setattr("app.core.extras.in_checkout", lambda: False)
    monkeypatch.setattr(
        "app.core.extras.requires",
        lambda _: [
            "numpy>=2",
            'mujoco<4,>=3.3; extra == "arm"',
            "ompl<3; extra == 'arm'",
            "x; extra == 'arms'",
        ],
    )
    assert install_command("arm") == "pip install 'mujoco<4,>=3.3' 'ompl<3'"
    assert "pip install" not in install_command("none"), "a package of that name is a stranger's"


def test_the_versions_of_python_are_those_of_readme():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert project["requires-python"] == ">=3.11,<3.15"
    assert "Python 3.11 to 3.14" in (ROOT / "README.md").read_text()
