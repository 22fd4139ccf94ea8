"""A needle that another program tracks, told by OpenIGTLink, in place of robot and cameras.

It moves the loop as the pen does: the joint angles are those of a robot that holds its needle that
way, and there is no force. Its pose comes in the patient's frame, RAS in millimetres, as Slicer and
PLUS have it: `NeedleTipToRas`, or `NeedleTipToReference` with `ReferenceToRas`.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Annotated, ClassVar, Final

import numpy as np
from pydantic import Field

from app.compose.needle import UPRIGHT
from app.compose.pen import START_DEPTH, joint_angles, pen_table, without_force
from app.core import paths
from app.core.arrays import FloatArray, unit
from app.core.clock import Clock
from app.core.configuration import Strict, load
from app.core.events import Event, EventQueue
from app.core.staleness import TRACKER_HOLD
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.device.control import Loop, Table
from app.device.links.pen import PenLink
from app.exchange.errors import LinkMessageError
from app.exchange.live import igtl_messages as igtl
from app.exchange.live.igtl_client import Address, IgtlClient, PeerTime
from app.exercises.schema import Exercise
from app.mechanisms.profile import DeviceProfile
from app.planning.placement import PlacedPlan
from app.session.conditions import TRAINEE
from app.simulation.plant import initial_plant
from app.tracking.fix import FixStatus, NeedleFix, without_point
from app.tracking.told_fixes import ToldFixes

DIRECT, RELATIVE, REFERENCE = "NeedleTipToRas", "NeedleTipToReference", "ReferenceToRas"
F: Final = np.diag([-1.0, -1.0, 1.0])
"""RAS to LPS."""

BESIDE: Final = 3e-3
"""Distance [m] beside the entry from which the needle's line is said to miss it."""

_Sd = Annotated[float, Field(ge=0.01, le=50.0)]


class TrackedSettings(Strict):
    """How well the tracked needle is known: what calibration and registration said of themselves.

    Attributes:
        tip_sd_mm: standard deviations of the tip along the needle's x, y and z, by its calibration.
        direction_sd_deg: of its direction.
        registration_sd_mm: of the patient's place.
        noise_sd_mm: what differs from pose to pose.
    """

    tip_sd_mm: tuple[_Sd, _Sd, _Sd] = (0.7, 0.7, 0.7)
    direction_sd_deg: _Sd = 0.5
    registration_sd_mm: _Sd = 1.0
    noise_sd_mm: _Sd = 0.3


def load_tracked() -> TrackedSettings:
    """Read `igtl.yaml` of the user's settings; the defaults without it.

    Raises:
        ConfigurationError: if it says something that cannot be used.
    """
    path = paths.settings() / "igtl.yaml"
    return load(path, TrackedSettings) if path.exists() else TrackedSettings()


