"""A question with answers that name what they do: no one has to read what Yes means."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtWidgets import QMessageBox, QWidget

from app.views.kit.parts import message_box


def ask(
    parent: QWidget | None,
    title: str,
    words: str,
    more: str,
    answers: Sequence[str],
    *,
    default: int = 0,
    escape: int,
) -> int:
    """Return the number of the answer.

    Args:
        parent: over which it opens.
        title: of the box.
        words: the question, as it stands.
        more: what follows from the answers.
        answers: words of the buttons.
        default: number of the answer that Enter gives.
        escape: number of the one that Escape, or closing the box, gives.
    """
    box = message_box(parent, title, words, more)
    box.setIcon(QMessageBox.Icon.Question)
    role = QMessageBox.ButtonRole.ActionRole
    buttons = [box.addButton(name, role) for name in answers]
    box.setDefaultButton(buttons[default])
    box.setEscapeButton(buttons[escape])
    box.exec()
    clicked = box.clickedButton()
    return buttons.index(clicked) if clicked in buttons else escape
