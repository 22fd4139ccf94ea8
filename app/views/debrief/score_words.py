"""A score in words: bands, points, verdict; the same on the page and in the report."""

from dataclasses import dataclass

from app.scoring.result import Score
from app.scoring.rows import Row
from app.scoring.tolerance import Band
from app.session.review import Review
from app.views.kit import theme
from app.views.kit.text import tr

COUNTED = ("scans",)
"""Units of values that are counted: whole numbers."""

BAND_LOOKS = {
    Band.EXPERT: (theme.GOOD, "★"),
    Band.GOOD: (theme.GOOD, "✔"),
    Band.PASS: (theme.WARNING, "▲"),
    Band.FAIL: (theme.BAD, "✖"),
}
"""Colour and symbol of a band, so that neither stands alone."""


@dataclass(frozen=True, slots=True)
class RowTexts:
    """One line of the score table as text; `colour` belongs to the band."""

    label: str
    value: str
    band: str
    points: str
    weight: str
    colour: str
    help: str


def band_word(band: Band) -> str:
    """Name of a band for people."""
    return {
        Band.EXPERT: tr("expert"),
        Band.GOOD: tr("good"),
        Band.PASS: tr("pass"),
        Band.FAIL: tr("fail"),
    }[band]


def counting(score: Score) -> tuple[Row, ...]:
    """Rows that count in the total or could fail it."""
    return tuple(row for row in score.rows if row.tolerance is not None)


def shown_only(score: Score) -> tuple[Row, ...]:
    """Rows without a tolerance, for information."""
    return tuple(row for row in score.rows if row.tolerance is None)


def row_texts(row: Row, score: Score) -> RowTexts:
    """Texts of one row; a void attempt is not judged, so that no row of it has band or points."""
    judged = row.band is not None and score.total is not None
    colour, symbol = BAND_LOOKS[row.band] if row.band and judged else (theme.TEXT_DIM, "–")
    band = f"{symbol} {band_word(row.band)}" if row.band and judged else "–"
    return RowTexts(
        label=row.label + (" *" if row.tolerance and row.tolerance.required else ""),
        value="–" if row.value is None else with_unit(row.value, row.unit),
        band=band,
        points=_points(row, score),
        weight=f"{row.tolerance.weight:g}" if row.tolerance else "–",
        colour=colour,
        help=row.note or (_limits(row) if score.total is not None else tr("Void: not judged.")),
    )


def number(value: float) -> str:
    """Three significant digits, never in exponents; what rounds to zero has no sign."""
    size = abs(value)
    return f"{value:.0f}" if size >= 100 else f"{value:.1f}" if size >= 10 else f"{value:z.2f}"


def with_unit(value: float, unit: str) -> str:
    """Say a value with its unit; the degree sign stands close."""
    if unit in COUNTED:
        return f"{value:.0f} {unit}"
    gap = "" if unit in ("°", "") else " "
    return f"{number(value)}{gap}{unit}"


def total_text(score: Score | None) -> str:
    """Say the total, or that there is none."""
    if score is None or score.total is None:
        return tr("not scored")
    return tr("{total:.0f} of 100 points", total=score.total)


def verdict(review: Review) -> tuple[str, str, str]:
    """Colour, symbol with word, and the reason in one line."""
    score = review.score
    if score is None:
        return theme.TEXT_DIM, "–", review.reason or tr("This attempt was not scored.")
    if score.void_reason:
        why = score.void_reason[:1].upper() + score.void_reason[1:]
        return theme.WARNING, tr("▲ Void"), f"{why}. {remedy(score)}"
    if score.passed:
        return theme.GOOD, tr("✔ Passed"), ""
    failures = ", ".join(row.label for row in score.failures)
    reason = (
        tr("Required and not met: {names}", names=failures)
        if failures
        else tr("{mark:g} points are needed", mark=score.rules.pass_mark)
    )
    return theme.BAD, tr("✖ Not passed"), reason


def remedy(score: Score) -> str:
    """Say what can be done about a void attempt: it depends on what made it void."""
    if score.attempt_void and "cameras" not in score.attempt_void:
        return tr(
            "It counts for nothing and spoils no average; mend what is named, if anything, and "
            "try again."
        )
    return tr(
        "It counts for nothing. Let both cameras see the marker (the panel Tracker says what each "
        "one lacks: light, something before it, the colour), then try again."
    )


def _points(row: Row, score: Score) -> str:
    weight = sum(other.weight for other in score.rows)
    if score.total is None or row.utility is None or weight <= 0.0 or row.weight <= 0.0:
        return "–"
    most = 100.0 * row.weight / weight
    return f"{most * row.utility:.1f} / {most:.1f}"


def _limits(row: Row) -> str:
    if row.tolerance is None:
        return tr("Shown for information; it does not count.")
    expert, good, passing, _ = row.tolerance.knots
    text = tr(
        "expert {expert:g}, good {good:g}, pass {passing:g} {unit}",
        expert=expert, good=good, passing=passing, unit=row.unit,
    )  # fmt: skip
    return text + ("; " + tr("* required to pass") if row.tolerance.required else "")
