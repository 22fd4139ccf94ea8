"""Another language between two attempts: the window is built anew, patient and plan stay."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QCoreApplication, QEvent, QObject, QSettings, QTimer
from PySide6.QtGui import QActionGroup
from PySide6.QtWidgets import QApplication, QMenu

from app.views.debrief.feature import DebriefFeature
from app.views.exercise.feature import ExerciseFeature
from app.views.kit.access import ACCESS
from app.views.kit.language import choose, chosen, code_for, languages, use_language
from app.views.kit.text import tr
from app.views.people.feature import PeopleFeature
from app.views.plan.feature import PlanFeature
from app.views.shell.collector import collect_for
from app.views.shell.message_bar import ATTEMPT_RUNS
from app.views.shell.window import MainWindow


def fill_language_menu(menu: QMenu, settings: QSettings, change: Callable[[str], object]) -> None:
    """List the languages with the one that is chosen checked, each by its own name.

    Args:
        menu: emptied first.
        settings: where the choice is kept.
        change: told the code of another choice, empty for the system's language.
    """
    menu.clear()
    there, now = languages(), chosen(settings)
    group = QActionGroup(menu)
    system = tr("As this computer: {language}", language=there[code_for("")])
    for code, title in {"": system, **there}.items():
        action = group.addAction(menu.addAction(title))
        action.setCheckable(True)
        action.setChecked(code == now)
        action.triggered.connect(lambda _=False, code=code: change(code))


class Rebuilding(QObject):
    """Replaces the window by one in the language that is chosen in it.

    Args:
        make: returns a window, not shown.

    Attributes:
        window: the one that stands.
    """

    def __init__(self, make: Callable[[], MainWindow]) -> None:
        super().__init__(QApplication.instance())
        self._make = make
        self._attach(make())

    def close(self) -> None:
        """Collect no more garbage for the window: it goes."""
        self._collector.close()

    def _attach(self, window: MainWindow) -> None:
        self.window, self._collector = window, collect_for(window)
        menu = window.view_menu.add_menu(tr("Language"))
        menu.aboutToShow.connect(
            lambda: fill_language_menu(menu, window.settings, self._change_soon)
        )

    def _change_soon(self, code: str) -> None:
        """Change once the menu that asks for it has closed: it goes with its window."""
        QTimer.singleShot(0, self, lambda: self.change(code))

    def change(self, code: str) -> None:
        """Build the window anew in another language; while an attempt runs, say that it waits."""
        window, application = self.window, QApplication.instance()
        before = chosen(window.settings)
        if code == before or not isinstance(application, QApplication):
            return
        if code_for(code) == code_for(before):  # by its own name, or because the computer has it
            choose(window.settings, code)
            return
        if window.editor.locked:
            window.message_bar.show_until(
                ATTEMPT_RUNS, tr("An attempt is running: end it before another language is chosen")
            )
            return
        patient, exercise = window.conductor.patient, window.conductor.exercise
        edit, path, dirty = window.editor.edit, window.editor.path, window.editor.dirty
        attempted, begun = window.editor.attempted, window.feature(ExerciseFeature).beginning
        briefed = exercise is not None and begun.is_briefed(exercise)
        signed_in = ACCESS.signed_in
        page, debrief = window.pages.currentWidget(), window.feature(DebriefFeature)
        if not all(one.may_go() for one in window.features if not isinstance(one, PlanFeature)):
            return
        application.setQuitOnLastWindowClosed(False)
        window.leave()  # the plan is taken along: nothing is asked of it
        self._collector.close()
        choose(window.settings, code)
        use_language(application, code)
        self._attach(self._make())
        new = self.window
        new.show()
        application.setQuitOnLastWindowClosed(True)
        if exercise is not None:
            new.conductor.set_exercise(exercise)
            if briefed:
                new.feature(ExerciseFeature).beginning.trust(exercise.id)
        if patient is not None:
            new.show_patient(patient)
            new.editor.take(edit.draft, edit.placement)
            if not dirty:
                new.editor.saved(path)
            if attempted:
                new.editor.note_attempt()
        if page is window.start_page:
            new.show_start()
        elif page is not window.feature(PeopleFeature).page:
            new.feature(DebriefFeature).go_on(debrief, page)

        of_people = page is window.feature(PeopleFeature).page

        def end() -> None:
            _destroy(window)
            if any(signed_in[:2]):  # whoever sits here has not gone
                ACCESS.sign_in(*signed_in)
                new.feature(PeopleFeature).look()
            if of_people:
                new.feature(PeopleFeature).show()

        QTimer.singleShot(0, self, end)


def _destroy(window: MainWindow) -> None:
    """Destroy a window while Python still holds all that belongs to it.

    Qt crashes where the garbage collector takes wrappers of items in a scene before the scene goes.
    """
    window.deleteLater()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
