"""The worker process: what crashes, hangs or fills the memory there is named, and nothing else."""

import json
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any

import nibabel
import numpy as np
import pydicom
import pytest
from numpy.typing import NDArray

from app.core.progress import Cancelled, Progress
from app.imaging.errors import FileDamagedError, WorkerError, WorkerLostError
from app.imaging.filling import filled
from app.imaging.header import ImagePlane, SliceHeader
from app.imaging.header_reading import file_headers
from app.imaging.series import Ignored
from app.imaging.structures.structure import StructureKind
from app.imaging.worker import limits, service
from app.imaging.worker.answers import lost as lost_error
from app.imaging.worker.attachments import Attachments, AttachmentsError, opened
from app.imaging.worker.lent_memory import LentMemory
from app.imaging.worker.pool import ImagingWorker
from app.imaging.worker.service import read_headers
from app.imaging.worker.values import ATTACHED, ForeignValueError, plain, reader
from tests.imaging.dicom_factory import Slices

HOSTILE = "tests.imaging.hostile_child"


@pytest.fixture
def hostile():
    worker = ImagingWorker(1, HOSTILE)
    yield worker
    worker.close()


def reasons(worker, *names):
    paths = [Path("/nowhere", name) for name in names]
    return [found.reason for found in read_headers(paths, Progress(), worker)]


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("crash", "was ended by SIGABRT: it gave itself up"),
        ("kill", "was ended by SIGKILL: by the system when memory ran out"),
        ("exit", "ended with code 3"),
        ("nonsense", "talked nonsense"),
        ("huge", "talked nonsense"),
        ("memory", "of memory"),
        ("surprise", "it cannot be read (KeyError in "),
        ("panic", "it cannot be read (PanicException in "),
        ("wrong", "talked nonsense"),
    ],
)
def test_a_file_that_breaks_its_reader_is_named_and_the_others_are_read(hostile, name, words):
    found = reasons(hostile, "a", name, "b", "c")
    assert words in found[1]
    assert [found[0], found[2], found[3]] == ["read a", "read b", "read c"]
    assert "JANE" not in found[1]


@pytest.mark.long("journey")
def test_a_file_that_hangs_its_reader_is_given_up_after_two_seconds(hostile):
    reasons(hostile, "warm")
    begin = time.monotonic()
    found = reasons(hostile, "a", "hang", "b")
    assert "took longer than 1.5 s" in found[1]
    assert found[::2] == ["read a", "read b"]
    assert time.monotonic() - begin < 60.0  # two of computing, and what a busy machine adds


@pytest.mark.long("journey")
def test_a_file_that_never_comes_is_given_up_too(hostile, monkeypatch):
    monkeypatch.setattr(limits, "LEAST_CLOCK_SECONDS", 1.0)
    monkeypatch.setattr(limits, "CLOCK_FACTOR", 0.1)
    assert "waited longer than 1 s" in reasons(hostile, "sleep")[0]


@pytest.mark.long("journey")
def test_a_long_job_that_tells_how_far_it_is_is_not_given_up_and_shows_it(hostile):
    told = []
    progress = Progress(lambda fraction, text: told.append((fraction, text)))
    (found,) = read_headers([Path("/nowhere/slow")], progress, hostile)
    assert found.reason == "read slow"
    assert (0.5, "step 5") in told


@pytest.mark.long("journey")
def test_a_file_that_takes_long_is_told_to_whoever_waits(hostile):
    told = []
    progress = Progress(lambda fraction, text: told.append(text))
    read_headers([Path("/nowhere", name) for name in ("a", "hang")], progress, hostile)
    assert "2 of 2: 1 s so far" in told


@pytest.mark.long("journey")
def test_many_hostile_files_in_a_row_cost_one_child_each(hostile):
    found = reasons(hostile, *["crash", "a"] * 4)
    assert found[1::2] == ["read a"] * 4
    assert all("SIGABRT" in reason for reason in found[::2])


def test_a_child_that_was_killed_while_it_had_nothing_to_do_is_replaced(hostile):
    reasons(hostile, "a")
    os.kill(hostile._idle[0]._process.pid, signal.SIGKILL)
    hostile._idle[0]._process.wait()
    assert reasons(hostile, "b") == ["read b"]


