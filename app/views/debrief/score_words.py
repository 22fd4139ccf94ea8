"""A score in words, for page and report: bands, points, verdict, risks, and what it was made
under.
"""

from dataclasses import dataclass, replace

from app.core.messages import joined
from app.core.units import MILLIMETRE
from app.imaging.field.tissue_words import tissue_words
from app.scoring.conditions import Assistance, Conditions, DeviceKind
from app.scoring.pass_line import pass_words
from app.scoring.procedure import ProcedureMarks
from app.scoring.result import Score
from app.scoring.risks import RiskMark
from app.scoring.rows import Row, shown_sd
from app.scoring.tolerance import Band
from app.scoring.unit_words import unit_words
from app.session.next_exercise import Proposal, ProposalReason
from app.session.review import Review
from app.views.exercise.readouts import clock_text
from app.views.kit import theme
from app.views.kit.access import ACCESS
from app.views.kit.roles import Role
from app.views.kit.text import begun, declared, listing, tr, tr_n, translated
from app.views.kit.text import number as local


def risk_line(mark: RiskMark, shown: float) -> str:
    """One structure in a line: sign, distance, limit, when; `shown` on the student's clock [s]."""
    when, depth = clock_text(shown), max(0.0, -mark.closest_mm)
    if mark.closest_mm <= 0.0:
        return tr(
            "✖ {name}: needle inside, {depth:.1f} mm deep, at {when} (limit {limit:g} mm)",
            name=tissue_words(mark.name),
            depth=depth,
            when=when,
            limit=mark.limit_mm,
        )
    name = tissue_words(mark.name)
    values = {"name": name, "distance": mark.closest_mm, "when": when, "limit": mark.limit_mm}
    if mark.breach_mm > 0.0:
        return tr("▲ {name}: {distance:.1f} mm, at {when}: nearer than {limit:g} mm", **values)
    return tr("✔ {name}: {distance:.1f} mm, at {when} (limit {limit:g} mm)", **values)


def risk_lines(review: Review) -> tuple[str, ...]:
    """All structures, the worst first."""
    ordered = sorted(review.risks, key=lambda mark: mark.closest_mm - mark.limit_mm)
    return tuple(risk_line(mark, review.clock_at(mark.time)) for mark in ordered)


def met_lines(review: Review) -> tuple[str, ...]:
    """List what the needle met: first what fails, then what may matter; skin, fat, muscle not."""
    if review.met is None:
        return ()
    forbidden = review.score.rules.forbidden if review.score is not None else ()
    lines = []
    for met in review.met:
        fails = met.is_forbidden(forbidden)
        if not fails and met.kind in _PLAIN and not met.name:
            continue
        when = clock_text(review.clock_at(met.time))
        line = tr("{met}, at {when}", met=met.sentence, when=when)
        lines.append((not fails, f"{'✖' if fails else '·'} {line}"))
    return tuple(line for _, line in sorted(lines, key=lambda one: one[0]))


_PLAIN = ("skin", "fat", "muscle")


def kind_word(kind: DeviceKind) -> str:
    """Name of what stood behind the needle, for people."""
    return {
        DeviceKind.REAL: tr("real robot"),
        DeviceKind.EMULATED: tr("emulated robot"),
        DeviceKind.SIMULATED: tr("simulated robot"),
        DeviceKind.PEN: tr("pen and webcam"),
        DeviceKind.UNKNOWN: tr("robot not known"),
    }[kind]


def hand_word(conditions: Conditions) -> str:
    """Say what held the needle; empty where it is not known."""
    if conditions.scripted:
        return tr("script ({skill})", skill=conditions.scripted)
    return {
        "mouse": tr("mouse"),
        "keyboard": tr("keyboard"),
        "tablet": tr("tablet"),
        "gamepad": tr("gamepad"),
        "robot": tr("hand at the robot"),
        "pen": tr("pen"),
        "script": tr("script"),
        "arm": tr("the arm (simulation)"),
    }.get(conditions.hand, "")


def hands_word(conditions: Conditions) -> str:
    """Say what held the needle, one after the other where another hand took it over."""
    if not conditions.taken_over:
        return hand_word(conditions)
    later = hand_word(replace(conditions, hand=conditions.taken_over))
    return tr("{first}, then {later}", first=hand_word(conditions), later=later)


def whose_words(conditions: Conditions | None) -> str:
    """Say whose attempt it is where it is no student's; empty for a student's."""
    if conditions is None or conditions.hand != "arm":
        return ""
    if conditions.taken_over:
        return tr(
            "◇ Begun by the arm (simulation), then taken over by {hand}: not a student's "
            "attempt, it is not scored for anyone",
            hand=hand_word(replace(conditions, hand=conditions.taken_over)),
        )
    return tr(
        "◇ Carried out by the arm (simulation), not by a student: it is not scored for anyone"
    )


