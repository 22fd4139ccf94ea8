"""Plug-ins: force laws, effects, metrics, studies and views, one file each, all read the same way.

A plug-in says what it is in a literal `DECLARATION = {...}` at its top. It is read as text: a file
that is not chosen is never imported. A `Kind` says for one sort of plug-in what must be declared,
where its files lie (the program's folder, folders appended to its package's `__path__`, folders of
plug-ins, the user's own folders) and which error is raised. Every message has file, line, field,
value and what would be valid. See docs/extending.md.

Names of the program's own cannot be taken. A file of somebody else's is imported only after a
process of its own has shown that it can be (`core.plugin_trial`), and whatever it raises is an
error of that file alone: it runs with all rights of the program.
"""

from __future__ import annotations

import ast
import importlib
import importlib.util
import math
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from difflib import get_close_matches
from functools import lru_cache
from glob import escape
from operator import attrgetter
from pathlib import Path
from sys import float_info
from types import MappingProxyType, ModuleType
from typing import Any, Final, Generic, NamedTuple, TypeVar

from app.core import paths, plugin_folders
from app.core.errors import AcusError
from app.core.files import read_at_most
from app.core.messages import sentence
from app.core.plugin_trial import import_fault
from app.core.state_vector import INDEX, SCENE, SUMS, VECTORS, slots_named
from app.core.trial import Trial

ENERGIES: Final = ("potential", "dissipative", "active")
"""A stage stores energy and gives it back; only takes it; or can give out more than it took."""

_NAME: Final = "DECLARATION"
_IMPORTING = threading.RLock()


@dataclass(frozen=True, slots=True)
class Parameter:
    """One SI parameter of a plug-in.

    Attributes:
        default: a number, a field of the device profile such as `fixture.stiffness`, or None: it
            must be given.
        unit: for display.
        minimum, maximum: the closed range it must lie in.
        meaning: one line.
    """

    default: float | str | None
    unit: str
    minimum: float
    maximum: float
    meaning: str


class Published(NamedTuple):
    """Range of a parameter in the literature: lower and upper end, in its unit, and who says so.

    `measured` are the numbers that the source gives, in the same unit; all lie in the range.
    """

    least: float
    most: float
    source: str
    measured: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Declaration:
    """What every plug-in says about itself; kinds add fields of their own.

    Attributes:
        name: of its file, without `.py`.
        path: of its file.
        title: one line for display.
    """

    name: str
    path: Path
    title: str


@dataclass(frozen=True, slots=True, kw_only=True)
class StageDeclaration(Declaration):
    """What a plug-in says that runs in a tick: a force law or an effect.

    Attributes:
        reads, writes: slots of the state vector, lower case; vectors by their components.
        energy: one of `ENERGIES`, and the statement behind it.
        parameters: name -> Parameter.
        published: name of a parameter -> its range in the literature, where there is one.
    """

    reads: tuple[str, ...]
    writes: tuple[str, ...]
    energy: tuple[str, str]
    parameters: Mapping[str, Parameter]
    published: Mapping[str, Published] = field(default_factory=lambda: MappingProxyType({}))

    def unpublished(self, values: Mapping[str, float]) -> tuple[str, ...]:
        """Return a sentence for each of `values` outside its range in the literature."""
        return tuple(
            sentence(
                "{name} is {setting:g} {parameters_unit}; published are "
                "{known_least:g} to {known_most:g} ({known_source})",
                name=name,
                setting=values[name],
                parameters_unit=self.parameters[name].unit,
                known_least=known.least,
                known_most=known.most,
                known_source=known.source,
            )
            for name, known in self.published.items()
            if name in values and not known.least <= values[name] <= known.most
        )


class Field(NamedTuple):
    """One key of a declaration.

    Attributes:
        valid: what may stand there, in words.
        read: value -> what the declaration holds; raises ValueError or TypeError, whose message
            may say which part of the value is wrong.
    """

    valid: str
    read: Callable[[Any], Any]


D = TypeVar("D", bound=Declaration)


