"""Virtual fixtures, force limits, safety and the real-time loop.

Names are imported when they are first asked for: the loop's modules compile for half a minute on a
first start, and who only wants a law's cost need not wait for them.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from app.core.parameters import Stage
from app.device.faults import Fault
from app.device.state import DeviceState

if TYPE_CHECKING:
    from app.device.control import laws
    from app.device.control.cost import stage_cost
    from app.device.control.loop import Host, Loop, Priority
    from app.device.control.shared import INPUT_NAMES, Inbox
    from app.device.control.table import Table, machine_stages
    from app.device.control.timing import Timing

__all__ = [
    "INPUT_NAMES",
    "DeviceState",
    "Fault",
    "Host",
    "Inbox",
    "Loop",
    "Priority",
    "Stage",
    "Table",
    "Timing",
    "laws",
    "machine_stages",
    "stage_cost",
]

_MODULES = {
    "INPUT_NAMES": "shared",
    "Host": "loop",
    "Inbox": "shared",
    "Loop": "loop",
    "Priority": "loop",
    "Stage": "table",
    "Table": "table",
    "Timing": "timing",
    "machine_stages": "table",
    "stage_cost": "cost",
}


def __getattr__(name: str) -> Any:
    """Import a name of this room from its module."""
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f"{__name__}.{_MODULES[name]}"), name)
    globals()[name] = value
    return value
