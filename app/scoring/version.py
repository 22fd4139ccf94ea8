"""Versions of the rules that make a score."""

from typing import Final

SCORING_VERSION: Final = 7
"""Of the rules that make a score: it grows whenever a metric, the judging, or what makes an attempt
void gives another answer to the same attempt. Scores of two versions are not comparable."""

GATED: Final = 7
"""From this one on what an attempt was like counts only as far as it came to its target."""

KNOWN_VERSIONS: Final = (5, 6, SCORING_VERSION)
"""Versions whose rules this program still has, so that a score is checked by its own. What changed:

7: what an attempt was like counts as far as its target was reached; an insertion that nobody saw
begin counts as unseen from where the needle was seen last; a plan of the student's own is judged.
6: the spectral arc length takes each picture once and smooths no more than its noise asks for; what
the rules forbid to be met fails the attempt.
"""