def test_closing_twice_is_closing_once_and_the_next_task_starts_anew(hostile):
    reasons(hostile, "a")
    child = hostile._idle[0]
    hostile.close()
    hostile.close()
    assert not child.alive
    assert reasons(hostile, "b") == ["read b"]


@pytest.mark.long("journey")
def test_a_cancelled_task_leaves_no_child_behind(hostile):
    progress = Progress()
    threading.Timer(1.0, progress.cancel).start()
    with pytest.raises(Cancelled):
        read_headers([Path("/nowhere/hang")], progress, hostile)
    assert hostile._idle == []
    assert reasons(hostile, "a") == ["read a"]


def test_more_threads_than_children_wait_for_each_other(hostile):
    found = []
    threads = [
        threading.Thread(target=lambda n=n: found.extend(reasons(hostile, f"{n}", f"{n}")))
        for n in range(5)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sorted(found) == sorted([f"read {n}" for n in range(5)] * 2)


def test_a_child_that_does_not_come_up_is_an_error_that_says_so():
    worker = ImagingWorker(1, "no.such.module")
    with pytest.raises(WorkerError, match="process that reads foreign files ended with code 1"):
        reasons(worker, "a")
    worker.close()


@pytest.mark.long("journey")
def test_the_child_ends_when_the_program_is_gone():
    program = (
        "import time; from app.imaging.worker.process import Child; c = Child();"
        "print(c._process.pid, flush=True); time.sleep(60)"
    )
    root = Path(__file__).resolve().parents[2]
    with subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, cwd=root
    ) as parent:
        pid = int(parent.stdout.readline())
        parent.kill()
    deadline = time.monotonic() + 60.0
    while time.monotonic() < deadline and Path(f"/proc/{pid}/cmdline").exists():
        if not Path(f"/proc/{pid}/cmdline").read_bytes():
            break  # ended, and not yet waited for by whoever inherited it
        time.sleep(0.1)
    else:
        assert not Path(f"/proc/{pid}").exists()


def test_the_child_goes_first_where_the_machine_runs_out_of_memory():
    worker = ImagingWorker(1)
    read_headers([Path("/nowhere/file")], Progress(), worker)
    pid = worker._idle[0]._process.pid
    assert Path(f"/proc/{pid}/oom_score_adj").read_text().strip() == "800"
    worker.close()


def test_the_child_loads_no_kernels_and_no_window():
    program = (
        "import sys; import app.imaging.worker.child as c;"
        "print([n for n in ('numba', 'PySide6', 'vtk', 'scipy', 'cv2') if n in sys.modules])"
    )
    root = Path(__file__).resolve().parents[2]
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, cwd=root, text=True)
    assert done.stdout.strip() == "[]"


PARSERS = """
import sys, zipfile
from pathlib import Path
from app.imaging.reading import load_ct
from app.imaging.scanning import scan_folder
folder = Path(sys.argv[1])
with zipfile.ZipFile(folder / "a.zip", "w") as archive:
    for path in (folder / "dicom").iterdir():
        archive.write(path, path.name)
print([load_ct(folder / name).size[2] for name in ("dicom", "a.zip", "nifti", "medium/DICOMDIR")])
print([name for name in ("pydicom", "nibabel", "gdcm") if name in sys.modules])
import pydicom
from app.imaging.library import CtLibrary
pydicom.dcmread = pydicom.dcmwrite = None
print(CtLibrary().import_series(scan_folder(folder / "dicom").series[0]).report.files)
"""


