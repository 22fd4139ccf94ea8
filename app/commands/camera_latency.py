"""`acus camera latency --display`: a patch on the screen blinks, the camera looks at it."""

from __future__ import annotations

import typer


def register(app: typer.Typer) -> None:
    """Add nothing: this file helps `acus camera latency`."""


def measure(side: str) -> None:
    """Open the test for the `left` or `right` camera and keep what the user keeps.

    Raises:
        CameraError: if the camera is simulated, or there is no such side.
        NoDisplayError: without a screen, or with one that is drawn into memory only.
    """
    import os

    from app.compose import Desktop
    from app.tracking.cameras.settings import SIDES, load_settings, save_settings, with_latency
    from app.tracking.errors import CameraError
    from app.views.cameras.latency_dialog import LatencyDialog
    from app.views.shell.application import NoDisplayError, start

    if side not in SIDES:
        raise CameraError(f"there is no {side!r} camera; there are {' and '.join(SIDES)}")
    settings = load_settings()
    if settings.simulated:
        raise CameraError(
            "the cameras are simulated and have no latency to measure; choose real ones with "
            "`acus camera use`"
        )
    if os.environ.get("QT_QPA_PLATFORM") == "offscreen":
        raise NoDisplayError(
            "the test needs a real screen that a camera can look at; there is none"
        )
    application = start()
    dialog = LatencyDialog(settings, side, Desktop(), lambda: None)
    dialog.measured.connect(
        lambda name, found: save_settings(with_latency(settings, name, found.median, found.sd))
    )
    dialog.finished.connect(lambda _: application.quit())
    dialog.show()
    application.exec()
    dialog.closed()()
