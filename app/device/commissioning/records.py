"""What is known of each device: one YAML file per serial number, with history and undo."""

import re
from datetime import datetime
from pathlib import Path
from typing import Annotated, Any, Final, Literal, Protocol

import yaml
from pydantic import Field

from app.core import paths
from app.core.configuration import Strict, load
from app.core.errors import ConfigurationError
from app.core.files import write_atomically
from app.core.messages import sentence
from app.device.commissioning.results import (
    AnyResult,
    ForceScale,
    Gauge,
    Homing,
    RoutineName,
    RoutineReport,
    Signs,
)
from app.device.errors import RecordError
from app.device.links.link import BoardInfo
from app.device.readiness import Readiness

_SAFE: Final = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,63}")


class RecordEntry(Strict):
    """One result of one routine.

    Attributes:
        date: local time with its offset, ISO 8601.
        boot: power cycle of the board, `BoardInfo.boot`.
        result: what was found.
        undone: whether it was taken back.
    """

    date: str
    boot: Annotated[int, Field(ge=0)]
    result: AnyResult
    undone: bool = False


class DeviceRecord(Strict):
    """Everything that commissioning found on one device, oldest first; nothing is ever dropped."""

    version: Literal[1] = 1
    device: str
    entries: tuple[RecordEntry, ...] = ()

    def newest(self, *steps: RoutineName) -> RecordEntry | None:
        """Newest entry of any of some routines that was not undone."""
        for entry in reversed(self.entries):
            if entry.result.step in steps and not entry.undone:
                return entry
        return None

    def added(self, result: AnyResult, boot: int, date: datetime) -> "DeviceRecord":
        """Return the record with one more result."""
        entry = RecordEntry(date=date.isoformat(timespec="seconds"), boot=boot, result=result)
        return self.model_copy(update={"entries": (*self.entries, entry)})

    def undo(self, *steps: RoutineName) -> "DeviceRecord":
        """Return the record with the newest entry (of some routines, or of any) taken back.

        Raises:
            RecordError: if there is none.
        """
        entry = self.newest(*(steps or tuple(RoutineName)))
        if entry is None:
            raise RecordError(
                sentence(
                    "device {device} has no calibration that could be undone", device=self.device
                )
            )
        undone = entry.model_copy(update={"undone": True})
        entries = tuple(undone if one is entry else one for one in self.entries)
        return self.model_copy(update={"entries": entries})

    def offsets(self, boot: int) -> tuple[float, float]:
        """Return the encoder offsets of a power cycle (left, right) [rad]; zeros if not homed."""
        entry = self.newest(RoutineName.HOMING, RoutineName.OFFSETS)
        if entry is None or entry.boot != boot or not isinstance(entry.result, Homing):
            return 0.0, 0.0
        return entry.result.offsets

    def gauge(self) -> tuple[float, float]:
        """Zero [N] and scale of the gauge; (0, 1) if it was never calibrated."""
        entry = self.newest(RoutineName.GAUGE)
        if entry is None or not isinstance(entry.result, Gauge):
            return 0.0, 1.0
        return entry.result.zero, entry.result.scale

    def readiness(self) -> Readiness:
        """Return what the clearance depends on."""
        homed, signs = (
            self.newest(RoutineName.HOMING, RoutineName.OFFSETS),
            self.newest(RoutineName.SIGNS),
        )
        force = self.newest(RoutineName.FORCE)
        scale = force.result if force is not None else None
        return Readiness(
            homed_boot=homed.boot if homed is not None else None,
            signs_boot=signs.boot if signs is not None else None,
            directions_known=_directions_known(homed, signs),
            force_factor=scale.factor if isinstance(scale, ForceScale) else None,
            force_date=force.date if force is not None else "",
            profile=scale.profile if isinstance(scale, ForceScale) else "",
        )


def _directions_known(homed: RecordEntry | None, signs: RecordEntry | None) -> bool:
    """Return whether an encoder and a motor that are both reversed would have been seen.

    Either the links were turned by hand, or homing against the stops saw the needle upright.
    """
    if signs is not None and isinstance(signs.result, Signs) and signs.result.by_hand:
        return True
    return (
        homed is not None and isinstance(homed.result, Homing) and homed.result.reference == "stops"
    )