def dial_text(dial: Assistance | None) -> str:
    """Say the dial in short: one number, or its range where it was turned; empty if not known."""
    if dial is None:
        return ""
    if not dial.moved:
        return local(dial.mean, "z.2f")
    return f"{local(dial.least, 'z.2f')} … {local(dial.most, 'z.2f')}"


def short_words(conditions: Conditions | None) -> str:
    """Say hand, robot and assistance in one line; empty where nothing is known."""
    if conditions is None:
        return ""
    dial = dial_text(conditions.assistance)
    parts = (
        tr("◇ no student's") if conditions.hand == "arm" else "",
        hands_word(conditions),
        kind_word(conditions.kind),
        tr("assistance {dial}", dial=dial) if dial else "",
        bands_words(conditions) if conditions.bands else "",
        tr("▲ model changed meanwhile: {models}", models=models_text(conditions))
        if conditions.models
        else "",
    )
    return "  ·  ".join(filter(None, parts))


def models_text(conditions: Conditions) -> str:
    """Name the effects, each with the model that was chosen while the attempt ran."""
    return ", ".join(conditions.models).replace("_", " ")


def facts_of(conditions: Conditions) -> tuple[tuple[str, str], ...]:
    """Name and value of everything that the score was made under."""
    c = conditions
    return (
        (tr("Exercise"), _exercise(c)),
        (tr("Assistance"), assistance_words(c.assistance)),
        (tr("Views"), _views(c)),
        (tr("Hand and robot"), f"{hands_word(c) or tr('not recorded')}, {_robot(c)}"),
        *(((tr("Bands"), bands_words(c)),) if c.bands else ()),
        (tr("Screen and needle"), agreement_words(c)),
        *(((tr("Computer"), c.computer),) if c.computer else ()),
        *(((tr("Models changed meanwhile"), models_text(c)),) if c.models else ()),
        (tr("Software"), _software(c)),
    )


def bands_words(conditions: Conditions) -> str:
    """Say by whose bands it was judged, and whose attempts these were fitted to."""
    source = {
        "scripts": tr("set from scripted runs, not from people"),
        "people": tr("set from people's attempts"),
        "author": tr("set by the exercise's author"),
    }.get(conditions.bands_source, "")
    hand = {
        "mouse": tr("scoring bands for the mouse"),
        "tablet": tr("scoring bands for the tablet"),
        "gamepad": tr("scoring bands for the gamepad"),
        "keyboard": tr("scoring bands for the keyboard"),
    }.get(conditions.bands) or tr("scoring bands for {hand}", hand=conditions.bands)
    return ", ".join(filter(None, (hand, source)))


def assistance_words(dial: Assistance | None) -> str:
    """Say what the exercise set, and what it was."""
    if dial is None:
        return tr("not recorded")
    start = tr("not recorded") if dial.start is None else local(dial.start, "z.2f")
    if not dial.moved and dial.start is not None and abs(dial.mean - dial.start) < 5e-3:
        return tr("{start} as set, throughout", start=start)
    return tr(
        "set {start}; least {least:z.2f}, most {most:z.2f}, over time {mean:z.2f}",
        start=start,
        least=dial.least,
        most=dial.most,
        mean=dial.mean,
    )


def agreement_words(conditions: Conditions) -> str:
    """Say how well screen and needle agreed, and by which calibration of the cameras."""
    if conditions.kind is DeviceKind.SIMULATED:
        return tr("simulated cameras")
    calibration = (
        tr("calibration {id}", id=conditions.calibration)
        if conditions.calibration
        else tr("no calibration")
    )
    if conditions.agreement_mm is None:
        return tr("not checked; {calibration}", calibration=calibration)
    return tr(
        "agree within {mm:.1f} mm (95 %); {calibration}",
        mm=conditions.agreement_mm,
        calibration=calibration,
    )


def _exercise(c: Conditions) -> str:
    version = tr("version {n}", n=c.version) if c.version else tr("version not recorded")
    level = tr("level {n}", n=c.level) if c.level else ""
    return ", ".join(filter(None, (c.exercise, version, level)))


def _views(c: Conditions) -> str:
    if c.views is None:
        return tr("not recorded")
    return listing(view.replace("_", " ") for view in c.views) or tr("none")


def _robot(c: Conditions) -> str:
    return f"{kind_word(c.kind)} ({c.device})" if c.device else kind_word(c.kind)


def _software(c: Conditions) -> str:
    parts = (
        f"Acus {c.software}" if c.software else "",
        tr("scoring version {n}", n=c.scoring_version) if c.scoring_version else "",
        tr("seed {n}", n=c.seed) if c.seed is not None else "",
    )
    return ", ".join(filter(None, parts))


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


