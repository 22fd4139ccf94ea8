"""The site's reference of what crosses rooms, made from imports and docstrings while it is built.

A page for each room lists every class and function that another room imports, module by module;
mkdocstrings prints their signatures and docstrings. With `ACUS_DOCS_REFERENCE=false` the pages have
the names alone: that takes a second instead of a minute.
"""

import ast
import os
from collections import defaultdict
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from mkdocs.structure.files import File, Files
from mkdocs.utils import get_relative_url

ROOT = Path(__file__).resolve().parents[1]
APP = ROOT / "app"

_OUT_OF_SEARCH = "---\nsearch:\n  exclude: true\n---\n"
"""Begins a page that only who reads code looks for: its names would hide the guide's answers."""

Crossing = Mapping[str, Mapping[str, set[str]]]
"""Room → module → names that other rooms import from it."""


def rooms() -> list[str]:
    """Rooms of the house by name."""
    return sorted(each.name for each in APP.iterdir() if (each / "__init__.py").is_file())


def crossing() -> Crossing:
    """Find what each room gives to others, by the import statements of the whole program."""
    found: dict[str, dict[str, set[str]]] = {
        room: defaultdict(set) for room in rooms() if room != "commands"
    }
    for file in APP.rglob("*.py"):
        own = file.relative_to(APP).parts[0].removesuffix(".py")
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if not isinstance(node, ast.ImportFrom) or not node.module or node.level:
                continue
            parts = node.module.split(".")
            if parts[0] != "app" or len(parts) < 2 or parts[1] == own or parts[1] not in found:
                continue
            for name in (one.name for one in node.names):
                _add(found[parts[1]], node.module, name)
    return found


def _add(modules: dict[str, set[str]], module: str, name: str) -> None:
    """Add a name, or the module itself where the name is a module."""
    inside = ROOT / module.replace(".", "/") / name
    if inside.with_suffix(".py").is_file() or inside.is_dir():
        modules.setdefault(f"{module}.{name}", set())
    else:
        modules.setdefault(module, set()).add(name)


def page(room: str, modules: Mapping[str, set[str]], whole: bool) -> str:
    """Markdown of a room's page."""
    doc = ast.get_docstring(ast.parse((APP / room / "__init__.py").read_text(encoding="utf-8")))
    lines = [
        f"{_OUT_OF_SEARCH}# {room}",
        "",
        doc or "",
        "",
        f"What other rooms import from `app.{room}`.",
        "",
    ]
    for module in sorted(modules):
        names = sorted(modules[module])
        lines += [f"## {module.removeprefix('app.')}", ""]
        if whole:
            members = "false" if not names else f"[{', '.join(names)}]"
            lines += [
                f"::: {module}",
                "    options:",
                "      show_root_heading: false",
                "      show_root_toc_entry: false",
                f"      members: {members}",
                "",
            ]
        else:
            lines += [", ".join(f"`{name}`" for name in names) or "the module itself", ""]
    return "\n".join(lines)


def index(result: Crossing) -> str:
    """Markdown of the list of rooms."""
    rows = [
        f"| [{room}]({room}.md) | {len(result[room])} | {sum(map(len, result[room].values()))} |"
        for room in result
    ]
    head = [
        f"{_OUT_OF_SEARCH}# Reference",
        "",
        "Made from imports and docstrings by `make docs`.",
        "",
    ]
    table = ["| room | modules that others import | names |", "|---|---|---|"]
    return "\n".join([*head, *table, *rows, ""])


def on_config(config: Any) -> Any:
    """Complete the navigation: the rooms' pages, the decisions, and developers' pages not named."""
    docs = Path(config["docs_dir"])
    sections = (one for one in config["nav"] if isinstance(one, dict))
    developer = next(one["Developer"] for one in sections if "Developer" in one)
    named = set(_named(config["nav"]))
    for entry in developer:
        if "Reference" in entry:
            rooms_pages = [f"reference/{room}.md" for room in crossing()]
            entry["Reference"] = ["reference/index.md", *rooms_pages]
        elif "Decisions" in entry:
            records = sorted(docs.glob("decisions/0*.md"))
            entry["Decisions"] += [f"decisions/{one.name}" for one in records]
    developer[1:1] = sorted(page.name for page in docs.glob("*.md") if page.name not in named)
    return config


def _named(entry: Any) -> Iterator[str]:
    """Pages that the navigation names."""
    if isinstance(entry, str):
        yield entry
    for part in entry if isinstance(entry, list) else ():
        yield from _named(part)
    for part in entry.values() if isinstance(entry, dict) else ():
        yield from _named(part)


def on_files(files: Files, config: Any) -> Files:
    """Add the pages."""
    found = crossing()
    whole = os.environ.get("ACUS_DOCS_REFERENCE", "true") != "false"
    files.append(File.generated(config, "reference/index.md", content=index(found)))
    icon = str(ROOT / "resources" / "icons" / "acus.svg")
    files.append(File.generated(config, "pictures/acus.svg", abs_src_path=icon))
    for room, modules in found.items():
        text = page(room, modules, whole)
        files.append(File.generated(config, f"reference/{room}.md", content=text))
    return files


def on_post_page(output: str, page: Any, config: Any) -> str:
    """Take the search's helper from the site itself: the theme would fetch it."""
    return _without_other_hosts(output, get_relative_url("search_in_files.js", page.url))


def on_post_template(output_content: str, template_name: str, config: Any) -> str:
    """Do the same on pages that are no text."""
    return _without_other_hosts(output_content, "search_in_files.js")


def _without_other_hosts(html: str, helper: str) -> str:
    return html.replace("https://unpkg.com/iframe-worker/shim", helper)
