"""Write the structures that come with shipped exercises: RT Structure Sets of the built-in patient.

Run as `python -m tools.exercise_structures`. An RT Structure Set needs no extra to be read. What
`WANTED` names is drawn from the patient's own vessels, slice by slice on the phantom's planes, so a
file belongs to its exercise's seed; it is made anew only where the phantom changes.
"""

from pathlib import Path
from typing import Final

import numpy as np
from pydicom.dataset import Dataset, FileDataset, FileMetaDataset
from pydicom.uid import UID, ExplicitVRLittleEndian

from app.core import paths
from app.core.arrays import FloatArray
from app.exercises.library import load_exercise
from app.exercises.scene import plan_of
from app.imaging.phantom.lesion import make_patient
from app.imaging.phantom.series import uid
from app.imaging.phantom.tubes import Tubes
from app.imaging.phantom.vessels import vasculature
from app.imaging.structures.structure import outlines

WANTED: Final = {"beside-the-vein": {"hepatic vein": "hepatic", "portal vein": "portal"}}
"""Exercise -> name of a structure -> field of `vessels.Vasculature`."""

THINNEST_MM: Final = 1.5
"""Vessels of a smaller radius are not drawn: a needle may meet them."""

AROUND_MM: Final = 35.0
"""What lies further from the path is left out."""

PLANE_MM, PIXEL_MM = 1.0, 0.5
"""Distance of the planes, those of the phantom's CT, and of the points that are looked at."""


def near_path(tubes: Tubes, scale: FloatArray, entry: FloatArray, target: FloatArray) -> FloatArray:
    """Balls near a path, LPS [mm]: centre and radius, shape (n, 4)."""
    balls = tubes.balls[tubes.balls[:, 3] >= THINNEST_MM]
    placed = np.column_stack([balls[:, :3] * scale, balls[:, 3] * scale.mean()])
    along = entry + np.linspace(0.0, 1.0, 60)[:, None] * (target - entry)
    gap = np.linalg.norm(placed[:, None, :3] - along[None], axis=2).min(axis=1)
    near: FloatArray = placed[gap - placed[:, 3] < AROUND_MM]
    return near


def contours(balls: FloatArray) -> list[FloatArray]:
    """Outlines of balls on the planes, LPS [mm], each of shape (n, 3)."""
    found = []
    low = (balls[:, :3] - balls[:, 3:]).min(axis=0) - 1.0
    high = (balls[:, :3] + balls[:, 3:]).max(axis=0) + 1.0
    x = np.arange(low[0], high[0], PIXEL_MM)
    y = np.arange(low[1], high[1], PIXEL_MM)
    for z in np.arange(np.ceil(low[2] / PLANE_MM), high[2] / PLANE_MM) * PLANE_MM:
        cut = balls[np.abs(balls[:, 2] - z) < balls[:, 3]]
        if not len(cut):
            continue
        depth = np.full((len(y), len(x)), -PIXEL_MM)
        for cx, cy, cz, radius in cut.tolist():
            disc = np.sqrt(radius**2 - (cz - z) ** 2)
            np.maximum(depth, disc - np.hypot(x[None] - cx, y[:, None] - cy), out=depth)
        for line in outlines(depth, 0.0):
            points = low[:2] + PIXEL_MM * line
            found.append(np.column_stack([points, np.full(len(points), z)]))
    return found


def write(path: Path, seed: int, regions: dict[str, list[FloatArray]]) -> None:
    """Write an RT Structure Set on the phantom's frame of reference."""
    meta = FileMetaDataset()
    meta.MediaStorageSOPClassUID = UID("1.2.840.10008.5.1.4.1.1.481.3")
    meta.MediaStorageSOPInstanceUID = uid("structures", seed, *regions)
    meta.TransferSyntaxUID = ExplicitVRLittleEndian
    file = FileDataset(str(path), {}, file_meta=meta, preamble=b"\0" * 128)
    file.SOPClassUID, file.SOPInstanceUID = (
        meta.MediaStorageSOPClassUID,
        meta.MediaStorageSOPInstanceUID,
    )
    file.Modality, file.StructureSetLabel = "RTSTRUCT", path.stem
    file.PatientName, file.PatientID = f"Phantom^Seed{seed}", f"PHANTOM-{seed}"
    file.StudyInstanceUID = uid("structures", "study", seed)
    file.SeriesInstanceUID = uid("structures", "series", seed)
    file.FrameOfReferenceUID = uid("frame", seed)
    file.StructureSetROISequence, file.ROIContourSequence = [], []
    file.RTROIObservationsSequence = []
    for number, (name, lines) in enumerate(regions.items(), 1):
        region, drawn, means = Dataset(), Dataset(), Dataset()
        region.ROINumber, region.ROIName = number, name
        region.ReferencedFrameOfReferenceUID = file.FrameOfReferenceUID
        region.ROIGenerationAlgorithm = "AUTOMATIC"
        drawn.ReferencedROINumber, drawn.ROIDisplayColor = number, [70, 110, 220]
        drawn.ContourSequence = []
        for line in lines:
            contour = Dataset()
            contour.ContourGeometricType = "CLOSED_PLANAR"
            contour.NumberOfContourPoints = len(line)
            contour.ContourData = [f"{value:.2f}" for value in line.ravel()]
            drawn.ContourSequence.append(contour)
        means.ObservationNumber = means.ReferencedROINumber = number
        means.RTROIInterpretedType = means.ROIInterpreter = ""
        file.StructureSetROISequence.append(region)
        file.ROIContourSequence.append(drawn)
        file.RTROIObservationsSequence.append(means)
    file.save_as(path, enforce_file_format=True)


def main() -> None:
    """Write every file that is wanted."""
    for name, wanted in WANTED.items():
        exercise = load_exercise(name)
        seed = exercise.ct.phantom.seed if exercise.ct.phantom else 1
        patient, plan = make_patient(seed), plan_of(exercise)
        vessels, scale = vasculature(patient), np.array(patient.scale)
        regions = {
            region: contours(
                near_path(getattr(vessels, field), scale, plan.entry_mm, plan.target_mm)
            )
            for region, field in wanted.items()
        }
        path = paths.resources() / "exercises" / f"{name}.dcm"
        write(path, seed, regions)
        print(f"{path}: {', '.join(f'{k} {len(v)} contours' for k, v in regions.items())}")


if __name__ == "__main__":
    main()
