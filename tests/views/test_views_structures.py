"""Structures in the window: book, outlines, brush, panel and warnings."""

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPointF, QRectF, Qt
from PySide6.QtGui import QImage, QMouseEvent, QPainter, QTransform
from window_rig import plan

import app.views.structures.book as book_module
import app.views.structures.panel as panel_module
from app.exercises.parts import StructurePart
from app.imaging.structures.distance import SignedDistance
from app.imaging.structures.structure import Structure, StructureKind, StructureSet
from app.imaging.volume import Volume
from app.planning.clearance import Nearness
from app.planning.draft import DraftPlan
from app.planning.needle_overlay import NeedleOverlay
from app.views.exercise.feature import ExerciseFeature
from app.views.slices.pane import SlicePane
from app.views.slices.panes import PaneId
from app.views.slices.presets import default_window
from app.views.slices.viewing import Tool, Viewing
from app.views.structures.book import StructureBook
from app.views.structures.brush import Brush, BrushGrip, Mode
from app.views.structures.feature import StructuresFeature
from app.views.structures.layer import StructureLayer, StructureOutline, draw_in
from app.views.structures.panel import KIND, NAME, PATH, StructurePanel
from app.views.structures.watch import StructureWatch, words


def ball(volume: Volume, centre, radius):
    from app.imaging.structures.edit import brushed

    return brushed(None, volume, np.asarray(centre, float), radius, True)


@pytest.fixture
def book(application, volume):
    book = StructureBook()
    book.set_volume(volume)
    centre = volume.lps_mm((np.array(volume.size) - 1) / 2)
    book.put("vessel", *ball(volume, centre, 8.0))
    book.change("vessel", kind=StructureKind.VESSEL, warn_mm=3.0)
    return book


def centre_of(book):
    return book.structures.structures[0].centre_mm


def measured(book):
    for one in book.unmeasured:
        book.set_field(one, SignedDistance.of(one))


def test_every_change_can_be_undone_and_visibility_is_no_step(book):
    book.set_visible("vessel", False)
    assert book.visible == ()
    book.change("vessel", name="aorta")
    assert not book.is_visible("aorta")
    book.undo()
    assert book.structures.find("vessel").kind is StructureKind.VESSEL
    book.remove("vessel")
    assert len(book.structures) == 0
    book.undo()
    assert len(book.structures) == 1
    book.redo()
    assert len(book.structures) == 0


def test_nothing_changes_while_an_attempt_runs(book):
    said = []
    book.refused.connect(said.append)
    book.set_locked(True)
    book.remove("vessel")
    book.undo()
    assert len(book.structures) == 1
    assert "attempt runs" in str(said[0])


def test_steps_of_large_structures_are_forgotten_before_they_fill_the_memory(
    book, volume, monkeypatch
):
    mask, corner = ball(volume, centre_of(book), 12.0)
    monkeypatch.setattr(book_module, "MOST_KEPT", 4 * mask.nbytes)
    for _ in range(20):
        book.put("vessel", mask.copy(), corner)
        book.change("vessel", warn_mm=len(book._history.past) % 7)  # shares its mask
    held = {id(one.mask): one.mask.nbytes for past in book._history.past for one in past}
    assert sum(held.values()) <= 5 * mask.nbytes
    for _ in range(6):
        assert book.can_undo
        book.undo()


def test_a_step_that_is_too_large_can_be_undone_still(book, volume, monkeypatch):
    monkeypatch.setattr(book_module, "MOST_KEPT", 0)
    before = book.structures.find("vessel").mask
    book.put("vessel", *ball(volume, centre_of(book), 12.0))
    book.undo()
    assert book.structures.find("vessel").mask is before


def test_a_bad_name_is_refused_and_a_taken_one_gets_a_number(book):
    said = []
    book.refused.connect(said.append)
    book.change("vessel", name="")
    assert "no name" in str(said[0])
    book.add(StructureSet((book.structures.find("vessel"),)))
    book.change("vessel 2", name="vessel")
    assert [one.name for one in book.structures] == ["vessel", "vessel 2"]


def test_distances_outlive_a_new_name_but_not_other_voxels(book, volume):
    measured(book)
    book.change("vessel", name="aorta", kind=StructureKind.RISK)
    assert book.unmeasured == ()
    book.put("aorta", *ball(volume, centre_of(book), 5.0))
    assert len(book.unmeasured) == 1


