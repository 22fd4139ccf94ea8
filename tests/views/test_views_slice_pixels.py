"""What a pane paints against a plain reference: greys pixel by pixel, lines and marks by places."""

from itertools import pairwise

import numpy as np
import pytest
from PySide6.QtGui import QImage

from app.imaging.oblique import Plane, oblique_image
from app.imaging.slab import Projection, slab_image
from app.imaging.window import WindowLevel, to_grey
from app.planning.draft import DraftPlan
from app.planning.error_overlay import ErrorOverlay
from app.planning.needle_overlay import NeedleOverlay
from app.views.slices.needle_source import NeedlePlanes
from app.views.slices.pane import SlicePane
from app.views.slices.panes import MPR_PANES, NEEDLE_PANES, PaneId
from app.views.slices.presentation import Presentation, Slab, Turn
from app.views.slices.presets import default_window
from app.views.slices.viewing import Viewing

SHOWN = (*MPR_PANES, *NEEDLE_PANES)
WIDE, BONE = WindowLevel(1500.0, -100.0), WindowLevel(300.0, 30.0)
MOST_PX = 0.5


@pytest.fixture
def viewing(application, volume):
    viewing = Viewing(default_window())
    viewing.set_volume(volume)
    yield viewing
    viewing.pictures.close()


@pytest.fixture(params=SHOWN, ids=str)
def pane(request, viewing, settle, destroy):
    planes = NeedlePlanes(viewing)
    planes.set_watched(True)
    viewing.set_seen(NEEDLE_PANES)
    viewing.set_tolerances((6.0, 12.0))
    axis = np.array([0.5, 0.7, 0.2]) / np.linalg.norm([0.5, 0.7, 0.2])
    tip = viewing.cursor_mm + [2.0, -1.0, 0.7]
    error = ErrorOverlay(tip, np.diag([1.0, 4.0, 2.0]))
    middle = viewing.cursor_mm
    viewing.set_draft(DraftPlan(tuple(middle - [3.0, 15.0, 4.0]), tuple(middle + [1.0, 4.0, 2.0])))
    viewing.set_needle(NeedleOverlay(tip - 100.0 * axis, tip, True, error))
    pane = SlicePane(viewing, request.param)
    destroy(pane)
    pane.resize(311, 270)
    pane.show()
    canvas = pane.canvas
    camera = canvas.camera.zoomed(1.37, 3.0, 2.0).panned(11.3, -7.7)
    canvas.set_camera(camera)
    assert settle(lambda: canvas.is_settled)
    yield pane
    planes.deleteLater()


def greys(canvas):
    """What the pane's picture has at each pixel, shape (height, width)."""
    image = canvas.feed.picture.image.convertToFormat(QImage.Format.Format_Grayscale8)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), -1)
    return rows[:, : image.width()].astype(float)


def reference(canvas, window, inverted=False):
    """Greys by the plain way: values of the plane, their grey, four of them mixed exactly."""
    plane, index, screen = canvas.plane, canvas.index, canvas.feed.wish.screen
    slab = plane.presentation.slab
    if plane.is_native:
        values, (left, top, width, height) = (
            np.ascontiguousarray(plane.image(index)),
            (plane.bounds_mm),
        )
    else:
        region = canvas.feed.wish.region
        columns, rows, size = region.columns, region.rows, region.pixel_mm
        left, top, width, height = region.left, region.top, columns * size, rows * size
        frame = plane.frame(index)
        corner = frame.lps_mm(left + size / 2, top + size / 2)
        pixels = Plane(corner, size * frame.right, size * frame.down, columns, rows)
        volume = canvas.viewing.volume
        if slab:
            values = slab_image(volume, pixels, slab.thickness_mm, Projection(slab.kind))
        else:
            values = oblique_image(volume, pixels)
    grey = to_grey(values, window).astype(float)
    if inverted:
        grey = 255.0 - grey
    x = (np.arange(screen.width) + 0.5) / screen.scale + screen.left
    y = (np.arange(screen.height) + 0.5) / screen.scale + screen.top
    along = []
    for at, low, extent, count in ((x, left, width, grey.shape[1]),
                                   (y, top, height, grey.shape[0])):  # fmt: skip
        place = np.clip((at - low) / extent * count - 0.5, 0.0, count - 1.0)
        first = np.minimum(place.astype(int), max(count - 2, 0))
        along.append((first, np.minimum(first + 1, count - 1), place - first,
                      (at - low) / extent))  # fmt: skip
    (c, d, u, across), (r, s, v, down) = along
    mixed = (1 - v)[:, None] * grey[r] + v[:, None] * grey[s]
    mixed = (1 - u) * mixed[:, c] + u * mixed[:, d]
    inside = ((down > 0) & (down < 1))[:, None] & ((across > 0) & (across < 1))
    edge = (np.minimum(np.abs(down), np.abs(1 - down)) < 1e-9)[:, None] | (
        np.minimum(np.abs(across), np.abs(1 - across)) < 1e-9
    )
    return np.where(inside, mixed, 0.0), edge


