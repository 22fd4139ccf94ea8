"""What a study shows beyond error against time: tables of its own, pictures, and sentences."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from app.core.messages import sentence
from app.studies.errors import StudyError

Cell = str | float | int


@dataclass(frozen=True, slots=True)
class Sheet:
    """A table.

    Attributes:
        name: for the file, unique in the study.
        title: one line.
        columns: headings, with units.
        rows: as long as the headings; numbers stay numbers.
    """

    name: str
    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]

    def __post_init__(self) -> None:
        if len(set(self.columns)) != len(self.columns):  # files keep a row as heading: value
            raise StudyError(
                sentence(
                    "table {name}: two of its headings are alike: {columns}",
                    name=self.name,
                    columns=self.columns,
                )
            )
        for row in self.rows:
            if len(row) != len(self.columns):
                raise StudyError(
                    sentence(
                        "table {name}: a row has {cells} cells, there are "
                        "{headings} headings: {row}",
                        name=self.name,
                        cells=len(row),
                        headings=len(self.columns),
                        row=row,
                    )
                )


@dataclass(frozen=True, slots=True)
class Figure:
    """A picture.

    Attributes:
        name: for the file, unique in the study.
        draw: draws into an empty figure of matplotlib.
        size: width and height [inch].
    """

    name: str
    draw: Callable[[Any], None]
    size: tuple[float, float] = (8.0, 6.0)


@dataclass(frozen=True, slots=True)
class Findings:
    """Tables, pictures, and what they say, line by line.

    Attributes:
        passed: whether what had to hold does; None where nothing had to.
    """

    sheets: tuple[Sheet, ...]
    figures: tuple[Figure, ...] = ()
    lines: tuple[str, ...] = ()
    passed: bool | None = None


def _nothing(*_: Any) -> Findings:
    raise StudyError(sentence("this survey has no measure=...; see 'How to add a study'"))


@dataclass(frozen=True, slots=True)
class Survey:
    """A study that answers by maps and tables instead of error against time.

    Attributes:
        name, title, question, reference: as the file's declaration says; the runner fills them in.
        measure: does the work; may report how far it is, and be cancelled. Where there are
            `inputs` it is called with them as well.
        quick: the same on less, for a first look (`--quick`); None if there is nothing less.
        inputs: what the paths are that may be given to it; empty if it takes none.
        borrows: what it needs from rooms above, as a `Study` does: the last arguments of `measure`.
        options: names of what may be asked of it, which `measure` takes by these names.
    """

    name: str = ""
    title: str = ""
    question: str = ""
    reference: str = ""
    measure: Callable[..., Findings] = _nothing
    quick: Callable[..., Findings] | None = None
    inputs: str = ""
    borrows: tuple[str, ...] = ()
    options: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class SurveyResult:
    """A survey with what it found."""

    survey: Survey
    findings: Findings