def device_key(info: BoardInfo) -> str:
    """Name of a device's record: its serial number, or its profile's name where it has none.

    Raises:
        RecordError: if the serial number is no plain name.
    """
    key = info.serial or f"unnumbered-{info.profile or 'device'}"
    if not _SAFE.fullmatch(key):
        raise RecordError(
            sentence(
                "the board calls itself {key!r}; a serial number is up to 64 letters, digits, "
                "'.', '-' and '_': set another one in its firmware",
                key=key,
            )
        )
    return key


def records_folder() -> Path:
    """Folder of the records, in the user's data folder (`ACUS_DATA` overrides)."""
    return paths.data() / "devices"


def load_record(info: BoardInfo, folder: Path | None = None) -> DeviceRecord:
    """Record of a device; an empty one if there is no file yet.

    Raises:
        RecordError: if the file is there and cannot be used; it stays as it is.
    """
    key = device_key(info)
    path = (folder or records_folder()) / f"{key}.yaml"
    if not path.exists():
        return DeviceRecord(device=key)
    try:
        record = load(path, DeviceRecord)
    except ConfigurationError as error:
        raise RecordError(
            sentence(
                "the calibration record is damaged: {error}; mend it, or move it away and "
                "calibrate anew (nothing was changed)",
                error=error,
            )
        ) from error
    if record.device != key:
        raise RecordError(
            sentence(
                "{path} belongs to device {record_device!r}, not {key!r}; it was copied or renamed",
                path=path,
                record_device=record.device,
                key=key,
            )
        )
    return record


def save_record(record: DeviceRecord, folder: Path | None = None) -> Path:
    """Write a record, whole or not at all; returns its file.

    Raises:
        RecordError: if the folder cannot be written.
    """
    path = (folder or records_folder()) / f"{record.device}.yaml"
    document: Any = record.model_dump(mode="json")
    try:
        write_atomically(path, yaml.safe_dump(document, sort_keys=False, allow_unicode=True))
    except OSError as error:
        raise RecordError(
            sentence(
                "cannot write {path}: {error_strerror}; set ACUS_DATA to a folder that can"
                " be written",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
    return path


CHECKS: Final = {
    RoutineName.SIGNS: "the earlier sign check",
    RoutineName.FORCE: "the earlier force scale",
}
"""Routines that confirm the device: one that fails leaves nothing confirmed."""


class RecordedDevice(Protocol):
    """A device with its record (`bench.Bench`)."""

    @property
    def info(self) -> BoardInfo:
        """Return who is at the other end."""
        ...

    @property
    def record(self) -> DeviceRecord:
        """Return what is known of the device."""
        ...

    def keep(self, result: AnyResult) -> Path:
        """Put a result into the record."""
        ...

    def undo(self, *steps: RoutineName) -> Path:
        """Take the newest result of some routines back."""
        ...


def settle(bench: RecordedDevice, step: RoutineName, report: RoutineReport) -> str:
    """Keep what a routine found; where a check failed, take back what it confirmed before.

    A check that was begun and did not succeed is newer than its earlier success, whatever made it
    fail: it counts no more (the history keeps it), and the clearance falls with it. A routine that
    was cancelled has found nothing; do not settle it.

    Args:
        bench: the device.
        step: the routine.
        report: its last one.

    Returns:
        Why it failed, and what counts no more; empty if it did not fail.

    Raises:
        RecordError: if the record cannot be written.
    """
    if report.result is not None:
        bench.keep(report.result)
        return ""
    if step not in CHECKS or not _counts(bench, step):
        return report.failure
    while _counts(bench, step):
        bench.undo(step)
    return sentence(
        "{report_failure} ({checks} counts no more: do this step again)",
        report_failure=report.failure,
        checks=CHECKS[step],
    )


def _counts(bench: RecordedDevice, step: RoutineName) -> bool:
    """Return whether an earlier success still counts; that of a force scale outlives the power
    cycle.
    """
    entry = bench.record.newest(step)
    return entry is not None and (step is RoutineName.FORCE or entry.boot == bench.info.boot)
