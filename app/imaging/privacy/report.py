"""What de-identification did, in counts: never a value of a header.

And what a de-identified series is, as the worker process hands it over.
"""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from app.core.messages import sentence

LOCK = ".lock"
"""File in a folder that is being written; whoever writes there holds it."""


@dataclass(slots=True)
class Tally:
    """Counts while files are treated; each counter maps an attribute's keyword to how often."""

    removed: Counter[str] = field(default_factory=Counter)
    emptied: Counter[str] = field(default_factory=Counter)
    replaced: Counter[str] = field(default_factory=Counter)
    shifted: Counter[str] = field(default_factory=Counter)
    unfit: Counter[str] = field(default_factory=Counter)
    private: int = 0
    masked: int = 0
    stripped: int = 0
    files: int = 0
    warnings: dict[str, None] = field(default_factory=dict)

    def warn(self, text: str) -> None:
        """Note a warning once, in the order in which they came."""
        self.warnings[text] = None

    def report(self) -> "RemovalReport":
        """Freeze the counts: what was written anew, or empty, does not count as removed too."""
        for keyword in (*self.replaced, *self.emptied):
            self.removed.pop(keyword, None)
        for keyword in self.emptied:
            self.unfit.pop(keyword, None)
        return RemovalReport(
            removed=dict(sorted(self.removed.items())),
            emptied=dict(sorted(self.emptied.items())),
            replaced=dict(sorted(self.replaced.items())),
            shifted=dict(sorted(self.shifted.items())),
            unfit=dict(sorted(self.unfit.items())),
            private=self.private,
            masked=self.masked,
            stripped=self.stripped,
            files=self.files,
            warnings=tuple(self.warnings),
        )


@dataclass(frozen=True, slots=True)
class RemovalReport:
    """What was done to the files of a series.

    Attributes:
        removed: attributes taken out, and from how many places.
        emptied: attributes that must stand there, written empty.
        replaced: identifiers and UIDs written anew.
        shifted: dates moved by the patient's offset.
        unfit: attributes that would be kept but whose value had another form: taken out.
        private: how many private attributes were taken out.
        masked: files whose pixels were blackened where an instructor drew.
        stripped: files whose pixel data held more than pixels, which was left out.
        files: how many were written.
        warnings: what a person must look at.
    """

    removed: Mapping[str, int]
    emptied: Mapping[str, int]
    replaced: Mapping[str, int]
    shifted: Mapping[str, int]
    unfit: Mapping[str, int]
    private: int
    masked: int
    stripped: int
    files: int
    warnings: tuple[str, ...]

    def lines(self) -> tuple[str, ...]:
        """Return the report as text, without any value of the files."""
        parts = (
            ("removed", self.removed),
            ("written empty", self.emptied),
            ("replaced", self.replaced),
            ("dates moved", self.shifted),
            (sentence("removed, because the value had another form"), self.unfit),
        )
        lines = [f"{title}: {', '.join(counts)}" for title, counts in parts if counts]
        lines.append(sentence("private attributes removed: {private}", private=self.private))
        if self.masked:
            lines.append(sentence("pixels blackened in {masked} files", masked=self.masked))
        if self.stripped:
            lines.append(
                sentence(
                    "left out of the pixel data of {stripped} files: what is not pixels "
                    "(comments, unused bits, bytes behind the last one)",
                    stripped=self.stripped,
                )
            )
        return (*lines, *(f"look at this: {warning}" for warning in self.warnings))

    def document(self) -> dict[str, Any]:
        """Return the report for JSON; keys in docs/json.md."""
        return {
            "files": self.files,
            "removed": dict(self.removed),
            "emptied": dict(self.emptied),
            "replaced": dict(self.replaced),
            "shifted": dict(self.shifted),
            "unfit": dict(self.unfit),
            "private": self.private,
            "masked": self.masked,
            "stripped": self.stripped,
            "warnings": list(self.warnings),
        }


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
