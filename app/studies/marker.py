"""Study: which extractor finds the marker exactly enough, and how near to the Cramér-Rao bound.

Rendered pictures of the band anywhere in the range of the rig `wide`, before an even grey and
before the housing, with the rig's noise and blur. Ways that give the centroid of the outline are
corrected by its known shift, as the tracker does.

The least errors that an unbiased extractor can have in a picture: two Cramér-Rao bounds.

Both are for independent noise of equal standard deviation in every grey value and take the
covariance from the inverse of the Fisher information, F = Jᵀ J / noise², J the derivatives of the
noise-free picture.

`position_bound` is for the position alone: light, colours, width, length and background count as
known, which no extractor can know. It takes the pixels in which the band has a share (the shaft's
edges beyond it are not the marker's).

`joint_bound` counts as unknown what the fit of the band's picture has to find too: the paint's
shading, the colours of the shaft beyond both ends and of the background beside it, width and
length; these are eliminated by the Schur complement

    bound = (F_pp - F_pn F_nn⁻¹ F_np)⁻¹,   p: position, n: all else.

What the fit knows beforehand (`tracking.band.fit`) counts as measured with its standard deviation.
"""

from collections.abc import Callable
from typing import Any, Final, NamedTuple

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.studies.findings import Findings, Sheet
from app.studies.in_use import called
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way
from app.tracking.band.equations import REST
from app.tracking.band.fit import SHADING_PRIOR, STRETCH_SD, rest_prior
from app.tracking.band.model import BAND, COLUMNS, design, no_rows
from app.tracking.band.outline import strips, trace
from app.tracking.band.pixels import CURVE, SIDE, BandPixels, gather
from app.tracking.cameras.camera import Image
from app.tracking.errors import TrackingError
from app.tracking.markers.choice import ExtractorName, extractors
from app.tracking.markers.extractor import Centre, Extractor, Hint, MarkerFix
from app.tracking.markers.silhouette import centroid_shift
from app.tracking.markers.thesis import ThesisMarker
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import NeedleShape, RigProfile, load_rig
from app.tracking.simulated.cameras import NeedleRenderer
from app.tracking.simulated.scene import MarkerScene
from app.tracking.tracker import Tracker

_STEP_PX = 0.3
"""Of the central differences: small beside the point spread, large beside a grey level."""


def schur_bound(position: FloatArray, nuisance: FloatArray, prior: FloatArray) -> FloatArray:
    """Least covariance of a position beside unknowns that are not of interest, (2, 2).

    Args:
        position: derivatives of the measurements by the position, over their noise, (m, 2).
        nuisance: the same by the other unknowns, (m, n).
        prior: information on these beforehand, (n, n); zeros for none.

    Raises:
        numpy.linalg.LinAlgError: if the measurements do not determine all unknowns.
    """
    cross = nuisance.T @ position
    known = np.linalg.solve(nuisance.T @ nuisance + prior, cross)
    return np.asarray(np.linalg.inv(position.T @ position - cross.T @ known))


def position_derivatives(
    render: Callable[[FloatArray], Image], model: CameraModel, p_world: FloatArray
) -> FloatArray:
    """Differentiate a noise-free picture by the band's (u, v), float (height, width, 3, 2).

    Args:
        render: noise-free picture with the band's centre at a point in world.
        model: the camera.
        p_world: the band's centre [m], shape (3,).
    """
    p_camera = model.T_camera_world @ p_world
    gradients = []
    for k in range(2):
        step = np.zeros(3)
        step[k] = _STEP_PX * p_camera[2] / model.intrinsics[k]
        ahead, behind = (
            render(model.T_world_camera @ (p_camera + sign * step)).astype(np.float64)
            for sign in (1.0, -1.0)
        )
        gradients.append((ahead - behind) / (2.0 * _STEP_PX))
    return np.stack(gradients, axis=-1)


def position_bound(
    render: Callable[[FloatArray], Image],
    band: Image,
    model: CameraModel,
    p_world: FloatArray,
    noise_grey: float,
) -> FloatArray:
    """Least covariance of the band's pixel with all else known [px²], shape (2, 2).

    Args:
        render: see `position_derivatives`.
        band: not zero where the band has a share of the pixel, shape (height, width).
        model: the camera.
        p_world: the band's centre [m], shape (3,).
        noise_grey: standard deviation of the noise.
    """
    stacked = position_derivatives(render, model, p_world)[band > 0].reshape(-1, 2) / noise_grey
    return np.asarray(np.linalg.inv(stacked.T @ stacked))


