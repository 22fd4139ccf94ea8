"""Colours, sizes and the style sheet: readable at arm's length, distinct without colour.

Words, areas and lines have the colours of the present theme; pictures (slices, 3D, pad, curves)
stay on black and keep theirs. Read a name here when something is drawn, not at import: the theme
and the size of the text change while the window is open. `now` brings a colour up to date.
"""

from dataclasses import dataclass
from enum import StrEnum
from string import Template

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QFont, QPalette, QPen
from PySide6.QtWidgets import QApplication

from app.core import paths
from app.views.kit.themes import DARK, Theme, restyled, translated

BACKGROUND, SURFACE, RAISED, BORDER = DARK.background, DARK.surface, DARK.raised, DARK.border
TEXT, TEXT_DIM, ACCENT = DARK.text, DARK.dim, DARK.accent
GOOD, WARNING, BAD = DARK.good, DARK.warning, DARK.bad

IMAGE_BACKGROUND = "#000000"
IMAGE_GROUND, IMAGE_LINE = DARK.background, DARK.border
IMAGE_TEXT, IMAGE_DIM, IMAGE_WARNING = DARK.text, DARK.dim, DARK.warning
"""What stands on pictures, in every theme."""

FONT_PX = 14
SMALL_PX = 13
TITLE_PX = 20
SPACING = 8
MARGIN = 12
CONTROL_HEIGHT = 30

LARGE = 1.3
"""How much larger the text is for a room."""


class Symbol(StrEnum):
    """Shape that tells a mark apart from the others without its colour."""

    NONE = "none"
    RING = "ring"
    DISC = "disc"
    DIAMOND = "diamond"
    SQUARE = "square"
    TRIANGLE = "triangle"
    DOWN = "down"
    CROSS = "cross"
    PLUS = "plus"
    HEXAGON = "hexagon"
    STAR = "star"


@dataclass(frozen=True, slots=True)
class Mark:
    """How one thing is drawn everywhere: its colour, its dashes and its shape.

    Attributes:
        colour: `#rrggbb`.
        dash: lengths of strokes and gaps in pen widths; empty for a solid line.
        symbol: shape of its point, if it has one.
        width: line width [px].
    """

    colour: str
    dash: tuple[float, ...] = ()
    symbol: Symbol = Symbol.NONE
    width: float = 1.5

    def pen(self, width: float | None = None, alpha: float = 1.0) -> QPen:
        """Cosmetic pen: its width [px] does not zoom; `alpha` in [0, 1]."""
        pen = QPen(self.qcolor(alpha), self.width if width is None else width)
        pen.setCosmetic(True)
        pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        if self.dash:
            pen.setDashPattern(list(self.dash))
        return pen

    def qcolor(self, alpha: float = 1.0) -> QColor:
        """Return the colour as Qt's, with `alpha` in [0, 1]."""
        colour = QColor(self.colour)
        colour.setAlphaF(alpha)
        return colour


# Planes: the convention of 3D Slicer and OHIF, told apart by luminance and dash as well.
AXIAL = Mark("#ff5c57")
SAGITTAL = Mark("#ffd84d", dash=(8.0, 4.0))
CORONAL = Mark("#35c46a", dash=(2.0, 3.0))
IN_PLANE = Mark("#c9a2ff")
IN_PLANE_90 = Mark("#5fd0c5", dash=(8.0, 4.0))
PROBE = Mark("#f0f0f0", dash=(2.0, 3.0))
# The rest: Okabe and Ito's colour-blind-safe hues, lightened for black.
NEEDLE = Mark("#ff9f1c", width=3.0)
NEEDLE_TIP = Mark("#35d6ed", symbol=Symbol.DIAMOND, width=2.0)
PATH = Mark("#8fc7ff", dash=(6.0, 3.0), width=1.5)
ENTRY = Mark("#56b4e9", symbol=Symbol.RING, width=2.5)
TARGET_AHEAD = Mark("#e58fc2", symbol=Symbol.RING, width=1.6)
TARGET_TOUCHED = Mark("#8fd19e", symbol=Symbol.SQUARE, width=1.6)
TARGET = Mark("#e58fc2", symbol=Symbol.DISC, width=2.5)
GHOST = Mark("#ffffff", dash=(1.0, 2.0), width=2.5)
GHOST_TIP = Mark("#ffffff", symbol=Symbol.SQUARE, width=2.0)
ROBOT = Mark("#9aa7b4")
SKIN = Mark("#d8b59c")
BONE = Mark("#efe7d3")

