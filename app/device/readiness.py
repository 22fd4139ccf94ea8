"""How much force a device is cleared for, and why it is not more."""

from dataclasses import dataclass
from typing import Final

from app.core.messages import sentence
from app.device.links.link import BoardInfo
from app.mechanisms.profile import DeviceProfile

UNVERIFIED_FORCE: Final = 1.0
"""Largest force at the hand [N] before a kitchen scale has confirmed the force scale."""

SCALE_TOLERANCE: Final = 0.10
"""A force scale within this of 1 counts as verified."""


@dataclass(frozen=True, slots=True)
class ForceClearance:
    """What goes into the loop's inputs of the same names.

    Attributes:
        homed: 1 once homed and signs checked in this power cycle, else 0.
        force_cap: largest force at the hand [N].
        reason: why it is less than full, and what to do; empty for full clearance.
    """

    homed: float
    force_cap: float
    reason: str = ""

    @property
    def full(self) -> bool:
        """Return whether nothing is held back."""
        return not self.reason

    def inputs(self) -> dict[str, float]:
        """Return the loop's inputs by name, for `loop.inbox.write(**...)`."""
        return {"homed": self.homed, "force_cap": self.force_cap}


@dataclass(frozen=True, slots=True)
class Readiness:
    """What has been commissioned on one device.

    Attributes:
        homed_boot: power cycle (`BoardInfo.boot`) in which it was homed last; None for never.
        signs_boot: power cycle of the last passed sign check; None for never.
        directions_known: whether the directions of the encoders were seen, not only that motors
            and encoders agree.
        force_factor: measured force over wanted force; None if never measured.
        force_date: when that was measured, ISO 8601.
        profile: name of the profile of that measurement.
    """

    homed_boot: int | None = None
    signs_boot: int | None = None
    directions_known: bool = False
    force_factor: float | None = None
    force_date: str = ""
    profile: str = ""

    def clearance(self, info: BoardInfo, profile: DeviceProfile) -> ForceClearance:
        """Clearance of the device behind `info` now, driven with `profile`.

        A board that does not number its power cycles (`boot` 0) is never taken as homed by its
        record: it may have been switched off in between.
        """
        full = profile.limits.hand_force
        if info.simulated:
            return ForceClearance(1.0, full)
        if info.ready:
            cap = min(UNVERIFIED_FORCE, full)
            return ForceClearance(
                1.0,
                cap,
                sentence(
                    "forces are held to {cap:g} N: those of this device were never weighed here",
                    cap=cap,
                ),
            )
        for done, lacks, step in (
            (self.homed_boot, "homed", "homing"),
            (self.signs_boot, "checked for its signs", "signs"),
        ):
            if done is None or done != info.boot or info.boot == 0:
                return ForceClearance(0.0, 0.0, _power_cycle(lacks, step, info.boot))
        if not self.directions_known:
            return ForceClearance(
                0.0,
                0.0,
                sentence(
                    "no force: the encoders' directions were not seen; home against the stops "
                    "(`--step homing`), or check the signs by hand (`--step signs` without --yes)"
                ),
            )
        if lack := self._scale_lacks(profile):
            cap = min(UNVERIFIED_FORCE, full)
            return ForceClearance(
                1.0,
                cap,
                sentence(
                    "forces are held to {cap:g} N: {lack}; weigh it with a kitchen scale"
                    " (docs/hardware.md): `acus device calibrate PORT --step force`",
                    cap=cap,
                    lack=lack,
                ),
            )
        return ForceClearance(1.0, full)

    def _scale_lacks(self, profile: DeviceProfile) -> str:
        if self.force_factor is None:
            return sentence("the force scale of this device was never measured")
        if self.profile != profile.name:
            return sentence(
                "its force scale was measured with profile {profile}, not {profile_name}",
                profile=self.profile,
                profile_name=profile.name,
            )
        if abs(self.force_factor - 1.0) <= SCALE_TOLERANCE:
            return ""
        return sentence(
            "its force scale was {force_factor:.2f} on {force_date},"
            " outside 1 ± {scale_tolerance:g}",
            force_factor=self.force_factor,
            force_date=self.force_date,
            scale_tolerance=SCALE_TOLERANCE,
        )


def _power_cycle(lacks: str, step: str, boot: int) -> str:
    if boot == 0:
        return sentence(
            "no force: the board does not number its power cycles, so it counts as not "
            "{lacks}; run `acus device calibrate PORT` after switching it on",
            lacks=lacks,
        )
    return sentence(
        "no force: the robot was not {lacks} since it was switched on; do that step in the "
        "menu Robot, Commissioning, or with `acus device calibrate PORT --step {step}`",
        lacks=lacks,
        step=step,
    )
