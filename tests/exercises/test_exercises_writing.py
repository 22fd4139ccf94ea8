"""Exercises into files and back: equal, in versions, with a schema; errors name field and line."""

import json
import string
from pathlib import Path

import jsonschema
import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from app.core.configuration import checked, parse_text
from app.core.errors import ConfigurationError
from app.exercises.errors import ExerciseError, UnknownExerciseError
from app.exercises.guidance import FadingPart, starting_dial
from app.exercises.library import folders, library, load_exercise, read_exercise, versions
from app.exercises.schema import Exercise
from app.exercises.writing import (
    exercise_text,
    free_id,
    save,
    schema_document,
    schema_text,
    write_exercise,
)

ROOT = Path(__file__).resolve().parents[2]
texts = st.text(st.characters(exclude_categories=["Cs"]), max_size=60)
letters = st.characters(exclude_categories=["Cs", "Cc"], exclude_characters="\0/\\")
names = st.text(letters, min_size=1, max_size=12).filter(lambda name: name not in (".", ".."))
numbers = st.floats(-1e4, 1e4, allow_nan=False)
shares = st.floats(-1.0, 1.0)
triples = st.tuples(numbers, numbers, numbers)


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("ACUS_DATA", str(tmp_path))
    return tmp_path / "exercises"


@st.composite
def knots(draw, falling=False):
    rising = sorted(draw(st.lists(st.integers(0, 10**6), min_size=4, max_size=4, unique=True)))
    values = [number / 128.0 for number in (rising[::-1] if falling else rising)]
    words = dict(zip(("expert", "good", "pass", "zero"), values, strict=True))
    return words | {"weight": draw(st.floats(0.1, 1e3)), "required": draw(st.booleans())}


@st.composite
def exercises(draw):
    entry = draw(triples)
    away = draw(st.permutations((0.0, 20.0, 3.5)))
    target = tuple(value + step for value, step in zip(entry, away, strict=True))
    parts = st.dictionaries(names, st.fixed_dictionaries({}, optional={
        "parameters": st.dictionaries(names, numbers, max_size=3), "model": texts, "organ": texts,
    }), max_size=3)  # fmt: skip
    laws = st.dictionaries(names, st.fixed_dictionaries({}, optional={
        "parameters": st.dictionaries(names, numbers, max_size=3)}), max_size=3)  # fmt: skip
    word = st.text(string.ascii_lowercase + string.digits, min_size=1, max_size=8)
    folder = draw(st.booleans())
    own = {"own": True, "target_mm": target}
    points = {"entry_mm": entry, "target_mm": target, "name": draw(texts)}
    ct = {"folder": f"/somewhere/{draw(names)}", "series": draw(st.none() | texts),
          "remedy": draw(st.sampled_from(("none", "halve"))),
          "digest": draw(st.none() | st.just("0123456789abcdef" * 4))}  # fmt: skip
    risks = st.dictionaries(names, st.floats(0.0, 50.0), max_size=3)
    fading = {"kind": "schedule", "dials": draw(st.lists(shares, min_size=1, max_size=4)),
              "probe_every": draw(st.sampled_from((0, 2, 5)))}  # fmt: skip
    return Exercise.model_validate({
        "id": "-".join(draw(st.lists(word, min_size=1, max_size=4))),
        "version": draw(st.integers(1, 10**9)),
        "level": draw(st.integers(1, 9)),
        "title": draw(texts.filter(bool)),
        "description": draw(texts),
        "ct": ct if folder else {"phantom": {"seed": draw(st.integers(0, 10**9))}},
        "plan": draw(st.sampled_from((own, points, *(() if folder else ("phantom_default",))))),
        "structures": [{"file": f"/somewhere/{draw(names)}", "risks": draw(risks)}]
        if draw(st.booleans()) else [],
        "placement": {"orientation": draw(st.sampled_from(("supine", "prone"))),
                      "rotation_deg": [draw(st.floats(-360.0, 360.0)) for _ in "xyz"]},
        "device": "icube", "joint": draw(st.sampled_from(("", "new"))),
        "assistance": draw(shares),
        "fading": draw(st.none() | st.just(fading)),
        "laws": draw(laws), "effects": draw(parts),
        "layers": draw(st.lists(st.builds(lambda name, mm: {"name": name, "thickness_mm": mm},
                                          texts, st.floats(1e-3, 1e3)), max_size=3)),
        "needle": {"gauge": draw(st.sampled_from((17, 25)))},
        "target_organ": draw(texts),
        "tolerances": {"lateral_error": draw(knots()), "tracking_valid": draw(knots(falling=True))},
        "guidance": {"mode": draw(st.sampled_from((None, "live", "control_ct")))},
        "reading": {"window": draw(st.sampled_from((None, "lung")))},
        "views": draw(st.lists(st.sampled_from(("bullseye", "cameras", "three_d")), unique=True)),
        "locks": draw(st.none() | st.just(["views"])),
        "hand": draw(st.sampled_from((None, "mouse"))),
        "seed": draw(st.integers(0, 2**63)),
    })  # fmt: skip


