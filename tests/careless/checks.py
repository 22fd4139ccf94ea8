"""What must hold after whatever a user did: seven checks through the program's own objects."""

from __future__ import annotations

import logging
import math
import os
import re
import sys
import threading
import time
import traceback
import warnings
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PySide6.QtCore import QObject, QTimer, QtMsgType, qInstallMessageHandler
from PySide6.QtWidgets import QLabel

from app.core import state_vector as sv
from app.core.language import ENGLISH
from app.session.header import TRASH
from app.session.machine import RUNNING
from app.session.recording import read_recording
from app.session.result import AttemptResult
from app.views.kit.language import chosen, code_for
from app.views.shell.language import Rebuilding
from app.views.shell.window import MainWindow
from tests.careless.texts import all_windows, cut_texts

ANSWER_S = 1.0
"""Longest that the window may keep its user waiting [s], where the machine does nothing else."""
BEAT_MS = 20
FORCE_SLACK = 1.01
USERS_OWN = re.compile(r"by the user|closed|another (patient|exercise|CT)|not begun", re.IGNORECASE)
"""Reasons of an abort that a user asked for; any other one voided the attempt."""
QUIET = (
    "This plugin does not support",
    "QXcbConnection: XCB error",
    "propagateSizeHints",
    "Could not find any platform",
    "Unable to detect a web browser",
)


@dataclass(frozen=True, slots=True)
class Failure:
    """One check that failed.

    Attributes:
        check: its name: log, void, quantity, patient, answer, force, text.
        words: what was found.
    """

    check: str
    words: str


