"""What happens between the parts of the workspace: patient, plan, robot, the live needle."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from app.core import state_vector
from app.core.arrays import FloatArray
from app.core.errors import AcusError
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.exercises.errors import ExerciseError
from app.exercises.guidance import Purpose
from app.exercises.locks import HandName, Lock
from app.exercises.parts import TELLING, ViewName
from app.exercises.scene import device_of, draft_of
from app.exercises.schema import Exercise
from app.mechanisms.profile import DeviceProfile
from app.planning.draft import DraftPlan
from app.planning.needle_overlay import NeedleOverlay
from app.planning.patient import Patient
from app.planning.placement import Placement
from app.session.abort_reasons import OTHER_PATIENT
from app.session.ct_facts import CtFacts
from app.session.machine import RUNNING, State
from app.session.pad.view import rings_of
from app.session.shown_views import Shown
from app.session.snapshot import Snapshot
from app.tracking.cameras.settings import CameraSettings
from app.views.exercise.controller import ExerciseController
from app.views.exercise.entry_marking import EntryMarking
from app.views.exercise.run import ExerciseRun
from app.views.exercise.runs import Runs
from app.views.exercise.scan_source import ScanSource
from app.views.exercise.target_motion import AblationView, GridScene, TargetMotion
from app.views.kit.background import Indicator
from app.views.kit.names import NAMES
from app.views.kit.text import tr
from app.views.plan.editor import PlanEditor
from app.views.plan.verdict import missing_words
from app.views.reading.fixed_reading import apply as apply_reading
from app.views.reading.lock_words import why_locked
from app.views.reading.workspace import WorkspacePage
from app.views.scene.robot import RobotShape
from app.views.scene.view import SurfaceExtraction
from app.views.shell.services import RobotChoice, RunSetup
from app.views.slices.slab import as_point
from app.views.slices.viewing import Tool, Viewing

DECLARATION: Final[dict[str, Any]] = {
    "view": "live_overlay",
    "title": "Needle on the slices",
    "reads": ("tip_offset",),
}

SCENE_DEAD_BAND_MM = 0.25
"""The 3D picture is made anew when the needle moved more than this."""


class LiveNeedle:
    """Draws needle and robot where a snapshot says they are."""

    def __init__(self, workspace: WorkspacePage) -> None:
        self._workspace = workspace
        self._drawn: FloatArray | None = None
        self._pulled: FloatArray = np.zeros(0)
        self._hidden = False

    def forget(self) -> None:
        """Draw everything anew at the next snapshot: another run, or another plan."""
        self._drawn, self._hidden = None, False

    def show(
        self, run: ExerciseRun, snapshot: Snapshot, absent: bool = False, bare: bool = False
    ) -> None:
        """Draw a moment; nothing where the run tells nothing of its needle.

        Args:
            run: whose needle it is.
            snapshot: of the moment.
            absent: whether the needle is not there yet.
            bare: whether it is drawn without the robot, which somebody else does not use.
        """
        if absent or not run.shown.live:
            if not self._hidden:
                self.hide()
            return
        self._hidden = False
        pose, transform = snapshot.pose, run.placed.T_world_patient
        length = run.profile.needle_length
        # Without a measured depth only the line is known: it ends at the entry, grey.
        p_end = pose.p_tip if pose.measured else run.placed.p_entry
        spread = pose.covariance if pose.measured else None
        bent = pose.curve if pose.measured and pose.bend is not None and pose.depth > 0.0 else None
        needle = NeedleOverlay.of_world(
            p_end, pose.axis, length, transform, pose.measured, spread, bent
        )
        viewing = self._workspace.viewing
        if run.shown.shows(ViewName.LIVE_OVERLAY):
            viewing.follow_needle(needle)
        else:
            viewing.set_needle(None)
        if not run.shown.shows(ViewName.THREE_D):
            return
        ends = needle.points_mm
        pulls = _pulls(run, snapshot)
        if self._drawn is None or _apart(self._drawn, ends) or _otherwise(self._pulled, pulls):
            self._drawn, self._pulled = ends, pulls
            self._workspace.scene.set_needle(needle)
            q = None if snapshot.device is None else snapshot.device.q
            robot = None if bare else RobotShape.of(run.profile, q, pulls)
            self._workspace.scene.set_robot(robot, transform.inverse())

    def hide(self) -> None:
        """Take the needle, and the robot, whose arms point along it, out of every view."""
        self._drawn, self._hidden = None, True
        self._workspace.viewing.set_needle(None)
        self._workspace.scene.set_needle(None)
        self._workspace.scene.set_robot(None, RigidTransform.identity())


def _pulls(run: ExerciseRun, snapshot: Snapshot) -> FloatArray:
    """Tensions of the robot's cables [N]; none where it has none, or nothing is known."""
    if run.profile.tension_range is None or snapshot.device is None:
        return np.zeros(0)
    pulls: FloatArray = np.array(snapshot.device.row[state_vector.CABLE])
    return pulls