SCHEMA = jsonschema.Draft202012Validator(schema_document())


@pytest.mark.long("statistics")
@settings(deadline=None, max_examples=100, suppress_health_check=[HealthCheck.too_slow])
@given(exercises())
def test_what_is_written_reads_back_equal_and_keeps_to_the_schema(exercise: Exercise) -> None:
    text = exercise_text(exercise)
    assert parse_text(text, Exercise, "x") == exercise
    SCHEMA.validate(yaml.safe_load(text))


@pytest.mark.parametrize("exercise", library().exercises, ids=lambda one: one.id)
def test_every_shipped_exercise_reads_back_equal(exercise: Exercise, tmp_path: Path) -> None:
    path = tmp_path / "copy.yaml"
    write_exercise(path, exercise)
    assert read_exercise(path) == exercise


def test_paths_below_the_folder_are_written_from_there(own: Path) -> None:
    own.mkdir()
    (own / "a.seg.nrrd").touch()
    exercise = Exercise.model_validate({
        "id": "x", "title": "X", "plan": {"entry_mm": [0, 0, 0], "target_mm": [0, 0, 9]},
        "ct": {"folder": own / "ct"}, "structures": [{"file": own / "a.seg.nrrd"}],
    })  # fmt: skip
    write_exercise(own / "x.yaml", exercise)
    text = (own / "x.yaml").read_text()
    assert str(own) not in text
    assert read_exercise(own / "x.yaml") == exercise


# --- versions -----------------------------------------------------------------------------------
@pytest.mark.long("journey")
def test_a_changed_exercise_is_a_new_version_and_the_earlier_ones_are_kept(own: Path) -> None:
    first = save(load_exercise("first-insertion").model_copy(update={"id": "mine", "version": 1}))
    assert first.version == 1
    assert save(first) == first
    second = save(first.model_copy(update={"level": 4}))
    third = save(second.model_copy(update={"level": 5}))
    assert (second.version, third.version) == (2, 3)
    assert versions("mine") == (1, 2, 3)
    assert library().broken == ()
    assert load_exercise("mine") == load_exercise("mine@3") == third
    assert load_exercise("mine@1") == first
    assert load_exercise("mine@2") == second
    with pytest.raises(UnknownExerciseError, match=r"no version 7 .* there are: 1, 2, 3"):
        load_exercise("mine@7")


@pytest.mark.long("journey")
def test_a_deleted_exercise_leaves_its_version_numbers_taken(own: Path) -> None:
    first = save(load_exercise("first-insertion").model_copy(update={"id": "mine", "version": 1}))
    save(first.model_copy(update={"level": 4}))
    (own / "mine.yaml").unlink()
    assert save(first.model_copy(update={"level": 6})).version == 2
    assert load_exercise("mine@1") == first


def test_a_shipped_exercise_stays_as_it_is(own: Path) -> None:
    with pytest.raises(ExerciseError, match="under another id"):
        save(load_exercise("first-insertion").model_copy(update={"level": 9}))


def test_a_file_that_cannot_be_used_is_not_written_over(own: Path) -> None:
    own.mkdir()
    (own / "mine.yaml").write_text("id: [")
    with pytest.raises(ExerciseError, match="cannot be used: repair it"):
        save(load_exercise("first-insertion").model_copy(update={"id": "mine"}))
    assert (own / "mine.yaml").read_text() == "id: ["


@pytest.mark.long("journey")
def test_a_file_of_another_name_keeps_its_name(own: Path) -> None:
    own.mkdir()
    (own / "by-hand.yaml").write_text("id: mine\ntitle: Mine\n")
    saved = save(load_exercise("mine").model_copy(update={"level": 3}))
    assert saved.version == 2
    assert sorted(path.name for path in folders()[1].glob("*.yaml")) == [
        "by-hand.yaml",
        "mine@1.yaml",
    ]


