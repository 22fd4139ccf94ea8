"""Frames of an enhanced multi-frame file: where each lies and what its values mean (PS3.3 A.38).

What holds for one frame stands in its functional groups, what holds for all in the shared ones; a
frame's own group goes first. A frame whose values are no Hounsfield units (perfusion and other
maps) is refused by the name that the file gives it.
"""

import math
import warnings
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, BinaryIO

import pydicom
from pydicom.dataset import Dataset

from app.core.messages import sentence
from app.imaging.elements import check_orientation, require_size
from app.imaging.errors import FileDamagedError, brief
from app.imaging.header import MULTI_FRAME, ImagePlane, Rescale, SliceHeader
from app.imaging.units import another_unit

_SHARED, _EACH, _REAL_WORLD = 0x52009229, 0x52009230, 0x00409096
_MOST_FRAMES = 1 << 16


def frames_of(
    file: SliceHeader, stream: BinaryIO, multi_energy: bool = False
) -> tuple[SliceHeader, ...]:
    """One header for each frame of a multi-frame file.

    Args:
        file: the header of the whole file, without damage.
        stream: the file.
        multi_energy: whether MultienergyCTAcquisition is YES.
    """
    try:
        groups = _groups(stream, file)
        return tuple(_frame(file, n, group, multi_energy) for n, group in enumerate(groups))
    except FileDamagedError as error:
        return (replace(file, damage=str(error)),)
    except Exception as error:  # hostile bytes make the parser raise nearly anything
        return (replace(file, damage=f"its frames cannot be read ({brief(error)})"),)


@dataclass(frozen=True, slots=True)
class _Group:
    """Functional groups of one frame over those that all share."""

    own: Dataset
    shared: Dataset

    def macro(self, keyword: str) -> Dataset:
        """One macro, empty where neither group has it."""
        for group in (self.own, self.shared):
            items = group.get(keyword)
            if items:
                item: Dataset = items[0]
                return item
        return Dataset()

    def numbers(self, macro: str, keyword: str, count: int) -> tuple[float, ...]:
        """Finite numbers of an attribute, `count` of them, or none where it is absent.

        Raises:
            FileDamagedError: if they are not finite or of another number.
        """
        value = self.macro(macro).get(keyword)
        if value is None or value == "":
            return ()
        many = value if isinstance(value, Sequence | pydicom.multival.MultiValue) else [value]
        found = tuple(float(one) for one in many)
        if len(found) != count or not all(map(math.isfinite, found)):
            raise FileDamagedError(
                sentence(
                    "{keyword} of a frame is not {count} finite numbers",
                    keyword=keyword,
                    count=count,
                )
            )
        require_size(keyword, found)
        return found


def _groups(stream: BinaryIO, file: SliceHeader) -> list[_Group]:
    stream.seek(0)
    with warnings.catch_warnings():  # what is wrong with a file is said by name, by us
        warnings.simplefilter("ignore")
        dataset = pydicom.dcmread(
            stream, stop_before_pixels=True, specific_tags=[_SHARED, _EACH], force=True
        )
        each = dataset.get("PerFrameFunctionalGroupsSequence") or []
        shared = (dataset.get("SharedFunctionalGroupsSequence") or [Dataset()])[0]
        if not 1 <= len(each) <= _MOST_FRAMES or len(each) != file.format.frames:
            raise FileDamagedError(
                sentence(
                    "NumberOfFrames is {stated_frames}, and {described_frames} frames are "
                    "described",
                    stated_frames=file.format.frames,
                    described_frames=len(each),
                )
            )
        return [_Group(own, shared) for own in each]


def _frame(file: SliceHeader, number: int, group: _Group, multi_energy: bool) -> SliceHeader:
    rescale, obstacle = _rescale(file, group, multi_energy)
    thickness = group.numbers("PixelMeasuresSequence", "SliceThickness", 1)
    return replace(
        file,
        frame=number,
        plane=_plane(group),
        rescale=rescale,
        obstacle=obstacle,
        windows=_windows(group) or file.windows,
        thickness_mm=thickness[0] if thickness else None,
        marks=_marks(file, group),
    )


