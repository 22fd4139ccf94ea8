"""Every kind of foreign file that is read: how it is laid out, read, and what is right of it.

A kind's `read` raises an AcusError, or says what is wrong with what it got; nothing is wrong if it
says nothing.
"""

import gc
import io
import shutil
import tempfile
import warnings
import zipfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import nibabel
import numpy as np
import pydicom
from pydicom.fileset import FileSet

from app.imaging.errors import SeriesRefusedError
from app.imaging.library import CtLibrary
from app.imaging.pacs.incoming import ACCEPTED, Incoming
from app.imaging.pacs.settings import PacsSettings
from app.imaging.reading import choose, load_ct, read_series
from app.imaging.scanning import scan_folder
from app.imaging.structures.files import read_structures, write_structures
from app.imaging.structures.structure import Structure, StructureSet
from app.imaging.structures.structure import StructureKind as Meaning
from app.imaging.volume import Volume
from tests.fuzz.archives import BINARY, archives
from tests.fuzz.documents import documents
from tests.fuzz.seeds import MIDDLE, OFFSETS, SHAPE, Seed, seeds
from tests.imaging.dicom_factory import SERIES, Slices
from tests.imaging.test_imaging_enhanced import write_enhanced
from tests.imaging.test_imaging_structure_files import rtstruct, square


@dataclass(frozen=True)
class Kind:
    """One kind of file.

    Attributes:
        name: for the report.
        content: what mutations start from.
        lay: writes a spoilt one, and what belongs to it, into an empty folder.
        read: reads it from there.
        text: whether it is made of lines of text.
    """

    name: str
    content: bytes
    lay: Callable[[Path, bytes], None]
    read: Callable[[Path], str]
    text: bool = False


def kinds(folder: Path) -> Iterator[Kind]:
    """Make every kind; `folder` is for what has to be written on the way, and stays."""
    known = list(seeds(folder))
    yield from (_series(seed) for seed in known)
    plain = known[0]
    yield _enhanced(folder)
    yield _zip(plain)
    yield _directory(folder, plain)
    yield from _nifti(folder)
    yield from _structures(folder)
    yield _import(folder)
    yield _pacs(folder, plain)
    for name, content, lay, read in documents(folder):
        yield Kind(name, content, lay, read, text=name != "record")
    for name, content, lay, read in archives(folder):
        yield Kind(name, content, lay, read, text=name not in BINARY)


# --- series of three files, the middle one spoilt


def _series(seed: Seed) -> Kind:
    def lay(folder: Path, data: bytes) -> None:
        for k, content in enumerate(seed.files):
            (folder / f"s{k}").write_bytes(data if k == MIDDLE else content)

    def read(folder: Path) -> str:
        return wrong(load_ct(folder), seed)

    return Kind(seed.name, seed.files[MIDDLE], lay, read)


def wrong(volume: Volume, seed: Seed) -> str:
    """Say what is wrong with a volume: whole files keep their values and their places in it."""
    if not_sane := insane(volume):
        return not_sane
    if volume.size[:2] != seed.hu.shape[:0:-1]:
        return f"size {volume.size}"
    for k in (0, len(OFFSETS) - 1):
        ends = {0: 0, len(OFFSETS) - 1: volume.size[2] - 1}
        if not np.array_equal(volume.hu[ends[k]], seed.hu[k]):
            return f"slice {k} has other values"
        place = volume.lps_mm((0, 0, ends[k]))
        if abs(place[2] - (-100.0 + OFFSETS[k])) > 0.01:
            return f"slice {k} lies at {place}"
    return ""


def insane(volume: Volume) -> str:
    """Say what no volume may be."""
    if not (np.isfinite(volume.affine_mm).all() and np.isfinite(volume.hu).all()):
        return "not finite"
    return "" if min(volume.size) > 0 else f"size {volume.size}"


# --- one file of everything


def _enhanced(folder: Path) -> Kind:
    path = write_enhanced(folder / "enhanced.dcm", Slices(offsets=OFFSETS, shape=SHAPE))
    return Kind("enhanced", path.read_bytes(), _alone("e.dcm"), lambda at: insane(load_ct(at)))


def _alone(name: str) -> Callable[[Path, bytes], None]:
    def lay(folder: Path, data: bytes) -> None:
        (folder / name).write_bytes(data)

    return lay


def _zip(seed: Seed) -> Kind:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for k, content in enumerate(seed.files):
            archive.writestr(f"study/s{k}", content)

    def read(folder: Path) -> str:
        try:
            volume = load_ct(folder / "a.zip")
        finally:
            gc.collect()
            left = list(Path(tempfile.gettempdir()).glob("acus-zip-*"))
            if left:
                raise AssertionError(f"{len(left)} folders left behind")
        return insane(volume) or (volume.size[2] == len(seed.hu) and wrong(volume, seed)) or ""

    return Kind("zip", buffer.getvalue(), _alone("a.zip"), read)


