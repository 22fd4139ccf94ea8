"""Study: which extractor finds the marker exactly enough, and how near to the Cramér-Rao bound.

Rendered pictures of the band anywhere in the range of the rig `wide`, before an even grey and
before the housing, with the rig's noise and blur. Ways that give the centroid of the outline are
corrected by its known shift, as the tracker does.
"""

from collections.abc import Callable
from typing import Any, Final, NamedTuple

import numpy as np

from app.core.arrays import FloatArray
from app.core.units import MILLIMETRE
from app.studies.findings import Findings, Sheet
from app.studies.references.cramer_rao import joint_bound, position_bound
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way
from app.tracking.cameras.camera import Image
from app.tracking.errors import TrackingError
from app.tracking.markers.choice import ExtractorName, extractors
from app.tracking.markers.extractor import Centre, Extractor, Hint, MarkerFix
from app.tracking.markers.silhouette import centroid_shift
from app.tracking.markers.thesis import ThesisMarker
from app.tracking.optics.rig import RigProfile, load_rig
from app.tracking.simulated.cameras import NeedleRenderer
from app.tracking.simulated.scene import MarkerScene

DECLARATION: Final[dict[str, Any]] = {
    "title": "The marker in a picture: four extractors and two Cramér-Rao bounds",
    "question": "Which extractor finds the marker exactly enough?",
    "reference": "the rendered band's centre, exact to the 55 rays of a pixel",
}

_RIG: Final = "wide"
_FULCRUM: Final = np.array([0.0, 0.16056, 0.090])
_SEEN: Final = 0.1  # [mm]
_SCENES: Final = 40
_THESIS_AREA: Final = 60.0  # [px²]
_BACKGROUNDS: Final = ("even grey", "housing")


class MarkerShot(NamedTuple):
    """A noisy picture, which camera took it, what is known beforehand and what is true."""

    image: Image
    camera: int
    hint: Hint
    true: FloatArray
    shift: FloatArray
    bound: float
    joint: float
    mm_per_px: float


def _scenes(rig: RigProfile, rng: np.random.Generator) -> list[MarkerScene]:
    """Needles anywhere in the rig's range that both cameras see."""
    found: list[MarkerScene] = []
    limits = rig.range
    while len(found) < _SCENES:
        depth = rng.uniform(limits.depth_min_mm, limits.depth_max_mm) * MILLIMETRE
        tilt, azimuth = np.deg2rad(rng.uniform(0.0, limits.tilt_max_deg)), rng.uniform(0, 2 * np.pi)
        across = np.sin(tilt) * np.array([np.cos(azimuth), np.sin(azimuth)])
        axis = np.array([*across, -np.cos(tilt)])
        tip = _FULCRUM + depth * axis
        scene = MarkerScene.from_tip(tip, axis, rig.needle.marker_offset)
        if all(model.sees(scene.p_world, 25.0)[0] for model in rig.models):
            found.append(scene)
    return found


def shots(background: str) -> list[MarkerShot]:
    """Noisy pictures of both cameras with their truth; the same on each call."""
    rig, rng = load_rig(_RIG), np.random.default_rng(5)
    renderers = [NeedleRenderer(m, rig.needle, rig.blur_px, i) for i, m in enumerate(rig.models)]
    if background == "even grey":
        renderers = [renderer.even(115.0) for renderer in renderers]
    return [
        _shot(rig, renderer, camera, scene, rng)
        for scene in _scenes(rig, rng)
        for camera, renderer in enumerate(renderers)
    ]


def _shot(
    rig: RigProfile,
    renderer: NeedleRenderer,
    camera: int,
    scene: MarkerScene,
    rng: np.random.Generator,
) -> MarkerShot:
    def at(p_world: FloatArray) -> Image:
        return renderer.render(MarkerScene(p_world, scene.axis_world))

    model, clean = renderer.model, renderer.render(scene)
    true = model.pixel(scene.p_world)
    shift = centroid_shift(model, rig.needle.shape, scene.p_world, scene.axis_world)
    if true is None or shift is None:
        raise TrackingError(f"camera {model.name} does not see the band at {scene.p_world}")
    noisy = clean + rng.normal(0.0, rig.noise_grey, clean.shape)
    bound = position_bound(at, renderer.band(scene), model, scene.p_world, rig.noise_grey)
    joint = joint_bound(
        at, model, rig.needle.shape, rig.blur_px, scene.p_world, scene.axis_world, rig.noise_grey
    )
    distance = float((model.T_camera_world @ scene.p_world)[2])
    return MarkerShot(
        np.clip(np.rint(noisy), 0.0, 255.0).astype(np.uint8),
        camera,
        Hint(true + rng.normal(0.0, 3.0, 2), scene.p_world, scene.axis_world),
        true,
        shift,
        float(np.trace(bound)),
        float(np.trace(joint)),
        distance / float(model.intrinsics[0]) / MILLIMETRE,
    )


