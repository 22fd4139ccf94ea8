"""A robot in memory under the whole control chain, on a virtual clock."""

import numpy as np
from memory_link import MemoryLink
from virtual_fixture import VirtualFixture

from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.core.compiled import stage
from app.device.control import Loop, machine_stages
from app.device.links.link import Link
from app.mechanisms.pantograph import inverse
from app.mechanisms.profile import load_profile

PROFILES = ("icube", "haply-2diy")


@stage
def free_arms(state, p):
    """A plant for tests of the wire: light arms with damping that stay near where they began."""
    for k in range(2):
        torque = state[sv.TORQUE_LEFT + k]
        pull = 2.0 * (p[k] - state[sv.PLANT_Q_LEFT + k])
        speed = 0.97 * state[sv.PLANT_QD_LEFT + k] + (torque + pull) * state[sv.DT] / 0.01
        state[sv.PLANT_QD_LEFT + k] = speed
        state[sv.PLANT_Q_LEFT + k] += speed * state[sv.DT]


def joint_angles(profile, tilt=0.1, azimuth=0.3):
    """Joint angles of a needle at a tilt towards an azimuth [rad]."""
    geometry = profile.pantograph
    reach = geometry.fulcrum[2] * np.tan(tilt)
    return inverse(
        geometry, geometry.fulcrum[:2] + reach * np.array([np.cos(azimuth), np.sin(azimuth)])
    )


class MemoryRig:
    """Loop on a virtual clock with a robot in memory; forces armed by `arm`."""

    def __init__(self, name="icube", homed=True, seed=1, watch=None):
        self.profile = load_profile(name)
        self.start = tuple(float(q) for q in joint_angles(self.profile))
        plant = ("plant", free_arms, np.array(self.start))
        self.link = MemoryLink(self.profile, [plant], self.start, homed, seed)
        read, write = self.link.stages().read, self.link.stages().write
        if watch is not None:  # with the board's torques in the state, its array as parameters
            write = (*write[:-1], ("watch", watch, self.link._box), write[-1])
        laws = [VirtualFixture.of(self.profile).stage()]
        self.clock = VirtualClock(10.0)
        initial = {"plant_q_left": self.start[0], "plant_q_right": self.start[1]}
        self.loop = Loop(
            machine_stages(self.profile, laws, [], Link.of(read, write)),
            self.profile.rate_hz,
            self.clock,
            initial=initial,
            link=self.link,
        )

    def arm(self, ticks=1200):
        self.loop.inbox.write(enabled=1.0, assistance=1.0, path_x=0.3, path_z=-0.95)
        self.loop.inbox.write(homed=1.0, force_cap=5.0)
        self.step(ticks)

    def rearm(self):
        """Disarm and arm again, as somebody does after a loss of the link."""
        self.loop.inbox.write(enabled=0.0)
        self.step(2)
        self.arm()

    def step(self, ticks):
        for start in range(0, ticks, 100):
            self.loop.inbox.write(heartbeat=self.clock.now())
            self.loop.step(min(100, ticks - start))

    def __getitem__(self, slot):
        return float(self.loop.latest().row[sv.INDEX[slot]])

    @property
    def torque(self):
        """Largest torque of the board's motors [N·m]."""
        return max(map(abs, self.link.torque))
