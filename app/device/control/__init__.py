"""Virtual fixtures, force limits, safety and the real-time loop."""

from app.device.control import laws
from app.device.control.cost import stage_cost
from app.device.control.fixture import VirtualFixture
from app.device.control.host import Host, Priority
from app.device.control.inbox import INPUT_NAMES, Inbox
from app.device.control.loop import Loop
from app.device.control.table import Stage, Table, pantograph_stages
from app.device.control.timing import Timing
from app.device.faults import Fault
from app.device.state import DeviceState

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
    "VirtualFixture",
    "laws",
    "pantograph_stages",
    "stage_cost",
]
