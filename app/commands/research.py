"""`acus research`: studies with students, from design to the bundle that is published."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from app.commands import completion
from app.commands.answer import Answer, Commands
from app.commands.doors import instructor
from app.commands.reader_language import template
from app.commands.record_options import RecordsFolder
from app.commands.shown import Each
from app.core.errors import writing
from app.core.messages import sentence

if TYPE_CHECKING:
    from app.research.research_study import ResearchStudy
    from app.session.people import People

DesignFile = Annotated[Path, typer.Argument(metavar="FILE", help="Design of the study, YAML.")]
StudyName = Annotated[str, typer.Argument(metavar="STUDY", help="Its id.")]
Student = Annotated[
    str,
    typer.Argument(metavar="STUDENT", help="Pseudonym.", autocompletion=completion.students),
]

RANK = 115


def register(app: typer.Typer) -> None:
    """Add the commands of research studies."""
    research = Commands(help="Research studies with students.")
    for command in (new, check, begin, enrol, answer, leave, status, lock, bundle, verify, power):
        research.command(command.__name__)(command)
    app.add_typer(research, name="research")


def new(
    out: Annotated[Path, typer.Option("--out", help="File to write.")],
) -> Answer:
    """Write the design of an example study to change (instructor)."""
    from app.core import paths
    from app.core.files import write_atomically
    from app.research import ResearchError

    instructor()
    example = paths.resources() / "research" / "design.yaml"
    if out.exists():
        raise ResearchError(sentence("{file} is there already: give another name", file=out))
    with writing(out, ResearchError):
        write_atomically(out, example.read_text(encoding="utf-8"))
    shown = template("{files}: change it, then `acus research check {files.0}`")
    return Answer({"files": [str(out)]}, shown=shown)


def check(design: DesignFile) -> Answer:
    """Say whether a study can begin as designed (instructor).

    Ends with code 3 if it cannot.
    """
    from app.research import design_problems, read_design
    from app.research.allocation_list import imbalance_bound

    instructor()
    found = read_design(design)
    problems = design_problems(found)
    facts = {
        "study": found.id,
        "arms": [arm.name for arm in found.arms],
        "participants": found.participants,
        "lists": list(found.randomisation.labels()),
        "imbalance": imbalance_bound(found),
        "problems": problems,
    }
    shown = (
        template("{study}: {participants} participants in {arms}, {lists:#1 list|# lists}"),
        template("in a list arms are never more than {imbalance} apart"),
        Each("problems", "✖ {}"),
    )
    return Answer(facts, yes=not problems, shown=shown)


def begin(
    design: DesignFile,
    seed: Annotated[
        int | None,
        typer.Option("--seed", help="Of the list: who knows it knows the list."),
    ] = None,
) -> Answer:
    """Begin a study: its list is drawn and sealed (instructor).

    Each arm gets a course, and an exercise of its own where it changes one. Register the
    commitment before the first student: it shows at the end that the list was this one.
    """
    from app.research import begin as begin_study
    from app.session.people import People

    people = People()
    instructor(people)
    study = begin_study(design, people, seed)
    facts = {
        "study": study.design.id,
        "folder": str(study.folder),
        "commitment": study.sealed["commitment"],
        "design": study.design.digest,
    }
    shown = (
        template("{study} has begun: its list is sealed"),
        template("commitment to register: {commitment}"),
    )
    return Answer(facts, shown=shown)


def enrol(
    study: StudyName,
    student: Student,
    consent_by: Annotated[str, typer.Option("--consent-by", help="Who took the consent.")],
    consent_version: Annotated[
        str, typer.Option("--consent-version", help="Of the text that was signed.")
    ],
    stratum: Annotated[
        list[str] | None, typer.Option("--stratum", help="FACTOR=LEVEL, for each factor.")
    ] = None,
) -> Answer:
    """Enrol a student who consented, and show the arm (instructor).

    The next place of the list is opened now and not before. The student takes the course of the
    arm from now on.
    """
    from app.research import ResearchError
    from app.research.research_study import group_of

    people, found = _opened(study)
    if consent_version != found.design.consent.version:
        raise ResearchError(
            sentence(
                "the student signed version {signed}; the study has version {version}",
                signed=consent_version,
                version=found.design.consent.version,
            )
        )
    levels = dict(_level(text) for text in stratum or ())
    one = found.enrol(people.find(student), levels, consent_by, people)
    facts = {
        "study": found.design.id,
        "code": one.code,
        "arm": one.arm,
        "course": group_of(found.design, one.arm),
        "enrolled": one.enrolled,
        "consent": one.consent,
    }
    shown = template("{code} is in arm {arm}: course {course}")
    return Answer(facts, shown=shown)


def answer(
    study: StudyName,
    questionnaire: Annotated[
        str, typer.Argument(metavar="QUESTIONNAIRE", help="sus, nasa-tlx, realism, or a .yaml.")
    ],
    file: Annotated[
        Path | None, typer.Option("--from", help="CSV with student, visit and a column an item.")
    ] = None,
    student: Annotated[
        str,
        typer.Option("--student", help="Pseudonym.", autocompletion=completion.students),
    ] = "",
    visit: Annotated[str, typer.Option("--visit", help="Name of the visit.")] = "",
    answers: Annotated[
        list[str] | None, typer.Option("--answer", help="ITEM=NUMBER, for each item.")
    ] = None,
) -> Answer:
    """Enter what students answered to a questionnaire (instructor).

    All rows of a file are taken or none. Scores are made by the questionnaire's rule.
    """
    from app.research import ResearchError
    from app.research.questionnaires import find_questionnaire, numbers_of, read_answers
    from app.research.research_study import AnsweredRow

    people, found = _opened(study)
    asked = find_questionnaire(questionnaire)
    if (file is None) == (not student):
        raise ResearchError(sentence("give --from FILE, or --student, --visit and --answer"))
    if file is None:
        items = [_level(text) for text in answers or ()]
        rows = [AnsweredRow(student, visit, numbers_of(dict(items)))]
    else:
        rows = []
        for row in read_answers(file):
            who, when = row.pop("student", ""), row.pop("visit", "")
            rows.append(AnsweredRow(who, when, numbers_of(row)))
    scores = found.answer(rows, asked, people)
    facts = {
        "study": found.design.id,
        "questionnaire": asked.id,
        "answers": [
            {"pseudonym": row.student, "visit": row.visit, "scores": made}
            for row, made in zip(rows, scores, strict=True)
        ],
    }
    score = Each("scores", template("  {key}: {value:.1f}"))
    shown = Each("answers", (template("{pseudonym} at {visit}"), score))
    return Answer(facts, shown=shown)


def leave(
    study: StudyName,
    student: Student,
    reason: Annotated[str, typer.Option("--reason", help="As it goes into the flow.")] = "",
    withdraw_data: Annotated[
        bool, typer.Option("--withdraw-data", help="What was recorded is not used either.")
    ] = False,
) -> Answer:
    """Let a student leave a study (instructor)."""
    people, found = _opened(study)
    one = found.leave(people.find(student), reason, withdraw_data, people)
    facts = {"study": found.design.id, "code": one.code, "withdrawn": one.withdrawn}
    shown = template("{code} has left{withdrawn:?; the data are not used|}")
    return Answer(facts, shown=shown)


def status(
    study: Annotated[str, typer.Argument(metavar="STUDY", help="Its id; all without it.")] = "",
    folder: RecordsFolder = None,
) -> Answer:
    """Show who is enrolled, and which visits are due (instructor).

    Arms stay hidden while the assessor is blind.
    """
    from app.research import studies_here
    from app.research.status import status_of
    from app.session.store import records_folder

    if study:
        people, found = _opened(study)
        studies = [found]
    else:
        from app.session.people import People

        people = People()
        instructor(people)
        studies = studies_here()
    place = records_folder(folder)
    facts = {"studies": [status_of(one, people, place) for one in studies]}
    visit = template(
        "  {pseudonym} ({code}): {visit} from {opens} to {closes}, {attempts} of {wanted} attempts"
        "{late:? — late|}"
    )
    shown = Each(
        "studies",
        (
            template("{study}: {enrolled} of {participants} enrolled, {left} left"),
            Each("arms", template("  {arm}: {enrolled} enrolled")),
            template("{blind:?  arms are hidden until the data are locked|}"),
            template("{locked:?  the data were locked on {locked:@}|}"),
            Each("due", visit),
        ),
        template("no study has begun here: `acus research new --out FILE` writes a design"),
    )
    return Answer(facts, shown=shown)


def lock(
    study: StudyName,
    by: Annotated[str, typer.Option("--by", help="Who locks them.")],
) -> Answer:
    """Lock a study's data: enrolment ends, arms are shown (instructor).

    It cannot be undone.
    """
    _, found = _opened(study)
    facts = {"study": found.design.id, "locked": found.lock(by)}
    return Answer(facts, shown=template("the data of {study} are locked"))


def bundle(
    study: StudyName,
    out: Annotated[Path, typer.Option("--out", help="File to write, .zip.")],
    folder: RecordsFolder = None,
) -> Answer:
    """Write all of a study as one file that names nobody (instructor).

    Tables with their codebook, the flow of participants, exercises, series and scores. Ctrl-C
    cancels; a file is written whole or not at all.
    """
    from app.commands.calibrate_parts import with_progress
    from app.research.bundle import write_bundle
    from app.session.store import records_folder

    people, found = _opened(study)
    place = records_folder(folder)
    done = with_progress(lambda progress: write_bundle(found, people, place, out, progress))
    facts = {
        "files": [str(out)],
        "participants": done.participants,
        "attempts": done.attempts,
        "series": done.series,
        "digest": done.digest,
        "without": list(done.without),
    }
    shown = (
        template(
            "{participants:#1 participant|# participants}, {attempts:#1 attempt|# attempts} "
            "written to {files}"
        ),
        template("its digest, to be stated with the results: {digest}"),
        Each("without", template("left out: {}")),
    )
    return Answer(facts, shown=shown)


def verify(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Bundle of a study.")],
) -> Answer:
    """Check a bundle: hashes, allocations, every score again.

    It needs nothing but the file. Ends with code 3 if something differs.
    """
    from app.commands.calibrate_parts import with_progress
    from app.research.bundle_check import check_bundle

    found = with_progress(lambda progress: check_bundle(file, progress))
    facts = {
        "study": found.study,
        "digest": found.digest,
        "files": found.files,
        "scores": found.scores,
        "made_again": found.made_again,
        "problems": list(found.problems),
        "notes": list(found.notes),
    }
    shown = (
        template(
            "{study}: {files:#1 file|# files} as stated; made again: {scores:#1 score|# scores}, "
            "{made_again:#1 table or figure|# tables and figures}"
        ),
        template("digest: {digest}"),
        Each("notes", template("{}")),
        Each("problems", "✖ {}"),
    )
    return Answer(facts, yes=not found.problems, shown=shown)


def power(
    effect: Annotated[float, typer.Option("--effect", help="Difference of the arms.")],
    sd: Annotated[float, typer.Option("--sd", help="Between students, at one visit.")],
    correlation: Annotated[
        float, typer.Option("--correlation", help="Of a student's two visits, 0 to 1.")
    ] = 0.5,
    visits: Annotated[int, typer.Option("--visits", help="The first is before training.")] = 2,
    students: Annotated[
        int | None, typer.Option("--students", help="In all; else as many as --power needs.")
    ] = None,
    wanted: Annotated[float, typer.Option("--power", help="That is wanted.")] = 0.8,
    dropout: Annotated[float, typer.Option("--dropout", help="Share that leaves.")] = 0.0,
    alpha: Annotated[float, typer.Option("--alpha", help="Of the two-sided test.")] = 0.05,
    share: Annotated[float, typer.Option("--share", help="Of students in arm two.")] = 0.5,
    simulations: Annotated[int, typer.Option("--simulations", help="How many studies.")] = 2000,
    seed: Annotated[int, typer.Option("--seed", help="Of the simulated studies.")] = 1,
) -> Answer:
    """Say how many students two arms need, or which power they have.

    Simulates studies under a mixed model with students as random intercepts, and fits each; beside
    it the closed forms of the t test and of the covariate test.
    """
    from app.research.power import Assumptions, power_of_t, simulate, students_by_simulation
    from app.research.power import students_for as closed_form

    for name, value, least, most in (
        ("--power", wanted, 0.06, 0.99),
        ("--dropout", dropout, 0.0, 0.9),
        ("--simulations", simulations, 100, 100_000),
    ):
        if not least <= value <= most:
            raise typer.BadParameter(
                sentence(
                    "{name} is {entry:g}: give {least:g} to {most:g}",
                    name=name,
                    entry=value,
                    least=least,
                    most=most,
                )
            )
    assumed = Assumptions(effect, sd, correlation, visits, share, alpha)
    stay = 1.0 - dropout
    if students is None:
        done = students_by_simulation(assumed, wanted, simulations, seed)
    else:
        done = simulate(int(students * stay + 1e-9), assumed, simulations, seed)
    facts = {
        "students": students or -int(-done.students / stay // 1),
        "complete": done.students,
        "power": done.power,
        "power_error": done.error,
        "coverage": done.coverage,
        "simulations": done.simulations,
        "t_test": {
            "power": power_of_t(done.students, assumed, False),
            "students": closed_form(lambda n: power_of_t(n, assumed, False), wanted),
        },
        "with_baseline": {
            "power": power_of_t(done.students, assumed, True),
            "students": closed_form(lambda n: power_of_t(n, assumed, True), wanted),
        },
    }
    shown = (
        template(
            "{students} students, of whom {complete} stay: power {power:.3f} ± {power_error:.3f} "
            "by {simulations} simulated studies; the interval holds the effect in {coverage:.1%}"
        ),
        template("t test without baseline: power {t_test.power:.3f} with as many"),
        template("with the first visit as covariate: power {with_baseline.power:.3f}"),
    )
    return Answer(facts, shown=shown)


def _opened(study: str) -> "tuple[People, ResearchStudy]":
    """Return people and a study, to the instructor."""
    from app.research import find_study
    from app.session.people import People

    people = People()
    instructor(people)
    return people, find_study(study)


def _level(text: str) -> tuple[str, Any]:
    factor, equals, level = text.partition("=")
    if not equals:
        raise typer.BadParameter(sentence("{entry!r}: give NAME=VALUE", entry=text))
    return factor.strip(), level.strip()
