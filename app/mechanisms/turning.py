"""A machine whose joints turn a rod about the remote centre: all that is asked of it, from d(q).

For machines that hold the needle in a guide and whose other parts turn with one joint each. They
bring d(q), hub to tip, its rates and their rates of change as compiled functions; inertias, weights
and tool point follow here. With G = dd/dq, shape (3, 2), a rod of inertia Θ about the centre has

    M = Θ GᵀG,   h = Θ Gᵀ(Ġ q̇),   g = -m s Gᵀ γ,

its centre of mass s beyond the remote centre along d, γ gravity; parts of a joint alone add to the
diagonal of M. `p[first:]` are the numbers of `RodPlaces`, then the machine's own, which its
functions take from `first + len(ROD)` on:

- `axis_of(p, own, q1, q2) -> (status, dx, dy, dz, lx, ly, lz, rx, ry, rz)`: d, dd/dq1, dd/dq2,
- `rates_of(p, own, q1, q2, v1, v2) -> (lx, ly, lz, rx, ry, rz)`: Ġ at q̇ = (v1, v2).

As in `needle_motion`, whoever takes them is inlined.
"""

from __future__ import annotations

from abc import abstractmethod
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from app.core import state_vector as sv
from app.core.arrays import FloatArray, frozen
from app.core.compiled import njit
from app.core.parameters import numbered, packed
from app.mechanisms.needle_motion import OWN, Compiled, Pose
from app.mechanisms.profile import DeviceProfile
from app.mechanisms.remote_centre import DynamicTerms, MachinePose, RemoteCentre
from app.mechanisms.status import OK, UNREACHABLE, Status


class RodPlaces(NamedTuple):
    """Remote centre, inertias, the guide and the needle, and gravity."""

    fx: int  # remote centre [m]
    fy: int
    fz: int
    left: int  # inertia of what turns with one joint alone [kg·m²]
    right: int
    guide: int  # of the guide about the centre [kg·m²], and its first moment along d [kg·m]
    guide_moment: int
    needle_mass: int  # [kg], inertia about its centre [kg·m²], that beyond P_I at zero depth [m]
    needle_inertia: int
    needle_offset: int
    gx: int  # gravity [m/s²]
    gy: int
    gz: int


ROD: Final = numbered(RodPlaces)
SIZE: Final = len(ROD)

Terms = tuple[float, float, float, float, float, float, float]
"""Mass matrix, velocity terms and gravity: (m11, m12, m22, h1, h2, g1, g2)."""


Axis = tuple[int, float, float, float, float, float, float, float, float, float]
"""What `axis_of` returns: status, d, dd/dq1, dd/dq2."""


@njit
def tool_at(p: FloatArray, first: int, axis: Axis) -> Pose:
    """Tool point of a needle direction and its Jacobian; one that does not point down has none.

    P3 = P_I + L d with L = -fz/dz, so dP3/dq = L (dd/dq - d (dd_z/dq)/d_z) on x and y.
    """
    status, dx, dy, dz, lx, ly, lz, rx, ry, rz = axis
    if status != OK or not dz < 0.0:
        return False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    lever = -p[first + ROD.fz] / dz
    ux, uy = dx / dz, dy / dz
    return (
        True,
        p[first + ROD.fx] + lever * dx,
        p[first + ROD.fy] + lever * dy,
        lever * (lx - ux * lz),
        lever * (rx - ux * rz),
        lever * (ly - uy * lz),
        lever * (ry - uy * rz),
    )


@njit(cache=False, forceinline=True)
def tool_of(p: FloatArray, first: int, q1: float, q2: float, axis_of: Compiled) -> Pose:
    """Tool point and its Jacobian at joint angles."""
    return tool_at(p, first, axis_of(p, first + SIZE, q1, q2))


@njit(cache=False, forceinline=True)
def terms_of(
    p: FloatArray,
    first: int,
    q1: float,
    q2: float,
    v1: float,
    v2: float,
    depth: float,
    depth_rate: float,
    axis_of: Compiled,
    rates_of: Compiled,
) -> Terms:
    """Mass, velocity terms and gravity of joints, guide and needle, the tip at `depth` [m]."""
    _, _, _, _, lx, ly, lz, rx, ry, rz = axis_of(p, first + SIZE, q1, q2)
    ax, ay, az, bx, by, bz = rates_of(p, first + SIZE, q1, q2, v1, v2)
    s = depth + p[first + ROD.needle_offset]
    mass = p[first + ROD.needle_mass]
    theta = p[first + ROD.guide] + p[first + ROD.needle_inertia] + mass * s * s
    ll, lr, rr = (
        lx * lx + ly * ly + lz * lz,
        lx * rx + ly * ry + lz * rz,
        rx * rx + ry * ry + rz * rz,
    )
    # The needle's sliding turns with it: 2 m s ḋepth across.
    slide = 2.0 * mass * s * depth_rate
    wx, wy, wz = lx * v1 + rx * v2, ly * v1 + ry * v2, lz * v1 + rz * v2
    hx = theta * (ax * v1 + bx * v2) + slide * wx
    hy = theta * (ay * v1 + by * v2) + slide * wy
    hz = theta * (az * v1 + bz * v2) + slide * wz
    moment = p[first + ROD.guide_moment] + mass * s
    gx, gy, gz = p[first + ROD.gx], p[first + ROD.gy], p[first + ROD.gz]
    return (
        p[first + ROD.left] + theta * ll,
        theta * lr,
        p[first + ROD.right] + theta * rr,
        lx * hx + ly * hy + lz * hz,
        rx * hx + ry * hy + rz * hz,
        -moment * (gx * lx + gy * ly + gz * lz),
        -moment * (gx * rx + gy * ry + gz * rz),
    )