@dataclass(frozen=True, slots=True, eq=False)
class PluginKind(Generic[D]):
    """One sort of plug-in.

    Attributes:
        noun: what it is, with its article, as the documentation says it: `an effect`.
        declares: made of a file's declaration.
        fields: key -> what must stand there; all of these keys.
        optional: key -> what must stand there if the key does.
        error: makes the error of the room that asks.
        package: whose folders hold such files; empty if they lie in folders of plug-ins alone.
        folder: name of the subfolder in folders of plug-ins and, for a kind with a package, of the
            user's own folder; empty if such files are found otherwise.
        functions: that a file must define at its top level.
        spared: key of a declaration that spares a file, where it is true, these functions.
        marks: a file of the program's folder counts only if one of these is in it; empty: all do.
        trial: of files that are not the program's own and run in the loop or the tracker.
    """

    noun: str
    declares: type[D]
    fields: Mapping[str, Field]
    error: Callable[[str], AcusError]
    package: str = ""
    folder: str = ""
    functions: tuple[str, ...] = ()
    spared: str = ""
    marks: tuple[bytes, ...] = ()
    trial: Trial | None = None
    optional: Mapping[str, Field] = field(default_factory=lambda: MappingProxyType({}))

    @property
    def word(self) -> str:
        """The noun without its article."""
        return self.noun.split(" ", 1)[1]

    def files(self, name: str = "*") -> list[Path]:
        """Files of all plug-ins: the program's own, appended folders', folders of plug-ins', then
        the user's.

        Args:
            name: of one plug-in; all of them without it.
        """
        shared = plugin_folders.files(self.folder, name)
        if not self.package:
            return shared
        package = importlib.import_module(self.package)
        found = [*_within(map(Path, package.__path__), name), *shared]
        found += _within(paths.plugin_places(self.folder), name)
        return [
            path
            for path in dict.fromkeys(found)
            if not path.stem.startswith("_") and (not self.is_own(path) or self._counts(path))
        ]

    def names(self) -> tuple[str, ...]:
        """Names of all plug-ins, sorted."""
        return tuple(sorted({path.stem for path in self.files()}))

    def find(self, name: str) -> D:
        """Read what a plug-in says about itself, without importing it.

        Raises:
            AcusError: made by `error`: for an unknown name, listing the known ones; for a name
                that two files have; for a file that is broken.
        """
        return self.read(self.file(name))

    def file(self, name: str) -> Path:
        """Return the file of a plug-in.

        Raises:
            AcusError: made by `error`: for an unknown name, or one that two files have.
        """
        found = self.files(escape(name)) if Path(name).name == name else []
        if not found:
            raise self.error(
                sentence(
                    "there is no {kind} {name!r}; there are {known}",
                    kind=self.word,
                    name=name,
                    known=self._known(),
                )
            )
        found = [path for path in found if self.is_own(path)] or found
        if reason := self.taken(found[0]):
            raise self.error(reason)
        if len(found) > 1:
            raise self.error(
                sentence(
                    "two files are the {noun} {name!r}: {first} and {second}; rename one",
                    noun=self.word.split()[-1],
                    name=name,
                    first=found[0],
                    second=found[1],
                )
            )
        return found[0]

    def read(self, path: Path) -> D:
        """Read the declaration of a file, without importing it; once while it does not change.

        Raises:
            AcusError: made by `error`, with file, line, field, value and what would be valid.
        """
        try:
            found: D = _read(self, path, read_at_most(path).decode("utf-8"))
        except (OSError, SyntaxError, ValueError) as reason:
            if isinstance(reason, AcusError):
                raise
            raise self.error(
                sentence(
                    "{kind} file {path} cannot be read: {reason}",
                    kind=self.word,
                    path=path,
                    reason=reason,
                )
            ) from reason
        return found

    def refused(self, check: Callable[[D], object] | None = None) -> dict[Path, str]:
        """Files of others that cannot be used, and why; they are left where they are.

        Their text is read, and nothing is run: what a trial showed before is known, what it would
        show is not.

        Args:
            check: looks further into a declared file; raises if it must not be used.
        """
        found = {}
        for path in self.files():
            if self.is_own(path):
                continue
            if reason := self.taken(path):
                found[path] = reason
                continue
            try:
                declared = self.find(path.stem)
                if check is not None:
                    check(declared)
            except AcusError as error:
                found[path] = str(error)
                continue
            known = self.trial.known(path) if self.trial is not None else {}
            if known.get("reason"):
                found[path] = str(known["reason"])
        return found

    def taken(self, path: Path) -> str:
        """Say that the name of somebody else's file is one of the program's own; else nothing.

        Imported, it would stand in the place of a plug-in, of another module or of a name of the
        package.
        """
        if self.is_own(path) or not self.package:
            return ""
        package, name = importlib.import_module(self.package), path.stem
        folder = Path(package.__file__ or "").parent
        standing = vars(package).get(name)
        loaded = getattr(standing, "__name__", "") == f"{self.package}.{name}"
        its_own = (folder / f"{name}.py").exists() or (folder / name).is_dir()
        its_own |= any(map(self.is_own, plugin_folders.files(self.folder, escape(name))))
        if not its_own and (standing is None or loaded):
            return ""
        return sentence(
            "{path}: {name!r} is a name of the program's own; rename the file", path=path, name=name
        )

    def fault(self, path: Path) -> str:
        """Say why somebody else's file cannot be imported or fails its trial, as processes of their
        own found; or "".
        """
        if self.is_own(path):
            return ""
        # By the name that it will have: compiled code is kept with it.
        package = self._module_name(path).rpartition(".")[0]
        if found := import_fault(path, package):
            return sentence(
                "{kind} file {path} cannot be imported: {fault}",
                kind=self.word,
                path=path,
                fault=found,
            )
        return "" if self.trial is None else self.trial.fault(path)

    @contextmanager
    def blamed(self, path: Path, doing: str) -> Iterator[None]:
        """Turn whatever a file raises, `SystemExit` too, into the kind's error, which names it.

        Args:
            path: of the file.
            doing: what fails, as in "parameters() does not work".
        """
        try:
            yield
        except (AcusError, KeyboardInterrupt):
            raise
        except BaseException as reason:
            text = f"{type(reason).__name__}: {reason}".rstrip(": ")
            raise self.error(
                sentence("{path}: {doing}: {fault}", path=path, doing=doing, fault=text)
            ) from reason

    def is_own(self, path: Path) -> bool:
        """Return whether a file is one of the program's own."""
        shared = plugin_folders.folder_of(path)
        if shared is not None or not self.package:
            return shared is not None and shared.is_own
        package = importlib.import_module(self.package)
        return package.__file__ is not None and path.parent == Path(package.__file__).parent

    def load(
        self,
        declared: D,
        before: Callable[[D], object] | None = None,
        after: Callable[[ModuleType], object] | None = None,
    ) -> ModuleType:
        """Import a plug-in's file, once; of a file that fails nothing stays.

        Args:
            declared: its declaration.
            before: checks the file before it is imported; raises if it must not be.
            after: checks the module; raises if it cannot be used.

        Raises:
            AcusError: made by `error`, naming the file and what went wrong in it.
        """
        shared = plugin_folders.folder_of(declared.path)
        name = self._module_name(declared.path)
        with _IMPORTING:
            known = sys.modules.get(name)
            if known is not None and known.__file__ == str(declared.path):
                return known
            if before is not None:
                before(declared)
            if fault := self.fault(declared.path):
                raise self.error(fault)
            try:
                module = _imported(name, declared.path, shared is not None)
                if after is not None:
                    after(module)
            except BaseException as reason:  # whatever somebody's file does: no half of it stays
                sys.modules.pop(name, None)
                if isinstance(reason, AcusError | KeyboardInterrupt):
                    raise
                text = str(reason) if isinstance(reason, Exception) else type(reason).__name__
                raise self.error(
                    sentence(
                        "{kind} file {declared_path} cannot be imported: {fault}",
                        kind=self.word,
                        declared_path=declared.path,
                        fault=text,
                    )
                ) from reason
            if shared is None:
                setattr(sys.modules[self.package], declared.name, module)
        return module

    def _module_name(self, path: Path) -> str:
        shared = plugin_folders.folder_of(path)
        return f"{self.package}.{path.stem}" if shared is None else shared.module_name(path)

    def _counts(self, path: Path) -> bool:
        if not self.marks:
            return True
        content = read_at_most(path)
        return any(mark in content for mark in self.marks)

    def _known(self) -> str:
        return ", ".join(self.names()) or "none"


