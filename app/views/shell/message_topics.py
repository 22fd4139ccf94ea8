"""Which message belongs to which state: shown while it is true, gone when it is true no more."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.core.events import Event
from app.views.kit.text import tr
from app.views.shell.message_bar import PAUSE, REFUSAL, ROBOT, MessageBar

if TYPE_CHECKING:
    from app.views.shell.window import MainWindow


class MessageTopics:
    """Connects what the window's parts say to its message bar.

    Args:
        window: whose parts and bar; everything in it is there.
    """

    def __init__(self, window: MainWindow) -> None:
        self._bar = window.message_bar
        self._failures(window)
        self._states(window)
        self._notes(window)

    def _failures(self, window: MainWindow) -> None:
        """Show what went wrong in a part until the part goes on."""
        controller, ended = window.conductor.controller, window.conductor.controller.finished
        runs, editor, pages = window.runs, window.editor, window.pages.currentChanged
        hand = window.workspace.bullseye.source.chosen
        for topic, failed, over in (
            ("ct", window.open_ct.failed, (window.open_ct.opened,)),
            ("patient", window.conductor.failed, ()),
            ("structures", window.structures.failed, (window.structures.book.changed,)),
            ("paths", window.paths.failed, (editor.changed,)),
            ("measure", window.measuring.failed, (window.measuring.noted,)),
            ("plan", window.plan_files.failed, (window.plan_files.noted,)),
            ("debrief", window.debrief.failed, (window.debrief.saved, pages)),
            ("attempt", controller.failed,
             (controller.worked, controller.began, ended, runs.ready, runs.gone, hand)),
            ("robot", window.robot.failed, (window.robot.accepted, ended)),
            ("cameras", window.cameras.failed, (window.cameras.accepted, ended)),
            ("pen", window.pen.failed, (window.pen.changed, ended)),
            ("checks", window.checks.failed, (window.checks.noted, editor.changed, ended)),
        ):  # fmt: skip
            failed.connect(lambda error, topic=topic: self._bar.show_until(topic, error))
            for signal in over:
                signal.connect(lambda *_, topic=topic: self._bar.forget(topic))

    def _states(self, window: MainWindow) -> None:
        bar, runs = self._bar, window.runs
        window.editor.refused.connect(lambda error: bar.show_until(REFUSAL, error))
        window.editor.changed.connect(lambda: bar.forget(REFUSAL))
        runs.failed.connect(lambda error: bar.show_until(ROBOT, error))
        runs.unusable.connect(
            lambda why: bar.show_until(
                "laws", tr("A force law of your own cannot be used: {why}", why=why)
            )
        )
        for signal in (runs.ready, window.robot.accepted, window.cameras.accepted):
            signal.connect(lambda *_: bar.forget(ROBOT))
        runs.starting.connect(lambda begun: bar.forget(ROBOT) if begun else None)
        window.conductor.controller.event_seen.connect(lambda event: tell_pause(bar, event))

    def _notes(self, window: MainWindow) -> None:
        for noted in (
            window.plan_files.noted,
            window.measuring.noted,
            window.checks.noted,
            window.pen.noted,
        ):
            noted.connect(self._bar.show_note)
        window.debrief.saved.connect(
            lambda path: self._bar.show_note(tr("Saved {name}", name=path))
        )


def tell_pause(bar: MessageBar, event: Event) -> None:
    """Say on every page that the attempt waits, until it goes on or ends."""
    if event.kind == "pause" and "duration_s" not in event.data:
        bar.show_until(PAUSE, event.message)
    elif event.kind == "withdrawal" and "how" not in event.data:
        bar.show_note(event.message)
    elif event.kind in ("pause", "state", "abort"):
        bar.forget(PAUSE)
