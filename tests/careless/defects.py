"""Defects that are planted to see that each check finds its own."""

from __future__ import annotations

import re
import time
from collections.abc import Callable
from typing import Any

from PySide6.QtWidgets import QLabel

from app.core.arrays import FloatArray
from app.device.control.kinematics import _AT, Kinematics
from app.views.plan.feature import PlanFeature
from app.views.shell.window import MainWindow


def log(window: MainWindow) -> None:
    """A click on a slice raises."""

    def placed(*_: object) -> None:
        raise RuntimeError("planted: the crosshair moved")

    window.workspace.viewing.cursor_changed.connect(placed)


def void(window: MainWindow) -> None:
    """A hand that moves far at once voids the attempt."""
    bullseye, controller = window.workspace.bullseye, window.conductor.controller

    def moved(pose: object) -> None:
        run = controller.run
        if run is not None and run.trainer.snapshot().state == "inserting":
            run.trainer.abort("planted: the needle ran away faster than a hand moves it")

    bullseye.hand_moved.connect(moved)


def quantity(window: MainWindow) -> None:
    """The bull's-eye says more than the panel."""
    from app.views.exercise import bullseye

    honest = bullseye.lateral

    def more(*arguments: Any, **others: Any) -> str:
        words: str = honest(*arguments, **others)
        return re.sub(r"\d+\.\d", lambda found: f"{1.1 * float(found[0]) + 0.2:.1f}", words)

    bullseye.lateral = more


def patient(window: MainWindow) -> None:
    """The count of scans survives whatever comes after: attempt, exercise, patient."""
    value = window.workspace.exercise_panel.readouts._values["scans"]
    plain, most = value.setText, 0

    def keep(text: str) -> None:
        nonlocal most
        most = max(most, int(text) if text.isdigit() else 0)
        plain(str(most))

    value.setText = keep  # type: ignore[method-assign]


def answer(window: MainWindow) -> None:
    """Every change of the window's width holds it for 1.3 s."""
    window.workspace.arranged.connect(lambda: time.sleep(1.3))


def force(window: MainWindow) -> None:
    """The loop takes the needle for 100 mm longer than it is, and so its lever."""
    honest = Kinematics.stage

    def stage(kinematics: Kinematics) -> tuple[str, Any, FloatArray]:
        name, function, parameters = honest(kinematics)
        parameters[_AT.length] += 0.1
        return name, function, parameters

    Kinematics.stage = stage  # type: ignore[method-assign]


def text(window: MainWindow) -> None:
    """A label of the plan has no room for its words."""
    label = QLabel(
        "A planted label that is wider than its place", window.feature(PlanFeature).panel
    )
    label.setGeometry(4, 4, 60, 16)
    label.show()


DEFECTS: dict[str, Callable[[MainWindow], None]] = {
    "log": log, "void": void, "quantity": quantity, "patient": patient, "answer": answer,
    "force": force, "text": text,
}  # fmt: skip
"""One for each check, by its name."""