def _imported(name: str, path: Path, has_package: bool) -> ModuleType:
    """Import a file by its name in the package that it lies in, or as a module of another."""
    if has_package:
        return importlib.import_module(name)
    specification = importlib.util.spec_from_file_location(name, path)
    if specification is None or specification.loader is None:
        raise ImportError(sentence("it is no Python file"))
    module = sys.modules[name] = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


def _within(folders: Iterable[Path], name: str) -> list[Path]:
    return [path for folder in folders for path in sorted(folder.glob(f"{name}.py"))]


class PluginText(NamedTuple):
    """A file that was read.

    Attributes:
        document: the literal; None if there is none.
        lines: key, or the name of a parameter, -> line on which its value stands.
    """

    document: dict[str, Any] | None
    lines: Mapping[str, int]


def read_statements(path: Path) -> list[ast.stmt]:
    """Read the statements of a file without running it.

    Raises:
        OSError, SyntaxError, ValueError: if it cannot be read as Python.
    """
    return ast.parse(read_at_most(path).decode("utf-8"), str(path)).body


@lru_cache(maxsize=512)
def _read(kind: PluginKind[Any], path: Path, text: str) -> Any:
    body = ast.parse(text, str(path)).body
    source = _literal(kind, body, path)
    if source.document is None:
        raise kind.error(
            sentence(
                "{path} has no {name} = {{...}}; see 'How to add {kind_noun}'",
                path=path,
                name=_NAME,
                kind_noun=kind.noun,
            )
        )
    given = set(source.document) - set(kind.optional)
    if given != set(kind.fields):
        may = f", and may have {', '.join(kind.optional)}" if kind.optional else ""
        raise kind.error(
            sentence(
                "{path}, line {line}: {name} must have exactly the keys"
                " {kind_fields}{may}; check {differing}",
                path=path,
                line=source.lines.get("", 1),
                name=_NAME,
                kind_fields=", ".join(kind.fields),
                may=may,
                differing=sorted(given ^ set(kind.fields)),
            )
        )
    defined = {node.name for node in body if isinstance(node, ast.FunctionDef)}
    needed = () if source.document.get(kind.spared) is True else kind.functions
    if missing := [name for name in needed if name not in defined]:
        raise kind.error(
            sentence(
                "{path} has no function {function}(); see 'How to add {kind_noun}'",
                path=path,
                function=missing[0],
                kind_noun=kind.noun,
            )
        )
    keys = (*kind.fields, *(key for key in kind.optional if key in source.document))
    values = {key: _value(kind, key, source, path) for key in keys}
    unknown = sorted(set(values.get("published", {})) - set(values.get("parameters", {})))
    if unknown:
        raise kind.error(
            sentence(
                "{path}, line {line}: published names "
                "{unknown_name!r}, which is no parameter; it has {parameters}",
                path=path,
                line=source.lines.get(f"published {unknown[0]!r}", 1),
                unknown_name=unknown[0],
                parameters=", ".join(values["parameters"]),
            )
        )
    return kind.declares(name=path.stem, path=path, **values)


