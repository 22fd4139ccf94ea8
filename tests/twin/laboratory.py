"""The laboratory: all parts started in their order, wired to each other, and ended."""

from __future__ import annotations

import json
import os
import shutil
import signal
import tempfile
import threading
import time
from pathlib import Path

from app.tracking.calibration.history import CalibrationHistory
from app.tracking.optics.calibration import CameraCalibration, PoseCalibration, StereoCalibration
from app.tracking.optics.rig import load_rig
from tests.twin.archive import Archive
from tests.twin.camera import Camera, SceneFile
from tests.twin.courier import Courier, acus
from tests.twin.part import BrokenRuleError, ProcessPart, module
from tests.twin.robot import Robot
from tests.twin.trainer_part import TrainerPart, home
from tests.twin.university import University, free_port

PARTS = ("robot", "trainer", "left camera", "cameras", "slicer", "gui", "archive", "university")
"""In this order; `cameras` are both at once."""

ARCHIVE_S, UNIVERSITY_S = 5.0, 3.0
"""How long the archive and the university may be silent [s]."""


class Listener(ProcessPart):
    """Slicer or the GUI; `heard` is the file of what it was told."""

    def __init__(self, name: str, folder: Path, port: int) -> None:
        super().__init__(name, folder / f"{name}.log")
        self.heard, self._port = folder / f"{name}.jsonl", port

    def command(self) -> list[str]:
        return module(self.name, self._port, self.heard)

    def start(self) -> None:
        super().start()
        assert self.hear() == "listens"

    def last(self) -> dict | None:
        """Return what it heard last."""
        with self.heard.open("rb") as stream:
            stream.seek(max(0, self.heard.stat().st_size - 20_000))
            for line in reversed(stream.read().splitlines()):
                try:
                    return json.loads(line)
                except ValueError:
                    continue
        return None


class Cameras:
    """Both cameras as one part."""

    name = "cameras"

    def __init__(self, both: list[Camera]) -> None:
        self._both = both

    def start(self) -> None:
        for one in self._both:
            one.start()

    def kill(self) -> None:
        for one in self._both:  # both at one moment, and only then what takes time
            os.kill(one.pid, signal.SIGKILL)
        for one in self._both:
            one.kill()

    def hang(self) -> None:
        for one in self._both:
            one.hang()

    def go_on(self) -> None:
        for one in self._both:
            one.go_on()

    def stop(self) -> None:
        for one in self._both:
            if one.works:
                os.kill(one.pid, signal.SIGTERM)
        for one in self._both:
            one.stop()


