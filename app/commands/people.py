"""`acus people` and `acus course`: students, groups, the instructor; exercises for them."""

import datetime
from pathlib import Path
from typing import Annotated

import typer

from app.commands import completion, people_openid
from app.commands.answer import Answer, Commands
from app.commands.doors import instructor, secret
from app.commands.reader_language import local, template
from app.commands.record_options import RecordsFolder
from app.commands.shown import Each
from app.core.messages import counted, joined, listed, sentence

Pseudonym = Annotated[
    str,
    typer.Argument(metavar="PSEUDONYM", help="The student.", autocompletion=completion.students),
]
CourseId = Annotated[
    str, typer.Argument(metavar="COURSE", help="Its id.", autocompletion=completion.courses)
]


RANK = 100


def register(app: typer.Typer) -> None:
    """Add the groups `people` and `course`."""
    people = Commands(help="Students, groups, and the instructor.")
    people.command("list")(list_)
    people.command("add")(add)
    people.command("roster")(roster)
    people.command("pin")(pin)
    people.command("rename")(rename)
    people.command("erase")(erase)
    people.command("instructor")(set_instructor)
    people.command("remark")(remark)
    people_openid.add_to(people)
    app.add_typer(people, name="people")
    course = Commands(help="Courses: exercises in order, for groups.")
    course.command("list")(list_courses)
    course.command("show")(show_course)
    course.command("save")(save_course)
    course.command("begin")(begin_course)
    course.command("plans")(list_plans)
    app.add_typer(course, name="course")


def list_(
    names: Annotated[bool, typer.Option("--names", help="Names too.")] = False,
) -> Answer:
    """List students and their groups (instructor)."""
    from app.session.people import People

    people = People()
    instructor(people)
    found = people.everybody(names)
    facts = {
        "students": [
            {"pseudonym": p.pseudonym, "key": p.key, "groups": list(p.groups)}
            | ({"name": p.name} if names else {})
            for p in found
        ],
        "instructor": people.has_instructor(),
    }
    row = "{pseudonym:24} {groups:24} " + ("{name}" if names else "{key}")
    none = template("no students yet: `acus people add` or `acus people roster`")
    return Answer(facts, shown=Each("students", row, none))


def add(
    pseudonym: Pseudonym,
    name: Annotated[str, typer.Option("--name", help="Name, kept apart.")] = "",
    group: Annotated[list[str] | None, typer.Option("--group", help="Group; repeatable.")] = None,
    pin_: Annotated[str, typer.Option("--pin", help="4 to 12 digits; drawn if not given.")] = "",
) -> Answer:
    """Add a student (instructor)."""
    from app.session.people import People
    from app.session.roster import RosterLine

    people = People()
    instructor(people)
    person, pin = people.add(RosterLine(pseudonym, name, pin_, tuple(group or ())))
    facts = {"pseudonym": person.pseudonym, "key": person.key, "pin": pin}
    return Answer(facts, shown=template("{pseudonym} was added; PIN {pin}"))


def roster(
    file: Annotated[Path, typer.Argument(metavar="CSV", help="Heading: pseudonym,name,pin,group.")],
    partly: Annotated[
        bool, typer.Option("--partly", help="Take the right rows although others are wrong.")
    ] = False,
) -> Answer:
    """Take students from a CSV file (instructor).

    Columns: pseudonym (needed), name, pin (drawn where empty), group (several separated by |). A
    student who is there already keeps the PIN unless the roster has one. If a row is wrong nothing
    is taken, unless --partly is given, and it ends with code 3.
    """
    from app.session.people import People
    from app.session.roster import roster_in

    people = People()
    instructor(people)
    lines, errors = roster_in(file)
    if errors and not partly:
        facts = {"added": [], "updated": [], "pins": {}, "errors": errors}
        return Answer(facts, yes=False, shown=(Each("errors"), template("nothing was taken")))
    done = people.take_roster(lines, partly)
    every = [*errors, *done.errors]
    facts = {
        "added": list(done.added),
        "updated": list(done.updated),
        "pins": dict(done.pins),
        "errors": every,
    }
    many = template("{added:#1 student|# students} added, {updated:#} updated")
    shown = (Each("errors"), many, Each("pins", "{key:24} PIN {value}"))
    return Answer(facts, yes=not every, shown=shown)


def pin(
    pseudonym: Pseudonym,
    new: Annotated[str, typer.Argument(metavar="PIN", help="4 to 12 digits.")],
) -> Answer:
    """Give a student another PIN (instructor)."""
    from app.session.people import People

    people = People()
    instructor(people)
    people.set_pin(pseudonym, new)
    return Answer({"pseudonym": pseudonym}, shown=template("{pseudonym} has a new PIN"))


