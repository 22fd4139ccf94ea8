"""The checks in the window, and the one in force: words on the status strip, and an ellipse."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np
from PySide6.QtCore import SignalInstance

from app.core.arrays import FloatArray
from app.core.errors import AcusError
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.imaging.volume import Volume
from app.planning.draft import DraftPlan
from app.planning.error_overlay import ErrorOverlay
from app.planning.registration.check import RegistrationAgreement
from app.session.snapshot import Snapshot
from app.views.exercise.run import ExerciseRun
from app.views.kit.menu_entries import add_entries
from app.views.kit.roles import TECHNICIANS, Role
from app.views.kit.text import moment, tr, translated
from app.views.kit.verdict import StatusItem, Verdict
from app.views.shell.feature import Context, Feature

if TYPE_CHECKING:
    from app.planning.registration.check import RegistrationCheck
    from app.planning.registration.record import RegistrationRecord
    from app.views.checks.daily_page import DailyPage
    from app.views.checks.registration_dialog import RegistrationDialog


GOOD_MM = 2.0
"""Up to this radius [mm] the agreement counts as good; a lesion of 10 mm is then hit."""


def agreement_item(
    agreement: RegistrationAgreement | None, reason: str = "", checked: str = "", known: bool = True
) -> StatusItem:
    """Return the line of the status strip.

    Args:
        agreement: at the target; None where nobody checked.
        reason: why there is none, although somebody did.
        checked: when and with what it was checked, for the help.
        known: whether the cameras' calibration says how sure it is.
    """
    title = tr("Screen and needle")
    if agreement is None:
        text = tr("check failed") if reason else tr("not checked")
        verdict = Verdict.WARNING if reason else Verdict.IDLE
        help_ = reason or tr(
            "Nobody has checked how well the needle on the screen agrees with the real one. "
            "Menu Checks, Registration check: touch the fiducials of a plate."
        )
        return StatusItem(verdict, title, text, help_)
    radius = agreement.radius / MILLIMETRE
    text = tr("agree within ± {mm:.1f} mm (95 %)", mm=radius)
    help_ = tr(
        "How far the needle on the screen may be from the real one at the target: what the "
        "registration check found, with the cameras' error. {checked}",
        checked=checked,
    )
    if not known:
        text = tr("{size}; the calibration's own uncertainty is unknown", size=text)
        help_ += " " + tr(
            "The calibration was imported and does not say how sure it is: the radius leaves its "
            "error out. Calibrate with pictures of a board to know it."
        )
    good = radius <= GOOD_MM and known
    return StatusItem(Verdict.GOOD if good else Verdict.WARNING, title, text, help_)


FURTHEST_MM = 10.0
"""A measured place that moves the entry farther than this is not this patient's."""


