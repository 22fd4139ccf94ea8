"""A gradebook that Moodle imports: grades by a rule, feedback, and what the rule makes of chance.

Moodle's rules, from its sources (`grade/import/csv/classes/load_data.php`, `lib/csvlib.class.php`,
`classes/dataformat.php`, as of version 5; older ones say the same but for what is named):

- separators comma, semicolon, colon or tab; quotes doubled; a backslash before a quote hides it;
- UTF-8 (or what is chosen), with a byte order mark or without; as many cells in each row as heads;
- a grade of a new item is stored as it stands, so its decimal sign is the point in every language;
  one above 100 or that is no number ends the import, and nothing of the file is taken;
- one column identifies the user: user name, e-mail address (both whatever case) or ID number; one
  that is unknown or that two users have ends the import, and an empty one gave its grades to the
  user of the row before in older versions; a value that begins with = + - @ gets an apostrophe
  and is then unknown;
- heads become the names of new items; feedback can be mapped to items that exist only.
"""

from __future__ import annotations

import csv
import io
import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Final

from app.core.messages import counted, joined, sentence
from app.exchange.csv_export import cell
from app.exchange.errors import ExportError
from app.scoring.best_of import AttemptSpread, attempt_spread, expected_best
from app.session.accounts import Account
from app.session.board import ProgressBoard
from app.session.index import Indexed
from app.session.people import Person, Remarks

_LONGEST: Final = 255
"""Characters that the name of a grade item may have."""

_NAMED: Final = 5
_UNFIT: Final = ("=", "+", "-", "@")
_HIDING: Final = re.compile(r'\\(?="|$)', re.MULTILINE)


class GradeFrom(StrEnum):
    """Which attempts make the grade."""

    BEST = "best"
    FIRST = "first"
    LAST = "last"
    MEAN = "mean"


@dataclass(frozen=True, slots=True)
class GradeRule:
    """How the grade of a student at an exercise comes of the attempts that count.

    Attributes:
        rule: which of them.
        last: of the mean: over so many of the last ones, or over all where there are fewer.
    """

    rule: GradeFrom = GradeFrom.BEST
    last: int = 0

    @classmethod
    def of(cls, text: str) -> GradeRule:
        """Read `best`, `first`, `last` or `mean:N`.

        Raises:
            ExportError: if it is none of them.
        """
        name, _, count = text.strip().casefold().partition(":")
        if name in (GradeFrom.BEST, GradeFrom.FIRST, GradeFrom.LAST) and not count:
            return cls(GradeFrom(name))
        if name == GradeFrom.MEAN and count.isdecimal() and 1 <= int(count) <= 1000:
            return cls(GradeFrom.MEAN, int(count))
        raise ExportError(
            sentence(
                "{rule!r} is no rule for grades: take best, first, last, or mean:3 for the mean "
                "of the last three",
                rule=text,
            )
        )

    def __str__(self) -> str:
        """Return it as `of` reads it."""
        return f"{self.rule}:{self.last}" if self.rule is GradeFrom.MEAN else str(self.rule)

    def taken(self, attempts: Sequence[Indexed]) -> Sequence[Indexed]:
        """Return the attempts that make the grade, of those that count, oldest first."""
        if not attempts:
            return ()
        if self.rule is GradeFrom.BEST:
            return (max(attempts, key=lambda attempt: attempt.total or 0.0),)
        if self.rule is GradeFrom.FIRST:
            return attempts[:1]
        return attempts[-self.last :] if self.rule is GradeFrom.MEAN else attempts[-1:]

    def grade(self, attempts: Sequence[Indexed]) -> float | None:
        """Return the grade, 0 to 100; None without an attempt."""
        totals = [attempt.total or 0.0 for attempt in self.taken(attempts)]
        return sum(totals) / len(totals) if totals else None


