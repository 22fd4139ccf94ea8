"""How near the needle came to structures of risk, in words for screen and paper."""

from app.scoring.risks import RiskMark
from app.session.review import Review
from app.views.exercise.readouts import clock_text
from app.views.kit.text import tr


def risk_line(mark: RiskMark, origin: float) -> str:
    """One structure in a line: sign, distance, limit, when; the time counted from `origin` [s]."""
    when, depth = clock_text(mark.time - origin), max(0.0, -mark.closest_mm)
    if mark.closest_mm <= 0.0:
        return tr("✖ {name}: needle inside, {depth:.1f} mm deep, at {when} (limit {limit:g} mm)",
                  name=mark.name, depth=depth, when=when, limit=mark.limit_mm)  # fmt: skip
    near = mark.breach_mm > 0.0
    text = (
        tr("▲ {name}: {distance:.1f} mm, at {when}: nearer than {limit:g} mm")
        if near
        else tr("✔ {name}: {distance:.1f} mm, at {when} (limit {limit:g} mm)")
    )
    return text.format(name=mark.name, distance=mark.closest_mm, when=when, limit=mark.limit_mm)


def risk_lines(review: Review) -> tuple[str, ...]:
    """All structures, the worst first."""
    ordered = sorted(review.risks, key=lambda mark: mark.closest_mm - mark.limit_mm)
    return tuple(risk_line(mark, review.origin) for mark in ordered)
