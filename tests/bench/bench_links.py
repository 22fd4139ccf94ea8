"""Latency and jitter of each live link beside the loop, and what links cost the loop.

In one run, in turn: the loop of an exercise on a simulated robot alone, and with OpenIGTLink,
rosbridge and Foxglove, a peer on each in a process of its own. Latency is the age of a pose
(OpenIGTLink) or of joint angles when they arrive there less their age in the program; jitter is how
far the times between arrivals are from their median.

Run as `python -m tests.bench.bench_links`.
"""

import json
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from app.compose.trainer import TrainerSetup, build_rig, device_of
from app.compose.watchers.links import Links
from app.core import state_vector as sv
from app.exchange.live.doors import Doors
from app.exchange.live.igtl_messages import packed
from app.exercises.scene import placed_plan_of
from app.planning.plan import Plan
from tests.layered import layered

SECONDS, ROUNDS, WANTED = 6.0, 4, 1.1
PROTOCOLS = ("igtl", "rosbridge", "foxglove")

PEER = """
import json, socket, struct, sys, threading, time
from websockets.sync.client import connect

ports, seconds = json.loads(sys.argv[1]), float(sys.argv[2])
found = {name: [] for name in ports}
end = time.time() + seconds

def igtl():
    one = socket.create_connection(("127.0.0.1", ports["igtl"]))
    one.sendall(bytes.fromhex(sys.argv[3]))  # by it the server knows that version 2 is understood
    stream = one.makefile("rb")
    while time.time() < end:
        head = stream.read(58)
        version, kind, name, stamp, size, crc = struct.unpack(">H12s20sQQQ", head)
        stream.read(size)
        if name.startswith(b"NeedleToRas"):
            found["igtl"].append((time.time(), stamp / 2**32))

def rosbridge():
    with connect(f"ws://127.0.0.1:{ports['rosbridge']}") as one:
        one.send(json.dumps({"op": "subscribe", "topic": "/joint_states"}))
        while time.time() < end:
            stamp = json.loads(one.recv())["msg"]["header"]["stamp"]
            found["rosbridge"].append((time.time(), stamp["sec"] + 1e-9 * stamp["nanosec"]))

def foxglove():
    address = f"ws://127.0.0.1:{ports['foxglove']}"
    with connect(address, subprotocols=["foxglove.websocket.v1"]) as one:
        one.recv(); one.recv()
        one.send(json.dumps({"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 4}]}))
        while time.time() < end:
            stamp = json.loads(one.recv()[13:])["timestamp"]
            found["foxglove"].append((time.time(), stamp["sec"] + 1e-9 * stamp["nsec"]))

threads = [threading.Thread(target=one, daemon=True) for one in (igtl, rosbridge, foxglove)]
for thread in threads:
    thread.start()
time.sleep(seconds + 0.2)
print(json.dumps(found), flush=True)
"""


def main() -> None:
    """Print latency and jitter of each link, and the loop's lateness with and without them."""
    with tempfile.TemporaryDirectory() as folder:
        plan = Plan(np.array([0.0, -100.0, 0.0]), np.array([15.0, -35.0, 10.0]), "bench")
        exercise = layered("first-insertion")
        placed = placed_plan_of(exercise, device_of(exercise), plan)
        rig = build_rig(TrainerSetup(exercise, placed, sessions=Path(folder)))
        rig.trainer.open()
        stop = threading.Event()
        beating = threading.Thread(target=_beat, args=(rig.trainer, stop))
        beating.start()
        try:
            while rig.loop.latest().tick < 1000:
                time.sleep(0.05)
            rig.trainer.begin("bench")
            _measure(rig)
        finally:
            stop.set()
            beating.join()
            rig.close()


def _measure(rig: object) -> None:
    late: dict[bool, list[np.ndarray]] = {False: [], True: []}
    arrivals: dict[str, list[np.ndarray]] = {name: [] for name in PROTOCOLS}
    ages: dict[str, list[float]] = {name: [] for name in PROTOCOLS}
    for number in range(2 * ROUNDS):
        linked = bool(number % 2)
        links = peer = None
        if linked:
            links = Links(dict.fromkeys(PROTOCOLS, 0), Doors())
            links.open()
            links.began(SimpleNamespace(rig=rig), None)
            ports = dict(zip(PROTOCOLS, (one.port for one in links.servers), strict=True))
            hello = packed("GET_STATUS", "bench", 1.0, b"", 2).hex()
            command = [sys.executable, "-c", PEER, json.dumps(ports), str(SECONDS + 1.0), hello]
            peer = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
            time.sleep(1.0)
        begin, end = rig.loop.latest().tick, time.monotonic() + SECONDS
        while time.monotonic() < end:
            time.sleep(0.05)
            if links is not None:
                moment = links.board.now()
                ages["igtl"].append(moment.wall - moment.needle.wall)
                for name in PROTOCOLS[1:]:
                    ages[name].append(moment.wall - moment.device.wall)
        late[linked].append(1e3 * np.array(rig.loop.rows(begin)[:, sv.LATENESS]))
        if links is not None and peer is not None:
            for name, pairs in json.loads(peer.communicate(timeout=30)[0]).items():
                arrivals[name].append(np.array(pairs, dtype=float).reshape(-1, 2))
            links.close()
    _show(late, arrivals, {name: float(np.median(every)) for name, every in ages.items()})


def _show(
    late: dict[bool, list[np.ndarray]], arrivals: dict[str, list[np.ndarray]], age: dict[str, float]
) -> None:
    print(f"{'link':12}{'values/s':>9}{'latency [ms] p50':>18}{'p99':>8}{'jitter [ms] p99':>17}")
    for name, rounds in arrivals.items():
        every = np.vstack(rounds)
        latency = 1e3 * (every[:, 0] - every[:, 1] - age[name])
        gaps = np.concatenate([np.diff(one[:, 0]) for one in rounds if len(one) > 2])
        jitter = 1e3 * np.quantile(np.abs(gaps - np.median(gaps)), 0.99)
        rate = len(every) / (ROUNDS * (SECONDS + 1.0))
        print(
            f"{name:12}{rate:9.1f}{np.median(latency):18.2f}"
            f"{np.quantile(latency, 0.99):8.2f}{jitter:17.2f}"
        )
    print(f"{'lateness of the loop [ms]':28}{'median':>9}{'p99':>9}{'max':>9}")
    medians = {}
    for linked, rounds in late.items():
        every = np.concatenate(rounds)
        medians[linked] = float(np.median([np.median(one) for one in rounds]))
        title = "with three links" if linked else "without"
        print(f"{title:28}{medians[linked]:9.4f}{np.quantile(every, 0.99):9.3f}{every.max():9.2f}")
    ratio = medians[True] / medians[False]
    reached = "reached" if ratio <= WANTED else "NOT reached"
    print(f"ratio of the medians {ratio:.2f}; to reach {WANTED}: {reached}")


def _beat(trainer: object, stop: threading.Event) -> None:
    while not stop.wait(0.1):
        trainer.heartbeat()


if __name__ == "__main__":
    main()
