"""Units of metrics for people: those that are words are translatable, signs stay signs."""

from app.core.messages import sentence


def unit_words(unit: str) -> str:
    """Return a metric's unit as a sentence of its own where it is one of our words.

    Args:
        unit: as its declaration has it; empty for a number without one.
    """
    ours = (sentence("points"), sentence("scans"), sentence("times"))
    return {str(one): one for one in ours}.get(unit, unit)
