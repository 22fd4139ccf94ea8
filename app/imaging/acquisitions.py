"""One series, several stacks: copies of a file, passes over the same places, pictures beside them.

A SeriesInstanceUID promises less than one volume. Copies of one image count once. Passes that
cover the same places (phases, echoes, a repeated acquisition) become series of their own; passes
that merely continue each other stay together, so that a slice missing between them is still seen.
"""

import filecmp
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from app.imaging import stack
from app.imaging.errors import FileDamagedError
from app.imaging.filling import filled
from app.imaging.header import SliceHeader

MARKS = (
    "acquisition",
    "time-position",
    "cardiac-phase",
    "trigger",
    "echo",
    "image-type",
    "kernel",
    "acquisition-time",
)
"""What may tell passes apart, the most telling first (names of `SliceHeader.marks`)."""

SECONDARY_CAPTURE = "1.2.840.10008.5.1.4.1.1.7"
_FEWEST = 3
"""A stack of another direction within a series counts as one from so many slices."""

Headers = tuple[SliceHeader, ...]


@dataclass(frozen=True, slots=True)
class Group:
    """Images that should make one volume.

    Attributes:
        headers: of each image.
        part: what sets them apart from others of the same series; empty where nothing does.
        notes: what was left out, in words.
        copies: what was left out because it is here already.
    """

    headers: Headers
    part: str = ""
    notes: tuple[str, ...] = ()
    copies: Headers = ()


def split(headers: Sequence[SliceHeader]) -> tuple[Group, ...]:
    """Sort the images of one SeriesInstanceUID into stacks.

    Args:
        headers: every image of the series, in any order.
    """
    beside = [header for header in headers if kind_beside(header)]
    images = [header for header in headers if not kind_beside(header)]
    if not images or not beside:
        return _stacks(tuple(headers))
    kinds = sorted({kind_beside(header) for header in beside})
    others = [Group(tuple(h for h in beside if kind_beside(h) == kind), kind) for kind in kinds]
    return (*_stacks(tuple(images)), *others)


def kind_beside(header: SliceHeader) -> str:
    """Name what only accompanies a volume: "localizer", "capture"; "" for all else."""
    if "LOCALIZER" in header.identity.image_type:
        return "localizer"
    return "capture" if header.identity.sop_class.startswith(SECONDARY_CAPTURE) else ""


def _stacks(headers: Headers) -> tuple[Group, ...]:
    if any(header.plane is None for header in headers):
        return (Group(headers),)
    classes: list[list[SliceHeader]] = []
    for header in headers:
        for one in classes:
            if _same_grid(one[0], header):
                one.append(header)
                break
        else:
            classes.append([header])
    if len(classes) > 1 and min(map(len, classes)) < _FEWEST:
        return (Group(headers),)  # refused as mixed, by name
    groups: list[Group] = []
    for number, one in enumerate(classes, 1):
        name = f"stack-{number}" if len(classes) > 1 else ""
        groups.extend(_passes(tuple(one), name))
    return tuple(groups)


def _same_grid(a: SliceHeader, b: SliceHeader) -> bool:
    same_size = (a.format.rows, a.format.columns) == (b.format.rows, b.format.columns)
    return (
        same_size
        and a.plane is not None
        and b.plane is not None
        and stack.same_plane(a.plane, b.plane)
    )


def _passes(headers: Headers, name: str) -> list[Group]:
    kept = _without_copies(headers)
    remain = {id(header) for header in kept}
    copies = tuple(header for header in headers if id(header) not in remain)
    notes = _words(len(copies))
    return [
        Group(members, "-".join(filter(None, (name, part))), notes, copies)
        for part, members in _divided(kept, MARKS)
    ]


def _words(count: int) -> tuple[str, ...]:
    if not count:
        return ()
    return (
        "1 file is a copy and left out" if count == 1 else f"{count} files are copies and left out",
    )


# --- copies


def _without_copies(headers: Headers) -> Headers:
    """Each image once: of files of one SOPInstanceUID, then of one place, those that are equal."""
    kept = _once(headers, [(h.identity.sop_uid or str(n), h.frame) for n, h in enumerate(headers)])
    places = _places(kept)
    if len(set(places)) < len(kept):
        kept = _once(kept, places, stops=True)
    return kept


def _once(headers: Headers, keys: Sequence[object], stops: bool = False) -> Headers:
    """Drop images equal to one of the same key; `stops` at the first pair that differs."""
    first: dict[object, list[SliceHeader]] = {}
    differs = False
    for header, key in zip(headers, keys, strict=True):
        same = first.setdefault(key, [])
        if differs or not (again := [n for n, one in enumerate(same) if _equal(one, header)]):
            differs = differs or (stops and bool(same))
            same.append(header)
        elif same[again[0]].damage and not header.damage:
            same[again[0]] = header
    kept = {id(header) for same in first.values() for header in same}
    return tuple(header for header in headers if id(header) in kept)


