"""Where a package of an extra is missing, the error names package and extra, in one wording."""

import re
import sys
import tomllib
from functools import partial
from pathlib import Path

import pytest

from app.core.errors import AcusError
from app.core.extras import not_installed
from app.imaging.pacs.association import network
from app.imaging.structures.extras import extra
from app.planning.arm import search, timing
from app.simulation.arm import mjcf
from app.studies import plot
from app.studies.findings import Figure
from app.studies.references.pinocchio_arm import import_pinocchio
from app.views.sounds.feature import MixerSpeaker

ROOT = Path(__file__).resolve().parents[2]
FIGURE = Figure("x", lambda _: None, (1.0, 1.0))
NEEDED = [
    ("ompl.base", search.import_ompl, "OMPL", "arm"),
    ("ruckig", timing.import_ruckig, "Ruckig", "arm"),
    ("mujoco", mjcf.import_mujoco, "MuJoCo", "arm"),
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
    assert said.endswith(
        f" is not installed; install the extra `{name}`: pip install 'acus[{name}]'"
    )


def test_what_can_be_done_without_it_is_said_last():
    said = str(not_installed(AcusError, "pygame-ce", "gamepad", "choose mouse or tablet"))
    assert said.endswith("pip install 'acus[gamepad]', or choose mouse or tablet")


def test_no_other_file_words_it_and_every_extra_that_is_named_exists():
    known = set(
        tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    )
    assert {name for *_, name in NEEDED} <= known
    elsewhere = [
        str(file.relative_to(ROOT))
        for file in (ROOT / "app").rglob("*.py")
        if re.search(r"pip install 'acus\[", file.read_text(encoding="utf-8"))
        and file.name != "extras.py"
    ]
    assert elsewhere == []
