"""Segmentations of 3D Slicer, `.seg.nrrd`: label maps in layers, one dictionary of segments.

Keys and their meaning as Slicer's `vtkMRMLSegmentationStorageNode` writes them.
"""

from __future__ import annotations

import os
import re
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.imaging.elements import FURTHEST_MM
from app.imaging.errors import brief
from app.imaging.structures.errors import StructureFileError
from app.imaging.structures.extras import extra
from app.imaging.structures.placing import Found, Labelled
from app.imaging.structures.structure import Colour, StructureKind, StructureSet
from app.imaging.volume import Volume

LARGEST = 2_000_000_000
"""Most voxels that a file may claim."""

MOST_LABELS = 256

_DRAWN_ON = "Acus.DrawnOn"
"""Key of the digest of the CT that the structures of this program were drawn on."""

_SPACES = {
    "left-posterior-superior": (1.0, 1.0, 1.0),
    "lps": (1.0, 1.0, 1.0),
    "right-anterior-superior": (-1.0, -1.0, 1.0),
    "ras": (-1.0, -1.0, 1.0),
    "left-anterior-superior": (1.0, -1.0, 1.0),
    "las": (1.0, -1.0, 1.0),
}


def read_nrrd(path: Path) -> Found:
    """Read the segments of a `.seg.nrrd` file, or the labels of a plain label map.

    Raises:
        StructureFileError: if the file is damaged, has no place in space, or is no label map.
        ExtraMissingError: without the extra `structures`.
    """
    nrrd = extra("nrrd", ".seg.nrrd files")
    try:
        with path.open("rb") as file:
            header = nrrd.read_header(file)
            _check_size(header, path)
            values = nrrd.read_data(header, file, str(path), index_order="F")
    except (StructureFileError, MemoryError):
        raise
    except Exception as error:  # pynrrd raises whatever the bytes lead it to
        what = brief(error)
        raise StructureFileError(
            sentence(
                "{path_name} cannot be read as NRRD ({fault})", path_name=path.name, fault=what
            )
        ) from error
    if values.dtype.kind not in "iub":
        raise StructureFileError(
            sentence(
                "{path_name} holds {values_dtype} values; a label map holds whole numbers",
                path_name=path.name,
                values_dtype=values.dtype,
            )
        )
    affine, layers = _geometry(header, values, path)
    found = _segments(header, layers, affine, path)
    return replace(found, drawn_on=frozenset({str(header.get(_DRAWN_ON, ""))}))


def _check_size(header: Any, path: Path) -> None:
    sizes = [int(n) for n in header.get("sizes", [])]
    if header.get("data file") or header.get("datafile"):
        raise StructureFileError(
            sentence(
                "{path_name} keeps its data in other files; only attached data are read",
                path_name=path.name,
            )
        )
    if len(sizes) not in (3, 4) or min(sizes) < 1 or np.prod(sizes, dtype=np.float64) > LARGEST:
        raise StructureFileError(
            sentence(
                "{path_name} has sizes {sizes}; three of a label map, and layers, are read",
                path_name=path.name,
                sizes=sizes,
            )
        )


def _geometry(header: Any, values: NDArray[Any], path: Path) -> tuple[FloatArray, NDArray[Any]]:
    """Affine voxel -> LPS [mm], and the layers, shape (n, K, J, I)."""
    space = str(header.get("space", "")).lower()
    signs = _SPACES.get(space)
    directions = np.asarray(header.get("space directions", ()), np.float64)
    origin = np.asarray(header.get("space origin", ()), np.float64)
    if signs is None or directions.shape != (values.ndim, 3) or origin.shape != (3,):
        raise StructureFileError(
            sentence(
                "{path_name} does not say where it lies: space {space!r}, "
                "{directions_shape} directions; left-posterior-superior or its like is needed",
                path_name=path.name,
                space=space or "missing",
                directions_shape=directions.shape,
            )
        )
    spatial = np.isfinite(directions).all(axis=1)
    if spatial.sum() != 3 or not np.isfinite(origin).all():
        raise StructureFileError(
            sentence(
                "{path_name} has {spatial} axes in space; 3 are needed",
                path_name=path.name,
                spatial=spatial.sum(),
            )
        )
    if values.ndim == 4:
        values = np.moveaxis(values, int(np.flatnonzero(~spatial)[0]), 0)
    else:
        values = values[None]
    affine = np.eye(4)
    affine[:3, :3] = (directions[spatial] * signs).T
    affine[:3, 3] = origin * signs
    if np.abs(affine).max() > FURTHEST_MM:
        raise StructureFileError(
            sentence(
                "{path_name} lies further away than {furthest_mm:g} mm",
                path_name=path.name,
                furthest_mm=FURTHEST_MM,
            )
        )
    if abs(np.linalg.det(affine[:3, :3])) < 1e-9:
        raise StructureFileError(
            sentence("{path_name}: its axes span no volume", path_name=path.name)
        )
    return affine, values.transpose(0, 3, 2, 1)


