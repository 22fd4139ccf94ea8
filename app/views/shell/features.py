"""The list of features: the order is that of panels, and of entries in menus that several share.

Features of plug-ins join it where they say (`feature_plugins`).
"""

from __future__ import annotations

from typing import Final

from app.views.accuracy.feature import AccuracyFeature
from app.views.author.feature import AuthorFeature
from app.views.cameras.feature import CamerasFeature
from app.views.checks.feature import ChecksFeature
from app.views.debrief.feature import DebriefFeature
from app.views.exercise.feature import ExerciseFeature
from app.views.measure.feature import MeasureFeature
from app.views.pen.feature import PenFeature
from app.views.people.feature import PeopleFeature
from app.views.plan.feature import PlanFeature
from app.views.plan.paths import PathsFeature
from app.views.plan.position import PositionFeature
from app.views.robot.feature import RobotFeature
from app.views.scene.feature import SceneFeature
from app.views.series.feature import SeriesFeature
from app.views.shell.feature import Feature
from app.views.shell.feature_plugins import with_plugins
from app.views.sounds.feature import SoundsFeature
from app.views.structures.feature import StructuresFeature

_OWN: Final[tuple[type[Feature], ...]] = (
    SeriesFeature,
    PlanFeature,
    PathsFeature,
    AuthorFeature,
    ExerciseFeature,
    RobotFeature,
    CamerasFeature,
    PenFeature,
    ChecksFeature,
    MeasureFeature,
    StructuresFeature,
    SceneFeature,
    PositionFeature,
    SoundsFeature,
    AccuracyFeature,
    DebriefFeature,
    PeopleFeature,
)

FEATURES: Final = with_plugins(_OWN)
"""A dropped file is offered to them from the last to the first."""
