"""Work beside the window: what was dropped, cancelled or failed keeps nothing of what it did."""

import gc
import weakref

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QObject

from app.core.errors import AcusError
from app.core.progress import Cancelled, Progress
from app.views.kit.background import BackgroundTask


class Ct:
    """Stands for three hundred megabytes."""

    def __init__(self) -> None:
        self.hu = np.zeros(4)


def begin(parent: QObject, ending: type[Exception] | None, waits: list[bool]) -> tuple:
    ct, told = Ct(), []

    def work(progress: Progress) -> Ct:
        mine = ct
        while not waits[0]:
            progress.report(0.5)
        if ending is not None:
            raise ending("over")
        return mine

    task = BackgroundTask(parent, work, lambda _: told.append("done"), told.append, None).open()
    return weakref.ref(ct), task, told


@pytest.mark.parametrize("ending", [None, AcusError, Cancelled])
def test_a_task_that_is_over_keeps_nothing_of_its_work(application, settle, ending) -> None:
    parent = QObject()
    kept, task, _ = begin(parent, ending, [True])
    assert settle(lambda: not task.is_running())
    settle(timeout=0.1)
    gc.collect()
    assert kept() is None
    assert parent.findChildren(BackgroundTask) == []


def test_a_dropped_task_goes_with_what_it_would_have_brought(application, settle) -> None:
    parent, waits = QObject(), [False]
    kept, task, told = begin(parent, None, waits)
    task.drop()
    waits[0] = True
    task.close()
    settle(timeout=0.1)
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    gc.collect()
    assert kept() is None
    assert told == []
    assert parent.findChildren(BackgroundTask) == []
