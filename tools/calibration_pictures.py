"""Makes the pictures of the calibration wizard in the user guide; part of `make docs-pictures`.

`python -m tools.calibration_pictures FOLDER` needs no camera: rendered pictures of a board before
the cameras of the rig `wide` stand in, and go through the wizard from the board to its place.
"""

import os
import sys
import tempfile
from pathlib import Path

import cv2
import numpy as np
from PySide6.QtWidgets import QApplication

from app.core.transform import RigidTransform
from app.mechanisms.profile import load_profile
from app.tracking.calibration.boards import Board, parse_board
from app.tracking.calibration.job import CalibrationJob
from app.tracking.calibration.placed_board import place
from app.tracking.optics.rig import load_rig
from app.tracking.simulated.board import BoardRenderer
from app.views.cameras.wizard import CalibrationWizard
from app.views.shell.application import start
from tools.robot_pictures import keep, pause, wait

BOARD = "charuco:9x6:11mm:8mm:DICT_5X5_100"
AT = (-45.0, 185.0, 10.0, 105.0, 0.0, 0.0)
PAIRS = 16


def poses(board: Board) -> list[RigidTransform]:
    """Places of the board in world: at the needle, turned to both cameras."""
    rng, found = np.random.default_rng(3), []
    middle = RigidTransform.from_translation(-board.points.mean(axis=0))
    upright = RigidTransform.from_rotation(place(0.0, 0.0, 0.0, 105.0).rotation)
    for _ in range(PAIRS):
        shift = rng.uniform([-0.03, 0.12, 0.03], [0.03, 0.25, 0.07])
        turn = np.radians([*rng.uniform(-16.0, 16.0, 2), rng.uniform(-60.0, 60.0)])
        at, turned = RigidTransform.from_translation(shift), RigidTransform.exp([0, 0, 0, *turn])
        found.append(at @ upright @ turned @ middle)
    return found


def render(folder: Path, board: Board, places: list[RigidTransform]) -> None:
    """Write the pairs."""
    folder.mkdir()
    rng = np.random.default_rng(4)
    for number, T_world_board in enumerate(places):
        for model in load_rig("wide").models:
            T_camera_board = model.T_camera_world @ T_world_board
            image = BoardRenderer(model, board).render(T_camera_board, rng=rng)
            cv2.imwrite(str(folder / f"{model.name}{number + 1:02}.png"), image)


def main(folder: Path) -> None:
    """Make them all."""
    folder, board = folder.resolve(), parse_board(BOARD)
    application = start(offscreen=True)
    with tempfile.TemporaryDirectory() as scratch:
        os.chdir(scratch)
        pairs, place_of_board = Path("pairs"), Path("place")
        render(pairs, board, poses(board))
        render(place_of_board, board, [place(*AT)])
        watched = load_profile("icube").fulcrum[None, :]
        wizard = CalibrationWizard(CalibrationJob(board=board, watched=watched))
        wizard.resize(980, 640)
        wizard.show()
        pause(0.5)
        keep(wizard, folder / "calibration-board.png")
        wizard.show_page(1)
        wizard.capture_page.begin_folder(pairs)
        wait(lambda: not wizard.capture_page.running)
        pause(0.5)
        keep(wizard, folder / "calibration-pictures.png")
        wizard.show_page(2)
        wait(lambda: not wizard.result_page.running)
        pause(0.5)
        keep(wizard, folder / "calibration-result.png")
        wizard.show_page(3)
        for field, value in zip(wizard.world_page.fields, AT, strict=True):
            field.setValue(value)
        wizard.world_page.begin_folder(place_of_board)
        wait(lambda: not wizard.world_page.running)
        pause(0.5)
        keep(wizard, folder / "calibration-place.png")
        wizard.done(0)  # not reject(): it would ask about what is not saved
    QApplication.processEvents()
    application.quit()


if __name__ == "__main__":
    main(Path(sys.argv[1]))
