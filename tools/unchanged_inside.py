"""Print what no command of the program tells; `tools/unchanged.py` runs it and keeps the text.

    python tools/unchanged_inside.py commands | pseudonyms | wire PAGE | declared ROOT

It reads a program that may be older or newer than this file. All of the program's own names that it
and `unchanged_window.py` use stand in `NAMES`, each with the places where it may be, tried in their
order: where a name has moved, add the new place.
"""

from __future__ import annotations

import ast
import enum
import hashlib
import json
import re
import sys
from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path
from typing import Any, Final

NAMES: Final[dict[str, tuple[str, ...]]] = {
    "command line": ("app.commands:build",),
    "study's pseudonym": ("app.imaging.privacy.pseudonyms:pseudonym",),
    "patient's pseudonym": ("app.imaging.privacy.pseudonyms:patient_pseudonym",),
    "installation's key": ("app.imaging.privacy.key:installation_key",),
    "student's pseudonym": ("app.session.header:pseudonym",),
    "framing": ("app.device.links.framing",),
    "acus protocol": ("app.device.links.acus_protocol",),
    "haply protocol": ("app.device.links.haply_protocol",),
    "host end": ("app.device.links.host_end",),
    "wire": ("app.device.links.wire",),
    "speech of a profile": ("app.device.links.protocols:speech_of",),
    "board's info": ("app.device.links.link:BoardInfo",),
    "device profile": ("app.mechanisms.profile:load_profile",),
    "state vector": ("app.core.state_vector",),
    "start of Qt": ("app.views.shell.application:start",),
    "services": ("app.compose.desktop:Desktop",),
    "window": ("app.views.shell.window:MainWindow",),
    "who is signed in": ("app.views.kit.access:ACCESS",),
    "people": ("app.session.people:People",),
    "line of a roster": ("app.session.roster:RosterLine",),
}
"""What it is -> `module` or `module:attribute`, the first that exists is taken."""


def name(what: str) -> Any:
    """Return an object of the program.

    Raises:
        SystemExit: if it is at none of its places.
    """
    for place in NAMES[what]:
        module, _, attribute = place.partition(":")
        try:
            part = import_module(module)
            return getattr(part, attribute) if attribute else part
        except (ModuleNotFoundError, AttributeError):
            continue
    raise SystemExit(f"{what}: at none of {', '.join(NAMES[what])}; add its place to NAMES")


# --- the command line ----------------------------------------------------------------------------
def commands() -> Iterator[str]:
    """Yield every command with its help, and its parameters with names, kinds and defaults."""
    import typer

    built = name("command line")()
    root = typer.main.get_command(built) if isinstance(built, typer.Typer) else built
    yield from _command("acus", root)


def _command(path: str, command: Any) -> Iterator[str]:
    yield f"{path}{'  (hidden)' if command.hidden else ''}"
    yield from (f"    | {line}".rstrip() for line in (command.help or "").splitlines())
    for parameter in command.params:
        marks = ("required", "multiple", "hidden", "is_flag", "envvar", "metavar", "min", "max")
        given = {mark: getattr(parameter, mark, None) for mark in marks}
        shown = {mark: value for mark, value in given.items() if value not in (None, False)}
        default = "computed" if callable(parameter.default) else repr(parameter.default)
        names = ", ".join([*parameter.opts, *parameter.secondary_opts])
        kind = f"{parameter.param_type_name} {names}: {_kind(parameter)}"
        yield f"    {kind}, default {default}, {shown}"
        told = getattr(parameter, "help", None) or ""
        yield from (f"        | {line}" for line in told.splitlines())
    yield ""
    for child, below in sorted(getattr(command, "commands", {}).items()):
        yield from _command(f"{path} {child}", below)


