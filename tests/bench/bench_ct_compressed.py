"""Compressed CT to ready volume, against SimpleITK's GDCM reader on the same folder.

A hundred slices of the phantom in JPEG-LS, JPEG 2000 and RLE; the folders
are kept in the cache. SimpleITK decodes on one thread, Acus in two processes, as the decoders hold
the lock of Python; it needs two free cores to be what it is. Their memory is shared: the rise of
the peak does not show the volume. Figure to reach: not slower than SimpleITK.
"""

import sys
from pathlib import Path

import pydicom
from pydicom.uid import JPEG2000Lossless, JPEGLSLossless, RLELossless

from app.core import paths
from app.imaging.phantom.series import phantom_series
from tests.bench.bench_ct_loading import compare

SLICES = 100
ROUNDS = 5
SYNTAXES = {"JPEG-LS": JPEGLSLossless, "JPEG 2000": JPEG2000Lossless, "RLE": RLELossless}


def main() -> None:
    """Print medians and ratios for each encoding."""
    source = phantom_series(1)
    for name, syntax in SYNTAXES.items():
        folder = paths.cache() / "bench" / name.lower().replace(" ", "-")
        _encode(source, folder, syntax)
        compare(f"{name}, {SLICES} slices", folder, limits=(1.0, 1.0), rounds=ROUNDS)


def _encode(source: Path, folder: Path, syntax: pydicom.uid.UID) -> None:
    if len(list(folder.glob("*.dcm"))) == SLICES:
        return
    folder.mkdir(parents=True, exist_ok=True)
    print(f"encoding {folder.name} ...", file=sys.stderr)
    files = sorted(file for file in source.rglob("*") if file.is_file())[:SLICES]
    for file in files:
        data = pydicom.dcmread(file)
        data.compress(syntax, generate_instance_uid=False)
        data.save_as(folder / f"{file.stem}.dcm", enforce_file_format=True)


if __name__ == "__main__":
    main()
