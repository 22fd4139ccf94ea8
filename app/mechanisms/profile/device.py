"""One robot: its sections, and what the other rooms ask of it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from importlib import import_module
from math import radians
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any, Final

from pydantic import model_validator

from app import mechanisms
from app.core import paths, plugin_folders
from app.core.arrays import FloatArray, frozen
from app.core.configuration import Strict, parse, parse_yaml, read_text
from app.core.errors import ConfigurationError
from app.core.messages import sentence
from app.core.plugin_trial import import_fault
from app.core.trial import Trial
from app.mechanisms.profile.control import (
    DEFAULT_VELOCITY,
    LET_GO_UNSTATED,
    Axis,
    EncoderSection,
    FixtureSection,
    HandSection,
    HaplySection,
    LetGoLimit,
    LimitSection,
    LoopSection,
    MotorSection,
    VelocityMethod,
    WireSection,
)
from app.mechanisms.profile.mechanics import (
    CentreSection,
    FrictionSection,
    MountingSection,
    NeedleSection,
    WorkspaceSection,
)

if TYPE_CHECKING:
    from app.mechanisms.remote_centre import RemoteCentre

LONGEST_NEEDLE: Final = 0.5
"""No needle for this work is longer [m]."""


class DeviceProfile(Strict):
    """One robot. Values are SI; each section carries the provenance of its values.

    `kind` says what machine it is: the folder of `mechanisms` whose `profile.py` has the sections
    of its own. `velocity` is how joint velocities come from its encoders' angles.
    """

    kind: str
    name: str
    description: str
    geometry: CentreSection
    workspace: WorkspaceSection
    encoder: EncoderSection
    limits: LimitSection
    fixture: FixtureSection
    inertia: NeedleSection
    friction: FrictionSection
    motor: MotorSection
    mounting: MountingSection
    wire: WireSection
    loop: LoopSection
    hand: HandSection = HandSection()
    velocity: VelocityMethod = DEFAULT_VELOCITY
    haply: HaplySection | None = None

    @model_validator(mode="after")
    def _fits_the_needle(self) -> DeviceProfile:
        length, deepest = self.geometry.needle_length, self.workspace.depth_max
        if deepest >= length:
            raise ValueError(
                sentence(
                    "workspace.depth_max {deepest:g} m must be below geometry.needle_length"
                    " {length:g} m: the hub stays outside the fulcrum",
                    deepest=deepest,
                    length=length,
                )
            )
        if self.inertia.needle_centre > length:
            raise ValueError(
                sentence(
                    "inertia.needle_centre {inertia_needle_centre:g} m must lie on the needle of"
                    " geometry.needle_length {length:g} m",
                    inertia_needle_centre=self.inertia.needle_centre,
                    length=length,
                )
            )
        return self

    @property
    def machine(self) -> RemoteCentre:
        """Return what the robot is, to be asked about poses, forces and stages; loads compiled
        code.

        Raises:
            ConfigurationError: if a file of the user's own cannot be used, or fails its trial;
                names it.
        """
        if fault := trial_fault(self):
            raise ConfigurationError(
                sentence(
                    "device {name}: machine {kind!r} cannot be used: {fault}",
                    name=self.name,
                    kind=self.kind,
                    fault=fault,
                )
            )
        return untried_machine(self)

    @property
    def fulcrum(self) -> FloatArray:
        """Remote centre in world [m], shape (3,)."""
        return frozen(self.geometry.fulcrum)

    @property
    def needle_length(self) -> float:
        """Hub point to tip [m]."""
        return self.geometry.needle_length

    @property
    def joint_inertia(self) -> float:
        """Inertia of a joint alone, the lightest that it can be found with [kg·m²]."""
        raise NotImplementedError

    @property
    def links_potential_bound(self) -> float:
        """Bound of the magnitude of gravity's potential without the needle, over all poses [J]."""
        raise NotImplementedError

    @property
    def holds_direction(self) -> bool:
        """Return whether the robot can hold a direction by itself, beyond the forces of laws."""
        return False

    @property
    def tension_range(self) -> tuple[float, float] | None:
        """Least and largest tension of its cables [N]; None where it has none."""
        return None

    @property
    def fastest_reel(self) -> float:
        """Fastest that its winches reel in [m/s]; 0 where it has none."""
        return 0.0

    @property
    def gear(self) -> float:
        """Motor turns per joint turn; 1 where no gear stands between them [-]."""
        return 1.0

    @property
    def shortest_needle(self) -> float:
        """Length that a needle must exceed [m]."""
        return max(self.workspace.depth_max, self.inertia.needle_centre)

    @property
    def tilt_limit_deg(self) -> float:
        """Tilt limit of the mounted joint [°]."""
        return self.workspace.tilt_limit_deg[self.workspace.joint]

    @property
    def tilt_limit(self) -> float:
        """Tilt limit of the mounted joint [rad]."""
        return radians(self.tilt_limit_deg)

    @property
    def depth_range(self) -> tuple[float, float]:
        """Depths of the tip beyond the fulcrum that the device allows [m]."""
        return self.workspace.depth_min, self.workspace.depth_max

    @property
    def let_go(self) -> LetGoLimit:
        """Limit of a needle that is let go: the profile's, or that of a profile which states none.

        `limits.let_go` is None in the latter case.
        """
        return self.limits.let_go or LET_GO_UNSTATED

    @property
    def rate_hz(self) -> float:
        """Rate of the control loop [Hz]."""
        return self.loop.rate_hz

    @property
    def renders(self) -> tuple[Axis, ...]:
        """Directions in which the device can push the needle."""
        return self.loop.renders

    def with_joint(self, joint: str) -> DeviceProfile:
        """Return the profile with another of its ball joints mounted.

        Raises:
            ConfigurationError: if the profile has no such joint; names those it has.
        """
        names = sorted(self.workspace.tilt_limit_deg)
        if joint not in names:
            raise ConfigurationError(
                sentence(
                    "device {name}: no joint {joint!r}; valid names: {names}",
                    name=self.name,
                    joint=joint,
                    names=", ".join(names),
                )
            )
        workspace = self.workspace.model_copy(update={"joint": joint})
        return self.model_copy(update={"workspace": workspace})

    def with_needle(self, length: float) -> DeviceProfile:
        """Return the profile with a needle of another length mounted [m].

        Raises:
            ConfigurationError: if the device cannot hold or use it; says what would be valid.
        """
        least = self.shortest_needle
        if not least < length < LONGEST_NEEDLE:
            raise ConfigurationError(
                sentence(
                    "device {name}: a needle of {length:g} m; it holds needles longer than"
                    " {least:g} m and shorter than {longest_needle:g} m",
                    name=self.name,
                    length=length,
                    least=least,
                    longest_needle=LONGEST_NEEDLE,
                )
            )
        geometry = self.geometry.model_copy(update={"needle_length": length})
        return self.model_copy(update={"geometry": geometry})


