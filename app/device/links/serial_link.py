"""A robot on a serial port: driven from the compiled loop, found again when it comes back."""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from app.core.arrays import FloatArray
from app.core.clock import Clock, SystemClock
from app.core.events import Event, EventQueue
from app.core.messages import sentence
from app.core.parameters import Stage
from app.device.errors import BoardVersionError, LinkError
from app.device.links import host_end as host
from app.device.links import wire
from app.device.links.link import BoardInfo, DeviceLink, Link, LinkStatus
from app.device.links.port import Port
from app.device.links.protocols import speech_of
from app.mechanisms.profile import DeviceProfile


class Plug:
    """The plug of a link.

    Args:
        end: array of the program's end of the wire; its field FD is kept here.
    """

    def __init__(self, end: FloatArray) -> None:
        self._end = end
        self._fd = -1
        self._port: Port | None = None
        end[wire.FD] = -1.0

    def open(self) -> None:
        """Reserve a number, with nothing behind it. Does nothing if it has one."""
        if self._fd < 0:
            self._fd = os.open(os.devnull, os.O_RDWR | os.O_NONBLOCK)
            self._end[wire.FD] = self._fd

    def put(self, port: Port) -> None:
        """Put an open port behind the number; it belongs to the plug now."""
        os.dup2(port.fd, self._fd, inheritable=False)
        self._port = port

    def take_away(self) -> None:
        """Close the port and leave nothing behind the number. Does nothing without a port."""
        port, self._port = self._port, None
        if port is not None:
            nothing = os.open(os.devnull, os.O_RDWR | os.O_NONBLOCK)
            os.dup2(nothing, self._fd, inheritable=False)
            os.close(nothing)
            port.close()

    def close(self) -> None:
        """Give the number back; no loop may use the stages any more. Idempotent."""
        self.take_away()
        if self._fd >= 0:
            fd, self._fd = self._fd, -1
            self._end[wire.FD] = -1.0
            os.close(fd)


CHECK_EVERY = 0.02
"""Time between two looks [s]."""

SILENCE = 0.25
"""Without a reply for this long while commands go out, the connection is made anew [s]."""


