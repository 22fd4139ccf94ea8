"""Make sure that `app` is the program that this package belongs to.

The program is the package `app` beside this one. The name is a common one: a folder `app` on
`PYTHONPATH` or in the working directory would come first in an ordinary import. So the program is
loaded from its file, once, and every `import app…` afterwards gets it.
"""

import importlib.util
import os
import sys
from types import ModuleType

_FOLDER = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "app")


def load_program() -> ModuleType:
    """Return the program's package, loaded if it was not.

    Raises:
        ImportError: if another `app` was imported before, or there is no program beside.
    """
    own = os.path.join(_FOLDER, "__init__.py")
    known = sys.modules.get("app")
    if known is not None:
        place = getattr(known, "__file__", None) or ""
        if os.path.realpath(place) != os.path.realpath(own):
            raise ImportError(
                f"another package named app is in use here, {place or 'without a file'}: acus needs"
                f" its own, {own}; import acus before it, or use acus in a process of its own"
            )
        return known
    specification = importlib.util.spec_from_file_location(
        "app", own, submodule_search_locations=[_FOLDER]
    )
    if specification is None or specification.loader is None or not os.path.isfile(own):
        raise ImportError(f"the program is missing: there is no {own}; install acus anew")
    module = sys.modules["app"] = importlib.util.module_from_spec(specification)
    try:
        specification.loader.exec_module(module)
    except BaseException:
        del sys.modules["app"]
        raise
    return module
