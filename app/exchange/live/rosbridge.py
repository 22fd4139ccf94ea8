"""Serves the rosbridge protocol, version 2, without ROS: JSON and CBOR by web sockets.

Written after the protocol's own document (github.com/RobotWebTools/rosbridge_suite,
ROSBRIDGE_PROTOCOL.md). A peer gets the newest value of each topic that it subscribes, at most fifty
a second or as its `throttle_rate` says; whatever its `queue_length`, nothing waits in a queue.
"""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.errors import NumericalError
from app.core.messages import sentence
from app.exchange.errors import LinkMessageError
from app.exchange.live.doors import Doors
from app.exchange.live.journal import LinkJournal
from app.exchange.live.web_sockets import SocketPeer, WebSocketServer, both
from app.exchange.moment import LiveMoment, LiveSource
from app.exchange.ros_topics import EVENTS, IMAGE_POINTS, TOPICS, event

PORT: Final = 9090
TITLE: Final = "rosbridge"
PERIOD: Final = 0.02

PLACE: Final = "/acus/place_plan"
"""Service: `entry` and `target`, three numbers each, metres in the frame `patient`."""

FARTHEST: Final = 5.0
"""No point of a patient is farther from the origin of his CT [m]."""

MOST_WANTED: Final = 64
"""Subscriptions of one peer."""

_TYPED_FLOAT64: Final = 86
"""CBOR's tag of an array of little-endian doubles (RFC 8746)."""


@dataclass(slots=True)
class _Subscription:
    """A topic that a peer wants."""

    topic: str
    id: str
    period: float
    cbor: bool
    due: float = 0.0
    key: object = None
    event: int = 0


