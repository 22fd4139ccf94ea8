"""Daily check and registration check in the window; error ellipses on the CT."""

from datetime import UTC, datetime
from types import SimpleNamespace

import numpy as np
import pytest

from app.core.confidence import chi_square_quantile
from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.planning.error_overlay import PATIENCE, Enlargement, ErrorOverlay
from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan
from app.planning.registration.draft import CheckDraft, measured_placement
from app.planning.registration.plate import load_plate
from app.planning.registration.record import Registrations
from app.session.touch import Touch
from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.inspection import Inspection
from app.views.checks.feature import ChecksFeature, agreement_item
from app.views.checks.registration_dialog import RegistrationDialog
from app.views.kit.verdict import Verdict
from app.views.scene.words import error_note

MM = 1e-3
PLATE = load_plate("stepped-plate")
FULCRUM = np.array([0.0, 0.16056, 0.090])
assert PLATE.place is not None
TRUE = PLATE.place.transform @ PLATE.touch
COVARIANCE = (0.2 * MM) ** 2 * np.eye(3)


class Around:
    """A window without one: a run whose cameras see the tip where it is put."""

    def __init__(self) -> None:
        self.tip = TRUE[0]
        self.time = 0.0
        placed = PlacedPlan.of(Plan(np.zeros(3), np.array([0.0, 60.0, 0.0])), Placement(), FULCRUM)
        self._run = SimpleNamespace(
            inspect=self._inspect, is_real=False, interactive=True, placed=placed,
            profile=SimpleNamespace(pantograph=SimpleNamespace(fulcrum=FULCRUM)),
            trainer=SimpleNamespace(hand=lambda *_: None),
        )  # fmt: skip

    def _inspect(self, masks: bool, lines: bool) -> Inspection:
        self.time += 1 / 30
        fix = NeedleFix(
            self.tip, COVARIANCE, self.time, FixStatus.VALID, (None, None), 0.1, has_point=True
        )
        return Inspection((), fix, 30.0, "wide", "c1")

    def run(self):
        return self._run

    def volume(self):
        return None

    def cursor_mm(self):
        return np.zeros(3)


@pytest.fixture
def dialog(application, tmp_path, monkeypatch):
    monkeypatch.setenv("ACUS_DATA", str(tmp_path))
    around = Around()
    made = RegistrationDialog(around)
    yield made, around
    made.close()
    made.deleteLater()


def touch_all(dialog, around, rows=range(6)) -> None:
    rng = np.random.default_rng(3)
    for row in rows:
        dialog.table.selectRow(row)
        around.tip = TRUE[row] + 0.1 * MM * rng.standard_normal(3)
        dialog.touch()
        dialog.toucher._timer.stop()
        while dialog.toucher._collector.share < 1.0:
            dialog.toucher._collector.add(around._inspect(False, False).fix)
        dialog.toucher._poll()


def test_touching_every_fiducial_gives_the_students_sentence(dialog):
    made, around = dialog
    assert made.outcome.student.text() == "Screen and needle: not checked"
    assert not made.buttons["save"].isEnabled()
    touch_all(made, around)
    assert made.outcome.student.text().startswith("Screen and needle agree within ± ")
    assert "FRE" not in made.outcome.student.text()
    assert "not accuracy" in made.outcome.figures.text()
    assert made.outcome.trouble.text() == ""
    assert made.buttons["save"].isEnabled()
    assert made.table.item(2, 4).text()
    assert not made.grab().isNull()


def test_undo_takes_back_the_last_touch(dialog):
    made, around = dialog
    touch_all(made, around, range(4))
    made.undo()
    assert len(made.draft.touched) == 3
    made.redo()
    assert len(made.draft.touched) == 4
    made.table.selectRow(1)
    made.forget()
    assert [one.name for one in made.draft.touched] == ["A", "C", "D"]


def test_exchanged_fiducials_are_named_and_cannot_be_saved(dialog):
    made, around = dialog
    touch_all(made, around)
    a, b = made.draft.touched[:2]
    made._do(made.draft.with_touch("A", np.array(b.point_mm) * MM, COVARIANCE))
    made._do(made.draft.with_touch("B", np.array(a.point_mm) * MM, COVARIANCE))
    assert "were touched in another order" in made.outcome.trouble.text()
    assert made.outcome.student.text() == "Screen and needle: not checked"
    assert not made.buttons["save"].isEnabled()


