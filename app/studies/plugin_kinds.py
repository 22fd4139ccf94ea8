"""What `acus plugin list` looks through for this room."""

from typing import Any, Final

from app.core.plugins import PluginKind
from app.studies.runner import KIND

KINDS: Final[tuple[PluginKind[Any], ...]] = (KIND,)
"""Kinds of plug-ins."""
