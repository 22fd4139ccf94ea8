"""Makes the pictures of the pen's page; part of `make docs-pictures`.

`python -m tools.pen_pictures FOLDER` needs no webcam: a folder of rendered pictures of a pen that
is rocked stands in for it, its true tip beside where the drawing has it.
"""

import os
import sys
import tempfile
from pathlib import Path

import cv2
import numpy as np
from PySide6.QtWidgets import QApplication

from app.compose.desktop import Desktop
from app.compose.live_pen import SIMULATED_WEBCAM, simulated_lens
from app.core.units import MILLIMETRE
from app.mechanisms.profile import load_profile
from app.tracking.pen.body import load_pen
from app.tracking.pen.needle import PenTip
from app.tracking.pen.settings import PenSettings
from app.tracking.simulated.pen import PenRenderer
from app.tracking.simulated.pen_scene import rocked
from app.views.pen.dialog import PenDialog
from app.views.shell.application import start
from tools.robot_pictures import keep, pause, wait

TRUE_TIP_MM = (1.2, -0.8, 176.5)
RATE_HZ = 15.0


def rendered(folder: Path) -> PenSettings:
    """Write the pictures and the lens; return the settings that name them."""
    pen, entry = load_pen("cube"), load_profile("icube").fulcrum
    draw = PenRenderer(
        SIMULATED_WEBCAM.model(),
        pen.body.board(),
        pen.base.board(),
        pen.base.pose(entry),
        pen.body.edge_mm * MILLIMETRE,
    )
    tip = PenTip.of(pen.tip.model_copy(update={"position_mm": TRUE_TIP_MM, "axis": TRUE_TIP_MM}))
    scene, rng = rocked(entry, tip), np.random.default_rng(1)
    (folder / "webcam").mkdir()
    for number in range(300):
        clean = draw.render(scene(number / RATE_HZ)).astype(np.float64)
        noisy = clean + rng.normal(0.0, 3.0, clean.shape[:2])[..., None]
        picture = np.clip(noisy, 0, 255).astype(np.uint8)
        cv2.imwrite(str(folder / "webcam" / f"{number:03d}.jpg"), picture)
    lens = folder / "lens.yaml"
    lens.write_text(simulated_lens().calibration.model_dump_json(), encoding="utf-8")
    return PenSettings(
        source="folder:webcam", size=(640, 480), rate_hz=RATE_HZ, calibration=Path("lens.yaml")
    )


def main(folder: Path) -> None:
    """Make them: while the tip is measured, and when it is measured and kept."""
    folder = folder.resolve()
    application = start(offscreen=True)
    with tempfile.TemporaryDirectory() as place:
        os.chdir(place)  # the folder is shown by its name
        page = PenDialog(rendered(Path(place)), Desktop(), lambda: None, used=False)
        page.show()
        wait(page.tip.begin.isEnabled, 120.0)
        pause(1.0)
        page.tip.begin.click()
        wait(lambda: page.tip.rocking is None or len(page.tip.rocking.covered) > 5, 120.0)
        pause(0.3)
        keep(page, folder / "pen-measuring.png")
        wait(lambda: page.tip.found is not None, 180.0)
        pause(0.5)
        pause(0.2)
        page.tip.save.click()
        wait(page.tip.begin.isEnabled, 120.0)
        pause(2.0)
        keep(page, folder / "pen-used.png")
        page.reject()
        page.closed()()
    QApplication.processEvents()
    application.quit()


if __name__ == "__main__":
    main(Path(sys.argv[1]))
