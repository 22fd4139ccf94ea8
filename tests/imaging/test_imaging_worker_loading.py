"""What the worker loads, and when: nothing before it is needed, and never at a file's cost."""

import sys

import numpy as np
import pydicom
import pytest

from app.core.progress import Progress
from app.imaging import header_reading
from app.imaging.element_reading import NotStandardError
from app.imaging.filling import filled
from app.imaging.header_reading import headers_in
from app.imaging.scanning import scan_folder
from app.imaging.worker import service
from app.imaging.worker.pool import ImagingWorker
from app.imaging.worker.service import load_decoders, read_headers
from tests.imaging.dicom_factory import Slices


def _children(worker):
    return [child._process.pid for child in worker._idle]


def test_decoders_can_be_loaded_before_any_file_comes():
    worker = ImagingWorker()
    try:
        worker.warm()
        (first,) = _children(worker)
        load_decoders(Progress(), worker)
        assert _children(worker) == [first]
    finally:
        worker.close()


@pytest.mark.long("journey")
def test_two_children_decode_at_once_what_takes_long(tmp_path, monkeypatch):
    files = Slices(offsets=tuple(float(n) for n in range(20))).write(tmp_path)
    for file in files:
        data = pydicom.dcmread(file)
        data.compress(pydicom.uid.JPEGLSLossless, generate_instance_uid=False)
        data.save_as(file)
    (series,) = scan_folder(tmp_path).series
    assert series.usable
    for limit, count in ((1 << 40, 1), (0, 2)):
        worker = ImagingWorker(most=2)
        monkeypatch.setattr(service, "shared_worker", lambda worker=worker: worker)
        monkeypatch.setattr(service, "_LONG", limit)
        try:
            values = filled(series.slices, np.dtype(np.int16))
            assert values.shape == (20, *values.shape[1:])
            assert len(_children(worker)) == count
        finally:
            worker.close()


def test_a_file_that_needs_pydicom_is_not_charged_for_loading_it(tmp_path, monkeypatch):
    """The program counts a file's processor time anew from each sign of progress."""
    file = tmp_path / "file"
    file.write_bytes(bytes(128) + b"DICM" + bytes(300))
    monkeypatch.delitem(sys.modules, "app.imaging.header_reading", raising=False)
    told = []
    headers_in(file, tmp_path, Progress(lambda fraction, text: told.append(text)))
    assert told == ["pydicom is loaded"]
    headers_in(file, tmp_path, Progress(lambda fraction, text: told.append(text)))
    assert told == ["pydicom is loaded"]


def test_an_odd_file_is_left_alone_where_only_sound_ones_are_asked_for(tmp_path):
    file = tmp_path / "file"
    file.write_bytes(bytes(128) + b"DICM" + bytes(300))
    with pytest.raises(NotStandardError):
        header_reading.file_headers(file, without_pydicom=True)


def test_odd_and_sound_files_of_one_folder_are_both_read(tmp_path):
    sound = Slices().write(tmp_path / "sound")
    odd = Slices().write(tmp_path / "odd")
    for file in odd:
        data = pydicom.dcmread(file)
        data.file_meta.TransferSyntaxUID = pydicom.uid.ExplicitVRBigEndian
        data.PixelData = data.pixel_array.astype(data.pixel_array.dtype.newbyteorder(">")).tobytes()
        pydicom.dcmwrite(file, data, implicit_vr=False, little_endian=False)
    found = read_headers([*sound, *odd], Progress())
    planes = [headers[0].plane for headers in found]
    assert planes[: len(sound)] == planes[len(sound) :]
