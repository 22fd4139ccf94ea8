"""Serves Foxglove's web socket protocol, messages as JSON in Foxglove's own schemas, metres.

Written after the protocol's document (github.com/foxglove/ws-protocol, spec.md). A peer gets the
newest value of each channel that it subscribes, at most thirty a second.
"""

from __future__ import annotations

import asyncio
import json
import struct
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.errors import AcusError, NumericalError
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.exchange.errors import LinkMessageError
from app.exchange.live.doors import Doors
from app.exchange.live.journal import LinkJournal
from app.exchange.live.web_sockets import SocketPeer, WebSocketServer, both
from app.exchange.moment import LiveEvent, LiveMoment, LiveSource, LiveSurface, Validity
from app.exchange.ros_topics import Told, quaternion, tip_pose, xyz
from app.session.schemas import FRAME_TRANSFORM, JOINT_STATES, LOG, POSE_IN_FRAME, Schema

PORT: Final = 8765
TITLE: Final = "Foxglove"
PERIOD: Final = 1.0 / 30.0
SUBPROTOCOLS: Final = ("foxglove.sdk.v1", "foxglove.websocket.v1")
"""Names that Foxglove asks for, the newer one first; what is used of them here is the same."""

_MESSAGE: Final = struct.Struct("<BIQ")
_DIAMETER: Final = 0.00127
"""Of an 18 gauge needle [m]."""

_SHAFT, _GREY = (0.9, 0.9, 0.95, 1.0), (0.5, 0.5, 0.5, 0.5)
_PATH, _ENTRY, _TARGET = (0.2, 0.8, 0.2, 1.0), (0.2, 0.6, 1.0, 1.0), (1.0, 0.3, 0.2, 0.9)
_SKIN, _RISK = (0.85, 0.65, 0.55, 0.25), (0.9, 0.25, 0.25, 0.8)


def _list(items: Schema) -> Schema:
    return {"type": "array", "items": items}


_ENTITY: Final[Schema] = {
    "type": "object",
    "properties": {
        "timestamp": FRAME_TRANSFORM["properties"]["timestamp"],
        "frame_id": {"type": "string"},
        "id": {"type": "string"},
        "lifetime": FRAME_TRANSFORM["properties"]["timestamp"],
        "frame_locked": {"type": "boolean"},
        **{
            part: _list({"type": "object"})
            for part in (
                *("metadata", "arrows", "cubes", "spheres", "cylinders", "lines"),
                *("triangles", "texts", "models"),
            )
        },
    },
}
SCENE_UPDATE: Final[Schema] = {
    "title": "foxglove.SceneUpdate",
    "type": "object",
    "properties": {"deletions": _list({"type": "object"}), "entities": _list(_ENTITY)},
}
FRAME_TRANSFORMS: Final[Schema] = {
    "title": "foxglove.FrameTransforms",
    "type": "object",
    "properties": {"transforms": _list(FRAME_TRANSFORM)},
}
FORCE: Final[Schema] = {
    "title": "acus.Force",
    "type": "object",
    "properties": {
        name: {"type": "number"} for name in ("x", "y", "z", "size", "angle_error_deg", "depth_mm")
    },
}


def stamp(wall: float) -> dict[str, int]:
    """Return a time [s since 1970] as Foxglove has it."""
    whole = int(wall)
    return {"sec": whole, "nsec": min(999_999_999, int((wall - whole) * 1e9))}


def _transform(wall: float, child: str, pose: RigidTransform) -> dict[str, Any]:
    return {
        "timestamp": stamp(wall),
        "parent_frame_id": "world",
        "child_frame_id": child,
        "translation": xyz(pose.translation),
        "rotation": quaternion(pose.rotation),
    }


def _frames(moment: LiveMoment) -> Told | None:
    plan, needle = moment.plan, moment.needle
    if plan is None:
        return None
    frames = [_transform(moment.wall, "patient", plan.T_world_patient)]
    key = 0.0
    if needle is not None and needle.validity is Validity.OK:
        key = needle.wall
        frames.append(_transform(needle.wall, "needle", tip_pose(needle, plan)))
    return Told((key, id(plan), int(moment.wall)), {"transforms": frames})


def _tip(moment: LiveMoment) -> Told | None:
    plan, needle = moment.plan, moment.needle
    if plan is None or needle is None or needle.validity is not Validity.OK:
        return None
    pose = tip_pose(needle, plan)
    body = {
        "timestamp": stamp(needle.wall),
        "frame_id": "world",
        "pose": _pose(pose.translation, pose.rotation),
    }
    return Told(needle.wall, body)


