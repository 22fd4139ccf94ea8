"""`acus store stations`, `revoke`, `renew`, `results`, `station`, `gather`, `audit`."""

from pathlib import Path
from typing import Annotated, Any

import typer

from app.commands import completion
from app.commands.answer import Answer, Commands
from app.commands.doors import instructor
from app.commands.reader_language import template
from app.commands.record_options import RecordsFolder
from app.commands.shown import Each
from app.core.messages import joined, sentence, sentence_of


def add_to(store: Commands) -> None:
    """Add the commands to the group `store`."""
    store.command("stations")(stations)
    store.command("revoke")(revoke)
    store.command("renew")(renew)
    store.command("results")(results)
    store.command("station")(station)
    store.command("gather")(gather)
    store.command("audit")(audit)


def stations(
    name: Annotated[str, typer.Option("--name", help="Name this station.")] = "",
) -> Answer:
    """Show this station and those known here (instructor).

    Each has a fingerprint, which two people compare before one lets the other's station in.
    """
    from app.session.people import People
    from app.session.station import StationKey
    from app.session.stations import fingerprint, name_of_station, set_name, stations_of

    people = People()
    instructor(people)
    if name:
        set_name(name, people)
    key = StationKey.of(people.folder)
    known = sorted(stations_of(people).values(), key=lambda one: (one.name, one.public))
    facts = {
        "station": key.station,
        "name": name_of_station(people, key),
        "fingerprint": fingerprint(key.public),
        "known": [
            {
                "station": one.station,
                "name": one.name,
                "fingerprint": fingerprint(one.public),
                "revoked": one.revoked,
            }
            for one in known
        ],
    }
    row = template("{name:20} {fingerprint} {revoked:?revoked|}")
    none = template("no other station is known here")
    this = template("this station is {name}: {fingerprint}")
    return Answer(facts, shown=(this, Each("known", row, none)))


def revoke(
    station: Annotated[str, typer.Argument(metavar="STATION", help="Its name or id.")],
) -> Answer:
    """Trust a known station no longer (instructor).

    It cannot be undone. Its files are refused, and its attempts count here only where the
    instructor admits them.
    """
    from app.session.people import People
    from app.session.stations import revoke as revoke_station

    people = People()
    instructor(people)
    one = revoke_station(station, people)
    shown = template("{name} is revoked: what it signed counts here only once admitted")
    return Answer({"station": one.station, "name": one.name}, shown=shown)


def renew() -> Answer:
    """Give this station a new key (instructor).

    What the one before signed stays verified. Lists read every record once more after it. Where a
    password is set a new recovery key is printed, and the one before is worth nothing any more.
    """
    from app.session.people import People
    from app.session.station import StationKey
    from app.session.stations import fingerprint, renew_key

    people = People()
    instructor(people)
    recovery = renew_key(people)
    print_it = sentence("Print it and lock it away: it opens the station's key in a backup.")
    lines = [sentence("recovery key: {key}", key=recovery), print_it] if recovery else []
    facts = {
        "recovery_key": recovery or None,
        "fingerprint": fingerprint(StationKey.of(people.folder).public),
    }
    return Answer(facts, lines, shown=template("this station has a new key: {fingerprint}"))


def results(
    out: Annotated[Path, typer.Option("--out", help="File to write.")],
    course: Annotated[
        str,
        typer.Option("--course", help="Only of its exercises.", autocompletion=completion.courses),
    ] = "",
    folder: RecordsFolder = None,
) -> Answer:
    """Write this station's results for others (instructor).

    Finished attempts that this station signed, what was said of attempts here, and who was erased,
    as digests that name nobody. `acus store gather` takes it in elsewhere. Ends with code 3 if an
    attempt is left out because it was altered.
    """
    from app.commands.calibrate_parts import with_progress
    from app.session.course import find_course
    from app.session.people import People
    from app.session.results_file import write_results
    from app.session.store import records_folder

    people, place = People(), records_folder(folder)
    instructor(people)
    chosen = find_course(course) if course else None
    done = with_progress(lambda progress: write_results(out, place, chosen, people, progress))
    facts = {
        "files": [out],
        "attempts": done.attempts,
        "remarks": done.remarks,
        "erased": done.erased,
        "left_out": list(done.left_out),
    }
    shown = (
        template(
            "{attempts:#1 attempt|# attempts} and {remarks:#1 remark|# remarks} written to {files}"
        ),
        Each("left_out", template("✖ {} is left out: it was altered after it was signed")),
    )
    return Answer(facts, yes=not done.left_out, shown=shown)


