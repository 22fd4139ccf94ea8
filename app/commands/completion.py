"""What the shell completes beside the names of commands and options."""

from collections.abc import Iterable


def exercises(incomplete: str) -> list[str]:
    """Return the exercises of the library that begin so."""
    from app.exercises.library import library

    return fitting(library().ids(), incomplete)


def sessions(incomplete: str) -> list[str]:
    """Return the ids of recorded attempts that begin so; none where they are students'."""
    from app.core.paths import sessions as folder

    if _guarded():
        return []
    return fitting(sorted(path.stem for path in folder().glob("*.mcap")), incomplete)


def courses(incomplete: str) -> list[str]:
    """Return the courses that begin so; none where they are the instructor's to see."""
    from app.session.course import courses as known

    if _guarded():
        return []
    return fitting([course.id for course in known()[0]], incomplete)


def students(incomplete: str) -> list[str]:
    """Return the pseudonyms that begin so; none where they are the instructor's to see."""
    from app.session.people import People

    if _guarded():
        return []
    return fitting([person.pseudonym for person in People().everybody()], incomplete)


def profiles(incomplete: str) -> list[str]:
    """Return the device profiles that begin so."""
    from app.mechanisms.profile import profile_names

    return fitting(profile_names(), incomplete)


def _guarded() -> bool:
    """Return whether an instructor's password is set."""
    from app.session.people import People

    return People().has_instructor()


def fitting(names: Iterable[str], incomplete: str) -> list[str]:
    """Return the names that begin so."""
    return [name for name in names if name.startswith(incomplete)]
