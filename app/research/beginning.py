"""How a research study begins: its list is sealed, its arms get courses and exercises."""

from __future__ import annotations

import json
from pathlib import Path

import yaml

from app.core import paths
from app.core.files import write_atomically
from app.core.messages import sentence
from app.exercises.guidance import Purpose
from app.exercises.schema import Exercise
from app.exercises.writing import write_exercise
from app.research.allocation_list import seal, seed_of
from app.research.design import (
    Arm,
    Feedback,
    ResearchDesign,
    design_problems,
    exercise_of,
    read_design,
)
from app.research.errors import ResearchError
from app.research.research_study import (
    DESIGN,
    EXERCISE,
    SEALED,
    Clock,
    ResearchStudy,
    now_utc,
    research_folder,
)
from app.session.course import Course, CourseItem, courses_folder
from app.session.people import People
from app.session.station import StationKey


def begin(
    path: Path, people: People, seed: int | None = None, clock: Clock = now_utc
) -> ResearchStudy:
    """Begin the study of a design: seal its list, write the exercises of its arms.

    Args:
        path: file of the design.
        people: of this station.
        seed: of the list; drawn at random without one. Whoever knows it knows the list.
        clock: time of the wall.

    Raises:
        ConfigurationError: if the design cannot be used.
        ResearchError: if it cannot begin; says why.
    """
    design = read_design(path)
    if problems := design_problems(design):
        raise ResearchError(problems[0])
    if design.stopping.until and design.stopping.until < clock().date():
        raise ResearchError(
            sentence(
                "{path}: stopping.until: {until} is past; nobody could be enrolled",
                path=path,
                until=design.stopping.until,
            )
        )
    folder = research_folder() / design.id
    if (folder / SEALED).exists():
        raise ResearchError(
            sentence(
                "{study} has begun already: its list is sealed; another study needs another id",
                study=design.id,
            )
        )
    _check_free(design, people)
    sealed = seal(design, seed_of(seed), StationKey.of(people.folder))
    text = yaml.safe_dump(design.document(), sort_keys=False, allow_unicode=True)
    try:
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        for number, arm in enumerate(design.arms, start=1):
            exercise = exercise_of(design, arm)
            if arm.changes_exercise:
                write_exercise(paths.data() / "exercises" / f"{exercise.id}.yaml", exercise)
            write_exercise(folder / EXERCISE.format(number=number), exercise)
            _course(design, number, arm, exercise).save(people.folder)
        write_atomically(folder / DESIGN, text)
        write_atomically(folder / SEALED, json.dumps(sealed, indent=1) + "\n")
    except OSError as error:
        raise ResearchError(
            sentence(
                "cannot write {folder}: {reason}", folder=folder, reason=error.strerror or error
            )
        ) from error
    return ResearchStudy(folder, design, clock)


def _course(design: ResearchDesign, number: int, arm: Arm, exercise: Exercise) -> Course:
    """Return the course of an arm: its exercise, held back where feedback is."""
    held = arm.feedback is Feedback.HELD
    item = CourseItem(
        exercise=exercise.id,
        version=exercise.version,
        purpose=Purpose.ASSESSMENT if held else Purpose.PRACTICE,
    )
    name = f"{design.id}-{number}"
    return Course(id=name, title=design.title, groups=(name,), items=(item,))


def _check_free(design: ResearchDesign, people: People) -> None:
    """Refuse a study whose courses or exercises would replace others.

    Raises:
        ResearchError: naming the first file that is there.
    """
    for number, arm in enumerate(design.arms, start=1):
        files = [courses_folder(people.folder) / f"{design.id}-{number}.yaml"]
        if arm.changes_exercise:
            files.append(paths.data() / "exercises" / f"{design.id}-{number}.yaml")
        there = [file for file in files if file.exists()]
        if there:
            raise ResearchError(
                sentence("{file} is there already: give the study another id", file=there[0])
            )
