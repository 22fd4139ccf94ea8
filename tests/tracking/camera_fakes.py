"""A scripted driver: what `cv2.VideoCapture` does, and what goes wrong with one."""

import threading
import time

import cv2
import numpy as np

from app.tracking.cameras.camera import Camera
from app.tracking.cameras.ports import CameraPort


class NoCamera(Camera):
    """Is there for a tracker that is handed its pictures; nothing may ask it for one."""

    def open(self):
        raise NotImplementedError

    def read(self):
        raise NotImplementedError

    def close(self):
        pass


LEFT = CameraPort("1-1.1", "1-1.1:1.0", "/dev/video0", "Webcam", ("pci-0-usb-0:1.1:1.0",))
RIGHT = CameraPort("1-1.2", "1-1.2:1.0", "/dev/video2", "Webcam", ("pci-0-usb-0:1.2:1.0",))


class FakeBus:
    """Cameras that are plugged in; unplugging one ends its captures."""

    def __init__(self, *ports):
        self.plugged = list(ports or (LEFT, RIGHT))
        self.captures = []
        self.script = {}

    def ports(self):
        return tuple(self.plugged)

    def open(self, node):
        capture = FakeCapture(self, node, **self.script)
        self.captures.append(capture)
        return capture


class FakeCapture:
    """A quick camera (200 Hz) of any size; `refuses` are properties that it does not take."""

    def __init__(self, bus, node, size=(640, 480), refuses=(), stamp="driver", image=None):
        self.bus, self.node, self.size = bus, node, size
        self.refuses, self.stamp, self.image = set(refuses), stamp, image
        self.values = {cv2.CAP_PROP_EXPOSURE: 157.0, cv2.CAP_PROP_FOCUS: 30.0,
                       cv2.CAP_PROP_WB_TEMPERATURE: 4600.0, cv2.CAP_PROP_FPS: 30.0}  # fmt: skip
        self.released, self.hanging = False, threading.Event()
        self.resume = threading.Event()
        self.mode, self.grabbed = "live", 0
        self.time = 0.0

    def isOpened(self):
        return any(port.node == self.node for port in self.bus.plugged)

    def set(self, prop, value):
        if prop in self.refuses:
            return False
        self.values[prop] = value
        return True

    def get(self, prop):
        if prop == cv2.CAP_PROP_FRAME_WIDTH:
            return self.size[0]
        if prop == cv2.CAP_PROP_FRAME_HEIGHT:
            return self.size[1]
        if prop == cv2.CAP_PROP_POS_MSEC:
            return {"driver": 1e3 * self.time, "none": 0.0, "count": 33.0 * self.grabbed}[
                self.stamp
            ]
        return self.values.get(prop, -1.0)

    def grab(self):
        time.sleep(0.005)
        if self.mode == "hang":
            self.hanging.set()
            self.resume.wait(60.0)
            return False
        self.grabbed += 1
        if self.mode != "same time":
            self.time = time.monotonic() - (0.004 if self.mode != "backwards" else 0.5)
        return self.isOpened()

    def retrieve(self):
        if self.mode == "broken":
            return False, None
        if self.image is not None:
            return True, self.image
        image = np.full((self.size[1], self.size[0], 3), 90, np.uint8)
        image[::16, ::16] = self.grabbed % 250 if self.mode != "frozen" else 7
        return True, image

    def release(self):
        self.released = True
