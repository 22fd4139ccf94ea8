"""The path report of a lung biopsy in words."""

from __future__ import annotations

from app.core.messages import joined, sentence
from app.imaging.field.tissue_words import tissue_words
from app.planning.lung_path.values import LOOK_MM, PROTECTED_FROM_MM, LungPathReport, TubeNear

MOST_TUBES = 4
"""So many vessels and bronchi are named, the first on the path."""


def lung_sentences(report: LungPathReport) -> tuple[str, ...]:
    """Say what a path to a target in the lung goes through, a line each."""
    return tuple(
        sentence("{label}: {figure}", label=label, figure=figure)
        for label, figure in lung_rows(report)
    )


def lung_rows(report: LungPathReport) -> tuple[tuple[str, str], ...]:
    """Return label and value of each line of the report; the labels are the same for all paths."""
    return (
        (sentence("Pleura crossed"), _crossed(report, of_fissures=False)),
        (sentence("Fissures crossed"), _crossed(report, of_fissures=True)),
        (sentence("Aerated lung"), _length(report.lung_mm)),
        (sentence("Of it emphysema"), _length(report.emphysema_mm)),
        (sentence("Rib below, upper border"), _away(report.rib_below_mm)),
        (sentence("Rib above, lower border"), _away(report.rib_above_mm)),
        (sentence("Intercostal vessels"), _away(report.intercostal_mm)),
        (sentence("Mid-line of the spine"), _length(report.spine_mm, 0)),
        (sentence("Rib protects the artery"), _protected(report)),
        (sentence("Vessels from 3 mm"), _tubes(report.vessels)),
        (sentence("Bronchi from 3 mm"), _tubes(report.bronchi)),
    )


def not_known() -> str:
    """Say that nobody labelled it."""
    return sentence("not known")


def _crossed(report: LungPathReport, of_fissures: bool) -> str:
    crossed = report.fissures if of_fissures else report.pleura
    if crossed is None:
        return not_known()
    if not crossed:
        return sentence("none")
    places = [
        sentence("{angle:.0f}° at {depth:.0f} mm", angle=one.angle_deg, depth=one.depth_mm)
        if one.angle_deg is not None
        else sentence("at {depth:.0f} mm", depth=one.depth_mm)
        for one in crossed
    ]
    return sentence("{count} ({places})", count=len(crossed), places=joined(", ", places))


def _length(mm: float | None, digits: int = 1) -> str:
    if mm is None:
        return not_known()
    if digits == 0:
        return sentence("{mm:.0f} mm", mm=mm)
    return sentence("{mm:.1f} mm", mm=mm)


def _away(mm: float | None) -> str:
    if mm is None:
        return not_known()
    if mm >= LOOK_MM:
        return sentence("{mm:.0f} mm or more", mm=LOOK_MM)
    if mm <= 0.0:
        return sentence("met")
    return sentence("{mm:.1f} mm", mm=mm)


def _protected(report: LungPathReport) -> str:
    if report.is_protected is None:
        return not_known()
    if report.is_protected:
        return sentence("yes")
    return sentence("no: within {mm:.0f} cm of the spine", mm=PROTECTED_FROM_MM / 10.0)


def _tubes(tubes: tuple[TubeNear, ...] | None) -> str:
    if tubes is None:
        return not_known()
    if not tubes:
        return sentence("none")
    words = []
    for one in tubes[:MOST_TUBES]:
        name = tissue_words(one.name)
        if one.away_mm <= 0.0:
            words.append(
                sentence(
                    "{name} of {wide:.1f} mm met at {depth:.0f} mm",
                    name=name,
                    wide=one.diameter_mm,
                    depth=one.depth_mm,
                )
            )
        else:
            words.append(
                sentence(
                    "{name} of {wide:.1f} mm, {away:.1f} mm off at {depth:.0f} mm",
                    name=name,
                    wide=one.diameter_mm,
                    away=one.away_mm,
                    depth=one.depth_mm,
                )
            )
    if len(tubes) > MOST_TUBES:
        words.append(sentence("and {count} more", count=len(tubes) - MOST_TUBES))
    return joined(", ", words)
