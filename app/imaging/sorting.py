"""The images of one SeriesInstanceUID sorted into what each makes a volume by itself.

A series is one study of one patient in one frame of reference (PS3.3 A.1.2, C.7.4.1). Where files
say otherwise they are read apart, or refused where nothing that is written down would keep them
apart. What only accompanies slices is set beside them, by name.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Final

from app.core.messages import sentence
from app.imaging import stack
from app.imaging.acquisitions import Group, Headers, passes
from app.imaging.header import CT_IMAGE, MR_IMAGE, MULTI_FRAME, SliceHeader

SECONDARY_CAPTURE: Final = "1.2.840.10008.5.1.4.1.1.7"
_FEWEST: Final = 3
"""A stack of another direction within a series counts as one from so many slices."""

_NAMED: Final = 3
"""So many files are named in a note."""

_WHO: Final = ("IssuerOfPatientID", "PatientBirthDate", "PatientName")
"""What a pseudonym does not tell apart."""

_ASIDE: Final = {
    "picture": "a picture in colour or without grey values",
    "map": "a map of other values",
    "other": "no CT or MR image",
    "unplaced": "an image that does not say where it lies",
}
"""Kind of what is set beside slices without being expected there -> what it is."""


def split(headers: Sequence[SliceHeader]) -> tuple[Group, ...]:
    """Sort the images of one SeriesInstanceUID into stacks.

    Args:
        headers: every image of the series, in any order.
    """
    return tuple(
        group
        for part, members, note, obstacle in _by_owner(headers)
        for group in _named(_of_one_owner(members, obstacle), part, note)
    )


def _named(groups: Sequence[Group], part: str, note: str) -> list[Group]:
    return [
        replace(
            group,
            part="-".join(filter(None, (part, group.part))),
            notes=(*filter(None, (note,)), *group.notes),
        )
        for group in groups
    ]


# --- whose they are

_Owned = tuple[str, Headers, str, str]
"""Part, its images, a note, and why they are refused."""


def _by_owner(headers: Sequence[SliceHeader]) -> list[_Owned]:
    """Part images of several patients or studies."""
    owners = [dict(header.identity.owner) for header in headers]
    patients = [owner.get("PatientID", "") for owner in owners]
    studies = [owner.get("StudyInstanceUID", "") for owner in owners]
    keys = list(zip(patients, studies, strict=True))
    if len(set(keys)) == 1:
        return [("", tuple(headers), "", _two_patients(owners))]
    several, attribute = (
        ("patient", "PatientID")
        if len(set(patients)) > 1
        else (
            "study",
            "StudyInstanceUID",
        )
    )
    plural = "patients" if several == "patient" else "studies"
    note = (
        f"files of {len(set(keys))} {plural} have this SeriesInstanceUID ({attribute} differs): "
        "read apart"
    )
    result = []
    for number, key in enumerate(sorted(set(keys)), 1):
        here = [n for n, other in enumerate(keys) if other == key]
        obstacle = _two_patients([owners[n] for n in here])
        result.append((f"{several}-{number}", tuple(headers[n] for n in here), note, obstacle))
    return result


def _two_patients(owners: Sequence[dict[str, str]]) -> str:
    """Say by which attribute images of one PatientID and study are of several patients."""
    for name in _WHO:
        if len({owner[name] for owner in owners if name in owner}) > 1:
            return sentence(
                "files of two patients: {name} differs under one PatientID and "
                "StudyInstanceUID; put the files of each patient into a folder of their own",
                name=name,
            )
    return ""


def _of_one_owner(headers: Headers, obstacle: str) -> list[Group]:
    if obstacle:
        return [Group(headers, obstacle=obstacle)]
    kinds = [kind_beside(header) for header in headers]
    for kind in ("unplaced", "other"):  # where they are most of a series, it is what they are
        if 2 * kinds.count(kind) >= len(headers):
            kinds = ["" if other == kind else other for other in kinds]
    images = tuple(header for header, kind in zip(headers, kinds, strict=True) if not kind)
    if not images or len(images) == len(headers):
        return _by_frame(headers)
    others, notes = [], []
    for kind in sorted({kind for kind in kinds if kind}):
        beside = tuple(h for h, other in zip(headers, kinds, strict=True) if other == kind)
        others.append(Group(beside, kind))
        if kind in _ASIDE:
            notes.append(_aside(beside, _ASIDE[kind]))
    first = [replace(g, notes=(*g.notes, *notes)) for g in _by_frame(images)]
    return [*first, *others]


def kind_beside(header: SliceHeader) -> str:
    """Name what only accompanies a volume: a localizer, a capture and the like; "" for all else."""
    identity, form = header.identity, header.format
    if "LOCALIZER" in identity.image_type:
        return "localizer"
    if identity.sop_class.startswith(SECONDARY_CAPTURE):
        return "capture"
    if header.damage:
        return ""
    if form.samples > 1 or not form.photometric.startswith("MONOCHROME"):
        return "picture"
    if header.obstacle:
        return "map"
    if identity.sop_class not in (CT_IMAGE, MR_IMAGE, *MULTI_FRAME) or (
        identity.modality not in ("CT", "MR")
    ):
        return "other"
    return "" if header.plane else "unplaced"


def _aside(headers: Headers, what: str) -> str:
    names = ", ".join(header.path.name for header in headers[:_NAMED])
    more = f" and {len(headers) - _NAMED} more" if len(headers) > _NAMED else ""
    return sentence("set aside, as {role}: {names}{more}", role=what, names=names, more=more)


# --- where they lie


def _by_frame(headers: Headers) -> list[Group]:
    """Part images of several frames of reference, but for those that have one of their own each.

    Those had theirs from whoever de-identified them. Images without any go with those of the only
    one there is.
    """
    frames: dict[str, list[SliceHeader]] = {}
    for header in headers:
        frame = "" if header.damage else header.identity.frame_of_reference  # may be cut off
        frames.setdefault(frame, []).append(header)
    told = {frame: members for frame, members in frames.items() if frame}
    own = all(len({h.identity.sop_uid for h in members}) < 2 for members in told.values())
    if len(told) < 2 or own:
        return _stacks(headers)
    note = (
        f"its files name {len(told)} frames of reference, whose positions do not compare "
        "(FrameOfReferenceUID differs): read apart"
    )
    return [
        group
        for number, frame in enumerate(sorted(frames), 1)
        for group in _named(_stacks(tuple(frames[frame])), f"frame-{number}", note)
    ]


def _stacks(headers: Headers) -> list[Group]:
    if any(header.plane is None for header in headers):
        return [Group(headers)]
    classes = _classes(headers, _same_grid)
    whole = [members for members in classes if len(members) >= _FEWEST]
    if len(classes) > 1 and not whole:
        return [Group(headers)]  # refused as mixed, by name
    if len(classes) == 1:
        whole = classes
    strays = [members for members in classes if members not in whole]
    notes = tuple(_aside(members, _other_grid(whole[0][0], members[0])) for members in strays)
    groups: list[Group] = []
    for number, members in enumerate(whole, 1):
        name = f"stack-{number}" if len(whole) > 1 else ""
        made = passes(members, name)
        groups.extend(replace(group, notes=(*group.notes, *notes)) for group in made)
    groups.extend(Group(members, f"beside-{n}") for n, members in enumerate(strays, 1))
    return groups


def _classes(headers: Headers, same: Callable[[SliceHeader, SliceHeader], bool]) -> list[Headers]:
    classes: list[list[SliceHeader]] = []
    for header in headers:
        for members in classes:
            if same(members[0], header):
                members.append(header)
                break
        else:
            classes.append([header])
    return [tuple(members) for members in classes]


def _same_grid(a: SliceHeader, b: SliceHeader) -> bool:
    return a.format.size == b.format.size and (
        a.plane is not None and b.plane is not None and stack.same_plane(a.plane, b.plane)
    )


def _other_grid(usual: SliceHeader, stray: SliceHeader) -> str:
    """Say by what a stray image belongs to no stack of the others."""
    planes = [header.plane for header in (usual, stray) if header.plane]
    if stack.mixed(planes).startswith("mixed orientations"):
        return sentence("of another direction than the slices")
    if usual.format.size != stray.format.size:
        return sentence("of another size than the slices")
    return sentence("of another pixel spacing than the slices")
