"""Device profiles as files."""

from pathlib import Path

from app.core import paths
from app.core.configuration import load
from app.core.errors import ConfigurationError
from app.mechanisms.profile.device import DeviceProfile


def profile_names() -> list[str]:
    """Names of the shipped device profiles."""
    return sorted(path.stem for path in _folder().glob("*.yaml"))


def load_profile(name_or_path: str | Path) -> DeviceProfile:
    """Load a shipped profile by name, or any profile by the path of its YAML file.

    Raises:
        ConfigurationError: if there is none (names the valid names), or the file is wrong.
    """
    text = str(name_or_path)
    if text in profile_names():
        return load(_folder() / f"{text}.yaml", DeviceProfile)
    path = Path(name_or_path)
    if path.suffix not in (".yaml", ".yml"):
        raise ConfigurationError(
            f"no device profile {text!r}; valid names: {', '.join(profile_names())},"
            " or the path of a .yaml file"
        )
    return load(path, DeviceProfile)


def _folder() -> Path:
    return paths.resources() / "devices"