@pytest.mark.long("journey")
def test_the_program_parses_nothing_itself(tmp_path):
    paths = Slices().write(tmp_path / "dicom")
    (tmp_path / "nifti").mkdir()
    nibabel.save(nibabel.Nifti1Image(np.zeros((4, 4, 5)), np.eye(4)), tmp_path / "nifti" / "a.nii")
    directory = pydicom.Dataset()
    directory.DirectoryRecordSequence = [pydicom.Dataset() for _ in paths]
    for record, path in zip(directory.DirectoryRecordSequence, paths, strict=True):
        record.ReferencedFileID = path.name.upper()
    meta = pydicom.dataset.FileMetaDataset()
    meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID = "1.2.840.10008.1.3.10", "2.25.1"
    meta.TransferSyntaxUID = "1.2.840.10008.1.2.1"
    directory.file_meta = meta
    Slices().write(tmp_path / "medium")
    pydicom.dcmwrite(tmp_path / "medium" / "DICOMDIR", directory, enforce_file_format=True)
    root = Path(__file__).resolve().parents[2]
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", PARSERS, str(tmp_path)],
        capture_output=True, cwd=root, text=True,
    )  # fmt: skip
    assert done.stdout.splitlines() == ["[5, 5, 5, 5]", "[]", "5"], done.stderr


@pytest.mark.long("journey")
def test_whoever_waits_for_a_child_is_told_and_may_cancel(hostile):
    told = []
    first = threading.Thread(target=lambda: reasons(hostile, "slow"))
    first.start()
    while not hostile._leased:
        time.sleep(0.01)
    progress = Progress(lambda _, text: (told.append(text), progress.cancel()))
    with pytest.raises(Cancelled):
        read_headers([Path("/nowhere/a")], progress, hostile)
    first.join()
    assert told[0].startswith("waiting until other files are read")


def test_a_file_whose_name_is_no_utf8_is_read_all_the_same(tmp_path):
    paths = Slices().write(tmp_path)
    odd = [path.rename(os.fsdecode(os.fsencode(path) + b"\xff")) for path in paths]
    headers = [found[0] for found in read_headers(odd, Progress())]
    assert [header.path for header in headers] == odd
    for path in odd:
        data = pydicom.dcmread(path)
        data.compress(pydicom.uid.RLELossless, generate_instance_uid=False)
        data.save_as(path)
    headers = [found[0] for found in read_headers(odd, Progress())]
    assert len(filled(headers, np.dtype(np.int16))) == len(odd)


def test_headers_come_through_the_process_as_they_are(tmp_path):
    for path in Slices().write(tmp_path):
        (here,) = file_headers(path)
        (there,) = read_headers([path], Progress())[0]
        assert there == here


@dataclass(frozen=True)
class Fault:
    number: int
    at: str = "nowhere"


PLANE = ImagePlane((1.0, 2.0, 3.0), (1.0, 0.0, 0.0, 0.0, 1.0, 0.0), (0.5, 0.5))


@pytest.mark.parametrize(
    "spoilt",
    [
        [],
        "text",
        None,
        [1, 2],
        [[1.0, 2.0, "3"], [0.0] * 6, [1, 1]],
        {},
        plain(PLANE) | {"position_mm": [1.0, 2.0, "3"]},
        plain(PLANE) | {"position_mm": [1.0, 2.0]},
        plain(PLANE) | {"position_mm": [1.0, 2.0, True]},
        plain(PLANE) | {"position_mm": [1.0, 2.0, float("inf")]},
        plain(PLANE) | {"position_mm": [1.0, 2.0, float("nan")]},
        plain(PLANE) | {"position_mm": None},
        plain(PLANE) | {"more": 1},
        {"position_mm": [1.0, 2.0, 3.0], "orientation": [0.0] * 6},
    ],
)
def test_a_value_of_the_wrong_type_is_refused(spoilt):
    with pytest.raises(ForeignValueError):
        reader(ImagePlane)(spoilt)


@pytest.mark.parametrize(
    ("kind", "value"),
    [(str, 1), (int, "1"), (int, 1 << 63), (int, 1.0), (int, True), (float, "1.0"),
     (float, True), (bool, 1), (Path, 1), (None, 0), (tuple[int, ...], {"0": 1}),
     (tuple[int, int], [1]), (Mapping[str, int], {"a": "1"}), (Fault, plain(Fault(1)) | {"at": 1}),
     (Fault, {"number": 1}), (SliceHeader | Ignored, ["a", "b"])],
)  # fmt: skip
def test_nothing_is_made_into_another_type(kind, value):
    with pytest.raises(ForeignValueError):
        reader(kind)(value)