class ChecksFeature(Feature):
    """Opens the pages; keeps the registration check that holds for the present cameras and CT."""

    topic: ClassVar[str] = "checks"
    place: ClassVar[int] = 100
    roles: ClassVar[frozenset[Role]] = TECHNICIANS

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._conductor, self._runs = context.conductor, context.runs
        self._editor, self._viewing = context.editors.plan, context.views.viewing
        self._window = context.shell.dialog_parent
        self.daily: DailyPage | None = None
        self.registration: RegistrationDialog | None = None
        self.record: RegistrationRecord | None = None
        self._check: RegistrationCheck | None = None
        self._looked, self._known = False, True
        self._conductor.controller.add_items(self.items)
        self._conductor.patient_changed.connect(self.forget)
        self._runs.ready.connect(lambda _: self.forget())
        *_, errors = add_entries(
            context.shell.menu(tr("&Checks")),
            [
                (tr("Daily check…"), "F9", self.open_daily),
                (tr("Registration check…"), "", self.open_registration),
                None,
                (tr("Draw errors of target and tip"), "", lambda: None),
            ],
        )
        errors.setCheckable(True)
        errors.setChecked(True)
        errors.toggled.connect(self._viewing.set_shows_errors)

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self.noted, self._editor.changed, self._conductor.controller.finished)

    # --- what the dialog needs ----------------------------------------------------------------
    def run(self) -> ExerciseRun | None:
        """Return what runs now."""
        return self._runs.run

    def volume(self) -> Volume | None:
        """Return the CT that is shown."""
        return self._viewing.volume

    def cursor_mm(self) -> FloatArray:
        """Return the crosshair in the CT (LPS, mm), shape (3,)."""
        return self._viewing.cursor_mm

    # --- pages --------------------------------------------------------------------------------
    def open_daily(self) -> None:
        """Show the daily check."""
        from app.planning.registration.plate import load_plate, plate_names
        from app.views.checks.daily_page import DailyPage  # OpenCV: not before the window

        if self.daily is None:
            try:
                plate = load_plate(plate_names()[0])
            except AcusError as error:
                self.failed.emit(error)
                return
            self.daily = DailyPage(self.run, plate, self._window)
            self.daily.kept.connect(self.noted)
        self.daily.show()
        self.daily.raise_()

    def open_registration(self) -> None:
        """Show the registration check."""
        from app.views.checks.registration_dialog import RegistrationDialog

        if self.registration is None:
            try:
                self.registration = RegistrationDialog(self, self._window)
            except AcusError as error:
                self.failed.emit(error)
                return
            self.registration.saved.connect(self._take)
            self.registration.place_wanted.connect(self.use_place)
        self.registration.show()
        self.registration.raise_()

    def close(self) -> None:
        """Close the pages; idempotent."""
        for page in (self.daily, self.registration):
            if page is not None:
                page.close()

    # --- the check in force -------------------------------------------------------------------
    def forget(self) -> None:
        """Find the check anew at the next poll: patient or cameras are others."""
        self._looked, self.record, self._check = False, None, None
        self._viewing.set_target_error(None)

    def items(self, snapshot: Snapshot) -> tuple[StatusItem, ...]:
        """Line of the status strip about how well screen and needle agree at the target."""
        run = self.run()
        if run is None:
            return ()
        if not self._looked:
            self._find_check(run)
        check, record = self._check, self.record
        if check is None or record is None:
            return (agreement_item(None),)
        used = run.placed.T_world_patient
        covariance = snapshot.pose.covariance if snapshot.pose.measured else np.zeros((3, 3))
        try:
            agreement = check.agreement(run.placed.p_target, covariance, used)
        except AcusError as error:
            return (agreement_item(None, translated(error)),)
        self._show_error(run, check)
        checked = tr(
            "Checked {when} with {plate}.",
            when=moment(record.created),
            plate=record.plate.name,
        )
        return (agreement_item(agreement, checked=checked, known=self._known),)

    def use_place(self, T_world_patient: RigidTransform) -> None:
        """Take the measured place of the patient; one step to undo in the plan."""
        from app.planning.registration.draft import measured_placement

        profile, edit = self._conductor.profile, self._editor.edit
        if profile is None or not edit.draft.complete:
            self.failed.emit(tr("A plan is needed first: place entry and target."))
            return
        try:
            plan, placement, moved = measured_placement(
                T_world_patient, edit.draft.plan(), edit.placement, profile.fulcrum
            )
        except AcusError as error:
            self.failed.emit(error)
            return
        if moved > FURTHEST_MM:
            self.failed.emit(
                tr(
                    "By the measured place the needle enters {moved:.0f} mm from the planned "
                    "entry: lay the phantom so that its entry is at the robot's fulcrum (at most "
                    "{most:.0f} mm), then measure again",
                    moved=moved,
                    most=FURTHEST_MM,
                )
            )
            return
        self._editor.take(DraftPlan.of(plan), placement)
        self.noted.emit(tr("The measured place is used; the entry moved by {mm:.1f} mm", mm=moved))

    def _find_check(self, run: ExerciseRun) -> None:
        from app.planning.registration.record import Registrations

        seen = run.inspect(False, False) if run.inspect is not None else None
        if seen is None:
            return
        self._looked, volume, self._known = True, self.volume(), seen.uncertainty_known
        ct = volume.series if volume is not None else None
        names = () if ct is None else (ct.pseudonym, ct.frame)
        try:
            record = Registrations.own().newest(seen.calibration, seen.rig, not run.is_real, *names)
            if record is not None:
                self._take(record)
        except AcusError as error:
            self.failed.emit(error)

    def _take(self, record: RegistrationRecord) -> None:
        self._looked, self.record, self._check = True, record, record.check()

    def _show_error(self, run: ExerciseRun, check: RegistrationCheck) -> None:
        viewing, target = self._viewing, self._editor.edit.draft.target_mm
        if target is None:
            return
        shown = viewing.target_error
        spread = check.spread(run.placed.p_target)
        error = ErrorOverlay.of_world(
            np.asarray(target), spread, run.placed.T_world_patient.rotation
        )
        if shown is None or not (
            np.allclose(shown.centre_mm, error.centre_mm)
            and np.allclose(shown.covariance_mm2, error.covariance_mm2)
        ):
            viewing.set_target_error(error)
