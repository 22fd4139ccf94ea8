"""The face of an exercise: its patient in the plane that shows its task, and a sign of that task.

Several exercises share a patient. Plane, section and sign come from what each of them says, so that
no two faces of the shipped ones are alike; signs are schematic and drawn over the CT.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Final

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPainterPath, QPen, QPixmap

from app.exercises.guidance import GuidanceMode
from app.exercises.portrait import ACROSS, Portrait
from app.exercises.practised_skill import PractisedSkill, practised_skill
from app.exercises.schema import Exercise
from app.views.exercise.briefing import paint_portrait
from app.views.kit import theme

SEEN_MM: Final = (150.0, 215.0)
"""Least and largest width of the section that is shown [mm]."""

PATHS: Final = 1.9
"""Width of the section in lengths of the path, within `SEEN_MM`."""

Place = Callable[[tuple[float, ...]], QPointF]


def plane_of(exercise: Exercise) -> str:
    """Return the slice that shows an exercise's task: motion from the front, gaps from the side."""
    if exercise.guidance_mode is GuidanceMode.CONTROL_CT:
        return "sagittal"
    match practised_skill(exercise):
        case PractisedSkill.BREATH:
            return "coronal"
        case PractisedSkill.CLEARANCE:
            return "sagittal"
        case _:
            return "axial"


def face(exercise: Exercise, portrait: Portrait, side: int, ratio: float) -> QPixmap:
    """Return the round face of an exercise, transparent around it.

    Args:
        exercise: whose task.
        portrait: of its patient.
        side: width and height [px].
        ratio: pixels of the screen per pixel.
    """
    made = QPixmap(round(side * ratio), round(side * ratio))
    made.setDevicePixelRatio(ratio)
    made.fill(Qt.GlobalColor.transparent)
    painter = QPainter(made)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    box, disc = QRectF(0.0, 0.0, side, side), QPainterPath()
    disc.addEllipse(box)
    painter.setClipPath(disc)
    paint_face(painter, box, exercise, portrait)
    painter.end()
    return made


def paint_face(
    painter: QPainter, box: QRectF, exercise: Exercise, portrait: Portrait, around: float = 1.0
) -> None:
    """Draw the section of an exercise's patient around its path, and the sign of its task.

    Args:
        painter: clipped to what is to be drawn.
        box: that the section fills.
        exercise: whose task.
        portrait: of its patient.
        around: how many times as wide a section as a face has.
    """
    name = plane_of(exercise)
    right, down = ACROSS[name]
    low, high = portrait.low_mm, portrait.high_mm
    wide, tall = high[right] - low[right], high[down] - low[down]
    target, entry = portrait.target_mm, portrait.entry_mm or portrait.target_mm
    length = math.hypot(entry[right] - target[right], entry[down] - target[down])
    seen = min(max(PATHS * length, SEEN_MM[0]), SEEN_MM[1])
    scale = min(box.width(), box.height()) / (around * seen)
    share = 0.5 / around  # the wider the section, the more of it is the patient's inside
    middle = tuple(t + share * (e - t) for t, e in zip(target, entry, strict=True))
    x, y = portrait.place(name, middle)
    whole = QRectF(0.0, 0.0, scale * wide, scale * tall)
    whole.moveTopLeft(box.center() - QPointF(x * whole.width(), y * whole.height()))
    painter.fillRect(box, QColor(theme.IMAGE_BACKGROUND))
    at = paint_portrait(painter, whole, portrait, name)

    def place(point: tuple[float, ...]) -> QPointF:
        x, y = portrait.place(name, point)
        return QPointF(at.left() + x * at.width(), at.top() + y * at.height())

    _sign(painter, box, exercise, portrait, place, scale * SEEN_MM[0] / 100.0)


# --- signs ------------------------------------------------------------------------------------
def _sign(
    painter: QPainter,
    box: QRectF,
    exercise: Exercise,
    portrait: Portrait,
    place: Place,
    unit: float,
) -> None:
    """Draw the sign; `unit` is a hundredth of the least section that is shown [px]."""
    target = place(portrait.target_mm)
    entry = None if portrait.entry_mm is None else place(portrait.entry_mm)
    if exercise.guidance_mode is GuidanceMode.CONTROL_CT:
        for step in (-1, 0, 1):
            y = target.y() + step * 6.0 * unit
            _line(painter, [QPointF(box.left(), y), QPointF(box.right(), y)], theme.AXIAL.colour)
    if exercise.is_own_plan or entry is None:
        _candidates(painter, target, unit)
        return
    along = entry - target
    size = math.hypot(along.x(), along.y()) or 1.0
    out = along / size
    side = QPointF(-out.y(), out.x())
    skill = practised_skill(exercise)
    if exercise.touch is not None:
        _tool(painter, entry, target, out, side, unit)
    elif skill is PractisedSkill.MACHINE:
        _holder(painter, entry, out, side, unit)
    elif skill is PractisedSkill.BREATH:
        beside = -15.0 if along.x() > 3.0 * unit else 15.0
        _breath(painter, target + QPointF(beside * unit, 0.0), unit, exercise.holds_breath)
    elif skill is PractisedSkill.PROCEDURE:
        for way in (-1.0, 1.0):  # the notch of the gun's needle about the lesion
            off = side * (way * 4.0 * unit)
            _line(
                painter,
                [target + out * (9.0 * unit) + off, target - out * (9.0 * unit) + off],
                theme.TARGET.colour,
            )
    elif skill is PractisedSkill.CLEARANCE:
        for way in (-1.0, 1.0):
            off = side * (way * 7.0 * unit)
            _line(painter, [target + off, target + along * 0.6 + off], theme.IMAGE_WARNING)
    elif exercise.assistance < 0.0:
        for way in (-1.0, 1.0):
            foot = target + along * 0.45 + side * (way * 4.0 * unit)
            _arrow(painter, foot, side * way, 15.0 * unit, unit)
    elif skill is PractisedSkill.HAND and exercise.laws:
        shares = (1.0, 0.55, 0.2) if exercise.fading is not None else (exercise.assistance,)
        for share in shares:
            _funnel(painter, target, entry, side * (13.0 * unit * share), share)


