"""Bringing stations together from their files: in any order, twice, half of them now.

- Attempts are added and never changed. Where one is here already under the same id with another
  digest the one that is here stays, and the other is named and left out.
- Of remarks the latest by the stations' signed counters holds (`station_results`), whatever any
  clock says.
- Who was erased anywhere is erased here and never comes back; tombstones tell, which name nobody.
  Records go too, unless they were kept as nobody's wherever the person was erased.
- Limits of courses are held over all attempts together; what is beyond is marked (`limits`).
- People and courses are added. Of two with one pseudonym, or one id, the one that is here stays,
  and the other is named and left out; groups are joined.
- Stations: a key is taken from whom is known, or where the instructor says so; revoked stays so.

Each file is checked whole beside its place, then taken in one step (`journal`) or not at all.
"""

from __future__ import annotations

import zipfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from app.core.messages import sentence
from app.core.progress import Progress
from app.session.audit import note
from app.session.backup_file import ArchiveError
from app.session.erasing import finish_erasing
from app.session.people import People
from app.session.school_file import read_manifest, stations_with
from app.session.station import StationKey
from app.session.station_results import (
    sign_and_number,
)
from app.session.stations import (
    stations_of,
)
from app.session.store import settled
from app.session.taking_in import GatheredFile as GatheredFile
from app.session.taking_in import OpenedFile, TakingIn
from app.session.taking_in import told_of as told_of

if TYPE_CHECKING:
    pass


def gather_file(
    source: Path,
    folder: Path,
    trust: bool = False,
    names: bool = False,
    people: People | None = None,
    progress: Progress | None = None,
) -> GatheredFile:
    """Take in a file of another station, all of it or nothing.

    Args:
        source: that `results_file` wrote.
        folder: of the records here.
        trust: let its station in although it is not known here.
        names: take names of students too, where the file has them.
        people: of this station.
        progress: reports, and may cancel.

    Raises:
        ArchiveError: naming the file, if it is none, damaged, forged, of a newer version, or of a
            station that is revoked or not known.
        Cancelled: if that was asked for. After each of these nothing of the file is here.
    """
    with reading(source), zipfile.ZipFile(source) as archive:
        opened = OpenedFile(archive, source, read_manifest(archive, source))
        return gather_opened([opened], folder, trust, names, people, progress)


def gather_opened(
    files: Sequence[OpenedFile],
    folder: Path,
    trust: bool = False,
    names: bool = False,
    people: People | None = None,
    progress: Progress | None = None,
    giving_way: frozenset[str] = frozenset(),
    by: str = "",
) -> GatheredFile:
    """Take in several files as one, all of them or nothing.

    Args:
        files: in whatever order.
        folder: of the records here.
        trust: as in `gather_file`, like the next three.
        names: students' too.
        people: of this station.
        progress: reports, and may cancel.
        giving_way: SHA-256 of courses and exercises that came from elsewhere: where one of these
            is here still, another of its name takes its place.
        by: who does it, for the audit trail; whoever is here without it.

    Raises:
        ArchiveError, OSError, zipfile.BadZipFile: as `gather_file`, for one of them.
        Cancelled: if that was asked for.
    """
    people, progress = people or People(), progress or Progress()
    key, known = StationKey.of(people.folder), stations_of(people)
    for one in files:
        known = stations_with(one.manifest, known, key, one.source, trust)
    settled(folder)
    sign_and_number(folder, people, key, progress.part(0.0, 0.2))
    at = TakingIn(tuple(files), folder, people, key, known, giving_way)
    at.take(names, progress.part(0.2, 1.0))
    finish_erasing(folder, people)
    senders = sorted({one.manifest.sender.station for one in files})
    note("files taken in", senders, people.folder, by)
    return at.done


@contextmanager
def reading(source: Path) -> Iterator[None]:
    """Name a file of another station in whatever goes wrong with it.

    Raises:
        ArchiveError: for an archive that is none, and for what the system refuses.
    """
    try:
        yield
    except (zipfile.BadZipFile, EOFError, NotImplementedError, RuntimeError) as error:
        raise ArchiveError(
            sentence(
                "{source} is cut or no file of Acus: fetch it anew from its station", source=source
            )
        ) from error
    except OSError as error:
        raise ArchiveError(
            sentence(
                "cannot take in {source}: {reason} ({place})",
                source=source,
                reason=error.strerror or error,
                place=error.filename or "",
            )
        ) from error
