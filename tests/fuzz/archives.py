"""Archives of this program's own: exercises, backups, records, spoilt outside and inside.

A spoilt byte of an archive is found by its checksums; so members are spoilt as well, and packed
again with the sums that fit, as somebody would who means it.
"""

import hashlib
import json
import os
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from mcap.reader import make_reader
from mcap.writer import Writer

from app.core.errors import AcusError
from app.core.progress import Progress
from app.exchange.acusx import pack, read_manifest, unpack
from app.exercises.library import load_exercise
from app.planning.patient import load_phantom
from app.session.archive import backup, restore_backup
from app.session.board import board_of
from app.session.people import People
from app.session.recording import read_recording
from app.session.roster import RosterLine
from app.session.sidecar import fresh_summary, verify_record
from tests.session.session_fakes import Bench

Made = tuple[str, bytes, Callable[[Path, bytes], None], Callable[[Path], str]]
BINARY = ("acusx", "backup", "people of a backup", "block of a record")
"""Kinds that are not made of lines of text."""
_HOME = ("ACUS_DATA", "ACUS_SESSIONS")
_BLOCKS = "/loop/inputs"


def archives(folder: Path) -> Iterator[Made]:
    """Make every kind; `folder` is for what has to be written on the way."""
    yield from _exercises(folder / "acusx")
    yield from _backups(folder / "backup")


@contextmanager
def home(folder: Path) -> Iterator[Path]:
    """Let the program keep everything in a folder of its own meanwhile."""
    before = {name: os.environ.get(name) for name in _HOME}
    os.environ.update({name: str(folder / name) for name in _HOME})
    try:
        yield folder
    finally:
        for name, value in before.items():
            os.environ.pop(name) if value is None else os.environ.update({name: value})


def packed_again(path: Path, name: str, data: bytes) -> bytes:
    """Return an archive with one member in the place of its own, its list corrected."""
    with zipfile.ZipFile(path) as archive:
        members = {one: archive.read(one) for one in archive.namelist()}
    members[name] = data
    if name != "manifest.json":
        manifest = json.loads(members["manifest.json"])
        manifest["files"][name] = hashlib.sha256(data).hexdigest()
        members["manifest.json"] = json.dumps(manifest).encode()
    out = path.with_suffix(".again")
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for one, content in members.items():
            archive.writestr(one, content)
    return out.read_bytes()


def _inside(path: Path, file: str, name: str) -> Callable[[Path, bytes], None]:
    def lay(folder: Path, data: bytes) -> None:
        (folder / file).write_bytes(packed_again(path, name, data))

    return lay


def _outside(file: str) -> Callable[[Path, bytes], None]:
    def lay(folder: Path, data: bytes) -> None:
        (folder / file).write_bytes(data)

    return lay


def _exercises(folder: Path) -> Iterator[Made]:
    exercise = load_exercise("first-insertion")
    folder.mkdir(parents=True)
    path = folder / "a.acusx"
    seed = exercise.ct.phantom.seed if exercise.ct.phantom else 1
    pack(path, exercise, load_phantom(seed, Progress()).volume)

    def read(at: Path) -> str:
        with home(at):
            manifest = read_manifest(at / "a.acusx")
            try:
                found = unpack(at / "a.acusx")
            except AcusError:
                left = [one for one in (at / _HOME[0]).rglob("*") if one.is_file()]
                if left:
                    raise AssertionError(f"{left[0].name} was half taken in") from None
                raise
            return "" if found.exercise.id and manifest.id else "an exercise without a name"

    yield "acusx", path.read_bytes(), _outside("a.acusx"), read
    with zipfile.ZipFile(path) as archive:
        for title, name in {
            "list of an acusx": "manifest.json",
            "exercise of an acusx": "exercise.yaml",
        }.items():
            yield title, archive.read(name), _inside(path, "a.acusx", name), read


