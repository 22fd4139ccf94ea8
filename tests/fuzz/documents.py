"""Files of settings, rigs, plans and records, as they come from elsewhere: how they are read.

Beside `kinds`, which has what scanners and archives send. All of these but OpenCV's are read in the
program itself, by its own readers; a spoilt one must end in a named error, in time.
"""

from collections.abc import Callable, Iterator
from pathlib import Path

import cv2
import numpy as np
import yaml

from app.core import paths
from app.core.transform import RigidTransform
from app.exchange.markups import read_plan, write_plan
from app.exchange.transforms import read_tfm, write_tfm
from app.exchange.urdf import read_geometry, write_urdf
from app.exercises.library import load_exercise
from app.mechanisms.profile.device import load_profile
from app.planning.plan import Plan
from app.planning.registration.plate import load_plate
from app.planning.registration.points import read_points
from app.session.recording import read_recording
from app.session.sidecar import fresh_summary, read_summary, sidecar, verify_record
from app.tracking.calibration.formats.own import save_calibration
from app.tracking.calibration.formats.reading import read_calibration
from app.tracking.calibration.formats.ros import ros_paths, write_ros
from app.tracking.calibration.history import CalibrationHistory
from app.tracking.optics.calibration import StereoCalibration
from app.tracking.optics.rig import load_rig
from app.tracking.pen.body import load_pen
from app.tracking.pen.settings import load_settings, load_webcam
from tests.session.session_fakes import Bench
from tests.tracking.calibration_samples import sample
from tests.tracking.test_tracking_calibration_formats import (
    FIRST_POSE,
    ICUBE_LEFT,
    ICUBE_RIGHT,
    INTRINSICS,
    SECOND_POSE,
)

Beside = dict[str, bytes]
Made = tuple[str, bytes, Callable[[Path, bytes], None], Callable[[Path], str]]
"""Name, content, how it is laid out and how it is read, as `kinds.Kind` has them."""

_UNIT, _SIZE = 0.01, (640, 480)


def documents(folder: Path) -> Iterator[Made]:
    """Make every kind; `folder` is for what has to be written on the way."""
    yield from _calibrations(folder)
    yield from _profiles()
    yield from _exchanged(folder)
    yield from _records(folder)


def _made(
    name: str, file: str, content: bytes, read: Callable[[Path], str], beside: Beside | None = None
) -> Made:
    def lay(folder: Path, data: bytes) -> None:
        for other, whole in (beside or {}).items():
            (folder / other).parent.mkdir(parents=True, exist_ok=True)
            (folder / other).write_bytes(whole)
        (folder / file).parent.mkdir(parents=True, exist_ok=True)
        (folder / file).write_bytes(data)

    return name, content, lay, read


def _finite(*values: object) -> str:
    arrays = [np.asarray(value, dtype=np.float64) for value in values]
    return "" if all(np.isfinite(array).all() for array in arrays) else "not finite"


def _sound(calibration: StereoCalibration) -> str:
    poses = [model.T_world_camera.matrix() for model in calibration.models()]
    lenses = [(*one.focal_px, *one.centre_px, *one.distortion) for one in calibration.cameras]
    return _finite(*poses, *lenses, calibration.covariance)


def _foreign(*names: str) -> Callable[[Path], str]:
    def read(at: Path) -> str:
        files = [at / name for name in names] or [at]
        return _sound(read_calibration(files, unit=_UNIT, image_size=_SIZE))

    return read


def _calibrations(folder: Path) -> Iterator[Made]:
    whole = sample(load_rig("wide"))
    save_calibration(folder / "own.yaml", whole)
    own = (folder / "own.yaml").read_bytes()
    yield _made("calibration", "own.yaml", own, _foreign("own.yaml"))
    lens = yaml.safe_dump(whole.cameras[0].model_dump(mode="json")).encode()
    yield _made(
        "lens", "lens.yaml", lens,
        lambda at: _finite(load_webcam(at / "lens.yaml").calibration.focal_px),
    )  # fmt: skip
    history = (
        "version: 1\nused: [own]\nposition: 0\ncalibrations:\n"
        "- {id: own, kept: '2026-01-01T10:00:00+00:00', condemned: null}\n"
    )
    yield _made(
        "history", "history.yaml", history.encode(),
        lambda at: "" if CalibrationHistory(at).entries() else "forgotten", {"own.yaml": own},
    )  # fmt: skip
    yield _made(
        "ICube pair", "right.yaml", ICUBE_RIGHT.encode(), _foreign("left.yaml", "right.yaml"),
        {"left.yaml": ICUBE_LEFT.encode()},
    )  # fmt: skip
    left, right = ros_paths(folder, whole)
    write_ros(left, right, whole)
    yield _made(
        "ROS pair", "left.yaml", left.read_bytes(), _foreign("left.yaml", "right.yaml"),
        {"right.yaml": right.read_bytes()},
    )  # fmt: skip
    texts = {"camera0_rot_trans.dat": FIRST_POSE, "camera1_rot_trans.dat": SECOND_POSE}
    texts |= {f"camera{i}_intrinsics.dat": INTRINSICS for i in (0, 1)}
    beside = {name: text.encode() for name, text in texts.items()}
    for name in ("camera1_rot_trans.dat", "camera0_intrinsics.dat"):
        yield _made(f"TemugeB {name[8:13]}", name, beside[name], _foreign(), beside)
    for suffix in ("yml", "xml", "json"):
        content = _storage(folder / f"both.{suffix}", whole)
        file = f"both.{suffix}"
        yield _made(f"OpenCV {suffix}", file, content, _foreign(file))


