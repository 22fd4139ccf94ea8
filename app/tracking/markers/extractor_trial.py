"""The trial of a marker extractor, in a process of its own: see `core.trial`.

Pictures of odd sizes, black, white, in the marker's colour, noise and a spot of that colour in
noise, each with hints that make sense and hints that make none.
"""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from app.core.trial_watch import CALL, SECONDS, Watch
from app.tracking.cameras.camera import Image
from app.tracking.markers.choice import KIND, pair_by
from app.tracking.markers.extractor import Extractor, Hint, MarkerFix, Miss
from app.tracking.optics.rig import RigProfile, load_rig

_RIG: Final = "wide"
_FULCRUM: Final = (0.0, 0.16056, 0.090)  # [m]
_SIZES: Final = ((1, 1), (1, 7), (5, 1), (3, 5), (17, 31), (121, 67), (241, 479))
_RED: Final = (20, 20, 220)
_ODD: Final = (np.nan, np.inf, -np.inf, 0.0, -1.0, 1e9, -1e9, 1e308)


def run(path: Path, argument: str, watch: Watch) -> dict[str, Any]:
    """Try the extractor of a file; see `core.trial.Trial.verdict`."""
    declared = KIND.read(path)
    module = replace(KIND, trial=None).load(declared)
    rig, tried = load_rig(_RIG), 0
    watch.doing("extractor()", CALL)
    pair = pair_by(module.extractor, rig)
    for extractor in pair:
        if not isinstance(extractor, Extractor):
            return {"reason": f"{path}: extractor() gives {extractor!r}; give an Extractor"}
    watch.begin()
    for what, image in _pictures(rig):
        for call, done in _calls(pair[tried % 2], image):
            watch.doing(f"{call} on {what}", CALL)
            if wrong := _wrong(call, done, image):
                return {"reason": f"{path}: {call} on {what} {wrong} (trial)"}
        tried += 1
        if watch.late():
            return {
                "reason": f"{path}: its calls took {SECONDS:g} s for {tried} pictures; a picture"
                " has 33 ms (trial)"
            }
    watch.rest()
    return {"reason": "", "states": tried}


def _pictures(rig: RigProfile) -> Iterator[tuple[str, Image]]:
    """Yield pictures with what they are, read-only as cameras' pictures are."""
    rng = np.random.default_rng(4)
    sizes = {model.image_size[::-1] for model in rig.models}
    for height, width in (*sorted(sizes), *_SIZES):
        black = np.zeros((height, width, 3), np.uint8)
        noise = rng.integers(0, 256, black.shape, np.uint8)
        spot = (noise // 8).astype(np.uint8)
        spot[height // 3 : 2 * height // 3 + 1, width // 3 : 2 * width // 3 + 1] = _RED
        red = np.broadcast_to(np.array(_RED, np.uint8), black.shape).copy()
        kinds = {
            "a black": black,
            "a white": np.full_like(black, 255),
            "a red": red,
            "a noisy": noise,
            "a grey noisy": np.repeat(noise[:, :, :1], 3, axis=2),
            "a spotted": spot,
        }
        for kind, image in kinds.items():
            image.setflags(write=False)
            yield f"{kind} picture of {width} x {height}", image


def _hints(image: Image) -> Iterator[tuple[str, Hint]]:
    middle = np.array(image.shape[1::-1]) / 2.0
    centre, down = np.array(_FULCRUM), np.array([0.0, 0.0, -1.0])
    yield "of its middle", Hint(middle, centre, down)
    yield "of its corner", Hint(np.zeros(2), centre, down)
    yield "without needle", Hint(middle)
    for odd in _ODD:
        yield f"of the pixel {odd:g}", Hint(np.array([odd, middle[1]]), centre, down)
        yield f"of the place {odd:g}", Hint(middle, np.full(3, odd), down)
        yield f"of the axis {odd:g}", Hint(middle, centre, np.full(3, odd))


def _calls(extractor: Extractor, image: Image) -> Iterator[tuple[str, Any]]:
    """Yield every way in which the tracker calls an extractor: its words, and the call."""
    down = np.array([0.0, 0.0, -1.0])
    yield "search()", lambda: extractor.search(image)
    yield "mask()", lambda: extractor.mask(image)
    yield "find_occluded()", lambda: extractor.find_occluded(image, down, lambda uv: None)
    for words, hint in _hints(image):
        yield f"find() with a hint {words}", lambda hint=hint: extractor.find(image, hint)


def _wrong(call: str, done: Any, image: Image) -> str:
    """Call; return what is wrong with it, or nothing."""
    try:
        found = done()
    except Exception as error:
        text = f"{type(error).__name__}: {error}".rstrip(": ")
        return f"raises {text}; return a Miss instead"
    if call == "mask()":
        shape, kind = getattr(found, "shape", None), getattr(found, "dtype", None)
        fits = shape == image.shape[:2] and kind == np.uint8
        return "" if fits else f"gives {kind} of the shape {shape}; give uint8, {image.shape[:2]}"
    several = found if call == "search()" else (found,)
    if not isinstance(several, tuple):
        return f"gives {type(found).__name__}; give a tuple of MarkerFix and Miss"
    for part in several:
        if not isinstance(part, MarkerFix | Miss):
            return f"gives {part!r}; give a MarkerFix or a Miss"
        numbers = [] if part.uv is None else [*part.uv]
        if isinstance(part, MarkerFix):
            numbers += [*part.covariance.flat, part.area, part.quality]
        if not np.isfinite(numbers).all():
            return f"gives {part!r}; give finite numbers, or a Miss"
    return ""
