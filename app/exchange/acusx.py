"""One file of an exercise, `.acusx`, to carry it to another computer; and taking one in.

A zip: what it is (`manifest.json`), the exercise, its plan for 3D Slicer, its structures on the
CT's grid, profiles of one's own, and on request the CT, de-identified. The CT is known by the
digest of its geometry and voxels. Nothing of such a file is believed: names, sizes and digests are
checked before anything is written, and pictures and structures are read in the worker process.
"""

from __future__ import annotations

import hashlib
import json
import re
import shutil
import stat
import zipfile
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final, Literal
from uuid import uuid4

from pydantic import Field

from app import __version__
from app.core import paths
from app.core.configuration import LARGEST_FILE, Strict, parse, parse_text
from app.core.errors import AcusError
from app.core.files import write_atomically
from app.core.messages import sentence
from app.core.progress import Progress
from app.core.temporary import temporary_folder
from app.exchange.errors import ExchangeError
from app.exchange.markups import plan_document
from app.exercises.library import library, read_exercise, unknown_profile
from app.exercises.parts import PlanPoints
from app.exercises.schema import Exercise
from app.exercises.writing import exercise_text, save, taken_ids
from app.imaging.volume import Volume, VolumeDigest, digest_of

if TYPE_CHECKING:
    from app.imaging.series import Series

SUFFIX: Final = ".acusx"
FORMAT: Final = 1
"""Number of the form of such a file; a reader refuses newer ones."""

_MANIFEST, _EXERCISE, _PLAN = "manifest.json", "exercise.yaml", "plan.mrk.json"
_STRUCTURES, _CT, _PROFILES = "structures/", "ct/", "profiles/"
_NAME: Final = re.compile(
    r"manifest\.json|exercise\.yaml|plan\.mrk\.json|structures/[0-9]{1,3}\.seg\.nrrd"
    r"|profiles/(device|rig)\.yaml|ct/[0-9]{1,6}\.dcm"
)
"""Names that a member may have: none leads out of a folder."""

_MOST_FILES: Final = 20_000
_MOST_BYTES: Final = 8 << 30
_MOST_GROWTH: Final = 60.0
_FREE_GROWTH: Final = 256 << 20
"""Up to so many bytes a file may grow as it likes: masks are packed a thousandfold."""
_CHUNK: Final = 1 << 20
_DAMAGED: Final = (
    *(zipfile.BadZipFile, zlib.error, EOFError, RuntimeError, ValueError),
    OSError,  # of a place before the file's beginning; nothing else is read or written meanwhile
)
"""What `zipfile` raises while it reads a damaged archive; NotImplementedError is a RuntimeError."""


class PackageError(ExchangeError):
    """A file of an exercise that cannot be used or written; says why and what to do."""


class TakenError(PackageError):
    """Another exercise has this id already: a choice is needed."""


class CtMissingError(PackageError):
    """The exercise's CT is neither in the file nor named, or another one than that."""


class CtIdentity(Strict):
    """Which CT: the phantom's seed, or the digest of geometry and voxels of a series.

    Attributes:
        phantom: seed of the procedural patient; None for a CT.
        digest: SHA-256 over all of it (`Volume.digest`).
        values: SHA-256 of the voxels.
        kind: of the voxels, as `VolumeDigest.kind`.
        size: columns, rows, slices.
        affine_mm: voxel -> LPS [mm], row by row.
        remedy: what is asked for in reading it.
    """

    phantom: int | None = None
    digest: Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]
    values: Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]
    kind: Literal["<i2", "<f4"]
    size: tuple[int, int, int]
    affine_mm: Annotated[tuple[float, ...], Field(min_length=16, max_length=16)]
    remedy: str = "none"


class PackageManifest(Strict):
    """What a file of an exercise says about itself.

    Attributes:
        format: says what kind of file it is.
        version: number of its form.
        acus: version of the program that wrote it.
        id: of the exercise.
        title: of the exercise.
        exercise_version: of the exercise.
        ct: which CT it belongs to.
        files: SHA-256 of every other member, by its name.
    """

    format: Literal["acusx"]
    version: int
    acus: str
    id: str
    title: str
    exercise_version: int
    ct: CtIdentity
    files: dict[str, str]