def _storage(path: Path, calibration: StereoCalibration) -> bytes:
    """File of OpenCV's stereo sample, written by OpenCV."""
    out = cv2.FileStorage(str(path), cv2.FILE_STORAGE_WRITE)
    for i, camera in enumerate(calibration.cameras, start=1):
        (fx, fy), (cx, cy) = camera.focal_px, camera.centre_px
        out.write(f"M{i}", np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]]))
        out.write(f"D{i}", np.array([camera.distortion]))
    pose = calibration.pose.transform
    out.write("R", np.array(pose.rotation))
    out.write("T", pose.translation[:, None] / _UNIT)
    out.release()
    return path.read_bytes()


def _profiles() -> Iterator[Made]:
    shipped = paths.resources()
    readers: dict[str, tuple[str, Callable[[Path], object]]] = {
        "rig": ("cameras/wide.yaml", lambda path: load_rig(path).models),
        "device": ("devices/icube.yaml", load_profile),
        "plate": ("fiducials/stepped-plate.yaml", load_plate),
        "exercise": ("exercises/breathing-liver.yaml", load_exercise),
    }
    for pen in sorted((shipped / "pens").glob("*.yaml"))[:1]:
        readers["pen profile"] = (f"pens/{pen.name}", load_pen)
    for name, (place, reader) in readers.items():

        def read(at: Path, reader: Callable[[Path], object] = reader) -> str:
            return "" if reader(at / "one.yaml") is not None else "nothing"

        yield _made(name, "one.yaml", (shipped / place).read_bytes(), read)
    settings = b"source: usb:0\nsize: [1280, 720]\nrate_hz: 30\npen: cube\nedge_mm: 60\n"
    yield _made(
        "pen settings", "pen.yaml", settings, lambda at: str(load_settings(at / "pen.yaml"))[:0]
    )


def _exchanged(folder: Path) -> Iterator[Made]:
    write_plan(
        folder / "plan.mrk.json", Plan(np.array([1.0, 2.0, 3.0]), np.array([1.0, 80.0, 3.0]), "a")
    )
    yield _made(
        "plan", "plan.mrk.json", (folder / "plan.mrk.json").read_bytes(),
        lambda at: _plan(read_plan(at / "plan.mrk.json")),
    )  # fmt: skip
    write_tfm(folder / "a.tfm", RigidTransform.exp([0.1, 0.2, 0.3, 0.4, 0.5, 0.6]))
    yield _made(
        "transform", "a.tfm", (folder / "a.tfm").read_bytes(),
        lambda at: _finite(read_tfm(at / "a.tfm").matrix()),
    )  # fmt: skip
    yield _made(
        "URDF", "a.urdf", write_urdf(load_profile("icube")).encode(),
        lambda at: "" if read_geometry(at / "a.urdf") else "nothing",
    )  # fmt: skip
    for name, content in {
        "points.csv": b"name,x_mm,y_mm,z_mm\nA,1.5,2,3\nB,10,2.5,3\nC,1,20,3.25\n",
        "points.yaml": b"A: [1.5, 2, 3]\nB: [10, 2.5, 3]\nC: [1, 20, 3.25]\n",
    }.items():

        def read(at: Path, name: str = name) -> str:
            return _finite(read_points(at / name).points)

        yield _made(name, name, content, read)


def _plan(plan: Plan) -> str:
    return _finite(plan.entry_mm, plan.target_mm)


def _records(folder: Path) -> Iterator[Made]:
    bench = Bench(folder / "sessions")
    bench.run(0.05)
    bench.trainer.begin("s-1")
    bench.insertion(0.06, x=0.05)
    result = bench.trainer.end()
    record = result.record
    assert record is not None
    content = record.read_bytes()
    fresh_summary(record)
    beside = sidecar(record).read_bytes()

    def read_record(at: Path) -> str:
        found = read_recording(at / record.name)
        trajectory = found.trajectory()
        summary = fresh_summary(at / record.name)
        verify_record(at / record.name)
        return _finite(trajectory.time) or ("" if summary.id else "no id")

    def read_sidecar(at: Path) -> str:
        summary = read_summary(at / record.name)
        return "" if summary.state != "broken" else f"a sound record is broken: {summary.reason}"

    yield _made("record", record.name, content, read_record)
    yield _made("sidecar", sidecar(record).name, beside, read_sidecar, {record.name: content})