@pytest.mark.parametrize("presentation", [
    Presentation(), Presentation(Slab("mean", 6.0)), Presentation(Slab("mip", 9.0), Turn(1, True)),
    Presentation(Slab("minip", 5.0), Turn(2)), Presentation(turn=Turn(3)),
], ids=["plain", "mean", "mip turned", "minip", "turned"])  # fmt: skip
@pytest.mark.parametrize(("window", "inverted"), [(WIDE, False), (BONE, True)])
def test_every_pixel_is_the_plain_references_to_one_grey_level(
    pane, viewing, settle, presentation, window, inverted
):
    viewing.set_presentation(pane.pane, presentation)
    viewing.set_window(window)
    viewing.greys.set_inverted(inverted)
    canvas = pane.canvas
    assert settle(lambda: canvas.is_settled)
    expected, edge = reference(canvas, window, inverted)
    off = np.abs(greys(canvas) - expected)
    assert off[~edge].max() <= 1.0
    assert edge.mean() < 0.02


def test_every_line_and_mark_lies_within_half_a_pixel_of_where_it_belongs(pane, viewing):
    canvas = pane.canvas
    canvas.flush()
    plane, index, needle = canvas.plane, canvas.index, viewing.needle

    def pixel(point):
        """By the plain way: a matrix of the plane's directions, then the camera."""
        frame = plane.frame(index)
        offset = np.asarray(point) - frame.origin_mm
        x, y = offset @ frame.right, offset @ frame.down
        camera, size = canvas.camera, np.array([canvas.width(), canvas.height()])
        return (np.array([x, y]) - [camera.x, camera.y]) * camera.scale + size / 2.0

    def away(shape, point):
        at = canvas._to_pixels.map(shape.x(), shape.y())
        return float(np.hypot(*(np.array(at) - pixel(point))))

    layers = canvas.layers
    draft = viewing.shown_draft
    for shape, point in ((layers.needle.tip, needle.tip_mm), (layers.plan.entry, draft.entry_mm),
                         (layers.plan.target, draft.target_mm)):  # fmt: skip
        assert shape.isVisible()
        assert away(shape, point) <= MOST_PX
    for segment, start, end in ((layers.needle._shaft[0], needle.start_mm, needle.tip_mm),
                                (layers.plan._path, draft.entry_mm, draft.target_mm)):  # fmt: skip
        start, end = pixel(start), pixel(end)
        lines = [[np.array(canvas._to_pixels.map(end).toTuple()) for end in item.lines[0]]
                 for item in segment._items if item.isVisible()]  # fmt: skip
        along = (end - start) / max(np.linalg.norm(end - start), 1e-9)

        def off(point, start=start, along=along):
            beside = point - start
            return abs(beside[0] * along[1] - beside[1] * along[0])

        assert max(off(place) for line in lines for place in line) <= MOST_PX
        joined = sorted(lines, key=lambda line: (line[0] - start) @ along)
        assert np.linalg.norm(joined[0][0] - start) <= MOST_PX
        assert np.linalg.norm(joined[-1][1] - end) <= MOST_PX
        for one, other in pairwise(joined):
            assert np.linalg.norm(one[1] - other[0]) <= MOST_PX
    for ring, radius in zip(layers.disc.rings, viewing.tolerances_mm, strict=True):
        if ring.isVisible():
            middle = canvas._to_pixels.mapRect(ring.boundingRect())
            assert np.linalg.norm(np.array(middle.center().toTuple())
                                  - pixel(draft.target_mm)) <= MOST_PX  # fmt: skip
            assert abs(middle.width() / 2.0 - radius * canvas.camera.scale) <= MOST_PX
    tip = canvas._to_pixels.mapRect(layers.errors.tip.boundingRect())
    assert np.linalg.norm(np.array(tip.center().toTuple()) - pixel(needle.tip_mm)) <= MOST_PX
    for other, line in layers.crosshair._lines.items():
        _in_both(canvas, line, viewing.frame(other))
    for other, line in (layers.traces.lines if layers.traces else {}).items():
        _in_both(canvas, line, viewing.frame(other))
    if layers.ticks is not None:
        ticks = layers.ticks.item.ticks
        ahead = needle.tip_mm - needle.start_mm
        ahead = ahead / np.linalg.norm(ahead)
        if pane.pane is not PaneId.PROBE:  # which looks along the needle
            for number, tick in enumerate(ticks, start=1):
                at = np.array(canvas._to_pixels.map(tick).toTuple())
                assert np.linalg.norm(at - pixel(needle.tip_mm + 10.0 * number * ahead)) <= MOST_PX


def _in_both(canvas, line, frame):
    """Whether a line of this plane lies in another one too, to half a pixel."""
    if not line.isVisible():
        return
    for ends in line.lines:
        for place in ends:
            point = canvas.plane.lps_mm(place.x(), place.y(), canvas.index)
            assert abs(frame.point(point)[2]) * canvas.camera.scale <= MOST_PX