def test_a_saved_check_is_found_again(dialog):
    made, around = dialog
    touch_all(made, around)
    told = []
    made.saved.connect(told.append)
    made.save()
    assert Registrations.own().newest("c1", "wide", simulated=True) == told[0]


def test_a_pick_without_a_ct_says_so(dialog):
    made, _ = dialog
    made.pick()
    assert "No CT is shown" in made.outcome.trouble.text()


def test_three_points_are_asked_for_one_by_one():
    draft = CheckDraft()
    assert draft.check(PLATE) == "touch 3 more fiducials"
    for name, point in zip("AB", TRUE[:2], strict=True):
        draft = draft.with_touch(name, point, COVARIANCE)
    assert draft.check(PLATE) == "touch 1 more fiducial"
    assert (
        draft.with_touch("C", TRUE[2], COVARIANCE).with_pick("A", np.zeros(3)).check(PLATE)
        == "pick 2 more beads in the CT, or none"
    )


def test_the_measured_place_is_what_the_plan_computes_from_then_on():
    turn = rotation_exp(np.array([0.05, -0.1, 0.3])) @ Placement().rotation
    measured = RigidTransform(turn, np.array([0.03, 0.2, 0.05]))
    plan = Plan(np.array([10.0, 20.0, 30.0]), np.array([15.0, 70.0, 40.0]))
    new, placement, moved = measured_placement(measured, plan, Placement(), FULCRUM)
    placed = PlacedPlan.of(new, placement, FULCRUM)
    np.testing.assert_allclose(placed.T_world_patient.matrix(), measured.matrix(), atol=1e-9)
    np.testing.assert_allclose(placed.p_target, measured @ (plan.target_mm * MM), atol=1e-9)
    assert moved == pytest.approx(np.linalg.norm(new.entry_mm - plan.entry_mm))


def test_without_a_check_the_strip_names_no_figure():
    item = agreement_item(None)
    assert item.text == "not checked"
    assert item.verdict is Verdict.IDLE
    assert agreement_item(None, "does not fit").verdict is Verdict.WARNING


def test_an_imported_calibration_makes_no_agreement_green_and_says_why():
    agreement = SimpleNamespace(radius=1e-3)
    assert agreement_item(agreement).verdict is Verdict.GOOD
    item = agreement_item(agreement, known=False)
    assert item.verdict is Verdict.WARNING
    assert item.text.endswith("the calibration's own uncertainty is unknown")


def test_the_outline_is_the_shadow_of_the_ellipsoid():
    error = ErrorOverlay(np.zeros(3), np.diag([4.0, 1.0, 0.25]))
    reach = np.sqrt(chi_square_quantile(0.95, 3))
    seen = error.ellipse_mm(np.array([1.0, 0, 0]), np.array([0, 0, 1.0]))
    np.testing.assert_allclose(seen, [2 * reach, 0.5 * reach, 0.0])
    rng = np.random.default_rng(2)
    for _ in range(50):
        axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        spread = rng.normal(size=(3, 3))
        error = ErrorOverlay(np.zeros(3), spread @ spread.T)
        far, near, angle = error.ellipse_mm(axes[0], axes[1])
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        shape = turn @ np.diag([far**2, near**2]) @ turn.T
        np.testing.assert_allclose(
            shape, reach**2 * (axes[:2] @ error.covariance_mm2 @ axes[:2].T), atol=1e-9
        )
    turned = ErrorOverlay.of_world(
        np.zeros(3), 1e-6 * np.diag([4.0, 1.0, 0.25]), rotation_exp([0.0, 0.0, np.pi / 2])
    )
    np.testing.assert_allclose(turned.covariance_mm2, np.diag([1.0, 4.0, 0.25]), atol=1e-12)


def test_the_scale_of_the_error_changes_only_when_it_stays_large() -> None:
    small, large = (ErrorOverlay(np.zeros(3), sd**2 * np.eye(3)) for sd in (0.1, 3.0))
    enlargement = Enlargement()
    assert enlargement.follow(large) == 1.0
    assert enlargement.follow(None) == 0.0
    assert enlargement.follow(small) == 10.0
    assert {enlargement.follow(e) for _ in range(20) for e in (large, large, small)} == {10.0}
    assert [enlargement.follow(large) for _ in range(PATIENCE + 1)][-1] == 1.0


