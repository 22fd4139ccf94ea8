"""Bringing back what a backup holds, as one step, and telling what of it is not taken.

Everything is unpacked and checked beside its place first; then a journal moves it (`journal`), and
what ends the program in between is finished, or undone, at the next start. No record is
overwritten. Nobody comes back who was erased, here or where the backup was made.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Final
from uuid import uuid4

from app.core import paths
from app.core.files import read_at_most, write_atomically
from app.core.messages import sentence
from app.core.progress import Progress
from app.session.accounts import owner_of
from app.session.audit import note
from app.session.backup_file import ArchiveError, Manifest, Packed, read_manifest, unpack
from app.session.backup_folder import opened_backup
from app.session.erasing import finish_erasing
from app.session.errors import BrokenRecordingError
from app.session.header import TRASH
from app.session.journal import Journal, Step, move, move_database, removal
from app.session.people import NAMES_FILE, PEOPLE, People
from app.session.people_rows import (
    PeopleRows,
    count_words,
    merged,
    read_rows,
    untaken,
    write_rows,
)
from app.session.recording import open_recording
from app.session.sidecar import file_digest
from app.session.signature import signature_file
from app.session.station import StationKey, key_file, this_station
from app.session.store import SUFFIX, settled

_LARGEST_NAMES: Final = 1 << 24
"""No list of names is larger [bytes]."""


@dataclass(frozen=True, slots=True)
class Restored:
    """What a backup brought.

    Attributes:
        records: attempts that were missing here.
        kept: that were here already, unchanged.
        different: ids of attempts that are another file here: the one here was kept.
        erased: attempts left out because their person was erased.
        people: `restored`, `kept` (there are people here already) or `none` in the backup.
        key: `restored`, `same`, `not asked` (no recovery key was given) or `none` in the backup.
        cts: folders of CTs that it brought.
        not_taken: what else the backup holds, or what was here, that is not here now: a line each.
    """

    records: int = 0
    kept: int = 0
    different: tuple[str, ...] = ()
    erased: int = 0
    people: str = "none"
    key: str = "none"
    cts: tuple[str, ...] = ()
    not_taken: tuple[str, ...] = ()


@dataclass
class _Restoring:
    """One backup on its way.

    Attributes:
        archive: the file, open.
        source: its path, for messages.
        manifest: what it says of itself.
        folder: of the records here.
        people: of this station.
        stages: folders in which things are prepared, by the folder that they are for.
        steps: that put all of it into its place.
        done: what was found so far.
    """

    archive: Packed
    source: Path
    manifest: Manifest
    folder: Path
    people: People
    stages: dict[Path, Path]
    steps: list[Step] = field(default_factory=list)
    done: Restored = field(default_factory=Restored)

    def stage(self, name: str, place: Path) -> Path:
        """Unpack a file into the stage of a place; return where it lies."""
        target = self.stages[place] / name
        unpack(self.archive, name, self.manifest.files[name], target, self.source)
        return target

    def say(self, *lines: str) -> None:
        """Tell what is not taken."""
        self.done = replace(self.done, not_taken=(*self.done.not_taken, *filter(None, lines)))


def restore_backup(
    source: Path,
    folder: Path,
    recovery: str = "",
    replace_people: bool = False,
    people: People | None = None,
    progress: Progress | None = None,
    passphrase: str = "",
) -> Restored:
    """Bring back what a backup holds and is missing here, all of it or nothing.

    Args:
        source: the backup: a file, or a folder of backups, of which the newest is taken.
        folder: of the records.
        recovery: the printed key; brings back the station's key too, so that its records are
            verified here. Empty leaves the key here alone.
        replace_people: take people, names and courses of the backup although there are some here.
        people: of this station.
        progress: reports, and may cancel.
        passphrase: of an encrypted backup.

    Raises:
        ArchiveError: if it is no backup, damaged, of a newer version, encrypted otherwise, or
            cannot be unpacked.
        SignatureError: for a wrong recovery key.
        Cancelled: if that was asked for. After each of these nothing has changed.
    """
    people, progress = people or People(), progress or Progress()
    settled(folder)
    try:
        with opened_backup(source, passphrase) as archive:
            manifest = read_manifest(archive, source)
            asked = recovery and manifest.key
            key = StationKey.unwrapped(manifest.key, recovery) if asked else None
            with _staged(folder, people) as (journal, stages):
                at = _Restoring(archive, source, manifest, folder, people, stages)
                _restore(at, key, replace_people, progress)
                journal.plan([*at.steps, *map(removal, stages.values())])
    except OSError as error:
        why = error.strerror or error
        raise ArchiveError(
            sentence(
                "cannot restore {source}: {reason} ({error_filename})",
                source=source,
                reason=why,
                error_filename=error.filename or "",
            )
        ) from error
    finish_erasing(folder, people)
    note("backup restored", [manifest.station], people.folder)
    return at.done


@contextmanager
def _staged(folder: Path, people: People) -> Iterator[tuple[Journal, dict[Path, Path]]]:
    """Make folders to prepare things in; they go at the end, whatever ends it."""
    places = (folder, people.folder, paths.data())
    for place in places:
        place.mkdir(parents=True, exist_ok=True, mode=0o700)
    stages = {place: place / f".restoring.{uuid4().hex}" for place in places}
    clear = [removal(stage) for stage in stages.values()]
    with Journal(people.folder, clear, alone=True) as journal:
        yield journal, stages


def _restore(
    at: _Restoring, key: StationKey | None, replace_people: bool, progress: Progress
) -> None:
    """Prepare everything, and list what puts it into its place."""
    erased, there = at.people.erased(), None
    if f"people/{PEOPLE}" in at.manifest.files:
        there = read_rows(at.stage(f"people/{PEOPLE}", at.people.folder), str(at.source))
    gone = at.people.erased_attempts() | (there.ids("erased_attempts") if there else frozenset())
    for number, name in enumerate(at.manifest.files):
        progress.report(number / len(at.manifest.files), name.rpartition("/")[2])
        if name.startswith("records/") and name.endswith(SUFFIX):
            _record(at, name, gone, frozenset(erased))
        elif name.startswith(("exercises/", "structures/", "research/", "cts/")):
            _own_file(at, name)
    if there is not None:
        _people(at, there, replace_people)
    _key(at, key)


def _record(at: _Restoring, name: str, gone: frozenset[str], erased: frozenset[str]) -> None:
    """Prepare a record with its signature, unless it is here, or its person was erased."""
    target = at.folder / name.removeprefix("records/")
    if target.stem in gone:
        at.done = replace(at.done, erased=at.done.erased + 1)
        return
    places = (at.folder / target.name, at.folder / TRASH / target.name)
    here = next((path for path in places if path.exists()), None)
    signature = f"{name.removesuffix(SUFFIX)}.sig"
    signed = signature in at.manifest.files
    if here is not None and file_digest(here) != at.manifest.files[name]:
        at.done = replace(at.done, different=(*at.done.different, target.stem))
        return
    if here is not None:
        at.done = replace(at.done, kept=at.done.kept + 1)
        if signed and not signature_file(here).exists():
            at.steps.append(move(at.stage(signature, at.folder), signature_file(here)))
        return
    record = at.stage(name, at.folder)
    if erased and _student(record) in erased:
        at.done = replace(at.done, erased=at.done.erased + 1)
        return
    if signed:  # first: a record is never without it
        at.steps.append(move(at.stage(signature, at.folder), signature_file(target)))
    at.steps.append(move(record, target))
    at.done = replace(at.done, records=at.done.records + 1)


def _student(record: Path) -> str:
    try:
        return open_recording(record).metadata.get("session", {}).get("student", "")
    except BrokenRecordingError:
        return ""


def _own_file(at: _Restoring, name: str) -> None:
    """Prepare an exercise, its structures, a profile, a study; one that is here is kept."""
    target = paths.data() / name
    if not target.exists():
        at.steps.append(move(at.stage(name, paths.data()), target))
        if name.startswith("cts/") and str(target.parent) not in at.done.cts:
            at.done = replace(at.done, cts=(*at.done.cts, str(target.parent)))
    elif file_digest(target) != at.manifest.files[name]:
        at.say(f"{name} is another file here: the one here was kept")


def _people(at: _Restoring, there: PeopleRows, replace_people: bool) -> None:
    """Prepare people, names and courses, or say what of them is not taken."""
    folder = at.people.folder
    known = (folder / PEOPLE).exists()
    names = _names(at)
    here = _here(at.people) if known else PeopleRows()
    listed = _names_here(folder) if known else {}
    taken = merged(here, there) if replace_people or not known else here
    courses = [name for name in at.manifest.files if name.startswith("people/courses/")]
    if known and not replace_people:
        at.done = replace(at.done, people="kept")
        at.say(*untaken(there, here, sentence("of the backup")))
        keys = here.ids("persons")
        other = sum(listed.get(key) != name for key, name in names.items() if key in keys)
        at.say(count_words(other, "name", sentence("of the backup")) if other else "")
        for name in courses:
            path = folder / name.removeprefix("people/")
            if not path.exists() or file_digest(path) != at.manifest.files[name]:
                at.say(sentence("the course {course} of the backup", course=path.stem))
        return
    at.done = replace(at.done, people="restored")
    at.say(*untaken(here, taken, sentence("that were here")))
    stage = at.stages[folder]
    write_rows(taken, stage / "new" / PEOPLE)
    at.steps.append(move_database(stage / "new" / PEOPLE, folder / PEOPLE))
    keys = taken.ids("persons")
    every = {**listed, **names}
    left = {entry: name for entry, name in every.items() if owner_of(entry) in keys}
    write_atomically(stage / "new" / NAMES_FILE, json.dumps(left, indent=1, ensure_ascii=False))
    at.steps.append(move(stage / "new" / NAMES_FILE, folder / NAMES_FILE))
    for name in courses:
        at.steps.append(move(at.stage(name, folder), folder / name.removeprefix("people/")))


def _here(people: People) -> PeopleRows:
    """Read the people who are here; none where their file is damaged: a backup mends that."""
    try:
        return read_rows(people.folder / PEOPLE, "this station")
    except ArchiveError:
        return PeopleRows()


def _names(at: _Restoring) -> dict[str, str]:
    """Read the names of the backup."""
    name = f"people/{NAMES_FILE}"
    if name not in at.manifest.files:
        return {}
    try:
        document = json.loads(read_at_most(at.stage(name, at.people.folder), _LARGEST_NAMES))
        return {str(key): str(text) for key, text in document.items()}
    except (OSError, ValueError, AttributeError, RecursionError) as error:
        raise ArchiveError(
            sentence(
                "the names in {at_source} are damaged; nothing was changed", at_source=at.source
            )
        ) from error


def _names_here(folder: Path) -> dict[str, str]:
    try:
        document = json.loads((folder / NAMES_FILE).read_text(encoding="utf-8"))
        return {str(key): str(text) for key, text in document.items()}
    except (OSError, ValueError, AttributeError, RecursionError):
        return {}


def _key(at: _Restoring, key: StationKey | None) -> None:
    """Prepare the backup's key as this station's; the one that was here is set aside."""
    here, path = this_station(), key_file(at.people.folder)
    wrapped = bool(at.manifest.key)
    if key is None:
        at.done = replace(at.done, key="not asked" if wrapped else "none")
        mine = here.station if here is not None else ""
        if at.manifest.station and at.manifest.station != mine and at.done.records:
            at.say(
                sentence(
                    "the signatures of {attempts}: another station ({station}) made them, and they "
                    "count nowhere here until the instructor admits each (`acus people remark ID "
                    "--admit REASON`)",
                    attempts=count_words(at.done.records, "attempt", sentence("restored")),
                    station=at.manifest.station[:16],
                )
            )
        return
    if here == key:
        at.done = replace(at.done, key="same")
        return
    stage = at.stages[at.people.folder]
    if here is not None:
        here.keep(stage / "before")
        aside = path.with_name(f"station-{here.station}.key")
        at.steps.append(move(key_file(stage / "before"), aside))
    key.keep(stage / "key")
    at.steps.append(move(key_file(stage / "key"), path))
    at.done = replace(at.done, key="restored")
