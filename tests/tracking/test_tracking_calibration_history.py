"""The history of calibrations: what is in use, undo and redo, and what was found bad."""

from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from calibration_samples import sample

from app.tracking.calibration.history import CalibrationHistory
from app.tracking.calibration.history_file import rejected_ids
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import StereoCalibration
from app.tracking.optics.rig import load_rig


def made(name: str) -> StereoCalibration:
    return sample(load_rig("thesis"), name)


@pytest.fixture
def history(tmp_path: Path) -> CalibrationHistory:
    start = datetime(2026, 1, 1, tzinfo=UTC)
    ticks = iter(range(1000))
    return CalibrationHistory(tmp_path / "c", lambda: start + timedelta(minutes=next(ticks)))


def active_id(history: CalibrationHistory) -> str | None:
    active = history.active()
    return None if active is None else active.id


def test_an_empty_history_has_nothing_in_use(history: CalibrationHistory) -> None:
    assert history.active() is None
    assert history.entries() == ()
    with pytest.raises(CalibrationError, match="nothing to undo"):
        history.undo()
    with pytest.raises(CalibrationError, match="used again"):
        history.redo()


def test_the_one_kept_last_is_in_use_and_undo_goes_back(history: CalibrationHistory) -> None:
    for name in ("a", "b", "c"):
        history.keep(made(name))
    assert active_id(history) == "c"
    assert history.undo() == "b"
    assert history.undo() == "a"
    assert history.undo() is None
    assert active_id(history) is None
    assert history.redo() == "a"
    assert history.redo() == "b"
    assert [entry.id for entry in history.entries()] == ["a", "b", "c"]


def test_keeping_after_undo_loses_no_calibration(history: CalibrationHistory) -> None:
    history.keep(made("a"))
    history.keep(made("b"))
    history.undo()
    history.keep(made("c"))
    with pytest.raises(CalibrationError, match="used again"):
        history.redo()
    assert {entry.id for entry in history.entries()} == {"a", "b", "c"}
    history.use("b")
    assert active_id(history) == "b"
    assert history.undo() == "c"


def test_a_rejected_calibration_is_not_used_any_more(history: CalibrationHistory) -> None:
    for name in ("a", "b", "c"):
        history.keep(made(name))
    assert history.reject("c", "  camera was\nbumped ") == "b"
    assert active_id(history) == "b"
    with pytest.raises(CalibrationError, match=r"found bad.*camera was bumped"):
        history.use("c")
    with pytest.raises(CalibrationError, match="used again"):
        history.redo()
    history.reject("a", "wrong board")
    assert history.undo() is None
    assert rejected_ids(history.folder) == {"c": "camera was bumped", "a": "wrong board"}
    assert history.load("c").id == "c"  # still there


def test_rejecting_needs_a_reason_and_a_known_calibration(history: CalibrationHistory) -> None:
    history.keep(made("a"))
    with pytest.raises(CalibrationError, match="say why"):
        history.reject("a", "  ")
    with pytest.raises(CalibrationError, match="no calibration begins with 'x'; there are a"):
        history.reject("x", "bad")


def test_an_id_is_found_by_its_beginning(history: CalibrationHistory) -> None:
    history.keep(made("2026-one"))
    history.keep(made("2026-two"))
    assert history.find("2026-t").id == "2026-two"
    with pytest.raises(CalibrationError, match=r"several.*2026-one, 2026-two"):
        history.find("2026")


@pytest.mark.promise(
    "docs/calibration.md: Files are written whole or not at all, once, and never deleted"
)
def test_a_calibration_is_never_overwritten(history: CalibrationHistory) -> None:
    history.keep(made("a"))
    history.keep(made("a"))  # the same again is no harm
    with pytest.raises(CalibrationError, match="already kept as a"):
        history.keep(made("a").model_copy(update={"rms_px": 9.0}))
    assert history.load("a").rms_px == made("a").rms_px


def test_a_file_copied_in_is_seen_and_can_be_used(history: CalibrationHistory) -> None:
    history.keep(made("a"))
    text = (history.folder / "a.yaml").read_text().replace("id: a\n", "id: z\n")
    (history.folder / "z.yaml").write_text(text)
    stray = history.find("z")
    assert stray.kept is None
    history.use("z")
    assert active_id(history) == "z"
    assert history.find("z").kept is not None


def test_a_broken_history_is_named_and_left_alone(history: CalibrationHistory) -> None:
    history.keep(made("a"))
    path = history.folder / "history.yaml"
    path.write_text("calibrations: 3\n")
    with pytest.raises(CalibrationError, match=r"history.yaml: calibrations"):
        history.keep(made("b"))
    assert path.read_text() == "calibrations: 3\n"
    path.write_text("used: [ghost]\n")
    with pytest.raises(CalibrationError, match="ghost"):
        history.entries()


def test_a_file_that_was_renamed_is_refused_by_name(history: CalibrationHistory) -> None:
    history.keep(made("a"))
    (history.folder / "b.yaml").write_text((history.folder / "a.yaml").read_text())
    with pytest.raises(CalibrationError, match="renamed"):
        history.use("b")
