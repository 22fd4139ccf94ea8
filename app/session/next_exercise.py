"""Which exercise comes next after an attempt, and why; and which others may stand beside it.

`propose` is pure: from what the attempt came to, what the student did before, the exercises that
there are, and the course if there is one. Nothing is proposed that rests on a result which the
student may not know yet, and nothing that he may not begin. `around` finds all that in the folder
of records.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path
from typing import Final

from app.exercises.practised_skill import is_lesson
from app.exercises.schema import Exercise
from app.scoring.result import Score
from app.session.board import Standing
from app.session.course import Course, courses, held_back, holding, not_void
from app.session.index import Index, Indexed
from app.session.motion import rivals
from app.session.people import PEOPLE, People, Person, Remarks, people_folder
from app.session.proficiency import mastered
from app.session.review import Review

TRIES: Final = 3
"""After so many attempts in a row that did not pass an easier exercise is proposed."""


class ProposalReason(StrEnum):
    """Why an exercise is proposed."""

    COURSE = "course"  # the next one of the course
    LEVEL = "level"  # mastered: the easiest that is not mastered yet
    WEAKNESS = "weakness"  # likewise, and it trains what cost most
    AGAIN = "again"  # not passed: the same once more
    CONFIRM = "confirm"  # passed once: two passes in a row lead on
    EASIER = "easier"  # not passed several times
    VOID = "void"  # nothing was judged: the same once more
    YOURSELF = "yourself"  # a program did it: the same, by hand
    DONE = "done"  # everything is passed: where most is to be gained
    WHOLE = "whole"  # a drill: the whole exercise after it
    CLOSED = "closed"  # none may be begun, or none can be named yet


@dataclass(frozen=True, slots=True)
class Proposal:
    """What comes next.

    Attributes:
        exercise: id; empty where nothing is proposed.
        title: as it is written.
        reason: why.
        metric: label of what cost most points; empty where nothing did or nobody may know it.
        points: what it cost, of 100.
        course: title of the course that it follows; empty without one.
        level: of the proposed exercise.
        tries: attempts in a row that did not pass; of a drill, those of that day with a score.
        closed: why the same exercise may not be begun again; empty where it may.
    """

    exercise: str
    title: str
    reason: ProposalReason
    metric: str = ""
    points: float = 0.0
    course: str = ""
    level: int = 0
    tries: int = 0
    closed: str = ""


def propose(
    done: str,
    score: Score | None,
    before: Sequence[Indexed],
    exercises: Sequence[Exercise],
    course: Course | None = None,
    refused: Callable[[str], str] = lambda _: "",
    held: bool = False,
) -> Proposal:
    """Propose what comes next.

    Args:
        done: id of the exercise that was attempted.
        score: of the attempt; None where nothing was judged, and where `held`.
        before: the student's attempts, this one among them, oldest first.
        exercises: that there are, easiest first.
        course: that the exercise was attempted in; None without one.
        refused: says why an exercise may not be begun now; empty where it may.
        held: whether the result is not released: nothing is told of it, not even by the proposal.
    """
    by_id = {one.id: one for one in exercises}
    lost = score.losses if score is not None and not held else ()
    name, label, points = (lost[0][1].name, lost[0][1].label, lost[0][0]) if lost else ("", "", 0.0)
    same = by_id.get(done)
    in_course = [item.exercise for item in course.items] if course is not None else []
    title = course.title if course is not None else ""

    def proposal(item: Exercise, reason: ProposalReason, tries: int = 0) -> Proposal:
        return Proposal(item.id, item.title, reason, label, points, title, item.level, tries)

    def again(reason: ProposalReason, tries: int = 0) -> Proposal:
        if same is None or refused(done):
            return Proposal("", "", ProposalReason.CLOSED, label, points, title)
        return proposal(same, reason, tries)

    if held:
        if course is not None and not course.ordered and done in in_course:
            after = in_course[in_course.index(done) + 1 :]
            for one in after:
                if one in by_id and not refused(one):
                    return proposal(by_id[one], ProposalReason.COURSE)
        return Proposal("", "", ProposalReason.CLOSED, course=title)
    if score is None or score.total is None:
        return again(ProposalReason.VOID)
    followed = course if done in in_course else None
    if not score.passed:
        tries = _in_a_row(done, before)
        easier = [one for one in exercises if same is not None and one.level < same.level]
        easier = [one for one in easier if not refused(one.id) and _fits(one, in_course)]
        if tries >= TRIES and easier:
            return proposal(_best_for(easier, name)[0], ProposalReason.EASIER, tries)
        return again(ProposalReason.AGAIN, tries)
    if followed is None:
        over = mastered(before, {one.id: one.version for one in exercises})
        if done not in over and same is not None and not refused(done):
            return proposal(same, ProposalReason.CONFIRM)
    else:
        over = _passed(before) | {done}
    left = still_open(exercises, followed, over, refused)
    if not left:
        return again(ProposalReason.DONE)
    if done in in_course:
        return proposal(left[0], ProposalReason.COURSE)
    lowest = [one for one in left if one.level == left[0].level]
    found, trains = _best_for(lowest, name)
    return proposal(found, ProposalReason.WEAKNESS if trains else ProposalReason.LEVEL)


def still_open(
    exercises: Sequence[Exercise],
    course: Course | None,
    done: Container[str],
    refused: Callable[[str], str] = lambda _: "",
) -> list[Exercise]:
    """Return what is not done yet and may be begun, what comes first at the front.

    In a course that is its order, else that of the lessons, the easiest first: what is for another
    machine follows from nothing. Start page and debrief both go by it; of equally easy ones the
    debrief prefers what trains what cost most.

    Args:
        exercises: that there are, easiest first.
        course: whose exercises alone count; None for all lessons.
        done: ids of those that were passed in the course; without one those that are mastered.
        refused: says why an exercise may not be begun now; empty where it may.
    """
    by_id = {one.id: one for one in exercises}
    order = (
        [one.id for one in exercises if is_lesson(one)]
        if course is None
        else [item.exercise for item in course.items]
    )
    return [by_id[one] for one in order if one in by_id and one not in done and not refused(one)]


def comes_next(
    stood: Mapping[str, Standing],
    exercises: Sequence[Exercise],
    student: Person | None,
    refused: Callable[[str], str] = lambda _: "",
) -> str:
    """Return the exercise that comes next: of a student's course, else of the lessons.

    In a course what is passed leads on, else what is mastered. Where nothing is left it is the one
    with the lowest best points; empty where none may be begun.

    Args:
        stood: how far who is here has come, by id of the exercise.
        exercises: that there are, easiest first.
        student: who; None for everybody.
        refused: says why an exercise may not be begun now; empty where it may.

    Raises:
        SessionError: if the courses cannot be read.
    """
    course = course_of(student)
    done = {
        name
        for name, one in stood.items()
        if (one.passed if course is not None else one.masters > 0)
    }
    left = still_open(exercises, course, done, refused)
    if left:
        return left[0].id
    able = still_open(exercises, course, (), refused)
    return min(able, key=lambda one: stood[one.id].best or 0.0).id if able else ""


def course_of(student: Person | None) -> Course | None:
    """Return the course that a student follows; None where there is none.

    Raises:
        SessionError: if the courses cannot be read.
    """
    if student is None:
        return None
    return next((one for one in courses()[0] if one.takes(student)), None)


def _fits(item: Exercise, in_course: Sequence[str]) -> bool:
    return not in_course or item.id in in_course


def _passed(before: Sequence[Indexed]) -> set[str]:
    """Exercises that a person passed, in any version; none by a script or altered afterwards."""
    return {one.exercise for one in before if one.passed and one.counts}


def _in_a_row(exercise: str, before: Sequence[Indexed]) -> int:
    """Return how many of the newest attempts at an exercise did not pass, one after the other."""
    count = 0
    for one in reversed([one for one in before if one.exercise == exercise]):
        if one.passed:
            break
        count += one.passed is False
    return max(1, count)


def _best_for(some: Sequence[Exercise], metric: str) -> tuple[Exercise, bool]:
    """Return the first exercise that judges a metric, or the first one; and whether it does."""
    if metric:
        for one in some:
            if metric in one.tolerances and one.tolerances[metric].weight > 0.0:
                return one, True
    return some[0], False


MOST_RIVALS: Final = 20


@dataclass(frozen=True, slots=True)
class Around:
    """What the other attempts say of one.

    Attributes:
        proposal: what comes next.
        rivals: what may stand beside it, each with whether it is of the same person.
    """

    proposal: Proposal
    rivals: tuple[tuple[Indexed, bool], ...]


def around(
    folder: Path,
    shown: Review,
    held: bool,
    exercises: Sequence[Exercise],
    manages: bool,
    may_see: Callable[[str], bool],
    refusal: Callable[[str], str],
) -> Around:
    """Look at the other attempts in a folder: what comes next, and what may stand beside one.

    Args:
        folder: of the records.
        shown: the attempt.
        held: whether its result is not released.
        exercises: that there are, easiest first.
        manages: whether who is here may see every result.
        may_see: whether attempts of whom a record names are open to who is here.
        refusal: says why who is here may not begin an exercise; empty where he may.

    Raises:
        SessionError: if something cannot be read.
    """
    index = Index(folder)
    index.refresh()
    attempts, (person, courses_here, remarks) = index.attempts(), who_did(shown.student)

    def same(student: str) -> bool:
        return student == shown.student

    def is_open(item: Indexed) -> bool:
        if manages:
            return True
        if not may_see(item.student):
            return False
        said = remarks.get(item.id)
        released = said is not None and said.released
        owner = person if same(item.student) else None
        return holding(courses_here, owner, item.exercise, item.version, released) is None

    under = shown.conditions
    own = [one for one in attempts if same(one.student) and one.stands and one.conditions.by_person]
    done = under.exercise if under is not None else ""
    course = next(
        (
            one
            for one in courses_here
            if person is not None
            and one.takes(person)
            and any(item.exercise == done for item in one.items)
        ),
        None,
    )
    seen = not_void((one for one in own if is_open(one)), remarks)
    score = None if held else shown.score
    if shown.drill is not None:
        scored = [one for one in not_void(own, remarks) if one.total is not None]
        rounds = sum(one.exercise == done and _same_day(one, shown) for one in scored)
        proposal = _whole(shown.drill.of, exercises, refusal, rounds)
    elif under is not None and not under.by_person:
        proposal = _yourself(done, exercises, refusal)
    else:
        proposal = propose(done, score, seen, exercises, course, refusal, held)
        proposal = replace(proposal, closed=refusal(done) if done else "")
    found = () if held or under is None else rivals(attempts, shown.id, under, same, is_open)
    return Around(proposal, tuple((one, same(one.student)) for one in found[:MOST_RIVALS]))


def _same_day(item: Indexed, shown: Review) -> bool:
    """Return whether an attempt was made on the day of the one that is shown, and not after it."""
    return item.started[:10] == shown.started[:10] and item.started <= shown.started


def _whole(
    whole: str, exercises: Sequence[Exercise], refused: Callable[[str], str], rounds: int
) -> Proposal:
    """Propose the whole exercise after a drill of it."""
    item = next((one for one in exercises if one.id == whole), None)
    if item is None or refused(whole):
        return Proposal("", "", ProposalReason.CLOSED, tries=rounds)
    return Proposal(item.id, item.title, ProposalReason.WHOLE, level=item.level, tries=rounds)


def _yourself(done: str, exercises: Sequence[Exercise], refused: Callable[[str], str]) -> Proposal:
    """Propose to do by hand what a program did."""
    same = next((one for one in exercises if one.id == done), None)
    if same is None or refused(done):
        return Proposal("", "", ProposalReason.CLOSED)
    return Proposal(same.id, same.title, ProposalReason.YOURSELF, level=same.level)


def who_did(recorded: str) -> tuple[Person | None, Sequence[Course], Mapping[str, Remarks]]:
    """Return whom a record names, all courses, and what the instructor said of attempts.

    Nobody where none is known.

    Raises:
        SessionError: if people or courses cannot be read.
    """
    if not (people_folder() / PEOPLE).exists():
        return None, (), {}
    people = People()
    person = next((one for one in people.everybody() if one.key == recorded), None)
    return person, courses()[0], people.remarks()


def held_by(shown: Review) -> str:
    """Return the title of the course that holds the result of an attempt; empty if none does.

    Raises:
        SessionError: if people or courses cannot be read.
    """
    under = shown.conditions
    if under is None:
        return ""
    return held_back([(shown.id, shown.student, under.exercise, under.version)]).get(shown.id, "")
