"""Makes the pictures of README and docs: `make docs-pictures`."""

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PICTURES = ROOT / "docs" / "pictures"
DATA = Path(os.environ.get("ACUS_TEST_DATA", ROOT.parent / "shared" / "data"))
CHEST = DATA / "ct_chest_lidc0314"

FROM_DEMO = {
    "1-plan": "plan",
    "3-inserting": "inserting",
    "3-bullseye": "bullseye",
    "3-cameras": "cameras",
    "4-at-the-target": "at-the-target",
    "5-debrief": "debrief",
    "6-sessions": "sessions",
}


def acus(*arguments: str | Path) -> None:
    """Run the command line, its output to the terminal."""
    subprocess.run([sys.executable, "-m", "app", *map(str, arguments)], check=True, cwd=ROOT)


FROM_CHEST = ("3-inserting", "4-at-the-target")


def demonstration(name: str, moments: Iterable[str], *arguments: str | Path) -> None:
    """Run a demonstration and keep some of its pictures as docs/pictures/<name>-<moment>.png."""
    with tempfile.TemporaryDirectory() as folder:
        acus("demo", "--headless", "--out", folder, *arguments)
        for moment in moments:
            kept = PICTURES / f"{name}-{FROM_DEMO[moment]}.png"
            shutil.copyfile(Path(folder) / f"{moment}.png", kept)


def studies() -> None:
    """Keep each study's pictures as docs/pictures/study-<name>[-<figure>].png."""
    from app.studies.runner import study_names

    for name in study_names():
        with tempfile.TemporaryDirectory() as folder:
            acus("study", name, "--out", folder)
            for picture in Path(folder).rglob("*.png"):
                shutil.copyfile(picture, PICTURES / f"study-{picture.name}")


def own_settings(module: str) -> None:
    """Let a module of `tools` keep its pictures, with settings of their own.

    The window is a technician's, who has all that can be shown, but on the student's way.
    """
    students = ("tools.student_pictures", "tools.film_pictures")
    role = "student" if module in students else "technician"
    with tempfile.TemporaryDirectory() as folder:
        own = {"ACUS_SETTINGS": f"{folder}/settings", "ACUS_DATA": f"{folder}/data"}
        own["ACUS_ROLE"] = role
        order = [sys.executable, "-m", module, str(PICTURES)]
        subprocess.run(order, check=True, cwd=ROOT, env=os.environ | own)


def drop_unshown() -> None:
    """Remove pictures that no page shows: some scripts make more than there is room for."""
    pages = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    shown = "".join(page.read_text(encoding="utf-8") for page in pages)
    for picture in sorted(PICTURES.glob("*.png")):
        if f"pictures/{picture.name}" not in shown:
            picture.unlink()


def main() -> None:
    """Make them all; without the shared data the chest's are left as they are."""
    PICTURES.mkdir(parents=True, exist_ok=True)
    demonstration("phantom", FROM_DEMO, "--skill", "novice")
    if CHEST.is_dir():
        demonstration("chest", FROM_CHEST, "--ct", CHEST)
    else:
        print(f"no chest CT in {CHEST}: its pictures stay as they are", file=sys.stderr)
    own_settings("tools.robot_pictures")
    own_settings("tools.camera_pictures")
    own_settings("tools.calibration_pictures")
    own_settings("tools.eyes_pictures")
    own_settings("tools.pen_pictures")
    own_settings("tools.reading_pictures")
    own_settings("tools.scene_pictures")
    own_settings("tools.holder_pictures")
    own_settings("tools.debrief_pictures")
    own_settings("tools.student_pictures")
    own_settings("tools.film_pictures")
    studies()
    drop_unshown()


if __name__ == "__main__":
    main()
