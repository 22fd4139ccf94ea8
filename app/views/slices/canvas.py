"""One slice on the screen: picture, shapes and words, painted in one pass by one painter.

A `PlaneView` is the part of the plane that a pane shows, and where its pixels lie: pan, zoom and
the mouse.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

from numpy.typing import NDArray
from PySide6.QtCore import QEvent, QPointF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QHideEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
    QShowEvent,
    QTransform,
    QWheelEvent,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.core.arrays import FloatArray
from app.views.kit import theme
from app.views.slices.camera import SliceCamera
from app.views.slices.drawing import Drawing
from app.views.slices.items import MarkItem
from app.views.slices.layers import (
    ALL_LAYERS,
    RUNNING_ON,
    WAITED_FOR,
    Due,
    Layer,
    LayerStack,
    Names,
)
from app.views.slices.pace import Unhurried
from app.views.slices.panes import PaneId
from app.views.slices.pictures import Picture, PictureFeed, Screen
from app.views.slices.plane import Rect, SlicePlane
from app.views.slices.presentation import Turn
from app.views.slices.viewing import Viewing
from app.views.slices.words import Written


class Gestures(Protocol):
    """What the canvas hands its mouse events to."""

    def press(self, event: QMouseEvent) -> None:
        """Take a button that went down."""

    def move(self, event: QMouseEvent) -> None:
        """Take a move, with or without a button."""

    def release(self, event: QMouseEvent) -> None:
        """Take a button that went up."""

    def wheel(self, event: QWheelEvent) -> None:
        """Take a turn of the wheel."""


class PlaneView(QWidget):
    """Looks at the plane of one pane; places are right at once, whatever is drawn yet.

    Hands over what the mouse does, and leaves the keys to the pane.

    Attributes:
        viewing: whose planes.
        pane: which of them.
        plane: the plane; None where there is none.
        camera: pan and zoom.
        gestures: who takes the mouse; nobody at first.

    Signals:
        left(): the mouse left the pane.
        double_clicked(): for maximising.
        ctrl_double_clicked(): for the window that there was at first.
    """

    left = Signal()
    double_clicked = Signal()
    ctrl_double_clicked = Signal()

    def __init__(self, viewing: Viewing, pane: PaneId, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.viewing, self.pane = viewing, PaneId(pane)
        self.plane: SlicePlane | None = None
        self.camera = SliceCamera(0.0, 0.0, 1.0)
        self.gestures: Gestures | None = None
        self._fitted = True
        self._size = (1, 1)
        self._visible: Rect = (0.0, 0.0, 1.0, 1.0)
        self._to_pixels = QTransform()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    @property
    def index(self) -> float:
        """Slice that is shown; whole where the volume's own slices are."""
        return self.viewing.index(self.pane)

    @property
    def visible_mm(self) -> Rect:
        """Rectangle of the plane that the pane shows."""
        return self._visible

    def sizeHint(self) -> QSize:
        """Return a size for a pane by itself."""
        return QSize(256, 192)

    def minimumSizeHint(self) -> QSize:
        """Return the least that a slice is of use in."""
        return QSize(72, 72)

    # --- pan and zoom -------------------------------------------------------------------------
    def fit(self) -> None:
        """Show the whole image, and keep doing so when the pane is resized."""
        if self.plane is not None:
            self.set_camera(SliceCamera.fit(self.plane.home_mm, (self.width(), self.height())))
            self._fitted = True

    def set_camera(self, camera: SliceCamera) -> None:
        """Pan and zoom to `camera`."""
        self.camera, self._fitted = camera, False
        self._see()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the image fitted, or its middle in the middle."""
        super().resizeEvent(event)
        if self._fitted and self.plane is not None:
            self.fit()
        else:
            self._see()

    def _keep_crosshair(self, before: SlicePlane, plane: SlicePlane) -> None:
        """Let the crosshair stay at its pixel, wherever the new plane counts from."""
        cursor = self.viewing.cursor_mm
        old, new = before.point(cursor, 0.0), plane.point(cursor, 0.0)
        right, down = new.x - old.x, new.y - old.y
        if max(abs(right), abs(down)) > 1e-6:
            camera, fitted = self.camera, self._fitted
            self.set_camera(SliceCamera(camera.x + right, camera.y + down, camera.scale))
            self._fitted = fitted

    def _see(self) -> None:
        """Take what is seen from the camera; every place is asked of it."""
        self._size = (self.width(), self.height())
        self._visible = self.camera.visible(self._size)
        self._camera_moved()

    def _camera_moved(self) -> None:
        """Show it; who draws more than a picture may do so later."""
        self._apply_camera()

    def _apply_camera(self) -> None:
        """Let what is drawn from now on stand where the camera has it."""
        scale, (left, top, _, _) = self.camera.scale, self._visible
        self._to_pixels = QTransform(scale, 0.0, 0.0, scale, -left * scale, -top * scale)

    # --- places -------------------------------------------------------------------------------
    def plane_at(self, position: QPointF) -> tuple[float, float]:
        """Plane point [mm] under a pixel of the pane."""
        x, y, _, _ = self._visible
        return x + position.x() / self.camera.scale, y + position.y() / self.camera.scale

    def lps_at(self, position: QPointF) -> FloatArray:
        """LPS point [mm] under a pixel of the pane; the crosshair's point without a volume."""
        if self.plane is None:
            return self.viewing.cursor_mm
        return self.plane.lps_mm(*self.plane_at(position), self.index)

    def pixel_at(self, x: float, y: float) -> QPointF:
        """Pixel of the pane at a plane point [mm]."""
        left, top, _, _ = self._visible
        return QPointF((x - left) * self.camera.scale, (y - top) * self.camera.scale)

    # --- mouse and keys -----------------------------------------------------------------------
    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Hand over."""
        if self.gestures is not None:
            self.gestures.press(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Hand over."""
        if self.gestures is not None:
            self.gestures.move(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Hand over."""
        if self.gestures is not None:
            self.gestures.release(event)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Hand over."""
        if self.gestures is not None:
            self.gestures.wheel(event)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Ask to be maximised or restored; with Ctrl for the first window."""
        if event.button() is Qt.MouseButton.LeftButton:
            ctrl = event.modifiers() & Qt.KeyboardModifier.ControlModifier
            (self.ctrl_double_clicked if ctrl else self.double_clicked).emit()

    def leaveEvent(self, event: QEvent) -> None:
        """Tell the read-outs."""
        self.left.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Leave the keys to the pane."""
        event.ignore()

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        """Leave the keys to the pane."""
        event.ignore()


class SliceCanvas(PlaneView):
    """Draws the slice of one pane.

    Changes are gathered until the event loop comes round, and drawn together: a needle that moves
    changes planes, crosshair and itself, and every layer is placed once. The picture is made beside
    the window's thread, and what lies over it waits for it. Under a needle that moves, and while
    somebody drags the window, words are written anew only as often as they can be read. A canvas
    that nobody sees draws nothing until it is shown.

    Attributes:
        drawing: the shapes over the picture.
        written: the words over everything.
        layers: who places the shapes.
        feed: where the picture comes from.

    Signals:
        painted(): all that was due is on the screen.
        changed(): slice, window, zoom or pan is another: the read-outs are out of date.
        plane_taken(): the plane is another one, or gone.
        seen(): the pane was shown or hidden.
    """

    painted = Signal()
    changed = Signal()
    plane_taken = Signal()
    seen = Signal()
    _wanted = Signal()

    def __init__(self, viewing: Viewing, pane: PaneId, parent: QWidget | None = None) -> None:
        super().__init__(viewing, pane, parent)
        self._turn = Turn()
        self._due: set[Due] = set()
        self._slice: tuple[SlicePlane, float] | None = None
        self._asked = self._begun = False
        self._painted: Picture | None = None
        self._wanted.connect(self._draw_together, Qt.ConnectionType.QueuedConnection)
        self._words = Unhurried(self._write, self)
        self.feed = PictureFeed(viewing.pictures, self._draw)
        self.destroyed.connect(self.feed.drop)
        self._seen = self._screen = Screen(0.0, 0.0, 1.0, 1, 1, 1.0)
        self.drawing = Drawing(self.update)
        self.written: list[Written] = []
        self.layers = LayerStack(self.drawing, viewing, self.pane)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)  # nothing shows below
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)
        self._background = QColor(theme.IMAGE_BACKGROUND)
        self._connect(viewing)

    def _connect(self, viewing: Viewing) -> None:
        viewing.volume_changed.connect(self.show_volume)
        viewing.cursor_changed.connect(lambda: self._want(Due.CROSSHAIR))
        viewing.traces_changed.connect(lambda: self._want(Due.CROSSHAIR))
        viewing.plane_changed.connect(self._show_plane)
        viewing.presentation_changed.connect(self._show_presentation)
        viewing.window_changed.connect(lambda: self._want(Due.GREYS))
        viewing.plan_changed.connect(lambda: self._want(Due.PLAN))
        viewing.needle_changed.connect(lambda: self._want(Due.NEEDLE))
        viewing.needle_shown.connect(self._begin)

    # --- what is shown ------------------------------------------------------------------------
    @property
    def values(self) -> NDArray[Any]:
        """Hounsfield units of the picture, on `values_mm`, shape (rows, columns)."""
        return self.feed.hu

    @property
    def values_mm(self) -> Rect:
        """Left, top, width and height [mm] of the picture in the plane."""
        return self.feed.bounds_mm

    @property
    def is_drawn(self) -> bool:
        """Return whether picture and shapes are those of now; words may follow."""
        return not (self._due or self.feed.is_waiting)

    @property
    def is_settled(self) -> bool:
        """Return whether all that there is has been drawn, and no picture is still to come."""
        return self.is_drawn and not self._words.is_waiting

    def add_layer(
        self, layer: Layer, marks: Sequence[MarkItem] = (), names: Names | None = None
    ) -> None:
        """Draw something more over the slice.

        Args:
            layer: placed whenever slice, plane or zoom change; its shapes stand in `drawing`. Who
                changes what it shows calls `refresh`.
            marks: those of its marks whose names shall be arranged with the others'.
            names: returns the places of words that it writes itself [mm]: marks' names keep off.
        """
        self.layers.add(layer, marks, names)
        self.refresh()

    def refresh(self) -> None:
        """Place the added layers anew, because what they show has changed."""
        self._want(Due.ADDED)

    def rewrite(self) -> None:
        """Write the read-outs anew, because what they say has changed."""
        self._want(Due.WORDS)

    def show_volume(self) -> None:
        """Take the viewing's volume and fit it; nothing of the last one stays."""
        self._clear()
        self._take_plane()
        self.fit()

    def _show_plane(self, pane: PaneId) -> None:
        """Take another plane, or show another's trace; zoom and pan stay."""
        if pane is not self.pane:
            if pane in self.layers.traced:
                self._want(Due.CROSSHAIR)
            return
        before = self.plane
        self._take_plane()
        if before is None:
            self.fit()
        elif self.plane is not None and not self.pane.is_needle:
            self._keep_crosshair(before, self.plane)
        self._want(Due.CROSSHAIR)

    def _show_presentation(self, pane: PaneId) -> None:
        """Fit what has been turned; a slab leaves zoom and pan."""
        turn = self.viewing.presentation(self.pane).turn
        if pane is self.pane and turn != self._turn:
            self._turn = turn
            self._take_plane()  # first, or the crosshair would be kept at its pixel afterwards
            self.fit()

    def _take_plane(self) -> None:
        plane = self.viewing.plane(self.pane)
        if plane is not self.plane:
            self.plane = plane
            self.plane_taken.emit()
            self._want(Due.WORDS)
        if plane is None:
            self._clear()

    @property
    def _is_interpolated(self) -> bool:
        return self.plane is not None and not self.plane.is_native

    def _clear(self) -> None:
        """Draw nothing: what was there is no longer true."""
        self.feed.drop()
        self._slice = None
        self.update()
        self.layers.hide()

    # --- drawing ------------------------------------------------------------------------------
    def _want(self, *due: Due) -> None:
        self._due.update(due)
        self._begun = False
        if not self._asked and self.isVisible():
            self._asked = True
            self._wanted.emit()

    def _camera_moved(self) -> None:
        self._want(Due.CAMERA)

    def _begin(self) -> None:
        """Let the picture be made while the window's thread is still busy with other things."""
        if self._asked:
            self._fetch()
            self._begun = True

    def _draw_together(self) -> None:
        """Draw what has changed, or wait with it for the picture that belongs to it."""
        if not self._asked:
            return  # it has been drawn meanwhile
        self._asked = False
        if not self._begun:
            self._fetch()
        if Due.CAMERA in self._due:  # zoomed and panned at once; what is interpolated follows
            self.feed.finish()
        elif self.feed.is_near:
            return
        self._draw()

    def flush(self) -> None:
        """Draw at once what has changed, each layer once, and write every word."""
        self._asked = False
        self._fetch()
        self.feed.finish()
        self._draw(as_it_is_now=True)
        if self._words.is_waiting:
            self._words.do()

    def _draw(self, as_it_is_now: bool = False) -> None:
        """Put everything where it belongs over the picture that there is.

        Where the next picture is on its way already, everything lies on the plane of the last one.
        """
        due, self._due = self._due, set()
        plane, index = self.plane, self.index
        if plane is None:
            self.changed.emit()
            return
        picture = self.feed.picture
        if picture is not None and self.feed.is_near and not as_it_is_now:
            plane, index = picture.wish.plane, picture.wish.index
        moved, zoomed = self._slice != (plane, index), Due.CAMERA in due
        if zoomed:
            self._apply_camera()
            self._screen = self._seen
        self._slice = plane, index
        layers = ALL_LAYERS if moved or zoomed else due & ALL_LAYERS
        if layers:
            self.layers.place(layers, plane, index, self.camera.scale)
        if moved or zoomed or due - {Due.CROSSHAIR}:
            hurried = (due & RUNNING_ON or not due) and not due & WAITED_FOR
            (self._words.ask if hurried else self._words.do)()
        if zoomed or picture is not self._painted:
            self.update()

    def _write(self) -> None:
        """Write the read-outs, and find the names of marks their places beside them."""
        self.changed.emit()
        plane, (width, height) = self.plane, self._size
        if plane is not None:
            taken = [one.geometry().united(one.held) for one in self.written if not one.is_empty]
            self.layers.arrange_labels(plane, self.index, (width, height), self.pixel_at, taken)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the picture, the shapes over it, and the words over both."""
        picture, screen = self.feed.picture, self._screen
        self._painted = picture
        painter = QPainter(self)
        fits = picture is not None and picture.wish.screen == screen
        if not fits:
            painter.fillRect(event.rect(), self._background)
            if picture is not None:
                painter.setTransform(self._to_pixels)
                picture.paint(painter)
        self.drawing.paint(painter, self._to_pixels, screen, picture if fits else None)
        for words in self.written:
            words.paint(painter)
        painter.end()
        self.painted.emit()
        if self.devicePixelRatioF() != screen.ratio and self.plane is not None:
            self._see()  # moved to another screen

    def changeEvent(self, event: QEvent) -> None:
        """Write words anew in another size of the text."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange and hasattr(self, "drawing"):
            self.rewrite()

    def _see(self) -> None:
        ratio, (left, top, _, _) = self.devicePixelRatioF(), self.camera.visible(self._px())
        width, height = (max(1, round(size * ratio)) for size in self._px())
        self._seen = Screen(left, top, self.camera.scale * ratio, width, height, ratio)
        super()._see()

    def _px(self) -> tuple[int, int]:
        return self.width(), self.height()

    def _fetch(self) -> None:
        """Want the picture of what the pane shows."""
        if self.plane is not None:
            greys = self.viewing.greys
            window = greys.of(self.pane)
            self.feed.want(self.plane, self.index, self._seen, window, greys.is_inverted)

    # --- seen and unseen ----------------------------------------------------------------------
    def showEvent(self, event: QShowEvent) -> None:
        """Catch up with what happened unseen."""
        super().showEvent(event)
        self._take_plane()
        if self.plane is not None:
            self._see()
        self.seen.emit()

    def hideEvent(self, event: QHideEvent) -> None:
        """Stop drawing."""
        super().hideEvent(event)
        self._asked = False
        if self._is_interpolated:
            self._clear()  # what it shows next may be another needle's
        self.seen.emit()