def metric_title(row: Row) -> str:
    """Return the name of a metric; in a student's words for a student, who has the others in the
    page of help.
    """
    plain = {
        "log_dimensionless_jerk": tr("Smoothness"),
        "frechet_distance": tr("Largest distance from the path"),
        "dtw_distance": tr("Mean distance from the path"),
    }
    student = ACCESS.role is Role.STUDENT
    return plain.get(row.name, declared(row.label)) if student else declared(row.label)


def row_texts(row: Row, score: Score) -> RowTexts:
    """Texts of one row; a void attempt is not judged, so that no row of it has band or points."""
    judged = row.band is not None and score.total is not None
    colour, symbol = BAND_LOOKS[row.band] if row.band and judged else (theme.TEXT_DIM, "–")
    band = f"{symbol} {band_word(row.band)}" if row.band and judged else "–"
    return RowTexts(
        label=metric_title(row) + (" *" if row.tolerance and row.tolerance.required else ""),
        value="–"
        if row.value is None
        else with_unit(row.value, row.unit, shown_sd(row.name, row.value, row.sd)),
        band=band,
        points=_points(row, score),
        weight=local(row.tolerance.weight, "g") if row.tolerance else "–",
        colour=colour,
        help=row.note or (_limits(row) if score.total is not None else tr("Void: not judged.")),
    )


def ending_words(review: Review) -> str:
    """Say where the needle ended, seen from the target; empty where nobody measured it."""
    if review.steps is not None and (
        review.steps.samples or "diagnostic_samples" in review.tolerances
    ):
        return _best_sample(review.steps)
    motion = review.motion
    away = motion.ending() if motion is not None else None
    if away is None:
        return ""
    aside = review.placed.T_world_patient.rotation.T @ away.across / MILLIMETRE
    names = (
        (tr("to the left"), tr("to the right")),
        (tr("towards the back"), tr("towards the front")),
        (tr("towards the head"), tr("towards the feet")),
    )
    sides = [
        (abs(value), side[0] if value > 0.0 else side[1])
        for value, side in sorted(zip(aside, names, strict=True), key=lambda one: -abs(one[0]))
        if abs(value) >= LEAST_ASIDE_MM
    ]
    parts = [tr("{mm:.1f} mm {side}", mm=size, side=side) for size, side in sides]
    where = f" ({', '.join(parts)})" if len(parts) > 1 else f" {sides[0][1]}" if sides else ""
    deep = -away.remaining / MILLIMETRE
    along = (
        tr("at its depth")
        if abs(deep) < LEAST_ASIDE_MM
        else tr("{mm:.1f} mm too deep", mm=deep)
        if deep > 0.0
        else tr("{mm:.1f} mm short of it", mm=-deep)
    )
    return tr(
        "The needle ended {mm:.1f} mm beside the target{where}, and {along}.",
        mm=away.lateral / MILLIMETRE,
        where=where,
        along=along,
    )


LEAST_ASIDE_MM = 0.3
"""Less than this towards a side is not told [mm]: a camera knows no better."""


def points_words(points: float) -> str:
    """Say so many points."""
    return tr_n("{n} point", "{n} points", round(points))


def proposal_words(proposal: Proposal) -> str:
    """Say in one or two sentences what comes next, and why."""
    cost = (
        tr(
            " {metric} cost most: {points}.",
            metric=declared(proposal.metric),
            points=points_words(proposal.points),
        )
        if proposal.metric
        else ""
    )
    next_one = tr("Next: {title}.", title=declared(proposal.title))
    words = {
        ProposalReason.COURSE: next_one
        + tr(" It follows in the course {course}.", course=declared(proposal.course)),
        ProposalReason.LEVEL: next_one
        + tr(" This one is passed; it is of level {level}.", level=proposal.level),
        ProposalReason.WEAKNESS: next_one
        + tr(
            " This one is passed; {metric} cost most here ({points}), and counts there.",
            metric=declared(proposal.metric),
            points=points_words(proposal.points),
        ),
        ProposalReason.AGAIN: tr("The same again: it is not passed yet.") + cost,
        ProposalReason.CONFIRM: tr("The same once more: two passes in a row lead on.") + cost,
        ProposalReason.EASIER: next_one
        + tr(
            " {n} attempts in a row did not pass; this one is of level {level}.",
            n=proposal.tries,
            level=proposal.level,
        )
        + cost,
        ProposalReason.YOURSELF: tr("Now you: {title}.", title=declared(proposal.title)),
        ProposalReason.WHOLE: tr(
            "Then the whole exercise: {title}.", title=declared(proposal.title)
        ),
        ProposalReason.VOID: tr("The same again: this attempt has no points."),
        ProposalReason.DONE: tr("All exercises that are open to you are passed.") + cost,
        ProposalReason.CLOSED: "",
    }
    return words[proposal.reason]