def _literal(kind: PluginKind[Any], body: list[ast.stmt], path: Path) -> PluginText:
    for node in body:
        if not isinstance(node, ast.AnnAssign | ast.Assign) or node.value is None:
            continue
        target = node.targets[0] if isinstance(node, ast.Assign) else node.target
        if isinstance(target, ast.Name) and target.id == _NAME:
            try:
                document = ast.literal_eval(node.value)
            except (ValueError, TypeError) as reason:
                raise kind.error(
                    sentence(
                        "{path}, line {node_lineno}: {name} is not a literal: {reason}",
                        path=path,
                        node_lineno=node.lineno,
                        name=_NAME,
                        reason=reason,
                    )
                ) from reason
            if isinstance(document, dict) and isinstance(node.value, ast.Dict):
                return PluginText(document, {"": node.lineno, **_lines(node.value)})
    return PluginText(None, {})


def _lines(node: ast.Dict) -> dict[str, int]:
    found: dict[str, int] = {}
    for key, value in zip(node.keys, node.values, strict=True):
        if isinstance(key, ast.Constant) and isinstance(key.value, str):
            found.setdefault(key.value, value.lineno)
            part = {"parameters": "parameter", "published": "published"}.get(key.value)
            if part is not None and isinstance(value, ast.Dict):
                rows = _lines(value)
                found |= {f"{part} {name!r}": line for name, line in rows.items()}
    return found


