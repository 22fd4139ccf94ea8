"""The features of the window: every class of `Feature` in a folder of `app.views`, and plug-ins'.

The order is that of panels, and of entries in menus that several share: by `place`, and features of
plug-ins where they say (`feature_plugins`).
"""

from __future__ import annotations

import re
from importlib import import_module
from operator import attrgetter
from pathlib import Path
from typing import Final

from app import views
from app.views.shell.feature import Feature
from app.views.shell.feature_plugins import with_plugins

_CLASS: Final = re.compile(rb"^class (\w+)\(Feature\):$", re.MULTILINE)


def _own() -> tuple[type[Feature], ...]:
    classes: list[type[Feature]] = []
    for path in sorted(Path(views.__file__).parent.glob("*/*.py")):
        for name in _CLASS.findall(path.read_bytes()):
            module = import_module(f"{views.__name__}.{path.parent.name}.{path.stem}")
            classes.append(getattr(module, name.decode()))
    return tuple(sorted(classes, key=attrgetter("place")))


FEATURES: Final = with_plugins(_own())
"""A dropped file is offered to them from the last to the first."""
