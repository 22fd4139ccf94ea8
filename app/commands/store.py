"""`acus store`: the folder of records and its index."""

from pathlib import Path
from typing import Annotated, Any

import typer

from app.commands.answer import Answer, Commands
from app.commands.reader_language import local, template
from app.commands.record_options import RecordsFolder
from app.commands.school_store import add_to as add_school_store
from app.commands.shown import Each
from app.commands.stations import add_to
from app.core.messages import sentence

RANK = 90


def register(app: typer.Typer) -> None:
    """Add `store status`, `rebuild`, `backup`, `restore`, `empty-trash`, and those of stations."""
    store = Commands(help="The folder of records: index, backup, trash, other stations.")
    store.command("status")(status)
    store.command("rebuild")(rebuild)
    store.command("check")(check)
    store.command("backup")(backup)
    store.command("restore")(restore)
    store.command("empty-trash")(empty)
    add_to(store)
    add_school_store(store)
    app.add_typer(store, name="store")


def status(folder: RecordsFolder = None) -> Answer:
    """Say how many attempts there are and what is signed.

    Brings the index up to date first. *verified*: written by this station and unchanged; it does
    not mean that the owner of the disk could not forge it.
    """
    from collections import Counter

    from app.session.index import Index
    from app.session.signature import Signed
    from app.session.store import TRASH, records, records_folder

    place = records_folder(folder)
    index = Index(place)
    seen = index.refresh()
    found = index.attempts()
    verdicts, states = Counter(one.verdict for one in found), Counter(one.state for one in found)
    rare = (Signed.ADMITTED, Signed.REVOKED)
    words = [v.value for v in Signed if v not in rare or verdicts[v.value]]
    words += sorted({one for one in verdicts if "(" in one})  # by other stations
    facts = {
        "folder": place,
        "index": index.path,
        "read": seen.read,
        "gone": seen.gone,
        "attempts": len(found),
        "signatures": {verdict: verdicts[verdict] for verdict in words},
        "states": dict(sorted(states.items())),
        "deleted": len(records(place / TRASH)),
    }
    shown = (
        template("{attempts} attempts in {folder}, {deleted} deleted"),
        template("index: {index:?{index}|in memory, the folder can only be read}"),
    )
    lines = [
        "signatures: " + ", ".join(f"{verdicts[v]} {v}" for v in words),
        "states: " + (", ".join(f"{n} {state}" for state, n in sorted(states.items())) or "none"),
    ]
    return Answer(facts, lines, shown=shown)


def rebuild(folder: RecordsFolder = None) -> Answer:
    """Make the index anew from the records."""
    from app.commands.calibrate_parts import with_progress
    from app.session.index import Index
    from app.session.store import records_folder

    index = Index(records_folder(folder))
    done = with_progress(index.rebuild)
    facts = {"folder": index.folder, "index": index.path, "attempts": done.total, "gone": done.gone}
    return Answer(
        facts, shown=template("{attempts} attempts indexed, {gone} of the old index are gone")
    )


def check(
    backup: Annotated[
        Path | None,
        typer.Argument(
            metavar="[BACKUP]", help="A backup, or a folder of them; else what is here."
        ),
    ] = None,
    folder: RecordsFolder = None,
) -> Answer:
    """Read what is here, or a backup, for damage (instructor).

    What is not as it was written is named.

    Every record is read whole and held against its signature, the list of people and the audit
    trail are looked through, every file of a backup is held against its list. Nothing is changed.
    Ends with code 3 if something is wrong. Of a folder of backups the newest is read.
    """
    from app.commands.calibrate_parts import with_progress
    from app.commands.doors import instructor, passphrase
    from app.session.archive import check_backup, check_store
    from app.session.backup_folder import is_encrypted
    from app.session.people import People
    from app.session.store import records_folder

    people = People()
    instructor(people)
    if backup is not None:
        source = backup
        secret = passphrase() if is_encrypted(source) else ""
        done = with_progress(lambda progress: check_backup(source, progress, secret))
    else:
        place = records_folder(folder)
        done = with_progress(lambda progress: check_store(place, people, progress))
    facts = {
        "records": done.files,
        "signatures": done.signatures,
        "wrong": list(done.wrong),
    }
    shown = (
        template("{records:#1 record|# records} read"),
        Each("wrong", template("✖ {}"), template("✔ everything is as it was written")),
    )
    return Answer(facts, yes=not done.wrong, shown=shown)


