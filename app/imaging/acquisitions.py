"""One stack of images, several passes: copies of a file, and passes over the same places.

A SeriesInstanceUID promises less than one volume. Copies of one image count once. Passes that
cover the same places (phases, echoes, kernels, a repeated acquisition) become series of their own,
though they may mesh to an even stack; passes that merely continue each other stay together, so
that a slice missing between them is still seen.
"""

import filecmp
import re
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from app.core.messages import counted, listed, sentence
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
    "stack",
    "image-type",
    "kernel",
    "tube-voltage",
    "thickness",
    "contrast",
    "number",
    "description",
    "comments",
    "acquisition-moment",
    "acquisition-time",
    "content-time",
)
"""What may tell passes apart, the most telling first (names of `SliceHeader.marks`)."""

_TIMES = ("acquisition-moment", "acquisition-time")
"""Marks that may differ with every slice of one pass, and grow along it."""

_OF_MR = ("time-position", "cardiac-phase", "echo", "image-type")
"""What may part an even stack of MR, whose acquisitions and times are meshed on purpose."""

_MIXED = {"kernel": "ConvolutionKernel", "tube-voltage": "KVP", "acquisition": "AcquisitionNumber"}
"""Marks by which values of neighbours may not compare -> their attribute."""

_COUNTED = ("stack", "contrast", "description", "comments", "acquisition-moment", "content-time")
"""Marks whose values are named by their number only: they may tell of the patient."""

_MESHED = 1.5
"""Slices of a pass that others mesh with lie so many times as far apart as those of all."""

_FEWEST_OF_A_TIME = 3
_APART_S = 30.0

Headers = tuple[SliceHeader, ...]


@dataclass(frozen=True, slots=True)
class Group:
    """Images that should make one volume.

    Attributes:
        headers: of each image.
        part: what sets them apart from others of the same series; empty where nothing does.
        notes: what was left out, in words.
        copies: what was left out because it is here already.
        obstacle: why they are no volume, whatever they are; empty mostly.
    """

    headers: Headers
    part: str = ""
    notes: tuple[str, ...] = ()
    copies: Headers = ()
    obstacle: str = ""


def passes(headers: Headers, name: str) -> list[Group]:
    """Sort images of one grid into passes, each without copies.

    Args:
        headers: of one size, direction and pixel spacing.
        name: what sets them apart from others already; empty where nothing does.
    """
    kept = _without_copies(headers)
    remain = {id(header) for header in kept}
    copies = tuple(header for header in headers if id(header) not in remain)
    notes = (*_words(len(copies)), *_namesakes(kept))
    return [
        Group(members, "-".join(filter(None, (name, part))), (*notes, *_mixture(members)), copies)
        for part, members in _divided(kept, MARKS)
    ]


def _mixture(headers: Headers) -> tuple[str, ...]:
    """Say by what slices of one volume differ so that their values may not compare."""
    names = []
    for mark, attribute in _MIXED.items():
        parts = _parted(headers, mark)
        if len(parts) > 1 and not (mark == "acquisition" and _disjoint(list(parts.values()))):
            names.append(attribute)
    if not names:
        return ()
    return (
        sentence("its slices differ in {names}: neighbours may not compare", names=listed(names)),
    )


def _namesakes(headers: Headers) -> tuple[str, ...]:
    """Say that different images have one SOPInstanceUID, which stands for one of them."""
    counts = Counter((header.identity.sop_uid, header.frame) for header in headers)
    doubled = sum(count for (uid, _), count in counts.items() if uid and count > 1)
    return (
        (sentence("{doubled} different images share a SOPInstanceUID", doubled=doubled),)
        if doubled
        else ()
    )


