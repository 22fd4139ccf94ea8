"""Where the robot's parts are, from its joint angles, in world [m]; how its cables pull."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.mechanisms.profile import DeviceProfile
from app.views.kit.text import tr
from app.views.kit.theme import Mark

if TYPE_CHECKING:
    from app.mechanisms.remote_centre import MachineDrawing

Segment = tuple[FloatArray, FloatArray]
"""Both ends of a straight part [m]."""

_SHADES: Final = ((0x3F, 0x8F, 0xE8), (0xC8, 0xC8, 0xBE), (0xFF, 0xA0, 0x00))
"""Blue over grey to orange: told apart with every common colour blindness."""

_HANGS: Final = 0.5
"""Share of the least tension below which a cable is drawn slack."""


@dataclass(frozen=True, slots=True)
class Cable:
    """A cable as it is drawn.

    Attributes:
        ends: both ends [m].
        share: how far between no tension and the largest, by its square root, 0 to 1.
        slack: whether it hangs.
    """

    ends: Segment
    share: float
    slack: bool

    @property
    def mark(self) -> Mark:
        """Its colour by its tension."""
        return Mark("#{:02x}{:02x}{:02x}".format(*tension_shade(self.share)))


@dataclass(frozen=True, slots=True, eq=False)
class RobotShape:
    """A machine as it is drawn.

    Attributes:
        drawing: its points and rods in world [m]; the base comes first.
        fulcrum: remote centre, the ball under the skin's surface, shape (3,).
        tensions: of its cables [N], in the order of its drawing; empty where it has none, or they
            are not known.
        tension_range: least and largest [N]; None where it has no cables.
    """

    drawing: MachineDrawing
    fulcrum: FloatArray
    tensions: tuple[float, ...] = ()
    tension_range: tuple[float, float] | None = None

    @classmethod
    def of(
        cls, profile: DeviceProfile, q: ArrayLike | None, tensions: ArrayLike = ()
    ) -> RobotShape:
        """Place the parts; without usable angles only what does not move is shown.

        Args:
            profile: of the robot.
            q: joint angles [rad], shape (2,), or None before the robot is connected.
            tensions: of its cables [N], as measured; none where they are not known.
        """
        angles = None if q is None else np.asarray(q, dtype=np.float64)
        usable = angles is not None and bool(np.isfinite(angles).all())
        known = tuple(np.asarray(tensions, dtype=np.float64).tolist())
        return cls(
            profile.machine.drawn(angles if usable else None),
            frozen(profile.fulcrum),
            known if profile.tension_range is not None else (),
            profile.tension_range,
        )

    def links(self) -> list[Segment]:
        """Return the ends of the rods to draw."""
        return [
            ends
            for rod, ends in zip(self.drawing.rods, self.drawing.ends(), strict=True)
            if rod.part.value != "cable"
        ]

    def cables(self) -> list[Cable]:
        """Return the cables; one whose tension is not known as if it had the least."""
        if self.tension_range is None:
            return []
        least, most = self.tension_range
        strung = [
            ends
            for rod, ends in zip(self.drawing.rods, self.drawing.ends(), strict=True)
            if rod.part.value == "cable"
        ]
        pulls = self.tensions if len(self.tensions) == len(strung) else (least,) * len(strung)
        return [
            Cable(ends, tension_share(pull, most), not pull >= _HANGS * least)
            for ends, pull in zip(strung, pulls, strict=True)
        ]

    def legend(self) -> tuple[tuple[tuple[int, int, int], str], ...]:
        """Say what the colours mean, and which reading of the joints is drawn."""
        if self.tension_range is None:
            return ()
        _, most = self.tension_range
        rows = [
            (tension_shade(share), tr("cable at {force:.0f} N", force=most * share * share))
            for share in (0.1, 1.0)
        ]
        rows.append((_SHADES[0], tr("dashed: slack cable")))
        if self.drawing.reading:
            rows.append((_SHADES[1], tr(self.drawing.reading)))
        return tuple(rows)


def tension_share(tension: float, most: float) -> float:
    """Place of a tension on the scale of colours: the square root of its share of the largest."""
    share = tension / most if np.isfinite(tension) else 0.0
    return float(np.sqrt(min(max(share, 0.0), 1.0)))


def tension_shade(share: float) -> tuple[int, int, int]:
    """Colour at a place of that scale, RGB."""
    at = np.interp(share, (0.0, 0.5, 1.0), (0.0, 1.0, 2.0))
    first = min(int(at), 1)
    low, high = np.array(_SHADES[first]), np.array(_SHADES[first + 1])
    red, green, blue = np.rint(low + (at - first) * (high - low)).astype(int).tolist()
    return red, green, blue
