"""Typed answers to a routine that must not wait for them: the loop's sign of life goes on."""

from __future__ import annotations

import sys
import threading
from collections.abc import Sequence
from math import isfinite
from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING

from app.commands.reader_language import tell
from app.core.errors import AcusError
from app.core.messages import sentence

if TYPE_CHECKING:
    from app.device.commissioning.results import RoutineReport
    from app.device.commissioning.routine import Routine


class AnswerError(AcusError):
    """An answer is missing or cannot be understood."""


def numbers(text: str, name: str, count: int) -> tuple[float, ...]:
    """Read numbers between commas, e.g. `20.5,51,102`.

    Raises:
        AnswerError: if one is not a finite number, or their count is wrong.
    """
    try:
        found = tuple(float(part) for part in text.split(","))
    except ValueError as error:
        raise AnswerError(
            sentence(
                "{name}: {answer!r} are not numbers between commas, e.g. 20.5,51,102",
                name=name,
                answer=text,
            )
        ) from error
    if len(found) != count or not all(isfinite(value) for value in found):
        raise AnswerError(
            sentence(
                "{name}: {count} finite numbers are needed, got {answer!r}",
                name=name,
                count=count,
                answer=text,
            )
        )
    return found


class Answers:
    """Answers from the keyboard or a pipe, read by a thread one line at a time, or prepared ones.

    Args:
        confirm: confirm everything without asking.
        prepared: numbers for the questions that need one, in order.
    """

    def __init__(self, confirm: bool = False, prepared: Sequence[float] = ()) -> None:
        self._confirm, self._prepared = confirm, list(prepared)
        self._lines: SimpleQueue[str] = SimpleQueue()
        self._asked = False

    def to(self, routine: Routine, report: RoutineReport, to_stderr: bool = False) -> float | None:
        """Answer to what a report needs, or None for not yet.

        Raises:
            AnswerError: if the input has ended, or a script has no reading for a question.
        """
        if report.unit and self._prepared:
            return self._prepared.pop(0)
        if self._confirm:
            if report.unit:
                raise AnswerError(
                    sentence(
                        "{routine_title}: {report_needs}: give it with --readings",
                        routine_title=routine.TITLE,
                        report_needs=report.needs,
                    )
                )
            return 0.0
        if not self._asked:
            self._asked = True
            how = f"[{report.unit}]" if report.unit else "[Enter]"
            tell(sentence("> {needs} {how}", needs=report.needs, how=how), err=to_stderr)
            threading.Thread(target=self._read, name="acus answers", daemon=True).start()
        return self._understood(report, to_stderr)

    def _understood(self, report: RoutineReport, to_stderr: bool) -> float | None:
        try:
            line = self._lines.get_nowait()
        except Empty:
            return None
        self._asked = False
        if not line:
            raise AnswerError(sentence("the input has ended before the routine; nothing was kept"))
        if not report.unit:
            return 0.0
        try:
            value = float(line.strip().replace(",", "."))
        except ValueError:
            value = float("nan")
        if isfinite(value):
            return value
        tell(
            sentence("{line!r} is not a number in {unit}", line=line.strip(), unit=report.unit),
            err=to_stderr,
        )
        return None

    def _read(self) -> None:
        self._lines.put(sys.stdin.readline())
