"""Models of effects that were chosen while an attempt ran: told, recorded, and read back.

From its tick on an effect is computed by another of its models. A replay changes the loop's table
before the same tick; a score made under such a choice is compared only with others made so.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

from app.core.events import Event
from app.core.messages import sentence

KIND: Final = "model"
"""Kind of the event."""


@dataclass(frozen=True, slots=True)
class ModelChoice:
    """One choice.

    Attributes:
        tick: first tick of the loop that computes so.
        effect: name of the effect.
        model: one of its models.
    """

    tick: int
    effect: str
    model: str

    def data(self) -> dict[str, object]:
        """Return what the event holds."""
        return {"tick": self.tick, "effect": self.effect, "model": self.model}

    def words(self) -> str:
        """Say it in one line."""
        return sentence(
            "effect {effect} is computed by its model {model} from here on",
            effect=self.effect,
            model=self.model,
        )


def choices_of(events: Iterable[Event]) -> tuple[ModelChoice, ...]:
    """Read the choices of an attempt, in the order of their ticks; damaged events are left out."""
    found = []
    for event in events:
        tick, effect, model = (event.data.get(key) for key in ("tick", "effect", "model"))
        if event.kind != KIND or not (isinstance(effect, str) and isinstance(model, str)):
            continue
        if isinstance(tick, int | float) and tick >= 1 and float(tick).is_integer():
            found.append(ModelChoice(int(tick), effect, model))
    return tuple(sorted(found, key=lambda choice: choice.tick))
