"""`acus calibrate mono`, `stereo` and `views`: pictures in, calibration out; `world`: the world
frame from a board at a known place.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from app.commands.answer import Answer
from app.commands.calibrate_parts import (
    BoardSpec,
    LensName,
    app,
    lens_named,
    mono_document,
    mono_lines,
    region_of,
    stereo_document,
    stereo_lines,
    view_document,
    view_line,
    with_progress,
)
from app.commands.calibrate_parts import Images as Folder
from app.commands.reader_language import tell, template
from app.commands.shown import Each
from app.core.messages import sentence

if TYPE_CHECKING:
    from collections.abc import Sequence

    from app.core.progress import Progress
    from app.core.transform import RigidTransform
    from app.tracking.calibration.boards import Board
    from app.tracking.calibration.checks import Check
    from app.tracking.calibration.pairing import Pair, Paired
    from app.tracking.calibration.sets import MonoSet, StereoSet
    from app.tracking.calibration.views import Rejection
    from app.tracking.calibration.world import WorldFrame
    from app.tracking.optics.calibration import StereoCalibration


POSE = "x,y,z[,rx,ry,rz]"


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
            metavar=POSE,
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
        watched=load_profile("icube").fulcrum[None, :],
        expected=expected,
    )
    placed = with_world(calibration, frame, known.spec)
    if keep:
        history.keep(placed)
    refused = [view for view in looked if isinstance(view, Rejection)]
    agree = template("places        agree within {disagreement_mm:.2f} mm")
    return Answer(
        world_document(placed, frame, refused) | {"kept": keep},
        shown=(
            Each(
                "camera_centres_mm",
                template("{key:13} stands at {value.0:8.1f} {value.1:8.1f} {value.2:8.1f} mm"),
            ),
            template("residual      {rms_px:.3f} px in {pictures:#} pictures"),
            template("{scale:?scale         {scale:.5f} ± {scale_sd:.5f} of the board's size}"),
            template(
                "{fulcrum_sd_mm:?fulcrum       sure to ± {fulcrum_sd_mm:.2f} mm "
                "(standard deviation per axis)}"
            ),
            agree if frame.disagreement_mm > 0.0 else "",
            Each("remarks", template("look at       {}")),
            Each("refused", template("not used      {name}: {text}")),
            template("{kept:?in use from now on: {id}|not kept: add --keep to use it}"),
        ),
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
            sentence(
                "--at {place!r} is not {pose}: millimetres and degrees, e.g. -60,180,90,180,0,0",
                place=text,
                pose=POSE,
            )
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


def _calibration(history: Any, calibration_id: str | None) -> "StereoCalibration":
    from app.tracking.errors import CalibrationError

    if calibration_id is not None:
        found: StereoCalibration = history.load(history.find(calibration_id).id)
        return found
    active: StereoCalibration | None = history.active()
    if active is None:
        raise CalibrationError(
            sentence(
                "no calibration is in use: run `acus calibrate stereo --keep` first, or name one "
                "with --calibration"
            )
        )
    return active


DEFAULT = "charuco:9x6:20mm:15mm:DICT_5X5_100"
Images = Annotated[
    Path | None, typer.Option("--images", metavar="DIR", help="Folder of the pictures.")
]
HoldBack = Annotated[
    int | None,
    typer.Option("--hold-back", min=0, help="Views held back for validation; 0: none."),
]
Window = Annotated[
    int | None,
    typer.Option(min=1, max=50, help="Half the sub-pixel window [px], to compare; else chosen."),
]
Out = Annotated[Path | None, typer.Option("--out", metavar="FILE", help="Write the YAML here.")]


RANK = 140


def register(root: typer.Typer) -> None:
    """Add `calibrate` to the command line, with the commands of its other files."""
    from app.commands import calibrate_history  # noqa: F401

    root.add_typer(app, name="calibrate")


@app.command("mono")
def mono(
    images: Images = None,
    board: BoardSpec = DEFAULT,
    hold_back: HoldBack = None,
    window: Window = None,
    out: Out = None,
    lens: LensName = None,
) -> Answer:
    """Calibrate one camera, or each of two by itself.

    Of two, their names stand in the pictures' names.

    With --out one camera's lens is written, as `acus pen calibrate --lens` and `pen.yaml` take it.
    """
    from app.core.errors import ConfigurationError
    from app.tracking.calibration.boards import parse_board
    from app.tracking.calibration.formats.own import save_camera
    from app.tracking.calibration.pairing import cameras_of
    from app.tracking.calibration.pictures import list_pictures
    from app.tracking.calibration.sets import mono_set

    known, model = parse_board(board), lens_named(lens)
    groups, strays = cameras_of(list_pictures(_folder(images)))

    def work(progress: "Progress") -> "list[MonoSet]":
        share = 1.0 / len(groups)
        return [
            mono_set(
                name,
                paths,
                known,
                hold_back,
                window,
                progress.part(i * share, (i + 1) * share),
                model,
            )
            for i, (name, paths) in enumerate(groups.items())
        ]

    for path in strays:
        tell(
            sentence("skipped: {name}: its name says none of the two cameras", name=path.name),
            err=True,
        )
    if out is not None and len(groups) != 1:
        raise ConfigurationError(
            sentence(
                "--out takes the lens of one camera; these pictures are of {groups}: "
                "give a folder for each, or use `acus calibrate stereo`",
                groups=", ".join(groups),
            )
        )
    found = with_progress(work)
    if out is not None:
        save_camera(out, found[0].result.calibration)
        tell(sentence("wrote {file}", file=out), err=True)
    facts = {"board": known.spec, "cameras": [mono_document(one) for one in found]}
    return Answer(facts, [line for one in found for line in mono_lines(one)])


@app.command("stereo")
def stereo(
    images: Images = None,
    board: BoardSpec = DEFAULT,
    left: Annotated[
        str | None, typer.Option(metavar="DIR|GLOB", help="Left pictures, in place of --images.")
    ] = None,
    right: Annotated[str | None, typer.Option(metavar="DIR|GLOB", help="Right pictures.")] = None,
    left_alone: Annotated[
        str | None,
        typer.Option(
            metavar="DIR|GLOB", help="More left pictures, of no pair: they help the left lens."
        ),
    ] = None,
    right_alone: Annotated[
        str | None, typer.Option(metavar="DIR|GLOB", help="More right pictures, of no pair.")
    ] = None,
    hold_back: HoldBack = None,
    names: Annotated[str, typer.Option(help="The cameras' names in the rig.")] = "left,right",
    baseline_mm: Annotated[
        float | None,
        typer.Option(min=0.1, help="Distance of the cameras by ruler [mm]: checks the board."),
    ] = None,
    check_images: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Pairs of a second board: checks the first.")
    ] = None,
    check_board: Annotated[
        str | None, typer.Option(metavar="SPEC", help="The second board.")
    ] = None,
    window: Window = None,
    out: Out = None,
    keep: Annotated[
        bool, typer.Option("--keep", help="Keep it in the history and use it from now on.")
    ] = False,
    force: Annotated[
        bool, typer.Option("--force", help="Write and keep it even if it is not good enough.")
    ] = False,
    rig: Annotated[
        str | None,
        typer.Option(help="Rig they are for: the verdict asks where its marker comes."),
    ] = None,
    lens: LensName = None,
) -> Answer:
    """Calibrate two cameras from pairs of pictures. Validated on pairs held back.

    Pictures are paired by name (docs/calibration.md): left01.png with right01.png, camera0_3.png
    with camera1_3.png; one without a partner helps its own lens. A known baseline or a second board
    contradicts a wrong board size. Exit code 3: it is not good enough, nothing was written or kept.
    """
    from app.tracking.calibration.boards import parse_board
    from app.tracking.calibration.sets import stereo_set
    from app.tracking.calibration.verdict import Grade, judge

    known, model = parse_board(board), lens_named(lens)
    second = _second(check_images, check_board)
    paired = _paired(images, left, right)
    both = _names(names)
    alone = _alone(paired, left_alone, right_alone)
    found = with_progress(
        lambda progress: stereo_set(
            paired.pairs, known, both, hold_back, window, progress, alone=alone, lens=model
        )
    )
    checks = _checks(found, baseline_mm, second)
    region = None if rig is None else region_of(rig, found.calibration)
    verdict = judge(found.calibration, checks, region)
    facts = stereo_document(found, checks, verdict) | {"remarks": paired.remarks}
    lines = [*stereo_lines(found, checks, verdict), *(f"  {line}" for line in paired.remarks)]
    if verdict.grade is Grade.NOT_GOOD_ENOUGH and not force:
        if out is not None or keep:
            tell(sentence("not written and not kept; --force does it all the same"), err=True)
        return Answer(facts, lines, yes=False)
    _write(found, out, keep)
    return Answer(facts, lines, yes=True)


@app.command("views")
def list_views(
    images: Folder,
    board: BoardSpec = "charuco:9x6:20mm:15mm:DICT_5X5_100",
) -> Answer:
    """Say of every picture whether it can be used. Or why it cannot."""
    from app.tracking.calibration.boards import parse_board
    from app.tracking.calibration.pictures import list_pictures, read_views

    known = parse_board(board)
    paths = list_pictures(images)
    found = with_progress(lambda progress: read_views(paths, known, progress))
    facts = {"board": known.spec, "views": [view_document(view) for view in found]}
    return Answer(facts, [view_line(view) for view in found])


def _folder(images: Path | None) -> Path:
    from app.core.errors import ConfigurationError

    if images is None:
        raise ConfigurationError(sentence("name the folder of the pictures: --images DIR"))
    return images


def _alone(paired: "Paired", left: str | None, right: str | None) -> tuple[list[Path], list[Path]]:
    from app.tracking.calibration.pictures import list_matching

    first, second = (
        [*lone, *(list_matching(text) if text is not None else ())]
        for lone, text in zip(paired.alone, (left, right), strict=True)
    )
    return first, second


def _paired(images: Path | None, left: str | None, right: str | None) -> "Paired":
    from app.core.errors import ConfigurationError
    from app.tracking.calibration.pairing import pair_folder, pair_folders
    from app.tracking.calibration.pictures import list_matching

    if (left is None) != (right is None) or (images is None) == (left is None):
        raise ConfigurationError(
            sentence("name the pictures: either --images DIR, or --left and --right")
        )
    if left is not None and right is not None:
        return pair_folders(list_matching(left), list_matching(right))
    return pair_folder(_folder(images))


def _second(images: Path | None, spec: str | None) -> "tuple[Sequence[Pair], Board] | None":
    from app.core.errors import ConfigurationError
    from app.tracking.calibration.boards import parse_board
    from app.tracking.calibration.pairing import pair_folder

    if (images is None) != (spec is None):
        raise ConfigurationError(
            sentence("--check-images DIR and --check-board SPEC go together; give both")
        )
    return (
        None if images is None or spec is None else (pair_folder(images).pairs, parse_board(spec))
    )


def _names(text: str) -> tuple[str, str]:
    from app.core.errors import ConfigurationError

    parts = [part.strip() for part in text.split(",")]
    if len(parts) != 2 or not all(parts) or parts[0] == parts[1]:
        raise ConfigurationError(
            sentence("--names {names!r} is not two names, e.g. left,right", names=text)
        )
    return parts[0], parts[1]


def _checks(
    outcome: "StereoSet", baseline_mm: float | None, second: "tuple[Sequence[Pair], Board] | None"
) -> "list[Check]":
    from app.tracking.calibration.checks import check_baseline, check_second_board
    from app.tracking.calibration.sets import seen_by_both

    checks = []
    if baseline_mm is not None:
        checks.append(check_baseline(outcome.calibration, baseline_mm))
    if second is not None:
        pairs = seen_by_both(*second, outcome.result.estimate)
        checks.append(check_second_board(outcome.calibration, pairs))
    return checks


def _write(result: "StereoSet", out: Path | None, keep: bool) -> None:
    from app.tracking.calibration.formats.own import save_calibration
    from app.tracking.calibration.history import CalibrationHistory

    if out is not None:
        save_calibration(out, result.calibration)
        tell(sentence("wrote {file}", file=out), err=True)
    if keep:
        kept = CalibrationHistory().keep(result.calibration)
        tell(sentence("kept {file}", file=kept), err=True)
