"""Which message belongs to which state: shown while it is true, gone when it is true no more."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import SignalInstance

from app.core.events import Event
from app.views.kit.text import tr
from app.views.shell.feature import Context, Feature
from app.views.shell.message_bar import PAUSE, REFUSAL, ROBOT, MessageBar


def connect_messages(
    context: Context, features: Sequence[Feature], hand_chosen: SignalInstance
) -> None:
    """Let everything that can fail say so at the top of the window.

    Args:
        context: whose parts speak.
        features: speak for themselves, until one of `Feature.over` says more.
        hand_chosen: signal: another hand moves the needle.
    """
    bar, runs, conductor = context.shell.messages, context.runs, context.conductor
    controller, equipment, editor = conductor.controller, context.equipment, context.editors.plan
    ended = controller.finished
    attempt = (controller.worked, controller.began, ended, runs.ready, runs.gone, hand_chosen)
    topics = [(feature.topic, feature.failed, feature.over()) for feature in features]
    for topic, failed, over in (
        *topics,
        ("patient", conductor.failed, ()),
        ("attempt", controller.failed, attempt),
        ("equipment", equipment.failed, (equipment.accepted, ended)),
    ):
        failed.connect(lambda error, topic=topic: bar.show_until(topic, error))
        for signal in over:
            signal.connect(lambda *_, topic=topic: bar.forget(topic))
    for feature in features:
        feature.noted.connect(bar.show_note)
    editor.refused.connect(lambda error: bar.show_until(REFUSAL, error))
    editor.changed.connect(lambda: bar.forget(REFUSAL))
    runs.failed.connect(lambda error: bar.show_until(ROBOT, error))
    runs.unusable.connect(
        lambda why: bar.show_until("laws", tr("A file of your own cannot be used: {why}", why=why))
    )
    for signal in (runs.ready, equipment.accepted):
        signal.connect(lambda *_: bar.forget(ROBOT))
    runs.starting.connect(lambda begun: bar.forget(ROBOT) if begun else None)
    controller.event_seen.connect(lambda event: tell_pause(bar, event))


def tell_pause(bar: MessageBar, event: Event) -> None:
    """Say on every page that the attempt waits, until it goes on or ends."""
    if event.kind == "pause" and "duration_s" not in event.data:
        bar.show_until(PAUSE, event.message)
    elif event.kind == "withdrawal" and "how" not in event.data:
        bar.show_note(event.message)
    elif event.kind in ("pause", "state", "abort"):
        bar.forget(PAUSE)
