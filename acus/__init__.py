"""Acus for other programs: records, exercises, scores, kinematics and CT from Python.

These names are promised; what they import from `app`, the program, is not. A change of one of them
is a breaking change. Units are SI unless a name says otherwise (`origin_mm`); docs/python.md shows
them at work. Training only, not a medical device.

    import acus

    record = acus.read_record("sessions/20261120-080001-a001.mcap")
    print(acus.score(record).total)

Names are imported when they are first asked for: `import acus` loads neither numpy nor a kernel,
and nothing here needs a display.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from acus._program import load_program

__version__: str = load_program().__version__

if TYPE_CHECKING:
    from acus._ct import Volume, phantom_ct, read_ct, slice_plane
    from acus._exercises import Trial, exercise, exercises, score, skills, try_exercise
    from acus._machines import Kinematics, Profile, kinematics, profile, profiles
    from acus._records import Record, Replay, Verification, read_record, records, replay, verify
    from app.core.errors import AcusError
    from app.core.events import Event
    from app.exercises.schema import Exercise
    from app.scoring.result import Score
    from app.scoring.rows import Row

__all__ = [
    "AcusError",
    "Event",
    "Exercise",
    "Kinematics",
    "Profile",
    "Record",
    "Replay",
    "Row",
    "Score",
    "Trial",
    "Verification",
    "Volume",
    "__version__",
    "exercise",
    "exercises",
    "kinematics",
    "phantom_ct",
    "profile",
    "profiles",
    "read_ct",
    "read_record",
    "records",
    "replay",
    "score",
    "skills",
    "slice_plane",
    "try_exercise",
    "verify",
]

_MODULES = {
    "AcusError": "app.core.errors",
    "Event": "app.core.events",
    "Exercise": "app.exercises.schema",
    "Kinematics": "acus._machines",
    "Profile": "acus._machines",
    "Record": "acus._records",
    "Replay": "acus._records",
    "Row": "app.scoring.rows",
    "Score": "app.scoring.result",
    "Trial": "acus._exercises",
    "Verification": "acus._records",
    "Volume": "acus._ct",
    "exercise": "acus._exercises",
    "exercises": "acus._exercises",
    "kinematics": "acus._machines",
    "phantom_ct": "acus._ct",
    "profile": "acus._machines",
    "profiles": "acus._machines",
    "read_ct": "acus._ct",
    "read_record": "acus._records",
    "records": "acus._records",
    "replay": "acus._records",
    "score": "acus._exercises",
    "skills": "acus._exercises",
    "slice_plane": "acus._ct",
    "try_exercise": "acus._exercises",
    "verify": "acus._records",
}


def __getattr__(name: str) -> Any:
    """Import a name of this package from its module."""
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(_MODULES[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """List the promised names, imported or not."""
    return sorted(__all__)
