"""How old a measurement may be before less is made of it, for every room the same.

The loop fades and cuts its force by these, the session chooses the needle's depth by them, and the
window colours its read-outs by them.
"""

from typing import Final

ENCODER_FADE: Final = 0.02
"""Age of the encoder values [s] from which the force fades."""

ENCODER_ZERO: Final = 0.1
"""Age of the encoder values [s] from which there is no force and no valid pose."""

TRACKER_FRESH: Final = 0.1
"""Age of a fix [s] up to which the depth counts as tracked: three frames at 30 Hz."""

TRACKER_HOLD: Final = 0.2
"""Age of a fix [s] up to which its depth is held; then it may be anywhere in the profile's
range, as far as force and let-go go, and the model's depth is drawn only as such."""

HEARTBEAT: Final = 1.0
"""Silence of the window [s] after which there is no force."""