def _segments(header: Any, layers: NDArray[Any], affine: FloatArray, path: Path) -> Found:
    numbers = sorted(int(m[1]) for key in header if (m := re.fullmatch(r"Segment(\d+)_ID", key)))
    if not numbers:
        labels = [label for label in np.unique(layers[0]).tolist() if label]
        if len(labels) > MOST_LABELS:
            raise StructureFileError(
                sentence(
                    "{path_name} holds {labels} labels: not a label map",
                    path_name=path.name,
                    labels=len(labels),
                )
            )
        plain = (Labelled(f"label {n}", layers[0] == n, affine) for n in labels)
        return Found(plain, len(labels))
    segments = (_segment(header, number, layers, affine, path) for number in numbers)
    return Found(segments, len(numbers))


def _segment(
    header: Any, number: int, layers: NDArray[Any], affine: FloatArray, path: Path
) -> Labelled:
    def value(key: str, default: str = "") -> str:
        return str(header.get(f"Segment{number}_{key}", default))

    try:
        layer, label = int(value("Layer", "0")), int(value("LabelValue", "1"))
    except ValueError:
        raise StructureFileError(
            sentence(
                "{path_name}, segment {segment_number}: its layer or label is no whole number",
                path_name=path.name,
                segment_number=number,
            )
        ) from None
    if not 0 <= layer < len(layers):
        raise StructureFileError(
            sentence(
                "{path_name}, segment {segment_number}: layer {layer} of {layers}",
                path_name=path.name,
                segment_number=number,
                layer=layer,
                layers=len(layers),
            )
        )
    kind, warn = _tags(value("Tags"))
    name = value("Name") or f"segment {number + 1}"
    return Labelled(name, layers[layer] == label, affine, kind, _colour(value("Color")), warn)


def _colour(text: str) -> Colour | None:
    try:
        r, g, b = (round(255 * min(1.0, max(0.0, float(part)))) for part in text.split())
    except (ValueError, OverflowError):
        return None
    return r, g, b


def _tags(text: str) -> tuple[StructureKind | None, float | None]:
    tags = dict(tag.split(":", 1) for tag in text.split("|") if ":" in tag)
    kind = tags.get("Acus.Kind", "")
    try:
        warn = float(tags["Acus.WarnMm"])
    except (KeyError, ValueError):
        warn = -1.0
    return (
        StructureKind(kind) if kind in {k.value for k in StructureKind} else None,
        warn if 0.0 <= warn <= 50.0 else None,
    )


def write_nrrd(path: Path, structures: StructureSet, volume: Volume) -> None:
    """Write structures as a `.seg.nrrd` on the grid of their CT; ones that overlap in layers.

    Raises:
        StructureFileError: if there is nothing to write, or it cannot be written.
        ExtraMissingError: without the extra `structures`.
    """
    nrrd = extra("nrrd", ".seg.nrrd files")
    if not len(structures):
        raise StructureFileError(sentence("there are no structures to write"))
    layers: list[NDArray[np.uint8]] = []
    header: dict[str, Any] = {}
    for number, structure in enumerate(structures):
        mask = structure.full(volume.hu.shape)
        fits = [n for n, known in enumerate(layers) if not known[mask].any()]
        if not fits:
            layers.append(np.zeros(volume.hu.shape, np.uint8))
        layer = fits[0] if fits else len(layers) - 1
        label = int(layers[layer].max()) + 1
        layers[layer][mask] = label
        i, j, k = structure.corner
        depth, height, width = structure.mask.shape
        extent = (i, i + width - 1, j, j + height - 1, k, k + depth - 1)
        values = {
            "ID": f"Segment_{number + 1}",
            "Name": structure.name,
            "NameAutoGenerated": "0",
            "Color": " ".join(f"{c / 255:.6g}" for c in structure.colour),
            "ColorAutoGenerated": "0",
            "Extent": " ".join(map(str, extent)),
            "LabelValue": str(label),
            "Layer": str(layer),
            "Tags": f"Acus.Kind:{structure.kind}|Acus.WarnMm:{structure.warn_mm:g}|",
        }
        header |= {f"Segment{number}_{key}": value for key, value in values.items()}
    _write(nrrd, path, layers, header, volume)


def _write(
    nrrd: Any, path: Path, layers: list[NDArray[np.uint8]], header: dict[str, Any], volume: Volume
) -> None:
    directions = [column.tolist() for column in volume.affine_mm[:3, :3].T]
    values = layers[0].T if len(layers) == 1 else np.stack([layer.T for layer in layers])
    if len(layers) > 1:
        directions.insert(0, [np.nan] * 3)
    header |= {
        "space": "left-posterior-superior",
        "space directions": np.array(directions),
        "space origin": volume.origin_mm,
        "kinds": [*(["list"] if len(layers) > 1 else []), "domain", "domain", "domain"],
        "encoding": "gzip",
        _DRAWN_ON: volume.digest,
        "Segmentation_ContainedRepresentationNames": "Binary labelmap|",
        "Segmentation_MasterRepresentation": "Binary labelmap",
        "Segmentation_ReferenceImageExtentOffset": "0 0 0",
    }
    try:
        with tempfile.TemporaryDirectory(dir=path.parent, prefix=".acus-") as folder:
            part = Path(folder) / "structures.seg.nrrd"
            nrrd.write(str(part), np.asfortranarray(values), header, index_order="F")
            os.replace(part, path)
    except OSError as error:
        raise StructureFileError(
            sentence(
                "{path} cannot be written: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
