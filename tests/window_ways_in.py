"""Every way of a CT into the real window, everything it logs or warns kept: for leak tests.

`python -m tests.window_ways_in CT_FOLDER BROKEN_FOLDER OUT`: opens the CT in place, imports it, and
lets every way in fail once with a folder of broken files. The log of all packages at its most
talkative goes to `OUT/window.log`; what is shown to the user does not.
"""

import logging
import sys
import time
from pathlib import Path

from PySide6.QtWidgets import QApplication, QDialog

from app.compose.desktop import Desktop
from app.planning.paths import demonstration_plan
from app.views.series.feature import SeriesFeature
from app.views.shell.application import start
from app.views.shell.window import MainWindow

PATIENCE_S = 550.0
"""A first start compiles every kernel [s]."""


def wait(until, seconds: float = PATIENCE_S) -> None:
    """Let the window live until something is so."""
    end = time.monotonic() + seconds
    while not until():
        if time.monotonic() > end:
            raise TimeoutError("the window did not get there")
        QApplication.processEvents()
        time.sleep(0.005)


def open_in_place(window: MainWindow, ct: Path) -> None:
    """Open the CT where it lies, and plan on it."""
    window.open_ct.open_folder(ct)
    wait(lambda: window.conductor.patient is not None)
    patient = window.conductor.patient
    window.editor.start(demonstration_plan(patient.volume, patient.body))
    wait(lambda: window.conductor.controller.run is not None)


def take_in(window: MainWindow, ct: Path) -> None:
    """Import the CT through the dialogs."""
    intake = window.feature(SeriesFeature).library.intake
    window.feature(SeriesFeature).library.import_from(ct)
    wait(lambda: intake.mask is not None)
    intake.mask.take.click()
    wait(lambda: intake.report is not None)
    intake.report.reject()


def fail(window: MainWindow, broken: Path) -> int:
    """Open and import what cannot be; return how often that was said, in the bar or a browser."""
    told: list[object] = []
    window.open_ct.failed.connect(told.append)
    window.feature(SeriesFeature).library.failed.connect(told.append)
    for begin in (window.open_ct.open_folder, window.feature(SeriesFeature).library.import_from):
        for path in sorted(broken.iterdir()):
            count = len(told)
            begin(path)
            wait(lambda count=count: len(told) > count or browser() is not None)
            if (dialog := browser()) is not None:
                told.append(dialog)
                dialog.reject()
    return len(told)


def browser() -> QDialog | None:
    """Return the browser of series, if one is open."""
    found = QApplication.activeModalWidget()
    return found if isinstance(found, QDialog) else None


def main(ct: Path, broken: Path, out: Path) -> None:
    """Leave `window.log` in `out`."""
    out.mkdir(parents=True, exist_ok=True)
    logging.basicConfig(filename=out / "window.log", level=logging.DEBUG)
    logging.getLogger("numba").setLevel(logging.WARNING)  # it would write every step of compiling
    logging.captureWarnings(True)
    logging.getLogger(__name__).info("the log is open")
    application = start(offscreen=True)
    window = MainWindow(Desktop(sessions=out / "sessions"))
    window.show()
    open_in_place(window, ct)
    take_in(window, ct)
    print(f"{fail(window, broken)} failures")
    window.editor.saved(Path("kept"))
    window.close()
    application.quit()


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3]))