class Supervisor:
    """Watches one end of a wire.

    Args:
        end: array of the program's end.
        lost: called in the thread when the board is lost; returns once it is found, or when `wait`
            says that the thread shall end.
    """

    def __init__(self, end: FloatArray, lost: Callable[[], None]) -> None:
        self._end = end
        self._lost = lost
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None

    @property
    def running(self) -> bool:
        """Return whether the thread has been started and not stopped."""
        return self._thread is not None

    def start(self) -> None:
        """Start watching."""
        self._stop.clear()
        self._thread = threading.Thread(target=self._run, name="acus link", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """Stop watching and wait for the thread. Idempotent."""
        thread, self._thread = self._thread, None
        self._stop.set()
        if thread is not None and thread is not threading.current_thread():
            thread.join()

    def wait(self, seconds: float) -> bool:
        """Wait; return True at once if the thread shall end."""
        return self._stop.wait(seconds)

    def _run(self) -> None:
        silence, replies, ticks = 0.0, -1.0, -1.0
        while not self._stop.wait(CHECK_EVERY):
            end = self._end
            if end[host.REPLIES] != replies or end[host.TICKS] == ticks:
                silence = 0.0  # it answers, or nobody asks
            else:
                silence += CHECK_EVERY
            replies, ticks = end[host.REPLIES], end[host.TICKS]
            if end[wire.DEAD] != 0.0 or end[host.ESTRANGED] != 0.0 or silence > SILENCE:
                self._lost()
                silence = 0.0


class SerialLink(DeviceLink):
    """One robot on one port.

    Its stages live as long as the link. When the board falls silent, restarts or is unplugged, the
    loop goes on without it (LINK_STATUS says so, Q_TIME gets old) and a thread looks for the same
    board every half a second. A board that comes back not homed clears the slot HOMED.

    Args:
        port: path, e.g. `/dev/ttyACM0`.
        profile: protocol, speed and numbers of the robot.
        on_connect: called with the board after each greeting, the first included, from the thread
            that greeted it; must be quick.
        clock: monotonic clock, for the times of events.
    """

    def __init__(
        self,
        port: str,
        profile: DeviceProfile,
        on_connect: Callable[[BoardInfo], None] | None = None,
        clock: Clock | None = None,
    ) -> None:
        self.port = port
        self.profile = profile
        self.events = EventQueue()
        self._on_connect = on_connect
        self._clock = clock or SystemClock()
        self._speech = speech_of(profile)
        self._end = np.zeros(host.SIZE)
        self._end[host.STATUS] = LinkStatus.CLOSED
        self._plug = Plug(self._end)
        self._supervisor = Supervisor(self._end, self._find_again)
        self._info: BoardInfo | None = None

    def open(self) -> None:
        """Open the port and greet the board. Does nothing if the link is open.

        Raises:
            LinkError: if the port is absent, busy or forbidden, nobody answers, or somebody else
                does; says what to do.
        """
        if self._supervisor.running:
            return
        _need_linux()
        self._speech.fill(self._end)
        self._plug.open()
        try:
            self._connect(None)
        except BaseException:
            self._plug.close()
            raise
        self._supervisor.start()

    def close(self) -> None:
        """Let go of the port. Does nothing if the link is closed."""
        self._supervisor.stop()
        self._end[host.STATUS] = LinkStatus.CLOSED
        self._plug.close()

    def stages(self) -> Link:
        """Stages of the tick: bytes in and parsed; one command built and sent."""
        _need_linux()
        from app.device.links.transport import fd_receive, fd_send

        read, write = self._speech.stages
        name = self._speech.name
        return Link.of(
            [Stage("receive", fd_receive, self._end), Stage(f"{name} read", read, self._end)],
            [Stage(f"{name} write", write, self._end), Stage("send", fd_send, self._end)],
        )

    def info(self) -> BoardInfo:
        """Return who was found by the last successful greeting.

        Raises:
            LinkError: before the first.
        """
        if self._info is None:
            raise LinkError(
                sentence("nobody was greeted on {port} yet; call open() first", port=self.port)
            )
        return self._info

    @property
    def is_homed(self) -> bool:
        """Return whether the board was homed since it was switched on (Haply: since it was
        greeted).
        """
        return bool(self._end[host.HOMED])

    @property
    def commands(self) -> int:
        """Commands that were sent so far."""
        return int(self._end[host.SENT])

    def rest(self, rests: bool) -> None:
        """Send no command while it `rests`; what comes is read. The board's watchdog ends all."""
        self._end[host.RESTS] = float(rests)

    def home(self) -> None:
        """Let the running loop send the homing message: the joints stand at their home angles.

        The slot HOMED stays 0 until the board has confirmed it; see `is_homed`.
        """
        self._end[host.HOME_WANTED] += 1.0

    def test_stages(self, wait: float) -> tuple[Stage, ...]:
        """Stages that send a command and wait up to `wait` [s] for its answer in the same tick.

        They measure the true round trip. A controller does not wait: it reads an answer in the next
        tick.
        """
        _need_linux()
        from app.device.links.transport import fd_await

        self._end[wire.WAIT] = wait
        link = self.stages()
        return *link.read, *link.write, Stage("await", fd_await, self._end), link.read[1]

    def _connect(self, serial: str | None) -> None:
        """Open the port, greet, and put it into the stages; `serial` is the board expected."""
        self._end[host.STATUS] = LinkStatus.CONNECTING
        self._plug.take_away()
        port = self._make_port()
        port.open()
        try:
            info = self._greeted(port)
            info = replace(info, emulated=info.emulated or port.is_pseudo_terminal)
            if serial is not None and info.serial != serial:
                raise LinkError(
                    sentence(
                        "another robot answers on {port} (serial number {info_serial!r} instead"
                        " of {serial!r}); plug the first one in again, or close and open the link",
                        port=self.port,
                        info_serial=info.serial,
                        serial=serial,
                    )
                )
        except BaseException:
            port.close()
            raise
        self._speech.greeted(self._end, info)
        self._info = info
        self._plug.put(port)
        self._end[host.HEARD] = self._clock.now()
        self._end[host.STATUS] = LinkStatus.FINE
        self._say(f"connected to {info.profile or 'a board'} on {self.port}", boot=info.boot)
        if self._on_connect is not None:
            self._on_connect(info)

    def _make_port(self) -> Port:
        return Port(self.port, self.profile.wire.baud)

    def _greeted(self, port: Port) -> BoardInfo:
        """Greet; what goes wrong is said with the port: there may be several robots."""
        try:
            return self._speech.greet(port.exchange)
        except LinkError as error:
            raise type(error)(sentence("{port}: {error}", port=self.port, error=error)) from error

    def _find_again(self) -> None:
        self._say(f"the robot on {self.port} is gone; looking for it")
        said = ""
        while not self._supervisor.wait(0.0):
            try:
                self._connect(self.info().serial)
            except LinkError as error:
                wrong = isinstance(error, BoardVersionError)
                status = LinkStatus.WRONG_VERSION if wrong else LinkStatus.CONNECTING
                if str(error) != said:
                    self._say(str(error))
                said = str(error)
                self._end[host.STATUS] = status
                self._supervisor.wait(0.5)
            else:
                return

    def _say(self, message: str, **data: object) -> None:
        self.events.put(Event(self._clock.now(), "link", message, data))


def _need_linux() -> None:
    if sys.platform != "linux":
        raise LinkError(
            sentence(
                "serial robots are driven from inside the compiled loop, which exists on Linux "
                "only; this is {sys_platform}: use the simulated robot here",
                sys_platform=sys.platform,
            )
        )