class TrackedNeedle(ToldFixes):
    """Makes fixes of what a peer tells (`tracking.needle_tracker.NeedleTracker`).

    Args:
        address: of the peer.
        settings: how well the needle is known.
        clock: for ages.
        fulcrum: P_I in world [m], shape (3,).
        patient: returns T_world_patient now.
        on_needle: gets direction in world, shape (3,), and its time [s] before each valid fix.
    """

    def __init__(
        self,
        address: Address,
        settings: TrackedSettings,
        clock: Clock,
        fulcrum: FloatArray,
        patient: Callable[[], RigidTransform],
        on_needle: Callable[[FloatArray, float], None],
    ) -> None:
        super().__init__(clock, "OpenIGTLink")
        self.events = EventQueue()
        self.client = IgtlClient(address, self.take)
        self._settings = settings
        self._fulcrum, self._patient, self._on_needle = np.array(fulcrum), patient, on_needle
        self._on_fix: Callable[[NeedleFix], None] | None = None
        self._reference: FloatArray | None = None
        self._time, self._seen = PeerTime(), (-1.0, b"")
        self._misses = False
        self._watch: threading.Thread | None = None
        self._stop = threading.Event()
        self._heard = -np.inf
        self._refused, self._lock = "", threading.Lock()

    def listen(self, on_fix: Callable[[NeedleFix], None]) -> None:
        """Call `on_fix` with every fix from now on."""
        self._on_fix = on_fix

    def open(self) -> None:
        """Look for the peer; idempotent: it may come later."""
        self._stop.clear()
        self.client.open()
        if self._watch is None:
            self._watch = threading.Thread(target=self._look, name="igtl-silence", daemon=True)
            self._watch.start()

    def close(self) -> None:
        """Leave it; idempotent."""
        self._stop.set()
        self.client.close()
        watch, self._watch = self._watch, None
        if watch is not None and watch is not threading.current_thread():
            watch.join(timeout=2.0)

    def take(self, message: igtl.Message, arrived: float) -> None:
        """Take a TRANSFORM; `arrived`: time [s].

        Raises:
            LinkMessageError: for a matrix that is no pose, which is told as a fix too.
        """
        if message.device not in (DIRECT, RELATIVE, REFERENCE):
            return
        if message.device == REFERENCE:
            if igtl.is_valid(message):
                self._reference = igtl.matrix_of(message)
            return
        if (message.time, message.content) == self._seen:
            return  # the same pose, told again
        self._seen = message.time, message.content
        time = self._time.captured(message.time, arrived)
        self._heard = self._clock.now()
        if not igtl.is_valid(message):
            said = message.metadata.get("TransformStatus", "INVALID")
            hidden = said in ("OUT_OF_VIEW", "OUT_OF_VOLUME", "MISSING")
            status = FixStatus.OUT_OF_VIEW if hidden else FixStatus.INCONSISTENT
            self._without(status, time, f"the peer says that {message.device} is {said}")
            return
        try:
            matrix = igtl.matrix_of(message)
        except LinkMessageError as error:
            self._without(FixStatus.INCONSISTENT, time, str(error))
            raise
        if message.device == RELATIVE:
            if self._reference is None:
                why = f"the peer sends {RELATIVE}, but no {REFERENCE}: register the patient there"
                self._without(FixStatus.NO_ORIENTATION, time, why)
                return
            matrix = self._reference @ matrix
        self._fix(matrix, time)

    def _fix(self, needle_to_ras_mm: FloatArray, time: float) -> None:
        T_world_patient, known = self._patient(), self._settings
        u, _, vt = np.linalg.svd(needle_to_ras_mm[:3, :3])  # the wire rounds: the nearest rotation
        rotation = T_world_patient.rotation @ F @ (u @ vt)
        p_tip = T_world_patient @ (F @ needle_to_ras_mm[:3, 3] * MILLIMETRE)
        axis = unit(rotation[:, 2])
        tip = rotation @ np.diag(np.square(np.array(known.tip_sd_mm) * MILLIMETRE)) @ rotation.T
        noise = np.eye(3) * (known.noise_sd_mm * MILLIMETRE) ** 2
        spread = tip + noise + np.eye(3) * (known.registration_sd_mm * MILLIMETRE) ** 2
        offset = p_tip - self._fulcrum
        depth = float(offset @ axis)
        across = offset - depth * axis
        turned = (known.direction_sd_deg * DEGREE) ** 2 * float(across @ across)
        variance = float(axis @ spread @ axis) + turned
        fix = NeedleFix(
            p_tip,
            spread,
            time,
            FixStatus.VALID,
            (None, None),
            0.0,
            depth,
            variance,
            has_point=True,
            noise_covariance=noise,
        )
        self._on_needle(axis, time)
        self._tell_beside(float(np.linalg.norm(across)))
        self._publish(fix)

    def _without(self, status: FixStatus, time: float, reason: str) -> None:
        self._publish(without_point(status, (None, None), time, ("tracked needle",), reason))

    def _publish(self, fix: NeedleFix) -> None:
        with self._lock:  # the peer's thread, and the one that notices its silence
            self.latest.publish(fix, fix.time)
            self._meter.count(fix, self._clock.now())
            if fix.reason != self._refused and fix.reason:
                self.events.put(Event(self._clock.now(), "camera", fix.reason))
            self._refused = fix.reason
            if self._on_fix is not None:
                self._on_fix(fix)

    def _tell_beside(self, distance: float) -> None:
        limit = BESIDE * (0.7 if self._misses else 1.0)
        if distance > limit and not self._misses:
            words = f"the needle passes {distance / MILLIMETRE:.0f} mm beside the entry"
            self.events.put(Event(self._clock.now(), "pen", words))
        self._misses = distance > limit

    def _look(self) -> None:
        """Say, in the watching thread, that nothing comes: a fix of its own, again and again."""
        while not self._stop.wait(TRACKER_HOLD):
            now = self._clock.now()
            if now - self._heard > TRACKER_HOLD:
                gone = "sends no needle" if self.client.connected else "is not there"
                self._without(FixStatus.NO_PICTURE, now, f"{self.client.address} {gone}")


@dataclass(eq=False)
class Tracked:
    """The tracked needle of a rig: what moves the loop (`needle_sources.NeedleSource`).

    Attributes:
        address: of the peer.
        settings: how well the needle is known.
        profile: geometry, without force.
    """

    address: Address
    settings: TrackedSettings
    profile: DeviceProfile
    link: PenLink = field(init=False)
    noun: ClassVar[str] = "a tracked needle"
    simulated: ClassVar[bool] = False
    _placed: PlacedPlan | None = None

    def __post_init__(self) -> None:
        self.profile = without_force(self.profile)
        upright = initial_plant(self.profile, UPRIGHT, START_DEPTH)
        self.link = PenLink((upright["plant_q_left"], upright["plant_q_right"]))

    def table(self, exercise: Exercise, placed: PlacedPlan, skill: str | None, seed: int) -> Table:
        """Return the table of a tick: needle, velocity, kinematics, effects."""
        self._placed = placed
        return pen_table(exercise, placed, self.profile, [self.link.stage()], skill, seed, False)

    def tracker(self, loop: Loop, clock: Clock, seed: int) -> TrackedNeedle:
        """Build the tracker that moves the loop."""
        fulcrum = np.array(self.profile.fulcrum)
        return TrackedNeedle(
            self.address, self.settings, clock, fulcrum, self._patient, self._point
        )

    def metadata(self, skill: str | None) -> Mapping[str, dict[str, str]]:
        """Return facts for the head of a record: to a replay it is as a pen."""
        known = self.settings
        return {
            "device": {"name": "igtl", "igtl": "no", "pen": "no", "simulated": "no"},
            "cameras": {
                "name": "OpenIGTLink",
                "simulated": "no",
                "source": "igtl",
                "tip_sd_mm": " ".join(f"{one:g}" for one in known.tip_sd_mm),
                "registration_sd_mm": f"{known.registration_sd_mm:g}",
            },
            TRAINEE: {"scripted": skill or "", "hand": "pen"},
        }

    def documents(self) -> Mapping[str, TrackedSettings]:
        """Return what a record has attached."""
        return {"tracked": self.settings}

    def _patient(self) -> RigidTransform:
        return RigidTransform.identity() if self._placed is None else self._placed.T_world_patient

    def _point(self, axis: FloatArray, time: float) -> None:
        """Move the loop; a direction that no robot has is passed over."""
        q = joint_angles(self.profile, axis)
        if q is not None:
            self.link.write(q, time)
