"""Tracker against the thesis' extractor: stereo pairs a second on one core, and error of the tip.

All get the same rendered pictures (640x480 and 1280x720, 4 grey levels of noise). To reach at
1280x720: 3 ms a pair when following, 12 ms when searching, 5 times the thesis' speed. A
pair is: marker in both pictures, undistortion, triangulation, covariance, consistency; rendering is
not timed. Processor time is that of the thread; ratios are medians over pairs of pictures that the
ways took in turn. Run as `python -m tests.bench.bench_tracker`.
"""

import os
import time
from dataclasses import dataclass, field

import cv2
import numpy as np

from app.core.clock import VirtualClock
from app.tracking.cameras.camera import CameraFrame
from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.markers.choice import ExtractorName, extractors
from app.tracking.markers.extractor import Extractor
from app.tracking.markers.thesis import ThesisMarker
from app.tracking.optics.rig import RigProfile, load_rig
from app.tracking.simulated.cameras import NeedleRenderer, simulated_cameras
from app.tracking.simulated.picture_effects import NoiseTile, noise
from app.tracking.simulated.scene import MarkerScene
from app.tracking.tracker import Tracker

FULCRUM = np.array([0.0, 0.16056, 0.090])
COUNT = 100

THESIS = "thesis' extractor"

Ways = dict[str, tuple[Extractor, Extractor]]
Shot = tuple[CameraFrame, CameraFrame, np.ndarray, np.ndarray]  # pictures, tip, axis


def pin_to_one_core() -> None:
    cv2.setNumThreads(1)
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