class _Talk:
    """What one peer wants, and what it says."""

    def __init__(
        self, peer: SocketPeer, source: LiveSource, asking: ThreadPoolExecutor, journal: LinkJournal
    ) -> None:
        self._peer, self._source, self._asking = peer, source, asking
        self._journal = journal
        self._wanted: dict[tuple[str, str], _Subscription] = {}
        self._ops = {
            "subscribe": self._subscribe,
            "unsubscribe": self._unsubscribe,
            "advertise": self._advertise,
            "unadvertise": self._nothing,
            "publish": self._publish,
            "call_service": self._call,
            "set_level": self._nothing,
        }

    # --- telling --------------------------------------------------------------------------------
    async def tell(self) -> None:
        """Send what is new and due, until the peer is gone."""
        while True:
            if self._wanted:
                moment, now = self._source.now(), time.monotonic()
                for one in list(self._wanted.values()):
                    if now >= one.due:
                        await self._tell(one, moment, now)
            await asyncio.sleep(PERIOD)

    async def _tell(self, wanted: _Subscription, moment: LiveMoment, now: float) -> None:
        if wanted.topic == EVENTS:
            for happened in self._source.events_after(wanted.event):
                wanted.event = happened.number
                await self._send_message(wanted, event(happened))
            return
        try:
            told = TOPICS[wanted.topic].of(moment)
        except NumericalError:  # of a pose that is none; the peer stays
            self._journal.say(f"a message of {wanted.topic} is not finite", "not finite")
            return
        if told is not None and told.key != wanted.key:
            wanted.key, wanted.due = told.key, now + wanted.period
            await self._send_message(wanted, told.body)

    async def _send_message(self, wanted: _Subscription, body: Mapping[str, Any]) -> None:
        await self._send({"op": "publish", "topic": wanted.topic, "msg": body}, wanted.cbor)

    async def _send(self, document: Mapping[str, Any], cbor: bool = False) -> None:
        try:
            data = as_cbor(document) if cbor else as_json(document)
        except ValueError:  # a number that is none is not sent
            self._journal.say(f"a message of {document.get('topic')} is not finite", "not finite")
            return
        await self._peer.send(data)

    # --- listening ------------------------------------------------------------------------------
    async def listen(self) -> None:
        """Do what the peer asks, until it is gone."""
        while True:
            data = await self._peer.receive()
            try:
                document = read(data)
                op = document.get("op")
                if not isinstance(op, str) or op not in self._ops:
                    known = ", ".join(self._ops)
                    raise LinkMessageError(
                        sentence(
                            "op {operation!r} is not known; there are {known}",
                            operation=str(op)[:40],
                            known=known,
                        )
                    )
                await self._ops[op](document)
            except (ValueError, TypeError, RecursionError) as error:
                why = str(error)[:300] or type(error).__name__
                self._journal.say(f"{self._peer.name}: {why}", why)
                await self._send({"op": "status", "level": "error", "msg": why})

    async def _subscribe(self, document: Mapping[str, Any]) -> None:
        topic = _text(document, "topic")
        if topic not in TOPICS:
            raise LinkMessageError(
                sentence(
                    "topic {topic!r} is not known; there are {known}",
                    topic=topic,
                    known=", ".join(TOPICS),
                )
            )
        kind = document.get("type")
        if isinstance(kind, str) and kind and not TOPICS[topic].is_of(kind):
            raise _wrong_type(topic, kind)
        throttle = document.get("throttle_rate", 0)
        if not isinstance(throttle, int | float) or not 0 <= throttle <= 3.6e6:
            raise LinkMessageError(
                sentence("throttle_rate {throttle!r} is not 0 to 3600000 ms", throttle=throttle)
            )
        compression = document.get("compression", "none")
        if compression not in ("none", "cbor"):
            await self._send(
                {
                    "op": "status",
                    "level": "warning",
                    "msg": f"compression {str(compression)[:20]!r} is not known here; "
                    "there are none and cbor: none is used",
                }
            )
        if len(self._wanted) >= MOST_WANTED:
            raise LinkMessageError(
                sentence("there are {most} subscriptions already", most=MOST_WANTED)
            )
        recent = self._source.events_after(0)
        one = _Subscription(
            topic,
            str(document.get("id", "")),
            1e-3 * throttle,
            compression == "cbor",
            event=recent[-1].number if recent else 0,
        )
        self._wanted[topic, one.id] = one

    async def _unsubscribe(self, document: Mapping[str, Any]) -> None:
        topic, name = _text(document, "topic"), document.get("id")
        for key in [k for k in self._wanted if k[0] == topic and name in (None, k[1])]:
            del self._wanted[key]

    async def _advertise(self, document: Mapping[str, Any]) -> None:
        topic, kind = _text(document, "topic"), _text(document, "type")
        if topic in TOPICS and not TOPICS[topic].is_of(kind):
            raise _wrong_type(topic, kind)

    async def _nothing(self, document: Mapping[str, Any]) -> None:
        return None

    async def _publish(self, document: Mapping[str, Any]) -> None:
        topic, message = _text(document, "topic"), document.get("msg")
        if topic != IMAGE_POINTS:
            raise LinkMessageError(
                sentence(
                    "nobody here listens to {topic!r}; {image_points} takes a plan",
                    topic=topic,
                    image_points=IMAGE_POINTS,
                )
            )
        if not isinstance(message, dict):
            raise LinkMessageError(sentence("a message of {topic} has the field data", topic=topic))
        points = vector(message.get("data"), 6, "data")
        if refused := await self._place(points[:3], points[3:]):
            raise LinkMessageError(sentence("the plan is refused: {reason}", reason=refused))

    async def _call(self, document: Mapping[str, Any]) -> None:
        service, values, done = _text(document, "service"), {}, True
        given = document.get("args", {})
        try:
            if service == PLACE:
                entry, target = _arguments(given, ("entry", "target"))
                refused = await self._place(vector(entry, 3, "entry"), vector(target, 3, "target"))
                values = {"success": not refused, "message": refused}
            elif service == "/rosapi/topics":
                values = {"topics": list(TOPICS), "types": [one.type for one in TOPICS.values()]}
            elif service == "/rosapi/topic_type":
                (topic,) = _arguments(given, ("topic",))
                values = {"type": TOPICS[topic].type if topic in TOPICS else ""}
            elif service == "/rosapi/services":
                values = {"services": [PLACE, *_ROSAPI]}
            else:
                known = ", ".join((PLACE, *_ROSAPI))
                raise LinkMessageError(
                    sentence(
                        "service {service!r} is not known; there are {known}",
                        service=service,
                        known=known,
                    )
                )
        except (ValueError, TypeError) as error:
            values, done = str(error)[:300], False  # type: ignore[assignment]
        answer = {"op": "service_response", "service": service, "values": values, "result": done}
        if "id" in document:
            answer["id"] = document["id"]
        await self._send(answer)

    async def _place(self, p_entry: FloatArray, p_target: FloatArray) -> str:
        """Ask for a plan in a thread of its own: whoever decides may take a moment."""
        asked = asyncio.get_running_loop().run_in_executor(
            self._asking, self._source.place, p_entry, p_target
        )
        return await asked


