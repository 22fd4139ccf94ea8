"""The needle holder in the loop on a virtual clock; cables tear, winches and encoders stick."""

from typing import Any

import numpy as np
from memory_link import MemoryLink

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import VirtualClock
from app.core.compiled import stage
from app.core.parameters import Stage
from app.device.control import Loop, laws, machine_stages
from app.device.links.link import Link
from app.device.links.simulated import simulated_link
from app.mechanisms.profile import DeviceProfile, load_profile
from app.mechanisms.tensegrity.stages import WINCH
from app.simulation.plant import initial_plant, plant_stage

PROFILE = load_profile("tensegrity")
UPRIGHT = (0.0, 0.0, -1.0)


@stage
def sticking(state: FloatArray, p: FloatArray) -> None:
    """Left encoder that keeps its value while p[0] is 1, gives none at 2, is not read at 3."""
    if p[0] == 0.0:
        p[1], p[2] = state[sv.Q_LEFT], state[sv.Q_TIME]
    elif p[0] == 1.0:
        state[sv.Q_LEFT] = p[1]
    elif p[0] == 2.0:
        state[sv.Q_LEFT] = np.nan
    else:
        state[sv.Q_LEFT], state[sv.Q_TIME] = p[1], p[2]


def leaning(tilt_deg: float, azimuth_deg: float) -> FloatArray:
    tilt, azimuth = np.radians((tilt_deg, azimuth_deg))
    return np.array([np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth), -np.cos(tilt)])


class HolderRig:
    """Loop, plant and a hand; `path` is what guidance wants."""

    def __init__(
        self,
        requests: Any,
        path: Any = UPRIGHT,
        start: Any = UPRIGHT,
        depth: float = 0.02,
        dial: float = 1.0,
        profile: DeviceProfile = PROFILE,
        wired: bool = False,
    ) -> None:
        self.profile, self.machine, self.depth = profile, profile.machine, depth
        self.plant = plant_stage(profile, start, depth)
        self.encoder = np.zeros(3)
        initial = initial_plant(profile, start, depth)
        self.board = None
        if wired:
            q = initial["plant_q_left"], initial["plant_q_right"]
            self.board = MemoryLink(profile, [self.plant], q)
            link = self.board.stages()
        else:
            link = simulated_link(profile, [self.plant])
        link = Link.of([*link.read, Stage("sticking", sticking, self.encoder)], link.write)
        bound = laws.energy_bound(requests, profile)
        forces = laws.stages_of(requests, profile)
        table = machine_stages(profile, forces, [], link, energy_bound=bound)
        self.clock = VirtualClock(10.0)
        self.loop = Loop(table, profile.rate_hz, self.clock, initial=initial, link=self.board)
        x, y, z = np.asarray(path, dtype=float)
        self.loop.inbox.write(
            path_x=x, path_y=y, path_z=z, assistance=dial, homed=1.0,
            force_cap=profile.limits.hand_force, hand_x=start[0], hand_y=start[1],
            hand_depth=depth, hand_holds=float("hold_direction" not in requests),
            tracked_depth=depth, tracked_variance=1e-9,
        )  # fmt: skip
        self.loop.open()
        self.run(0.2)
        self.loop.inbox.write(enabled=1.0)

    def run(self, seconds: float) -> FloatArray:
        """Go on; returns the rows."""
        first = self.loop.latest().tick
        left = round(seconds * self.profile.rate_hz)
        while left > 0:
            now, ticks = self.clock.now(), min(left, 20)
            self.loop.inbox.write(heartbeat=now, tracked_time=now)
            self.loop.step(ticks)
            left -= ticks
        return self.loop.rows(first)

    def hand(self, axis: Any, holds: bool = True) -> None:
        """Hold the needle along a direction, or let it go."""
        self.loop.inbox.write(hand_x=axis[0], hand_y=axis[1], hand_holds=float(holds))

    @property
    def axis(self) -> FloatArray:
        """Where the needle truly points."""
        return self.machine.axis(self.loop.latest().row[sv.PLANT_Q])

    def tear(self, cable: int) -> None:
        """Break a cable."""
        self.plant.parameters[WINCH.torn1 + cable] = 1.0

    def block(self, cable: int, paid_out: float) -> None:
        """Let a winch pay out and then stick."""
        self.plant.parameters[WINCH.reel1 + cable] -= paid_out
        self.plant.parameters[WINCH.coulomb] = 1e3