def rename(
    pseudonym: Pseudonym,
    new: Annotated[str, typer.Argument(metavar="NEW", help="The pseudonym from now on.")],
) -> Answer:
    """Give a student another pseudonym (instructor).

    Attempts stay theirs. What the school's store has is looked through once more at the next
    exchange: a student of this pseudonym who was left out comes in then.
    """
    from app.session.people import People
    from app.session.school_store.synchronising import read_again

    people = People()
    instructor(people)
    before = people.find(pseudonym).pseudonym
    person = people.rename(pseudonym, new)
    read_again(people)
    facts = {"pseudonym": person.pseudonym, "before": before, "key": person.key}
    return Answer(facts, shown=template("{before} is {pseudonym} from now on"))


def erase(
    pseudonym: Pseudonym,
    records: Annotated[
        bool, typer.Option("--records/--keep-records", help="Delete the records, or keep them.")
    ],
    folder: RecordsFolder = None,
) -> Answer:
    """Erase a person for good (instructor): it cannot be undone.

    Name, PIN and comments go. Records hold a random key only and are deleted, or stay
    as nobody's. Files that were exported before are out of reach.
    """
    from app.session.archive import erase_person
    from app.session.people import People
    from app.session.store import records_folder

    people = People()
    instructor(people)
    found = erase_person(pseudonym, records_folder(folder), records, people)
    facts = {"pseudonym": pseudonym, "records": found.deleted, "anonymous": found.anonymous}
    shown = template(
        "{pseudonym} was erased; records deleted: {records}, kept as nobody's: {anonymous}"
    )
    return Answer(facts, shown=shown)


def set_instructor(
    recover: Annotated[
        bool, typer.Option("--recover", help="With the printed recovery key.")
    ] = False,
) -> Answer:
    """Set or change the instructor's password.

    The first time a recovery key is printed: write it down and lock it away. The password guards
    against curiosity, not against the owner of the disk, who can read and replace these files.
    """
    from app.session.people import People

    people = People()
    if recover:
        key = typer.prompt(local(sentence("Recovery key")), err=True)
        people.recover(key, _new_password())
        return Answer({"recovery_key": None}, [sentence("the password was changed")])
    if people.has_instructor():
        old = secret(sentence("Password now"))
        recovery = people.change_password(old, _new_password())
        lines = [sentence("the password was changed")]
        if not recovery:
            return Answer({"recovery_key": None}, lines)
        lines.append(sentence("the recovery key that was printed before is worth nothing any more"))
    else:
        recovery, lines = people.set_instructor(_new_password()), []
    return Answer(
        {"recovery_key": recovery},
        [
            *lines,
            sentence("recovery key: {key}", key=recovery),
            sentence(
                "Print it and lock it away: it sets a new password, and opens the station's key in "
                "a backup. It is kept nowhere."
            ),
        ],
    )


def remark(
    attempt: Annotated[str, typer.Argument(metavar="ID", help="Id of the attempt.")],
    comment: Annotated[str | None, typer.Option("--comment", help="For the student.")] = None,
    void: Annotated[
        str | None, typer.Option("--void", help="Reason why it does not count; '' if it does.")
    ] = None,
    release: Annotated[
        bool | None, typer.Option("--release/--hold", help="Show the result of an assessment.")
    ] = None,
    admit: Annotated[
        str | None,
        typer.Option("--admit", help="Why an attempt that is not signed here counts all the same."),
    ] = None,
    folder: RecordsFolder = None,
) -> Answer:
    """Comment an attempt, void, release or admit it (instructor)."""
    from app.session.admission import admissions
    from app.session.admission import admit as admit_records
    from app.session.people import People
    from app.session.store import find, records_folder

    people = People()
    instructor(people)
    path = find(records_folder(folder), attempt)
    name = path.stem
    if admit is not None:
        admit_records([path], admit, people)
    asked = {"comment": comment, "void": void, "released": release}
    said: dict[str, str | bool] = {k: v for k, v in asked.items() if v is not None}
    if said:
        people.remark(name, **said)
    now = people.remarks().get(name)
    facts = {
        "attempt": name,
        "comment": now.comment if now else "",
        "void": now.void if now else "",
        "released": bool(now and now.released),
        "admitted": admitted.why if (admitted := admissions(people).get(name)) else "",
    }
    return Answer(facts, shown=Each("", "{key:9} {value:?{value}|-}"))