@njit(cache=False, forceinline=True)
def write_pose(state: FloatArray, p: FloatArray, axis_of: Compiled) -> None:
    """Write KINEMATICS, and where it is OK P3_*, J_* and INERTIA_*: a machine's stage `pose`."""
    q1, q2 = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    axis = axis_of(p, SIZE, q1, q2)
    status, _, _, dz, lx, ly, lz, rx, ry, rz = axis
    if status == OK and not dz < 0.0:
        status = UNREACHABLE
    state[sv.KINEMATICS] = status
    if status != OK:
        return
    _, x, y, jxl, jxr, jyl, jyr = tool_at(p, 0, axis)
    state[sv.P3_X], state[sv.P3_Y] = x, y
    state[sv.J_XL], state[sv.J_XR], state[sv.J_YL], state[sv.J_YR] = jxl, jxr, jyl, jyr
    guide = p[ROD.guide]
    state[sv.INERTIA_LEFT] = p[ROD.left] + guide * (lx * lx + ly * ly + lz * lz)
    state[sv.INERTIA_CROSS] = guide * (lx * rx + ly * ry + lz * rz)
    state[sv.INERTIA_RIGHT] = p[ROD.right] + guide * (rx * rx + ry * ry + rz * rz)


@njit(cache=False, forceinline=True)
def write_dynamics(state: FloatArray, p: FloatArray, axis_of: Compiled, rates_of: Compiled) -> None:
    """Write MASS_*, BIAS_*, DRIFT_*, WEIGHT_* and LINKS_POTENTIAL: a machine's `dynamics`."""
    if state[sv.KINEMATICS] != OK:
        return
    q1, q2, v1, v2 = state[sv.Q_LEFT], state[sv.Q_RIGHT], state[sv.QD_LEFT], state[sv.QD_RIGHT]
    m11, m12, m22, h1, h2, g1, g2 = terms_of(
        p, 0, q1, q2, v1, v2, state[sv.DEPTH], 0.0, axis_of, rates_of
    )
    state[sv.MASS_LEFT], state[sv.MASS_CROSS], state[sv.MASS_RIGHT] = m11, m12, m22
    state[sv.BIAS_LEFT], state[sv.BIAS_RIGHT] = h1, h2
    state[sv.WEIGHT_LEFT], state[sv.WEIGHT_RIGHT] = g1, g2
    dx, dy, dz = write_drift(state, p, axis_of, rates_of)
    fall = p[ROD.gx] * dx + p[ROD.gy] * dy + p[ROD.gz] * dz
    state[sv.LINKS_POTENTIAL] = -p[ROD.guide_moment] * fall


@njit(cache=False, forceinline=True)
def write_drift(
    state: FloatArray, p: FloatArray, axis_of: Compiled, rates_of: Compiled
) -> tuple[float, float, float]:
    """Write DRIFT_*; returns the needle's direction.

    It is that of P3 = P_I + L d: L d̈ + 2 L̇ ḋ + L̈ d on x and y, with L̇ = -L ḋ_z/d_z and
    L̈ = L (2 ḋ_z²/d_z² - d̈_z/d_z).
    """
    q1, q2, v1, v2 = state[sv.Q_LEFT], state[sv.Q_RIGHT], state[sv.QD_LEFT], state[sv.QD_RIGHT]
    _, dx, dy, dz, lx, ly, lz, rx, ry, rz = axis_of(p, SIZE, q1, q2)
    ax, ay, az, bx, by, bz = rates_of(p, SIZE, q1, q2, v1, v2)
    wx, wy, wz = lx * v1 + rx * v2, ly * v1 + ry * v2, lz * v1 + rz * v2
    cx, cy, cz = ax * v1 + bx * v2, ay * v1 + by * v2, az * v1 + bz * v2
    lever, u = -p[ROD.fz] / dz, wz / dz
    rate, second = -lever * u, lever * (2.0 * u * u - cz / dz)
    state[sv.DRIFT_X] = lever * cx + 2.0 * rate * wx + second * dx
    state[sv.DRIFT_Y] = lever * cy + 2.0 * rate * wy + second * dy
    return dx, dy, dz