def number(value: float) -> str:
    """Three significant digits, never in exponents; what rounds to zero has no sign."""
    size = abs(value)
    return local(value, ".0f" if size >= 100 else ".1f" if size >= 10 else "z.2f")


def with_unit(value: float, unit: str, sd: float | None = None) -> str:
    """Say a value with its unit, and its deviation where it shows; the degree sign stands close."""
    words = translated(unit_words(unit))
    if unit in COUNTED:
        return f"{value:.0f} {words}"
    gap = "" if unit in ("°", "") else " "
    unsure = f" ± {number(sd)}" if sd and number(sd) != number(0.0) else ""
    return f"{number(value)}{unsure}{gap}{words}"


def total_text(score: Score | None, void: str = "") -> str:
    """Say the total, or that there is none; none that the instructor declared void either."""
    if void:
        return ""
    if score is None or score.total is None:
        return tr("not scored")
    return tr("{total:.0f} of 100 points", total=score.total)


def _ended(sentence: str) -> str:
    return sentence if sentence.endswith((".", "!", "?")) else f"{sentence}."


def verdict(review: Review) -> tuple[str, str, str]:
    """Colour, symbol with word, and the reason in one line."""
    score = review.score
    if review.said.void:
        why = tr("Declared void by the instructor: {why}", why=review.said.void)
        return theme.WARNING, tr("▲ Void"), tr("{why} It does not count.", why=_ended(why))
    if score is None:
        why = begun(review.reason)
        return theme.TEXT_DIM, "–", _ended(why) if why else tr("This attempt was not scored.")
    if score.void_reason:
        why = _ended(begun(score.void_reason))
        return theme.WARNING, tr("▲ Void"), f"{why} {remedy(score, review.conditions)}"
    if score.passed:
        word = tr("✔ Passed") if review.drill is None else tr("✔ Reached")
        return theme.GOOD, word, near_mark_words(score)
    failures = listing(metric_title(row) for row in score.failures)
    if score.hard_fails:
        reason = begun(joined("; ", score.hard_fails))
    elif failures:
        reason = tr("Required and not met: {names}", names=failures)
    else:
        reason = tr("{mark:g} points are needed", mark=score.rules.pass_mark)
        if near := near_mark_words(score):
            reason = f"{_ended(reason)} {near}"
    word = tr("✖ Not passed") if review.drill is None else tr("✖ Not reached yet")
    return theme.BAD, word, reason


def near_mark_words(score: Score) -> str:
    """Say that a total lies within the error of measurement of the mark; empty if it does not."""
    mark = score.rules.mark
    if not score.is_near_mark or mark is None or mark.score_error is None:
        return ""
    return tr(
        "Within the error of measurement of the mark ({mark:g} ± {error:.1f} points): another "
        "attempt may fall on its other side.",
        mark=score.rules.pass_mark,
        error=mark.score_error,
    )


def remedy(score: Score, conditions: Conditions | None = None) -> str:
    """Say what can be done about a void attempt: it depends on what made it void."""
    if score.unseen and conditions is not None and conditions.kind is DeviceKind.SIMULATED:
        return tr(
            "It counts for nothing. The pictures of the simulated cameras came too late: this "
            "computer was too busy. Close other programs, then try again."
        )
    if not score.unseen:
        return tr(
            "It does not count and does not affect any average; fix what is named, if "
            "anything, and try again."
        )
    return tr(
        "It counts for nothing. Let both cameras see the marker (the tab Cameras says what each "
        "one lacks: light, something before it, the colour), then try again."
    )


def _points(row: Row, score: Score) -> str:
    weight = sum(other.weight for other in score.rows)
    if score.total is None or row.utility is None or weight <= 0.0 or row.weight <= 0.0:
        return "–"
    most = 100.0 * row.weight / weight
    return f"{local(most * row.counted, '.1f')} / {local(most, '.1f')}"


def _limits(row: Row) -> str:
    if row.tolerance is None:
        return tr("Shown for information; it does not count.")
    expert, good, passing, _ = row.tolerance.knots
    text = tr(
        "expert {expert:g}, good {good:g}, pass {passing:g} {unit}",
        expert=expert,
        good=good,
        passing=passing,
        unit=unit_words(row.unit),
    )
    required = tr("* required to pass") if row.tolerance.required else ""
    return "; ".join(filter(None, (text, required, pass_words(row.name, passing))))


def _best_sample(steps: ProcedureMarks) -> str:
    """Say what the samples hold: where the outer needle ended matters less than they."""
    if not steps.samples:
        return tr("No sample was taken.")
    best = max(sample.lesion_mm for sample in steps.samples)
    return tr(
        "{n} of {of} samples suffice for a diagnosis; the best holds {mm:.1f} mm of lesion.",
        n=sum(sample.is_diagnostic for sample in steps.samples),
        of=len(steps.samples),
        mm=best,
    )