def everywhere(rig: RigProfile, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """A tip and an axis, uniform in the rig's declared depth and tilt."""
    depth = rng.uniform(rig.range.depth_min_mm, rig.range.depth_max_mm) * 1e-3
    tilt, azimuth = np.deg2rad(rng.uniform(0.0, rig.range.tilt_max_deg)), rng.uniform(0, 2 * np.pi)
    across = np.sin(tilt)
    axis = np.array([across * np.cos(azimuth), across * np.sin(azimuth), -np.cos(tilt)])
    return FULCRUM + depth * axis, axis


def along(step: int) -> tuple[np.ndarray, np.ndarray]:
    """A needle being inserted and turned: what the tracker follows from picture to picture."""
    t = step / 30.0
    tilt, azimuth = 0.4, 0.7 * t
    across = np.sin(tilt)
    axis = np.array([across * np.cos(azimuth), across * np.sin(azimuth), -np.cos(tilt)])
    return FULCRUM + (0.055 + 0.05 * np.sin(t)) * axis, axis


def shoot(rig: RigProfile, poses: list[tuple[np.ndarray, np.ndarray]]) -> list[Shot]:
    rng = np.random.default_rng(2)
    renderers = [NeedleRenderer(m, rig.needle, rig.blur_px, i) for i, m in enumerate(rig.models)]
    tiles = [NoiseTile.make(m.image_size, rig.noise_grey, i) for i, m in enumerate(rig.models)]
    shots = []
    for step, (tip, axis) in enumerate(poses):
        scene = MarkerScene.from_tip(tip, axis, rig.needle.marker_offset)
        if not all(model.sees(scene.p_world, 20.0)[0] for model in rig.models):
            continue  # the figure is for where both cameras see it
        left, right = (
            CameraFrame(noise(renderer.render(scene), tile, rng), step / 30.0)
            for renderer, tile in zip(renderers, tiles, strict=True)
        )
        shots.append((left, right, tip, axis))
    return shots


@dataclass
class Result:
    """Of one way: wall and processor time of every pair [s], and the fixes."""

    wall: list[float] = field(default_factory=list)
    processor: list[float] = field(default_factory=list)
    fixes: list[NeedleFix] = field(default_factory=list)


def run(rig: RigProfile, shots: list[Shot], ways: Ways, fresh: bool) -> dict[str, Result]:
    """Every pair by every way in turn, so that what else the machine does slows all alike.

    `fresh` starts a new tracker for every pair (no memory).
    """
    holder, clock = {"axis": shots[0][3]}, VirtualClock()
    cameras = simulated_cameras(rig, lambda t: None, clock)

    def new(both: tuple[Extractor, Extractor]) -> Tracker:
        return Tracker(cameras, rig, clock, lambda t: holder["axis"], FULCRUM, extractors=both)

    trackers = {name: new(both) for name, both in ways.items()}
    for tracker in trackers.values():
        tracker.process(shots[0][0], shots[0][1])  # kernels loaded
    results = {name: Result() for name in ways}
    for left, right, _, axis in shots:
        holder["axis"] = axis
        for name, result in results.items():
            tracker = new(ways[name]) if fresh else trackers[name]
            wall, processor = time.perf_counter(), time.thread_time()
            result.fixes.append(tracker.process(left, right))
            result.processor.append(time.thread_time() - processor)
            result.wall.append(time.perf_counter() - wall)
    return results


def report_error(label: str, shots: list[Shot], fixes: list[NeedleFix]) -> None:
    errors = np.array(
        [
            np.linalg.norm(fix.p_tip_world - tip) * 1e3
            for fix, (_, _, tip, _) in zip(fixes, shots, strict=True)
            if fix.has_point
        ]
    )
    valid = np.mean([fix.status is FixStatus.VALID for fix in fixes])
    if not errors.size:
        print(f"  {label:<28} nothing found")
        return
    rms = float(np.sqrt(np.mean(errors**2)))
    print(
        f"  {label:<28} RMS {rms:.3f} mm   median {np.median(errors):.3f}   "
        f"p99 {np.percentile(errors, 99):.3f}   found {errors.size}/{len(shots)}   "
        f"valid {valid:.0%}"
    )


def report_rate(label: str, result: Result, peer: Result) -> None:
    wall, processor = (1e3 * np.array(times) for times in (result.wall, result.processor))
    ratio = np.median(np.array(peer.processor) / np.array(result.processor))
    median, late = np.percentile(processor, [50, 99])
    print(
        f"  {label:<28} processor: median {median:.2f} ms, best {processor.min():.2f}, "
        f"p99 {late:.2f}   wall: median {np.median(wall):.2f}   "
        f"{ratio:.1f} times as fast as the thesis'"
    )


def larger(rig: RigProfile) -> RigProfile:
    """Return the rig with 1280x720 pictures of the same field's height."""
    cameras = [
        camera.model_dump()
        | {
            "image_size": (1280, 720),
            "focal_px": tuple(1.5 * focal for focal in camera.focal_px),
            "centre_px": (639.5, 359.5),
        }
        for camera in rig.cameras
    ]
    return RigProfile.model_validate(rig.model_dump() | {"cameras": cameras})


def bench(rig: RigProfile) -> None:
    width, height = rig.models[0].image_size
    scale = (0.136e-3 * rig.models[0].intrinsics[0] / 0.42) ** 2 if rig.name == "wide" else 1.0
    thesis = ThesisMarker(200.0 * scale, 2000.0 * max(scale, 1.0))
    ways: Ways = {
        "model fit": extractors(rig, ExtractorName.MODEL_FIT),
        "outline centroid": extractors(rig, ExtractorName.OUTLINE_CENTROID),
        THESIS: (thesis, thesis),
    }
    print(f"rig {rig.name}, {width}x{height}, noise {rig.noise_grey:g} grey levels, one core")
    print(f" load of the machine {os.getloadavg()[0]:.1f}: above 1 even processor times are longer")
    rng = np.random.default_rng(7)
    for label, poses, fresh in (
        ("following", [along(step) for step in range(COUNT)], False),
        ("searching", [everywhere(rig, rng) for _ in range(COUNT)], True),
    ):
        shots = shoot(rig, poses)
        results = run(rig, shots, ways, fresh)
        for name, result in results.items():
            report_rate(f"{name}, {label}", result, results[THESIS])
            report_error(f"{name}, {label}", shots, result.fixes)


def main() -> None:
    pin_to_one_core()
    wide = load_rig("wide")
    for rig in (wide, larger(wide), load_rig("thesis")):
        bench(rig)


if __name__ == "__main__":
    main()
