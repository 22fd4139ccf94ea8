"""The ways to the pages and states of the window, each of them an act of its own.

An act sits down in a role and goes from state to state; another picture script's way is taken where
there is one.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Final

from PySide6.QtWidgets import QScrollArea

from app.session.store import list_sessions
from app.views.accuracy.feature import AccuracyFeature
from app.views.author.feature import AuthorFeature
from app.views.cameras.feature import CamerasFeature
from app.views.checks.feature import ChecksFeature
from app.views.debrief.feature import DebriefFeature
from app.views.exercise.feature import ExerciseFeature
from app.views.kit.roles import Role
from app.views.measure.feature import MeasureFeature
from app.views.pen.feature import PenFeature
from app.views.people.feature import PeopleFeature
from app.views.plan.feature import PlanFeature
from app.views.robot.feature import RobotFeature
from tools import dialog_pictures, reading_pictures
from tools.debrief_pictures import attempt as scripted_attempt
from tools.docs_pictures import CHEST
from tools.looks.gallery import PASSES_S, Gallery
from tools.robot_pictures import pause, wait

FIRST: Final = "first-insertion"


def start(gallery: Gallery) -> None:
    """Show the start page to everybody, searched and toured."""
    window, page = gallery.window, gallery.window.start_page
    gallery.sit_down(Role.STUDENT)
    window.show_start()
    facts, count = window.start_facts, len(page.map.places)
    wait(lambda: facts.pictured >= count, PASSES_S)
    gallery.keep("start-first")
    if gallery.wish.wants("start-tour"):
        page.tour.click()
        window.tour.move(2)
        wait(lambda: window.conductor.settled)
        gallery.keep("start-tour")
        window.tour.end()
    window.show_start()
    page.offer_tour(False)
    gallery.keep("start-student")
    page.search.setText("liver")
    gallery.keep("start-search")
    page.search.setText("")
    for role in (Role.INSTRUCTOR, Role.TECHNICIAN):
        gallery.sit_down(role)
        gallery.keep(f"start-{role}")
    window.message_bar.show_error("The folder /data/ct-2026 cannot be read: permission denied")
    gallery.keep("start-message")
    window.message_bar.clear()


def briefing(gallery: Gallery) -> None:
    """Show what a student reads before the first attempt."""
    gallery.sit_down(Role.STUDENT)
    window = gallery.window
    window.conductor.exercise_wanted.emit(FIRST)
    beginning = window.feature(ExerciseFeature).beginning
    wait(lambda: beginning.page.isVisible())
    pause(0.5)
    gallery.keep("briefing")
    beginning.back()


def attempt(gallery: Gallery) -> None:
    """Go through an attempt as a student."""
    gallery.sit_down(Role.STUDENT)
    workspace = gallery.window.workspace
    gallery.begin(FIRST)
    gallery.keep("attempt-ready")
    gallery.insert(0.3)
    gallery.keep("attempt-inserting")
    gallery.push(0.9)
    gallery.keep("attempt-deep")
    workspace.room.toggle_panels()
    gallery.keep("attempt-panels")
    workspace.room.toggle_panels()
    workspace.set_left_handed(True)
    gallery.keep("attempt-left-handed")
    workspace.set_left_handed(False)
    workspace.show_layout("2x2")
    gallery.keep("attempt-two-by-two")
    gallery.leave_attempt()


def breath(gallery: Gallery) -> None:
    """Insert into a liver that breathes."""
    gallery.sit_down(Role.STUDENT)
    gallery.begin("breathing-liver")
    gallery.insert(0.5)
    gallery.keep("attempt-breath")
    gallery.leave_attempt()


def scan(gallery: Gallery) -> None:
    """Take a control scan where nothing is live."""
    gallery.sit_down(Role.STUDENT)
    gallery.begin("scans-only")
    gallery.insert(0.75)
    window, panel = gallery.window, gallery.window.workspace.exercise_panel
    gallery.keep("attempt-scans-only")
    panel.scan.table.setValue(float(window.workspace.viewing.cursor_mm[2]))
    panel.buttons.scan_requested.emit()
    wait(lambda: window.workspace.scan_view.scan is not None)
    gallery.trainer.step()
    gallery.keep("attempt-scan")
    gallery.leave_attempt()


def own_plan(gallery: Gallery) -> None:
    """Leave the plan to the student."""
    gallery.sit_down(Role.STUDENT)
    gallery.window.begin_exercise("plan-it-yourself")
    wait(lambda: gallery.window.workspace.isVisible(), PASSES_S)
    pause(1.0)
    gallery.keep("plan-student")


def debrief(gallery: Gallery) -> None:
    """Show an attempt that is over, to a student and to an instructor, and the list."""
    gallery.sit_down(Role.STUDENT)
    gallery.begin("thick-tissue")
    window = gallery.window
    patient, feature = window.conductor.patient, window.feature(DebriefFeature)
    if patient is None:
        raise RuntimeError("no patient is open")
    for seed in (5, 2):
        scripted_attempt(patient.volume, patient, "novice", seed, gallery.sessions)
    gallery.sit_down(Role.INSTRUCTOR)
    page = feature.page
    newest = max(list_sessions(gallery.sessions), key=lambda summary: summary.started)
    feature.sessions.open_requested.emit(newest)
    wait(lambda: page.isVisible() and page.views.has_ct)
    pause(2.0)
    gallery.keep("debrief-instructor")
    feature.show_sessions()
    pause(0.5)
    gallery.keep("sessions")
    gallery.window.show_workspace()
    gallery.sit_down(Role.STUDENT)
    feature.show()
    gallery.keep("debrief-student")
    for unfolded in (page.fold, page.details):  # an instructor's has no such button as the last
        unfolded.setChecked(True)
    pause(0.3)
    areas = page.findChildren(QScrollArea)
    next(area for area in areas if area.isAncestorOf(page.details)).ensureWidgetVisible(
        page.details
    )
    gallery.keep("debrief-details")
    for unfolded in (page.fold, page.details):
        unfolded.setChecked(False)


def reading(gallery: Gallery) -> None:
    """Go through layouts, measurements and slabs as an instructor."""
    gallery.sit_down(Role.INSTRUCTOR)
    gallery.begin(FIRST)
    window = gallery.window
    window.workspace.side.setCurrentWidget(window.feature(PlanFeature).panel)
    gallery.keep("plan-instructor")
    reading_pictures.measurements(gallery)
    window.feature(MeasureFeature).forget()
    reading_pictures.structures(gallery)
    reading_pictures.entry_map(gallery)
    for name in ("1+3", "6-up", "needle", "2x2"):
        window.workspace.show_layout(name)
        gallery.keep(f"layout-{name.replace('+', '-and-')}")
    window.workspace.show_bullseye(True)
    gallery.keep("layout-bullseye")
    window.workspace.show_bullseye(False)


def author(gallery: Gallery) -> None:
    """Go through the form of an exercise."""
    gallery.sit_down(Role.INSTRUCTOR)
    gallery.begin(FIRST)
    feature = gallery.window.feature(AuthorFeature)
    feature.make()
    dialog = feature.dialog
    if dialog is None:
        raise RuntimeError("the form did not open")
    for number, word in enumerate(
        ("task", "patient", "help", "sight", "effects", "score", "review")
    ):
        if gallery.wish.wants(f"author-{word}"):
            dialog.show_page(number)
            pause(0.8)
            gallery.keep(f"author-{word}", dialog)
    dialog.may_close = lambda: True
    dialog.reject()
    pause(0.2)


def people(gallery: Gallery) -> None:
    """Show people, courses and progress, and their dialogs."""
    gallery.sit_down(Role.INSTRUCTOR)
    feature = gallery.window.feature(PeopleFeature)
    feature.show()
    pause(0.5)
    for number, word in enumerate(("progress", "students", "courses")):
        feature.page.tabs.setCurrentIndex(number)
        gallery.keep(f"people-{word}")
    gallery.dialog("people-add", feature.add_student)
    gallery.dialog("people-course", lambda: feature.edit_course(None))
    gallery.dialog("people-sign-in", feature.sign_in_student)
    gallery.dialog("people-password", feature.sign_in_instructor)
    gallery.window.show_workspace()


def robot(gallery: Gallery) -> None:
    """Show the technician's panels and pages."""
    gallery.sit_down(Role.TECHNICIAN)
    gallery.begin(FIRST)
    window = gallery.window
    for number, name in enumerate(window.workspace.side.names()):
        window.workspace.side.setCurrentIndex(window.workspace.side.there[number])
        pause(0.3)
        gallery.keep(f"technician-panel-{number}")
        del name
    feature = window.feature(RobotFeature)
    gallery.dialog("robot-key", feature.ask_key)
    gallery.dialog("robot-port", feature.ask_port)
    accuracy = window.feature(AccuracyFeature)
    accuracy.open_page()
    accuracy.show_study("contact", here=False)
    pause(0.5)
    gallery.keep("accuracy")
    if accuracy.page is not None:
        accuracy.page.tabs.setCurrentIndex(1)
        gallery.keep("accuracy-hard")
    window.show_workspace()


