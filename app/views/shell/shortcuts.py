"""The sheet of keys and mouse buttons, and the sentence about what this program is."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import (
    QBoxLayout,
    QDialog,
    QDialogButtonBox,
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from app.views.kit import theme
from app.views.kit.parts import PlainLabel
from app.views.kit.roles import STAFF, Role
from app.views.kit.text import disclaimer, keys_text, tr
from app.views.slices.bindings import Scheme, key_rows, mouse_rows

_AROUND_PX = 40
_WIDEST_PX = 1280
"""Two columns up to this width, the smallest screen's; longer words than English have one."""
_LEAST_PX = 300

ROLE_KEY: Final = "Ctrl+Alt+R"
"""Opens the choice of roles."""

Group = tuple[str, list[tuple[str, str]]]


def groups(
    scheme: Scheme,
    watching: Mapping[str, str] | None = None,
    pen: bool = False,
    role: Role = Role.TECHNICIAN,
) -> list[Group]:
    """Headings with what to press and what it does.

    Args:
        scheme: of mouse and keys in the slices.
        watching: keys of features by which an exercise is watched, and who shows it.
        pen: whether a pen can stand in for the robot.
        role: whose keys.
    """
    watched, staff = watching or {}, role in STAFF
    return [
        (tr("Slices: mouse ({scheme})", scheme=scheme.title), mouse_rows(scheme)),
        (
            tr("Slices: keys ({scheme})", scheme=scheme.title),
            [*key_rows(scheme), ("1 … 9, 0", tr("window presets, the file's own"))],
        ),
        (
            tr("Plan"),
            [
                ("E, T", tr("place entry, place target: then click in any view, 3D too")),
                (tr("Drag a mark"), tr("move it")),
                (tr("Esc"), tr("stop placing")),
                ("Ctrl+Z, Ctrl+Y", tr("undo, redo")),
                *(_of_staff(scheme) if staff else []),
                *([("F4", tr("pen and webcam: a needle without a robot"))] if pen else []),
                (ROLE_KEY, tr("who sits here: student, instructor, technician")),
            ],
        ),
        (
            tr("3D view"),
            [
                (tr("Left, middle, right drag"), tr("turn, pan, zoom")),
                ("A P L Shift+R S I", tr("look from that side")),
                ("N, W", tr("look along the needle, as the operator")),
                (tr("Space, r; Backspace"), tr("whole patient; from where one looked before")),
                ("X, C", tr("x-ray; cut along the needle")),
                ("M, Y", tr("slices as planes; organs")),
                ("V, Q", tr("volume rendering; light background")),
            ],
        ),
        (
            tr("Attempt"),
            [
                ("F5", tr("start the attempt; anything new is explained first")),
                (
                    ", ".join(("Shift+F5", "Ctrl+F5", *watched)),
                    "; ".join((tr("briefing; an expert shows it"), *watched.values())),
                ),
                ("S", tr("control scan")),
                (
                    "(Shift+, Alt+) J, Ctrl+J",
                    tr("next step, fire the gun (something is wrong, do it)"),
                ),
                (tr("Enter"), tr("end the attempt")),
                ("Ctrl+B, Ctrl+T", tr("in an attempt: all panels; live pictures or the scan")),
                (tr("Hold Esc"), tr("abort: force to zero at once")),
                (tr("Hold H, or a pedal"), tr("forces on, where they are armed by holding")),
                (
                    f"{scheme.menu_keys['follow']}, {scheme.menu_keys['bullseye']}",
                    tr("slices follow the tip; bull's-eye"),
                ),
                (
                    tr("Drag, Q, E in the bull's-eye"),
                    tr("tilt the needle; turn a bevelled one"),
                ),
                (tr("Wheel, Page keys in the bull's-eye"), tr("depth 1 mm, with Shift 0.2 mm")),
            ],
        ),
    ]


def _of_staff(scheme: Scheme) -> list[tuple[str, str]]:
    return [
        ("Ctrl+S, Ctrl+Shift+S", tr("save plan, save as")),
        (measure_keys(scheme), tr("measure: distance, angle, HU, region")),
        ("Ctrl+O, Ctrl+Shift+O", tr("open CT folder, open plan")),
    ]


def measure_keys(scheme: Scheme) -> str:
    """Keys of the measuring tools."""
    return ", ".join(scheme.menu_keys[name] for name in ("distance", "angle", "probe", "region"))


class ShortcutSheet(QDialog):
    """All keys and buttons on one page."""

    def __init__(
        self,
        scheme: Scheme,
        parent: QWidget | None = None,
        watching: Mapping[str, str] | None = None,
        pen: bool = False,
        role: Role = Role.TECHNICIAN,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Keys and mouse"))
        columns = QHBoxLayout()
        columns.setSpacing(4 * theme.SPACING)
        mouse, keys, plan, scene, attempt = groups(scheme, watching, pen, role)
        for part in ((mouse, plan, scene), (keys, attempt)):
            column = QVBoxLayout()
            for group in part:
                column.addLayout(_table(group))
            column.addStretch(1)
            columns.addLayout(column)
        sheet = QWidget(self)
        sheet.setLayout(columns)
        area = QScrollArea(self)
        area.setFrameShape(QFrame.Shape.NoFrame)
        area.setWidgetResizable(True)
        area.setWidget(sheet)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close, parent=self)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.addWidget(area)
        layout.addWidget(disclaimer_label(self))
        layout.addWidget(buttons)
        around, most = QSize(_AROUND_PX, 4 * _AROUND_PX), self.screen().availableSize() * 0.95
        if sheet.sizeHint().width() > max(most.width() - _AROUND_PX, _WIDEST_PX):
            columns.setDirection(QBoxLayout.Direction.TopToBottom)
        self.resize((sheet.sizeHint() + around).boundedTo(most))


def disclaimer_label(parent: QWidget | None = None) -> QLabel:
    """Return the sentence as a label."""
    label = _WideLabel(disclaimer(), parent)
    label.setProperty("role", "disclaimer")
    label.setAlignment(Qt.AlignmentFlag.AlignCenter)
    label.setWordWrap(True)  # never cut, however narrow the window
    return label


class _WideLabel(PlainLabel):
    """A label that wraps, and asks for no more height than its width makes necessary."""

    def minimumSizeHint(self) -> QSize:
        """Return a line of a narrow page; what more it takes its layout asks by the width."""
        return QSize(theme.px(_LEAST_PX), self.fontMetrics().lineSpacing())


def _table(group: Group) -> QGridLayout:
    heading, rows = group
    grid = QGridLayout()
    grid.setVerticalSpacing(1)
    grid.setHorizontalSpacing(2 * theme.SPACING)
    title = PlainLabel(heading)
    title.setProperty("role", "heading")
    grid.addWidget(title, 0, 0, 1, 2)
    for number, (key, meaning) in enumerate(rows, start=1):
        pressed, does = PlainLabel(keys_text(key)), PlainLabel(meaning)
        pressed.setStyleSheet(f"color: {theme.ACCENT}; font-weight: 600;")
        grid.addWidget(pressed, number, 0)
        grid.addWidget(does, number, 1)
    grid.setColumnStretch(1, 1)
    return grid
