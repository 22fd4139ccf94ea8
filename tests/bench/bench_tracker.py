"""Tracker against the thesis' extractor: stereo pairs a second on one core, and error of the tip.

All get the same rendered pictures (640x480 and 1280x720, 4 grey levels of noise). To reach at
1280x720: 3 ms a pair when following, 12 ms when searching, 5 times the thesis' speed. A
pair is: marker in both pictures, undistortion, triangulation, covariance, consistency; rendering is
not timed. Run as `python -m tests.bench.bench_tracker`.
"""

import os
import time

import cv2
import numpy as np

from app.core.clock import VirtualClock
from app.tracking.cameras.camera import Frame
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

Shot = tuple[Frame, Frame, np.ndarray, np.ndarray]  # pictures, tip, axis


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
            Frame(noise(renderer.render(scene), tile, rng), step / 30.0)
            for renderer, tile in zip(renderers, tiles, strict=True)
        )
        shots.append((left, right, tip, axis))
    return shots


def run(
    rig: RigProfile, shots: list[Shot], both: tuple[Extractor, Extractor], fresh: bool
) -> tuple[np.ndarray, list[NeedleFix]]:
    """Times [s] and fixes; `fresh` starts a new tracker for every pair (no memory)."""
    holder = {"axis": shots[0][3]}
    clock = VirtualClock()
    cameras = simulated_cameras(rig, lambda t: None, clock)

    def new() -> Tracker:
        return Tracker(cameras, rig, clock, lambda t: holder["axis"], FULCRUM, extractors=both)

    tracker, times, fixes = new(), [], []
    tracker.process(shots[0][0], shots[0][1])  # kernels loaded
    for left, right, _, axis in shots:
        tracker = new() if fresh else tracker
        holder["axis"] = axis
        start = time.thread_time()  # one core's time, whatever else the machine does
        fixes.append(tracker.process(left, right))
        times.append(time.thread_time() - start)
    return np.array(times), fixes


def report_error(label: str, shots: list[Shot], fixes: list[NeedleFix]) -> float:
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
        return float("nan")
    rms = float(np.sqrt(np.mean(errors**2)))
    print(
        f"  {label:<28} RMS {rms:.3f} mm   median {np.median(errors):.3f}   "
        f"p99 {np.percentile(errors, 99):.3f}   found {errors.size}/{len(shots)}   "
        f"valid {valid:.0%}"
    )
    return rms


def report_rate(label: str, times: np.ndarray) -> float:
    median = float(np.median(times))
    print(
        f"  {label:<28} {1.0 / median:7.1f} pairs/s   median {median * 1e3:.2f} ms   "
        f"p99 {np.percentile(times, 99) * 1e3:.2f} ms"
    )
    return median


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
    ways: dict[str, tuple[Extractor, Extractor]] = {
        "model fit": extractors(rig, ExtractorName.MODEL_FIT),
        "outline centroid": extractors(rig, ExtractorName.OUTLINE_CENTROID),
        "thesis' extractor": (thesis, thesis),
    }
    print(f"rig {rig.name}, {width}x{height}, noise {rig.noise_grey:g} grey levels, one core")
    print(f" load of the machine {os.getloadavg()[0]:.1f} (times count only when it is below 1)")
    moving = shoot(rig, [along(step) for step in range(COUNT)])
    rng = np.random.default_rng(7)
    shots = shoot(rig, [everywhere(rig, rng) for _ in range(COUNT)])
    times, errors = {}, {}
    for name, both in ways.items():
        times[name] = report_rate(f"{name}, following", run(rig, moving, both, False)[0])
        searching, fixes = run(rig, shots, both, True)
        report_rate(f"{name}, searching", searching)
        errors[name] = report_error(f"{name}, whole range", shots, fixes)
    peer = "thesis' extractor"
    for name in list(ways)[:2]:
        speed = times[peer] / times[name]
        print(
            f"  {name}: {speed:.1f} times as fast as the thesis', "
            f"{errors[peer] / errors[name]:.1f} times as exact"
        )


def main() -> None:
    pin_to_one_core()
    wide = load_rig("wide")
    for rig in (wide, larger(wide), load_rig("thesis")):
        bench(rig)


if __name__ == "__main__":
    main()