def _value(kind: PluginKind[Any], key: str, source: PluginText, path: Path) -> Any:
    document = source.document or {}
    wanted = kind.fields[key] if key in kind.fields else kind.optional[key]
    value = document[key]
    line = source.lines.get(key, 1)
    try:
        return wanted.read(value)
    except _WrongPartError as wrong:
        line = source.lines.get(wrong.part or key, line)
        what = wrong if wrong.part else f"{key}: {wrong}"
        raise kind.error(
            sentence(
                "{path}, line {line}: {fault}; give {wanted_valid}",
                path=path,
                line=line,
                fault=what,
                wanted_valid=wanted.valid,
            )
        ) from wrong
    except (TypeError, ValueError, AttributeError, KeyError) as wrong:
        raise kind.error(
            sentence(
                "{path}, line {line}: {key} is {setting!r}; give {wanted_valid}",
                path=path,
                line=line,
                key=key,
                setting=value,
                wanted_valid=wanted.valid,
            )
        ) from wrong


class _WrongPartError(ValueError):
    """One part of a value is wrong: which (a key of `Source.lines`, or empty), and what with it."""

    def __init__(self, part: str, words: str) -> None:
        super().__init__(words)
        self.part = part


def _text(value: Any) -> str:
    if not isinstance(value, str) or not value:
        raise ValueError
    return value


def _flag(value: Any) -> bool:
    if not isinstance(value, bool):
        raise TypeError
    return value


def _texts(value: Any) -> tuple[str, ...]:
    if not isinstance(value, tuple | list) or not all(isinstance(part, str) for part in value):
        raise TypeError
    return tuple(value)


def _choices(value: Any) -> Mapping[str, str]:
    if not isinstance(value, dict) or not value or not all(map(_text, (*value, *value.values()))):
        raise ValueError
    return MappingProxyType(dict(value))


def _slots(value: Any) -> tuple[str, ...]:
    found: list[str] = []
    for name in _texts(value):
        slots = slots_named(name)
        if not slots:
            near = get_close_matches(name, (*INDEX, *VECTORS), 3, 0.5)
            hint = f" (near: {', '.join(near)})" if near else ""
            raise _WrongPartError(
                "",
                sentence("{name!r} is not a slot of core.state_vector{hint}", name=name, hint=hint),
            )
        found += slots
    return tuple(dict.fromkeys(found))


def _written(value: Any) -> tuple[str, ...]:
    found = _slots(value)
    if strange := [name for name in found if INDEX[name] not in SUMS + SCENE]:
        raise _WrongPartError(
            "", sentence("{strange} is the loop's own", strange=", ".join(strange))
        )
    return found


def _energy(value: Any) -> tuple[str, str]:
    kind, statement = value
    if kind not in ENERGIES or not isinstance(value, tuple | list):
        raise ValueError
    return kind, str(statement)


def _parameters(value: Any) -> Mapping[str, Parameter]:
    return MappingProxyType({_text(name): _parameter(name, row) for name, row in value.items()})


def _parameter(name: str, row: Any) -> Parameter:
    try:
        default, unit, minimum, maximum, meaning = row
        found = Parameter(default, unit, float(minimum), float(maximum), meaning)
        usable = math.isfinite(found.minimum) and math.isfinite(found.maximum)
    except (TypeError, ValueError):
        usable = False
    if not (usable and isinstance(default, int | float | str | None)):
        raise _WrongPartError(
            sentence("parameter {name!r}", name=name),
            sentence("parameter {name!r} is {row!r}", name=name, row=row),
        )
    return found


def _published(value: Any) -> Mapping[str, Published]:
    return MappingProxyType({_text(name): _range(name, row) for name, row in value.items()})


