"""The calibration wizard on rendered pictures, from the board to the history."""

from pathlib import Path
from types import SimpleNamespace

import cv2
import numpy as np
import pytest
from board_pictures import board_picture
from calibration_samples import sample
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMessageBox

from app.core.transform import RigidTransform
from app.tracking.calibration.boards import DEFAULT_BOARD, BoardKind, parse_board
from app.tracking.calibration.coverage import Coverage
from app.tracking.calibration.formats.own import save_camera
from app.tracking.calibration.formats.reading import read_calibration
from app.tracking.calibration.formats.ros import ros_paths, write_ros
from app.tracking.calibration.job import CalibrationJob, last_board
from app.tracking.calibration.placed_board import place
from app.tracking.calibration.views import Rejection, RejectionReason
from app.tracking.cameras.camera import CameraFrame
from app.tracking.errors import CalibrationError
from app.tracking.optics.rig import load_rig
from app.views.cameras.wizard import CalibrationWizard
from app.views.cameras.wizard_words import baseline_sd, pairs_words, verdict_of
from app.views.kit.verdict import Verdict

SPEC = "charuco:9x6:11mm:8mm:DICT_5X5_100"
AT = (-45.0, 185.0, 10.0, 105.0, 0.0, 0.0)
COUNT = 9


def poses() -> list[RigidTransform]:
    """Places of the board in world at the needle, turned to both cameras of the wide rig."""
    rng = np.random.default_rng(3)
    middle = parse_board(SPEC).points.mean(axis=0)
    found = []
    for _ in range(COUNT):
        shift = rng.uniform([-0.02, -0.03, -0.015], [0.02, 0.06, 0.015])
        turn = np.radians([*rng.uniform(-14, 14, 2), rng.uniform(-60, 60)])
        found.append(
            RigidTransform.from_translation(np.array([0.0, 0.17, 0.05]) + shift)
            @ RigidTransform.from_rotation(place(0, 0, 0, 105.0).rotation)
            @ RigidTransform.exp([0, 0, 0, *turn])
            @ RigidTransform.from_translation(-middle)
        )
    return found


