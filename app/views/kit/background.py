"""Long work beside the window: a plain thread works, the window's own timer polls it.

The worker touches no Qt object, so nothing can be destroyed under it and every callback runs on the
window's thread.
"""

import logging
import threading
import traceback
from collections.abc import Callable
from typing import Any, Protocol, TypeVar

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtWidgets import QProgressDialog, QWidget

from app.core.progress import Cancelled, Progress
from app.views.kit.text import literal, tr, translated

T = TypeVar("T")
POLL_MS = 30
DIALOG_AFTER_MS = 500

_log = logging.getLogger(__name__)


class Indicator(Protocol):
    """Something that shows running tasks, such as the window's progress strip."""

    def show_task(self, task: "BackgroundTask", title: str) -> None:
        """Follow the task's signals until `finished`; offer `task.cancel`."""
        ...


_Callbacks = tuple[
    Callable[[Any], object], Callable[[Exception], object], Callable[[], object] | None
]


def _nothing(_: object) -> None:
    """Call of a task that has delivered."""


class BackgroundTask(QObject):
    """One piece of work in its thread; lives on, and reports to, the window's thread.

    Signals:
        progressed(float, str): fraction in [0, 1] and what is being done.
        finished(): the work ended, whichever way; comes after the callback.
    """

    progressed = Signal(float, str)
    finished = Signal()

    def __init__(
        self,
        parent: QObject,
        operation: Callable[[Progress], T],
        on_success: Callable[[T], object],
        on_error: Callable[[Exception], object],
        on_cancel: Callable[[], object] | None = None,
    ) -> None:
        super().__init__(parent)
        self._callbacks: _Callbacks = (on_success, on_error, on_cancel)
        self._box = _Outcome(operation)
        self._reported: tuple[float, str] | None = None
        self._is_running = False
        self._timer = QTimer(self, interval=POLL_MS)
        self._timer.timeout.connect(self._poll)
        box = self._box  # not self: the worker must not keep the Qt object alive
        self.destroyed.connect(lambda: box.progress.cancel())
        self._thread = threading.Thread(target=self._box.run, name="acus-background", daemon=True)

    def open(self) -> "BackgroundTask":
        """Start the thread and the looking."""
        self._is_running = True
        self._timer.start()
        self._thread.start()
        return self

    def cancel(self) -> None:
        """Ask the work to stop at its next report; `on_cancel` follows."""
        self._box.progress.cancel()

    def is_running(self) -> bool:
        """Return whether the callback is still to come."""
        return self._is_running

    def drop(self) -> None:
        """Cancel and call nobody back, without waiting: for work that other work replaces."""
        self.cancel()
        if self._is_running:  # else Qt may have deleted it already
            self._is_running = False
            self._timer.stop()
            self._callbacks = (_nothing, _nothing, None)
            self._box = _Outcome(_nothing)  # what it was to bring may be a whole patient
            self.finished.emit()  # whoever shows it lets go of it
            self.deleteLater()

    def close(self, timeout: float = 2.0) -> None:
        """Drop it and wait up to `timeout` [s] for the thread, when a window ends; idempotent."""
        self.drop()
        if self._thread.is_alive():
            self._thread.join(timeout)

    def _poll(self) -> None:
        done = self._box.done.is_set()
        report = self._box.report
        if report is not None and report != self._reported:
            self._reported = report
            fraction, text = report
            self.progressed.emit(fraction, translated(text))  # a signal's text is a plain one
        if done:
            self._is_running = False
            self._timer.stop()
            self._deliver()

    def _deliver(self) -> None:
        on_success, on_error, on_cancel = self._callbacks
        # A callback may hold the last reference to the parent. Let go of together with this
        # object it would have the parent destroy this object once more, in its own destructor.
        self._callbacks = (_nothing, _nothing, None)
        box, self._box = self._box, _Outcome(_nothing)
        error, result = box.error, box.result
        box.result = box.error = None  # in a reference cycle, perhaps with a whole patient
        try:
            if error is None:
                on_success(result)
            elif not isinstance(error, Cancelled):
                on_error(error)
            elif on_cancel is not None:
                on_cancel()
        finally:
            self.finished.emit()
            self.deleteLater()


class _Outcome:
    """What worker and window share: each attribute is written by the worker only."""

    def __init__(self, operation: Callable[[Progress], Any]) -> None:
        self._operation = operation
        self.report: tuple[float, str] | None = None
        self.result: Any = None
        self.error: Exception | None = None
        self.done = threading.Event()
        self.progress = Progress(self._listen)

    def _listen(self, fraction: float, text: str) -> None:
        self.report = (fraction, text)

    def run(self) -> None:
        """Work, keep the result or the error, and say so last."""
        try:
            self.result = self._operation(self.progress)
        except Cancelled as error:
            self.error = _without_frames(error)
        except Exception as error:  # handed to on_error on the window's thread
            # Where it failed, not its message: that may hold a path with a patient's name.
            where = "".join(traceback.format_tb(error.__traceback__))
            _log.info("background work failed: %s\n%s", type(error).__name__, where)
            self.error = _without_frames(error)
        finally:
            self._operation = _nothing
            self.done.set()


def _without_frames(error: Exception) -> Exception:
    """Return an error that keeps nothing of what its frames worked on: a CT has 300 MB."""
    one: BaseException | None = error
    while one is not None:
        one.__traceback__ = None
        one = one.__cause__ or one.__context__
    return error


def run_in_background(
    parent: QObject,
    operation: Callable[[Progress], T],
    on_success: Callable[[T], object],
    on_error: Callable[[Exception], object],
    on_cancel: Callable[[], object] | None = None,
    *,
    title: str = "",
    indicator: Indicator | None = None,
) -> BackgroundTask:
    """Run `operation(progress)` beside the window.

    Args:
        parent: the callbacks die with it, and its end cancels the work.
        operation: runs in another thread; must touch nothing of Qt; reports to `progress`, which
            raises `Cancelled` after a cancel.
        on_success: gets the result, on the window's thread.
        on_error: gets the exception, on the window's thread.
        on_cancel: called on the window's thread when the user stopped the work.
        title: what is being done; shown by `indicator`, or else in a dialog that appears when the
            work lasts. Without a title the work is silent.
        indicator: a strip in the window instead of the dialog.
    """
    task = BackgroundTask(parent, operation, on_success, on_error, on_cancel)
    if indicator is not None:
        indicator.show_task(task, title)
    elif title:
        _show_dialog(task, title, parent if isinstance(parent, QWidget) else None)
    return task.open()


def _show_dialog(task: BackgroundTask, title: str, parent: QWidget | None) -> None:
    dialog = QProgressDialog(literal(title), tr("Cancel"), 0, 1000, parent)
    dialog.setMinimumDuration(DIALOG_AFTER_MS)
    dialog.setAutoReset(False)
    dialog.setWindowTitle(title)

    def follow(fraction: float, text: str) -> None:
        dialog.setLabelText(literal(f"{title}\n{text}" if text else title))
        dialog.setValue(int(1000 * fraction))

    def end() -> None:
        dialog.reset()
        dialog.deleteLater()

    task.progressed.connect(follow)
    task.finished.connect(end)
    dialog.canceled.connect(task.cancel)