def _kind(parameter: Any) -> str:
    """Return the type of a value: typer's own annotation, or click's parameter type."""
    described = getattr(parameter, "type_descriptor", None)
    if described is None:
        kind = parameter.type
        limits = [getattr(kind, name, None) for name in ("choices", "min", "max")]
        return f"{kind.name} {limits}"
    annotation = described.annotation
    words = annotation.__name__ if isinstance(annotation, type) else str(annotation)
    return f"{words} {[one.value for one in annotation]}" if _is_enum(annotation) else words


def _is_enum(annotation: Any) -> bool:
    return isinstance(annotation, type) and issubclass(annotation, enum.Enum)


# --- pseudonyms ----------------------------------------------------------------------------------
IDENTITIES: Final = (
    ("12345678", "1.2.840.113619.2.55.3.1", ""),
    ("12345678", "1.2.840.113619.2.55.3.2", "7"),
    ("", "1.2.840.113619.2.55.3.1", ""),
    ("Müller^Änne", "1.2.3", "CT-0011AAFF"),
    ("Müller^Änne", "1.2.3", "CT-0011aaff"),
)
STUDENTS: Final = ("", "  Ada\tLovelace ", "S-17", "x" * 80, "a\nb\u200bc", "Ωmega ✓")


def pseudonyms() -> Iterator[str]:
    """Yield the pseudonyms of patients under the fixed key, and of students in records."""
    key = name("installation's key")()
    yield f"key {hashlib.sha256(key).hexdigest()}"
    of_study, of_patient = name("study's pseudonym"), name("patient's pseudonym")
    for patient, study, number in IDENTITIES:
        names = of_study(patient, study, number), of_patient(key, patient, study)
        yield f"{patient!r} {study!r} {number!r} -> {' '.join(names)}"
    of_student = name("student's pseudonym")
    yield from (f"{student!r} -> {of_student(student)!r}" for student in STUDENTS)


# --- the wire ------------------------------------------------------------------------------------
def wire(page: Path) -> Iterator[str]:
    """Yield what the page's examples decode to, and what the program itself sends and takes."""
    framing, acus = name("framing"), name("acus protocol")
    text = page.read_text(encoding="utf-8")
    frames = []
    for data, words in re.findall(r"^((?:[0-9a-f]{2} )+)= (.*)$", text, re.MULTILINE):
        raw = bytes.fromhex(data)
        deframer = framing.Deframer()
        payloads = list(deframer.feed(raw))
        again = [framing.frame(payload).hex(" ") for payload in payloads]
        yield f"{raw.hex(' ')} = {words}"
        yield f"    payloads {[one.hex(' ') for one in payloads]}, errors {deframer.errors}"
        yield f"    framed again {again}"
        frames.append((raw, payloads))
        for payload in payloads:
            if payload[0] == acus.INFO:
                yield f"    {acus.read_info(payload)!r}"
    yield f"hello {acus.hello(1).hex(' ')}, {acus.hello(2).hex(' ')}"
    yield f"home {acus.home(0x1234).hex(' ')}"
    for profile_name in ("icube", "haply-2diy", "tensegrity"):
        yield from _spoken(profile_name, [raw for raw, _ in frames])


