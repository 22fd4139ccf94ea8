"""The rule that chooses a default: the cheapest way whose error nobody notices, in time.

A way comes into question if it answers in every setting, stays below the perception line in all of
them and within the deadline in all of them. Of these the cheapest is the sweet spot; since times
differ between runs and computers, ways of up to `EQUALLY_CHEAP` times the least time count as
equally cheap, and the most exact of them is chosen: the one whose worst share of what is noticed is
least. A program that does otherwise says why (`Study.exception`); the number is computed here.
"""

from typing import Final

from app.studies.study import Point, Result, duration

EQUALLY_CHEAP: Final = 1.2
"""Times within a fifth of the least are not told apart."""


def sweet_spot(result: Result) -> str | None:
    """Return the name of the way that the rule chooses; None where no way comes into question."""
    fit = [p for p in result.summary() if not _misses(result, p)]
    if not fit:
        return None
    least = min(p.seconds for p in fit)
    near = [p for p in fit if p.seconds <= EQUALLY_CHEAP * least]
    return min(near, key=lambda p: noticed_share(result, p.way)).way


def noticed_share(result: Result, way: str) -> float:
    """Return a way's largest error as a share of what is noticed in its setting."""
    return max(p.error / p.noticed for p in result.points if p.way == way)


def departure(result: Result) -> str:
    """Return why the default is not the sweet spot, with its number; empty where it is."""
    study, chosen = result.study, sweet_spot(result)
    if chosen == study.default:
        return ""
    worst = {p.way: p for p in result.summary()}
    if study.default not in worst:
        number = f"`{study.default}` gave no answer"
    elif chosen is None:
        number = f"no way keeps all limits; `{study.default}` {_off(result, worst[study.default])}"
    else:
        own, other = worst[study.default], worst[chosen]
        number = (
            f"`{study.default}` takes {own.seconds / other.seconds:.2g} times the time of "
            f"`{chosen}` ({duration(own.seconds)} against {duration(other.seconds)}); its error is "
            f"{noticed_share(result, own.way):.2g} of what is noticed against "
            f"{noticed_share(result, chosen):.2g}"
        )
        missed = _misses(result, own)
        number += f"; it {_off(result, own)}" if missed else ""
    return f"{number}. {study.exception}" if study.exception else number


def _misses(result: Result, worst: Point) -> bool:
    answered = sum(p.way == worst.way for p in result.points)
    asked = len(result.study.settings)
    return not (worst.within_perception and worst.within_deadline and answered == asked)


def _off(result: Result, worst: Point) -> str:
    """Say by how much a way misses its limits."""
    study, missed = result.study, []
    if not worst.within_perception:
        own = [p for p in result.points if p.way == worst.way]
        over = max(own, key=lambda p: p.error / p.noticed)
        share = over.error / over.noticed
        missed.append(f"has {share:.2g} times what is noticed in {over.setting}")
    if not worst.within_deadline:
        missed.append(f"takes {worst.seconds / study.deadline.value:.2g} times the deadline")
    silent = [f.setting for f in result.failures if f.way == worst.way]
    if silent:
        missed.append(f"gives no answer in {', '.join(silent)}")
    return " and ".join(missed)