def backup(
    out: Annotated[Path | None, typer.Option("--out", help="File to write.")] = None,
    into: Annotated[
        Path | None, typer.Option("--into", help="Folder of backups to add one to.")
    ] = None,
    encrypt: Annotated[
        bool, typer.Option("--encrypt", help="Encrypt it; asks for a passphrase (--into).")
    ] = False,
    with_cts: Annotated[
        bool, typer.Option("--with-cts", help="The CTs of own exercises too (--into).")
    ] = False,
    folder: RecordsFolder = None,
) -> Answer:
    """Write everything into a file or a folder (instructor).

    It holds names, and is readable by you only. Into a folder, what is there already from an
    earlier backup is not written again. The station's key is in it only where an instructor's
    password is set, encrypted by the recovery key that was printed then.
    """
    from app.commands.calibrate_parts import with_progress
    from app.commands.doors import instructor, passphrase
    from app.session import archive
    from app.session.backup_folder import backups_of
    from app.session.errors import SessionError
    from app.session.people import People
    from app.session.station import opens
    from app.session.store import records_folder

    if (out is None) == (into is None) or (into is None and (encrypt or with_cts)):
        raise SessionError(
            sentence("give --out FILE or --into FOLDER; --encrypt and --with-cts need --into")
        )
    people, place = People(), records_folder(folder)
    instructor(people)
    facts: dict[str, Any] = {}
    if into is not None:
        room = into
        secret = passphrase(confirm=not backups_of(room)) if encrypt else ""
        saved = with_progress(
            lambda progress: archive.backup_into(room, place, people, progress, secret, with_cts)
        )
        facts = {"files": [saved.path], "records": saved.records, "new_mb": saved.new / 1e6}
        left = list(saved.left_out)
        written = template(
            "{records:#1 record|# records} written to {files}, {new_mb:.1f} MB were new"
        )
    elif out is not None:
        file = out
        count = with_progress(lambda progress: archive.backup(file, place, people, progress))
        facts, left = {"files": [out], "records": count}, archive.left_out()
        written = template("{records:#1 record|# records} written to {files}")
    wrapped = people.wrapped_key()
    key = bool(wrapped) and opens(wrapped)
    lines = []
    if wrapped and not key:
        lines.append(
            sentence(
                "the station's key in it was sealed by an earlier build, and nothing opens it any "
                "more: change the password (`acus people instructor`), which prints a new recovery "
                "key, and make the backup again"
            )
        )
    elif not key:
        lines.append(
            sentence(
                "without the station's key: set a password first (`acus people instructor`) if its "
                "records are to be verified on another computer"
            )
        )
    facts |= {"key": key, "left_out": left}
    return Answer(facts, lines, shown=(written, Each("left_out", template("not in it: {}"))))


def restore(
    source: Annotated[
        Path, typer.Argument(metavar="BACKUP", help="A backup, or a folder of them: the newest.")
    ],
    folder: RecordsFolder = None,
    key: Annotated[
        bool, typer.Option("--key", help="The station's key too; asks for the recovery key.")
    ] = False,
    people_too: Annotated[
        bool, typer.Option("--people", help="People too, although there are some here.")
    ] = False,
) -> Answer:
    """Bring back what a backup holds (instructor).

    Only what is missing here, all of it or nothing: no record is overwritten, and nobody comes back
    who was erased. Says what of it is not taken, and ends with code 3 if anything is not.
    """
    from app.commands.calibrate_parts import with_progress
    from app.commands.doors import instructor, passphrase
    from app.session import archive
    from app.session.backup_folder import is_encrypted
    from app.session.people import People
    from app.session.store import records_folder

    people, place = People(), records_folder(folder)
    instructor(people)
    recovery = typer.prompt(local(sentence("Recovery key")), err=True) if key else ""
    secret = passphrase() if is_encrypted(source) else ""
    done = with_progress(
        lambda progress: archive.restore_backup(
            source, place, recovery, people_too, people, progress, secret
        )
    )
    facts = {
        "records": done.records,
        "kept": done.kept,
        "different": list(done.different),
        "erased": done.erased,
        "people": done.people,
        "key": done.key,
        "cts": list(done.cts),
        "not_taken": list(done.not_taken),
    }
    shown = (
        template("{records} records restored, {kept} were here already"),
        "people: {people}; station's key: {key}",
        Each("different", template("✖ {} is another record here: the one here was kept")),
        template("{erased} records left out: their person was erased") if done.erased else "",
        Each("cts", template("a CT lies in {}: move it to where its exercise names it")),
        Each("not_taken", template("✖ not taken: {}")),
    )
    return Answer(facts, yes=not done.different and not done.not_taken, shown=shown)


def empty(
    days: Annotated[float, typer.Option("--days", min=30.0, help="At least 30.")] = 30.0,
    folder: RecordsFolder = None,
) -> Answer:
    """Delete what was deleted 30 days ago for good (instructor)."""
    from app.commands.doors import instructor
    from app.session.archive import empty_trash
    from app.session.store import records_folder

    instructor()
    gone = empty_trash(records_folder(folder), days)
    return Answer(
        {"deleted": gone}, shown=template("{deleted:#1 attempt|# attempts} deleted for good")
    )
