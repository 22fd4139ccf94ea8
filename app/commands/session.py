"""`acus session`: recorded attempts."""

from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import typer

from app.commands import completion
from app.commands.answer import Answer, Commands
from app.commands.doors import PASSWORD, instructor, see
from app.commands.reader_language import tell, template
from app.commands.record_options import RecordsFolder
from app.commands.session_export import export
from app.commands.session_lines import detail_lines, details, nobodys, print_table, total_words
from app.core.messages import counted, joined, sentence

Id = Annotated[
    str,
    typer.Argument(
        metavar="ID", help="Session id, or its beginning.", autocompletion=completion.sessions
    ),
]
Record = Annotated[
    str,
    typer.Argument(
        metavar="ID",
        help="Session id, or its beginning; or the path of the record.",
        autocompletion=completion.sessions,
    ),
]


RANK = 80


def register(app: typer.Typer) -> None:
    """Add the group `session`."""
    session = Commands(help="Recorded attempts.")
    session.command("list")(list_)
    session.command("show")(show)
    session.command("replay")(replay)
    session.command("verify")(verify)
    session.command("compare")(compare)
    session.command("export")(export)
    session.command("delete")(delete)
    session.command("restore")(restore)
    session.command("recover")(recover)
    session.command("gather")(gather)
    app.add_typer(session, name="session")


def tell_folder() -> None:
    """Say where attempts are kept, and which lie in the source tree."""
    from app.core import paths

    tell(sentence("attempts are kept in {folder}", folder=paths.sessions()))
    tell_elsewhere()


def tell_elsewhere() -> None:
    """Say on standard error which attempts lie in the source tree."""
    from app.core import paths
    from app.session.elsewhere import elsewhere

    found = elsewhere(paths.sessions())
    if found is not None:
        tell(found.words, err=True)


def list_(folder: RecordsFolder = None) -> Answer:
    """List attempts, newest first. Broken records with the reason.

    Those of students are listed for the instructor alone, once one is set: his password stands in
    the variable ACUS_INSTRUCTOR_PASSWORD.
    """
    if folder is None:
        tell_elsewhere()
    from app.commands.doors import visitor
    from app.session.store import list_sessions

    place, here = _folder(folder), visitor()
    every = list_sessions(place)
    summaries = [one for one in every if here.may_see(one.student)]
    hidden = len(every) - len(summaries)
    facts = {
        "folder": str(place),
        "sessions": [s.document() for s in summaries],
        "hidden": hidden,
    }
    note = counted(
        "{n} attempt of a student is for the instructor: {variable} holds the password",
        "{n} attempts of students are for the instructor: {variable} holds the password",
        hidden,
        variable=PASSWORD,
    )
    if not summaries:
        none = sentence("no sessions in {folder}", folder=place)
        return Answer(facts, [note if hidden else none])
    return Answer(facts, lambda: print_table(summaries, note if hidden else ""))


def show(
    session_id: Record,
    folder: RecordsFolder = None,
) -> Answer:
    """Show one attempt: score, events, what its record holds."""
    from app.session.recording import read_recording
    from app.session.store import computed, find, located

    place, name = located(session_id, folder)
    recording = read_recording(find(place, name))
    (summary,) = computed(place, [name])
    see([summary])
    document = details(recording, summary.document())
    return Answer(document, detail_lines(document, nobodys(summary.conditions)))


def replay(
    session_id: Record,
    check: Annotated[
        bool,
        typer.Option(
            "--check", help="Recompute every tick, and the score; exit code 3 if one differs."
        ),
    ] = False,
    folder: RecordsFolder = None,
) -> Answer:
    """Say what a record holds of the robot's loop. --check computes it anew and compares."""
    from app.session.recording import read_recording
    from app.session.replay import contents
    from app.session.store import find, located
    from app.session.summary import derive

    recording = read_recording(find(*located(session_id, folder)))
    see([derive(recording)])
    if not check:
        content = contents(recording)
        return Answer(content.document(), list(content.sentences()))
    from app.compose.recomputed import replay_recording  # loads kernels
    from app.session.verify import verify as verified

    report, found = replay_recording(recording), verified(recording)
    return Answer(
        report.document() | {"score": found.document()},
        [
            *report.sentences(),
            *(sentence("score: {verdict}", verdict=line) for line in found.sentences()),
        ],
        yes=report.identical and (found.confirmed or not found.same_rules),
    )


