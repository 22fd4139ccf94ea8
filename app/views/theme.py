"""Colours, sizes and the style sheet: dark, readable at arm's length, distinct without colour."""

from dataclasses import dataclass
from enum import StrEnum
from string import Template

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QFont, QPalette, QPen
from PySide6.QtWidgets import QApplication

from app.core import paths

BACKGROUND = "#14171a"
SURFACE = "#1d2125"
RAISED = "#282d33"
BORDER = "#3a4149"
TEXT = "#e8ecef"
TEXT_DIM = "#a5afb8"
ACCENT = "#4aa3df"
IMAGE_BACKGROUND = "#000000"
GOOD = "#4cc38a"
WARNING = "#f2b134"
BAD = "#ff6b5e"

FONT_PX = 14
SMALL_PX = 13
TITLE_PX = 20
SPACING = 8
MARGIN = 12
CONTROL_HEIGHT = 30


class Symbol(StrEnum):
    """Shape that tells a mark apart from the others without its colour."""

    NONE = "none"
    RING = "ring"
    DISC = "disc"
    DIAMOND = "diamond"


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
TARGET = Mark("#e58fc2", symbol=Symbol.DISC, width=2.5)
ROBOT = Mark("#9aa7b4")
SKIN = Mark("#d8b59c")
BONE = Mark("#efe7d3")

VERDICTS = {"good": (GOOD, "✔"), "warning": (WARNING, "▲"), "bad": (BAD, "✖")}
"""Colour and symbol of a verdict, so that neither stands alone."""


def style_sheet() -> str:
    """Return the style sheet: `resources/theme/dark.qss` with the colours filled in."""
    template = (paths.resources() / "theme" / "dark.qss").read_text(encoding="utf-8")
    return Template(template).substitute(
        background=BACKGROUND, surface=SURFACE, raised=RAISED, border=BORDER, text=TEXT,
        dim=TEXT_DIM, accent=ACCENT, bad=BAD, font=FONT_PX, small=SMALL_PX, title=TITLE_PX,
        inner=CONTROL_HEIGHT - 12,
    )  # fmt: skip


def apply_theme(application: QApplication) -> None:
    """Give the whole application the dark palette, the font size and the style sheet."""
    application.setStyle("Fusion")
    application.setPalette(_palette())
    font = QFont(application.font())
    font.setPixelSize(FONT_PX)
    application.setFont(font)
    application.setStyleSheet(style_sheet())


def _palette() -> QPalette:
    role = QPalette.ColorRole
    palette = QPalette()
    colours = {
        role.Window: BACKGROUND, role.WindowText: TEXT, role.Base: "#101316", role.Text: TEXT,
        role.AlternateBase: SURFACE, role.Button: RAISED, role.ButtonText: TEXT,
        role.ToolTipBase: RAISED, role.ToolTipText: TEXT, role.Highlight: ACCENT,
        role.HighlightedText: "#0b0d0f", role.PlaceholderText: TEXT_DIM, role.Link: ACCENT,
    }  # fmt: skip
    for name, colour in colours.items():
        palette.setColor(name, QColor(colour))
    return palette