def _plane(group: _Group) -> ImagePlane | None:
    position = group.numbers("PlanePositionSequence", "ImagePositionPatient", 3)
    orientation = group.numbers("PlaneOrientationSequence", "ImageOrientationPatient", 6)
    spacing = group.numbers("PixelMeasuresSequence", "PixelSpacing", 2)
    if not (position and orientation and spacing):
        return None
    if min(spacing) <= 0.0:
        raise FileDamagedError(
            sentence("PixelSpacing is {spacing}; both must be above zero", spacing=spacing)
        )
    check_orientation(orientation)
    return ImagePlane(position, orientation, spacing)  # type: ignore[arg-type]  # counts were checked


def _rescale(file: SliceHeader, group: _Group, multi_energy: bool) -> tuple[Rescale | None, str]:
    macro = "PixelValueTransformationSequence"
    slope = group.numbers(macro, "RescaleSlope", 1)
    intercept = group.numbers(macro, "RescaleIntercept", 1)
    if slope and slope[0] == 0.0:
        raise FileDamagedError(sentence("RescaleSlope is 0; every pixel would have the same value"))
    if "MR" in MULTI_FRAME[file.identity.sop_class]:
        return (Rescale(slope[0], intercept[0]) if slope and intercept else Rescale(1, 0)), ""
    unit = str(group.macro(macro).get("RescaleType", "") or "")
    kinds = _kinds(file, group)
    if reason := another_unit(kinds, unit, multi_energy, _measured_in(group)):
        return None, reason
    return (Rescale(slope[0], intercept[0]) if slope and intercept else None), ""


def _kinds(file: SliceHeader, group: _Group) -> tuple[str, ...]:
    own = group.macro("CTImageFrameTypeSequence").get("FrameType")
    values: Any = own or file.identity.image_type
    return tuple(str(value) for value in values)


def _measured_in(group: _Group) -> str:
    """Code of the unit of a frame's real world values; empty where it gives none."""
    units = group.macro("RealWorldValueMappingSequence").get("MeasurementUnitsCodeSequence")
    return str(units[0].get("CodeValue", "") or "") if units else ""


def _windows(group: _Group) -> tuple[tuple[float, float], ...]:
    """Width and level pairs; a window that cannot be used is no reason to refuse a frame."""
    macro = group.macro("FrameVOILUTSequence")
    try:
        pairs = [
            [
                float(v)
                for v in (value if isinstance(value, pydicom.multival.MultiValue) else [value])
            ]
            for value in (macro.get("WindowWidth"), macro.get("WindowCenter"))
        ]
    except (TypeError, ValueError):
        return ()
    found = zip(*pairs, strict=False)
    return tuple(dict.fromkeys((width, level) for width, level in found if 1.0 <= width < 1e6))


def _marks(file: SliceHeader, group: _Group) -> tuple[tuple[str, str], ...]:
    content = group.macro("FrameContentSequence")
    values = {
        "acquisition": content.get("FrameAcquisitionNumber"),
        "time-position": content.get("TemporalPositionIndex"),
        "cardiac-phase": group.macro("CardiacSynchronizationSequence").get(
            "NominalPercentageOfCardiacPhase"
        ),
        "echo": group.macro("MREchoSequence").get("EffectiveEchoTime"),
        "stack": content.get("StackID"),
        "kernel": group.macro("CTReconstructionSequence").get("ConvolutionKernel"),
        "tube-voltage": group.macro("CTXRayDetailsSequence").get("KVP"),
        "acquisition-moment": content.get("FrameAcquisitionDateTime"),
        "image-type": "\\".join(_kinds(file, group)) or None,
    }
    own = {mark: str(value) for mark, value in values.items() if value is not None}
    return tuple((dict(file.marks) | own).items())
