"""The force along the needle while its tip was in a tissue, or stood on bone.

By the loop's own account of it (`Samples.along`), where a hand felt it: a simulated one, or one at
a device that can push along the needle; and where the loop looked the tissue up in the patient.
Where that is not so, nothing is told: a force that nobody felt is none, and not 0.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.session.header import FIELD_FACTS
from app.session.samples import Samples

AXIAL: Final = "axial"
"""Of the axes that a device renders, the one along the needle."""


def feels_along(
    metadata: Mapping[str, Mapping[str, str]], attachments: Mapping[str, bytes]
) -> bool:
    """Tell from a record's head whether a hand felt the patient's tissue along the needle."""
    if FIELD_FACTS not in metadata:
        return False
    if metadata.get("device", {}).get("simulated") == "yes":
        return True
    try:
        return AXIAL in json.loads(attachments["device.json"])["loop"]["renders"]
    except (LookupError, TypeError, ValueError):
        return False


@dataclass(frozen=True, slots=True, eq=False)
class FeltAlong:
    """The force along the needle over the attempt.

    Attributes:
        time: monotonic [s], shape (n,).
        force: positive where the tissue pushes the tip out [N], shape (n,), NaN where not known.
    """

    time: FloatArray
    force: FloatArray

    @classmethod
    def of(cls, samples: Samples, felt: bool) -> FeltAlong:
        """Take it out of samples; nothing of it where nobody felt it."""
        if not felt or samples.along is None:
            return cls(np.empty(0), np.empty(0))
        return cls(samples.time, samples.along)

    def largest(self, begin: float, end: float) -> float | None:
        """Return the largest between two moments [N], from the sample before the first one on.

        None where nothing is known of that time; never below 0: what draws the tip inwards while
        it is withdrawn is no force of meeting.
        """
        first = max(0, int(np.searchsorted(self.time, begin, side="right")) - 1)
        last = int(np.searchsorted(self.time, end, side="right"))
        known = self.force[first : max(last, first + 1)]
        known = known[np.isfinite(known)]
        return max(0.0, float(known.max())) if len(known) else None