@dataclass(frozen=True, slots=True)
class UnpackedExercise:
    """What was taken in.

    Attributes:
        exercise: as it is kept now.
        known: whether it was there already, the same.
        ct: folder of its CT; None for the phantom.
        structures: files of structures that were written.
    """

    exercise: Exercise
    known: bool
    ct: Path | None
    structures: tuple[Path, ...]


# --- writing ------------------------------------------------------------------------------------
def pack(
    path: Path,
    exercise: Exercise,
    volume: Volume,
    with_ct: bool = False,
    progress: Progress | None = None,
) -> PackageManifest:
    """Write an exercise with all that belongs to it into one file, whole or not at all.

    Args:
        path: to write.
        exercise: to pack.
        volume: its CT, read in the exercise's way.
        with_ct: whether the CT itself goes in, de-identified.
        progress: told how far it is; cancels, leaving nothing.

    Raises:
        PackageError: if it cannot be written; or the CT is another one than the exercise names.
        AcusError: if structures or CT cannot be read, or the CT cannot be de-identified.
    """
    progress = progress or Progress()
    _require_same(volume.digest, exercise.ct.digest, "this CT")
    if with_ct and exercise.ct.folder is None:
        raise PackageError(sentence("the phantom needs no CT in the file: leave it out"))
    folder = temporary_folder("acusx")
    beside = path.with_name(f".{path.name}.{uuid4().hex}")
    try:
        members = _members(folder, exercise, volume, progress.part(0.0, 0.4))
        if with_ct:
            members |= _ct_members(folder, exercise, volume, progress.part(0.4, 0.9))
        manifest = PackageManifest(
            format="acusx",
            version=FORMAT,
            acus=__version__,
            id=exercise.id,
            title=exercise.title,
            exercise_version=exercise.version,
            ct=_identity(exercise, volume),
            files={name: _sha256(file) for name, file in members.items()},
        )
        text = json.dumps(manifest.model_dump(mode="json"), indent=1, ensure_ascii=False)
        path.parent.mkdir(parents=True, exist_ok=True)
        with zipfile.ZipFile(beside, "x", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr(_MANIFEST, text + "\n")
            for number, (name, file) in enumerate(members.items()):
                progress.report(
                    0.9 + 0.1 * number / len(members), sentence("packing {name}", name=name)
                )
                archive.write(file, name)
        beside.replace(path)
    except OSError as error:
        if isinstance(error, ExchangeError):
            raise
        raise PackageError(
            sentence(
                "cannot write {path}: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
    finally:
        beside.unlink(missing_ok=True)
        shutil.rmtree(folder, ignore_errors=True)
    return manifest


def _members(
    folder: Path, exercise: Exercise, volume: Volume, progress: Progress
) -> dict[str, Path]:
    """Write all but the CT into a folder; returns the files by their names in the archive."""
    from app.imaging.structures.files import read_structures, write_structures

    members, parts = {}, []
    for number, part in enumerate(exercise.structures, 1):
        name = f"{_STRUCTURES}{number}.seg.nrrd"
        target = folder / f"{number}.seg.nrrd"
        found = read_structures(part.file, volume, progress)  # what else the file says stays here
        write_structures(target, found, volume)
        members[name] = target
        parts.append(part.model_copy(update={"file": Path(name)}))
    changes: dict[str, Any] = {"structures": tuple(parts)}
    for field in ("device", "rig"):
        own = Path(getattr(exercise, field))
        if own.suffix in (".yaml", ".yml"):
            name = f"{_PROFILES}{field}.yaml"
            members[name] = own
            changes[field] = name
    if exercise.ct.folder is not None:  # a folder may name a patient
        known = {"folder": Path("ct"), "series": None, "digest": volume.digest}
        changes["ct"] = exercise.ct.model_copy(update=known)
    text = exercise_text(exercise.model_copy(update=changes))
    (folder / _EXERCISE).write_text(text, encoding="utf-8")
    members = {_EXERCISE: folder / _EXERCISE, **members}
    if isinstance(exercise.plan, PlanPoints):
        plan = json.dumps(plan_document(exercise.plan.plan()), indent=1, ensure_ascii=False)
        (folder / _PLAN).write_text(plan + "\n", encoding="utf-8")
        members[_PLAN] = folder / _PLAN
    return members


def _ct_members(
    folder: Path, exercise: Exercise, volume: Volume, progress: Progress
) -> dict[str, Path]:
    """De-identify the CT into a folder, and see that it is still the same."""
    from app.imaging.library import CtLibrary
    from app.imaging.reading import read_with

    library, remedy = CtLibrary(folder / "library"), exercise.ct.remedy
    taken = library.import_series(volume.series, (), progress.part(0.0, 0.7), remedy)
    again = read_with(_only(taken.entry.folder), remedy, progress.part(0.7, 1.0))
    _require_same(again.digest, volume.digest, "the de-identified CT")
    files = sorted(taken.entry.folder.glob("*.dcm"))
    return {f"{_CT}{number}.dcm": file for number, file in enumerate(files, 1)}


def _only(folder: Path) -> Any:
    from app.imaging.scanning import scan_folder

    found = scan_folder(folder).series
    if len(found) != 1:
        raise PackageError(
            sentence(
                "{folder} holds {count} series; one is needed", folder=folder, count=len(found)
            )
        )
    return found[0]


def _identity(exercise: Exercise, volume: Volume) -> CtIdentity:
    found: VolumeDigest = digest_of(volume)
    seed = None if exercise.ct.phantom is None else exercise.ct.phantom.seed
    return CtIdentity(
        phantom=seed,
        digest=found.whole,
        values=found.values,
        kind=found.kind,  # type: ignore[arg-type]
        size=found.size,
        affine_mm=found.affine_mm,
        remedy=exercise.ct.remedy,
    )


def _require_same(result: str, wanted: str | None, subject: str) -> None:
    if wanted is not None and result != wanted:
        raise CtMissingError(
            sentence(
                "{subject} is another one than the exercise was made on: its digest is "
                "{digest}…, {wanted_digest}… is needed (acus ct digest tells it)",
                subject=subject,
                digest=result[:12],
                wanted_digest=wanted[:12],
            )
        )


def _sha256(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


# --- reading ------------------------------------------------------------------------------------
def read_manifest(path: Path) -> PackageManifest:
    """Read what a file of an exercise says about itself; nothing is written.

    Raises:
        PackageError: if it is no such file, damaged, of a newer form, or holds what none has.
    """
    with _opened(path) as archive:
        return _manifest(archive, path)


def unpack(
    path: Path,
    ct: Path | None = None,
    series: str | None = None,
    name: str = "",
    replace: bool = False,
    progress: Progress | None = None,
) -> UnpackedExercise:
    """Take an exercise in from its file.

    Args:
        path: the file.
        ct: folder of its CT where the file does not hold it; must be the same by its digest.
        series: SeriesInstanceUID, where that folder holds several; None finds it by the digest.
        name: id to keep it under; empty for its own.
        replace: whether an exercise of that id becomes an earlier version of this one.
        progress: told how far it is; cancels, leaving nothing.

    Raises:
        PackageError: if the file cannot be used.
        CtMissingError: if the CT is needed, or another one.
        TakenError: if another exercise has this id.
        AcusError: if exercise, structures or CT cannot be used.
    """
    progress = progress or Progress()
    folder = temporary_folder("acusx")
    try:
        with _opened(path) as archive:
            manifest = _manifest(archive, path)
            _extract(archive, manifest, folder, path, progress.part(0.0, 0.3))
        text = (folder / _EXERCISE).read_text(encoding="utf-8", errors="strict")
        exercise = parse_text(text, Exercise, f"{path}: {_EXERCISE}")
        if name:
            document = exercise.model_dump(mode="json", by_alias=True) | {"id": name}
            exercise = parse(document, Exercise, f"--as {name}")
        exercise, targets = _placed(folder, exercise)
        there = _same_there(exercise, replace)
        if exercise.ct.phantom is None:
            place, key = _ct_folder(
                folder, exercise, manifest, (ct, series), path, progress.part(0.3, 1.0)
            )
            known = {"folder": place, "series": key}
            exercise = exercise.model_copy(update={"ct": exercise.ct.model_copy(update=known)})
        if there is not None:
            return UnpackedExercise(there, True, there.ct.folder, ())
        for target, source in targets.items():
            write_atomically(target, source.read_bytes())
        written = tuple(target for target in targets if target.suffix == ".nrrd")
        return UnpackedExercise(save(exercise), False, exercise.ct.folder, written)
    except UnicodeDecodeError as error:
        raise PackageError(
            sentence("{path}: {exercise} is no text in UTF-8", path=path, exercise=_EXERCISE)
        ) from error
    except OSError as error:
        if isinstance(error, AcusError):
            raise
        raise PackageError(
            sentence(
                "cannot unpack {path}: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _opened(path: Path) -> zipfile.ZipFile:
    try:
        return zipfile.ZipFile(path)
    except OSError as error:
        raise PackageError(
            sentence(
                "cannot read {path}: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
    except (zipfile.BadZipFile, NotImplementedError, ValueError) as error:
        raise PackageError(
            sentence(
                "{path} is no exercise file ({suffix}), or damaged: have it written again "
                "(acus exercise pack)",
                path=path,
                suffix=SUFFIX,
            )
        ) from error


def _manifest(archive: zipfile.ZipFile, path: Path) -> PackageManifest:
    """Check the list of members, then read what the file says about itself."""
    members = archive.infolist()
    names = [member.filename for member in members]
    if len(names) > _MOST_FILES:
        raise PackageError(
            sentence(
                "{path} holds {files} files; {most_files} are the most",
                path=path,
                files=len(names),
                most_files=_MOST_FILES,
            )
        )
    for member in members:
        if why := _refused(member):
            raise PackageError(
                sentence(
                    "{path} is not used: {member_filename!r} {reason}",
                    path=path,
                    member_filename=member.filename[:80],
                    reason=why,
                )
            )
    twice = {one for one in names if names.count(one) > 1} if len(set(names)) < len(names) else ()
    if twice:
        raise PackageError(
            sentence(
                "{path} is not used: {double_name!r} is in it twice",
                path=path,
                double_name=min(twice),
            )
        )
    if _MANIFEST not in names:
        raise PackageError(
            sentence(
                "{path} is no exercise file: it has no {manifest}", path=path, manifest=_MANIFEST
            )
        )
    try:
        document = json.loads(_bytes(archive, _MANIFEST, path))
    except (ValueError, RecursionError) as error:
        raise PackageError(
            sentence("{path}: {manifest} is not JSON", path=path, manifest=_MANIFEST)
        ) from error
    version = document.get("version") if isinstance(document, dict) else None
    if isinstance(version, int) and version > FORMAT:
        raise PackageError(
            sentence(
                "{path} was written by a newer Acus ({declared}): its form is "
                "{version}, this program reads up to {format}: install the newer one",
                path=path,
                declared=str(document.get("acus"))[:20],
                version=version,
                format=FORMAT,
            )
        )
    manifest = parse(document, PackageManifest, f"{path}: {_MANIFEST}")
    if set(manifest.files) != set(names) - {_MANIFEST} or _EXERCISE not in manifest.files:
        raise PackageError(
            sentence("{path} is not used: its list of files is not what it holds", path=path)
        )
    return manifest


def _refused(member: zipfile.ZipInfo) -> str:
    """Return why a member is not taken; empty if it is."""
    if not _NAME.fullmatch(member.filename):
        return "is no part of an exercise"
    if stat.S_ISLNK(member.external_attr >> 16):
        return "is a link, not a file"
    if member.flag_bits & 1:
        return "is encrypted"
    if member.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        return "is packed in a way that is not read"
    if member.filename.endswith((".json", ".yaml")) and member.file_size > LARGEST_FILE:
        return f"is larger than {LARGEST_FILE >> 20} MB"
    return ""


def _require_room(archive: zipfile.ZipFile, folder: Path, path: Path) -> None:
    whole = sum(member.file_size for member in archive.infolist())
    packed = max(sum(member.compress_size for member in archive.infolist()), 1)
    if whole > _MOST_BYTES or (whole > _FREE_GROWTH and whole / packed > _MOST_GROWTH):
        raise PackageError(
            sentence(
                "{path} is not used: it would grow {growth:.0f} times to {unpacked_gb:.1f} GB",
                path=path,
                growth=whole / packed,
                unpacked_gb=whole / 1e9,
            )
        )
    free = shutil.disk_usage(folder).free
    if whole > free:
        raise PackageError(
            sentence(
                "{path} unpacks to {whole:.1f} GB and {free:.1f} GB are free in the "
                "temporary folder: make room",
                path=path,
                whole=whole / 1e9,
                free=free / 1e9,
            )
        )


def _bytes(archive: zipfile.ZipFile, name: str, path: Path) -> bytes:
    try:
        with archive.open(name) as stream:
            return stream.read(LARGEST_FILE + 1)
    except _DAMAGED as error:
        raise PackageError(
            sentence("{path} is damaged at {name}: have it sent again", path=path, name=name)
        ) from error


def _chunks(archive: zipfile.ZipFile, name: str, path: Path) -> Iterator[bytes]:
    """Read a member piece by piece, no more of it than the size that was checked."""
    try:
        with archive.open(name) as packed:
            while chunk := packed.read(_CHUNK):
                yield chunk
    except _DAMAGED as error:
        raise PackageError(
            sentence("{path} is damaged at {name}: have it sent again", path=path, name=name)
        ) from error


def _extract(
    archive: zipfile.ZipFile,
    manifest: PackageManifest,
    folder: Path,
    path: Path,
    progress: Progress,
) -> None:
    """Write every member below a folder, each as its digest says."""
    _require_room(archive, folder, path)
    for number, (name, wanted) in enumerate(manifest.files.items()):
        progress.report(number / len(manifest.files), sentence("unpacking {name}", name=name))
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        found = hashlib.sha256()
        with target.open("xb") as plain:
            for chunk in _chunks(archive, name, path):
                found.update(chunk)
                plain.write(chunk)
        if found.hexdigest() != wanted:
            raise PackageError(
                sentence("{path}: {name} was altered after it was packed", path=path, name=name)
            )


def _ct_folder(
    folder: Path,
    exercise: Exercise,
    manifest: PackageManifest,
    given: tuple[Path | None, str | None],
    path: Path,
    progress: Progress,
) -> tuple[Path, str | None]:
    """Find the exercise's CT in the folder given, or take it into the library.

    Returns:
        Its folder, and which series of several it is; None for the only one.
    """
    from app.imaging.errors import SeriesAmbiguousError
    from app.imaging.library import CtLibrary, discard
    from app.imaging.reading import choose, read_with
    from app.imaging.scanning import scan_folder

    remedy, wanted = exercise.ct.remedy, manifest.ct.digest
    if exercise.ct.digest != wanted:
        raise PackageError(
            sentence(
                "{path} is not used: exercise and {manifest} name different CTs",
                path=path,
                manifest=_MANIFEST,
            )
        )
    packed = folder / _CT
    if not packed.is_dir():
        ct, uid = given
        if ct is None:
            raise CtMissingError(
                sentence(
                    "{path} does not hold its CT: name the folder of the one with the digest "
                    "{wanted}… (--ct DIR; acus ct digest tells it)",
                    path=path,
                    wanted=wanted[:12],
                )
            )
        listing = scan_folder(ct, progress.part(0.0, 0.2))
        asked: tuple[Series, ...]
        try:
            asked = (choose(listing, uid, remedy),)
        except SeriesAmbiguousError as error:  # the digest says which of them it is
            asked = error.series
        for k, series in enumerate(asked):
            part = progress.part(0.2 + 0.8 * k / len(asked), 0.2 + 0.8 * (k + 1) / len(asked))
            digest = read_with(series, remedy, part).digest
            if digest == wanted:
                return ct.resolve(), series.key if len(asked) > 1 else uid
        if len(asked) > 1:
            raise CtMissingError(
                sentence(
                    "none of the {series} CT series in {ct} is that of {path}: one with the "
                    "digest {wanted}… is needed; name the folder that holds it",
                    series=len(asked),
                    ct=ct,
                    path=path,
                    wanted=wanted[:12],
                )
            )
        _require_same(digest, wanted, f"the CT in {ct}")
    volume = read_with(_only(packed), remedy, progress.part(0.0, 0.4))
    _require_same(volume.digest, wanted, f"the CT in {path}")
    library = CtLibrary()
    taken = library.import_series(_only(packed), (), progress.part(0.4, 0.9), remedy)
    again = read_with(_only(taken.entry.folder), remedy, progress.part(0.9, 1.0))
    if again.digest != wanted:
        if not taken.again:
            discard(taken.entry.folder)
        raise CtMissingError(
            sentence(
                "the library holds another CT under the name of this one, {taken_entry_name}: "
                "its digest is {again_digest}…, {wanted}… is needed; remove it first (acus "
                "library remove {taken_entry_name})",
                taken_entry_name=taken.entry.name,
                again_digest=again.digest[:12],
                wanted=wanted[:12],
            )
        )
    return taken.entry.folder, None


def _placed(folder: Path, exercise: Exercise) -> tuple[Exercise, dict[Path, Path]]:
    """Return the exercise with structures and profiles in the user's folders, and what to copy."""
    targets, parts = {}, []
    for part in exercise.structures:
        source = _inside(folder, part.file.as_posix())
        place = paths.data() / "structures" / exercise.id / f"{_sha256(source)[:8]}.seg.nrrd"
        targets[place] = source
        parts.append(part.model_copy(update={"file": place}))
    changes: dict[str, Any] = {"structures": tuple(parts)}
    for field in ("device", "rig"):
        named = getattr(exercise, field)
        if why := unknown_profile(field, named):
            raise PackageError(
                sentence(
                    "the exercise cannot be used here: {field}: {reason}", field=field, reason=why
                )
            )
        if Path(named).suffix in (".yaml", ".yml"):
            source = _inside(folder, named)
            place = paths.data() / "exercises" / "profiles" / f"{exercise.id}-{field}.yaml"
            targets[place] = source
            changes[field] = str(place)
    return exercise.model_copy(update=changes), targets


def _same_there(exercise: Exercise, replace: bool) -> Exercise | None:
    """Return the exercise where it is there already; None where it is not.

    Raises:
        TakenError: if another one has its id, and shall not be replaced.
    """
    there = library().files.get(exercise.id)
    if there is None:
        if exercise.id in taken_ids() and not replace:
            raise TakenError(
                sentence(
                    "the id {exercise_id!r} is taken by a file that cannot be used, or by "
                    "earlier versions: keep this exercise under another name (--as NAME)",
                    exercise_id=exercise.id,
                )
            )
        return None
    known = read_exercise(there)
    place = {"folder": known.ct.folder, "series": known.ct.series}
    ct = exercise.ct if exercise.ct.phantom else exercise.ct.model_copy(update=place)
    if exercise.model_copy(update={"version": known.version, "ct": ct}) == known:
        return known
    if not replace:
        raise TakenError(
            sentence(
                "there is another exercise {exercise_id!r}: keep this one under another name "
                "(--as NAME), or as a new version of it (--replace)",
                exercise_id=exercise.id,
            )
        )
    return None


def _inside(folder: Path, name: str) -> Path:
    """Return a file that was unpacked, by its name in the exercise."""
    if not _NAME.fullmatch(name) or not (folder / name).is_file():
        raise PackageError(
            sentence("the exercise names {name!r}, which the file does not hold", name=name[:80])
        )
    return folder / name