def test_what_is_wrong_with_a_value_is_told_with_its_place():
    spoilt = plain(PLANE) | {"position_mm": [1.0, 2.0, "3"]}
    with pytest.raises(ForeignValueError, match=r"^position_mm\.2: Input should be a valid number"):
        reader(ImagePlane)(spoilt)


def test_values_keep_their_types():
    assert reader(ImagePlane | None)(json.loads(json.dumps(plain(PLANE)))) == PLANE
    assert reader(ImagePlane | None)(None) is None
    assert reader(StructureKind)("risk") is StructureKind.RISK
    assert reader(Path)("/a/\udcff") == Path("/a/\udcff")  # a name that is no UTF-8
    assert type(reader(float)(1)) is float


def test_arrays_travel_beside_the_message_and_cannot_be_changed_on_the_way():
    attachments = Attachments()
    values = (np.arange(7, dtype=np.int16), np.eye(3), np.zeros((0, 4), bool))
    message = plain(values, attachments)
    memory = attachments.memory()
    kept = os.dup(memory.descriptor)
    kinds = (Annotated[NDArray[kind], ATTACHED] for kind in (np.int16, np.float64, np.bool_))
    arrays = opened(message, memory)
    found = reader(tuple[*kinds])(arrays)
    for one, other in zip(found, values, strict=True):
        np.testing.assert_array_equal(one, other)
        assert one.dtype == other.dtype
        assert not one.flags.writeable
    with pytest.raises(PermissionError):
        os.pwrite(kept, b"x", 0)
    os.close(kept)
    assert reader(Annotated[NDArray[Any], ATTACHED])(arrays[0]) is arrays[0]
    with pytest.raises(ForeignValueError, match="an array of int16, not of int32"):
        reader(Annotated[NDArray[np.int32], ATTACHED])(arrays[0])
    with pytest.raises(ForeignValueError, match="list where an array is wanted"):
        reader(Annotated[NDArray[Any], ATTACHED])([1, 2])


@pytest.mark.parametrize(
    "where",
    [["<i2", [8], 0], ["<i2", [7], 2], ["<i2", [-1], 0], ["O", [1], 0], [7], None, ["<i2", 3, 0]],
)
def test_an_array_that_does_not_lie_in_its_memory_is_refused(where):
    attachments = Attachments()
    attachments.add(np.arange(7, dtype=np.int16))
    with pytest.raises(AttachmentsError):
        opened([{"array": where}], attachments.memory())


def test_memory_that_its_maker_could_still_shrink_is_refused(tmp_path):
    file = os.open(tmp_path / "plain", os.O_RDWR | os.O_CREAT)
    os.ftruncate(file, 100)
    with pytest.raises(AttachmentsError):
        opened([{"array": ["<i2", [7], 0]}], LentMemory(file))


def test_a_file_swapped_after_the_scan_is_not_read(tmp_path):
    path = Slices().write(tmp_path)[0]
    (header,) = file_headers(path)
    path.write_bytes(path.read_bytes() + b"\0\0")
    with pytest.raises(FileDamagedError, match="has changed since"):
        filled([header], np.dtype(np.int16))


def test_a_file_removed_after_the_scan_is_named(tmp_path):
    path = Slices().write(tmp_path)[0]
    (header,) = file_headers(path)
    path.unlink()
    with pytest.raises(FileDamagedError, match=rf"{path.name} cannot be read: No such file"):
        filled([header], np.dtype(np.int16))


def test_a_slice_that_breaks_its_reader_ends_the_load_by_name(tmp_path, monkeypatch):
    (header,) = file_headers(Slices().write(tmp_path)[0])
    encoded: SliceHeader = replace(
        header, pixels=replace(header.pixels, syntax="1.2.840.10008.1.2.5")
    )
    lost = (found for found in [(0, lost_error("was ended by SIGSEGV"))])
    monkeypatch.setattr(service.ImagingWorker, "run", lambda *_: lost)
    with pytest.raises(
        WorkerLostError, match=r"s000: damaged .* SIGSEGV \(decoder pylibjpeg-rle\)"
    ):
        filled([encoded], np.dtype(np.int16))