VERDICTS = {"good": (GOOD, "✔"), "warning": (WARNING, "▲"), "bad": (BAD, "✖")}
"""Colour and symbol of a verdict, so that neither stands alone."""

_present, _scale = DARK, 1.0


def present() -> Theme:
    """Return the theme that is shown."""
    return _present


def scale() -> float:
    """Return how much larger than usual the text is."""
    return _scale


def px(usual: int) -> int:
    """Return a length for the present size of the text, of one for the usual size."""
    return round(usual * _scale)


def now(colour: str) -> str:
    """Return what a colour of any theme is in the present one; a mark's is readable as text."""
    return translated(colour, _present)


def on_image(colour: str) -> str:
    """Return what a colour of any theme is on a picture, whatever the present theme."""
    return translated(colour, DARK)


def style_sheet() -> str:
    """Return the style sheet: `resources/theme/window.qss` with the colours filled in."""
    folder = paths.resources() / "theme"
    template = (folder / "window.qss").read_text(encoding="utf-8")
    return Template(template).substitute(
        _present.colours(),
        font=FONT_PX,
        small=SMALL_PX,
        title=TITLE_PX,
        inner=CONTROL_HEIGHT - 12,
        round=SMALL_PX // 2 + 1,
        check=(folder / f"check-{_present.name}.svg").as_posix(),
    )


def font_of(pixels: int, bold: bool = False) -> QFont:
    """Return the application's font in a size [px], as a style sheet gives it to a widget."""
    font = QFont(QApplication.font())
    font.setPixelSize(pixels)
    font.setWeight(QFont.Weight.DemiBold if bold else QFont.Weight.Normal)
    return font


def apply_theme(application: QApplication, theme: Theme = DARK, size: float = 1.0) -> None:
    """Give the whole application, and what is open of it, a theme and a size of the text.

    Args:
        application: all its widgets are changed.
        theme: the colours.
        size: of the text, 1 being the usual one.
    """
    zoom = size / _scale
    _adopt(theme, size)
    if not application.styleSheet():  # it stays; setting it again polishes every widget once more
        application.setStyle("Fusion")
    application.setPalette(_palette())
    font = QFont(application.font())
    font.setPixelSize(FONT_PX)
    application.setFont(font)
    application.setStyleSheet(style_sheet())
    for widget in application.allWidgets():
        if sheet := widget.styleSheet():
            widget.setStyleSheet(restyled(sheet, theme, zoom))
        widget.update()


def _adopt(theme: Theme, size: float) -> None:
    global _present, _scale, BACKGROUND, SURFACE, RAISED, BORDER, TEXT, TEXT_DIM, ACCENT
    global GOOD, WARNING, BAD, VERDICTS, FONT_PX, SMALL_PX, TITLE_PX, CONTROL_HEIGHT
    _present, _scale = theme, size
    BACKGROUND, SURFACE, RAISED = theme.background, theme.surface, theme.raised
    BORDER, TEXT, TEXT_DIM, ACCENT = theme.border, theme.text, theme.dim, theme.accent
    GOOD, WARNING, BAD = theme.good, theme.warning, theme.bad
    VERDICTS = {"good": (GOOD, "✔"), "warning": (WARNING, "▲"), "bad": (BAD, "✖")}
    FONT_PX, SMALL_PX, TITLE_PX, CONTROL_HEIGHT = (
        round(size * usual) for usual in (14, 13, 20, 30)
    )


def _palette() -> QPalette:
    role = QPalette.ColorRole
    palette = QPalette()
    colours = {
        role.Window: BACKGROUND,
        role.WindowText: TEXT,
        role.Base: _present.field,
        role.Text: TEXT,
        role.AlternateBase: SURFACE,
        role.Button: RAISED,
        role.ButtonText: TEXT,
        role.ToolTipBase: RAISED,
        role.ToolTipText: TEXT,
        role.Highlight: ACCENT,
        role.HighlightedText: _present.on_accent,
        role.PlaceholderText: TEXT_DIM,
        role.Link: ACCENT,
    }
    for name, colour in colours.items():
        palette.setColor(name, QColor(colour))
    return palette