def _joints(moment: LiveMoment) -> Told | None:
    device = moment.device
    if device is None:
        return None
    joints = [
        {"name": name, "position": float(q), "velocity": float(qd), "effort": float(torque)}
        for name, q, qd, torque in zip(
            device.names, device.q, device.qd, device.torque, strict=True
        )
    ]
    return Told(device.wall, {"timestamp": stamp(device.wall), "joints": joints})


def _force(moment: LiveMoment) -> Told | None:
    device, needle = moment.device, moment.needle
    if device is None or needle is None:
        return None
    body = {
        **xyz(device.felt),
        "size": float(np.linalg.norm(device.felt)),
        "angle_error_deg": float(np.degrees(device.angle_error)),
        "depth_mm": 1e3 * needle.depth,
    }
    return Told(device.wall, body)


def _pose(place: FloatArray, rotation: FloatArray) -> dict[str, Any]:
    return {"position": xyz(place), "orientation": quaternion(rotation)}


def _colour(rgba: tuple[float, float, float, float]) -> dict[str, float]:
    return dict(zip("rgba", rgba, strict=True))


def _entity(name: str, wall: float, **parts: Any) -> dict[str, Any]:
    empty: dict[str, Any] = {name: [] for name in _ENTITY["properties"]}
    named = {"timestamp": stamp(wall), "frame_id": "world", "id": name}
    return empty | named | {"lifetime": stamp(0.0), "frame_locked": True} | parts


def _sphere(place: FloatArray, size: float, rgba: tuple[float, float, float, float]) -> Any:
    diameter = dict.fromkeys("xyz", size)
    return [{"pose": _pose(place, np.eye(3)), "size": diameter, "color": _colour(rgba)}]


def _scene(moment: LiveMoment) -> Told | None:
    """Needle at each new pose; path, entry and target when they change, and once a second."""
    plan, needle = moment.plan, moment.needle
    if plan is None:
        return None
    ends = plan.T_world_patient @ np.vstack([plan.p_entry, plan.p_target])
    line = {
        "type": 0,  # LINE_STRIP
        "pose": _pose(np.zeros(3), np.eye(3)),
        "thickness": 2.0,
        "scale_invariant": True,
        "points": [xyz(end) for end in ends],
        "color": _colour(_PATH),
        "colors": [],
        "indices": [],
    }
    entities = [
        _entity("path", moment.wall, lines=[line]),
        _entity("entry", moment.wall, spheres=_sphere(ends[0], 0.004, _ENTRY)),
        _entity("target", moment.wall, spheres=_sphere(ends[1], 0.006, _TARGET)),
    ]
    key = 0.0
    if needle is not None and needle.validity is not Validity.INVALID:
        key, valid = needle.wall, needle.validity is Validity.OK
        size = {"x": _DIAMETER, "y": _DIAMETER, "z": plan.length}
        shaft = {
            "pose": _pose(
                0.5 * (needle.p_hub + needle.p_straight), tip_pose(needle, plan).rotation
            ),
            "size": size,
            "bottom_scale": 1.0,
            "top_scale": 1.0,
            "color": _colour(_SHAFT if valid else _GREY),
        }
        entities.append(_entity("needle", needle.wall, cylinders=[shaft]))
    told = {"deletions": [], "entities": entities}
    return Told((key, id(plan), int(moment.wall)), told)


def _anatomy(moment: LiveMoment) -> Told | None:
    """Skin and structures, in the patient's frame, when they change: once to each subscriber.

    A change of registration needs no new ones: `/tf` turns the frame. With another patient, or
    none, those of the one before are taken away.
    """
    entities = [
        _entity(f"{number} {one.name}", moment.wall, triangles=[_triangles(one)])
        | {"frame_id": "patient"}
        for number, one in enumerate(moment.surfaces)
    ]
    everything = {"timestamp": stamp(moment.wall), "type": 1, "id": ""}
    return Told(moment.surfaces, {"deletions": [everything], "entities": entities})


def _triangles(surface: LiveSurface) -> dict[str, Any]:
    return {
        "pose": _pose(np.zeros(3), np.eye(3)),
        "points": [dict(zip("xyz", place, strict=True)) for place in surface.points.tolist()],
        "color": _colour(_SKIN if surface.skin else _RISK),
        "colors": [],
        "indices": surface.triangles.ravel().tolist(),
    }


@dataclass(frozen=True, slots=True)
class _Channel:
    topic: str
    schema: Schema
    of: Callable[[LiveMoment], Told | None]


EVENTS: Final = "/events"

CHANNELS: Final[Mapping[int, _Channel]] = {
    1: _Channel("/tf", FRAME_TRANSFORMS, _frames),
    2: _Channel("/scene", SCENE_UPDATE, _scene),
    3: _Channel("/needle/tip", POSE_IN_FRAME, _tip),
    4: _Channel("/haptic/joints", JOINT_STATES, _joints),
    5: _Channel("/haptic/force", FORCE, _force),
    6: _Channel(EVENTS, LOG, lambda _: None),  # one by one, by `_log`
    7: _Channel("/anatomy", SCENE_UPDATE, _anatomy),
}
"""By their number in the protocol."""