def _backups(folder: Path) -> Iterator[Made]:
    path = folder / "a.acusbackup"
    with home(folder):
        people, sessions = People(), folder / _HOME[1]
        ada, _ = people.add(RosterLine("Ada", "Lovelace", "1843", ("A",)))
        bench = Bench(sessions)
        bench.run(0.05)
        bench.trainer.begin(ada.key)
        bench.insertion(0.06, x=0.05)
        record = bench.trainer.end().record
        assert record is not None
        people.remark(record.stem, comment="well done")
        backup(path, sessions)
        people.database.close()

    def read(at: Path) -> str:
        with home(at):
            restore_backup(at / "a.acusbackup", at / _HOME[1], replace_people=True)
            people = People()
            try:
                people.everybody(names=True)
                people.remarks()
                people.has_instructor()
                board_of(at / _HOME[1], people)
            finally:
                people.database.close()
            return ""

    yield "backup", path.read_bytes(), _outside("a.acusbackup"), read
    with zipfile.ZipFile(path) as archive:
        for title, name in {
            "list of a backup": "manifest.json",
            "people of a backup": "people/people.sqlite",
            "names of a backup": "people/names.json",
        }.items():
            yield title, archive.read(name), _inside(path, "a.acusbackup", name), read
    yield from _records(record)


# --- records: MCAP, chunk by chunk with checksums of its own


def _records(record: Path) -> Iterator[Made]:
    def read(at: Path) -> str:
        path = at / record.name
        found, summary = read_recording(path), fresh_summary(path)
        verify_record(path)
        found.trajectory()
        return "" if summary.id else "no id"

    for title, topic in {"block of a record": _BLOCKS, "event of a record": "/events"}.items():
        yield title, _message(record, topic), _with_message(record, topic), read
    yield (
        "metadata of a record",
        json.dumps(_metadata(record)).encode(),
        _with_metadata(record),
        read,
    )


def _message(record: Path, topic: str) -> bytes:
    with record.open("rb") as stream:
        *_, (_, _, last) = make_reader(stream).iter_messages([topic])
        return bytes(last.data)


def _metadata(record: Path) -> dict[str, dict[str, str]]:
    with record.open("rb") as stream:
        return {one.name: dict(one.metadata) for one in make_reader(stream).iter_metadata()}


def _with_message(record: Path, topic: str) -> Callable[[Path, bytes], None]:
    whole = _message(record, topic)

    def lay(folder: Path, data: bytes) -> None:
        _copied(record, folder, lambda of, kept: data if (of, kept) == (topic, whole) else kept)

    return lay


def _with_metadata(record: Path) -> Callable[[Path, bytes], None]:
    def lay(folder: Path, data: bytes) -> None:
        try:
            spoilt = json.loads(data)
            texts = {str(k): {str(a): str(b) for a, b in v.items()} for k, v in spoilt.items()}
        except (ValueError, AttributeError, RecursionError):
            texts = {"session": {"header": data.decode("utf-8", "replace")}}
        _copied(record, folder, lambda _, kept: kept, texts)

    return lay


def _copied(
    record: Path,
    folder: Path,
    spoil: Callable[[str, bytes], bytes],
    metadata: dict[str, dict[str, str]] | None = None,
) -> None:
    """Write a record anew, with what is spoilt in it and checksums that fit."""
    with record.open("rb") as source, (folder / record.name).open("wb") as target:
        reader, writer = make_reader(source), Writer(target)
        header = reader.get_header()
        writer.start(header.profile, header.library)
        schemas: dict[int, int] = {}
        channels: dict[int, int] = {}
        for schema, channel, message in reader.iter_messages():
            if channel.id not in channels:
                if schema is not None and schema.id not in schemas:
                    schemas[schema.id] = writer.register_schema(
                        schema.name, schema.encoding, schema.data
                    )
                known = schemas.get(schema.id, 0) if schema is not None else 0
                channels[channel.id] = writer.register_channel(
                    channel.topic, channel.message_encoding, known, dict(channel.metadata)
                )
            writer.add_message(
                channels[channel.id], message.log_time, spoil(channel.topic, bytes(message.data)),
                message.publish_time, message.sequence,
            )  # fmt: skip
        for name, values in (_metadata(record) if metadata is None else metadata).items():
            writer.add_metadata(name, values)
        for one in reader.iter_attachments():
            writer.add_attachment(one.create_time, one.log_time, one.name, one.media_type, one.data)
        writer.finish()
