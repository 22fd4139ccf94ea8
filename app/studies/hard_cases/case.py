"""A hard case: an input at which a formula is delicate, what is right there, how far off we may be.

Every case has a reference, good to 60 digits (`references.json`, made by `tools.hard_references`)
or given by its formula; a bound that the program's own function keeps; and what happens one step
beyond the bound, which is tried. A bound that nothing breaks would guard nothing: the tests try
each with a deliberate defect, a wrong way to compute the same, which must make the case fail.
"""

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from decimal import Decimal, localcontext
from functools import cache
from importlib.util import find_spec
from math import isfinite
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

from app.core import plugin_folders
from app.core.errors import AcusError
from app.core.extras import install_command
from app.core.messages import sentence
from app.core.plugins import CHOICES, TEXT, Declaration, PluginKind
from app.studies.errors import StudyError

REFERENCES: Final = "references.json"
"""Inputs and values to 60 digits, by name: beside the cases, here and in folders of plug-ins."""

_OWN: Final = (
    "kinematics",
    "statics",
    "dynamics",
    "force laws",
    "governor",
    "guard",
    "cables and encoders",
    "effects",
    "integrators",
    "velocity",
    "triangulation",
    "calibration",
    "rotations",
    "DICOM geometry",
    "oblique planes",
    "distances",
    "planning",
    "metrics",
)
"""Subsystems in the order of the table; further ones are declared by the file of their cases."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclaredCases(Declaration):
    """What a file of hard cases says about itself, here if it adds subsystems.

    Attributes:
        subsystems: that it adds -> the one behind which each stands in the table.
    """

    subsystems: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))


KIND: Final[PluginKind[DeclaredCases]] = PluginKind(
    noun="a file of hard cases",
    declares=DeclaredCases,
    fields={"title": TEXT},
    optional={"subsystems": CHOICES},
    error=StudyError,
    folder="hard_cases",
)


def _all_subsystems() -> tuple[str, ...]:
    order = list(_OWN)
    own = [path for path in sorted(_HERE.glob("*.py")) if b"\nDECLARATION" in path.read_bytes()]
    unusable = KIND.refused()
    plugin_folders.refused.update(unusable)
    shared = (path for path in KIND.files() if path not in unusable)
    for declared in map(KIND.read, (*shared, *own)):
        for subsystem, after in declared.subsystems.items():
            if after in order:
                order.insert(order.index(after) + 1, subsystem)
                continue
            reason = (
                f"{declared.path}: {subsystem!r} stands behind {after!r};"
                f" there are {', '.join(order)}"
            )
            if declared.path in own or KIND.is_own(declared.path):
                raise StudyError(reason)
            plugin_folders.refused[declared.path] = reason
    return tuple(order)


_HERE: Final = Path(__file__).parent
SUBSYSTEMS: Final = _all_subsystems()
"""All subsystems, those that are added too, in the order of the table; every one has cases."""


def reference_folders() -> tuple[Path, ...]:
    """Return where files of references lie: here, and in folders of plug-ins."""
    shared = (folder.path / "hard_cases" for folder in plugin_folders.folders())
    return (_HERE, *shared)


EXTRAS: Final[Mapping[str, str]] = {"mujoco": "physics"}
"""Package that a case may need -> the extra that brings it."""

_DIGITS = 80  # in which errors are computed


@dataclass(frozen=True, slots=True)
class ReferenceValue:
    """What is right.

    Attributes:
        how: the formula, or how the digits were found.
        value: its numbers, flat.
        given: the input for which it holds, as exact doubles; empty where the case has its own.
    """

    how: str
    value: tuple[Decimal, ...]
    given: tuple[float, ...] = ()


def digits(name: str) -> ReferenceValue:
    """Return a reference from the file, by its name.

    Raises:
        StudyError: if the file has none of that name.
    """
    entry = _kept().get(name)
    if entry is None:
        raise StudyError(
            sentence(
                "{references} has no reference {name!r}; add it to tools/hard_references.py",
                references=REFERENCES,
                name=name,
            )
        )
    values = tuple(Decimal(text) for text in entry["value"])
    return ReferenceValue(f"60 digits: {entry['how']}", values, tuple(entry["given"]))


def analytic(how: str, value: ArrayLike) -> ReferenceValue:
    """Return a reference that a formula gives; `value` of any shape."""
    return ReferenceValue(how, _decimals(value))


@dataclass(frozen=True, slots=True)
class Beyond:
    """What happens one step beyond the bound: in words, and a trial that it does."""

    text: str
    happens: Callable[..., bool]


def named(error: type[Exception], call: Callable[[], object]) -> Beyond:
    """Beyond the bound the program refuses by a named error."""

    def raises() -> bool:
        try:
            call()
        except error:
            return True
        return False

    return Beyond(f"named error {error.__name__}", raises)


def answers(text: str, happens: Callable[..., bool]) -> Beyond:
    """Beyond the bound the program answers, bounded as `text` says, or by a named status."""
    return Beyond(text, happens)


@dataclass(frozen=True, slots=True, kw_only=True)
class HardCase:
    """One case.

    Attributes:
        subsystem: one of `SUBSYSTEMS`.
        case: what is hard about it, a sentence; unique in the subsystem.
        given: the input, for people.
        way: the function of the program that is held against the reference.
        found: a way -> its numbers, as many as the reference has, of any shape.
        reference: what is right.
        unit: of error and bound.
        bound: largest error allowed.
        beyond: what happens one step further.
        relative: errors count in shares of the reference's largest number.
        needs: packages that are not in every installation; without them the case is skipped.

    Raises:
        StudyError: without a reference, a bound or words, or for an unknown subsystem.
    """

    subsystem: str
    case: str
    given: str
    way: Callable[..., Any]
    found: Callable[..., Any]
    reference: ReferenceValue
    unit: str
    bound: float
    beyond: Beyond
    relative: bool = False
    needs: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if self.subsystem not in SUBSYSTEMS:
            raise StudyError(
                sentence(
                    "hard case {case!r}: subsystem is {subsystem!r}; there are {subsystems}",
                    case=self.case,
                    subsystem=self.subsystem,
                    subsystems=", ".join(SUBSYSTEMS),
                )
            )
        if not isinstance(self.reference, ReferenceValue) or not self.reference.value:
            raise StudyError(
                sentence(
                    "hard case {case!r} has no reference; use digits() or analytic()",
                    case=self.case,
                )
            )
        if not (isfinite(self.bound) and self.bound >= 0.0):
            raise StudyError(
                sentence(
                    "hard case {case!r}: bound is {bound}; give 0 or more",
                    case=self.case,
                    bound=self.bound,
                )
            )
        for name in ("case", "given", "unit"):
            if not getattr(self, name):
                raise StudyError(
                    sentence(
                        "hard case {case!r}: {name} is empty; say it in words",
                        case=self.case,
                        name=name,
                    )
                )

    @property
    def name(self) -> str:
        """Subsystem and case."""
        return f"{self.subsystem}: {self.case}"

    def error(self, way: Callable[..., Any] | None = None) -> float:
        """Error of a way, or of the program's own [unit]; infinite if it has no finite answer.

        Raises:
            StudyError: if it gives another number of values than the reference has.
        """
        try:
            answer = self.found(way or self.way)
        except (AcusError, ArithmeticError, np.linalg.LinAlgError):
            return float("inf")
        values = np.atleast_1d(np.asarray(answer, dtype=np.float64)).ravel()
        right = self.reference.value
        if len(values) != len(right):
            raise StudyError(
                sentence(
                    "hard case {case!r}: {computed} values found, the reference has {expected}",
                    case=self.case,
                    computed=len(values),
                    expected=len(right),
                )
            )
        if not np.isfinite(values).all():
            return float("inf")
        with localcontext() as context:
            context.prec = _DIGITS
            off = max(abs(Decimal(v) - r) for v, r in zip(values.tolist(), right, strict=True))
            if self.relative:
                off /= max(abs(r) for r in right)
            return float(off)

    def missing(self) -> str:
        """Return why the case cannot be tried here; empty if it can."""
        lacking = [package for package in self.needs if find_spec(package) is None]
        return ", ".join(f"needs {p}: {install_command(EXTRAS[p])}" for p in lacking)


@dataclass(frozen=True, slots=True)
class HardOutcome:
    """What became of a case: error [unit], and why it does not hold; or why it was skipped."""

    case: HardCase
    error: float = 0.0
    trouble: str = ""
    skipped: str = ""


def tried(case: HardCase) -> HardOutcome:
    """Try a case: its error against its bound, and what happens beyond."""
    if missing := case.missing():
        return HardOutcome(case, skipped=missing)
    error = case.error()
    if not error <= case.bound:
        return HardOutcome(case, error, f"error {error:.3g} is beyond the bound {case.bound:.3g}")
    if not case.beyond.happens():
        return HardOutcome(case, error, f"beyond the bound there is no {case.beyond.text}")
    return HardOutcome(case, error)


def _decimals(value: ArrayLike) -> tuple[Decimal, ...]:
    numbers = np.atleast_1d(np.asarray(value, dtype=np.float64)).ravel().tolist()
    return tuple(Decimal(number) for number in numbers)


@cache
def _kept() -> Mapping[str, Any]:
    document: dict[str, Any] = {}
    for folder in reference_folders():
        file = folder / REFERENCES
        if file.is_file():
            document |= json.loads(file.read_text(encoding="utf-8"))
    return document
