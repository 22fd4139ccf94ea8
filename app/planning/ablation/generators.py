"""Tables of generators: which zone a power ablates in how many minutes, as somebody measured it.

A table is a file of `resources/generators`, or one that an exercise names by its path. It holds
what was measured and nothing between: a power and time that are not in it are refused.
"""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated, Final

import numpy as np
from numpy.typing import ArrayLike
from pydantic import Field, model_validator

from app.core import paths
from app.core.configuration import Strict, load
from app.core.messages import sentence
from app.planning.ablation.zone import Zone
from app.planning.errors import PlanError

FOLDER: Final = "generators"

Positive = Annotated[float, Field(gt=0.0, le=500.0)]


class Energy(StrEnum):
    """What heats the tissue."""

    RADIO_FREQUENCY = "radio_frequency"
    MICROWAVE = "microwave"


class GeneratorRow(Strict):
    """What one power and time ablates.

    Attributes:
        power_w: of the generator [W].
        minutes: for so long.
        long_mm: diameter of the zone along the needle.
        short_mm: diameter across it.
        ahead_mm: how far it reaches ahead of the tip; None for the table's own.
    """

    power_w: Positive
    minutes: Annotated[float, Field(gt=0.0, le=60.0)]
    long_mm: Positive
    short_mm: Positive
    ahead_mm: Annotated[float, Field(ge=0.0, le=50.0)] | None = None


class GeneratorTable(Strict):
    """Zones that one kind of electrode ablates.

    Attributes:
        title: electrode and generator in a few words.
        energy: radio frequency or microwave.
        ex_vivo: whether it was measured in a liver without blood; zones are smaller in a patient.
        tissue: what it was measured in.
        source: who measured it.
        ahead_mm: how far a zone reaches ahead of the tip, where a row does not say it.
        ahead_source: where that comes from.
        rows: powers and times, in order.
    """

    title: Annotated[str, Field(min_length=1, max_length=80)]
    energy: Energy
    ex_vivo: bool
    tissue: Annotated[str, Field(min_length=1, max_length=80)]
    source: Annotated[str, Field(min_length=1)]
    ahead_mm: Annotated[float, Field(ge=0.0, le=50.0)]
    ahead_source: Annotated[str, Field(min_length=1)]
    rows: Annotated[tuple[GeneratorRow, ...], Field(min_length=1, max_length=60)]

    @model_validator(mode="after")
    def _rows_can_be(self) -> GeneratorTable:
        settings = [(row.power_w, row.minutes) for row in self.rows]
        twice = [one for one in settings if settings.count(one) > 1]
        if twice:
            raise ValueError(
                sentence(
                    "{power:g} W for {minutes:g} min stands in the table twice: leave one out",
                    power=twice[0][0],
                    minutes=twice[0][1],
                )
            )
        for row in self.rows:
            ahead = self.ahead_of(row)
            if ahead >= row.long_mm:
                raise ValueError(
                    sentence(
                        "{power:g} W for {minutes:g} min: a zone {long_mm:g} mm long cannot reach "
                        "{ahead:g} mm ahead of the tip",
                        power=row.power_w,
                        minutes=row.minutes,
                        long_mm=row.long_mm,
                        ahead=ahead,
                    )
                )
        return self

    @property
    def words(self) -> str:
        """Return what it is, in which tissue it was measured, and that that had no blood if so."""
        if self.ex_vivo:
            return sentence("{title}: ex vivo, {tissue}", title=self.title, tissue=self.tissue)
        return sentence("{title}: in vivo, {tissue}", title=self.title, tissue=self.tissue)

    def ahead_of(self, row: GeneratorRow) -> float:
        """Return how far a row's zone reaches ahead of the tip [mm]."""
        return self.ahead_mm if row.ahead_mm is None else row.ahead_mm

    def number_of(self, power_w: float, minutes: float) -> int:
        """Return the number of the row of a power and time.

        Raises:
            PlanError: if none has them; names those that do.
        """
        for number, row in enumerate(self.rows):
            if row.power_w == power_w and row.minutes == minutes:
                return number
        raise PlanError(
            sentence(
                "{power:g} W for {minutes:g} min is not in the generator's table; there are {all}",
                power=power_w,
                minutes=minutes,
                all=", ".join(f"{row.power_w:g} W {row.minutes:g} min" for row in self.rows),
            )
        )

    def zone(self, number: int, tip_mm: ArrayLike, axis: ArrayLike) -> Zone:
        """Return what a row ablates about a needle.

        Args:
            number: of the row.
            tip_mm: of the needle, LPS, shape (3,).
            axis: direction in which it goes on, shape (3,).

        Raises:
            PlanError: if the needle has no direction.
        """
        row, way = self.rows[number], np.asarray(axis, np.float64)
        length = float(np.linalg.norm(way))
        if not length > 1e-9:
            raise PlanError(sentence("the needle has no direction"))
        middle = self.ahead_of(row) - 0.5 * row.long_mm
        centre = np.asarray(tip_mm, np.float64) + middle * way / length
        return Zone(centre, way, 0.5 * row.long_mm, 0.5 * row.short_mm)


def shipped_tables() -> tuple[str, ...]:
    """Return the names of the tables that come with the program."""
    return tuple(sorted(path.stem for path in (paths.resources() / FOLDER).glob("*.yaml")))


def load_table(name_or_path: str | Path) -> GeneratorTable:
    """Load a table that comes with the program by name, or one from a file.

    Raises:
        PlanError: if none has that name.
        ConfigurationError: if the file is no table; names field and value.
    """
    path = Path(name_or_path)
    if path.suffix not in {".yaml", ".yml"}:
        path = paths.resources() / FOLDER / f"{name_or_path}.yaml"
        if not path.is_file():
            raise PlanError(
                sentence(
                    "no generator's table is called {name!r}; there are {names}, or give the path "
                    "of a .yaml file",
                    name=str(name_or_path),
                    names=", ".join(shipped_tables()),
                )
            )
    return load(path, GeneratorTable)
