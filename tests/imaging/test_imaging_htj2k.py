"""High-Throughput JPEG 2000: code streams of another encoder, read as slices of a series."""

from pathlib import Path

import numpy as np
import pydicom
import pytest
from pydicom.encaps import encapsulate
from pydicom.uid import UID

from app.imaging.reading import read_series
from app.imaging.scanning import scan_folder
from tests.imaging.dicom_factory import Slices

STREAMS = Path(__file__).parent / "htj2k"
ROWS, COLUMNS = 40, 56


def picture(factor=1):
    j, i = np.mgrid[:ROWS, :COLUMNS]
    return (i * i + 3 * j * j + 7 * i * j) // 4 % 4096 * factor


def series_of(folder, stream, syntax, bits, signed):
    data = (STREAMS / stream).read_bytes()
    for file in Slices(shape=(ROWS, COLUMNS), signed=signed).write(folder):
        dataset = pydicom.dcmread(file)
        dataset.file_meta.TransferSyntaxUID = UID(f"1.2.840.10008.1.2.4.{syntax}")
        dataset.BitsStored, dataset.HighBit = bits, bits - 1
        dataset.PixelData = encapsulate([data])
        dataset["PixelData"].VR = "OB"
        dataset.save_as(file)
    (series,) = scan_folder(folder).series
    return series


@pytest.mark.parametrize(
    ("stream", "syntax", "bits", "signed", "factor", "off"),
    [
        ("lossless-12-unsigned.j2c", 201, 12, False, 1, 0),
        ("lossless-16-signed.j2c", 201, 16, True, 7, 0),
        ("rpcl-12-unsigned.j2c", 202, 12, False, 1, 0),
        ("lossy-12-unsigned.j2c", 203, 12, False, 1, 4),
    ],
)
def test_slices_in_high_throughput_jpeg_2000_are_read(
    tmp_path, stream, syntax, bits, signed, factor, off
):
    series = series_of(tmp_path, stream, syntax, bits, signed)
    assert series.usable, series.reason
    rescale = series.slices[0].rescale
    stored = (read_series(series).hu[0] - rescale.intercept) / rescale.slope
    assert np.abs(stored - picture(factor)).max() <= off


def test_a_code_stream_cut_in_two_is_no_picture(tmp_path):
    series = series_of(tmp_path, "lossless-12-unsigned.j2c", 201, 12, False)
    header = series.slices[0]
    dataset = pydicom.dcmread(header.path)
    whole = (STREAMS / "lossless-12-unsigned.j2c").read_bytes()
    dataset.PixelData = encapsulate([whole[:60]])
    dataset["PixelData"].VR = "OB"
    dataset.save_as(header.path)
    (found,) = scan_folder(tmp_path).series
    with pytest.raises(ValueError, match=r"cannot be decoded|damaged"):
        read_series(found)
