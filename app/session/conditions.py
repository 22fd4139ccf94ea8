"""Gathers from an attempt's head and samples what its score was made under.

What held the needle is one of them; it stands in every record.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Final

import numpy as np

from app.core.events import Event
from app.core.messages import sentence
from app.exercises.hand_bands import OF_HANDS
from app.scoring.conditions import Assistance, Conditions, DeviceKind
from app.session.effect_models import choices_of
from app.session.errors import SessionError
from app.session.machine import COUNTING
from app.session.samples import Samples
from app.session.ticker import SLOWED
from app.session.transitions import waited_for_computer

TRAINEE: Final = "trainee"
"""Name of the metadata record; its key `hand` holds one of `HANDS`."""

ARM: Final = "arm"
"""The simulated arm that carries out a plan, as a source of the hand."""

HANDS: Final = ("mouse", "keyboard", "tablet", "gamepad", "robot", "pen", "script", ARM)
"""Sources of the hand: `robot` is a real hand at a real robot, `pen` one that holds a pen with
printed markers, `script` the scripted trainee."""

POINTERS: Final = tuple(OF_HANDS)
"""Those that move a simulated hand, which is a person's: unsteady, and where the attempt waits for
its first movement."""

TAKEN_OVER: Final = "taken_over"
"""Kind of the event at which another hand goes on with the needle: `hand` one of `HANDS`, `depth_m`
where the tip was, None where nobody had measured it."""


def hand_of(trainee: Mapping[str, str], asked: str = "") -> str:
    """Return the hand of an attempt.

    A run that was built for one hand (a scripted trainee, a real robot, a pen) keeps it whatever is
    asked for; without a word it is the mouse.

    Args:
        trainee: metadata record of the run: `scripted` not empty, or `hand`, says the one hand.
        asked: what the window says.

    Raises:
        SessionError: for another name; gives the valid ones.
    """
    if trainee.get("scripted"):
        return "script"
    hand = trainee.get("hand") or asked or "mouse"
    if hand not in HANDS:
        raise SessionError(
            sentence(
                "hand {hand!r} is not known; valid names: {hands}",
                hand=hand,
                hands=", ".join(HANDS),
            )
        )
    return hand


CONDITIONS: Final = "conditions"
"""Metadata record of what the exercise sets: `level`, `views`, `assistance`, `content`,
`drill`; and by whose bands the attempt is judged."""

BANDS: Final = "bands"
BANDS_SOURCE: Final = "bands_source"
"""Keys of that record: the hand whose own bands judge, and where these come from; not there where
the exercise's tolerances do."""

AGREEMENT: Final = "agreement"
"""Metadata record of the registration check in force: `radius_mm`, `check` (its id)."""

EXERCISE_FILE: Final = "exercise.json"
"""Attachment that holds the exercise."""

Metadata = Mapping[str, Mapping[str, str]]


def conditions_of(
    metadata: Metadata,
    samples: Samples,
    scoring_version: int,
    events: Sequence[Event] = (),
) -> Conditions:
    """Gather the conditions of one attempt; what a damaged record does not say is empty.

    Args:
        metadata: metadata records by name.
        samples: the attempt over time.
        scoring_version: of its score; 0 without one.
        events: of the attempt, which tell what was chosen while it ran.
    """
    exercise = metadata.get("exercise", {})
    said = metadata.get(CONDITIONS, {})
    trainee, device = metadata.get(TRAINEE, {}), metadata.get("device", {})
    agreement = _number(metadata.get(AGREEMENT, {}).get("radius_mm"))
    return Conditions(
        exercise=exercise.get("id", ""),
        version=_whole(exercise.get("version")) or 0,
        level=_whole(said.get("level")) or 0,
        content=said.get("content", ""),
        assistance=assistance_of(samples, _number(said.get("assistance"))),
        views=None
        if "views" not in said
        else tuple(sorted(filter(None, said["views"].split(",")))),
        hand=trainee.get("hand", ""),
        scripted=trainee.get("scripted", ""),
        kind=kind_of(device),
        device=device.get("name", ""),
        ct=metadata.get("ct", {}).get("pseudonym", ""),
        seed=_whole(metadata.get("session", {}).get("seed")),
        software=metadata.get("software", {}).get("version", ""),
        calibration=metadata.get("cameras", {}).get("calibration", ""),
        agreement_mm=agreement,
        scoring_version=scoring_version,
        models=tuple(sorted({f"{c.effect}: {c.model}" for c in choices_of(events)})),
        taken_over=_taken_over(events),
        computer=computer_of(events),
        drill=said.get("drill", ""),
        bands=said.get(BANDS, ""),
        bands_source=said.get(BANDS_SOURCE, ""),
    )


def computer_of(events: Sequence[Event]) -> str:
    """Say how this computer was too slow for an attempt; empty where it was not."""
    if (waited := waited_for_computer(events)) > 0.0:
        return sentence(
            "too slow: the attempt waited {waited:.0f} s for its simulated cameras", waited=waited
        )
    lost = sum(_seconds(event) for event in events if event.kind == SLOWED)
    if not lost > 0.0:
        return ""
    return sentence("too slow by {lost:.0f} s: the simulated world was slowed with it", lost=lost)


def _seconds(event: Event) -> float:
    seconds = event.data.get("seconds")
    sound = isinstance(seconds, int | float) and math.isfinite(seconds)
    return max(0.0, float(seconds)) if sound and isinstance(seconds, int | float) else 0.0


def assistance_of(samples: Samples, start: float | None = None) -> Assistance | None:
    """Return the dial over the attempt, from what was recorded; None where nothing was.

    `start` is what the exercise sets. Each sample counts until the next one.
    """
    dial = samples.assistance
    if dial is None or len(dial) == 0:
        return None
    known = np.isfinite(dial) & np.isin(samples.state, [state.value for state in COUNTING])
    if not known.any():
        return None
    spans = np.maximum(np.diff(samples.time, append=samples.time[-1]), 0.0)[known]
    values = dial[known]
    whole = float(spans.sum())
    mean = float(values @ spans) / whole if whole > 0.0 else float(values.mean())
    return Assistance(start, float(values.min()), float(values.max()), mean)


def kind_of(device: Mapping[str, str]) -> DeviceKind:
    """Tell what stood behind the needle, by the metadata record `device`."""
    if "yes" in (device.get("simulated"), device.get("pen")):
        return DeviceKind.SIMULATED
    if "pen" in device:
        return DeviceKind.PEN
    try:
        return DeviceKind(device.get("kind", ""))
    except ValueError:
        return DeviceKind.UNKNOWN


def _taken_over(events: Iterable[Event]) -> str:
    """Return the last hand that took the needle over; one that is not known is left out."""
    hands = [event.data.get("hand") for event in events if event.kind == TAKEN_OVER]
    return next((hand for hand in reversed(hands) if hand in HANDS and isinstance(hand, str)), "")


def _whole(text: str | None) -> int | None:
    try:
        return int(text) if text is not None else None
    except ValueError:
        return None


def _number(text: str | None) -> float | None:
    try:
        number = float(text) if text is not None else math.nan
    except ValueError:
        return None
    return number if math.isfinite(number) else None
