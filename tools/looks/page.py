"""A page that shows all pictures of `make looks`, with what is wrong in them."""

from __future__ import annotations

import os
from collections.abc import Iterable
from html import escape
from pathlib import Path
from typing import Final

from tools.looks.gallery import Look
from tools.looks.measure import TOLERANCE

_HEAD: Final = """<!doctype html><html lang="en"><meta charset="utf-8"><title>Looks of Acus</title>
<style>
body { font: 15px/1.5 sans-serif; background: #14171a; color: #e8ecef; margin: 24px; }
h2 { margin: 32px 0 8px; } figure { display: inline-block; margin: 0 16px 16px 0; width: 440px;
vertical-align: top; } img { width: 100%; border: 1px solid #3a4149; } .bad img { border-color:
#ff6b5e; } li { color: #ff6b5e; } a { color: #4aa3df; } figcaption { color: #a5afb8; }
nav a { margin-right: 12px; }
</style>
"""


def write(looks: Iterable[Look], folder: Path, store: Path) -> Path:
    """Write `index.html` into the folder of the pictures; return its path."""
    states: dict[str, list[Look]] = {}
    for look in looks:
        states.setdefault(look.state, []).append(look)
    links = "".join(f'<a href="#{name}">{name}</a>' for name in states)
    parts = [_HEAD, f"<h1>{len(states)} states</h1><nav>{links}</nav>"]
    for name, some in states.items():
        parts.append(f'<h2 id="{name}">{name}</h2>')
        kept = store / f"{name}.png"
        if kept.is_file():
            parts.append(_figure(os.path.relpath(kept, folder), "kept", []))
        for look in some:
            lines = [f"{one['rule']}: {one['where']}: {one['words']}" for one in look.faults]
            if look.differs is not None and look.differs > TOLERANCE:
                lines.append(f"differs in {100 * look.differs:.1f} % of it")
            parts.append(_figure(look.file, f"{look.language}, {look.theme}, {look.size}", lines))
    page = folder / "index.html"
    page.write_text("\n".join(parts), encoding="utf-8")
    return page


def _figure(file: str, words: str, faults: list[str]) -> str:
    lines = "".join(f"<li>{escape(line)}</li>" for line in faults)
    return (
        f'<figure class="{"bad" if faults else ""}"><a href="{file}"><img loading="lazy" '
        f'src="{file}" alt="{escape(words)}"></a><figcaption>{escape(words)}'
        f"<ul>{lines}</ul></figcaption></figure>"
    )
