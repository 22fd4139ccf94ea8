"""Recomputes an attempt's score from its record and says what differs from what was written.

A score is believed because it can be computed again: everything that shows one outside the list of
sessions takes it from here. Deliberate forgery of the samples themselves is not found here.
"""

import json
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Final

from pydantic import ValidationError

from app.core.errors import AcusError
from app.core.messages import listed, sentence
from app.exercises.hand_bands import HandBands, judged_by_hand
from app.scoring.conditions import Conditions
from app.scoring.defaults import DEFAULT_TOLERANCES
from app.scoring.errors import ScoreFormatError
from app.scoring.result import Score
from app.scoring.rows import ScoreRules
from app.scoring.score import score
from app.scoring.tolerance import Tolerance
from app.scoring.version import KNOWN_VERSIONS, SCORING_VERSION
from app.session.conditions import BANDS, CONDITIONS, EXERCISE_FILE, conditions_of
from app.session.machine import FINAL
from app.session.recording import Recording
from app.session.sample_columns import SAMPLES_FILE

SCORE_FILE: Final = "score.json"
"""Name of the attachment that holds the score."""

RELATIVE: Final = 1e-9
"""Numbers that differ by less are the same: another processor sums in another order."""


@dataclass(frozen=True, slots=True)
class Change:
    """One value that is not what the record gives.

    Attributes:
        what: of the value: `total`, `passed`, a metric's name, or a field of the list's file.
        written: value that was written.
        recomputed: value that the record gives now.
    """

    what: str
    written: Any
    recomputed: Any

    def sentence(self) -> str:
        """Say it in one line."""
        return sentence(
            "{quantity}: {written} written, {recomputed} by the record",
            quantity=self.what,
            written=_word(self.written),
            recomputed=_word(self.recomputed),
        )


@dataclass(frozen=True, slots=True)
class Verification:
    """What the record of an attempt says of its score.

    Attributes:
        session: id.
        written: the score as it was written; None without one.
        recomputed: by the rules of the written score's version, by today's where this program does
            not have those; None where they give none.
        unscored: why today's rules give no score; empty if they do.
        changes: what differs, one each; empty if nothing does.
        finished: whether the attempt was ended or aborted; only then a score is expected.
        cut: why the record does not hold all samples of the attempt; empty if it does. Its score
            cannot be computed again then, and stands as it was written.
    """

    session: str
    written: Score | None
    recomputed: Score | None
    unscored: str
    changes: tuple[Change, ...]
    finished: bool
    cut: str = ""

    @property
    def same_rules(self) -> bool:
        """Return whether the rules that the score was written under are known; without one they
        are.
        """
        return self.written is None or self.written.version in KNOWN_VERSIONS

    @property
    def confirmed(self) -> bool:
        """Return whether what was written is what the record gives, by the rules that it states."""
        return self.same_rules and not self.changes and not self.cut

    @property
    def standing(self) -> Score | None:
        """The score to show: what the record gives; of another scoring version, what it kept.

        None for an attempt that was not finished, whatever its record holds.
        """
        if not self.finished:  # what a cut record kept of a score is of no finished attempt
            return None
        if self.cut:
            return self.written
        return self.recomputed if self.same_rules else self.written

    def remarks(self) -> tuple[str, ...]:
        """Say what whoever sees the score must know; nothing if all is as written."""
        if not self.finished or (self.written is None and self.recomputed is None):
            return ()
        if self.cut:
            return (
                sentence("the score cannot be computed again: not all samples are in the record"),
            )
        if self.written is not None and not self.same_rules:
            now = _points(self.recomputed) if self.recomputed is not None else "no score"
            return (
                sentence(
                    "scored by version {written_version}: {points}, by today's rules: {now}",
                    written_version=self.written.version,
                    points=_points(self.written),
                    now=now,
                ),
            )
        if self.confirmed:
            return ()
        most = "; ".join(change.sentence() for change in self.changes[:3])
        more = f"; and {len(self.changes) - 3} more" if len(self.changes) > 3 else ""
        return (
            sentence(
                "the score in this record is not what its samples give: {most}{more}",
                most=most,
                more=more,
            ),
        )

    def sentences(self) -> list[str]:
        """Say all of it, one line each."""
        if not self.finished:
            return [sentence("the attempt was not finished: it has no score to verify")]
        remarks = [] if self.same_rules and not self.cut else [*self.remarks()]
        if not self.same_rules:
            known = sentence(
                "this program has the rules of versions {versions}",
                versions=_names(KNOWN_VERSIONS),
            )
            remarks.append(sentence("it cannot be checked: {known}", known=known))
        if not self.confirmed:
            cut = (self.cut,) if self.cut else ()
            return [*remarks, *cut, *(change.sentence() for change in self.changes)]
        if self.recomputed is None:
            return [
                *remarks,
                sentence("not scored, as written: {unscored}", unscored=self.unscored),
            ]
        rows = len(self.recomputed.rows)
        return [*remarks, f"confirmed: {_points(self.recomputed)}, {rows} metrics"]

    def document(self) -> dict[str, Any]:
        """JSON-ready mapping; the keys stand in docs/json.md."""
        return {
            "session": self.session,
            "confirmed": self.confirmed,
            "finished": self.finished,
            "written_total": self.written.total if self.written else None,
            "written_version": self.written.version if self.written else None,
            "recomputed_total": self.recomputed.total if self.recomputed else None,
            "scoring_version": SCORING_VERSION,
            "unscored": self.unscored,
            "cut": self.cut,
            "changes": [
                {"what": c.what, "written": c.written, "recomputed": c.recomputed}
                for c in self.changes
            ],
        }


