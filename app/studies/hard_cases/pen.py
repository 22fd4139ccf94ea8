"""Hard cases of the pen with printed markers: one face, face on; a tip that is hardly rocked."""

from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np

from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.studies.hard_cases.cameras import camera
from app.studies.hard_cases.case import HardCase, analytic, answers, named
from app.tracking.pen.body import load_pen
from app.tracking.pen.detector import MarkerSighting
from app.tracking.pen.errors import PenError
from app.tracking.pen.locator import BoardLocator
from app.tracking.pen.pivot import MeasuredPose, pivot
from app.tracking.pen.pose import PoseStatus

DECLARATION: Final[dict[str, Any]] = {
    "title": "Pose and tip of the pen",
    "subsystems": {"pose of the pen": "calibration"},
}

_Way = Callable[..., Any]

BODY: Final = load_pen("cube").body.board()
LOCATOR: Final = BoardLocator(BODY, 0.05)
DIMPLE: Final = np.array([0.1, 0.05, 0.6])
"""Where the tip of a pen stands while it is rocked [m]."""


def _face_on(turn: Sequence[float], distance: float) -> RigidTransform:
    # The cube's first side straight towards the camera, then turned [rad].
    front = np.array([[0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]])
    return RigidTransform(rotation_exp(turn) @ front, np.array([0.0, 0.0, distance]))


def sightings(pose: RigidTransform, *ids: int) -> list[MarkerSighting]:
    """Return what the camera sees of a cube's markers, exactly."""
    return [
        MarkerSighting(m.id, camera().project_camera(pose @ m.corners)[0], 0.01 * np.eye(8))
        for m in BODY.markers
        if m.id in ids
    ]


def _visible(pose: RigidTransform) -> list[int]:
    return [
        m.id for m in BODY.markers if pose.rotate(m.normal) @ (pose @ m.corners.mean(axis=0)) < 0
    ]


def _cube() -> tuple[HardCase, ...]:
    def own(pose: RigidTransform, ids: Sequence[int]) -> Any:
        return LOCATOR.locate(camera(), sightings(pose, *ids))

    def either() -> bool:
        found = own(_face_on((0.03, 0.08, 0.0), 1.0), (0,))
        return found.status is PoseStatus.AMBIGUOUS and bool(np.isfinite(found.covariance).all())

    def error(way: _Way, pose: RigidTransform, ids: Sequence[int]) -> Any:
        found = way(pose, ids)
        if found.status is not PoseStatus.FOUND:
            return np.full(6, np.inf)
        return (found.T_camera_board @ pose.inverse()).log()

    square_on = _face_on((0.0, 0.5, 0.0), 0.4)
    edge_on, half = _face_on((0.0, np.pi / 4, 0.0), 0.5), _face_on((0.0, 0.7, 0.0), 0.3)
    return tuple(
        HardCase(
            subsystem="pose of the pen",
            case=case,
            given=f"cube {pose.translation[2]:g} m away, exact corners",
            way=own,
            found=lambda way, T=pose, i=tuple(ids): error(way, T, i),
            reference=analytic("the pose that was projected", np.zeros(6)),
            unit="m, rad",
            bound=1e-6,  # where the refinement stops: a thousandth of what noise does
            beyond=answers("named AMBIGUOUS for one face almost straight ahead", either),
        )
        for case, pose, ids in (
            ("a cube seen edge on", edge_on, _visible(edge_on)),
            ("one face alone, from the side and near", half, (0,)),
            ("one face alone, turned exactly about its own axis", square_on, (0,)),
        )
    )


def _pivoted() -> tuple[HardCase, ...]:
    tip = np.array([0.0, 0.0, 0.18])

    def poses(rock: float, sides: int = 24) -> list[MeasuredPose]:
        found = []
        for k in range(sides):
            turn = 2.0 * np.pi * k / sides
            rotation = rotation_exp(rock * np.array([np.cos(turn), np.sin(turn), 0.3]))
            T = RigidTransform(rotation, DIMPLE - rotation @ tip)
            found.append(MeasuredPose(T, 1e-8 * np.eye(6)))
        return found

    return tuple(
        HardCase(
            subsystem="pose of the pen",
            case=f"tip of a pen rocked by {words}",
            given="24 exact poses, tip 180 mm away",
            way=pivot,
            found=lambda way, r=rock: way(poses(r)).p_tip,
            reference=analytic("the tip that stood still", tip),
            unit="m",
            bound=bound,
            beyond=named(PenError, lambda: pivot(poses(np.radians(0.5)))),
        )
        for words, rock, bound in (
            ("30°", np.radians(30.0), 1e-12),
            ("15°", np.radians(15.0), 1e-11),
        )
    )


CASES: Final = (*_cube(), *_pivoted())
"""Where the pen is, and where its tip."""