def _line(painter: QPainter, points: list[QPointF], colour: str, width: float = 1.6) -> None:
    """Draw a line with a dark rim, so that it is seen on bone as well."""
    path = QPainterPath(points[0])
    for point in points[1:]:
        path.lineTo(point)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for ink, wide in ((theme.IMAGE_BACKGROUND, width + 2.0), (colour, width)):
        pen = QPen(QColor(ink), wide)
        pen.setCapStyle(Qt.PenCapStyle.RoundCap)
        painter.setPen(pen)
        painter.drawPath(path)


def _arrow(painter: QPainter, foot: QPointF, way: QPointF, length: float, unit: float) -> None:
    tip, across = foot + way * length, QPointF(-way.y(), way.x())
    back = tip - way * (5.0 * unit)
    barbs = [back + across * (4.0 * unit), tip, back - across * (4.0 * unit)]
    _line(painter, [foot, tip], theme.IMAGE_TEXT)
    _line(painter, barbs, theme.IMAGE_TEXT)


def _breath(painter: QPainter, middle: QPointF, unit: float, holds: bool) -> None:
    """Draw up and down for the breath, with two bars between where it is held."""
    gap = 7.0 * unit if holds else 0.0
    for way in (-1.0, 1.0):
        foot = middle + QPointF(0.0, way * gap)
        _arrow(painter, foot, QPointF(0.0, way), 15.0 * unit, unit)
    if holds:
        for x in (-2.5 * unit, 2.5 * unit):
            ends = [middle + QPointF(x, y) for y in (-4.0 * unit, 4.0 * unit)]
            _line(painter, ends, theme.IMAGE_TEXT, 2.4)


def _candidates(painter: QPainter, target: QPointF, unit: float) -> None:
    """Draw entries from which the student may choose: none is the program's."""
    for degrees in (-125.0, -95.0, -65.0):
        way = QPointF(math.cos(math.radians(degrees)), math.sin(math.radians(degrees)))
        end = target + way * (38.0 * unit)
        painter.setPen(theme.PATH.pen(1.4))
        painter.drawLine(target + way * (6.0 * unit), end)
        painter.setPen(theme.ENTRY.pen(1.8))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawEllipse(end, 3.0 * unit, 3.0 * unit)


def _funnel(
    painter: QPainter, target: QPointF, entry: QPointF, half: QPointF, share: float
) -> None:
    """Shade how far the robot leads: the wider, the stronger."""
    shape = QPainterPath(target)
    top = entry + (entry - target) * 0.15
    for point in (top + half, top - half, target):
        shape.lineTo(point)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(theme.ENTRY.qcolor(0.12 + 0.2 * max(0.0, share)))
    painter.drawPath(shape)


def _holder(painter: QPainter, entry: QPointF, out: QPointF, side: QPointF, unit: float) -> None:
    """Draw a guide on the skin, held by cables from a ring over it."""
    foot, head = entry + out * (3.0 * unit), entry + out * (20.0 * unit)
    for way in (-1.0, 1.0):
        for end in (head, foot):
            post = entry + out * (11.0 * unit) + side * (way * 32.0 * unit)
            _line(painter, [end, post], theme.ROBOT.colour)
        stand = post + out * (9.0 * unit)
        _line(painter, [stand, post - out * (12.0 * unit)], theme.ROBOT.colour, 2.6)
    _line(painter, [foot, head], theme.IMAGE_TEXT, 3.6)


def _tool(
    painter: QPainter, entry: QPointF, target: QPointF, out: QPointF, side: QPointF, unit: float
) -> None:
    """Draw the tool through its trocar, and targets about the path."""
    handle = entry + out * (17.0 * unit) + side * (10.0 * unit)
    _line(painter, [handle, entry, entry + (target - entry) * 0.55], theme.NEEDLE.colour, 2.6)
    for along, across in ((0.75, -11.0), (0.85, 10.0), (1.1, -4.0), (1.2, 13.0)):
        middle = entry + (target - entry) * along + side * (across * unit)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        for ink, wide in ((theme.IMAGE_BACKGROUND, 3.4), (theme.TARGET_AHEAD.colour, 1.6)):
            painter.setPen(QPen(QColor(ink), wide))
            painter.drawEllipse(middle, 3.4 * unit, 3.4 * unit)