def verify(
    session_id: Record,
    folder: RecordsFolder = None,
) -> Answer:
    """Compute the score anew and say what differs, and what is signed.

    Looks at the score in the record, the files beside it and its row of the index. Ends with code 3
    if one of them differs or the record was altered after it was signed. *verified* means: written
    by this station, not that the owner of its disk could not forge it.
    """
    from app.session.admission import admissions, with_admission
    from app.session.index import Index
    from app.session.recording import open_recording
    from app.session.sidecar import cached, file_digest, sidecar, verify_record
    from app.session.signature import Signed, judge_whole
    from app.session.station import this_station
    from app.session.store import find, located
    from app.session.summary import derive

    path = find(*located(session_id, folder))
    see([derive(open_recording(path))])  # nothing beside the record is written anew
    found, signed = verify_record(path), judge_whole(path, this_station())
    index, admitted = Index(path.parent).problems_of(path), admissions().get(path.stem)
    verdict = with_admission(signed.word, file_digest(path), admitted)
    facts: dict[str, Any] = {
        "signature": verdict,
        "signature_reason": signed.why,
        "admitted": admitted.why if admitted is not None and verdict == Signed.ADMITTED else "",
        "index": index,
    }
    lines = [*found.sentences(), sentence("signature: {verdict}", verdict=signed.sentence())]
    if facts["admitted"]:
        lines.append(sentence("admitted by the instructor: {reason}", reason=facts["admitted"]))
    if (kept := cached(path)) is not None and not kept.intact:
        lines.append(
            sentence(
                "{file} is not sealed by this station: lists read the record",
                file=sidecar(path).name,
            )
        )
    lines += [sentence("the index was altered: {problem}", problem=each) for each in index]
    return Answer(
        found.document() | facts,
        lines,
        yes=found.confirmed and signed.verdict is not Signed.ALTERED and not index,
    )


def compare(
    first: Id,
    second: Annotated[
        str, typer.Argument(metavar="ID", help="Another one.", autocompletion=completion.sessions)
    ],
    folder: RecordsFolder = None,
) -> Answer:
    """Say whether two scores may be compared. Code 3 with the reasons if not."""
    from app.scoring.conditions import Conditions, comparable
    from app.session.store import computed

    pair = computed(_folder(folder), [first, second])
    see(pair)
    a, b = (s.conditions or Conditions(s.exercise_id) for s in pair)
    reasons = comparable(a, b)
    facts = {
        "comparable": not reasons,
        "reasons": list(reasons),
        "sessions": [summary.document() for summary in pair],
    }
    lines = [joined("  ", (each.id, total_words(each.score, each.signature))) for each in pair]
    apart = [sentence("not comparable: {reason}", reason=reason) for reason in reasons]
    lines += apart or [sentence("comparable")]
    return Answer(facts, lines, yes=not reasons)


def delete(session_id: Id, folder: RecordsFolder = None) -> Answer:
    """Delete an attempt (instructor); restore it within 30 days."""
    from app.session import store

    instructor()
    path = store.delete(_folder(folder), session_id)
    shown = template("{id} deleted: `acus session restore {id}` brings it back")
    return Answer({"id": path.stem, "file": path}, shown=shown)


def restore(
    session_id: Annotated[str, typer.Argument(metavar="ID", help="Id of a deleted attempt.")],
    folder: RecordsFolder = None,
) -> Answer:
    """Bring a deleted attempt back (instructor)."""
    from app.session import store

    instructor()
    path = store.restore(_folder(folder), session_id)
    return Answer({"id": path.stem, "file": path}, shown=template("{id} is back"))


def recover(
    session_id: Annotated[
        str,
        typer.Argument(
            metavar="[ID]", help="Its id; none lists them.", autocompletion=completion.sessions
        ),
    ] = "",
    folder: RecordsFolder = None,
) -> Answer:
    """List attempts that were cut off, or close one as it stands.

    It is listed as unfinished then and never scored as finished. One that a running program
    writes is none of them.
    """
    from app.commands.doors import visitor
    from app.session import interrupted
    from app.session.store import find

    place = _folder(folder)
    if session_id:
        cut = interrupted.is_cut_off(find(place, session_id))
        path = interrupted.recover(place, session_id)
        facts = {"id": path.stem, "file": path, "interrupted": []}
        closed = template("{id} was closed as it stands: listed as unfinished")
        whole = template("{id} has its end: there was nothing to recover, and nothing was changed")
        return Answer(facts, shown=closed if cut else whole)
    here = visitor()
    found = [
        one if here.may_see(one.student) else replace(one, student="a student")
        for one in interrupted.interrupted(place)[0]
    ]
    lines = [
        sentence(
            "{id}  {student}  {exercise}  {duration:.0f} s: `acus session recover {id}` keeps it",
            id=one.id,
            student=one.student,
            exercise=one.exercise_id,
            duration=one.duration,
        )
        for one in found
    ]
    facts = {"id": "", "file": None, "interrupted": [one.document() for one in found]}
    return Answer(facts, lines or [sentence("no attempt was cut off in {folder}", folder=place)])


def gather() -> Answer:
    """Bring attempts here that lie in the source tree.

    Editable installs of earlier versions kept them there. Only what this station signed comes, and
    is then no more in the tree: a folder that several people used may hold attempts of others.
    """
    from app.core import paths
    from app.session.elsewhere import elsewhere
    from app.session.elsewhere import gather as bring
    from app.session.people import People

    folder = paths.sessions()
    found = elsewhere(folder)
    if found is None:
        facts = {"folder": folder, "from": None, "gathered": 0, "left": 0}
        return Answer(facts, shown=template("nothing to do"))
    count = bring(found, folder, People())
    left = len(found.records) - count
    facts = {"folder": folder, "from": found.folder, "gathered": count, "left": left}
    stay = template(
        "{left:#1 stays|# stay} there, not signed by this station: "
        "`acus session list --folder {from}` lists them"
    )
    brought = template("{gathered:#1 attempt|# attempts} brought from {from} to {folder}")
    return Answer(facts, shown=(brought, stay if left else ""))


def _folder(folder: Path | None) -> Path:
    from app.session.store import records_folder

    return records_folder(folder)