@dataclass(frozen=True, slots=True)
class MoodleChoice:
    """How a gradebook is written.

    Attributes:
        identifier: by which Moodle knows a student; without a user name the pseudonym is it.
        rule: of the grades.
        feedback: whether each exercise has a column of feedback.
    """

    identifier: Account = Account.USERNAME
    rule: GradeRule = field(default_factory=GradeRule)
    feedback: bool = False


def moodle_text(
    board: ProgressBoard,
    choice: MoodleChoice,
    accounts: Mapping[str, Mapping[Account, str]],
    titles: Mapping[str, str],
    remarks: Mapping[str, Remarks],
    semicolons: bool = False,
    translate: Callable[[str], str] = str,
) -> str:
    """Return the gradebook as CSV, a row for each student.

    Args:
        board: students, exercises and the attempts that count.
        choice: identifier, rule, feedback.
        accounts: of students by key.
        titles: of exercises by id; the id stands for one that has none.
        remarks: of attempts; a comment on what makes the grade is feedback.
        semicolons: between cells; the decimal sign stays the point.
        translate: a sentence into the language of the feedback.

    Raises:
        ExportError: if a student has no identifier, or two have the same, or Moodle could not read
            one.
    """
    known = identifiers(board.students, choice.identifier, accounts)
    stream = io.StringIO(newline="")
    writer = csv.writer(stream, delimiter=";" if semicolons else ",", lineterminator="\r\n")
    writer.writerows(
        [_readable(value) for value in row]
        for row in _rows(board, choice, known, titles, remarks, translate)
    )
    return stream.getvalue()


def identifiers(
    students: Sequence[Person], kind: Account, accounts: Mapping[str, Mapping[Account, str]]
) -> dict[str, str]:
    """Return by what Moodle knows each student, by key.

    Raises:
        ExportError: naming who has none, two that have the same, or one that Moodle cannot read.
    """
    known = {}
    for person in students:
        otherwise = person.pseudonym if kind is Account.USERNAME else ""
        known[person.key] = accounts.get(person.key, {}).get(kind, otherwise).strip()
    without = [person.pseudonym for person in students if known[person.key] in ("", "0")]
    if without:
        raise ExportError(
            sentence(
                "no {kind} is known of {students}: give it by a roster with the column {kind}, or "
                "choose another identifier",
                kind=kind.value,
                students=_some(without),
            )
        )
    unfit = [name for name in known.values() if name.startswith(_UNFIT)]
    if unfit:
        raise ExportError(
            sentence(
                "Moodle changes {identifiers} as it imports, for it begins with = + - or @: choose "
                "another identifier",
                identifiers=_some(unfit),
            )
        )
    same = Counter(name if kind is Account.IDNUMBER else name.casefold() for name in known.values())
    for name, count in same.items():
        if count > 1:
            holders = [
                person.pseudonym
                for person in students
                if name in (known[person.key], known[person.key].casefold())
            ]
            raise ExportError(
                sentence(
                    "{students} have the same {kind}, {identifier!r}: correct it by a roster, or "
                    "choose another identifier",
                    students=_some(holders),
                    kind=kind.value,
                    identifier=name,
                )
            )
    return known


def item_names(board: ProgressBoard, titles: Mapping[str, str]) -> list[str]:
    """Return how each exercise is called in the gradebook; no two have the same name."""
    names = []
    for item in board.items:
        title = " ".join(titles.get(item.exercise, "").split()) or item.exercise
        names.append((title, f", v{item.version}", f" ({item.exercise})"))
    count = Counter(title for title, _, _ in names)
    return [
        f"{title[: _LONGEST // 2]}{version}{name if count[title] > 1 else ''}"
        for title, version, name in names
    ]