def equipment(gallery: Gallery) -> None:
    """Show dialogs of cameras, checks and pen."""
    gallery.sit_down(Role.TECHNICIAN)
    gallery.begin(FIRST)
    window = gallery.window
    checks, cameras = window.feature(ChecksFeature), window.feature(CamerasFeature)
    gallery.dialog("checks-daily", checks.open_daily)
    gallery.dialog("checks-registration", checks.open_registration)
    gallery.dialog("cameras-set-up", cameras.set_up)
    gallery.dialog("cameras-calibrate", cameras.calibrate)
    gallery.dialog("pen", window.feature(PenFeature).open)


def series(gallery: Gallery) -> None:
    """Show what stands around a CT: its series, its import, the archive."""
    gallery.sit_down(Role.INSTRUCTOR)
    gallery.chest = CHEST if CHEST.is_dir() else None
    for name, show in (
        ("reading-series", dialog_pictures.series),
        ("privacy-report", dialog_pictures.report),
        ("pacs-panel", dialog_pictures.pacs),
    ):
        if gallery.wish.wants(name):
            show(gallery)
    gallery.chest = None


def helping(gallery: Gallery) -> None:
    """Show help, keys and what this is."""
    window = gallery.window
    for role in (Role.STUDENT, Role.TECHNICIAN):
        gallery.sit_down(role)
        gallery.dialog(f"help-keys-{role}", window.show_shortcuts)
    gallery.dialog("help-about", window.show_about)
    gallery.dialog("help-problem", window.report_problem)