@pytest.mark.parametrize("pane", [PaneId.AXIAL, PaneId.SAGITTAL, PaneId.CORONAL])
def test_an_outline_is_drawn_where_the_structure_is(book, volume, pane):
    viewing = Viewing(default_window())
    view = SlicePane(viewing, pane)
    view.resize(300, 300)
    layer = StructureLayer(view.canvas.drawing, book)
    view.canvas.add_layer(layer)
    viewing.set_volume(volume)
    viewing.set_cursor(centre_of(book))
    view.canvas.flush()
    plane = view.canvas.plane
    item = layer._items["vessel"]
    at = plane.point(centre_of(book), view.canvas.index)
    assert item.isVisible()
    assert item._path.contains(QPointF(at.x, at.y))
    rect = item._path.boundingRect()
    assert rect.width() == pytest.approx(16.0, abs=3.5)
    viewing.show_slice(pane, 0)
    view.canvas.flush()
    assert not item.isVisible()
    viewing.set_cursor(centre_of(book))
    book.set_visible("vessel", False)
    view.canvas.refresh()
    view.canvas.flush()
    assert layer._items == {}


def test_the_name_of_a_mark_stays_off_that_of_a_structure(book, volume, destroy):
    viewing = Viewing(default_window())
    pane = SlicePane(viewing, PaneId.AXIAL)
    destroy(pane)
    pane.resize(500, 400)
    pane.show()
    viewing.set_volume(volume)
    draw_in(pane.canvas, book)
    centre = np.array(centre_of(book))
    for away in np.linspace(-8.0, 8.0, 9):  # round the upper end of the outline, where its name is
        viewing.set_draft(DraftPlan(None, tuple(centre + [away, -9.0, 0.0])))
        pane.canvas.flush()
        ((name,),) = [names() for names in pane.canvas.layers._names]
        ends = (pane.canvas.pixel_at(p.x(), p.y()) for p in (name.topLeft(), name.bottomRight()))
        mark = pane.canvas.layers.plan.target
        label = mark.label_rect.translated(pane.canvas.pixel_at(mark.x(), mark.y()))
        assert not label.intersects(QRectF(*ends))
    viewing.pictures.close()


def test_the_picture_of_an_outline_is_drawn_once_and_looks_like_the_outline(book, volume):
    outline = StructureOutline(1.5)
    square = np.array([[0.0, 0.0], [20.0, 0.0], [20.0, 12.0], [0.0, 12.0]])
    one = book.structures.find("vessel")
    outline.set_lines(one, [square])
    outline.set_style(one, 4.0, bold=False)
    drawn, draw = [], outline._draw
    outline._draw = lambda painter: (drawn.append(1), draw(painter))

    def painted(dx, paint=outline.paint):
        picture = QImage(160, 120, QImage.Format.Format_ARGB32_Premultiplied)
        picture.fill(Qt.GlobalColor.gray)
        with QPainter(picture) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setTransform(QTransform(4.0, 0.0, 0.0, 4.0, 30.25 + dx, 30.5))
            paint(painter)
            assert painter.transform().dx() == 30.25 + dx
        return np.array(picture.constBits()).reshape(120, 160, 4).astype(int)

    assert np.abs(painted(0.0) - painted(0.0, draw)).max() <= 3
    assert np.array_equal(painted(0.0)[:, :-20], painted(20.0)[:, 20:])  # moved by whole pixels
    assert len(drawn) == 1
    outline.set_style(one, 4.0, bold=True)
    assert np.abs(painted(0.0) - painted(0.0, draw)).max() <= 3
    assert len(drawn) == 2
    painted(0.4)  # by half a pixel: drawn anew
    assert len(drawn) == 3


def press(canvas, x, y):
    kind = QEvent.Type.MouseButtonPress
    left, none = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    return QMouseEvent(kind, QPointF(x, y), QPointF(x, y), left, left, none)


