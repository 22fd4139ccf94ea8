"""What a de-identified series is, as the worker process hands it over."""

from dataclasses import dataclass

from app.imaging.privacy.report import RemovalReport

LOCK = ".lock"
"""File in a folder that is being written; whoever writes there holds it."""


@dataclass(frozen=True, slots=True)
class Deidentified:
    """A series that was written anew.

    Attributes:
        report: what was removed.
        study: pseudonym of the study.
        series_uid: its new SeriesInstanceUID.
    """

    report: RemovalReport
    study: str
    series_uid: str

    @property
    def name(self) -> str:
        """Name of its folder: the pseudonym and a part of the new UID."""
        return f"{self.study}-{int(self.series_uid.split('.')[-1]) % 16**6:06X}"


def file_name(number: int) -> str:
    """Name of a written file, by its number in the series."""
    return f"{number:06d}.dcm"
