"""The arm with its hand and its long tool: all that only this machine needs, in one folder.

In simulation only: nothing here drives a real arm or a real hand. A folder of plug-ins: the program
finds its features, demonstration, studies, hard cases and row of the table of machines by their
being there (`core.plugin_folders`), and nothing outside of it names it. From the bottom:
`mechanics`, `hand` and `laparoscopy` are the mathematics, `motion` plans, `scene` moves it in
MuJoCo, `eyes` look for tool and trocar in pictures, `run` joins scene and eyes, `studies`,
`hard_cases` and `comparisons` measure, `views` and `features` show it in the window, and
`demonstrations` is what `acus demo --device arm` does. Studies import the public names of these
packages only.
"""

from typing import Any, Final

DECLARATION: Final[dict[str, Any]] = {"title": "The arm with its hand and its long tool"}
