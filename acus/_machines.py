"""Device profiles, and where a machine's joints point the needle."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.mechanisms.profile import DeviceProfile as Profile
from app.mechanisms.profile import load_profile, profile_names

if TYPE_CHECKING:
    from app.mechanisms.remote_centre import RemoteCentre

__all__ = ["Kinematics", "Profile", "kinematics", "profile", "profiles"]


@dataclass(frozen=True, slots=True, eq=False)
class Kinematics:
    """A machine that turns a needle about a remote centre with two joints; SI, frame `world`.

    Attributes:
        centre: remote centre [m], shape (3,).
        joint_ranges: least and largest angle of both joints [rad], open intervals.
    """

    centre: FloatArray
    joint_ranges: tuple[tuple[float, float], tuple[float, float]]
    _machine: RemoteCentre = field(repr=False)

    def forward(self, q: ArrayLike) -> FloatArray:
        """Return the needle's direction, a unit vector from hub to tip, shape (3,).

        Args:
            q: joint angles [rad], shape (2,).

        Raises:
            AcusError: where the machine has no pose; says why.
        """
        return self._machine.axis(q)

    def inverse(self, axis: ArrayLike) -> FloatArray:
        """Return the joint angles [rad], shape (2,), that point the needle along `axis`.

        Args:
            axis: direction from hub to tip, shape (3,).

        Raises:
            AcusError: if none do in the assembly that the machine is built in; says why.
        """
        return self._machine.usable(axis)

    def reaches(self, axis: ArrayLike) -> bool:
        """Tell whether the machine can point the needle along `axis`, shape (3,)."""
        return self._machine.holds(axis)

    def tip(self, q: ArrayLike, depth: float) -> FloatArray:
        """Return where the tip of a straight needle is [m], shape (3,).

        Args:
            q: joint angles [rad], shape (2,).
            depth: of the tip beyond the remote centre [m].

        Raises:
            AcusError: as `forward`.
        """
        return frozen(self.centre + depth * self._machine.axis(q))

    def jacobian(self, q: ArrayLike) -> FloatArray:
        """Return how the direction turns with the joints [1/rad], shape (3, 2).

        Args:
            q: joint angles [rad], shape (2,).

        Raises:
            AcusError: as `forward`.
        """
        return self._machine.jacobian(q)

    def joint_torques(self, q: ArrayLike, moment: ArrayLike) -> FloatArray:
        """Return the joint torques [N·m], shape (2,), that make a moment on the needle.

        Args:
            q: joint angles [rad], shape (2,).
            moment: about the remote centre [N·m], shape (3,).

        Raises:
            AcusError: as `forward`.
        """
        return self._machine.joint_torques(q, moment)


def profiles() -> tuple[str, ...]:
    """Return the names of the shipped device profiles."""
    return tuple(profile_names())


def profile(name_or_path: str | Path) -> Profile:
    """Return a shipped device profile by its name, or any by the path of its YAML file.

    Raises:
        AcusError: if there is none, naming the valid names, or the file is wrong.
    """
    return load_profile(name_or_path)


def kinematics(profile: Profile | str | Path) -> Kinematics:
    """Return the kinematics of a profile's machine, whatever its kind.

    Args:
        profile: its name or file will do.

    Raises:
        AcusError: if the profile or its machine cannot be used; says why.
    """
    chosen = profile if isinstance(profile, Profile) else load_profile(profile)
    machine = chosen.machine
    return Kinematics(machine.centre, machine.joint_ranges, machine)
