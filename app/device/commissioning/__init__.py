"""Commissioning of a real device: one routine per file, stepped on a running loop.

Light: results, reports and records. `commissioning.bench` brings the routines and, with the loop,
compiled code.
"""

from app.device.commissioning.records import DeviceRecord, load_record, save_record
from app.device.commissioning.results import AnyResult, RoutineName, RoutineReport
from app.device.errors import CommissioningError, RecordError

__all__ = [
    "AnyResult",
    "CommissioningError",
    "DeviceRecord",
    "RecordError",
    "RoutineName",
    "RoutineReport",
    "load_record",
    "save_record",
]