def verify(recording: Recording) -> Verification:
    """Recompute score and metrics of a record and compare them with what was written; no raise."""
    written, unreadable = written_score(recording)
    finished = state_of(recording) in {state.value for state in FINAL}
    if not finished:
        return Verification(recording.id, written, None, "", (), finished)
    cut = recording.metadata.get("result", {}).get("full", "")
    if cut and SAMPLES_FILE not in recording.attachments:
        return Verification(recording.id, written, None, "", (), finished, cut)
    now, unscored = _recomputed(recording, written)
    changes = [Change(SCORE_FILE, unreadable, "a score")] if unreadable else []
    comparable = written is None or written.version in KNOWN_VERSIONS
    if comparable and (written is not None or now is not None):
        changes += changes_between(written, now, unscored)
    return Verification(recording.id, written, now, unscored, tuple(changes), finished)


def conditions(recording: Recording, standing: Score | None) -> Conditions:
    """Gather what a recorded attempt was made under, with the version of the score that stands."""
    version = standing.version if standing is not None else 0
    return conditions_of(recording.metadata, recording.samples, version, recording.events)


def state_of(recording: Recording) -> str:
    """Last state of the attempt, as its result says or else its last sample; empty if neither."""
    state = recording.metadata.get("result", {}).get("state", "")
    if state in {final.value for final in FINAL}:
        return state
    states = recording.samples.state
    return str(states[-1]) if len(states) else ""


def written_score(recording: Recording) -> tuple[Score | None, str]:
    """Return the score that was written, and why it cannot be read (empty if it can)."""
    stored = recording.attachments.get(SCORE_FILE)
    if stored is None:
        return None, ""
    try:
        return Score.from_json(stored.decode()), ""
    except (ScoreFormatError, UnicodeDecodeError, RecursionError) as error:
        return None, str(error)


def _recomputed(recording: Recording, written: Score | None) -> tuple[Score | None, str]:
    tolerances, rules = judged_by(recording, written)
    try:
        return score(recording.trajectory(), tolerances, rules, _version_of(written)), ""
    except AcusError as error:
        return None, str(error)


def _version_of(written: Score | None) -> int:
    """Version of the rules to compute a score again by: its own, if this program has them."""
    own = written is not None and written.version in KNOWN_VERSIONS
    return written.version if own and written is not None else SCORING_VERSION


def _names(versions: Iterable[int]) -> str:
    return listed(map(str, versions))


def judged_by(
    recording: Recording, written: Score | None
) -> tuple[Mapping[str, Tolerance], ScoreRules]:
    """Return tolerances and rules: the attached exercise's, else those of the written score.

    Where the record says so, by the bands of the hand that made the attempt.
    """
    try:
        exercise = json.loads(recording.attachments[EXERCISE_FILE])
        tolerances = {
            str(name): Tolerance.model_validate(limits)
            for name, limits in exercise["tolerances"].items()
        }
        whose = recording.metadata.get(CONDITIONS, {}).get(BANDS, "")
        bands = HandBands.model_validate(exercise["bands"][whose]) if whose else None
        return judged_by_hand(tolerances, bands), ScoreRules.model_validate(exercise["rules"])
    except (KeyError, TypeError, AttributeError, ValueError, ValidationError, RecursionError):
        pass  # a damaged exercise: the score carries what it was judged by
    if written is None:
        return DEFAULT_TOLERANCES, ScoreRules()
    return {row.name: row.tolerance for row in written.rows if row.tolerance}, written.rules


def changes_between(written: Score | None, now: Score | None, unscored: str) -> list[Change]:
    """Return what differs between the score that was written and the one that is computed now.

    Args:
        written: None without one.
        now: None where there is none.
        unscored: why.
    """
    if written is None or now is None:
        return [
            Change("score", _points(written), _points(now) + (f" ({unscored})" if unscored else ""))
        ]
    pairs: list[tuple[str, Any, Any]] = [
        ("total", written.total, now.total),
        ("passed", written.passed, now.passed),
        ("void", written.void_reason, now.void_reason),
        ("pass mark", written.rules.pass_mark, now.rules.pass_mark),
    ]
    before = {row.name: row for row in written.rows}
    after = {row.name: row for row in now.rows}
    for name in dict.fromkeys((*before, *after)):
        a, b = before.get(name), after.get(name)
        if a is None and b is not None and b.tolerance is None:
            continue  # a metric that came later and counts nothing
        pairs.append((name, a.value if a else "no such metric", b.value if b else "no such metric"))
        if a and b and a.sd is not None and not _alike(a.sd, b.sd):
            pairs.append((f"uncertainty of {name}", a.sd, b.sd))
        if a and b and a.tolerance != b.tolerance:
            pairs.append((f"limits of {name}", _limits(a.tolerance), _limits(b.tolerance)))
    return [Change(name, a, b) for name, a, b in pairs if not _same(a, b)]


def _same(a: Any, b: Any) -> bool:
    if isinstance(a, float) and isinstance(b, float):
        return math.isclose(a, b, rel_tol=RELATIVE, abs_tol=RELATIVE)
    return bool(a == b)


def _alike(a: float, b: float | None) -> bool:
    """Return whether two standard deviations are the same; they are products of longer sums."""
    return b is not None and math.isclose(a, b, rel_tol=1e-6, abs_tol=RELATIVE)


def _limits(tolerance: Tolerance | None) -> str:
    if tolerance is None:
        return "none"
    knots = ", ".join(f"{knot:g}" for knot in tolerance.knots)
    required = ", required" if tolerance.required else ""
    return f"{knots} (weight {tolerance.weight:g}{required})"


def _points(score: Score | None) -> str:
    if score is None:
        return "no score"
    return sentence("void") if score.total is None else f"{score.total:.0f}"


def _word(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.6g}"
    return "nothing" if value in (None, "") else str(value)