class Checks(QObject):
    """Watches the window that stands, which another language replaces; lives on its thread."""

    def __init__(self, holder: Rebuilding, stacks: Path, answer_s: float = ANSWER_S) -> None:
        super().__init__(holder)
        self._answer_s = answer_s
        self._holder, self._heard = holder, holder.window
        self._found: list[Failure] = []
        self._labels: set[str] = set()
        self._beat = time.monotonic()
        self._slowest = self._felt = self._true = 0.0
        self._stated = ""
        self._file, self._stacks = stacks, ""
        self._listen()
        self._timer = QTimer(self, interval=BEAT_MS)
        self._timer.timeout.connect(self._look)
        self._timer.start()
        self._hear_of_attempts()
        threading.Thread(target=self._watch, name="careless-stacks", daemon=True).start()

    @property
    def _window(self) -> MainWindow:
        return self._holder.window

    def _hear_of_attempts(self) -> None:
        self._heard = self._window
        self._heard.conductor.controller.finished.connect(self._finished)

    def after(self) -> list[Failure]:
        """Return what failed since the last call, and what does not hold now."""
        begin = time.monotonic()
        found, self._found = self._found, []
        if self._slowest > self._answer_s:
            load = os.getloadavg()[0]
            words = f"the window did not answer for {self._slowest:.1f} s (load {load:.1f})"
            found.append(Failure("answer", f"{words}\n{self._read_stacks()}"))
        if self._stated:
            found.append(Failure("force", self._stated))
        self._slowest, self._stated = 0.0, ""
        found += [Failure("text", words) for window in all_windows() for words in cut_texts(window)]
        found += [Failure("quantity", words) for words in self._quantities()]
        found += [Failure("patient", words) for words in self._other_patient()]
        self._beat += time.monotonic() - begin  # looking takes its own time
        return found

    # --- the log ------------------------------------------------------------------------------
    def _listen(self) -> None:
        """Hear every exception, warning and message of this process."""

        def uncaught(kind: type[BaseException], error: BaseException, trace: object) -> None:
            words = "".join(traceback.format_exception(kind, error, trace))  # type: ignore[arg-type]
            self._say("log", words)

        sys.excepthook = uncaught
        threading.excepthook = lambda told: uncaught(
            told.exc_type, told.exc_value or told.exc_type(), told.exc_traceback
        )
        sys.unraisablehook = lambda told: uncaught(
            told.exc_type, told.exc_value or told.exc_type(), told.exc_traceback
        )
        warnings.simplefilter("always")
        warnings.showwarning = lambda message, kind, file, line, *_: self._say(
            "log", f"{kind.__name__}: {message} ({file}:{line})"
        )
        handler = logging.Handler(logging.WARNING)
        handler.emit = lambda record: self._say("log", record.getMessage())  # type: ignore[method-assign]
        logging.getLogger().addHandler(handler)
        bad = (QtMsgType.QtWarningMsg, QtMsgType.QtCriticalMsg, QtMsgType.QtFatalMsg)
        qInstallMessageHandler(
            lambda kind, _, words: self._say("log", f"Qt: {words}") if kind in bad else None
        )

    def _say(self, check: str, words: str) -> None:
        if not any(quiet in words for quiet in QUIET):
            self._found.append(Failure(check, words.strip()))

    # --- the heartbeat and the force ----------------------------------------------------------
    def _look(self) -> None:
        if self._heard is not self._window:
            self._hear_of_attempts()
        now = time.monotonic()
        self._slowest, self._beat = max(self._slowest, now - self._beat), now
        run = self._window.conductor.controller.run
        device = None if run is None else run.trainer.snapshot().device
        row = getattr(device, "row", None)
        if run is None or row is None:
            return
        if row[sv.HOLDING] > 0.5:  # winches that hold push nobody: a hand feels its own push
            return
        cap = float(row[sv.FORCE_CAP])
        limit = min(run.profile.limits.hand_force, cap if cap > 0.0 else math.inf)
        felt = math.hypot(*(float(row[slot]) for slot in (sv.FELT_X, sv.FELT_Y, sv.FELT_Z)))
        outside = run.profile.geometry.needle_length - float(row[sv.PLANT_DEPTH])
        true = felt * float(row[sv.L_OUT]) / outside if not run.is_real and outside > 0 else 0.0
        if not max(felt, true) <= limit * FORCE_SLACK:
            depth = 1e3 * float(row[sv.PLANT_DEPTH])
            self._stated = (
                f"{felt:.2f} N stated, {true:.2f} N true at {depth:.0f} mm, limit {limit:.2f} N"
            )

    def _watch(self) -> None:
        """Note what every thread is at when the window does not answer; the window's comes last.

        With the interpreter's lock, which `faulthandler` does without, and crashed at times; and
        without keeping a frame: a painter that one holds would outlive its painting.
        """
        told, main = 0.0, threading.main_thread().ident
        while True:
            time.sleep(0.05)
            beat = self._beat
            if beat != told and time.monotonic() - beat > 0.8 * self._answer_s:
                told = beat
                stacks = sorted(_stacks(), key=lambda item: item[0] == main)
                self._stacks = "\n".join(
                    "".join(traceback.format_list(stack)) for _, stack in stacks
                )
                self._file.write_text(self._stacks)

    def _read_stacks(self) -> str:
        """Return what was noted last, once."""
        words, self._stacks = self._stacks, ""
        return words

    # --- attempts -----------------------------------------------------------------------------
    def _finished(self, result: AttemptResult) -> None:
        summary = result.summary
        if summary.state == "aborted" and not USERS_OWN.search(summary.reason or ""):
            self._say("void", f"an attempt was voided: {summary.reason}")
        if result.record is not None and result.trajectory is not None:
            begin = time.monotonic()
            record = result.record
            if not record.exists():  # deleted in the list before its debrief was there
                record = record.parent / TRASH / record.name
            kept, shown = read_recording(record).trajectory(), result.trajectory
            if kept.tip.shape != shown.tip.shape or not np.allclose(kept.tip, shown.tip, atol=1e-6):
                self._say("quantity", "the record has another way of the tip than the debrief")
            self._beat += time.monotonic() - begin

    # --- one value per quantity ---------------------------------------------------------------
    def _quantities(self) -> list[str]:
        """Compare what panel, bull's-eye and slices say of one snapshot."""
        controller, workspace = self._window.conductor.controller, self._window.workspace
        run = controller.run
        if run is None or not run.shown.live:
            return []
        controller._display._figures_time = -1.0  # the panel's figures are due
        controller.poll()
        said, is_english = [], code_for(chosen(self._window.settings)) == ENGLISH
        panel, pad = workspace.exercise_panel.readouts, workspace.bullseye
        labels = {"lateral": pad._lateral, "to_target": pad._remaining}
        for name, label in labels.items():
            if not label.isVisible():  # it is written again before it is shown
                continue
            text = label.text()
            mine, other = _number(panel.text(name)), _number(text)
            if "too deep" in text or "at target" in text:  # told with the sign of too deep
                other = None if other is None else -other
            if mine is not None and other is not None and not is_english:
                mine, other = abs(mine), abs(other)  # which side is in words
            if mine is not None and other is not None and abs(mine - other) > 0.051:
                said.append(f"{name}: the panel says {mine}, the bull's-eye {other}")
        return said

    # --- patients -----------------------------------------------------------------------------
    def _other_patient(self) -> list[str]:
        window = self._window
        conductor, workspace = window.conductor, window.workspace
        patient, run = conductor.patient, conductor.controller.run
        if patient is None:
            return []
        said = []
        snapshot = None if run is None else run.trainer.snapshot()
        if workspace.viewing.volume is not patient.volume:
            said.append("the slices show another volume than the patient's")
        if run is None and workspace.viewing.needle is not None:
            said.append("a needle is shown, but nothing runs")
        runs = snapshot is not None and snapshot.state in RUNNING
        judged = runs or window.editor.verdict.placed is not None  # else Start says what is missing
        if run is not None and judged and run.placed.plan != _plan_of(window):
            said.append("the run has another plan than the editor")
        scans = workspace.exercise_panel.readouts.text("scans")
        if scans.isdigit() and int(scans) > (0 if snapshot is None else snapshot.scans):
            said.append(f"{scans} control scans are shown, there are none")
        name = patient.label
        for old in self._labels - {name}:
            for label in workspace.findChildren(QLabel):
                if label.isVisible() and old and old in label.text():
                    said.append(f"{label.text()!r} tells of {old}, {name} is open")
        self._labels.add(name)
        return said


def _stacks() -> list[tuple[int, list[tuple[str, int, str, None]]]]:
    """Where every thread is, oldest call first, by its number; no other thread runs meanwhile."""
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1.0)
    try:
        found = []
        for thread, frame in sys._current_frames().items():
            stack: list[tuple[str, int, str, None]] = []
            while frame is not None:
                code = frame.f_code
                stack.append((code.co_filename, frame.f_lineno, code.co_name, None))
                frame = frame.f_back
            found.append((thread, stack[::-1]))
        return found
    finally:
        del frame
        sys.setswitchinterval(interval)


def _plan_of(window: MainWindow) -> object:
    draft = window.editor.edit.draft
    return draft.plan() if draft.complete else None


def _number(text: str) -> float | None:
    found = re.search(r"[-+]?\d+(?:\.\d+)?", text.replace("−", "-").replace(",", "."))
    return float(found.group()) if found else None
