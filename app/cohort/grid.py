"""The grid of a sweep: an exercise, and what of it is varied.

Every combination of the axes is a *cell*; its seeds are attempts of it. An axis that is not given
leaves the exercise as it is.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Annotated, Any, Final, Self

from pydantic import Field, ValidationError, field_validator, model_validator

from app.cohort.errors import CohortError
from app.core.configuration import Strict, load
from app.core.messages import sentence, sentence_of
from app.core.units import MILLIMETRE
from app.exercises.parts import TissueSource
from app.exercises.schema import Exercise
from app.exercises.tissue import in_layers
from app.simulation.effects import declaration
from app.simulation.errors import SimulationError
from app.simulation.hands import Script
from app.simulation.skills import SKILLS

MOST: Final = 10_000_000
"""Attempts of one sweep at most."""

_DIRECTIONS: Final = ("superior_inferior", "anterior_posterior", "left_right")

Millimetres = Annotated[float, Field(ge=0.0, le=50.0)]


@dataclass(frozen=True, slots=True)
class SweepCell:
    """One combination of the axes.

    Attributes:
        exercise: with what the axes change of it.
        skill: a name of `simulation.skills.SKILLS`.
        script: how the trainee behaves.
        registration_error: distance by which the patient lies elsewhere than robot and hand have
            him; the direction is drawn by the seed [m].
        tracking_noise: factor on the noise of the cameras.
        values: what the axes have here, as the table says it.
    """

    exercise: Exercise
    skill: str
    script: Script
    registration_error: float
    tracking_noise: float
    values: Mapping[str, Any]


class SweepGrid(Strict):
    """What is varied, as a YAML file or the command line says it.

    Attributes:
        exercise: name, name@version or file.
        skills: of `simulation.skills.SKILLS`.
        seeds: how many, which are 1 and on; or a list.
        devices: machines, by the names of their profiles.
        registration_error_mm: distance between where the patient lies and where he is believed.
        tracking_noise: factor on the noise of the cameras.
        breathing_mm: amplitude towards the feet; the others grow with it as in the literature.
        tissue: `field` or `layers`.
        assistance: the robot's help, -1 to 1.
        effects: EFFECT.PARAMETER -> values [SI].
        script: `hand`, as people are; `quick`, as in a demonstration.
    """

    exercise: str
    skills: tuple[str, ...] = tuple(SKILLS)
    seeds: Annotated[int, Field(ge=1)] | tuple[Annotated[int, Field(ge=0)], ...] = 20
    devices: tuple[str, ...] = ()
    registration_error_mm: tuple[Millimetres, ...] = (0.0,)
    tracking_noise: tuple[Annotated[float, Field(ge=0.1, le=1000.0)], ...] = (1.0,)
    breathing_mm: tuple[Millimetres, ...] = ()
    tissue: tuple[TissueSource, ...] = ()
    assistance: tuple[Annotated[float, Field(ge=-1.0, le=1.0)], ...] = ()
    effects: Mapping[str, tuple[float, ...]] = Field(default_factory=dict)
    script: Script = Script.HAND

    @field_validator("skills")
    @classmethod
    def _known_skills(cls, names: tuple[str, ...]) -> tuple[str, ...]:
        for name in names:
            if name not in SKILLS:
                raise ValueError(
                    sentence(
                        "no skill {name!r}; there are {skills}",
                        name=name,
                        skills=", ".join(SKILLS),
                    )
                )
        return names

    @field_validator("effects")
    @classmethod
    def _known_parameters(
        cls, axes: Mapping[str, tuple[float, ...]]
    ) -> Mapping[str, tuple[float, ...]]:
        for axis, values in axes.items():
            effect, _, parameter = axis.partition(".")
            if not parameter:
                raise ValueError(
                    sentence("{axis!r}: write EFFECT.PARAMETER, as puncture.force_scale", axis=axis)
                )
            try:
                for value in values:
                    declaration(effect).checked({parameter: value})
            except SimulationError as error:
                raise ValueError(sentence_of(error)) from error
        return axes

    @model_validator(mode="after")
    def _something_is_to_be_done(self) -> Self:
        for name in ("skills", "registration_error_mm", "tracking_noise"):
            if not getattr(self, name):
                raise ValueError(sentence("{field}: give one value at least", field=name))
        axes = {**dict(self), **self.effects}
        for name, values in axes.items():
            if isinstance(values, tuple) and len(set(values)) < len(values):
                raise ValueError(sentence("{field}: a value stands there twice", field=name))
        if self.seeds == ():
            raise ValueError(sentence("{field}: give one value at least", field="seeds"))
        empty = [axis for axis, values in self.effects.items() if not values]
        if empty:
            raise ValueError(sentence("{field}: give one value at least", field=empty[0]))
        if self.attempts > MOST:
            raise ValueError(
                sentence(
                    "the grid has {count} attempts; at most {most} are done at once",
                    count=self.attempts,
                    most=MOST,
                )
            )
        return self

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read a file.

        Raises:
            ConfigurationError: if it cannot be read, or something in it is wrong; says what.
        """
        return load(path, cls)

    @classmethod
    def given(cls, **values: Any) -> Self:
        """Make it of the command line's values; empty ones are not given.

        Raises:
            CohortError: if something is wrong; says what.
        """
        try:
            return cls(**{name: value for name, value in values.items() if value not in (None, ())})
        except ValidationError as error:
            first = error.errors()[0]
            where = ".".join(map(str, first["loc"])) or "grid"
            reason = first["msg"].removeprefix("Value error, ")
            raise CohortError(sentence("{field}: {reason}", field=where, reason=reason)) from error

    @property
    def every_seed(self) -> tuple[int, ...]:
        """Return the seeds."""
        return tuple(range(1, self.seeds + 1)) if isinstance(self.seeds, int) else self.seeds

    @property
    def attempts(self) -> int:
        """Return how many attempts there are."""
        count = self.seeds if isinstance(self.seeds, int) else len(self.seeds)
        count *= len(self.skills)
        count *= len(self.registration_error_mm) * len(self.tracking_noise)
        for axis in (self.devices, self.breathing_mm, self.tissue, self.assistance):
            count *= len(axis) or 1
        for values in self.effects.values():
            count *= len(values)
        return count

    def cells(self, exercise: Exercise) -> Iterator[SweepCell]:
        """Yield every combination for the exercise that was read, skills fastest.

        Raises:
            CohortError: if the exercise cannot be so; says which and why.
        """
        scenes = product(
            self.devices or (None,),
            self.tissue or (None,),
            self.breathing_mm or (None,),
            self.assistance or (None,),
        )
        axes = [[(axis, value) for value in values] for axis, values in self.effects.items()]
        for scene, chosen in product(scenes, product(*axes)):
            changed = _varied(exercise, *scene, dict(chosen))
            of_scene = {
                "device": changed.device,
                "tissue": changed.tissue.value,
                "breathing_mm": scene[2],
                "assistance": changed.assistance,
                **dict(chosen),
            }
            for error, noise, skill in product(
                self.registration_error_mm, self.tracking_noise, self.skills
            ):
                values = {
                    "skill": skill,
                    **of_scene,
                    "registration_error_mm": error,
                    "tracking_noise": noise,
                }
                yield SweepCell(changed, skill, self.script, error * MILLIMETRE, noise, values)