def _words(count: int) -> tuple[str, ...]:
    if not count:
        return ()
    return (counted("{n} file is a copy and left out", "{n} files are copies and left out", count),)


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
    """Return whether two images are copies of one: all that counts of the header, and every
    pixel.
    """
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
    even = len(headers) > 1 and _is_even(headers)
    for at, mark in enumerate(marks if len(headers) > 1 else ()):
        parts = _parted(headers, mark)
        if even and len(parts) > 2 and mark in _TIMES:
            parts = _sweeps(headers, mark)
        if len(parts) < 2 or min(map(len, parts.values())) < 2 or ("" in parts and not even):
            continue
        if _disjoint(list(parts.values())):
            continue
        chains = _chains([(value, parts[value]) for value in sorted(parts, key=_natural)])
        if len(chains) < 2 or (even and not _meshed(headers, [c[1] for c in chains], mark)):
            continue
        result: list[tuple[str, Headers]] = []
        for number, (names, members) in enumerate(chains, 1):
            shown = str(number)
            if mark not in _COUNTED and all(name.isdecimal() for name in names):
                shown = "+".join(names)
            result.extend(
                ("-".join(filter(None, (f"{mark}-{shown}", inner))), group)
                for inner, group in _divided(members, marks[at + 1 :])
            )
        return result
    return [("", headers)]


def _parted(headers: Headers, mark: str) -> dict[str, Headers]:
    parts: dict[str, list[SliceHeader]] = {}
    for header in headers:
        parts.setdefault(dict(header.marks).get(mark, ""), []).append(header)
    return {value: tuple(members) for value, members in parts.items()}


def _meshed(headers: Headers, members: Sequence[Headers], mark: str) -> bool:
    """Return whether parts of an even stack are passes of their own, each even and as sparse as
    that.
    """
    if mark not in _OF_MR and headers[0].identity.modality == "MR":
        return False
    if mark in (*_TIMES, "content-time") and min(map(len, members)) < _FEWEST_OF_A_TIME:
        return False
    if mark == "content-time" and not _times_apart(headers):
        return False
    least = _MESHED * _step(headers)
    return all(len(part) > 1 and _is_even(part) and _step(part) >= least for part in members)


def _times_apart(headers: Headers) -> bool:
    """Return whether the times at which images were made lie apart: several are made at once."""
    times = sorted(_parted(headers, "content-time"))
    if not all(re.fullmatch(r"\d{6}(\.\d+)?", time) for time in times):
        return False
    seconds = [3600 * int(t[:2]) + 60 * int(t[2:4]) + float(t[4:]) for t in times]
    return all(later - one >= _APART_S for one, later in pairwise(seconds))


def _step(headers: Headers) -> float:
    return float(np.ptp(_along(headers))) / (len(headers) - 1)


def _sweeps(headers: Headers, mark: str) -> dict[str, Headers]:
    """Part slices that each have a time of their own where the table went back over others."""
    parts = _parted(headers, mark)
    sweeps: list[Headers] = []
    for value in sorted(parts, key=_natural):
        if sweeps and not _overlap(sweeps[-1], parts[value]):
            sweeps[-1] += parts[value]
        else:
            sweeps.append(parts[value])
    return {str(number): sweep for number, sweep in enumerate(sweeps, 1)}


def _natural(value: str) -> tuple[float, str]:
    try:
        return float(value), value
    except ValueError:
        return float("inf"), value


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
        if free:
            several = len(free) > 1
            even = [n for n in free if several and _is_even(chains[n][1] + members)]
            n = (even or free)[0]
            chains[n] = ([*chains[n][0], value], chains[n][1] + members)
        else:
            chains.append(([value], members))
    return chains


def _disjoint(parts: Sequence[Headers]) -> bool:
    """Return whether each part has a range along the normal of its own."""
    ends = np.cumsum([len(part) for part in parts])[:-1]
    along = np.split(_along(tuple(header for part in parts for header in part)), ends)
    ranges = sorted((float(part.min()), float(part.max())) for part in along)
    return all(low > high + stack.TOLERANCE_MM for (_, high), (low, _) in pairwise(ranges))


def _overlap(a: Headers, b: Headers) -> bool:
    along = _along(a + b)
    first, second = along[: len(a)], along[len(a) :]
    limit = stack.TOLERANCE_MM
    return bool(first.min() <= second.max() + limit and second.min() <= first.max() + limit)
