"""DIMSE statuses and rejections in words (PS3.7 annex C, PS3.4 annexes B and C, PS3.8 9.3.4)."""

from typing import Any

from app.core.messages import sentence

SUCCESS = 0x0000
CANCELLED = 0xFE00
PENDING = (0xFF00, 0xFF01)
WARNING = 0xB000

_WORDS = {
    SUCCESS: "done",
    0x0105: "it does not know one of the attributes",
    0x0106: "it finds an attribute's value invalid",
    0x0107: "it does not support an attribute that was asked for",
    0x0110: "it failed while working on the request",
    0x0111: "it has this object already",
    0x0112: "it has no such object",
    0x0115: "it finds an argument invalid",
    0x0117: "it finds an object's UID invalid",
    0x0118: "it does not know this class of objects",
    0x0119: "class and object do not belong together",
    0x0122: "it does not support this kind of object or request",
    0x0124: "this program is not authorised there; its administrator must allow its AE title",
    0x0210: "it says that the request was sent twice",
    0x0211: "it does not know this operation",
    0x0212: "it finds an argument of the wrong type",
    0x0213: "it is short of resources; try again later",
    0xA700: "it is out of resources; try again later",
    0xA701: "it is out of resources and cannot count the matches; narrow the search",
    0xA702: "it is out of resources and cannot send the pictures; try again later",
    0xA801: "it does not know where to move to: its administrator must enter this program's AE "
    "title, address and port, or retrieve with C-GET",
    0xA900: "it finds that the request does not fit the service",
    0xAA00: "none of the frames asked for are in the object",
    0xAA01: "it cannot make an object of the frames asked for",
    0xAA02: "this kind of request has no frames",
    WARNING: "it could not send all of the pictures",
    CANCELLED: "cancelled",
    0xFF00: "more is to come",
    0xFF01: "more is to come, though some wishes are not supported",
}
_REJECTED = {
    (1, 1): "it gives no reason",
    (1, 2): "it does not support this kind of connection",
    (1, 3): "it does not know this program's AE title: its administrator must enter it",
    (1, 7): "it has another AE title than the one configured",
    (2, 1): "it gives no reason",
    (2, 2): "it does not support this protocol version",
    (3, 1): "it is too busy for now; try again later",
    (3, 2): "it has too many connections; try again later",
}


def words(status: int) -> str:
    """Say a status in words, with its number."""
    text = _WORDS.get(status)
    if text is None:
        text = (
            sentence("it cannot process the request")
            if status >> 12 == 0xC
            else sentence("an unknown answer")
        )
    return f"{text} (status 0x{status:04X})"


def rejected(primitive: Any) -> str:
    """Say in words why an association was rejected."""
    source = getattr(primitive, "result_source", 0)
    reason = getattr(primitive, "diagnostic", 0)
    return _REJECTED.get((source, reason), f"it gives the unknown reason {source}.{reason}")
