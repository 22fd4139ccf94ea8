"""`acus calibrate world`: the world frame from a board at a known place."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from app.commands.answer import Answer
from app.commands.calibrate_parts import BoardSpec, app, with_progress

if TYPE_CHECKING:
    from collections.abc import Sequence

    from app.core.transform import RigidTransform
    from app.tracking.calibration.views import Rejection
    from app.tracking.calibration.world import WorldFrame
    from app.tracking.optics.calibration import StereoCalibration

PLACE = "x,y,z[,rx,ry,rz]"


@app.command("world")
def world(
    images: Annotated[
        list[Path],
        typer.Option("--images", metavar="DIR", help="Pairs of pictures of the board at a place."),
    ],
    at: Annotated[
        list[str],
        typer.Option(
            "--at",
            metavar=PLACE,
            help="The place: first inner corner [mm, world], turns about world x, y, z [deg] "
            "(180,0,0: print up, columns along x). Once for each --images.",
        ),
    ],
    board: BoardSpec = "charuco:9x6:20mm:15mm:DICT_5X5_100",
    calibration_id: Annotated[
        str | None, typer.Option("--calibration", metavar="ID", help="Default: the one in use.")
    ] = None,
    rig: Annotated[
        str | None,
        typer.Option(help="Rig whose cameras stand roughly so: for boards that look the same."),
    ] = None,
    sd_mm: Annotated[
        float, typer.Option(min=0.001, max=50.0, help="How exactly the board lies, per axis.")
    ] = 0.3,
    sd_deg: Annotated[
        float, typer.Option(min=0.001, max=20.0, help="The same of its direction.")
    ] = 0.15,
    keep: Annotated[
        bool, typer.Option("--keep", help="Keep it in the history and use it from now on.")
    ] = False,
) -> Answer:
    """Find where the cameras stand. In the robot's frame, from a board at known places."""
    from app.mechanisms.profile import load_profile
    from app.tracking.calibration.boards import parse_board
    from app.tracking.calibration.history import CalibrationHistory
    from app.tracking.calibration.placed_pictures import placed_boards
    from app.tracking.calibration.views import Rejection
    from app.tracking.calibration.world import find_world, with_world
    from app.tracking.optics.rig import load_rig

    known = parse_board(board)
    places = [place_of(text) for text in at]
    history = CalibrationHistory()
    calibration = _calibration(history, calibration_id)
    expected = load_rig(rig).models[0].T_world_camera if rig is not None else None
    boards, looked = with_progress(lambda progress: placed_boards(images, places, known, progress))
    frame = find_world(
        calibration,
        boards,
        place_sd_mm=sd_mm,
        place_sd_deg=sd_deg,
        watched=load_profile("icube").pantograph.fulcrum[None, :],
        expected=expected,
    )
    placed = with_world(calibration, frame, known.spec)
    if keep:
        history.keep(placed)
    refused = [view for view in looked if isinstance(view, Rejection)]
    last = f"in use from now on: {placed.id}" if keep else "not kept: add --keep to use it"
    return Answer(
        world_document(placed, frame, refused) | {"kept": keep},
        [*world_lines(placed, frame, refused), last],
    )


def place_of(text: str) -> "RigidTransform":
    """Read a board's place.

    Raises:
        CalibrationError: if it is not three or six finite numbers.
    """
    from math import isfinite

    from app.tracking.calibration.placed_board import place
    from app.tracking.errors import CalibrationError

    try:
        numbers = [float(part) for part in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) not in (3, 6) or not all(isfinite(number) for number in numbers):
        raise CalibrationError(
            f"--at {text!r} is not {PLACE}: millimetres and degrees, e.g. -60,180,90,180,0,0"
        )
    return place(*numbers)


def world_document(
    placed: "StereoCalibration", frame: "WorldFrame", refused: "Sequence[Rejection]"
) -> dict[str, Any]:
    """Return the result as JSON."""
    sd = [frame.pose.covariance[i][i] ** 0.5 for i in range(6)]
    return {
        "id": placed.id,
        "T_world_left": frame.pose.model_dump(mode="json"),
        "sd_mm": [value * 1e3 for value in sd[:3]],
        "sd_rad": sd[3:],
        "camera_centres_mm": {
            camera.name: (centre * 1e3).tolist()
            for camera, centre in zip(placed.cameras, frame.centres, strict=True)
        },
        "rms_px": frame.rms_px,
        "pictures": [{"name": name, "rms_px": rms} for name, rms in frame.by_picture],
        "refused": [{"name": view.name, "text": view.text} for view in refused],
        "scale": frame.scale,
        "scale_sd": frame.scale_sd,
        "disagreement_mm": frame.disagreement_mm,
        "fulcrum_sd_mm": frame.watched_sd_mm,
        "remarks": list(frame.remarks),
    }


def world_lines(
    placed: "StereoCalibration", frame: "WorldFrame", refused: "Sequence[Rejection]"
) -> list[str]:
    """Return the result for people."""
    lines = [
        f"{camera.name:13} stands at {x:8.1f} {y:8.1f} {z:8.1f} mm"
        for camera, (x, y, z) in zip(placed.cameras, frame.centres * 1e3, strict=True)
    ]
    lines.append(f"{'residual':13} {frame.rms_px:.3f} px in {len(frame.by_picture)} pictures")
    if frame.scale is not None:
        lines.append(f"{'scale':13} {frame.scale:.5f} ± {frame.scale_sd:.5f} of the board's size")
    if frame.watched_sd_mm is not None:
        lines.append(
            f"{'fulcrum':13} sure to ± {frame.watched_sd_mm:.2f} mm (standard deviation per axis)"
        )
    if frame.disagreement_mm > 0.0:
        lines.append(f"{'places':13} agree within {frame.disagreement_mm:.2f} mm")
    lines += [f"{'look at':13} {remark}" for remark in frame.remarks]
    return lines + [f"{'not used':13} {view.name}: {view.text}" for view in refused]


def _calibration(history: Any, calibration_id: str | None) -> "StereoCalibration":
    from app.tracking.errors import CalibrationError

    if calibration_id is not None:
        found: StereoCalibration = history.load(history.find(calibration_id).id)
        return found
    active: StereoCalibration | None = history.active()
    if active is None:
        raise CalibrationError(
            "no calibration is in use: run `acus calibrate stereo --keep` first, or name one with "
            "--calibration"
        )
    return active