def errors_px(shots_: list[MarkerShot], found: list[Any]) -> FloatArray:
    """Distance of each find from the truth [px]; NaN where a way found nothing, shape (n,)."""
    errors = np.full(len(shots_), np.nan)
    for k, (shot, fix) in enumerate(zip(shots_, found, strict=True)):
        if isinstance(fix, MarkerFix):
            shift = shot.shift if fix.centre is Centre.OUTLINE else np.zeros(2)
            errors[k] = float(np.linalg.norm(fix.uv - shift - shot.true))
    return errors


def _case(setting: Setting) -> Case:
    taken = shots(setting.name)

    def error(found: Any) -> float:
        millimetres = errors_px(taken, found) * np.array([shot.mm_per_px for shot in taken])
        return float(np.sqrt(np.nanmean(millimetres**2)))

    return Case(taken, error, _SEEN)


def _finders(name: ExtractorName) -> tuple[Extractor, Extractor]:
    """Extractors of both cameras; the thesis' with a least area of 60 px² instead of 200, which
    refuses nearly every band of this rig.
    """
    if name is ExtractorName.THESIS:
        return ThesisMarker(area_min=_THESIS_AREA), ThesisMarker(area_min=_THESIS_AREA)
    return extractors(load_rig(_RIG), name)


def _way(name: ExtractorName) -> Callable[[Case], Prepared]:
    def prepare(case: Case) -> Prepared:
        finders = _finders(name)
        taken: list[MarkerShot] = case.data

        def run() -> list[Any]:
            return [finders[shot.camera].find(shot.image, shot.hint) for shot in taken]

        return Prepared(run, len(taken))

    return prepare


def _findings() -> Findings:
    rows = []
    for background in _BACKGROUNDS:
        taken = shots(background)
        least = np.array([shot.bound for shot in taken])
        joint = np.array([shot.joint for shot in taken])
        scale = np.array([shot.mm_per_px for shot in taken])
        floor = np.sqrt(np.mean(least))
        in_mm = float(np.sqrt(np.mean(least * scale**2)))
        over = round(float(np.sqrt(np.mean(least) / np.mean(joint))), 2)
        of_joint = round(float(np.median(np.sqrt(least / joint))), 2)
        rows.append(
            (background, "bound: position alone", round(float(floor), 4), in_mm,
             1.0, 1.0, over, of_joint, 0)
        )  # fmt: skip
        floor, in_mm = np.sqrt(np.mean(joint)), float(np.sqrt(np.mean(joint * scale**2)))
        rows.append(
            (background, "bound: joint", round(float(floor), 4), in_mm,
             round(1.0 / over, 2), round(1.0 / of_joint, 2), 1.0, 1.0, 0)
        )  # fmt: skip
        for name in ExtractorName:
            finders = _finders(name)
            found = [finders[shot.camera].find(shot.image, shot.hint) for shot in taken]
            errors = errors_px(taken, found)
            kept = np.isfinite(errors)
            rms = float(np.sqrt(np.mean(errors[kept] ** 2)))
            rows.append(
                (
                    background,
                    name.value,
                    round(rms, 4),
                    float(np.sqrt(np.mean((errors * scale)[kept] ** 2))),
                    round(rms / float(np.sqrt(np.mean(least[kept]))), 2),
                    round(float(np.median(errors[kept] / np.sqrt(least[kept]))), 2),
                    round(rms / float(np.sqrt(np.mean(joint[kept]))), 2),
                    round(float(np.median(errors[kept] / np.sqrt(joint[kept]))), 2),
                    int(np.sum(~kept)),
                )
            )
    columns = (
        "background", "way", "RMS [px]", "RMS [mm]", "RMS over position's bound", "median",
        "RMS over joint bound", "median of these", "refused",
    )  # fmt: skip
    return Findings(
        (Sheet("bound", "Error over two Cramér-Rao bounds", columns, tuple(rows)),),
        (),
        (
            "The bound of the position alone takes light, colours and background as known, so that "
            "no extractor can quite reach it. The joint bound has the unknowns of model_fit: "
            "shading, colours of shaft and background, width and length.",
        ),
    )


STUDY: Final = Study(
    error_label="RMS distance from the band's centre [mm at its distance]",
    ways=tuple(
        Way(name.value, name.value, _way(name), "one find near a predicted pixel")
        for name in ExtractorName
    ),
    settings=tuple(Setting(name, {}) for name in _BACKGROUNDS),
    case=_case,
    deadline=Limit(1.5e-3, "1.5 ms: half of 3 ms for a pair of pictures"),
    perception=Limit(_SEEN, "0.1 mm beside the needle"),
    default="model_fit: a fraction of the others' error, and it notices what covers the marker",
    findings=_findings,
)
"""Four ways to find the marker, against the bound."""
