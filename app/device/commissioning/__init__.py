"""Commissioning of a real device: one routine per file, stepped on a running loop.

Light: results, reports and records. `commissioning.bench` brings the routines and, with the loop,
compiled code.
"""

from app.device.commissioning.errors import CommissioningError, RecordError
from app.device.commissioning.records import DeviceRecord, load_record, save_record
from app.device.commissioning.report import Report
from app.device.commissioning.results import AnyResult, Step

__all__ = [
    "AnyResult",
    "CommissioningError",
    "DeviceRecord",
    "RecordError",
    "Report",
    "Step",
    "load_record",
    "save_record",
]
