"""What the dialog of the boxes says."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.views.kit.text import tr

if TYPE_CHECKING:
    from app.imaging.privacy.burned_in import Box


def explanation(can_draw: bool) -> str:
    """Say what to look for and what to do with it."""
    if can_draw:
        return tr(
            "Names can be written into the picture itself. Nothing finds them by itself: look "
            "through the pictures and drag a box over any writing. What is shown black in a box is "
            "black in the library for good; the original stays as it is."
        )
    return tr(
        "Look through the pictures for writing. These files hold many pictures each; on such files "
        "no boxes can be drawn: do not take them in if there is any."
    )


def box_words(number: int, box: Box) -> str:
    """Line of a box in the list."""
    on = tr("all pictures") if box.picture is None else tr("picture {number}", number=box.picture)
    return f"{number}  {on}: {box.columns} × {box.rows} px, ({box.column}, {box.row})"
