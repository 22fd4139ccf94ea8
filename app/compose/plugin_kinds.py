"""What `acus plugin list` looks through for this room."""

from typing import Any, Final

from app.compose.needle_sources import KIND
from app.core.plugins import PluginKind

KINDS: Final[tuple[PluginKind[Any], ...]] = (KIND,)
"""Kinds of plug-ins."""
