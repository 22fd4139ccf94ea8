"""Flags attempts whose camera calibration was later found bad."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType

from app.core.messages import sentence
from app.session.summary import Summary
from app.tracking.calibration.history_file import rejected_ids
from app.tracking.errors import CalibrationError


@dataclass(frozen=True, slots=True)
class CalibrationFlags:
    """What is known of calibrations now.

    Attributes:
        bad: reason by id of those found bad.
        unknown: why that could not be read; empty if it could.
    """

    bad: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    unknown: str = ""

    @classmethod
    def read(cls, folder: Path | None = None) -> "CalibrationFlags":
        """Read the history of calibrations (the user's by default); never raises."""
        try:
            return cls(MappingProxyType(rejected_ids(folder)))
        except CalibrationError as error:
            return cls(unknown=str(error))

    def problem(self, calibration: str) -> str:
        """Line to show with an attempt that was made with a calibration; empty if there is none."""
        if not calibration:
            return ""
        if self.unknown:
            return sentence(
                "whether calibration {calibration} is still good is not known: {unknown}",
                calibration=calibration,
                unknown=self.unknown,
            )
        reason = self.bad.get(calibration)
        if reason is None:
            return ""
        return sentence(
            "the cameras' calibration {calibration} was later found bad: {reason}",
            calibration=calibration,
            reason=reason,
        )

    def flagged(self, summary: Summary) -> Summary:
        """Return a summary with that line among its problems."""
        line = self.problem(summary.calibration)
        return replace(summary, problems=(*summary.problems, line)) if line else summary