@pytest.fixture(scope="module")
def pictures(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder, board = tmp_path_factory.mktemp("pairs"), parse_board(SPEC)
    for k, T_world_board in enumerate(poses()):
        for model in load_rig("wide").models:
            image = board_picture(
                board, model, model.T_camera_world @ T_world_board, seed=k, supersample=2
            )
            cv2.imwrite(str(folder / f"{model.name}{k:02}.png"), image)
    return folder


@pytest.fixture(scope="module")
def at_place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder, board = tmp_path_factory.mktemp("place"), parse_board(SPEC)
    for model in load_rig("wide").models:
        image = board_picture(board, model, model.T_camera_world @ place(*AT))
        cv2.imwrite(str(folder / f"{model.name}01.png"), image)
    return folder


@pytest.fixture
def job() -> CalibrationJob:
    return CalibrationJob(board=parse_board(SPEC))


@pytest.fixture
def wizard(application, job, destroy):
    dialog = CalibrationWizard(job)
    destroy(dialog)
    dialog.show()
    yield dialog
    dialog.done(0)


def titles(wizard: CalibrationWizard) -> list[str]:
    return [wizard.list.item(i).text() for i in range(wizard.list.count())]


@pytest.mark.long("journey")
def test_from_pictures_to_a_calibration_in_use(wizard, job, pictures, at_place, settle) -> None:
    assert titles(wizard) == ["✔ Board", "– Pictures", "– Result", "– Place", "– Save"]
    wizard.show_page(1)
    wizard.capture_page.begin_folder(pictures)
    assert not wizard.next.isEnabled()
    assert settle(lambda: not wizard.capture_page.running)
    assert job.pairs >= 8
    assert f"{job.pairs} pairs, all of which are used" in wizard.capture_page.state.text()
    assert wizard.next.isEnabled()
    wizard.show_page(2)  # computes by itself
    assert wizard.result_page.running
    assert settle(lambda: not wizard.result_page.running)
    assert job.result is not None
    left = job.result.calibration.cameras[0]
    assert left.focal_px[0] == pytest.approx(1070.0, rel=0.01)
    assert wizard.result_page.views.rowCount() == job.pairs
    assert wizard.result_page.parameters.item(0, 0).text() == "fx [px]"
    assert "board's size is not checked" in wizard.result_page.ruled.text()
    wizard.result_page.ruler.setValue(1e3 * job.result.calibration.baseline / 1.05)
    assert "mm instead of 11 mm would explain it" in wizard.result_page.ruled.text()
    assert titles(wizard)[2].startswith("✖")
    wizard.result_page.ruler.setValue(1e3 * job.result.calibration.baseline)
    assert wizard.result_page.ruled.text().startswith("✔")
    wizard.show_page(3)
    for field, value in zip(wizard.world_page.fields, AT, strict=True):
        field.setValue(value)
    wizard.world_page.begin_folder(at_place)
    assert settle(lambda: not wizard.world_page.running)
    assert job.world is not None
    for centre, model in zip(job.world.centres, load_rig("wide").models, strict=True):
        np.testing.assert_allclose(centre, model.centre, atol=8e-3)
    wizard.show_page(4)
    assert titles(wizard)[4] == "▲ Save"
    used = []
    wizard.used.connect(lambda: used.append(True))
    wizard.save_page.save.click()
    assert not wizard.next.isEnabled()  # the file is being written
    assert settle(lambda: used == [True])
    assert titles(wizard)[4] == "✔ Save"
    active = job.history.active()
    assert active is not None
    assert active.world is not None
    assert not wizard.save_page.save.isEnabled()


@pytest.mark.parametrize(
    ("answer", "stays"),
    [(QMessageBox.StandardButton.Cancel, True), (QMessageBox.StandardButton.Discard, False)],
)
def test_escape_does_not_throw_an_unsaved_result_away_unasked(
    wizard, job, monkeypatch, answer, stays
) -> None:
    asked = []
    monkeypatch.setattr(QMessageBox, "question", lambda *_: asked.append(True) or answer)
    job.set_result(SimpleNamespace(calibration=sample(load_rig("wide"))))
    QTest.keyClick(wizard, Qt.Key.Key_Escape)
    assert asked == [True]
    assert wizard.isVisible() == stays


def test_without_anything_to_lose_the_wizard_closes_unasked(wizard, monkeypatch) -> None:
    monkeypatch.delattr(QMessageBox, "question")
    QTest.keyClick(wizard, Qt.Key.Key_Escape)
    assert not wizard.isVisible()


def test_the_history_can_be_undone_and_rejected(wizard, job, settle) -> None:
    for name in ("one", "two"):
        job.history.keep(sample(load_rig("wide"), name))
    wizard.show_page(4)
    page = wizard.save_page

    def done(active: str) -> bool:
        return settle(lambda: not page.running and job.history.active().id == active)

    assert settle(lambda: "held back" in page.table.item(0, 1).text())
    page.undo.click()
    assert done("one")
    page.table.selectRow(0)
    assert page.chosen() == "two"
    page.use.click()
    assert done("two")
    page.table.selectRow(0)
    page.reject_chosen("camera bumped")
    assert done("one")
    assert "camera bumped" in page.table.item(0, 3).text()
    page.reject_chosen("  ")
    assert done("one")
    assert "say why" in page.state.text()


def test_a_damaged_calibration_is_listed_with_its_reason(wizard, job, settle) -> None:
    path = job.history.keep(sample(load_rig("wide"), "one"))
    path.write_text("id: 3\n")
    wizard.show_page(4)
    assert settle(lambda: "unreadable" in wizard.save_page.table.item(0, 3).text())


def test_a_folder_without_pairs_says_so(wizard, tmp_path: Path) -> None:
    wizard.show_page(1)
    wizard.capture_page.begin_folder(tmp_path)
    assert "no picture" in wizard.capture_page.state.text()
    assert not wizard.next.isEnabled()
    assert "choose the page in the list" in wizard.next.toolTip()


def test_pictures_without_a_board_are_named(wizard, job, tmp_path: Path, settle) -> None:
    for name in ("left01.png", "right01.png"):
        cv2.imwrite(str(tmp_path / name), np.full((120, 160, 3), 90, np.uint8))
    wizard.capture_page.begin_folder(tmp_path)
    assert settle(lambda: not wizard.capture_page.running)
    assert "not used: left01.png and right01.png" in wizard.capture_page.state.text()
    assert job.pairs == 0


@pytest.mark.long("journey")
def test_too_few_pairs_fail_with_a_reason_and_nothing_to_save(
    wizard, job, pictures, tmp_path: Path, settle
) -> None:
    for name in ("left00.png", "right00.png"):
        (tmp_path / name).write_bytes((pictures / name).read_bytes())
    wizard.capture_page.begin_folder(tmp_path)
    assert settle(lambda: not wizard.capture_page.running)
    wizard.show_page(2)
    assert settle(lambda: not wizard.result_page.running)
    assert "at least 3" in wizard.result_page.state.text()
    wizard.show_page(4)
    assert "nothing new" in wizard.save_page.state.text()


@pytest.mark.long("journey")
def test_another_board_forgets_the_pictures(wizard, job, pictures, settle) -> None:
    wizard.capture_page.begin_folder(pictures)
    assert settle(lambda: not wizard.capture_page.running)
    wizard.board_page.square.setValue(12.0)
    assert job.board.square == pytest.approx(0.012)
    assert job.views == ()


def test_the_board_page_says_what_cannot_be(wizard, job, tmp_path: Path) -> None:
    page = wizard.board_page
    page.marker.setValue(30.0)
    assert "does not fit into a square" in page.state.text()
    assert not wizard.next.isEnabled()
    page.marker.setValue(8.0)
    page.square.setValue(90.0)
    assert "does not fit on A4" in page.state.text()
    assert wizard.next.isEnabled()  # a board of somebody else's
    assert not page.print.isEnabled()
    page.square.setValue(11.0)
    page.save(tmp_path / "board.pdf")
    assert (tmp_path / "board.pdf").read_bytes().startswith(b"%PDF")
    page.kind.setCurrentIndex(page.kind.findData(BoardKind.CHECKERBOARD))
    page.columns.setValue(7)
    page.rows.setValue(5)
    assert job.board.spec == "checkerboard:7x5:11mm"
    assert "half a turn" in page.state.text()


class FakeCamera:
    """Shows each picture of a folder for three reads."""

    def __init__(self, files: list[Path]) -> None:
        self._images = [cv2.imread(str(path)) for path in files]
        self._reads = 0
        self.closed = False

    def newest(self) -> CameraFrame:
        self._reads += 1
        k = min(self._reads // 3, len(self._images) - 1)
        return CameraFrame(self._images[k].copy(), float(self._reads))

    def close(self) -> None:
        self.closed = True


@pytest.fixture
def cameras(pictures) -> list[FakeCamera]:
    return [FakeCamera(sorted(pictures.glob(f"{n}*.png"))[:3]) for n in ("left", "right")]


@pytest.mark.long("journey")
def test_live_cameras_are_searched_and_let_go(application, job, cameras, destroy, settle) -> None:
    dialog = CalibrationWizard(job, lambda progress: cameras)
    destroy(dialog)
    dialog.show()
    dialog.show_page(1)
    page = dialog.capture_page
    page.begin_live()
    assert settle(lambda: page.search is not None and len(page.search.collector.kept) >= 2)
    dialog.show_page(0)
    assert dialog.pages.currentIndex() == 1  # it keeps its page while it works
    page.stop.click()
    assert all(camera.closed for camera in cameras)
    assert len(job.views) >= 2
    assert job.refused == ()
    dialog.done(0)


def test_cameras_that_do_not_open_are_told(application, job, destroy, settle) -> None:
    def refuse(progress):
        raise OSError("no such camera")

    dialog = CalibrationWizard(job, refuse)
    destroy(dialog)
    dialog.capture_page.begin_live()
    assert settle(lambda: not dialog.capture_page.running)
    assert "no such camera" in dialog.capture_page.state.text()
    dialog.close()


def test_the_verdict_follows_what_was_held_back() -> None:
    good = sample(load_rig("wide"))
    assert good.validation is not None
    assert verdict_of(good)[0] is Verdict.GOOD
    assert verdict_of(good.model_copy(update={"validation": None}))[0] is Verdict.WARNING
    off = good.validation.model_copy(update={"scale": 1.01})
    assert verdict_of(good.model_copy(update={"validation": off}))[0] is Verdict.WARNING
    far = good.validation.model_copy(update={"rms_mm": 2.0})
    assert verdict_of(good.model_copy(update={"validation": far}))[0] is Verdict.BAD
    assert verdict_of(good.model_copy(update={"rms_px": 3.0}))[0] is Verdict.BAD
    assert baseline_sd(good) > 0.0
    assert Coverage().covered == 0.0


def test_what_other_programs_wrote_is_imported_on_the_last_page(
    wizard, job, tmp_path: Path, settle
) -> None:
    theirs = sample(load_rig("wide"))
    left, right = ros_paths(tmp_path, theirs)
    write_ros(left, right, theirs)
    used = []
    wizard.used.connect(lambda: used.append(True))
    wizard.show_page(4)
    dialog = wizard.save_page.ask_import()
    assert not dialog.take.isEnabled()
    dialog.set_files([left, tmp_path / "nowhere.yaml"])
    dialog.take.click()
    assert settle(lambda: "nowhere.yaml" in dialog.state.text())
    dialog.set_files([left, right])
    dialog.size_box.setText("big")
    dialog.take.click()
    assert settle(lambda: "--size big" in dialog.state.text())
    dialog.size_box.clear()
    dialog.take.click()
    assert settle(lambda: used == [True])
    assert job.history.active().notes[0].startswith("imported: ROS")
    assert "it has no place yet" in wizard.save_page.state.text()
    table = wizard.save_page.table
    assert settle(lambda: "own uncertainty not known" in table.item(0, 1).text())


def test_the_lens_of_one_camera_is_told_from_a_calibration_of_two(tmp_path: Path) -> None:
    path = tmp_path / "lens.yaml"
    save_camera(path, sample(load_rig("wide")).cameras[0])
    with pytest.raises(CalibrationError, match="is the lens of one camera; a calibration holds"):
        read_calibration([path])


def test_the_last_board_is_there_again_and_an_unreadable_one_is_the_usual(wizard) -> None:
    told = []
    wizard.board_page.chosen.connect(told.append)
    wizard.board_page.square.setValue(12.5)
    assert last_board(told[-1]) == wizard.job.board
    assert last_board("").spec == last_board("a board of wood").spec == DEFAULT_BOARD


def test_each_picture_of_no_use_has_its_own_reason_and_no_pair_is_called_used():
    refused = [
        Rejection(RejectionReason.UNREADABLE, "has more than 8192 x 8192 pixels", "left01.png"),
        Rejection(RejectionReason.UNREADABLE, "is no picture or is damaged", "right01.png"),
    ]
    words = pairs_words(0, 0, refused)
    assert words.startswith("no pair in which both cameras see the board")
    assert "left01.png (has more than" in words
    assert "right01.png (is no picture" in words