@njit(cache=False, forceinline=True)
def plant_terms(state: FloatArray, p: FloatArray, axis_of: Compiled, rates_of: Compiled) -> Terms:
    """Return what `needle_motion` asks as `terms`: the machine's numbers stand from p[OWN] on."""
    return terms_of(
        p,
        OWN,
        state[sv.PLANT_Q_LEFT],
        state[sv.PLANT_Q_RIGHT],
        state[sv.PLANT_QD_LEFT],
        state[sv.PLANT_QD_RIGHT],
        state[sv.PLANT_DEPTH],
        state[sv.PLANT_DEPTH_RATE],
        axis_of,
        rates_of,
    )


class RodMachine(RemoteCentre):
    """The Python side of such a machine.

    Args:
        profile: its numbers.
        joints_alone: inertia of what turns with each joint alone [kg·m²].
        guide: inertia of the guide about the centre [kg·m²], first moment along d [kg·m].
        own: the machine's own numbers, for its two functions.
    """

    def __init__(
        self,
        profile: DeviceProfile,
        joints_alone: tuple[float, float],
        guide: tuple[float, float],
        own: ArrayLike = (),
    ) -> None:
        super().__init__(profile.fulcrum)
        (fx, fy, fz), (gx, gy, gz) = profile.geometry.fulcrum, profile.mounting.gravity
        left, right = joints_alone
        part = profile.inertia
        self.values = packed(
            ROD,
            np.asarray(own, dtype=np.float64),
            fx=fx,
            fy=fy,
            fz=fz,
            left=left,
            right=right,
            guide=guide[0],
            guide_moment=guide[1],
            needle_mass=part.needle_mass,
            needle_inertia=part.needle_inertia,
            needle_offset=part.needle_centre - profile.needle_length,
            gx=gx,
            gy=gy,
            gz=gz,
        )
        self.values.setflags(write=False)
        self._friction = profile.friction.coulomb, profile.friction.viscous

    @abstractmethod
    def kernels(self) -> tuple[Any, Any]:
        """Return the compiled functions `axis_of` and `rates_of`."""

    def called(self, q1: float, q2: float) -> tuple[str, float]:
        """Return the name of the singularity at a pose, and the distance from one [-]."""
        axis_of = self.kernels()[0]
        _, _, _, _, *columns = axis_of(self.values, SIZE, q1, q2)
        least = np.linalg.svd(np.array(columns).reshape(2, 3), compute_uv=False)[1]
        return ("regular" if least > 1e-6 else "singular"), float(least)

    def pose(self, q: ArrayLike) -> MachinePose:
        """Pose at joint angles; see `RemoteCentre`."""
        q1, q2 = np.asarray(q, dtype=np.float64).tolist()
        status, dx, dy, dz, *columns = self.kernels()[0](self.values, SIZE, q1, q2)
        if status == OK and not dz < 0.0:
            status = UNREACHABLE
        name, measure = self.called(q1, q2)
        if status != OK:
            nothing = frozen(np.zeros(3)), frozen(np.zeros((3, 2)))
            return MachinePose(Status(status), name, 0.0, *nothing)
        turning = frozen(np.array(columns).reshape(2, 3).T)
        return MachinePose(Status.OK, name, measure, frozen([dx, dy, dz]), turning)

    def jacobian_rate(self, q: ArrayLike, qd: ArrayLike) -> FloatArray:
        """Rate of dd/dq; see `RemoteCentre`."""
        self._valid(q)
        angles, speeds = (np.asarray(x, dtype=np.float64).tolist() for x in (q, qd))
        return frozen(
            np.array(self.kernels()[1](self.values, SIZE, *angles, *speeds)).reshape(2, 3).T
        )

    def dynamics(
        self, q: ArrayLike, qd: ArrayLike, depth: float, depth_rate: float = 0.0
    ) -> DynamicTerms:
        """Joints, guide and needle; see `RemoteCentre`."""
        self._valid(q)
        (q1, q2), (v1, v2) = (np.asarray(x, dtype=np.float64).tolist() for x in (q, qd))
        compiled = getattr(terms_of, "py_func", terms_of)
        m11, m12, m22, h1, h2, g1, g2 = compiled(
            self.values, 0, q1, q2, v1, v2, depth, depth_rate, *self.kernels()
        )
        coulomb, viscous = self._friction
        friction = [coulomb * np.sign(v) + viscous * v for v in (v1, v2)]
        return DynamicTerms(
            mass=frozen([[m11, m12], [m12, m22]]),
            velocity=frozen([h1, h2]),
            gravity=frozen([g1, g2]),
            friction=frozen(friction),
        )