def chance_words(board: ProgressBoard, rule: GradeRule) -> str:
    """Say what chance does to grades by this rule, with figures of these attempts."""
    some = [attempts for attempts in board.counted.values() if attempts]
    spread = spread_of(board)
    if spread.sd is None:
        if rule.rule is not GradeFrom.BEST:
            return ""
        return sentence(
            "the best of several attempts lies above what a student usually does: the best of 5 "
            "equal attempts by {share:.1f} standard deviations; how much attempts vary here is not "
            "known yet ({pairs})",
            share=expected_best(5),
            pairs=counted("{n} pair of attempts", "{n} pairs of attempts", spread.pairs),
        )
    attempts_vary = sentence(
        "attempts of one student vary by {sd:.1f} points from one to the next (standard deviation, "
        "{pairs})",
        sd=spread.sd,
        pairs=counted("{n} pair of attempts", "{n} pairs of attempts", spread.pairs),
    )
    if rule.rule is GradeFrom.BEST:
        above = [expected_best(len(attempts)) * spread.sd for attempts in some]
        most = max(len(attempts) for attempts in some)
        consequence = sentence(
            "so the best of 5 equal attempts is expected {five:.1f} points above their mean, and "
            "these grades {mean:.1f} on average, up to {high:.1f} for {attempts} attempts: who "
            "tries more often is graded higher without being better",
            five=expected_best(5) * spread.sd,
            mean=sum(above) / len(above),
            high=max(above),
            attempts=most,
        )
    else:
        size = rule.last if rule.rule is GradeFrom.MEAN else 1
        consequence = sentence(
            "so a grade by this rule is uncertain by {sd:.1f} points, and does not rise with the "
            "number of attempts by chance",
            sd=spread.sd / size**0.5,
        )
    return joined("; ", (attempts_vary, consequence))


def spread_of(board: ProgressBoard) -> AttemptSpread:
    """Return how much the attempts on a board vary."""
    return attempt_spread([a.total or 0.0 for a in some] for some in board.counted.values())


def _rows(
    board: ProgressBoard,
    choice: MoodleChoice,
    known: dict[str, str],
    titles: Mapping[str, str],
    remarks: Mapping[str, Remarks],
    translate: Callable[[str], str],
) -> Iterator[Sequence[object]]:
    heads: list[object] = [choice.identifier.value]
    for name in item_names(board, titles):
        heads += [name, f"{name} (Feedback)"] if choice.feedback else [name]
    yield heads
    for person in board.students:
        row: list[object] = [known[person.key]]
        for item in board.items:
            attempts = board.counted.get((person.key, item.exercise), ())
            grade = choice.rule.grade(attempts)
            row.append(None if grade is None else round(grade, 2))
            if choice.feedback:
                row.append(translate(_feedback(choice.rule, attempts, remarks)))
        yield row


def _feedback(rule: GradeRule, attempts: Sequence[Indexed], remarks: Mapping[str, Remarks]) -> str:
    """Say how a grade came about, and what the instructor said of what makes it."""
    if not attempts:
        return ""
    n, taken = len(attempts), len(rule.taken(attempts))
    of_how_many = {
        GradeFrom.BEST: counted("best of {n} attempt", "best of {n} attempts", n),
        GradeFrom.FIRST: counted("first of {n} attempt", "first of {n} attempts", n),
        GradeFrom.LAST: counted("last of {n} attempt", "last of {n} attempts", n),
        GradeFrom.MEAN: counted(
            "mean of the last {n} attempt", "mean of the last {n} attempts", taken
        ),
    }[rule.rule]
    passed = any(attempt.passed for attempt in attempts)
    parts = [
        sentence("the only attempt") if n == 1 else of_how_many,
        sentence("passed") if passed else sentence("not passed yet"),
    ]
    parts += [
        sentence("the instructor: {comment}", comment=" ".join(comment.split()))
        for attempt in rule.taken(attempts)
        if (comment := remarks.get(attempt.id, Remarks()).comment)
    ]
    return joined("; ", parts)


def _readable(value: object) -> str:
    """Return a cell as Moodle reads it: a blank keeps a backslash from hiding a quote."""
    return _HIDING.sub(lambda match: match[0] + " ", cell(value))


def _some(names: Sequence[str]) -> str:
    more = f" (+{len(names) - _NAMED})" if len(names) > _NAMED else ""
    return ", ".join(names[:_NAMED]) + more
