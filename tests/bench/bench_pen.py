"""The pen: time for a picture and error of the tip, beside plain OpenCV in the same run.

Plain OpenCV is what a reader of its tutorials writes: `ArucoDetector` with sub-pixel corners, one
`solvePnP` over all corners of the cube and one over those of the sheet, the tip by both poses.
Pictures are rendered with an exact print, noise of 4 grey levels; a pen is rocked and pushed in.
Run as `python -m tests.bench.bench_pen [pictures]` (60 by default).
"""

import sys
import time

import cv2
import numpy as np

from app.core.arrays import unit
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.mechanisms.profile import load_profile
from app.studies.pen import Setup
from app.tracking.cameras.camera import CameraFrame
from app.tracking.optics.calibration import CameraCalibration
from app.tracking.pen.board import MarkerBoard, aruco_dictionary
from app.tracking.pen.needle import PenTip
from app.tracking.pen.step import PenStep
from app.tracking.pen.webcam import Webcam
from app.tracking.simulated.pen import PenRenderer
from app.tracking.simulated.pen_scene import PenScene, body_pose

ENTRY = load_profile("icube").fulcrum
RATE = 30.0
LOST = 0.02
"""Error of the tip [m] from which an answer is a wrong one, not an inaccurate one."""


class Plain:
    """Markers, corners and poses by OpenCV alone."""

    def __init__(self, model, body: MarkerBoard, base: MarkerBoard, T_world_base, tip: PenTip):
        parameters = cv2.aruco.DetectorParameters()
        parameters.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
        self._detector = cv2.aruco.ArucoDetector(aruco_dictionary(body.dictionary), parameters)
        fx, fy, cx, cy = model.intrinsics
        self._matrix = np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])
        self._distortion, self._boards = model.distortion, (body, base)
        self._T_world_base, self._tip = T_world_base, tip

    def look(self, image):
        """Tip in world [m]; None without both boards."""
        corners, ids, _ = self._detector.detectMarkers(image)
        if ids is None:
            return None
        seen = dict(zip(np.ravel(ids).tolist(), corners, strict=True))
        poses = [self._pose(board, seen) for board in self._boards]
        if None in poses:
            return None
        body, base = poses
        return self._T_world_base @ base.inverse() @ body @ self._tip.p_tip

    def _pose(self, board, seen):
        pairs = [(m.corners, seen[m.id].reshape(4, 2)) for m in board.markers if m.id in seen]
        if not pairs:
            return None
        points, pixels = (np.concatenate(part) for part in zip(*pairs, strict=True))
        found, turn, shift = cv2.solvePnP(points, pixels, self._matrix, self._distortion)
        return RigidTransform(cv2.Rodrigues(turn)[0], shift.ravel()) if found else None


def pictures(setup: Setup, count: int):
    """Pictures of a pen on its way in, and its true tips."""
    pen, model, rng = setup.pen(), setup.camera(), np.random.default_rng(3)
    draw = PenRenderer(
        model, pen.body.board(), pen.base.board(), pen.base.pose(ENTRY), setup.edge_mm * MILLIMETRE
    )
    tip, frames, tips = PenTip.of(pen.tip), [], []
    for number in range(count):
        s = number / RATE
        axis = unit([0.25 * np.sin(1.1 * s), 0.1 + 0.2 * np.cos(0.7 * s), -1.0])
        p_tip = ENTRY + (0.08 * number / count) * axis
        image = draw.render(
            PenScene(body_pose(p_tip, axis, tip.p_tip, tip.axis, 1.0), p_tip)
        ).astype(np.float64)
        image += rng.normal(0.0, setup.noise, image.shape[:2])[..., None]
        frames.append(CameraFrame(np.clip(np.rint(image), 0, 255).astype(np.uint8), 1.0 + s))
        tips.append(p_tip)
    return frames, tips


def timed(look, frames):
    """Median time for a picture [ms] and the tips found."""
    times, found = [], []
    for frame in frames:
        begin = time.thread_time()
        found.append(look(frame))
        times.append(1e3 * (time.thread_time() - begin))
    return float(np.median(times)), found


def told(name: str, span: float, result, tips) -> None:
    """One line."""
    errors = [
        float(np.linalg.norm(tip - true)) / MILLIMETRE
        for tip, true in zip(result, tips, strict=True)
        if tip is not None
    ]
    wrong = sum(error > LOST / MILLIMETRE for error in errors)
    fair = [error for error in errors if error <= LOST / MILLIMETRE] or [float("nan")]
    rms, most = float(np.sqrt(np.mean(np.square(fair)))), float(np.percentile(fair, 95))
    print(
        f"  {name:<26} {span:6.2f} ms   tip RMS {rms:5.2f} mm, 95 % {most:5.2f} mm   "
        f"answered {len(errors)} of {len(tips)}, wrong by 20 mm and more {wrong}"
    )


def compare(setup: Setup, count: int) -> None:
    """Both ways on the same pictures."""
    frames, tips = pictures(setup, count)
    pen, model = setup.pen(), setup.camera()
    lens = Webcam(CameraCalibration(
        name=model.name, image_size=model.image_size, focal_px=tuple(model.intrinsics[:2]),
        centre_px=tuple(model.intrinsics[2:]), distortion=tuple(model.distortion),
    ))  # fmt: skip
    plain = Plain(model, pen.body.board(), pen.base.board(), pen.base.pose(ENTRY),
                  PenTip.of(pen.tip))  # fmt: skip
    known = PenStep(pen, lens, ENTRY)

    def stepped(frame):
        needle = known.observe(frame).needle
        return None if needle is None else needle.p_tip

    # Pictures a second apart remember nothing of each other: each is searched as a whole.
    apart = [CameraFrame(frame.image, 100.0 + number) for number, frame in enumerate(frames)]
    stepped(frames[0]), plain.look(frames[0].image)  # load the kernels
    print(f"{setup.width}x{setup.height}, cube of {setup.edge_mm:g} mm at {setup.distance:g} m")
    by_plain, tips_plain = timed(lambda frame: plain.look(frame.image), frames)
    told("OpenCV alone", by_plain, tips_plain, tips)
    by_step, tips_step = timed(stepped, frames)
    told("Acus, following", by_step, tips_step, tips)
    by_search, tips_search = timed(stepped, apart)
    told("Acus, searching", by_search, tips_search, tips)
    print(f"  OpenCV's time over Acus': {by_plain / by_step:.1f} following, "
          f"{by_plain / by_search:.1f} searching")  # fmt: skip


def main() -> None:
    """Both sizes."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 60
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)  # one core each: the time of this thread is all of it
    print(f"median processor time of one picture, {count} pictures, one core")
    compare(Setup(), count)
    compare(Setup(width=1280, height=720), count)
    cv2.setNumThreads(threads)


if __name__ == "__main__":
    main()
