"""What a registration check says: to everybody large, to technicians below, troubles between."""

from __future__ import annotations

from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from app.core.arrays import FloatArray
from app.core.errors import AcusError
from app.core.transform import RigidTransform
from app.planning.registration import words
from app.planning.registration.check import RegistrationCheck
from app.views.kit import theme


class RegistrationResult(QWidget):
    """Three texts.

    Attributes:
        student: the sentence for everybody; names no figure without a check.
        trouble: what is wrong or still to be done.
        figures: FRE, FLE, TRE and what they mean.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.student, self.trouble, self.figures = QLabel(self), QLabel(self), QLabel(self)
        self.student.setStyleSheet(f"font-size: {theme.TITLE_PX}px;")
        self.trouble.setStyleSheet(f"color: {theme.WARNING};")
        self.figures.setProperty("role", "dim")
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(theme.SPACING)
        for label in (self.student, self.trouble, self.figures):
            label.setWordWrap(True)
            column.addWidget(label)

    def say(self, text: str) -> None:
        """Say what is wrong; nothing for an empty text."""
        self.trouble.setText(f"▲ {text}" if text else "")

    def show_check(
        self, found: RegistrationCheck | str, p_target: FloatArray, used: RigidTransform | None
    ) -> None:
        """Show a check, or why there is none yet.

        Args:
            found: the check, or what is still missing.
            p_target: target in world [m], shape (3,).
            used: T_world_patient that the screen uses; None without a run.
        """
        if isinstance(found, str):
            self.student.setText(words.NOT_CHECKED.capitalize())
            self.say(found.capitalize())
            self.figures.setText("")
            return
        try:
            agreement = found.agreement(p_target, T_world_patient=used)
            self.student.setText(words.student_line(agreement).capitalize())
            self.say("")
        except AcusError as error:
            self.student.setText(words.NOT_CHECKED.capitalize())
            self.say(str(error))
        if troubles := words.troubles(found):
            self.say("\n".join(troubles))
        lines = list(words.technician_lines(found))
        if found.trusted:
            lines.append(words.target_line(found, p_target))
        self.figures.setText("\n".join([*lines, *words.MEANING]))