def test_a_stroke_of_the_brush_is_one_step_and_grows_what_it_touches(book, volume):
    viewing = Viewing(default_window())
    view = SlicePane(viewing, PaneId.AXIAL)
    view.resize(400, 400)
    viewing.set_volume(volume)
    viewing.set_cursor(centre_of(book))
    brush = Brush()
    grip = BrushGrip(view.canvas, book, brush)
    before = book.structures.find("vessel").mask.sum()
    at = view.canvas.plane.point(centre_of(book), view.canvas.index)
    start = view.canvas.pixel_at(at.x, at.y)
    event = press(view.canvas, start.x(), start.y())
    assert not grip.grab(start, event)
    brush.set(mode=Mode.PAINT, radius_mm=6.0)
    assert grip.grab(start, event)
    for mm in range(0, 16, 2):
        grip.drag(view.canvas.pixel_at(at.x + mm, at.y))
    grip.drop(start)
    assert book.structures.find("vessel").mask.sum() > before
    book.undo()
    assert book.structures.find("vessel").mask.sum() == before
    brush.set(mode=Mode.ERASE, radius_mm=40.0)
    grip.grab(start, event)
    assert len(book.structures) == 0
    book.undo()
    assert len(book.structures) == 1


def overlay(volume, tip, valid=True):
    return NeedleOverlay(np.asarray(tip) - [0.0, 150.0, 0.0], np.asarray(tip), valid, None)


def test_the_needle_is_warned_once_and_again_after_it_went_away(book, volume, monkeypatch):
    measured(book)
    watch = StructureWatch(book)
    now = [10.0]
    monkeypatch.setattr("app.views.structures.watch.monotonic", lambda: now[0])
    events, shown = [], []
    watch.breached.connect(events.append)
    watch.needle_changed.connect(shown.append)

    def at(distance):
        now[0] += 0.1
        watch.set_needle(overlay(volume, centre_of(book) - [0.0, 8.0 + distance, 0.0]))

    for distance in (9.0, 2.0, 1.8, 2.2, -3.0, -4.0, -1.0, 2.0):
        at(distance)
    assert [event.kind for event in events] == ["breach", "breach"]
    assert "mm from vessel" in events[0].message
    assert "in vessel" in events[1].message
    at(9.0)
    assert watch.needle is None
    assert shown[-1] is None
    at(1.5)
    assert len(events) == 3
    assert watch.needle.nearness is Nearness.NEAR
    watch.set_needle(overlay(volume, centre_of(book), valid=False))
    assert watch.needle is None  # what is not tracked is not judged
    at(1.5)
    watch.set_needle(None)
    assert watch.needle is None


def test_a_kind_has_room_for_its_word_in_another_language(book, monkeypatch):
    names = dict.fromkeys(StructureKind, "vaisseau sanguin")
    monkeypatch.setattr(panel_module, "kind_names", lambda: names)
    table = StructurePanel(book, StructureWatch(book), Brush()).table
    assert table.columnWidth(KIND) >= table.cellWidget(0, KIND).sizeHint().width()


def test_the_panel_shows_the_path_and_changes_the_book(book, volume):
    measured(book)
    watch = StructureWatch(book)
    panel = StructurePanel(book, watch, Brush())
    centre = centre_of(book)
    watch.set_draft(DraftPlan(tuple(centre - [0, 30, 0]), tuple(centre + [0, 30, 0])))
    assert panel.table.item(0, PATH).text().startswith("✖ -")
    watch.set_draft(DraftPlan(tuple(centre - [40, 30, 0]), tuple(centre + [-40, 30, 0])))
    assert panel.table.item(0, PATH).text().startswith("✔ 3")
    panel.table.item(0, NAME).setCheckState(Qt.CheckState.Unchecked)
    assert book.visible == ()
    panel.table.item(0, NAME).setText("aorta")
    assert book.structures.structures[0].name == "aorta"
    panel.table.cellWidget(0, 2).setValue(7.5)
    assert book.structures.find("aorta").warn_mm == 7.5
    box = panel.table.cellWidget(0, 1)
    box.setCurrentIndex(box.findData("target"))
    box.activated.emit(box.currentIndex())
    assert book.structures.find("aorta").kind is StructureKind.TARGET
    assert panel.table.cellWidget(0, 2).value() == 0.0
    panel.show_needle(None, "")
    assert panel.live.text() == "✔  " or panel.live.text() == ""
    panel.remove.click()
    assert panel.table.rowCount() == 0
    assert "No structures" in panel.note.text()