def station(
    out: Annotated[Path, typer.Option("--out", help="File to write.")],
    names: Annotated[bool, typer.Option("--names", help="Names too.")] = False,
    pins: Annotated[bool, typer.Option("--pins", help="Hashes of the PINs too.")] = False,
    folder: RecordsFolder = None,
) -> Answer:
    """Write the course for another station (instructor).

    Students by key and pseudonym with their groups, courses, own exercises, and known stations, so
    that everybody has the same key everywhere. Without --pins each station gives PINs of its own.
    """
    from app.commands.calibrate_parts import with_progress
    from app.session.people import People
    from app.session.results_file import write_course
    from app.session.store import records_folder

    people, place = People(), records_folder(folder)
    instructor(people)
    done = with_progress(lambda progress: write_course(out, place, names, pins, people, progress))
    facts = {
        "files": [out],
        "people": done.people,
        "courses": done.courses,
        "erased": done.erased,
    }
    shown = template(
        "{people:#1 student|# students} and {courses:#1 course|# courses} written to {files}"
    )
    return Answer(facts, shown=shown)


def gather(
    files: Annotated[list[Path], typer.Argument(metavar="FILE...", help="Of other stations.")],
    trust: Annotated[
        bool, typer.Option("--trust", help="Let stations in that are not known here.")
    ] = False,
    names: Annotated[bool, typer.Option("--names", help="Names of students too.")] = False,
    folder: RecordsFolder = None,
) -> Answer:
    """Take in what other stations wrote (instructor).

    In any order, twice, half of them now: it ends the same. Each file is taken whole or not at all.
    Ends with code 3 if a file is refused, or something is another one here and left out.
    """
    from app.commands.calibrate_parts import with_progress
    from app.core.errors import AcusError
    from app.core.progress import Cancelled
    from app.session.gathering import GatheredFile, gather_file, told_of
    from app.session.people import People
    from app.session.store import records_folder

    people, place = People(), records_folder(folder)
    instructor(people)
    gathered: list[GatheredFile] = []
    taken: list[dict[str, Any]] = []
    refused: list[str] = []
    for number, file in enumerate(files):
        begin, end = number / len(files), (number + 1) / len(files)
        try:
            done = with_progress(
                lambda progress, file=file, begin=begin, end=end: gather_file(  # type: ignore[misc]
                    file, place, trust, names, people, progress.part(begin, end)
                )
            )
        except Cancelled:
            raise
        except AcusError as error:
            refused.append(sentence_of(error))
            continue
        gathered.append(done)
        taken.append(
            {
                "file": file,
                "station": done.station,
                "attempts": done.attempts,
                "present": done.present,
                "remarks": done.remarks,
                "erased": done.erased,
                "left_out": done.left_out,
                "people": done.people,
                "courses": done.courses,
                "excess": done.excess,
                "strangers": done.strangers,
                "different": list(done.different),
            }
        )
    row = template(
        "{station}: {attempts:#1 attempt|# attempts} added, {present} here already, "
        "{remarks:#1 remark|# remarks}, {people:#1 student|# students}, "
        "{courses:#1 course|# courses}, {erased} erased, {left_out} left out as erased"
    )
    lines = [
        joined(" ", ("✖", sentence("left out: {line}", line=line)))
        for one in taken
        for line in one["different"]
    ]
    lines += [joined(" ", ("✖", line)) for line in refused]
    lines += told_of(gathered)
    excess = gathered[-1].excess if gathered else 0
    facts = {"taken": taken, "refused": refused, "excess": excess}
    yes = not refused and not any(one["different"] for one in taken)
    return Answer(facts, lines, yes=yes, shown=Each("taken", row))


def audit(
    last: Annotated[int, typer.Option("--last", help="Only so many lines; 0: all.", min=0)] = 20,
) -> Answer:
    """Say who did what at this station (instructor).

    Keys and ids, no names. Each line is signed and chained to the one before; ends with code 3 if
    one was changed, taken out or put in.
    """
    from app.session.audit import audit_file, entries
    from app.session.people import People

    people = People()
    instructor(people)
    every = entries(people.folder)
    wrong = [one.number for one in every if not one.right]
    shown_lines = every[-last:] if last else every
    facts = {
        "file": audit_file(people.folder),
        "lines": len(every),
        "wrong": wrong,
        "entries": [
            {
                "number": one.number,
                "time": one.time,
                "who": one.who,
                "what": one.what,
                "about": list(one.about),
                "count": one.count,
                "right": one.right,
            }
            for one in shown_lines
        ],
    }
    row = template("{number:6} {time:25} {who:14} {what:22} {count:4} {about}")
    shown = (
        Each("entries", row, template("nothing was done yet")),
        template("{wrong:?✖ not as they were written: {wrong}|}"),
    )
    return Answer(facts, yes=not wrong, shown=shown)
