"""The live links in the window: a line of the status strip each, and plans that peers send.

A plan of a peer is an instructor's: a student's window has no such feature, and takes none.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from threading import Event
from typing import Any, ClassVar

from PySide6.QtCore import Signal, SignalInstance

from app.core.arrays import FloatArray
from app.core.errors import AcusError
from app.core.units import MILLIMETRE
from app.planning.draft import DraftPlan
from app.planning.plan import Plan
from app.session.machine import RUNNING
from app.session.snapshot import Snapshot
from app.views.kit.roles import STAFF, Role
from app.views.kit.text import tr
from app.views.kit.verdict import StatusItem, Verdict
from app.views.shell.feature import Context, Feature

PATIENCE = 1.0
"""A peer is answered within so long [s]: that the window is busy, if it is."""

_VERDICTS = {"connected": Verdict.GOOD, "waiting": Verdict.IDLE, "troubled": Verdict.WARNING}


@dataclass(slots=True, eq=False)
class _Wish:
    """A plan that a peer sends, LPS [m], and the answer to it."""

    p_entry: FloatArray
    p_target: FloatArray
    answered: Event = field(default_factory=Event)
    refusal: str = ""


class LinksFeature(Feature):
    """Shows the links that were asked for on the command line; without any there is nothing.

    Signals:
        plan_wanted(object): a peer sends a plan; in the window's thread from here on.
    """

    plan_wanted = Signal(object)
    topic: ClassVar[str] = "links"
    place: ClassVar[int] = 105
    roles: ClassVar[frozenset[Role]] = STAFF
    help: ClassVar[str] = "links.md#in-the-window"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._editor, self._runs = context.editors.plan, context.runs
        self._links = [one for one in context.services.watchers if hasattr(one, "statuses")]
        context.conductor.controller.add_items(self.items)
        self.plan_wanted.connect(self._take)
        for links in self._links:
            links.take_plans(self.place_plan)

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self._editor.changed,)

    def close(self) -> None:
        """Take no more plans; idempotent."""
        for links in self._links:
            links.take_plans(None)

    def items(self, snapshot: Snapshot) -> tuple[StatusItem, ...]:
        """Return a line of the status strip for each link."""
        return tuple(link_item(status) for links in self._links for status in links.statuses())

    def place_plan(self, p_entry: FloatArray, p_target: FloatArray) -> str:
        """Take a plan, LPS [m], shape (3,) each; called in the thread of a link.

        Returns why not; empty where it is done.
        """
        wish = _Wish(p_entry, p_target)
        self.plan_wanted.emit(wish)
        return wish.refusal if wish.answered.wait(PATIENCE) else "the window is busy; try again"

    def _take(self, wish: _Wish) -> None:
        wish.refusal = self._refusal(wish)
        wish.answered.set()
        if wish.refusal:
            self.failed.emit(tr("A plan of a live link is refused: {why}", why=wish.refusal))
        else:
            self.noted.emit(tr("A live link has set entry and target."))

    def _refusal(self, wish: _Wish) -> str:
        run = self._runs.run
        if run is not None and run.trainer.snapshot().state in RUNNING:
            return "an attempt is running: its plan cannot change"
        if self.context.conductor.patient is None:
            return "no patient is open"
        edit = self._editor.edit
        try:
            plan = Plan(wish.p_entry / MILLIMETRE, wish.p_target / MILLIMETRE, edit.draft.name)
            self._editor.take(DraftPlan.of(plan), edit.placement)
        except AcusError as error:
            return str(error)
        if self._editor.edit.draft != DraftPlan.of(plan):
            return "the exercise keeps its plan, or its target"
        return ""


def link_item(status: Any) -> StatusItem:
    """Return the line of a link (`exchange.live.journal.LinkReport`)."""
    text = tr("nobody yet")
    if status.peers:
        text = tr("{peers} · {rate:.0f}/s", peers=status.peers, rate=status.rate)
    told = tr(
        "Programs that are connected, and messages a second. It listens at {address}.",
        address=status.address,
    )
    return StatusItem(
        _VERDICTS.get(str(status.health), Verdict.WARNING),
        status.title,
        text,
        f"{told}\n{status.line}" if status.line else told,
        detail=True,
    )