def joint_bound(
    render: Callable[[FloatArray], Image],
    model: CameraModel,
    shape: NeedleShape,
    blur_px: float,
    p_world: FloatArray,
    axis_world: FloatArray,
    noise_grey: float,
) -> FloatArray:
    """Least covariance of the band's pixel beside the unknowns of the fit [px²], shape (2, 2).

    It takes the pixels that the fit looks at, the shaft's edges beyond the band included.

    Args:
        render: see `position_derivatives`.
        model: the camera.
        shape: of the needle.
        blur_px: standard deviation of the point spread.
        p_world: the band's centre [m], shape (3,).
        axis_world: unit vector from hub to tip, shape (3,).
        noise_grey: standard deviation of the noise.

    Raises:
        TrackingError: if the band has no picture there.
    """
    unknowns = band_unknowns(
        render(p_world),
        model,
        shape,
        blur_px,
        noise_grey,
        model.T_camera_world @ p_world,
        model.T_camera_world.rotate(axis_world),
    )
    u, v = np.rint(unknowns.pixels).astype(int).T
    by_pixel = position_derivatives(render, model, p_world)[v, u] / noise_grey  # (m, 3, 2)
    position = by_pixel.transpose(1, 0, 2).reshape(-1, 2)
    return schur_bound(position, unknowns.columns, unknowns.prior)


# --- the unknowns of the band's picture besides its position, as columns of a design matrix -------
_SHAFTS = COLUMNS - BAND


class Unknowns(NamedTuple):
    """Of one picture.

    `pixels`: (m, 2) u, v that the fit looks at; `columns`: derivatives of their colours, one colour
    after the other, over the noise, (3·m, n); `prior`: information on the unknowns, (n, n).
    """

    pixels: FloatArray
    columns: FloatArray
    prior: FloatArray


class _Band(NamedTuple):
    pixels: BandPixels
    rows: FloatArray
    ground: FloatArray
    origin: FloatArray


def band_unknowns(
    image: Image,
    model: CameraModel,
    shape: NeedleShape,
    blur_px: float,
    noise_grey: float,
    p_camera: FloatArray,
    axis_camera: FloatArray,
) -> Unknowns:
    """Differentiate a noise-free picture by shading, colours, width and length.

    Args:
        image: the picture, (height, width, 3).
        model: the camera.
        shape: of the needle.
        blur_px: standard deviation of the point spread.
        noise_grey: standard deviation of the noise.
        p_camera: the band's true centre in the camera frame [m], shape (3,).
        axis_camera: unit vector from hub to tip, shape (3,).

    Raises:
        TrackingError: if the band has no picture there.
    """
    at = _places(image, model, shape, blur_px, noise_grey, p_camera, axis_camera)
    count, colours = len(at.rows), at.pixels.colours
    band, rest = at.rows[:, 0, :BAND], np.zeros((count, REST))
    covered = _covered(at.rows[:, 0])
    rest[:, :_SHAFTS] = at.rows[:, 0, BAND:]
    rest[:, _SHAFTS:] = (1.0 - covered)[:, None] * at.ground
    paint = colours[at.rows[:, 0, 0] > 0.97].mean(axis=0)
    linear = np.zeros((3 * count, BAND + 3 * REST))
    prior = np.zeros((BAND + 3 * REST + 2, BAND + 3 * REST + 2))
    prior[:BAND, :BAND] = np.diag(SHADING_PRIOR)
    for c in range(3):
        own = slice(BAND + c * REST, BAND + (c + 1) * REST)
        linear[c * count : (c + 1) * count, :BAND] = paint[c] * band
        linear[c * count : (c + 1) * count, own] = rest
        prior[own, own] = rest_prior(*at.pixels.uneven)
    values = colours.T.ravel()
    normal = linear.T @ linear + prior[:-2, :-2]
    solved = np.asarray(np.linalg.solve(normal, linear.T @ values), dtype=np.float64)
    sizes = _sizes(at, paint, solved)
    prior[-2:, -2:] = np.eye(2) / STRETCH_SD**2
    return Unknowns(at.pixels.places + at.origin, np.column_stack([linear, sizes]), prior)


def _covered(rows: FloatArray) -> FloatArray:
    return np.asarray(rows[:, 0] + rows[:, BAND:].sum(axis=1))