def list_courses() -> Answer:
    """List the courses (instructor).

    Files that cannot be used are told with the reason; it ends with code 3 then.
    """
    from app.session.course import courses, courses_folder

    instructor()
    found, broken = courses()
    facts = {
        "folder": courses_folder(),
        "courses": [course.document() for course in found],
        "broken": broken,
    }
    row = template("{id:24} {title}: {items:#1 exercise|# exercises}")
    shown = (
        (Each("courses", row), Each("broken", "✖ {}"))
        if found or broken
        else template("no courses in {folder}")
    )
    return Answer(facts, yes=not broken, shown=shown)


def show_course(name: CourseId) -> Answer:
    """Show a course, and whether its exercises are there (instructor).

    Code 3 if one is not in the library in the version that is pinned.
    """
    from app.session.course import find_course, pinned_problems

    instructor()
    course = find_course(name)
    problems = pinned_problems(course)
    groups = listed(course.groups) if course.groups else sentence("everybody")
    lines: list[str] = [sentence("{title} ({groups})", title=course.title, groups=groups)]
    for item in course.items:
        more = [
            counted(", {n} attempt", ", {n} attempts", item.attempts) if item.attempts else "",
            sentence(", from {date}", date=item.opens) if item.opens else "",
            sentence(", until {date}", date=item.closes) if item.closes else "",
        ]
        line = sentence(
            "  {exercise} (version {version}): {purpose}",
            exercise=item.exercise,
            version=item.version,
            purpose=item.purpose.value,
        )
        lines.append(joined("", (line, *more)))
    lines += [joined(" ", ("✖", problem)) for problem in problems]
    return Answer(course.document() | {"problems": problems}, lines, yes=not problems)


def save_course(
    file: Annotated[Path, typer.Argument(metavar="YAML", help="File of the course.")],
) -> Answer:
    """Take a course from its file (instructor). Code 3 if its exercises are not all here.

    An exercise without a version is pinned to the newest one; with an unknown one nothing is saved.
    """
    from app.session.course import newest_versions, pinned_problems, read_course

    instructor()
    known = newest_versions()
    course = read_course(file).pinned(known)
    problems = pinned_problems(course)
    lines: list[str] = [joined(" ", ("✖", problem)) for problem in problems]
    if any(item.exercise not in known for item in course.items):
        lines.append(
            sentence(
                "{title} was not saved: correct these, or import the exercises first",
                title=course.title,
            )
        )
        return Answer({"files": [], "problems": problems}, lines, yes=False)
    path = course.save()
    lines.insert(0, sentence("{title} saved: {path}", title=course.title, path=path))
    return Answer({"files": [path], "problems": problems}, lines, yes=not problems)


def begin_course(
    plan: Annotated[str, typer.Argument(metavar="PLAN", help="See `acus course plans`.")],
    on: Annotated[str, typer.Option(help="First day, such as 2026-11-30.")],
    group: Annotated[list[str] | None, typer.Option(help="Who takes it; repeat.")] = None,
    name: Annotated[str, typer.Option(help="File name; default: the plan's, with the month.")] = "",
) -> Answer:
    """Begin a course by a plan on a day (instructor). Code 3 if its exercises are not all here."""
    from app.session.course import courses, newest_versions, pinned_problems
    from app.session.course_plan import find_course_plan

    instructor()
    try:
        first = datetime.date.fromisoformat(on)
    except ValueError as error:
        raise typer.BadParameter(
            sentence("{day!r} is no day; give one such as 2026-11-30", day=on)
        ) from error
    course = find_course_plan(plan).begun(first, tuple(group or ()), name)
    if any(other.id == course.id for other in courses()[0]):
        raise typer.BadParameter(
            sentence(
                "a course {id} is there already: give another --name, or change it in the window",
                id=course.id,
            )
        )
    course = course.pinned(newest_versions())
    problems = pinned_problems(course)
    if problems:
        lines = [joined(" ", ("✖", problem)) for problem in problems]
        return Answer({"files": [], "problems": problems}, lines, yes=False)
    path = course.save()
    saved = sentence("{title} saved: {path}", title=course.title, path=path)
    return Answer({"files": [path], "problems": []}, [saved])


def list_plans() -> Answer:
    """List the plans by which a course can be begun."""
    from app.session.course_plan import course_plans

    plans = course_plans()
    lines = [
        sentence(
            "{id:32} {units} units  {title}",
            id=plan.id,
            units=len(plan.units),
            title=plan.title,
        )
        for plan in plans
    ]
    return Answer({"plans": [plan.model_dump(mode="json") for plan in plans]}, lines)


def _new_password() -> str:
    return secret(sentence("New password"), confirm=True)
