"""Why a control cannot be changed, in the student's words."""

from __future__ import annotations

from typing import Final

from app.exercises.guidance import Purpose
from app.exercises.locks import Lock
from app.exercises.parts import ViewName
from app.exercises.schema import Exercise
from app.views.kit.roles import TECHNICIANS, Role
from app.views.kit.text import declared, tr


def why_locked(exercise: Exercise | None, lock: Lock) -> str:
    """Say why the exercise keeps a control as it is; empty where the control is free."""
    if exercise is None or lock not in exercise.locked:
        return ""
    what = {
        Lock.ASSISTANCE: tr("the assistance"),
        Lock.VIEWS: tr("what is shown"),
        Lock.READING: tr("window, slab and layout"),
        Lock.HAND: tr("what moves the hand, and how far"),
        Lock.MODELS: tr("the way effects are computed"),
    }[lock]
    if exercise.purpose is Purpose.ASSESSMENT:
        return tr("This is an assessment: {what} is the same for everybody.", what=what)
    if exercise.is_probe and lock in (Lock.ASSISTANCE, Lock.VIEWS):
        return tr("This attempt is a probe, without help: {what} stays as it is.", what=what)
    if lock not in (exercise.locks or ()):
        return tr("Control scans guide here: {what} stays as the exercise has it.", what=what)
    return tr("The exercise “{title}” sets {what}.", title=declared(exercise.title), what=what)


CAMERA_ROLES: Final = TECHNICIANS
"""Who has the panel of the cameras; for others there are no camera pictures to be shown."""


def views_for(role: Role) -> tuple[ViewName, ...]:
    """Return the views that an exercise can show to somebody in a role."""
    return tuple(view for view in ViewName if view is not ViewName.CAMERAS or role in CAMERA_ROLES)


def view_title(view: ViewName) -> str:
    """Name of a view for people."""
    return {
        ViewName.LIVE_OVERLAY: tr("Needle on the slices"),
        ViewName.BULLSEYE: tr("Bull's-eye"),
        ViewName.THREE_D: tr("3D view"),
        ViewName.CAMERAS: tr("Camera pictures"),
        ViewName.FORCE_GAUGE: tr("Force along the needle"),
        ViewName.TARGET_MOTION: tr("Motion of the target"),
    }[view]


def off_words(reason: str) -> str:
    """Say that a view is off, and how it is switched on if it may be; `reason` it may not."""
    if reason:
        return tr("Not shown in this exercise")
    return tr("Not shown in this exercise; switch it on in View ▸ Shown by the exercise")