def test_a_warning_has_words(book, volume):
    measured(book)
    watch = StructureWatch(book)
    watch.set_needle(overlay(volume, centre_of(book) - [0.0, 10.0, 0.0]))
    assert words(watch.needle).endswith("mm from vessel")


# --- in the window -------------------------------------------------------------------------------
def test_one_undo_takes_back_plan_and_structures_in_order(window, patient, settle) -> None:
    window.show_patient(patient)
    plan(window)
    book, edit = window.editors.structures, window.editor
    entry = edit.edit.draft.entry_mm
    book.put("a", *ball(patient.volume, (5.0, 0.0, 140.0), 5.0))
    window.editor.place(Tool.ENTRY, (8.0, -18.0, 140.0), True)
    book.put("b", *ball(patient.volume, (5.0, 0.0, 150.0), 5.0))
    book.put("b", *ball(patient.volume, (5.0, 0.0, 150.0), 6.0), starts_step=False)  # the stroke
    window.undo.undo()
    assert [one.name for one in book.structures] == ["a"]
    window.undo.undo()
    assert edit.edit.draft.entry_mm == entry
    window.undo.undo()
    assert len(book.structures) == 0
    for _ in range(3):
        window.undo.redo()
    assert [one.name for one in book.structures] == ["a", "b"]
    assert edit.edit.draft.entry_mm != entry
    book.set_locked(True)
    window.undo.undo()  # the attempt keeps the structures; the plan's step goes back
    assert [one.name for one in book.structures] == ["a", "b"]


@pytest.fixture
def with_structures(window, patient, tmp_path):
    """An exercise whose file of structures was drawn on the CT that is shown."""
    pytest.importorskip("nrrd")
    from app.imaging.structures.files import write_structures

    parts = (("vessel", (5.0, 0.0, 140.0)), ("liver", (10.0, 5.0, 140.0)))
    made = [Structure.of(name, filled(patient.volume, centre), patient.volume)
            for name, centre in parts]  # fmt: skip
    path = tmp_path / "a.seg.nrrd"
    write_structures(path, StructureSet(tuple(made)), patient.volume)
    first = next(iter(window.feature(ExerciseFeature).exercises.values()))

    def exercise(name="vessel", file=path):
        part = StructurePart(file=file, risks={name: 4.0})
        return first.model_copy(update={"structures": (part,)})

    return exercise


def filled(volume: Volume, centre):
    mask = np.zeros(volume.hu.shape, bool)
    box, (i, j, k) = ball(volume, centre, 5.0)
    mask[k : k + box.shape[0], j : j + box.shape[1], i : i + box.shape[2]] = box
    return mask


@pytest.mark.long("journey")
def test_structures_of_an_exercise_come_with_its_ct(
    window, patient, with_structures, settle, monkeypatch
) -> None:
    monkeypatch.setattr(window.conductor, "fits", lambda _: True)
    window.conductor.set_exercise(with_structures())
    window.show_patient(patient)
    book = window.editors.structures
    assert settle(lambda: len(book.structures) == 2)
    vessel, liver = book.structures.find("vessel"), book.structures.find("liver")
    assert (vessel.kind, vessel.warn_mm) == (StructureKind.RISK, 4.0)
    assert liver.kind is not StructureKind.RISK
    assert not window.undo.can_undo
    plan(window)
    assert settle(lambda: "vessel" in window.feature(StructuresFeature).watch.path)
    other = next(e for e in window.feature(ExerciseFeature).exercises.values() if not e.structures)
    window.conductor.set_exercise(other)
    assert settle(lambda: len(book.structures) == 0)


def test_structures_that_an_exercise_lacks_are_said(
    window, patient, with_structures, settle, monkeypatch, tmp_path
) -> None:
    monkeypatch.setattr(window.conductor, "fits", lambda _: True)
    said = []
    window.feature(StructuresFeature).failed.connect(said.append)
    window.conductor.set_exercise(with_structures("spleen"))
    window.show_patient(patient)
    assert settle(lambda: bool(said))
    assert "there is no structure 'spleen'; there are: vessel, liver" in str(said[0])
    window.conductor.set_exercise(with_structures(file=tmp_path / "gone.nrrd"))
    assert settle(lambda: len(said) > 1)
    assert "gone.nrrd" in str(said[1])
