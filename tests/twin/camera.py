"""A camera as a program: draws what stands before it, and streams it as a UVC camera does.

`python -m tests.twin.camera SIDE NODE SCENE`: listens at a socket in the place of the device's
node, and hands out uncompressed pictures, each with the time of its capture by CLOCK_MONOTONIC, as
V4L2 stamps its buffers. The scene is eight numbers in a file that the station writes.
"""

from __future__ import annotations

import mmap
import socket
import struct
import sys
import time
from contextlib import suppress
from pathlib import Path

import cv2
import numpy as np

from tests.twin.part import ProcessPart, ahead, module

RATE_HZ, SEED, NOISE_GREY, TILES = 30.0, 7, 3.0, 8
_HEAD = struct.Struct("<IIdI")  # width, height, time [s], bytes
_SCENE = struct.Struct("<8d")  # count, centre of the band [m], axis, count again


class SceneFile:
    """What stands before the cameras, shared by a file; a torn write is read again."""

    def __init__(self, path: Path, new: bool = False) -> None:
        if new:
            path.write_bytes(bytes(_SCENE.size))
        with path.open("r+b") as file:
            self._map = mmap.mmap(file.fileno(), _SCENE.size)
        self._count = 0.0

    def write(self, p_band: np.ndarray, axis: np.ndarray) -> None:
        self._count += 1.0
        self._map[:] = _SCENE.pack(self._count, *p_band, *axis, self._count)

    def read(self) -> tuple[np.ndarray, np.ndarray] | None:
        """Return the band's centre [m] and the needle's axis; None before there was one."""
        for _ in range(100):
            first, *numbers, last = _SCENE.unpack(self._map[:])
            if first == last and first > 0.0:
                return np.array(numbers[:3]), np.array(numbers[3:])
            time.sleep(1e-4)
        return None


class Camera(ProcessPart):
    """A camera at a node."""

    def __init__(self, side: str, folder: Path, nodes: Path, scene: Path) -> None:
        super().__init__(f"{side} camera", folder / f"{side}-camera.log")
        self.side, self.node, self._scene = side, nodes / side, scene

    def command(self) -> list[str]:
        return ahead("nice", "-n", "-5") + module("camera", self.side, self.node, self._scene)

    def start(self) -> None:
        super().start()
        assert self.hear() == "streams"

    def kill(self) -> None:
        super().kill()
        self.node.unlink(missing_ok=True)  # as the system takes the node of what was unplugged

    def stop(self) -> None:
        super().stop()
        self.node.unlink(missing_ok=True)


class StreamCapture:
    """The driver's side of the wire: what `cv2.VideoCapture` is to the program."""

    def __init__(self, node: str | int) -> None:
        self._socket = socket.socket(socket.AF_UNIX)
        self._picture, self._time, self._open = None, 0.0, True
        self._values: dict[int, float] = {}
        try:
            self._socket.connect(str(node))
        except OSError:
            self._open = False

    def isOpened(self) -> bool:
        return self._open

    def set(self, prop: int, value: float) -> bool:
        self._values[prop] = value
        return True

    def get(self, prop: int) -> float:
        return 1e3 * self._time if prop == cv2.CAP_PROP_POS_MSEC else self._values.get(prop, -1.0)

    def grab(self) -> bool:
        head = self._exactly(_HEAD.size)
        if head is None:
            return False
        width, height, self._time, size = _HEAD.unpack(head)
        data = self._exactly(size)
        if data is None:
            return False
        self._picture = np.frombuffer(data, np.uint8).reshape(height, width, 3)
        return True

    def retrieve(self) -> tuple[bool, np.ndarray | None]:
        return self._picture is not None, self._picture

    def release(self) -> None:
        self._socket.close()

    def _exactly(self, size: int) -> bytearray | None:
        data = bytearray(size)
        view = memoryview(data)
        while view:
            try:
                count = self._socket.recv_into(view)
            except OSError:
                return None
            if count == 0:
                return None
            view = view[count:]
        return data


def main(side: str, node: str, scene: str) -> None:
    """Stream to one program after the other."""
    from app.tracking.optics.rig import load_rig
    from app.tracking.simulated.cameras import NeedleRenderer
    from app.tracking.simulated.scene import MarkerScene

    rig = load_rig("wide")
    model = next(one for one in rig.models if one.name == side)
    renderer = NeedleRenderer(model, rig.needle, rig.blur_px, SEED)
    rng = np.random.default_rng([SEED, len(side)])
    shape = (model.image_size[1], model.image_size[0], 3)
    tiles = [
        np.rint(rng.normal(0.0, NOISE_GREY, shape)).astype(np.int8).astype(np.int16)
        for _ in range(TILES)
    ]
    shared = SceneFile(Path(scene))
    Path(node).unlink(missing_ok=True)
    listening = socket.socket(socket.AF_UNIX)
    listening.bind(node)
    listening.listen(1)
    print("streams", flush=True)
    number = 0
    while True:
        link, _ = listening.accept()
        with link, suppress(OSError):
            link.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 1 << 20)
            due = time.monotonic()
            while True:
                due = max(due + 1.0 / RATE_HZ, time.monotonic())
                time.sleep(max(0.0, due - time.monotonic()))
                seen, moment, number = shared.read(), time.monotonic(), number + 1
                if seen is None:
                    continue
                clean = renderer.render(MarkerScene(*seen)).astype(np.int16)
                # Another tile at another place each time: no two pictures are the same.
                noise = np.roll(tiles[number % TILES], 17 * number % shape[0], axis=0)
                image = np.clip(clean + noise, 0, 255).astype(np.uint8)
                data = image.tobytes()
                link.sendall(_HEAD.pack(shape[1], shape[0], moment, len(data)))
                link.sendall(data)


if __name__ == "__main__":
    main(*sys.argv[1:])