def _varied(
    exercise: Exercise,
    device: str | None,
    tissue: TissueSource | None,
    breathing: float | None,
    assistance: float | None,
    effects: Mapping[str, float],
) -> Exercise:
    """Return the exercise with what a cell has otherwise, checked as one that is read."""
    if tissue is TissueSource.LAYERS:
        exercise = in_layers(exercise)
    changes: dict[str, Any] = {}
    if device is not None:
        changes["device"] = device
    if tissue is not None:
        changes["tissue"] = tissue.value
    if assistance is not None:
        changes["assistance"] = assistance
    document = exercise.model_dump(mode="json", by_alias=True) | changes
    asked, without = document["effects"], document["without"]
    if breathing is not None:
        _breathe(asked, without, breathing)
    for axis, value in effects.items():
        effect, _, parameter = axis.partition(".")
        if effect not in asked:
            raise CohortError(
                sentence(
                    "exercise {exercise} does not ask for the effect {effect}: "
                    "{axis} would change nothing",
                    exercise=exercise.id,
                    effect=effect,
                    axis=axis,
                )
            )
        asked[effect]["parameters"][parameter] = value
    try:
        return Exercise.model_validate(document)
    except ValidationError as error:
        reason = error.errors()[0]["msg"].removeprefix("Value error, ")
        raise CohortError(
            sentence("exercise {exercise}: {reason}", exercise=exercise.id, reason=reason)
        ) from error


def _breathe(effects: dict[str, Any], without: dict[str, str], amplitude_mm: float) -> None:
    """Let the patient breathe so far towards the feet, or not at all at 0 mm."""
    if amplitude_mm == 0.0:
        effects.pop("breathing", None)
        without["breathing"] = "the sweep has him hold still here"
        return
    without.pop("breathing", None)
    part = effects.setdefault("breathing", {"parameters": {}, "model": "", "organ": ""})
    usual = declaration("breathing").checked({})
    share = amplitude_mm * MILLIMETRE / usual[_DIRECTIONS[0]]
    part["parameters"] |= {name: share * usual[name] for name in _DIRECTIONS}
