"""What the end of a routine means for the device's record."""

from pathlib import Path
from typing import Final, Protocol

from app.device.commissioning.records import DeviceRecord
from app.device.commissioning.report import Report
from app.device.commissioning.results import AnyResult, Step
from app.device.links.link import BoardInfo

CHECKS: Final = {Step.SIGNS: "the earlier sign check", Step.FORCE: "the earlier force scale"}
"""Routines that confirm the device: one that fails leaves nothing confirmed."""


class Kept(Protocol):
    """A device with its record (`bench.Bench`)."""

    @property
    def info(self) -> BoardInfo:
        """Who is at the other end."""
        ...

    @property
    def record(self) -> DeviceRecord:
        """What is known of the device."""
        ...

    def keep(self, result: AnyResult) -> Path:
        """Put a result into the record."""
        ...

    def undo(self, *steps: Step) -> Path:
        """Take the newest result of some routines back."""
        ...


def settle(bench: Kept, step: Step, report: Report) -> str:
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
    return f"{report.failure} ({CHECKS[step]} counts no more: do this step again)"


def _counts(bench: Kept, step: Step) -> bool:
    """Whether an earlier success still counts; that of a force scale outlives the power cycle."""
    entry = bench.record.newest(step)
    return entry is not None and (step is Step.FORCE or entry.boot == bench.info.boot)
