"""The angles of both rings, in words."""

from math import atan2, degrees, hypot

from PySide6.QtWidgets import QLabel

from app.core.arrays import FloatArray


class RingDial(QLabel):
    """Shows by how much each ring is turned."""

    def show_axis(self, axis: FloatArray) -> None:
        """Show the rings for a direction of the needle, hub to tip."""
        x, y, z = axis.tolist()
        outer, inner = degrees(atan2(y, -z)), degrees(atan2(-x, hypot(y, z)))
        self.setText(f"outer ring {outer:.0f}°, inner ring {inner:.0f}°")