ACTS: Final[dict[str, tuple[Callable[[Gallery], None], tuple[str, ...]]]] = {
    "start": (start, ("start",)),
    "briefing": (briefing, ("briefing",)),
    "attempt": (attempt, ("attempt-",)),
    "breath": (breath, ("attempt-breath",)),
    "scan": (scan, ("attempt-scan",)),
    "own_plan": (own_plan, ("plan-student",)),
    "debrief": (debrief, ("debrief-", "sessions")),
    "reading": (reading, ("plan-", "planning-", "structures-", "layout-")),
    "author": (author, ("author-",)),
    "people": (people, ("people-",)),
    "robot": (robot, ("technician-", "robot-", "accuracy")),
    "equipment": (equipment, ("checks-", "cameras-", "pen")),
    "series": (series, ("reading-series", "privacy-report", "pacs-panel")),
    "helping": (helping, ("help-",)),
}
"""Each act with the beginnings of its states' names."""


def play(gallery: Gallery) -> None:
    """Go through all acts with a state that is wanted; one that fails is told and left."""
    for name, (act, begins) in ACTS.items():
        only = gallery.wish.only
        if only and not any(_may_hold(pattern, begins) for pattern in only):
            continue
        try:
            act(gallery)
        except (TimeoutError, RuntimeError, LookupError, AttributeError) as error:
            print(f"{name}: {type(error).__name__}: {error}", flush=True)
            gallery.broken.append(f"{name}: {error}")


def _may_hold(pattern: str, begins: tuple[str, ...]) -> bool:
    plain = pattern.strip("*")
    return any(plain.startswith(begin) or begin.startswith(plain) for begin in begins)


def taken(folder: Path, make: Callable[[Path], Gallery]) -> Gallery:
    """Play all acts in a gallery that `make` returns, given a folder for records."""
    with tempfile.TemporaryDirectory() as sessions:
        gallery = make(Path(sessions))
        try:
            play(gallery)
        finally:
            gallery.window.editor.saved(Path("kept"))
            gallery.leave_attempt()
            gallery.window.leave()
    return gallery