@pytest.mark.long("journey")
def test_a_full_disk_and_a_folder_that_is_none_are_one_line_and_nothing_is_lost(
    own: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = save(load_exercise("first-insertion").model_copy(update={"id": "mine", "version": 1}))

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr("app.core.files.os.replace", full)
        with pytest.raises(ExerciseError, match="No space left on device; nothing was changed"):
            save(first.model_copy(update={"level": 4}))
    assert load_exercise("mine") == first
    assert [path.name for path in own.glob("*.yaml")] == ["mine.yaml"]
    (own.parent / "other").mkdir()
    (own.parent / "other" / "exercises").write_text("a file")
    monkeypatch.setenv("ACUS_DATA", str(own.parent / "other"))
    with pytest.raises(ExerciseError, match="cannot write in"):
        save(first)


def test_an_id_is_made_of_any_title() -> None:
    assert free_id("Niere, schräg (links)", []) == "niere-schraeg-links"
    assert free_id("Niere", ["niere", "niere-2"]) == "niere-3"
    assert free_id("腎臓", []) == "exercise"
    assert len(free_id("x" * 200, ["x" * 60])) <= 64


# --- messages -----------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("id: x\ntitle: X\nasistance: 1\n", r"asistance: Extra .*valid names: .*\(line 3\)"),
        ("id: x\ntitle: X\nneedle:\n  gauge: 19\n", r"needle\.gauge: .*there are 17, .*\(line 4\)"),
        ("id: x\ntitle: X\n\nlevel: 12\n", r"level: .*less than or equal to 9, got 12 \(line 4\)"),
        ("id: x\ntitle: X\nplan:\n  entry_mm: [1, 2]\n  target_mm: [1, 2, 3]\n",
         r"plan\.points\.entry_mm\.2: required|required and missing: plan\.points\.entry_mm\.2"),
        ("id: x\ntitle: X\nrig: nothing\n", r"rig: 'nothing' is not known; .*wide.*\(line 3\)"),
        ("id: x\ntitle: X\npurpose: assessment\nlocks: [views]\n", r"locks.*missing.*\(line 4\)"),
        ("id: x\ntitle: X\ntolerances:\n  angle_error: {expert: 3, good: 2, pass: 5}\n",
         r"tolerances\.angle_error: .*rise or fall strictly.*\(line 4\)"),
        ("id: x\ntitle: X\nfading: {kind: schedule}\n", r"fading.*dials.*\(line 3\)"),
    ],
)  # fmt: skip
def test_a_mistake_names_field_and_line(text: str, told: str, tmp_path: Path) -> None:
    path = tmp_path / "x.yaml"
    path.write_text(text)
    with pytest.raises(ConfigurationError, match=told) as raised:
        read_exercise(path)
    assert "\n" not in str(raised.value)


def test_a_problem_names_its_field_for_a_form() -> None:
    _, found = checked({"id": "x", "level": 0, "needle": {"gauge": 19}}, Exercise)
    assert {(one.field, one.missing) for one in found} == {
        (("level",), False), (("title",), True), (("needle", "gauge"), False)
    }  # fmt: skip


# --- schema -------------------------------------------------------------------------------------
def test_the_published_schema_is_that_of_the_reader() -> None:
    published = (ROOT / "docs" / "exercise.schema.json").read_text(encoding="utf-8")
    assert published == schema_text()


@pytest.mark.long("statistics")
def test_shipped_files_and_short_forms_keep_to_the_schema_and_typos_do_not() -> None:
    schema = json.loads(schema_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    for path in folders()[0].glob("*.yaml"):
        jsonschema.validate(yaml.safe_load(path.read_text(encoding="utf-8")), schema)
    for more in ({"effects": ["breathing"]}, {"reading": {"window": "soft_Tissue"}}):
        jsonschema.validate({"id": "x", "title": "X", **more}, schema)
    for more in ({"levl": 1}, {"level": 10}, {"reading": {"window": "Lungs"}}):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate({"id": "x", "title": "X", **more}, schema)


def test_every_field_of_the_schema_is_described() -> None:
    properties = schema_document()["properties"]
    assert [name for name, one in properties.items() if "description" not in one] == []


# --- fading -------------------------------------------------------------------------------------
def test_a_schedule_gives_each_attempt_its_dial_and_keeps_the_last() -> None:
    fading = FadingPart.model_validate({"kind": "schedule", "dials": [0.7, 0.3, 0.0]})
    dials = [starting_dial(1.0, fading, [None] * n).share for n in range(5)]
    assert dials == [0.7, 0.3, 0.0, 0.0, 0.0]


def test_assistance_fades_with_good_attempts_and_comes_back_after_poor_ones() -> None:
    fading = FadingPart.model_validate({"kind": "performance", "step": 0.25, "least": 0.1})
    totals, dials = [95.0, 70.0, None, 82.0, 85.0, 20.0, 99.0], []
    for number in range(len(totals) + 1):
        dials.append(starting_dial(0.7, fading, totals[:number]).share)
    assert dials == pytest.approx([0.7, 0.45, 0.45, 0.45, 0.2, 0.1, 0.35, 0.1])


def test_probes_have_no_assistance_and_count_for_nothing() -> None:
    fading = FadingPart.model_validate({"kind": "performance", "step": 0.2, "probe_every": 3})
    totals = [90.0, 90.0, 0.0, 90.0]
    dials = [starting_dial(0.7, fading, totals[:n]) for n in range(5)]
    assert [dial.is_probe for dial in dials] == [False, False, True, False, False]
    assert [dial.share for dial in dials] == pytest.approx([0.7, 0.5, 0.0, 0.3, 0.1])


def test_without_fading_the_dial_stays() -> None:
    assert starting_dial(-0.4, None, [10.0, 99.0]).share == -0.4


def test_a_text_that_is_no_exercise_is_told_in_words_of_a_file() -> None:
    with pytest.raises(ConfigurationError, match=r"names with values.*got 'nonsense'"):
        parse_text("nonsense\n", Exercise, "mine.yaml")