def _spoken(profile_name: str, frames: list[bytes]) -> Iterator[str]:
    """Yield what the stages of a profile's protocol send, and how they take each example."""
    import numpy as np

    host, ends, sv = name("host end"), name("wire"), name("state vector")
    profile = name("device profile")(profile_name)
    speech = name("speech of a profile")(profile)
    info = name("board's info")(profile_name, "A0007", "1.0", "acus 1", 0x1234, False)
    read, write = speech.stages

    def fresh() -> tuple[Any, Any]:
        end, state = np.zeros(host.SIZE), sv.empty_state()
        speech.fill(end)
        speech.greeted(end, info)
        end[host.STATUS], end[ends.SEQUENCE], state[sv.TIME] = 0.0, 257.0, 1.0
        end[ends.NOW] = 1.0
        return end, state

    yield profile_name
    if profile_name == "haply-2diy":
        haply = name("haply protocol")
        yield f"    setup {haply.setup(profile).hex(' ')}"
        yield f"    request {haply.read_request(profile).hex(' ')}"
    else:
        packed = name("acus protocol").pack_info(profile, "A0007", 0x1234, True)
        yield f"    info {packed.hex(' ')}"
    slots = {"TORQUE_LEFT": 0.25, "TORQUE_RIGHT": -0.125, "TENSION_1": 2.0, "TENSION_2": 12.5}
    slots |= {"TENSION_3": 2.0, "TENSION_4": 40.0, "REEL_RATE_1": 0.01, "REEL_RATE_2": -0.01}
    for enabled, holds, homes in ((1, 0, 0), (0, 0, 0), (1, 1, 0), (1, 0, 1)):
        end, state = fresh()
        for slot, value in slots.items():
            state[getattr(sv, slot)] = value
        state[sv.ENABLED], state[sv.HOLDING], end[host.HOME_WANTED] = enabled, holds, homes
        write(state, end)
        sent = ends.outgoing(end)[: int(end[ends.OUT_COUNT])].tobytes()
        yield f"    enabled {enabled} holds {holds} homes {homes}: {sent.hex(' ')}"
    for raw in frames:
        end, state = fresh()
        end[ends.SEQUENCE] = 258.0  # which the examples answer
        before = state.copy()
        ends.incoming(end)[: len(raw)] = np.frombuffer(raw, np.uint8)
        end[ends.IN_COUNT] = len(raw)
        read(state, end)
        changed = {
            slot.lower(): float(state[place])
            for slot, place in sorted(_slots(sv).items())
            if state[place] != before[place]
        }
        yield f"    takes {raw.hex(' ')[:23]} …: {changed}"


def _slots(sv: Any) -> dict[str, int]:
    return {str(slot): int(place) for slot, place in sv.INDEX.items()}


# --- what declares itself ------------------------------------------------------------------------
def declared(root: Path) -> Iterator[str]:
    """Yield every `DECLARATION` of the program's files, its machines, profiles and exercises.

    Files are named without their folders: those may move.
    """
    rows = []
    for path in sorted((root / "app").rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        if "\nDECLARATION" not in text:
            continue
        for node in ast.parse(text).body:
            if isinstance(node, ast.Assign | ast.AnnAssign) and node.value is not None:
                targets = node.targets if isinstance(node, ast.Assign) else [node.target]
                if [getattr(target, "id", "") for target in targets] == ["DECLARATION"]:
                    rows.append(_declaration(path.stem, node.value))
    yield from sorted(rows)
    profiles, machines = (
        {path.parent.name for path in (root / "app").rglob(file)}
        for file in ("profile.py", "machine.py")
    )
    yield f"machines {sorted(machines & profiles)}"
    for folder in ("devices", "exercises", "cameras", "fiducials", "pens", "dicom"):
        for path in sorted((root / "resources" / folder).glob("*")):
            if path.is_file():
                yield f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {folder}/{path.name}"


def _declaration(stem: str, node: ast.expr) -> str:
    """Return a declaration under the name by which it is called: a view's own, else the file's."""
    try:
        value = ast.literal_eval(node)
    except ValueError:
        return f"{stem}\n{ast.unparse(node)}"
    called = value.get("view", stem) if isinstance(value, dict) else stem
    return f"{called}\n{json.dumps(value, indent=1, ensure_ascii=False, default=repr)}"


PARTS: Final[dict[str, Callable[..., Iterator[str]]]] = {
    "commands": commands,
    "pseudonyms": pseudonyms,
    "wire": lambda page: wire(Path(page)),
    "declared": lambda root: declared(Path(root)),
}


def main() -> None:
    """Print a part."""
    for line in PARTS[sys.argv[1]](*sys.argv[2:]):
        sys.stdout.write(f"{line}\n")


if __name__ == "__main__":
    main()