def kinds() -> list[str]:
    """Kinds of machines: the program's own, those of plug-ins, and folders of the user's own."""
    for own in map(str, paths.plugin_places("mechanisms")):
        if own not in mechanisms.__path__:
            mechanisms.__path__.append(own)
    shared = (folder.path / _SHARED for folder in plugin_folders.folders())
    places = (*map(Path, mechanisms.__path__), *shared)
    return sorted({path.parent.name for folder in places for path in _profiles_in(folder)})


def _profiles_in(folder: Path) -> Iterator[Path]:
    # A machine has both files.
    return (p for p in folder.glob("*/profile.py") if (p.parent / "machine.py").is_file())


_SHARED: Final = "machines"
"""Subfolder of a folder of plug-ins that holds machines."""


def _home(kind: str) -> tuple[Path, str, bool]:
    """Return where a machine's folder lies, the package that is, and whether it is our own."""
    shared = (f for f in plugin_folders.folders() if (f.path / _SHARED / kind).is_dir())
    if (_OWN / kind).is_dir():
        return _OWN, mechanisms.__name__, True
    for folder in shared:
        return folder.path / _SHARED, f"{folder.package}.{_SHARED}", folder.is_own
    places = paths.plugin_places("mechanisms")
    own = next((place for place in places if (place / kind).is_dir()), places[0])
    return own, mechanisms.__name__, False


DEFAULT_KIND: Final = "pantograph"
"""Kind of a profile or record that says none: all were, before there was another."""


def profile_class(kind: object, origin: str) -> type[DeviceProfile]:
    """Return what a profile of a kind is read as; `origin` names it in messages.

    Raises:
        ConfigurationError: if there is no such machine, naming the valid kinds, or its own file
            cannot be used.
    """
    if kind not in kinds():
        raise ConfigurationError(
            sentence(
                "{origin}: kind: there is no machine of kind {kind!r}; valid kinds: {kinds}",
                origin=origin,
                kind=kind,
                kinds=", ".join(kinds()),
            )
        )
    module = _part(str(kind), "profile", origin)
    found: type[DeviceProfile] | None = getattr(module, "PROFILE", None)
    if found is None:
        raise ConfigurationError(
            sentence(
                "{origin}: machine {kind!r}: {module_file} has no PROFILE",
                origin=origin,
                kind=kind,
                module_file=module.__file__,
            )
        )
    return found