def _otherwise(before: FloatArray, now: FloatArray) -> bool:
    """Return whether cables pull differently enough for another picture: by a tenth, or one went
    slack.
    """
    if before.shape != now.shape:
        return True
    return bool((np.abs(now - before) > 0.1 * np.abs(before) + 0.5).any())


def _apart(item: FloatArray, other: FloatArray) -> bool:
    """Return whether two drawn shafts differ enough for another picture."""
    return item.shape != other.shape or bool(np.abs(item - other).max() > SCENE_DEAD_BAND_MM)


RAY_MM = 2000.0


class Conductor(QObject):
    """Keeps the views of one workspace in step.

    Signals:
        failed(object): an error to show; nothing was lost.
        patient_left(): the patient is about to be replaced: everything of it is to be forgotten.
        patient_changed(): another patient is shown.
        exercise_taken(str): identifier of the exercise that is being prepared.
        views_changed(): other views are on, or may be switched.
        exercises_changed(): there are others to choose from.
        exercise_wanted(str): somebody wants to begin an exercise, by its identifier.
        start_wanted(): somebody wants to choose another exercise, on the start page.
        offered(BriefingOffer): a feature offers another way to watch an exercise.

    Attributes:
        controller: serves the attempt.
        runs: the trainer that runs, if one does.
        views: the widgets of the exercise.
        scans: the control scans of this attempt.
        patient: who is shown; None before one is.
        exercise: that is prepared; None before one is.
    """

    failed = Signal(object)
    patient_left = Signal()
    patient_changed = Signal()
    exercise_taken = Signal(str)
    views_changed = Signal()
    exercises_changed = Signal()
    exercise_wanted = Signal(str)
    start_wanted = Signal()
    offered = Signal(object)

    def __init__(
        self,
        workspace: WorkspacePage,
        editor: PlanEditor,
        runs: Runs,
        indicator: Indicator,
        parent: QObject,
    ) -> None:
        super().__init__(parent)
        self._workspace, self._editor, self.runs = workspace, editor, runs
        self._indicator = indicator
        self.views = workspace.exercise_views
        self.controller = ExerciseController(self.views, parent=self)
        self.patient: Patient | None = None
        self.exercise: Exercise | None = None
        self._robot, self._released, self._leaving = RobotChoice(), False, False
        self._demonstrates = self._lent = self._bare = False
        self._cameras: CameraSettings | None = None
        self._profile: DeviceProfile | None = None
        self._surfaces = SurfaceExtraction(workspace.scene, self)
        self._needle, self._motion = LiveNeedle(workspace), TargetMotion(workspace)
        self._ablation = AblationView(workspace)
        self.scans = ScanSource(self.controller, workspace, lambda: self.patient, self)
        self.marking = EntryMarking(
            workspace.exercise_panel.entry,
            editor,
            tuple(workspace.panes),
            lambda: self.patient,
            lambda: self.exercise,
            lambda: workspace.exercise_panel.scan.choices.tilt_deg,
            self,
        )
        workspace.exercise_panel.scan.choices.changed.connect(self.marking.show_words)
        self._grid = GridScene(workspace.scene, self)
        self.marking.shown.connect(self._grid.show)
        self.controller.rester.seen = self._is_seen
        self._connect()

    def _lighten(self, light: bool) -> None:
        """Let the 3D view stand still on a computer that is too busy, and say so; or go on."""
        scene = self._workspace.scene
        scene.set_still(light)
        self._workspace.rail.set_busy(light, scene.isVisible() and not scene.off)

    def _is_seen(self) -> bool:
        """Return whether the views of the exercise may be seen."""
        return self._workspace.isVisible() and not self._workspace.window().isMinimized()

    def _connect(self) -> None:
        viewing, scene = self._workspace.viewing, self._workspace.scene
        viewing.point_placed.connect(self._editor.place)
        scene.clicked.connect(self._click_in_scene)
        self._editor.changed.connect(self._show_plan)
        self._editor.refused.connect(lambda _: viewing.refuse_point())
        self.runs.ready.connect(self._attach)
        self.runs.moved.connect(self._moved)
        self.runs.gone.connect(self._detach)
        self._surfaces.failed.connect(self.failed)
        self.controller.snapshot_taken.connect(self.show_snapshot)
        self.controller.attached.connect(self._show_views)
        self.controller.attached.connect(self._begin_steps)
        self.controller.snapshot_taken.connect(self._workspace.next_step.show_snapshot)
        self.controller.ending.connect(self._workspace.next_step.set_ending)
        self.controller.ending.connect(self._workspace.exercise_panel.buttons.set_ending)
        self.controller.beginning.connect(self._as_the_exercise_says)
        self.controller.began.connect(lambda _: self._begin_attempt())
        self.controller.burdened.connect(self._lighten)
        self.controller.slowed.connect(self._workspace.rail.set_slowed)
        self.controller.attached.connect(self._workspace.room.end)
        self.patient_changed.connect(self._workspace.scan_view.clear)
        self.scans.failed.connect(self.failed)
        self.marking.failed.connect(self.failed)
        self.controller.beginning.connect(self._tell_mark)
        self._workspace.exercise_panel.entry.dialled.connect(self._dial)

    @property
    def profile(self) -> DeviceProfile | None:
        """Device of the exercise; None before there is one."""
        return self._profile

    @property
    def planning(self) -> Viewing:
        """State of the planning CT's slices."""
        return self._workspace.viewing

    @property
    def settled(self) -> bool:
        """Return whether everything stands: surfaces extracted, robot and cameras on."""
        return not self._surfaces.is_running and self.controller.run is not None

    # --- patient and exercise -----------------------------------------------------------------
    def set_patient(self, patient: Patient) -> None:
        """Show another patient with the plan that belongs to it, or with none.

        The run of the last one is ended, an attempt on it saved, and everything that was known of
        it forgotten.
        """
        self.leave_patient()
        self.patient = patient
        self._workspace.viewing.set_volume(patient.volume)
        self._workspace.scene.set_volume(patient.volume)
        self._surfaces.start(patient)
        self._editor.set_body(patient.body)
        self._start_plan(patient)
        self.patient_changed.emit()

    def leave_patient(self) -> None:
        """End the run on the patient, and forget everything that was known of it; idempotent."""
        if self.patient is None:
            return
        self._demonstrates = self._lent = False
        self._leaving = True  # no run may be wanted for a plan that is about to go
        try:
            self.runs.abort(OTHER_PATIENT)
            self.patient = None
            self._editor.set_locked(False)
            self._editor.set_keeps_target(False)
            self._editor.start(None, Placement())
            self.patient_left.emit()
            self._as_the_exercise_says(reading=False)
        finally:
            self._leaving = False

    def set_exercise(self, exercise: Exercise) -> None:
        """Take an exercise's device, effects and tolerances; its plan, if its patient is shown.

        Raises:
            AcusError: if its device cannot be used.
        """
        self._profile = device_of(exercise)
        self.exercise = exercise
        self._editor.set_profile(self._profile)
        self._editor.set_exercise(exercise.id, exercise.title)
        radii = rings_of(exercise)
        self._workspace.viewing.set_tolerances(tuple(radius / MILLIMETRE for radius in radii))
        self._as_the_exercise_says(reading=False)
        self._show_views()
        if self.patient is not None and self.fits(self.patient):
            self._start_plan(self.patient)
        self.exercise_taken.emit(exercise.id)

    def go_on_with(self, exercise: Exercise) -> None:
        """Take another dial and other views for the next attempt; plan and patient stay."""
        self.exercise = exercise
        self._as_the_exercise_says(reading=False)
        self._show_plan()
        self._show_views()

    def _as_the_exercise_says(self, reading: bool = True) -> None:
        """Put dial, hand and, unless `reading` is False, the reading as the exercise has them."""
        exercise, workspace = self.exercise, self._workspace
        if exercise is None:
            return
        panel, source = workspace.exercise_panel, workspace.bullseye.source
        panel.set_assistance(exercise.assistance)
        panel.set_locked(why_locked(exercise, Lock.ASSISTANCE))
        why, hand = why_locked(exercise, Lock.HAND), exercise.hand
        if why:
            source.fix(hand or HandName.MOUSE, why)
        else:
            source.release()
            if hand is not None:
                source.set_source(hand)
        if exercise.touch is not None:
            source.fix_sense(
                True, tr("The hand holds the tool's handle: the tip goes the other way.")
            )
        else:
            source.release_sense()
        if reading:
            apply_reading(workspace, exercise)

    # --- views --------------------------------------------------------------------------------
    @property
    def shown(self) -> Shown:
        """Return what the exercise shows: the one gate of every view."""
        run, exercise = self.controller.run, self.exercise
        if run is not None:
            return run.shown
        return Shown() if exercise is None else Shown.of_exercise(exercise)

    def why_view_stays(self, view: ViewName) -> str:
        """Say why the student cannot switch a view now; empty where he can."""
        if self.exercise is None:
            return tr("Choose an exercise first.")
        if not self.shown.live and view in TELLING:
            return tr("Control scans guide here: nothing shows the needle between them.")
        if self._editor.locked:
            return tr("Views can be switched between attempts.")
        return why_locked(self.exercise, Lock.VIEWS)

    def show_view(self, view: ViewName, on: bool) -> None:
        """Switch a view, where the exercise lets the student; a run is built anew with it."""
        why, exercise = self.why_view_stays(view), self.exercise
        if why or exercise is None:
            self.failed.emit(ExerciseError(why))
        else:
            others = frozenset(exercise.views) - {view}
            self.exercise = exercise.showing(others | {view} if on else others)
            self._show_plan()
        self._show_views()

    def _show_views(self) -> None:
        run = self.controller.run
        why = why_locked(self.exercise, Lock.VIEWS)
        self._workspace.show_views(self.shown, run is None or run.interactive, why)
        self.views_changed.emit()

    def _begin_attempt(self) -> None:
        exercise, run = self.exercise, self.controller.run
        own = None if exercise is None else exercise.reading.layout
        self._workspace.room.begin(own or "", run is None or run.shown.live)
        self._look_anew()

    def _look_anew(self) -> None:
        """Look at the CT as a first attempt does: whole, at the target, no slice laid aslant."""
        viewing, target = self._workspace.viewing, self._editor.edit.draft.target_mm
        for pane in self._workspace.panes:
            if viewing.is_oblique(pane.pane):
                viewing.set_frame(pane.pane, None)
        if target is not None:
            viewing.set_cursor(target)
        for pane in self._workspace.slices:
            pane.canvas.fit()

    def _begin_steps(self) -> None:
        self._workspace.next_step.begin(self.controller.run)

    def set_robot(self, choice: RobotChoice) -> None:
        """Take another robot, from now on; a run on the present one ends."""
        if choice != self._robot:
            self._robot = choice
            self._show_plan()

    def set_cameras(self, cameras: CameraSettings | None) -> None:
        """Take other cameras, None for simulated ones; a run on the present ones ends."""
        if cameras != self._cameras:
            self._cameras = cameras
            self._show_plan()

    def set_demonstrating(self, on: bool) -> None:
        """Give the needle to the scripted expert, on a simulated robot, or take it back."""
        if on != self._demonstrates:
            self._demonstrates = on
            self._show_plan()

    def lend(self, on: bool) -> None:
        """Give the needle to a feature, on a simulated robot, or take it back."""
        if on != self._lent:
            self._lent = on
            self._show_plan()

    def show_leader(self, bar: QWidget | None) -> None:
        """Let a bar say what leads the needle, in place of the next step, and draw no robot; None
        ends that.
        """
        self._bare = bar is not None
        self._needle.forget()
        self._workspace.lead_by(bar)

    def show_scene_alone(self, alone: bool) -> None:
        """Give the 3D view the whole room, if the exercise shows it, or share it again."""
        workspace = self._workspace
        if alone and not workspace.scene.off and workspace.grid.maximised is not workspace.scene:
            workspace.share_room()
            workspace.grid.toggle(workspace.scene)
        elif not alone:
            workspace.share_room()

    def let_go(self) -> None:
        """End the run, so that somebody else can have the robot; the plan stays."""
        self._released = True
        self.runs.want(None)

    def take_again(self) -> None:
        """Have a run again after `let_go`."""
        self._released = False
        self._show_plan()

    def check(self, exercise: Exercise) -> None:
        """See whether an exercise can be taken.

        Raises:
            AcusError: if its device cannot be used.
        """
        device_of(exercise)

    def fits(self, patient: Patient, exercise: Exercise | None = None) -> bool:
        """Return whether an exercise, by default the present one, is made for this patient."""
        exercise = exercise or self.exercise
        if exercise is None:
            return False
        ct = exercise.ct
        if ct.phantom is not None:
            return patient.phantom_seed == ct.phantom.seed
        same_way = patient.volume.recipe.remedy == ct.remedy
        if ct.folder is None or patient.folder is None or not same_way:
            return False
        same_place = patient.folder.absolute() == ct.folder.absolute()
        return same_place and ct.digest in (None, patient.volume.digest)

    def _why_not_here(self) -> str:
        """Say why the exercise cannot be done on the patient that is open; empty where it can."""
        exercise, patient = self.exercise, self.patient
        if exercise is None or patient is None or exercise.purpose is not Purpose.ASSESSMENT:
            return ""
        if self.fits(patient):
            return ""
        return tr(
            "This assessment is made for another CT than the one that is open: begin it from the "
            "start page, which opens its own."
        )

    def _other_ct(self, patient: Patient) -> str:
        """Say that the folder of the exercise holds another CT by now; empty where it does not."""
        ct = None if self.exercise is None else self.exercise.ct
        if ct is None or ct.digest is None or ct.folder is None or patient.folder is None:
            return ""
        if patient.folder.absolute() != ct.folder.absolute() or self.fits(patient):
            return ""
        return tr(
            "The CT in {folder} is not the one the exercise was made on, or was read "
            "differently: put the right one there, or make the exercise again on this one.",
            folder=NAMES.shown(str(ct.folder)),
        )

    def _start_plan(self, patient: Patient) -> None:
        draft = None if patient.proposed is None else DraftPlan.of(patient.proposed)
        placement, own = None, False
        if why := self._other_ct(patient):
            self.failed.emit(ExerciseError(why))
        try:
            if self.exercise is not None and self.fits(patient):
                draft, placement = draft_of(self.exercise), self.exercise.placement.placement()
                own = self.exercise.is_own_plan
        except AcusError as error:
            self.failed.emit(error)
        self._editor.set_keeps_target(False)
        self._editor.start(draft, placement)
        self._editor.set_keeps_target(own)
        if draft is not None and draft.target_mm is not None:
            self._workspace.viewing.set_cursor(draft.target_mm)

    # --- plan ---------------------------------------------------------------------------------
    def _show_plan(self) -> None:
        editor, workspace = self._editor, self._workspace
        workspace.viewing.set_draft(editor.edit.draft)
        workspace.scene.set_plan(editor.edit.draft)
        placed = editor.verdict.placed
        self.show_readiness()
        elsewhere = self._why_not_here()
        if editor.locked or self._released or self._leaving or placed is None or elsewhere:
            return  # a run that is open stays with its plan until there is a better one
        if self.exercise is None or self.patient is None:
            return
        shows, volume = self._demonstrates, self.patient.volume
        simulated = shows or self._lent
        robot, cameras = (RobotChoice(), None) if simulated else (self._robot, self._cameras)
        ct = CtFacts.of_volume(volume)
        self.runs.want(RunSetup(self.exercise, placed, ct, robot, cameras, volume, shows))

    def _dial(self) -> None:
        """Let the simulated hand point the needle as it is dialled."""
        run, direction = self.controller.run, self.marking.direction()
        if run is not None and direction is not None:
            self.views.bullseye.point(run.placed.T_world_patient.rotate(direction))

    def _tell_mark(self) -> None:
        """Tell the run where the entry was marked, before an attempt begins."""
        run = self.controller.run
        if run is not None and self.marking.mark is not None:
            run.trainer.mark_entry(self.marking.mark)

    def why_not_start(self) -> str:
        """Say what keeps an attempt from beginning that does not go by itself; empty if nothing."""
        run = self.runs.run
        refused = "" if run is not None and run.demonstrates else self.controller.refusal()
        return self._why_not_here() or missing_words(self._editor) or refused

    def show_readiness(self) -> None:
        """Let Start, its key and the line over the views say whether an attempt can begin now."""
        why = self.why_not_start()
        self._workspace.exercise_panel.set_ready(self.runs.run is not None and not why, why)

    def _click_in_scene(self, point: FloatArray, direction: FloatArray) -> None:
        """Take a click on the skin in 3D as the entry, if one is being placed."""
        if self._workspace.viewing.tool is not Tool.ENTRY or self.patient is None:
            return
        from app.imaging.body import skin_entry  # scipy: loaded since there is a patient

        try:
            start, end = point - RAY_MM * direction, point + RAY_MM * direction
            skin = skin_entry(self.patient.body, start, end)
        except AcusError as error:
            self._editor.refused.emit(error)
            return
        self._editor.place(Tool.ENTRY, as_point(skin), True)
        self._workspace.viewing.set_cursor(skin)
        self._workspace.viewing.set_tool(Tool.NAVIGATE)

    # --- robot and needle ---------------------------------------------------------------------
    def _attach(self, run: ExerciseRun) -> None:
        self._needle.forget()
        self._motion.hide()
        self._ablation.hide()
        self.controller.attach(run)
        self._show_plan()

    def _moved(self, run: ExerciseRun) -> None:
        self._needle.forget()
        self._motion.hide()
        self._ablation.hide()
        self.controller.replan(run)
        self._begin_steps()

    def _detach(self) -> None:
        self.controller.detach()
        self._needle.hide()
        self._motion.hide()
        self._ablation.hide()
        self._show_plan()

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Draw needle and robot where a snapshot says they are."""
        run = self.controller.run
        if run is None:
            return
        self._editor_lock(snapshot)
        self._needle.show(run, snapshot, self.controller.is_absent, self._bare)
        self._motion.show(run, snapshot)
        self._ablation.show(snapshot)

    def _editor_lock(self, snapshot: Snapshot) -> None:
        running = snapshot.state in RUNNING
        if running != self._editor.locked:
            self._editor.set_locked(running)
            self.marking.look()
            self._workspace.exercise_panel.entry.set_dials(running)
            if not running:
                self._workspace.room.end()
            self.views_changed.emit()
        elif snapshot.state in (State.ENDED, State.ABORTED):  # before it was ever seen to run
            self._workspace.room.end()

    def close(self) -> None:
        """Let go of everything that runs; idempotent."""
        self.controller.detach()
        self._surfaces.close()
        self._grid.close()
        self.runs.close()
        self._workspace.scene.close_renderer()
        for viewing in (self._workspace.viewing, self._workspace.scan_view.viewing):
            viewing.pictures.close()
