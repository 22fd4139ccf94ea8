"""What an effect says about itself, read from its source without importing it.

An effect that is not in the plan must not be imported, yet the compiler must know what it reads
and writes. So each effect file carries a literal `DECLARATION` and a frozen dataclass whose field
defaults are literals; both are read with `ast`.
"""

import ast
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.core.declarations import number_within, read_source
from app.core.state_vector import INDEX
from app.simulation.errors import SimulationError

_KEYS = (
    "title",
    "reads",
    "writes",
    "consumers",
    "needs",
    "models",
    "energy",
    "cost_class",
    "parameters",
)


@dataclass(frozen=True, slots=True)
class Parameter:
    """One SI parameter of an effect: default, unit, the closed range it must lie in, what it is."""

    default: float
    unit: str
    minimum: float
    maximum: float
    meaning: str


@dataclass(frozen=True, slots=True)
class Declaration:
    """What an effect reads, writes and needs, and who could consume it.

    Attributes:
        name: file name without `.py`.
        title: one line for display.
        reads, writes: slots of the state vector, lower case.
        consumers: kinds of consumer that could use it, for display; the compiler looks at slots.
        needs: parts of the scene that must not be empty (`layers`).
        models: way to compute it -> what that way is; the first is the default.
        energy: `potential`, `dissipative` or `active`, and the statement behind it.
        cost_class: A (< 50 ns), B (1-5 µs), C (frame or event rate), D (offline).
        parameters: name -> Parameter.
    """

    name: str
    title: str
    reads: tuple[str, ...]
    writes: tuple[str, ...]
    consumers: tuple[str, ...]
    needs: tuple[str, ...]
    models: Mapping[str, str]
    energy: tuple[str, str]
    cost_class: str
    parameters: Mapping[str, Parameter]

    def checked(self, given: Mapping[str, float]) -> dict[str, float]:
        """Complete `given` with the defaults and check every value.

        Raises:
            SimulationError: for an unknown name, or a value that is no number or out of range.
        """
        if unknown := [name for name in given if name not in self.parameters]:
            raise SimulationError(
                f"effect {self.name!r} has no parameter {unknown[0]!r}; "
                f"it has {', '.join(sorted(self.parameters)) or 'none'}"
            )
        return {
            name: self._checked(name, given.get(name, p.default))
            for name, p in self.parameters.items()
        }

    def _checked(self, name: str, value: object) -> float:
        limit = self.parameters[name]
        number = number_within(value, limit.minimum, limit.maximum)
        if number is None:
            raise SimulationError(
                f"effect {self.name!r}: {name} is {value!r}; "
                f"give {limit.minimum:g} to {limit.maximum:g} {limit.unit}"
            )
        return number

    def model(self, asked: str) -> str:
        """Return the way to compute it: the one asked for, or the default.

        Raises:
            SimulationError: naming the ways that exist.
        """
        if asked and asked not in self.models:
            raise SimulationError(
                f"effect {self.name!r} has no model {asked!r}; it has {', '.join(self.models)}"
            )
        return asked or next(iter(self.models))


def class_name(effect: str) -> str:
    """Name of the dataclass in an effect's file: `shaft_friction` -> `ShaftFriction`."""
    return "".join(part.capitalize() for part in effect.split("_"))


def read_declaration(path: Path) -> Declaration:
    """Read an effect's declaration from its source.

    Raises:
        SimulationError: naming the file and what is missing, unknown or not a literal.
    """
    document, body = read_source(path, "an effect", _KEYS, SimulationError)
    _check_slots(document, path)
    return Declaration(
        name=path.stem,
        title=document["title"],
        reads=tuple(document["reads"]),
        writes=tuple(document["writes"]),
        consumers=tuple(document["consumers"]),
        needs=tuple(document["needs"]),
        models=document["models"],
        energy=tuple(document["energy"]),
        cost_class=document["cost_class"],
        parameters=_parameters(document["parameters"], _defaults(body, path), path),
    )


def _defaults(body: list[ast.stmt], path: Path) -> dict[str, float]:
    """Field -> default of the effect's dataclass."""
    wanted = class_name(path.stem)
    for node in body:
        if isinstance(node, ast.ClassDef) and node.name == wanted:
            fields = [item for item in node.body if isinstance(item, ast.AnnAssign)]
            try:
                return {
                    item.target.id: float(ast.literal_eval(item.value))
                    for item in fields
                    if isinstance(item.target, ast.Name) and item.value is not None
                }
            except (ValueError, TypeError) as error:
                raise SimulationError(
                    f"{path}: a field of {wanted} has no literal number as default"
                ) from error
    raise SimulationError(f"{path} has no dataclass {wanted}; see 'How to add an effect'")


def _parameters(
    limits: dict[str, tuple[str, float, float, str]], defaults: dict[str, float], path: Path
) -> dict[str, Parameter]:
    if set(limits) != set(defaults):
        raise SimulationError(
            f"{path}: the fields of the dataclass and DECLARATION['parameters'] differ in "
            f"{sorted(set(limits) ^ set(defaults))}"
        )
    return {name: Parameter(defaults[name], *limits[name]) for name in defaults}


def _check_slots(document: dict[str, Any], path: Path) -> None:
    for slot in (*document["reads"], *document["writes"]):
        if slot not in INDEX:
            raise SimulationError(f"{path}: {slot!r} is not a slot of core.state_vector")
