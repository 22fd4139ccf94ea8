"""Wrong ways to find the pen and its tip, each of which a hard case must catch."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from app.core.arrays import unit
from app.core.transform import RigidTransform
from app.studies.hard_cases.cameras import camera
from app.studies.hard_cases.pen import DIMPLE, LOCATOR, sightings
from app.tracking.pen.pivot import MeasuredPose, pivot
from tests.hard.defects import Defect


def blurred(pose: RigidTransform, ids: Sequence[int]) -> Any:
    off = [
        replace(s, corners=s.corners + 0.1 * (i + 1)) for i, s in enumerate(sightings(pose, *ids))
    ]
    return LOCATOR.locate(camera(), off)


def mean_of_axes(poses: Sequence[MeasuredPose]) -> Any:
    # The dimple as the mean of all tips that the pen would have without a tip.
    found = pivot(poses)
    mean = np.mean([pose.T.translation for pose in poses], axis=0)
    return replace(found, p_tip=unit(found.p_tip) * np.linalg.norm(mean - DIMPLE))


DEFECTS = {
    "pose of the pen": {
        **dict.fromkeys(
            (
                "a cube seen edge on",
                "one face alone, from the side and near",
                "one face alone, turned exactly about its own axis",
            ),
            Defect("corners 0.1 px off, each marker further", blurred),
        ),
        **dict.fromkeys(
            ("tip of a pen rocked by 30°", "tip of a pen rocked by 15°"),
            Defect("distance of the mean pose from the dimple", mean_of_axes),
        ),
    },
}
