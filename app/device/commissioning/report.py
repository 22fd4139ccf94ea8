"""What a routine says after each step."""

from dataclasses import dataclass

from app.device.commissioning.results import AnyResult


@dataclass(frozen=True, slots=True)
class Report:
    """State of a routine, for the wizard and the command line.

    Attributes:
        progress: 0...1.
        message: what goes on, for people.
        needs: what the routine waits for, for people; empty while it works by itself. `answer`
            lets it go on.
        unit: of the number that it asks for; empty if a plain confirmation is enough.
        done: whether it has ended.
        result: what it found, once done.
        failure: why it ended without a result, and what to do; empty otherwise.
    """

    progress: float
    message: str
    needs: str = ""
    unit: str = ""
    done: bool = False
    result: AnyResult | None = None
    failure: str = ""
