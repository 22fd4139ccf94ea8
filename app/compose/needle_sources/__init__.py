"""What may move the needle in place of robot and cameras: one file each, such as `pen`.

A needle source gives the loop its joint angles and a tracker its fixes; nothing pushes the hand. A
file is found by being here, or in `needle_sources/` of a folder of plug-ins, and imported when it
is used. It declares its `title`, and its `noun` for sentences, and defines

- `source(pictures)`, which returns what builds a `NeedleSource` of an exercise's device;
- `replay_table(exercise, placed, profile, skill, seed, simulated)`, the table that a recorded
  attempt is computed again with;
- `check(pictures)`, if where it looks can be judged at once;
- `preview(settings)`, if it has a page in the window: what the page looks at, opened, without a
  loop.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, Protocol

from app.core.messages import sentence
from app.core.plugins import TEXT, Declaration, PluginKind
from app.tracking.cameras.source import parse_source
from app.tracking.errors import TrackingError
from app.tracking.needle_tracker import NeedleTracker

if TYPE_CHECKING:
    from pydantic import BaseModel

    from app.core.clock import Clock
    from app.device.control import Loop, Table
    from app.exercises.schema import Exercise
    from app.mechanisms.profile import DeviceProfile
    from app.planning.placement import PlacedPlan
    from app.tracking.fix import NeedleFix


class SourceTracker(NeedleTracker, Protocol):
    """A tracker that moves the loop itself, and hands on its fixes afterwards."""

    def listen(self, on_fix: Callable[[NeedleFix], None]) -> None:
        """Call `on_fix` with every fix from now on, in the tracker's thread."""


class NeedleSource(Protocol):
    """What moves the needle of a rig in place of robot and cameras."""

    @property
    def profile(self) -> DeviceProfile:
        """Return the geometry of the exercise's device, which renders no force."""

    @property
    def noun(self) -> str:
        """Return what it is, with its article, for sentences."""

    @property
    def simulated(self) -> bool:
        """Return whether a simulated hand holds the needle."""

    def table(self, exercise: Exercise, placed: PlacedPlan, skill: str | None, seed: int) -> Table:
        """Return the table of a tick; `skill` of the scripted trainee, None without one."""

    def tracker(self, loop: Loop, clock: Clock, seed: int) -> SourceTracker:
        """Return the tracker that moves the loop, not open yet.

        Raises:
            CameraError: if its pictures cannot be had.
        """

    def metadata(self, skill: str | None) -> Mapping[str, dict[str, str]]:
        """Return facts for the head of a record: `device`, `cameras`, `trainee`.

        The `name` of `device` is that of the source's file, and a key of `device` too: whether the
        hand is simulated, `yes` or `no`.
        """

    def documents(self) -> Mapping[str, BaseModel]:
        """Return what a record has attached beside exercise and device, by name."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclaredSource(Declaration):
    """What the file of a needle source says about itself.

    Attributes:
        noun: what it is, with its article, for sentences.
    """

    noun: str


KIND: Final[PluginKind[DeclaredSource]] = PluginKind(
    noun="a needle source",
    declares=DeclaredSource,
    fields={"title": TEXT, "noun": TEXT},
    error=TrackingError,
    package=__name__,
    folder="needle_sources",
    functions=("source", "replay_table"),
)


def needle_source(name: str, pictures: str) -> Callable[[DeviceProfile], NeedleSource]:
    """Return what builds a needle source of an exercise's device; nothing is opened.

    Args:
        name: of its file.
        pictures: where its pictures come from, such as `usb:0` or `simulated`.

    Raises:
        AcusError: if there is no such source, or its pictures or settings cannot be used.
    """
    declared = KIND.find(name)
    module = KIND.load(declared)
    with KIND.blamed(declared.path, "source() does not work"):
        made: Callable[[DeviceProfile], NeedleSource] = module.source(pictures)
    return made


def named(text: str) -> tuple[str, str]:
    """Return which source a text names, and where it looks: `NAME:…` of a file here, or the
    pictures of a pen's webcam, such as `usb:0`.
    """
    name, _, rest = text.partition(":")
    return (name, rest) if name in KIND.names() else ("pen", text)


def check(text: str) -> None:
    """Look at what a text names before a window opens, as far as that is quick.

    Raises:
        AcusError: if there is no such source, or no such place.
    """
    name, place = named(text)
    declared = KIND.find(name)
    if name == "pen":
        parse_source(place)
    elif (look := getattr(KIND.load(declared), "check", None)) is not None:
        look(place)


def open_preview(name: str, settings: object) -> Any:
    """Open what the page of a needle source looks at, without a loop.

    Args:
        name: of its file.
        settings: as the page has them.

    Raises:
        AcusError: if there is no such source, it has no page, or it cannot be opened.
    """
    declared = KIND.find(name)
    preview = getattr(KIND.load(declared), "preview", None)
    if preview is None:
        raise TrackingError(
            sentence(
                "{declared_path} has no function preview(): it has no page",
                declared_path=declared.path,
            )
        )
    with KIND.blamed(declared.path, "preview() does not work"):
        return preview(settings)


def recorded_table(
    metadata: Mapping[str, Mapping[str, str]],
    exercise: Exercise,
    placed: PlacedPlan,
    profile: DeviceProfile,
    skill: str | None,
    seed: int,
) -> Table | None:
    """Return the table to replay a record of a needle source with; None for a robot's record.

    Raises:
        AcusError: if this program has no such source.
    """
    device = metadata.get("device", {})
    name = device.get("name", "")
    if name == "simulated" or device.get(name) not in ("yes", "no"):
        return None
    declared = KIND.find(name)
    module, simulated = KIND.load(declared), device[name] == "yes"
    with KIND.blamed(declared.path, "replay_table() does not work"):
        table: Table = module.replay_table(exercise, placed, profile, skill, seed, simulated)
    return table