def _directory(folder: Path, seed: Seed) -> Kind:
    files, medium = FileSet(), folder / "medium"
    tags = {"StudyDate": "20200101", "StudyTime": "1200", "StudyID": "1"}
    for path in Slices(offsets=OFFSETS, shape=SHAPE, tags=tags).write(folder / "for medium"):
        files.add(pydicom.dcmread(path))
    files.write(medium)
    del files
    with warnings.catch_warnings():  # of the folder it kept its copies in
        warnings.simplefilter("ignore")
        gc.collect()

    def lay(to: Path, data: bytes) -> None:
        shutil.copytree(medium, to, dirs_exist_ok=True)
        (to / "DICOMDIR").write_bytes(data)

    def read(at: Path) -> str:
        listing = scan_folder(at / "DICOMDIR")
        outside = [one for one in listing.series for file in one.files if at not in file.parents]
        if outside:
            return "reads beside the medium"
        volume = read_series(choose(listing))
        return (volume.size[2] == len(seed.hu) and wrong(volume, seed)) or ""

    return Kind("DICOMDIR", (medium / "DICOMDIR").read_bytes(), lay, read)


def _nifti(folder: Path) -> Iterator[Kind]:
    values = (np.arange(16 * 12 * 5, dtype=np.int16) - 1000).reshape(16, 12, 5)
    for name in ("a.nii", "a.nii.gz"):
        nibabel.save(nibabel.Nifti1Image(values, np.diag([-0.8, -0.9, 2.0, 1.0])), folder / name)
        content = (folder / name).read_bytes()
        yield Kind(
            name[2:], content, _alone(name), lambda at, name=name: insane(load_ct(at / name))
        )


# --- structures


def _structures(folder: Path) -> Iterator[Kind]:
    tags = dict.fromkeys(
        ("PatientBirthDate", "PatientSex", "StudyDate", "StudyTime", "AccessionNumber", "StudyID",
         "ReferringPhysicianName"), ""
    )  # fmt: skip
    Slices(offsets=tuple(2.0 * k for k in range(8)), shape=(20, 24),
           tags={**tags, "Manufacturer": "x"}).write(folder / "ct")  # fmt: skip
    volume = load_ct(folder / "ct")
    mask = np.zeros(volume.hu.shape, bool)
    mask[2:5, 3:10, 4:12] = True
    aorta = Structure.of("aorta", mask, volume, Meaning.VESSEL)
    lesion = Structure.of("lesion", np.roll(mask, 3, axis=1), volume, Meaning.TARGET)
    for name in ("x.seg.nrrd", "x.dcm"):
        write_structures(folder / name, StructureSet((aorta, lesion)), volume)
    regions = {"a": [(k, square(3.5, 9.5)) for k in range(2, 6)]}
    rtstruct(folder / "rt.dcm", volume, regions)
    labels = nibabel.Nifti1Image(
        mask.T.astype(np.uint8), np.diag([-1.0, -1.0, 1.0, 1.0]) @ volume.affine_mm
    )
    nibabel.save(labels, folder / "labels.nii")

    def read(at: Path) -> str:
        (path,) = at.iterdir()
        found = read_structures(path, volume)
        return "" if all(one.name and one.mask.any() for one in found) else "an empty structure"

    for title, name in {
        ".seg.nrrd": "x.seg.nrrd", "SEG": "x.dcm", "RTSTRUCT": "rt.dcm", "labels": "labels.nii",
    }.items():  # fmt: skip
        yield Kind(title, (folder / name).read_bytes(), _alone(name), read)


# --- de-identified, and from a PACS


def _import(folder: Path) -> Kind:
    tags = {"PatientName": "DOE^JANE", "PatientID": "4711081"}
    paths = Slices(offsets=OFFSETS, shape=SHAPE, tags=tags).write(folder / "to import")

    def lay(to: Path, data: bytes) -> None:
        (to / "in").mkdir()
        for number, path in enumerate(paths):
            (to / "in" / path.name).write_bytes(data if number == MIDDLE else path.read_bytes())

    def read(at: Path) -> str:
        library = CtLibrary(at / "library")
        try:
            entry = library.import_series(choose(scan_folder(at / "in"))).entry
        except Exception:
            left = list(library.folder.iterdir()) if library.folder.exists() else []
            if left:
                raise AssertionError(f"{len(left)} folders half imported") from None
            raise
        if any(b"DOE^JANE" in path.read_bytes() for path in entry.folder.iterdir()):
            return "a name was kept"
        return insane(load_ct(entry.folder))

    return Kind("import", paths[MIDDLE].read_bytes(), lay, read)


def _pacs(folder: Path, seed: Seed) -> Kind:
    head = pydicom.dcmread(io.BytesIO(seed.files[MIDDLE]))
    kind, instance = str(head.SOPClassUID), str(head.SOPInstanceUID)
    settings = PacsSettings(name="a", title="A", host="127.0.0.1", port=104)

    def read(at: Path) -> str:
        incoming = Incoming(settings, SERIES).open()
        try:
            status = incoming.take(kind, instance, at / "sent")
            if (status == ACCEPTED) != incoming.has(instance) or incoming.count() > 1:
                return "kept what it refused, or the other way round"
            if len(list(incoming.folder.iterdir())) > 1:
                return "left a part behind"
        finally:
            incoming.forget()
        if status != ACCEPTED:
            raise SeriesRefusedError("; ".join(incoming.problems))
        return ""

    return Kind("PACS", seed.files[MIDDLE], _alone("sent"), read)
