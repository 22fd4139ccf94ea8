"""The tensegrity needle holder as a machine that points a needle at a remote centre."""

from math import cos, pi, radians, sin
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen, unit
from app.core.messages import sentence
from app.core.parameters import Stage, numbered, packed
from app.mechanisms.errors import MechanismError
from app.mechanisms.profile import DeviceProfile
from app.mechanisms.remote_centre import (
    REGULAR,
    DrawnRod,
    DynamicTerms,
    JointBranch,
    MachineDrawing,
    MachineStages,
    PartKind,
    RemoteCentre,
)
from app.mechanisms.status import OK, Status
from app.mechanisms.tensegrity import stages
from app.mechanisms.tensegrity.efforts import cable_stages
from app.mechanisms.tensegrity.geometry import JointReading
from app.mechanisms.tensegrity.kernels import inverse_kernel, singularity_kernel
from app.mechanisms.tensegrity.kinematics import GuideSingularity
from app.mechanisms.tensegrity.points import machine_points
from app.mechanisms.tensegrity.profile import TensegrityProfile, TensionFrom
from app.mechanisms.turning import SIZE, RodMachine

_READINGS = {
    JointReading.RHOMBUS: "joints read as one rhombus (equation 1 of the paper)",
    JointReading.SCISSOR: "joints read as two rhombi (points B to F of the paper)",
}
_BASE = DrawnRod("A1", "A2", PartKind.BASE)


class Tensegrity(RodMachine):
    """Two spherical pantographs and four cables over the remote centre."""

    joint_ranges = ((0.0, pi), (0.0, pi))

    def __init__(self, profile: TensegrityProfile) -> None:
        self.profile, self.geometry = profile, profile.geometry.bars
        turn = radians(profile.geometry.heading_deg)
        inertia, moment = profile.masses.along
        frame = packed(
            stages.FRAME,
            cosine=cos(turn),
            sine=sin(turn),
            density=profile.masses.density,
            radius1=self.geometry.first_radius,
            radius2=self.geometry.second_radius,
            **dict(zip(stages.FramePlaces._fields[5:14], self.geometry.bars, strict=True)),
            winch_mass=profile.winches.mass,
        )
        super().__init__(profile, (0.0, 0.0), (inertia, -moment), frame)
        self._R_world_machine = np.array(
            [[cos(turn), -sin(turn), 0.0], [sin(turn), cos(turn), 0.0], [0.0, 0.0, 1.0]]
        )

    def kernels(self) -> tuple[Any, Any]:
        """Return what places the needle and its rates."""
        return stages.axis_of, stages.rates_of

    def called(self, q1: float, q2: float) -> tuple[str, float]:
        """Name what is stretched, folded or flat, and how near: the least of the five measures."""
        axis = np.array(stages.axis_of(self.values, SIZE, q1, q2)[1:4])
        t = -self._R_world_machine.T @ axis
        measures = singularity_kernel(q1, q2, *t.tolist(), *self.geometry.bars)
        nearest = int(np.argmin(np.abs(measures)))
        size = float(abs(measures[nearest]))
        if not np.isfinite(size):
            return REGULAR, 0.0
        return (tuple(GuideSingularity)[nearest] if size <= stages.NEAR else REGULAR), size

    def joints(self, axis: ArrayLike) -> tuple[JointBranch, ...]:
        """As it is built, and mirrored below the plane of both base axes."""
        t = -self._R_world_machine.T @ unit(axis, "axis")
        found = []
        for name, assembly in (("as built", 1.0), ("mirrored", -1.0)):
            status, b1, b2 = inverse_kernel(*t.tolist(), *self.geometry.bars, assembly)
            pose = stages.axis_of(self.values, SIZE, b1, b2)
            fine = status == OK and assembly > 0.0 and pose[0] == OK and pose[3] < 0.0
            q = frozen([b1, b2]) if status == OK else frozen(np.zeros(2))
            found.append(JointBranch(name, Status(status), q, fine))
        return tuple(found)

    def drawn(self, q: ArrayLike | None) -> MachineDrawing:
        """Bars as the chords of their arcs, and the cables in the order of the winches."""
        places = {
            f"A{k}": self._in_world(radius * base)
            for k, base, radius in zip(
                (1, 2), self.geometry.bases, self.geometry.radii, strict=True
            )
        }
        reading = _READINGS[self.geometry.reading]
        if q is None:
            return MachineDrawing(places, (_BASE,), reading)
        try:
            shown = machine_points(self.geometry, -self._R_world_machine.T @ self.axis(q))
        except MechanismError:
            return MachineDrawing(places, (_BASE,), reading)
        places |= {name: self._in_world(point) for name, point in shown.points.items()}
        bars = tuple(DrawnRod(start, end) for start, end in shown.bars)
        cables = tuple(DrawnRod(start, end, PartKind.CABLE) for start, end in shown.cables)
        return MachineDrawing(places, (_BASE, *bars, *cables), reading)

    def dynamics(
        self, q: ArrayLike, qd: ArrayLike, depth: float, depth_rate: float = 0.0
    ) -> DynamicTerms:
        """Bars, guide, needle and winches; see `tensegrity.dynamics`."""
        self._valid(q)
        (b1, b2), (v1, v2) = (np.asarray(x, dtype=np.float64).tolist() for x in (q, qd))
        needle = stages.needle_along(self.values, 0, depth, depth_rate)
        _, terms = stages.guide_terms(self.values, 0, b1, b2, v1, v2, *needle, 1.0)
        m11, m12, m22, h1, h2, g1, g2 = terms
        coulomb, viscous = self.profile.friction.coulomb, self.profile.friction.viscous
        return DynamicTerms(
            mass=frozen([[m11, m12], [m12, m22]]),
            velocity=frozen([h1, h2]),
            gravity=frozen([g1, g2]),
            friction=frozen([coulomb * np.sign(v) + viscous * v for v in (v1, v2)]),
        )

    def stages(self) -> MachineStages:
        """Pose and dynamics, the watch over cables and encoders, and four tensions after safety."""
        part, winches = self.profile.cables, self.profile.winches
        watch, efforts = cable_stages(self.profile, self.values)
        own = packed(
            numbered(stages.WinchPlaces),
            k0=part.stiffness,
            c=part.stiffening,
            least=part.least,
            most=part.most,
            mass=winches.mass,
            coulomb=winches.coulomb,
            viscous=winches.viscous,
            fastest=winches.fastest,
            by_current=float(part.tension_from is TensionFrom.CURRENT),
        )
        return MachineStages(
            pose=Stage("machine", stages.pose_stage, np.array(self.values)),
            dynamics=Stage("dynamics", stages.dynamics_stage, np.array(self.values)),
            plant=stages.plant_stage,
            plant_values=np.concatenate([self.values, own]),
            watch=(watch,),
            efforts=(efforts,),
        )

    def _in_world(self, point: FloatArray) -> FloatArray:
        return frozen(self.centre + self._R_world_machine @ point)


def machine(profile: DeviceProfile) -> RemoteCentre:
    """Return the machine of a profile.

    Raises:
        MechanismError: if the profile is of another kind.
    """
    if not isinstance(profile, TensegrityProfile):
        raise MechanismError(
            sentence(
                "device {profile_name} is a {profile_kind}, no tensegrity",
                profile_name=profile.name,
                profile_kind=profile.kind,
            )
        )
    return Tensegrity(profile)