def _part(kind: str, name: str, origin: str) -> ModuleType:
    """Import a file of a machine; one of the user's own only where that was seen to go well."""
    fault, reason = machine_fault(kind, name), None
    _, package, is_own = _home(kind)
    if not fault:
        try:
            return import_module(f"{package}.{kind}.{name}")
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # whatever somebody's file does
            if is_own:
                raise
            fault, reason = str(error) or type(error).__name__, error
    raise ConfigurationError(
        sentence(
            "{origin}: machine {kind!r} cannot be used: {fault}",
            origin=origin,
            kind=kind,
            fault=fault,
        )
    ) from reason


def machine_fault(kind: str, name: str) -> str:
    """Say why a file of a machine of somebody else's cannot be imported; else nothing.

    Args:
        kind: folder of the machine.
        name: `profile` or `machine`.
    """
    path = _foreign(kind, name)
    if path is None:
        return ""
    folder, package, _ = _home(kind)
    fault = import_fault(path, package, folder)
    return f"{path}: {fault}" if fault else ""


def _foreign(kind: str, name: str) -> Path | None:
    """Return a file of a machine that is not the program's own; None if it is, or is not there."""
    folder, _, own = _home(kind)
    path = folder / kind / f"{name}.py"
    return None if own or not path.is_file() else path


def is_own(kind: str) -> bool:
    """Return whether a machine is one of the program's own."""
    return _home(kind)[2]


TRIAL: Final = Trial("app.mechanisms.machine_trial")
_passed: set[tuple[Path, str]] = set()


def trial_fault(profile: DeviceProfile) -> str:
    """Say why a machine that is not the program's own fails its trial; nothing if it passes.

    The trial is of the machine with the numbers of its profile, whatever needle and joint are
    mounted, and remembered.
    """
    path = _foreign(profile.kind, "machine")
    if path is None:
        return ""
    usual = profile.with_joint(min(profile.workspace.tilt_limit_deg))
    with suppress(ConfigurationError):
        usual = usual.with_needle(_USUAL_NEEDLE)
    argument = usual.model_dump_json()
    if (path, argument) in _passed:
        return ""
    fault = machine_fault(profile.kind, "machine") or TRIAL.fault(path, argument)
    if not fault:
        _passed.add((path, argument))
    return fault


def refused_by_trial(kind: str) -> str:
    """Say why a trial of somebody else's machine has refused it, with the profiles that are known
    by name or with another before; nothing if none has.
    """
    path = _foreign(kind, "machine")
    if path is None:
        return ""
    for name in profile_names():
        with suppress(ConfigurationError):  # of somebody else's
            profile = load_profile(name)
            if profile.kind == kind and (fault := trial_fault(profile)):
                return fault
    return TRIAL.refusal(path)


def untried_machine(profile: DeviceProfile) -> RemoteCentre:
    """Return the machine of a profile, see `DeviceProfile.machine`, without its trial."""
    module = _part(profile.kind, "machine", f"device {profile.name}")
    found: RemoteCentre = module.machine(profile)
    return found


_USUAL_NEEDLE: Final = 0.2  # [m]
_OWN: Final = Path(mechanisms.__file__ or "").parent


def parse_profile(document: Any, origin: str, text: str = "") -> DeviceProfile:
    """Check a profile that is in memory, as what its `kind` says it is; see `core.configuration`.

    Raises:
        ConfigurationError: for an unknown kind, or naming every field that is wrong.
    """
    kind = document.get("kind", DEFAULT_KIND) if isinstance(document, Mapping) else DEFAULT_KIND
    return parse(document, profile_class(kind, origin), origin, text)


def profile_names() -> list[str]:
    """Return the names of the shipped device profiles and of those in folders of plug-ins."""
    return sorted(_profiles())


def load_profile(name_or_path: str | Path) -> DeviceProfile:
    """Load a shipped profile by name, or any profile by the path of its YAML file.

    Raises:
        ConfigurationError: if there is none (names the valid names), or the file is wrong.
    """
    text = str(name_or_path)
    path = _profiles().get(text, Path(name_or_path))
    if path.suffix not in (".yaml", ".yml"):
        raise ConfigurationError(
            sentence(
                "no device profile {wanted!r}; valid names: {profile_names},"
                " or the path of a .yaml file",
                wanted=text,
                profile_names=", ".join(profile_names()),
            )
        )
    content = read_text(path)
    return parse_profile(parse_yaml(content, str(path)), str(path), content)


def _profiles() -> dict[str, Path]:
    """Return the files of profiles by name; a shipped one keeps its name."""
    shared = (folder.path / "devices" for folder in plugin_folders.folders())
    places = (paths.resources() / "devices", *shared)
    files = [path for place in places for path in sorted(place.glob("*.yaml"))]
    return {path.stem: path for path in reversed(files)}
