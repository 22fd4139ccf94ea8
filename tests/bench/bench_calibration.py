"""Calibration of two cameras from 30 pairs 640x480 on disk, beside OpenCV's plain recipe.

Both read the same rendered pictures (noise of 3 grey levels, blur 0.7 px) whose truth is known; the
plain recipe is findChessboardCorners, an 11 px sub-pixel window, five coefficients, stereoCalibrate
with fixed lenses. To reach: 10 s for 30 pictures. Run as `python -m tests.bench.bench_calibration`.
"""

import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np

from app.core.transform import RigidTransform
from app.tracking.calibration.pairing import Pair, pair_folder
from app.tracking.calibration.sets import stereo_set
from app.tracking.simulated.board import BoardRenderer
from tests.tracking.calibration_rig import Rig, usual_rig

COUNT = 30
TO_REACH = 10.0


def draw(rig: Rig, folder: Path) -> list[Pair]:
    rng = np.random.default_rng(4)
    for i, T in enumerate(rig.poses(COUNT, 11)):
        for camera in (rig.left, rig.right):
            image = BoardRenderer(camera, rig.board, 2).render(
                camera.T_camera_world @ T, 0.7, 3.0, rng
            )
            cv2.imwrite(str(folder / f"{camera.name}{i:02d}.png"), image)
    return list(pair_folder(folder).pairs)


def ours(pairs: list[Pair], rig: Rig) -> RigidTransform:
    return stereo_set(pairs, rig.board).calibration.pose.transform


def plain(pairs: list[Pair], rig: Rig) -> RigidTransform:
    size = (rig.board.columns, rig.board.rows)
    found: list[list[np.ndarray]] = [[], []]
    for pair in pairs:
        both = []
        for path in (pair.left, pair.right):
            grey = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)
            ok, corners = cv2.findChessboardCorners(grey, size)
            if ok:
                stop = (cv2.TERM_CRITERIA_EPS | cv2.TERM_CRITERIA_MAX_ITER, 100, 1e-3)
                both.append(cv2.cornerSubPix(grey, corners, (11, 11), (-1, -1), stop))
        if len(both) == 2:
            for side in (0, 1):
                found[side].append(both[side])
    points = [rig.board.points.astype(np.float32)] * len(found[0])
    shape = rig.left.image_size
    left, right = (cv2.calibrateCamera(points, side, shape, None, None) for side in found)
    result = cv2.stereoCalibrate(
        points, *found, left[1], left[2], right[1], right[2], shape, flags=cv2.CALIB_FIX_INTRINSIC
    )
    return RigidTransform(result[5], result[6].ravel())


def measure(
    label: str, work: Callable[[list[Pair], Rig], RigidTransform], pairs: list[Pair], rig: Rig
) -> tuple[float, float]:
    """Seconds of the clock, and error of the baseline [mm]."""
    start, busy = time.perf_counter(), time.process_time()
    pose = work(pairs, rig)
    seconds, busy = time.perf_counter() - start, time.process_time() - busy
    error = float(np.linalg.norm((pose @ rig.T_right_left.inverse()).log()[:3])) * 1e3
    print(f"  {label:<16} {seconds:6.2f} s (processor {busy:6.2f} s)   pose off by {error:.3f} mm")
    return seconds, error


def main() -> None:
    rig = usual_rig()
    with tempfile.TemporaryDirectory() as folder:
        pairs = draw(rig, Path(folder))
        print(f"{2 * len(pairs)} pictures 640x480 (to reach: {TO_REACH:g} s for 30)")
        seconds, error = measure("acus", ours, pairs, rig)
        peer_seconds, peer_error = measure("plain OpenCV", plain, pairs, rig)
    print(
        f"  {seconds / peer_seconds:.1f} times the time, error divided by {peer_error / error:.1f}"
    )


if __name__ == "__main__":
    main()