def _sizes(at: _Band, paint: FloatArray, solved: FloatArray) -> FloatArray:
    """Differentiate the colours by the relative width and length, (3·m, 2)."""
    found = []
    for c in range(3):
        rest = solved[BAND + c * REST : BAND + (c + 1) * REST]
        behind = at.ground @ rest[_SHAFTS:]
        by_size = [
            paint[c] * rows[:, :BAND] @ solved[:BAND]
            + rows[:, BAND:] @ rest[:_SHAFTS]
            - _covered(rows) * behind
            for rows in (at.rows[:, 3], at.rows[:, 4])
        ]
        found.append(np.column_stack(by_size))
    return np.vstack(found)


def _places(
    image: Image,
    model: CameraModel,
    shape: NeedleShape,
    blur_px: float,
    noise_grey: float,
    p_camera: FloatArray,
    axis_camera: FloatArray,
) -> _Band:
    """Pixels near the band with their colours and the model's columns."""
    seen, outline = trace(
        p_camera,
        axis_camera,
        shape,
        model.intrinsics,
        model.distortion,
        strips(p_camera, shape, model.intrinsics, blur_px),
    )
    pixels = gather(image, outline, blur_px, noise_grey)
    count = len(pixels.places)
    if not seen or count == 0:
        raise TrackingError(
            sentence(
                "camera {model_name} has no picture of a band at {p_camera} m",
                model_name=model.name,
                p_camera=p_camera,
            )
        )
    ground, every = np.zeros((count, 2 * SIDE)), np.arange(count)
    for k in range(3):
        ground[every, pixels.first + k] += pixels.weights[:, k]
    ground[every, CURVE + np.where(pixels.first >= SIDE, SIDE, 0)] = pixels.weights[:, 3]
    rows = no_rows(count)
    design(pixels.places, outline, shape, blur_px, np.zeros(2), np.ones(2), rows)
    rows.values[~rows.seen] = 0.0
    return _Band(pixels, rows.values, ground, np.array([outline.u, outline.v]))


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
        raise TrackingError(
            sentence(
                "camera {model_name} does not see the band at {scene_p_world}",
                model_name=model.name,
                scene_p_world=scene.p_world,
            )
        )
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


def errors_px(shots_: list[MarkerShot], result: list[Any]) -> FloatArray:
    """Distance of each find from the truth [px]; NaN where a way found nothing, shape (n,)."""
    errors = np.full(len(shots_), np.nan)
    for k, (shot, fix) in enumerate(zip(shots_, result, strict=True)):
        if isinstance(fix, MarkerFix):
            shift = shot.shift if fix.centre is Centre.OUTLINE else np.zeros(2)
            errors[k] = float(np.linalg.norm(fix.uv - shift - shot.true))
    return errors


def _case(setting: Setting) -> Case:
    taken = shots(setting.name)

    def error(result: Any) -> float:
        millimetres = errors_px(taken, result) * np.array([shot.mm_per_px for shot in taken])
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


def _used(name: ExtractorName) -> object:
    return type(extractors(load_rig(_RIG), name)[0])


def _in_use() -> object:
    built: Any = called(Tracker.__init__, "default_extractors")
    return type(built(load_rig(_RIG))[0])


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
            (
                background,
                "bound: position alone",
                round(float(floor), 4),
                in_mm,
                1.0,
                1.0,
                over,
                of_joint,
                0,
            )
        )
        floor, in_mm = np.sqrt(np.mean(joint)), float(np.sqrt(np.mean(joint * scale**2)))
        rows.append(
            (
                background,
                "bound: joint",
                round(float(floor), 4),
                in_mm,
                round(1.0 / over, 2),
                round(1.0 / of_joint, 2),
                1.0,
                1.0,
                0,
            )
        )
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
        "background",
        "way",
        "RMS [px]",
        "RMS [mm]",
        "RMS over position's bound",
        "median",
        "RMS over joint bound",
        "median of these",
        "refused",
    )
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
        Way(name.value, name.value, _way(name), "one find near a predicted pixel", _used(name))
        for name in ExtractorName
    ),
    settings=tuple(Setting(name, {}) for name in _BACKGROUNDS),
    case=_case,
    deadline=Limit(1.5e-3, "1.5 ms: half of 3 ms for a pair of pictures"),
    perception=Limit(_SEEN, "0.1 mm beside the needle"),
    default="model_fit",
    because="a fraction of the others' error, and it notices what covers the marker",
    exception="The only way that notices fingers and highlights over the marker.",
    in_use=_in_use,
    findings=_findings,
)
"""Four ways to find the marker, against the bound."""
