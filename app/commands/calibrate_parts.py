"""What the commands of `acus calibrate` share: group, options, progress, how results are told."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

import typer

from app.commands.answer import Commands, wants_json
from app.commands.reader_language import local
from app.core.messages import joined, sentence

if TYPE_CHECKING:
    from collections.abc import Callable

    from app.core.progress import Progress
    from app.tracking.calibration.checks import Check
    from app.tracking.calibration.mono import MonoResult
    from app.tracking.calibration.remarks import ViewResidual
    from app.tracking.calibration.sets import MonoSet, Seen, StereoSet
    from app.tracking.calibration.verdict import Judgement, Region
    from app.tracking.calibration.views import BoardView, Rejection
    from app.tracking.optics.calibration import CameraCalibration, StereoCalibration
    from app.tracking.optics.lens import LensModel

T = TypeVar("T")

app = Commands(help="Calibrate cameras from pictures of a board.")

Images = Annotated[Path, typer.Option("--images", metavar="DIR", help="Folder of the pictures.")]
BoardSpec = Annotated[
    str,
    typer.Option(
        "--board",
        metavar="SPEC",
        help="checkerboard:COLSxROWS:SQUARE (inner corners, e.g. checkerboard:9x6:25mm) or "
        "charuco:COLSxROWS:SQUARE:MARKER:DICTIONARY (squares).",
    ),
]


def with_progress(work: "Callable[[Progress], T]") -> T:
    """Run `work(progress)` with a bar on the standard error; Ctrl-C cancels it."""
    from rich.progress import Progress as Bar

    from app.commands.output import console
    from app.core.progress import Progress
    from app.core.words import printable

    with Bar(console=console(stderr=True), transient=True, disable=wants_json()) as bar:
        task = bar.add_task("", total=1.0)

        def show(fraction: float, text: str) -> None:
            bar.update(task, completed=fraction, description=printable(local(text)))

        return work(Progress(show))


LensName = Annotated[
    str | None,
    typer.Option(
        "--lens",
        metavar="MODEL",
        help="plumb_bob, rational_polynomial or equidistant (fisheye); else as the pictures ask.",
    ),
]


def lens_named(text: str | None) -> "LensModel | None":
    """Return the model of a lens by its name; None for none.

    Raises:
        ConfigurationError: for another name.
    """
    from app.core.errors import ConfigurationError
    from app.tracking.optics.lens import LensModel

    if text is None:
        return None
    if text not in set(LensModel):
        raise ConfigurationError(
            sentence(
                "--lens {lens!r}: there are {known_lenses}; equidistant is the fisheye model",
                lens=text,
                known_lenses=", ".join(LensModel),
            )
        )
    return LensModel(text)


def region_of(rig: str, calibration: "StereoCalibration") -> "Region | None":
    """Outline where a rig's marker comes in both pictures, by the calibration's place if known.

    Raises:
        CalibrationError: if the pictures are of another size than the rig's.
        RigError: if there is no such rig.
    """
    from app.mechanisms.profile import load_profile
    from app.tracking.calibration.applies import require_size
    from app.tracking.optics.rig import load_rig, view_cone

    profile = load_rig(rig)
    for camera, model in zip(calibration.cameras, profile.models, strict=True):
        require_size(
            camera, model.image_size, sentence("the picture of rig {name}", name=profile.name)
        )
    models = profile.models if calibration.world is None else calibration.models()
    fulcrum = load_profile("icube").fulcrum
    return view_cone(models, profile.needle, profile.range, fulcrum).outlines


def view_document(view: "BoardView | Rejection") -> dict[str, Any]:
    """One picture as JSON."""
    from app.tracking.calibration.views import Rejection

    if isinstance(view, Rejection):
        return {"name": view.name, "used": False, "reason": view.reason.value, "text": view.text}
    return {
        "name": view.name,
        "used": True,
        "reason": "",
        "text": "",
        "image_size": list(view.image_size),
        "corners": int(view.ids.size),
        "square_px": round(view.square_px, 2),
        "edge_px": round(view.sharpness, 2),
        "window_px": view.window,
    }


def view_line(view: "BoardView | Rejection") -> str:
    """One picture as a line for people."""
    from app.tracking.calibration.views import Rejection

    if isinstance(view, Rejection):
        return sentence("{name:<24} not used  {reason}", name=view.name, reason=view.text)
    return sentence(
        "{name:<24} {corners:>3} corners  squares {square_px:.0f} px  edges {edge_px:.1f} px  "
        "window ±{window} px",
        name=view.name,
        corners=view.ids.size,
        square_px=view.square_px,
        edge_px=view.sharpness,
        window=view.window,
    )


def mono_document(outcome: "MonoSet") -> dict[str, Any]:
    """One camera as JSON."""
    result = outcome.result
    return {
        **camera_document(result.calibration),
        "opencv_rms_px": result.usual_rms_px,
        "held_back_rms_px": result.held_back_rms_px,
        "dropped": [{"name": d.name, "value": d.value, "sd": d.sd} for d in result.dropped],
        "residuals": _residuals(result.residuals),
        "pictures": [view_document(view) for view in outcome.read],
        "notes": list(result.notes),
    }


def stereo_document(
    outcome: "StereoSet", checks: "Sequence[Check]", verdict: "Judgement"
) -> dict[str, Any]:
    """Two cameras as JSON."""
    calibration, estimate = outcome.calibration, outcome.result.estimate
    pose = calibration.pose
    return {
        "id": calibration.id,
        "created": calibration.created.isoformat(),
        "board": calibration.board,
        "verdict": verdict.grade.value,
        "reason": verdict.why.value,
        "text": verdict.text,
        "rms_px": calibration.rms_px,
        "together": calibration.together.model_dump() if calibration.together else None,
        "opencv_rms_px": estimate.usual_rms_px,
        "cameras": [
            camera_document(camera) | _lens_alone(mono)
            for camera, mono in zip(
                calibration.cameras, (estimate.left, estimate.right), strict=True
            )
        ],
        "rotation": [list(row) for row in pose.rotation],
        "translation_mm": list(pose.translation_mm),
        "pose_sd": _sd(pose.covariance),
        "baseline_mm": calibration.baseline * 1e3,
        "validation": calibration.validation.model_dump() if calibration.validation else None,
        "mended": list(estimate.mended),
        "residuals": _residuals(outcome.result.residuals),
        "pictures": [view_document(view) for view in outcome.read],
        "checks": [
            {
                "name": check.name,
                "known_mm": check.known_mm,
                "measured_mm": check.measured_mm,
                "passed": check.passed,
                "text": check.text,
            }
            for check in checks
        ],
        "notes": list(calibration.notes),
    }


def camera_document(camera: "CameraCalibration") -> dict[str, Any]:
    """Parameters of one camera as JSON."""
    names = camera.lens.parameters
    values = [*camera.focal_px, *camera.centre_px, *camera.distortion]
    return {
        "name": camera.name,
        "image_size": list(camera.image_size),
        "lens": camera.lens.value,
        "views": camera.views,
        "rms_px": camera.rms_px,
        "parameters": dict(zip(names, values, strict=True)),
        "sd": dict(zip(names, _sd(camera.covariance), strict=True)),
        "estimated": list(camera.estimated),
        "covariance": [list(row) for row in camera.covariance],
    }


def mono_lines(outcome: "MonoSet") -> list[str]:
    """One camera for people."""
    result = outcome.result
    camera = result.calibration
    lines = [_camera_line(camera), *_parameter_lines(camera)]
    lines += _plain_line(result.usual_rms_px)
    if result.held_back_rms_px is not None:
        rms_px = result.held_back_rms_px
        lines.append(sentence("  views held back      {rms_px:.4f} px", rms_px=rms_px))
    lines += _residual_lines(result.residuals)
    return lines + _refused(outcome.read) + _indented(result.notes)


def stereo_lines(
    outcome: "StereoSet", checks: "Sequence[Check]", verdict: "Judgement"
) -> list[str]:
    """Two cameras for people."""
    calibration, estimate = outcome.calibration, outcome.result.estimate
    lines: list[str] = [
        sentence("calibration {id}, {board}", id=calibration.id, board=calibration.board)
    ]
    for camera, mono in zip(calibration.cameras, (estimate.left, estimate.right), strict=True):
        lines += [_camera_line(camera), *_parameter_lines(camera)]
        alone_px = mono.calibration.rms_px
        lines.append(sentence("  by itself {rms_px:.4f} px", rms_px=alone_px))
        lines += _plain_line(mono.usual_rms_px)
    sd = _sd(calibration.pose.covariance)
    x, y, z = calibration.pose.translation_mm
    lines += [
        sentence(
            "both     {rms_px:.4f} px RMS over {pairs} pairs",
            rms_px=calibration.rms_px,
            pairs=len(estimate.pairs),
        ),
        sentence(
            "  T_right_left {place} mm ± {sd}; baseline {baseline_mm:.3f} mm",
            place=f"({x:.3f}, {y:.3f}, {z:.3f})",
            sd=", ".join(f"{1e3 * value:.3f}" for value in sd[:3]),
            baseline_mm=calibration.baseline * 1e3,
        ),
    ]
    lines += _plain_line(estimate.usual_rms_px)
    lines += _validation_lines(outcome)
    lines += [
        sentence("  agrees: {check}", check=check.text)
        if check.passed
        else sentence("  CONTRADICTS: {check}", check=check.text)
        for check in checks
    ]
    if not checks:
        lines.append(
            sentence(
                "  not checked: the board's size; give --baseline-mm, or a second board "
                "(--check-images, --check-board)"
            )
        )
    lines += _residual_lines(outcome.result.residuals)
    lines += _refused(outcome.read) + _indented(calibration.notes)
    grade = verdict.grade.value
    return [*lines, sentence("verdict: {grade}: {verdict}", grade=grade, verdict=verdict.text)]


def _indented(notes: "Sequence[str]") -> list[str]:
    return [joined("", ("  ", note)) for note in notes]


def _plain_line(rms_px: float | None) -> list[str]:
    if rms_px is None:
        return []
    return [
        sentence(
            "  OpenCV's plain recipe (every view, five coefficients): {rms_px:.4f} px",
            rms_px=rms_px,
        )
    ]


def _validation_lines(result: "StereoSet") -> list[str]:
    value = result.calibration.validation
    if value is None:
        return [sentence("  not validated: no pairs were held back (--hold-back N)")]
    return [
        sentence(
            "  {views} pairs held back: corners within {rms_mm:.3f} mm RMS (at most "
            "{max_mm:.3f} mm) of the true board, lengths x {scale:.5f} ± {scale_sd:.5f}, "
            "epipolar {epipolar_px:.3f} px",
            views=value.views,
            rms_mm=value.rms_mm,
            max_mm=value.max_mm,
            scale=value.scale,
            scale_sd=value.scale_sd,
            epipolar_px=value.epipolar_px,
        )
    ]


def _camera_line(camera: "CameraCalibration") -> str:
    width, height = camera.image_size
    return sentence(
        "{name:<8} {rms_px:.4f} px RMS over {views} views of {width}x{height}",
        name=camera.name,
        rms_px=camera.rms_px,
        views=camera.views,
        width=width,
        height=height,
    )


def _parameter_lines(camera: "CameraCalibration") -> list[str]:
    document = camera_document(camera)
    return [
        f"  {name}  {value:>12.6g} ± {document['sd'][name]:.2g}"
        if name in camera.estimated
        else sentence("  {name}  {zero:>12} (not supported by the views)", name=name, zero=0)
        for name, value in document["parameters"].items()
    ]


def _residual_lines(residuals: "Sequence[ViewResidual]") -> list[str]:
    words = {"used": "", "outlier": sentence("left out"), "held_back": sentence("held back")}
    return [
        joined("  ", (f"  {r.name:<32} {r.rms_px:7.3f} px", *filter(None, (words[r.role],))))
        for r in residuals
    ]


def _refused(looked: "Sequence[Seen]") -> list[str]:
    from app.tracking.calibration.views import Rejection

    return [
        sentence("  {name:<32} not used: {reason}", name=v.name, reason=v.text)
        for v in looked
        if isinstance(v, Rejection)
    ]


def _residuals(residuals: "Sequence[ViewResidual]") -> list[dict[str, Any]]:
    return [{"name": r.name, "rms_px": r.rms_px, "role": r.role} for r in residuals]


def _lens_alone(mono: "MonoResult") -> dict[str, Any]:
    return {
        "alone_rms_px": mono.calibration.rms_px,
        "opencv_rms_px": mono.usual_rms_px,
        "dropped": [{"name": d.name, "value": d.value, "sd": d.sd} for d in mono.dropped],
    }


def _sd(covariance: Sequence[Sequence[float]]) -> list[float]:
    return [max(row[i], 0.0) ** 0.5 for i, row in enumerate(covariance)]
