"""The profile of a gimbal: inertias and radius of its two rings."""

from typing import Final, Literal

from app.mechanisms.profile.device import DeviceProfile
from app.mechanisms.profile.mechanics import Inertia, Length, NeedleSection


class RingSection(NeedleSection):
    """The needle, the rings' inertia about their own axes [kg·m²], and their radius [m]."""

    outer_inertia: Inertia
    inner_inertia: Inertia
    radius: Length


class GimbalProfile(DeviceProfile):
    """One gimbal."""

    kind: Literal["gimbal"]
    inertia: RingSection

    @property
    def joint_inertia(self) -> float:
        """Inertia of the lighter ring alone [kg·m²]."""
        return min(self.inertia.outer_inertia, self.inertia.inner_inertia)

    @property
    def links_potential_bound(self) -> float:
        """The rings are balanced [J]."""
        return 0.0


PROFILE: Final = GimbalProfile