def _range(name: str, row: Any) -> Published:
    try:
        least, most, source, *measured = row
        found = Published(float(least), float(most), _text(source), *map(_numbers, measured))
        usable = math.isfinite(found.least) and found.least <= found.most < math.inf
    except (TypeError, ValueError):
        usable = False
    if not usable:
        raise _WrongPartError(
            sentence("published {name!r}", name=name),
            sentence("published {name!r} is {row!r}", name=name, row=row),
        )
    for value in found.measured:
        if not found.least <= value <= found.most:
            raise _WrongPartError(
                sentence("published {name!r}", name=name),
                sentence(
                    "published {name!r} is {least:g} to {most:g}, and {measured:g} was measured,"
                    " which lies outside",
                    name=name,
                    least=found.least,
                    most=found.most,
                    measured=value,
                ),
            )
    return found


def _numbers(values: Any) -> tuple[float, ...]:
    return tuple(float(value) for value in values)


TEXT: Final = Field("a text that is not empty", _text)
FLAG: Final = Field("True or False", _flag)
TEXTS: Final = Field("a tuple of texts", _texts)
CHOICES: Final = Field("{name: what it is, ...}, one at least", _choices)
SLOTS: Final = Field(
    "a tuple of slots or vectors in lower case, such as ('depth', 'force', 'target_shift')", _slots
)
WRITES: Final = Field(
    "a tuple of slots or vectors that a law or effect may write:"
    f" {', '.join(name for name, slot in INDEX.items() if slot in SUMS + SCENE)}",
    _written,
)
ENERGY: Final = Field(
    f"(kind, statement), the kind one of {', '.join(ENERGIES)}, the statement a text", _energy
)
PARAMETERS: Final = Field(
    "{name: (default, unit, least, most, meaning), ...}, the default a number, None if it must be"
    " given, or for a force law a field of the device profile",
    _parameters,
)
PUBLISHED: Final = Field(
    "{name of a parameter: (least, most, source), ...}, the range in the literature and who says"
    " so; behind the source may stand a tuple of what was measured, which the range must hold",
    _published,
)


def complete(
    kind: PluginKind[Any],
    declared: StageDeclaration,
    given: Mapping[str, float],
    profile: object | None = None,
) -> dict[str, float]:
    """Complete the parameters that were given with the defaults, and check every value.

    Args:
        kind: of the plug-in.
        declared: its declaration.
        given: values that replace its defaults.
        profile: whose fields a default may name; None if there is none.

    Raises:
        AcusError: made by the kind's `error`: for an unknown name, or a value that is no number,
            out of range, or missing.
    """
    what = f"{kind.word.split()[-1]} {declared.name!r}"
    if unknown := sorted(set(given) - set(declared.parameters)):
        raise kind.error(
            sentence(
                "{owner} has no parameter {unknown_name!r}; it has {declared_parameters}",
                owner=what,
                unknown_name=unknown[0],
                declared_parameters=", ".join(sorted(declared.parameters)) or "none",
            )
        )
    found = {}
    for name, limit in declared.parameters.items():
        value: object = given.get(name, limit.default)
        if name not in given and isinstance(value, str):
            try:
                value = float(attrgetter(value)(profile))
            except AttributeError as error:
                raise kind.error(
                    sentence(
                        "{declared_path}: {name} takes {limit_default!r} from the device "
                        "profile, which has no such field",
                        declared_path=declared.path,
                        name=name,
                        limit_default=limit.default,
                    )
                ) from error
        if value is None:
            raise kind.error(
                sentence(
                    "{owner} needs {name} [{limit_unit}]: {limit_meaning}",
                    owner=what,
                    name=name,
                    limit_unit=limit.unit,
                    limit_meaning=limit.meaning,
                )
            )
        number = number_within(value, limit.minimum, limit.maximum)
        if number is None:
            raise kind.error(
                sentence(
                    "{owner}: {name} is {setting!r}; "
                    "give {limit_minimum:g} to {limit_maximum:g} {limit_unit}",
                    owner=what,
                    name=name,
                    setting=value,
                    limit_minimum=limit.minimum,
                    limit_maximum=limit.maximum,
                    limit_unit=limit.unit,
                )
            )
        found[name] = number
    return found


def number_within(value: object, minimum: float, maximum: float) -> float | None:
    """Return a value as a number if it is a finite one within a closed range; else None."""
    if not isinstance(value, int | float) or isinstance(value, bool):
        return None
    usable = minimum <= value <= maximum and abs(value) <= float_info.max
    return float(value) if usable else None