class Laboratory:
    """Everything in one folder of its own; use it as a context.

    Args:
        parts: names of those that are there beside robot, cameras and trainer.
        seed: of the hand.
    """

    def __init__(self, parts: frozenset[str], seed: int) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="acus-twin-"))
        self.nodes = Path(tempfile.mkdtemp(prefix="acus-twin-", dir="/dev/shm"))
        (self.folder / "sessions").mkdir()
        scene, ports = self.folder / "scene", (free_port(), free_port())
        SceneFile(scene, new=True).write([0.0, 0.16056, 0.10], [0.0, 0.0, -1.0])
        self._before = {name: os.environ.get(name) for name in home(self.folder)}
        os.environ |= {k: v for k, v in home(self.folder).items() if k.startswith("ACUS_")}
        _calibrate()
        self.robot = Robot(self.folder)
        sides = [Camera(side, self.folder, self.nodes, scene) for side in ("left", "right")]
        self.parts = {"robot": self.robot, "left camera": sides[0], "cameras": Cameras(sides)}
        student = acus(self.folder, "people", "add", "Ada")[2]["key"]
        self.trainer = TrainerPart(self.folder, self.robot, self.nodes, scene, ports, student, seed)
        self.listeners = {
            name: Listener(name, self.folder, port)
            for name, port in zip(("slicer", "gui"), ports, strict=True)
            if name in parts
        }
        self.archive = Archive(self.folder) if "archive" in parts else None
        self.university = University(self.folder) if "university" in parts else None
        self.parts |= {"trainer": self.trainer} | self.listeners
        self.parts |= {one.name: one for one in (self.archive, self.university) if one}
        self.courier = Courier(self.folder, parts & {"archive", "university"})
        self.wall = time.time() - time.monotonic()

    def __enter__(self) -> Laboratory:
        try:
            self._start()
        except BaseException:
            self.close()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """End every part, and remove the folders; idempotent."""
        order = ["slicer", "gui", "trainer", "cameras", "robot", "archive", "university"]
        for name in order:
            if name in self.parts:
                self.parts[name].stop()
        for name, value in self._before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value
        shutil.rmtree(self.nodes, ignore_errors=True)
        if not os.environ.get("ACUS_TWIN_KEEP"):
            shutil.rmtree(self.folder, ignore_errors=True)

    def _start(self) -> None:
        for name in ("robot", "cameras", "archive", "university"):
            if name in self.parts:
                self.parts[name].start()
        self._tell_whom()
        self.trainer.start()
        for one in self.listeners.values():
            one.start()
        self.courier.start()
        threading.Thread(target=self._hand_over, daemon=True).start()

    def _tell_whom(self) -> None:
        """Tell the program where archive and university are."""
        if self.archive is not None:
            one = self.archive.orthanc
            done, said, _ = acus(
                self.folder, "pacs", "add", "orthanc", "--host", "127.0.0.1", "--port", one.port,
                "--title", one.title, "--own-host", "127.0.0.1", "--timeout-s", ARCHIVE_S,
            )  # fmt: skip
            if not done:
                raise BrokenRuleError(said)
        if self.university is not None:
            own = ("--home", "https://training.example", "--user", "acus")
            done, said, _ = acus(self.folder, "results", "lrs", self.university.url, *own)
            if not done:
                raise BrokenRuleError(said)
            (file,) = (self.folder / "data").rglob("lrs.json")
            file.write_text(json.dumps(json.loads(file.read_text()) | {"seconds": UNIVERSITY_S}))

    def _hand_over(self) -> None:
        """Give the courier each attempt that has ended."""
        place = 0
        while True:
            time.sleep(0.1)
            some, place = self.trainer.said[place:], len(self.trainer.said)
            for one in some:
                if one["kind"] == "ended" and one["state"] == "ended" and one["record"]:
                    self.courier.take(one["id"])

    # --- what is asked of it ----------------------------------------------------------------------
    def inserting(self, seconds: float = 90.0) -> None:
        """Wait until the needle goes in, a while after that began, with a torque on.

        Raises:
            BrokenRuleError: if it does not.
        """
        since, end = time.monotonic(), time.monotonic() + seconds
        while True:
            left = end - time.monotonic()
            one = self.trainer.find(
                lambda told: told["kind"] == "state" and told["state"] == "inserting",
                since, left, "a needle that goes in",
            )  # fmt: skip
            time.sleep(1.5)
            later = [o for o in self.trainer.said if o["kind"] == "state" and o["t"] > one["t"]]
            if not later:
                return
            since = later[-1]["t"] if later[-1]["state"] == "inserting" else time.monotonic()

    def words_after(self, since: float) -> list[str]:
        """Return what the trainer said in words after a moment."""
        kinds = ("words", "event")
        return [o["words"] for o in self.trainer.said if o["t"] >= since and o["kind"] in kinds]


def _calibrate() -> None:
    """Keep the rig's own numbers as the calibration of the cameras."""
    rig = load_rig("wide")
    cameras = [
        CameraCalibration(
            name=one.name, image_size=one.image_size, focal_px=tuple(one.intrinsics[:2]),
            centre_px=tuple(one.intrinsics[2:]), distortion=tuple(one.distortion),
        )
        for one in rig.models
    ]  # fmt: skip
    left, right = (one.T_world_camera for one in rig.models)
    made = {
        "id": "twin", "created": "2026-01-01T00:00:00Z", "cameras": tuple(cameras),
        "pose": PoseCalibration.of(right.inverse() @ left), "world": PoseCalibration.of(left),
    }  # fmt: skip
    CalibrationHistory().keep(StereoCalibration.model_validate(made))