def _log(happened: LiveEvent) -> dict[str, Any]:
    return {
        "timestamp": stamp(happened.wall),
        "level": 2,
        "message": happened.message,
        "name": happened.kind,
        "file": "",
        "line": 0,
    }


class _FoxgloveTalk:
    """What one peer has subscribed."""

    def __init__(self, peer: SocketPeer, source: LiveSource, journal: LinkJournal) -> None:
        self._peer, self._source, self._journal = peer, source, journal
        self._wanted: dict[int, int] = {}
        self._keys: dict[int, object] = {}
        recent = source.events_after(0)
        self._event = recent[-1].number if recent else 0

    async def greet(self) -> None:
        """Say who this is and which channels there are."""
        info = {
            "op": "serverInfo",
            "name": "Acus",
            "capabilities": [],
            "supportedEncodings": ["json"],
            "metadata": {},
        }
        channels = [
            {
                "id": number,
                "topic": channel.topic,
                "encoding": "json",
                "schemaName": channel.schema["title"],
                "schema": json.dumps(channel.schema),
                "schemaEncoding": "jsonschema",
            }
            for number, channel in CHANNELS.items()
        ]
        await self._peer.send(json.dumps(info))
        await self._peer.send(json.dumps({"op": "advertise", "channels": channels}))

    async def tell(self) -> None:
        """Send what is new, until the peer is gone."""
        while True:
            if self._wanted:
                moment = self._source.now()
                for subscription, number in list(self._wanted.items()):
                    await self._tell(subscription, CHANNELS[number], moment)
            await asyncio.sleep(PERIOD)

    async def _tell(self, subscription: int, channel: _Channel, moment: LiveMoment) -> None:
        if channel.topic == EVENTS:
            for happened in self._source.events_after(self._event):
                self._event = happened.number
                await self._send(subscription, happened.wall, _log(happened))
            return
        try:
            message = channel.of(moment)
        except NumericalError:  # of a pose that is none; the peer stays
            self._journal.say(f"{channel.topic} is not finite, and not sent", "not finite")
            return
        if message is not None and message.key != self._keys.get(subscription):
            self._keys[subscription] = message.key
            await self._send(subscription, moment.wall, message.body)

    async def _send(self, subscription: int, wall: float, body: Mapping[str, Any]) -> None:
        try:
            data = json.dumps(body, allow_nan=False).encode()
        except ValueError:
            self._journal.say("a message is not finite, and not sent", "not finite")
            return
        await self._peer.send(_MESSAGE.pack(1, subscription, max(0, int(wall * 1e9))) + data)

    async def listen(self) -> None:
        """Do what the peer asks, until it is gone."""
        while True:
            data = await self._peer.receive()
            try:
                self._take(data)
            except (AcusError, ValueError, TypeError, LookupError, RecursionError) as error:
                reason = str(error)[:300] or type(error).__name__
                self._journal.say(f"{self._peer.name}: {reason}", reason)
                answer = {"op": "status", "level": 2, "message": reason}
                await self._peer.send(json.dumps(answer))

    def _take(self, data: str | bytes) -> None:
        said = json.loads(data) if isinstance(data, str) else None
        document: dict[str, Any] = said if isinstance(said, dict) else {}
        operation = document.get("op")
        if operation == "subscribe":
            for asked in document["subscriptions"]:
                subscription, number = int(asked["id"]), int(asked["channelId"])
                if number not in CHANNELS or not 0 <= subscription < 2**32:
                    raise LinkMessageError(
                        sentence("there is no channel {channel}", channel=number)
                    )
                if len(self._wanted) >= 64:
                    raise LinkMessageError(sentence("there are 64 subscriptions already"))
                self._wanted[subscription] = number
                self._keys.pop(subscription, None)
        elif operation == "unsubscribe":
            for subscription in document["subscriptionIds"]:
                self._wanted.pop(int(subscription), None)
        else:
            raise LinkMessageError(
                sentence(
                    "{operation!r} is not known; there are subscribe and unsubscribe",
                    operation=str(operation)[:40],
                )
            )


def server(source: LiveSource, doors: Doors, port: int = PORT) -> WebSocketServer:
    """Return the server of this protocol, not open yet; port 0 is one that is free."""

    async def talk(peer: SocketPeer, journal: LinkJournal) -> None:
        conversation = _FoxgloveTalk(peer, source, journal)
        await conversation.greet()
        await both(conversation.tell(), conversation.listen())

    return WebSocketServer(TITLE, doors, port, talk, SUBPROTOCOLS)