def _places(headers: Headers) -> list[object]:
    """Return a number for each place along the normal; one for slices within the tolerance."""
    along = _along(headers)
    numbers = np.zeros(len(headers), int)
    order = np.argsort(along, kind="stable")
    numbers[order[1:]] = np.cumsum(np.diff(along[order]) >= stack.TOLERANCE_MM)
    return list(numbers.tolist())


def _along(headers: Headers) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    planes = [header.plane for header in headers if header.plane is not None]
    result = np.array([plane.position_mm for plane in planes]) @ stack.normal(planes[0])
    return np.asarray(result, np.float64)


def _equal(a: SliceHeader, b: SliceHeader) -> bool:
    """Whether two images are copies of one: all that counts of the header, and every pixel."""
    same_header = (a.plane, a.rescale) == (b.plane, b.rescale) and (
        (a.format.rows, a.format.columns) == (b.format.rows, b.format.columns)
    )
    if a.damage or b.damage:  # of one instance, the whole copy stands for the broken one
        return same_header and a.identity.sop_uid == b.identity.sop_uid
    return same_header and (_same_file(a, b) or _same_pixels(a, b))


def _same_file(a: SliceHeader, b: SliceHeader) -> bool:
    try:
        return a.frame == b.frame and filecmp.cmp(a.path, b.path, shallow=False)
    except OSError:
        return False


def _same_pixels(a: SliceHeader, b: SliceHeader) -> bool:
    if any(h.format.samples != 1 or h.rescale is None or h.format.rows < 1 for h in (a, b)):
        return False
    if any(header.format.bits_allocated not in (8, 16) for header in (a, b)):
        return False
    try:
        pictures = [filled((header,), np.dtype(np.float32)) for header in (a, b)]
    except FileDamagedError:
        return False
    return np.array_equal(pictures[0], pictures[1])


# --- passes


def _divided(headers: Headers, marks: Sequence[str]) -> list[tuple[str, Headers]]:
    """Find passes over the same places, each with its name; a single one is nameless."""
    if not marks or len(headers) < 2 or _is_even(headers):
        return [("", headers)]
    values = [dict(header.marks).get(marks[0], "") for header in headers]
    parts: dict[str, list[SliceHeader]] = {}
    for value, header in zip(values, headers, strict=True):
        parts.setdefault(value, []).append(header)
    if len(parts) < 2 or "" in parts or min(map(len, parts.values())) < 2:
        return _divided(headers, marks[1:])
    chains = _chains([(value, tuple(parts[value])) for value in sorted(parts, key=_natural)])
    if len(chains) < 2:
        return _divided(headers, marks[1:])
    result: list[tuple[str, Headers]] = []
    for number, (names, members) in enumerate(chains, 1):
        shown = "+".join(names) if all(name.isdecimal() for name in names) else str(number)
        result.extend(
            ("-".join(filter(None, (f"{marks[0]}-{shown}", inner))), group)
            for inner, group in _divided(members, marks[1:])
        )
    return result


def _natural(value: str) -> tuple[float, str]:
    return (float(value) if value.isdecimal() else float("inf"), value)


def _is_even(headers: Headers) -> bool:
    planes = [header.plane for header in headers if header.plane is not None]
    slices = stack.stack(planes, (headers[0].format.columns, headers[0].format.rows))
    return float(slices.off_mm.max()) <= stack.TOLERANCE_MM and not stack.doubled(
        slices, [""] * len(headers)
    )


def _chains(parts: Iterable[tuple[str, Headers]]) -> list[tuple[list[str], Headers]]:
    """Join parts that do not overlap: where they continue each other, they are one pass."""
    chains: list[tuple[list[str], Headers]] = []
    for value, members in parts:
        free = [n for n, chain in enumerate(chains) if not _overlap(chain[1], members)]
        even = [n for n in free if _is_even(chains[n][1] + members)]
        if free:
            n = (even or free)[0]
            chains[n] = ([*chains[n][0], value], chains[n][1] + members)
        else:
            chains.append(([value], members))
    return chains


def _overlap(a: Headers, b: Headers) -> bool:
    along = _along(a + b)
    first, second = along[: len(a)], along[len(a) :]
    limit = stack.TOLERANCE_MM
    return bool(first.min() <= second.max() + limit and second.min() <= first.max() + limit)
