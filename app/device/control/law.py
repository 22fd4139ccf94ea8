"""What a force law says about itself, read from its source without importing it."""

from __future__ import annotations

import ast
import math
from collections.abc import Mapping
from dataclasses import dataclass
from operator import attrgetter
from pathlib import Path
from typing import Any, Final

from app.core.declarations import number_within, read_source
from app.core.state_vector import INDEX
from app.device.errors import LawError
from app.mechanisms.profile import DeviceProfile

ENERGIES: Final = ("potential", "dissipative", "active")
"""A law stores energy and gives it back; only takes it; or can give out more than it took."""

_KEYS = ("title", "reads", "writes", "energy", "parameters")
_FUNCTIONS = ("parameters", "energy_bound", "step")


@dataclass(frozen=True, slots=True)
class LawParameter:
    """One SI parameter of a law.

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

    def value(self, profile: DeviceProfile) -> float | None:
        """Return the default for a device; None where there is none.

        Raises:
            AttributeError: if the profile has no such field.
        """
        if isinstance(self.default, str):
            return float(attrgetter(self.default)(profile))
        return self.default


@dataclass(frozen=True, slots=True)
class Law:
    """A force law as its file declares it.

    Attributes:
        name: file name without `.py`.
        path: of the file.
        title: one line for display.
        reads, writes: slots of the state vector, lower case.
        energy: one of `ENERGIES`, and the statement behind it.
        parameters: name -> LawParameter.
    """

    name: str
    path: Path
    title: str
    reads: tuple[str, ...]
    writes: tuple[str, ...]
    energy: tuple[str, str]
    parameters: Mapping[str, LawParameter]

    def checked(self, given: Mapping[str, float], profile: DeviceProfile) -> dict[str, float]:
        """Complete `given` with the defaults for a device and check every value.

        Raises:
            LawError: for an unknown name, or a value that is no number or out of range.
        """
        if unknown := sorted(set(given) - set(self.parameters)):
            raise LawError(
                f"law {self.name!r} has no parameter {unknown[0]!r}; "
                f"it has {', '.join(sorted(self.parameters)) or 'none'}"
            )
        return {
            name: self._checked(
                name, given[name] if name in given else self._default(name, profile)
            )
            for name in self.parameters
        }

    def _default(self, name: str, profile: DeviceProfile) -> float | None:
        parameter = self.parameters[name]
        try:
            return parameter.value(profile)
        except AttributeError as error:
            raise LawError(
                f"{self.path}: {name} takes {parameter.default!r} from the device profile, "
                "which has no such field"
            ) from error

    def _checked(self, name: str, value: object) -> float:
        limit = self.parameters[name]
        if value is None:
            raise LawError(f"law {self.name!r} needs {name} [{limit.unit}]: {limit.meaning}")
        number = number_within(value, limit.minimum, limit.maximum)
        if number is None:
            raise LawError(
                f"law {self.name!r}: {name} is {value!r}; "
                f"give {limit.minimum:g} to {limit.maximum:g} {limit.unit}"
            )
        return number


def read_law(path: Path) -> Law:
    """Read a law's declaration from its source.

    Raises:
        LawError: naming the file and what is missing, unknown or not a literal.
    """
    document, body = read_source(path, "a force law", _KEYS, LawError)
    _check(document, body, path)
    return Law(
        name=path.stem,
        path=path,
        title=document["title"],
        reads=_slots(document["reads"], path),
        writes=_slots(document["writes"], path),
        energy=tuple(document["energy"]),
        parameters={name: _parameter(name, row, path) for name, row in _rows(document).items()},
    )


def _check(document: dict[str, Any], body: list[ast.stmt], path: Path) -> None:
    energy = document["energy"]
    if not (isinstance(energy, tuple) and len(energy) == 2 and energy[0] in ENERGIES):
        raise LawError(
            f"{path}: energy is {energy!r}; give (kind, statement), "
            f"the kind one of {', '.join(ENERGIES)}"
        )
    defined = {node.name for node in body if isinstance(node, ast.FunctionDef)}
    if missing := [name for name in _FUNCTIONS if name not in defined]:
        raise LawError(f"{path} has no function {missing[0]}(); see 'How to add a force law'")


def _slots(names: Any, path: Path) -> tuple[str, ...]:
    """Slots of the state; a vector's three by their common name (`force`, `hub_v`)."""
    found = []
    for name in names:
        vector = [name + axis for axis in ("_x", "_y", "_z")]
        if name.endswith("_v"):
            vector = [name + axis for axis in ("x", "y", "z")]
        slots = [name] if name in INDEX else [slot for slot in vector if slot in INDEX]
        if not slots:
            raise LawError(f"{path}: {name!r} is not a slot of core.state_vector")
        found += slots
    return tuple(found)


def _rows(document: dict[str, Any]) -> dict[str, Any]:
    return dict(document["parameters"])


def _parameter(name: str, row: Any, path: Path) -> LawParameter:
    try:
        default, unit, minimum, maximum, meaning = row
        parameter = LawParameter(default, unit, float(minimum), float(maximum), meaning)
        usable = math.isfinite(parameter.minimum) and math.isfinite(parameter.maximum)
    except (TypeError, ValueError):
        usable = False
    if not (usable and isinstance(default, int | float | str | None)):
        raise LawError(
            f"{path}: parameter {name!r} is {row!r}; give (default, unit, least, most, meaning), "
            "the default a number or a field of the device profile"
        )
    return parameter