@pytest.mark.parametrize(("sd_mm", "scale"), [(0.1, 10.0), (2.0, 10.0), (2.3, 1.0), (5.0, 1.0)])
def test_a_large_error_is_not_enlarged_and_that_is_said(sd_mm: float, scale: float) -> None:
    overlay = ErrorOverlay(np.zeros(3), np.diag([sd_mm**2, 0.01, 0.01]))
    assert overlay.scale == scale
    assert ("enlarged" in error_note(overlay.scale)) is (scale > 1.0)


def test_the_page_of_the_daily_check_shows_every_step_and_keeps_the_day(
    application, tmp_path, monkeypatch
):
    from views_exercise_fakes import run as fake_run

    from app.session.checks.record import newest_check
    from app.views.checks.daily_page import DailyPage

    monkeypatch.setenv("ACUS_DATA", str(tmp_path))
    run = fake_run(inspect=Around()._inspect)
    page = DailyPage(lambda: run, PLATE)
    page.show()
    assert [one.name for one in page.results][:2] == ["homing", "signs"]
    page._touched(Touch(TRUE[5] + [0.2 * MM, 0, 0], COVARIANCE / 9, 30, 0.1 * MM))
    touch = next(one for one in page.results if one.name == "touch")
    assert touch.found.startswith("stepped-plate F: 0.20 mm off")
    page.keep_result()
    kept = newest_check()
    assert kept is not None
    assert kept.words(datetime.now(UTC).astimezone()).split()[-2] == "today"
    assert not page.grab().isNull()
    page.close()
    page.deleteLater()


def test_the_page_of_the_daily_check_without_a_run_says_what_to_do(application):
    from app.views.checks.daily_page import DailyPage

    page = DailyPage(lambda: None, PLATE)
    page.show()
    assert "choose an exercise" in page.results[0].todo
    assert not page.touch.isEnabled()
    page.close()
    page.deleteLater()


def test_the_ellipse_round_the_target_is_drawn_where_it_was_checked(application, volume, destroy):
    from app.planning.draft import DraftPlan
    from app.views.slices.pane import SlicePane
    from app.views.slices.panes import PaneId
    from app.views.slices.presets import default_window
    from app.views.slices.viewing import Viewing

    viewing = Viewing(default_window())
    pane = SlicePane(viewing, PaneId.AXIAL)
    destroy(pane)
    pane.resize(300, 240)
    viewing.set_volume(volume)
    middle = viewing.cursor_mm
    viewing.set_draft(DraftPlan(tuple(middle - [0, 20, 0]), tuple(middle)))
    canvas = pane.canvas
    assert not canvas.layers.errors.target.isVisible()
    viewing.set_target_error(ErrorOverlay(middle, np.diag([4.0, 1.0, 1.0])))
    canvas.flush()
    item = canvas.layers.errors.target
    assert item.isVisible()
    reach = 2.0 * np.sqrt(chi_square_quantile(0.95, 3))
    assert item.boundingRect().width() == pytest.approx(2 * reach, rel=0.02)
    assert canvas.layers.plan.target._label.startswith("Target, TRE 95 %")
    assert not pane.grab().isNull()
    viewing.set_shows_errors(False)
    canvas.flush()
    assert not item.isVisible()
    assert canvas.layers.plan.target._label == "Target"


def test_the_window_opens_both_checks_without_a_run(window, settle):
    assert window.feature(ChecksFeature).items(None) == ()
    window.feature(ChecksFeature).open_daily()
    window.feature(ChecksFeature).open_registration()
    settle()
    assert window.feature(ChecksFeature).daily.isVisible()
    assert window.feature(ChecksFeature).registration.isVisible()
    told = []
    window.feature(ChecksFeature).failed.connect(told.append)
    window.feature(ChecksFeature).use_place(RigidTransform.identity())
    assert "plan is needed" in str(told[0])
    window.feature(ChecksFeature).close()
    assert not window.feature(ChecksFeature).daily.isVisible()