def _wrong_type(topic: str, kind: str) -> LinkMessageError:
    return LinkMessageError(
        sentence(
            "{topic} has type {expected}, not {other!r}",
            topic=topic,
            expected=TOPICS[topic].type,
            other=kind,
        )
    )


_ROSAPI: Final = ("/rosapi/topics", "/rosapi/topic_type", "/rosapi/services")


def read(data: str | bytes) -> dict[str, Any]:
    """Return what a peer says, JSON or CBOR.

    Raises:
        LinkMessageError: if it is neither, or no mapping.
    """
    if isinstance(data, str):
        try:
            document = json.loads(data)
        except ValueError as error:
            raise LinkMessageError(sentence("this is no JSON: {error}", error=error)) from None
    else:
        import cbor2

        try:
            document = cbor2.loads(data)
        except Exception as error:
            raise LinkMessageError(
                sentence("this is no CBOR: {error}", error=type(error).__name__)
            ) from None
    if not isinstance(document, dict):
        raise LinkMessageError(sentence("a message is a mapping with `op`"))
    return document


def as_json(document: Mapping[str, Any]) -> str:
    """Return a message as JSON.

    Raises:
        ValueError: if a number in it is not finite.
    """
    return json.dumps(document, default=lambda array: array.tolist(), allow_nan=False)


def as_cbor(document: Mapping[str, Any]) -> bytes:
    """Return a message as CBOR; arrays of numbers as typed arrays.

    Raises:
        ValueError: if a number of an array is not finite.
    """
    import cbor2

    def typed(encoder: Any, array: Any) -> None:
        finite = np.asarray_chkfinite(array, dtype="<f8")
        encoder.encode(cbor2.CBORTag(_TYPED_FLOAT64, finite.tobytes()))

    return cbor2.dumps(document, default=typed)


def vector(value: object, size: int, name: str) -> FloatArray:
    """Return numbers [m] as an array, shape (size,).

    Raises:
        LinkMessageError: if there are not so many, or one is not finite or too far away.
    """
    if isinstance(value, dict):
        value = [value.get(axis) for axis in "xyz"]
    numbers = isinstance(value, list) and len(value) == size
    if not numbers or any(isinstance(n, bool) or not isinstance(n, int | float) for n in value):  # type: ignore[attr-defined]
        raise LinkMessageError(
            sentence(
                "{name} is not {size} numbers, metres in the frame patient", name=name, size=size
            )
        )
    found = np.array([float(n) if abs(n) < 1e300 else np.inf for n in value])  # type: ignore[attr-defined]
    if not np.isfinite(found).all() or np.abs(found).max() > FARTHEST:
        raise LinkMessageError(
            sentence(
                "{name} has a number beyond {farthest:g} m: metres are expected",
                name=name,
                farthest=FARTHEST,
            )
        )
    return found


def _text(document: Mapping[str, Any], name: str) -> str:
    value = document.get(name)
    if not isinstance(value, str) or not value:
        raise LinkMessageError(
            sentence("{operation} needs {name}, a text", operation=document.get("op"), name=name)
        )
    return value


def _arguments(given: object, names: tuple[str, ...]) -> list[Any]:
    """Return arguments of a service, given by name or in their order."""
    if isinstance(given, list) and len(given) == len(names):
        return given
    if isinstance(given, dict) and all(name in given for name in names):
        return [given[name] for name in names]
    raise LinkMessageError(sentence("the service needs {names}", names=" and ".join(names)))


def server(source: LiveSource, doors: Doors, port: int = PORT) -> WebSocketServer:
    """Return the server of this protocol, not open yet; port 0 is one that is free."""
    asking = ThreadPoolExecutor(1, thread_name_prefix="rosbridge-plan")

    async def talk(peer: SocketPeer, journal: LinkJournal) -> None:
        conversation = _Talk(peer, source, asking, journal)
        await both(conversation.tell(), conversation.listen())

    return WebSocketServer(
        TITLE,
        doors,
        port,
        talk,
        needs=("websockets", "cbor2"),
        at_end=lambda: asking.shutdown(wait=False, cancel_futures=True),
    )
