"""The laboratory's GUI: roslibpy at the rosbridge. `python -m tests.twin.gui PORT OUT`.

Each message is a line of JSON: when it came, its topic, the message.
"""

from __future__ import annotations

import json
import sys
import time

import roslibpy

TOPICS = {
    "/needle_pose": "geometry_msgs/PoseWithCovarianceStamped",
    "/tf": "tf2_msgs/TFMessage",
    "/acus/events": "std_msgs/String",
}


def main(port: str, out: str) -> None:
    with open(out, "a", buffering=1) as told:

        def hear(topic: str):
            def take(message: dict) -> None:
                line = {"at": time.time(), "name": topic, "message": message}
                told.write(json.dumps(line) + "\n")

            return take

        ros = roslibpy.Ros(host="127.0.0.1", port=int(port))
        topics = [roslibpy.Topic(ros, name, kind) for name, kind in TOPICS.items()]
        for topic in topics:
            topic.subscribe(hear(topic.name))
        ros.run_forever()


if __name__ == "__main__":
    print("listens", flush=True)
    main(*sys.argv[1:])
