"""Run by `peer.Peer` as a program of its own: SimpleITK and pydicom may crash at a hostile file.

Reads a request in JSON per line, answers one in JSON per line. Imports nothing of Acus: it is the
other opinion.
"""

import contextlib
import gzip
import json
import struct
import sys
import zlib
from typing import Any

import numpy as np

from app.core.messages import sentence

_NO_DICOM: dict[str, Any] = {
    "modality": "",
    "sop_class": "",
    "series": False,
    "frames": 0,
    "samples": 0,
    "bits": 0,
    "photometric": "",
    "size": [0, 0],
    "preamble": False,
    "image_type": [],
    "rescale": False,
    "pixels": False,
    "undefined": False,
    "missing": [],
    "unit": "",
    "energies": False,
    "planes": [],
}


_TYPE_1 = (
    "PhotometricInterpretation",
    "Rows",
    "Columns",
    "BitsAllocated",
    "BitsStored",
    "HighBit",
    "PixelRepresentation",
)


def image(files: list[str], folder: str, out: str) -> dict[str, Any]:
    """Read with GDCM through SimpleITK: geometry, and the values into a file of numpy's.

    Args:
        files: of the image.
        folder: that holds links to these files and nothing else.
        out: file for the values.
    """
    import SimpleITK

    if len(files) == 1:
        found = SimpleITK.ReadImage(files[0], imageIO="GDCMImageIO")
    else:
        reader = SimpleITK.ImageSeriesReader()
        reader.SetFileNames(reader.GetGDCMSeriesFileNames(folder))
        found = reader.Execute()
    if found.GetNumberOfComponentsPerPixel() > 1:
        return {"error": "a picture in colour"}
    np.save(out, SimpleITK.GetArrayViewFromImage(found))
    return {
        "size": found.GetSize(),
        "spacing": found.GetSpacing(),
        "origin": found.GetOrigin(),
        "direction": found.GetDirection(),
    }


def nifti(file: str) -> dict[str, Any]:
    """Read from the fixed places of the header what a refusal of a NIfTI file is about.

    The places are those of nifti1.h and nifti2.h; nothing is scaled or believed.
    """
    with open(file, "rb") as raw:
        head = raw.read(2)
        raw.seek(0)
        stream = gzip.GzipFile(fileobj=raw) if head == b"\x1f\x8b" else raw
        try:
            data = stream.read(544)
            rest = sum(len(part) for part in iter(lambda: stream.read(1 << 20), b""))
        except (OSError, EOFError, zlib.error):
            data, rest = b"", 0
    for order in "<>":
        for size, dim, kind, forms, rows, offset in (
            (348, (40, "8h"), (70, "h"), (252, "2h"), (280, "12f"), (108, "f")),
            (540, (16, "8q"), (12, "h"), (344, "2i"), (400, "12d"), (168, "q")),
        ):
            if len(data) < size or struct.unpack_from(f"{order}i", data)[0] != size:
                continue
            read = [
                struct.unpack_from(order + form, data, at)
                for at, form in (dim, kind, forms, rows, offset)
            ]
            sizes, ((code,), (qform, sform), matrix, (start,)) = list(read[0]), read[1:]
            axes = np.reshape(matrix, (3, 4))[:, :3]
            lengths = np.linalg.norm(axes, axis=0)
            square = (
                lengths.min() > 0
                and np.abs(axes.T @ axes / np.outer(lengths, lengths) - np.eye(3)).max()
                * max(sizes[1:4], default=1)
                < 1e-3
            )
            return {
                "sizes": sizes[1 : 1 + max(0, min(sizes[0], 7))],
                "type": code,
                "placed": bool(qform or sform),
                "square": bool(square or not sform),
                "volume": bool(sform == 0 or abs(np.linalg.det(axes)) > 1e-9),
                "bytes": len(data) + rest - int(start),
            }
    return {}


def facts(file: str) -> dict[str, Any]:
    """Read with pydicom what a refusal is about, and where the standard puts each frame."""
    if file.endswith((".nii", ".nii.gz")):
        return _NO_DICOM | {"nifti": nifti(file)}
    import pydicom

    data = pydicom.dcmread(file, stop_before_pixels=True, force=True)
    if len(data) == 0:
        raise ValueError(sentence("no element can be read"))
    frames = frames_of(data)
    return {
        "modality": str(data.get("Modality", "")),
        "sop_class": str(data.get("SOPClassUID", "")),
        "series": bool(data.get("SeriesInstanceUID")),
        "frames": frames,
        "samples": int(data.get("SamplesPerPixel") or 0),
        "photometric": str(data.get("PhotometricInterpretation", "")),
        "bits": int(data.get("BitsAllocated") or 0),
        "size": [int(data.get("Columns") or 0), int(data.get("Rows") or 0)],
        "preamble": data.preamble is not None,
        "image_type": [str(word) for word in data.get("ImageType") or ()],
        "rescale": "RescaleSlope" in data,
        "pixels": decodes(file),
        "undefined": undefined(file),
        "missing": [name for name in _TYPE_1 if data.get(name) is None],
        "unit": str(data.get("RescaleType", "")),
        "energies": str(data.get("MultienergyCTAcquisition", "")) == "YES",
        "planes": [plane(data, number) for number in range(frames)] if frames < 5000 else [],
    }


def frames_of(data: Any) -> int:
    """Return the number of frames; 1 where what stands there is no number."""
    try:
        return int(data.get("NumberOfFrames") or 1)
    except ValueError:
        return 1


def decodes(file: str) -> bool:
    """Return whether pydicom makes pixels of it."""
    import pydicom

    try:
        return bool(pydicom.dcmread(file, force=True).pixel_array.size)
    except Exception:  # whatever a damaged file makes it raise
        return False


def undefined(file: str) -> bool:
    """Return whether the pixels are of undefined length."""
    import pydicom

    try:
        data = pydicom.dcmread(file, force=True)
        return bool(data["PixelData"].is_undefined_length)
    except Exception:  # whatever a damaged file makes it raise
        return False


def plane(data: Any, number: int) -> list[list[float]] | None:
    """Position, orientation and pixel spacing of a frame; None where they are not given."""
    groups = []
    for name in ("PerFrameFunctionalGroupsSequence", "SharedFunctionalGroupsSequence"):
        items = data.get(name) or []
        groups += [items[min(number, len(items) - 1)]] if items else []

    def value(macro: str, name: str) -> list[float] | None:
        for group in groups:
            if macro in group and name in group[macro].value[0]:
                return [float(v) for v in group[macro].value[0][name].value]
        return [float(v) for v in data[name].value] if data.get(name) else None

    found = [
        value("PlanePositionSequence", "ImagePositionPatient"),
        value("PlaneOrientationSequence", "ImageOrientationPatient"),
        value("PixelMeasuresSequence", "PixelSpacing"),
    ]
    return None if None in found else found  # type: ignore[return-value]


def main() -> None:
    """Answer requests until there are no more."""
    answers, sys.stdout = sys.stdout, sys.stderr  # libraries talk on stdout
    for line in sys.stdin:
        request = json.loads(line)
        answer: dict[str, Any] = {}
        with contextlib.suppress(BrokenPipeError):
            try:
                if "facts" in request:
                    answer = {"facts": [facts(file) for file in request["facts"]]}
                else:
                    answer = image(request["files"], request["folder"], request["out"])
            except Exception as error:  # the peer's refusal, whatever it is called there
                answer = {"error": f"{type(error).__name__}: {error}"[:400]}
            answers.write(json.dumps(answer) + "\n")
            answers.flush()


if __name__ == "__main__":
    main()
