"""A sweep: a trial's scores, one row for each attempt, gone on with where it was broken off."""

import json

import numpy as np
import pyarrow.parquet as parquet
import pytest

from app.cohort import CohortError, SweepGrid, crew_of, sweep
from app.cohort.sweeping import SEEDS, displaced
from app.compose.skill_scores import Resolved, skill_outcomes
from app.compose.trial import Trials
from app.core.progress import Cancelled, Progress
from app.exercises.library import load_exercise
from app.tracking.simulated.sampled import BOTH
from tests.layered import layered

EXERCISE = "first-insertion"


@pytest.fixture
def exercise_file(tmp_path):
    """An exercise in layers, as a file: it needs no patient and is tried in half the time."""
    exercise = layered(EXERCISE)
    file = tmp_path / "layered.yaml"
    file.write_text(exercise.model_dump_json(by_alias=True))  # JSON is YAML
    return file


def rows(file):
    """Read the table by what shares no code with the program's writer but the format."""
    table = parquet.read_table(file)
    return [
        dict(zip(table.column_names, values, strict=True))
        for values in zip(*(column.to_pylist() for column in table.columns), strict=True)
    ]


def grid(file, **axes):
    return SweepGrid.given(exercise=str(file), **{"skills": ("expert",), "seeds": 1, **axes})


@pytest.mark.long("journey")
def test_a_sweep_scores_each_seed_as_a_trial_of_the_exercise_does(exercise_file, tmp_path):
    out = tmp_path / "a.parquet"
    done = sweep(grid(exercise_file, skills=("novice", "expert"), seeds=2), out, crew_of())
    trial = skill_outcomes(load_exercise(exercise_file), 2, ("novice", "expert"))
    expected = [
        (one.skill, seed, total, passed)
        for one in trial
        for seed, total, passed in zip((1, 2), one.totals, one.passed, strict=True)
    ]
    found = [(row["skill"], row["seed"], row["total"], row["passed"]) for row in rows(out)]
    assert found == expected  # to the bit
    assert (done.rows, done.parts, done.done_before) == (4, 2, 0)
    assert done.cost.attempt > 0.0


@pytest.mark.long("journey")
def test_a_sweep_goes_on_with_the_parts_that_are_missing_and_ends_with_the_same_bytes(
    exercise_file, tmp_path
):
    out, wanted = tmp_path / "a.parquet", grid(exercise_file, skills=("novice", "expert"))
    begun = Progress(lambda share, text: share >= 0.5 and begun.cancel())
    with pytest.raises(Cancelled):
        sweep(wanted, out, crew_of(), begun)
    assert not out.exists()
    (kept,) = (tmp_path / "a.parquet.parts").glob("*.parquet")
    before = kept.read_bytes()
    done = sweep(wanted, out, crew_of())
    assert (done.done_before, kept.read_bytes()) == (1, before)
    whole = out.read_bytes()
    kept.write_bytes(before[: len(before) // 2])  # cut off
    assert sweep(wanted, out, crew_of()).done_before == 1
    assert out.read_bytes() == whole


@pytest.mark.long("journey")
def test_more_seeds_and_values_leave_the_parts_that_are_there(exercise_file, tmp_path):
    out = tmp_path / "a.parquet"
    first = grid(exercise_file, seeds=(3,))
    more = grid(
        exercise_file, seeds=(3,), assistance=(0.0, load_exercise(exercise_file).assistance)
    )
    sweep(first, out, crew_of())
    assert sweep(more, out, crew_of()).done_before == 1
    assert [row["assistance"] for row in rows(out)] == [0.0, 0.7]


@pytest.mark.long("journey")
def test_a_registration_error_moves_the_target_by_its_length_and_costs_the_score(
    exercise_file, tmp_path
):
    on = Resolved.of(load_exercise(exercise_file))
    for seed in (1, 2, 3):
        true = displaced(on.placed, 0.004, seed)
        assert np.linalg.norm(true.p_target - on.placed.p_target) == pytest.approx(0.004)
        assert np.allclose(true.p_target - true.p_entry, on.placed.p_target - on.placed.p_entry)
    assert displaced(on.placed, 0.004, 1).p_target[0] != displaced(on.placed, 0.004, 2).p_target[0]
    out = tmp_path / "a.parquet"
    sweep(grid(exercise_file, registration_error_mm=(0.0, 8.0)), out, crew_of())
    right, wrong = rows(out)
    assert wrong["value_target_error"] == pytest.approx(8.0, abs=right["value_target_error"] + 0.5)
    assert wrong["total"] < right["total"]
    assert (right["passed"], wrong["passed"]) == (True, False)


@pytest.mark.long("journey")
def test_noise_of_the_cameras_grows_what_a_depth_is_uncertain_by_in_proportion(
    exercise_file, tmp_path
):
    """Nearly: what is known of the needle's direction adds a share of its own."""
    on = Resolved.of(load_exercise(exercise_file))
    usual, noisy = (
        Trials(on.exercise, on.placed, noise=factor)._cameras.table[:, BOTH, 0]
        for factor in (1.0, 4.0)
    )
    seen = np.isfinite(usual)
    assert np.median(noisy[seen] / usual[seen]) == pytest.approx(4.0, rel=0.1)
    out = tmp_path / "a.parquet"
    sweep(grid(exercise_file, tracking_noise=(1.0, 300.0)), out, crew_of())
    few, many = rows(out)
    assert few["total_sd"] < many["total_sd"]
    assert few["value_depth_error"] != many["value_depth_error"]


def test_breathing_moves_the_target_and_none_lets_it_stand(exercise_file):
    exercise = load_exercise(exercise_file)
    still, deep = grid(exercise_file, breathing_mm=(0.0, 23.8)).cells(exercise)
    assert "breathing" not in still.exercise.effects
    given = deep.exercise.effects["breathing"].parameters  # twice the medians of the liver
    assert given == pytest.approx(
        {"superior_inferior": 0.0238, "anterior_posterior": 0.0076, "left_right": 0.0026}
    )


def test_the_cells_of_a_grid_are_every_combination_once():
    wanted = SweepGrid.given(
        exercise=EXERCISE,
        skills=("novice", "expert"),
        devices=("icube", "haply-2diy"),
        tissue=("field", "layers"),
        registration_error_mm=(0.0, 2.0),
        effects={"shaft_friction.presliding_stiffness": (1e4, 1e5)},
        seeds=SEEDS + 1,
    )
    cells = list(wanted.cells(load_exercise(EXERCISE)))
    values = {json.dumps(cell.values, sort_keys=True) for cell in cells}
    assert (len(values), wanted.attempts) == (32, 32 * (SEEDS + 1))
    assert {cell.exercise.tissue.value for cell in cells} == {"field", "layers"}


@pytest.mark.parametrize(
    ("axes", "reason"),
    [
        ({"skills": ("wizard",)}, "no skill 'wizard'"),
        ({"seeds": 0}, "seeds"),
        ({"seeds": (1, 1)}, "seeds: a value stands there twice"),
        ({"registration_error_mm": (-1.0,)}, "registration_error_mm"),
        ({"registration_error_mm": (float("nan"),)}, "registration_error_mm"),
        ({"tracking_noise": (0.0,)}, "tracking_noise"),
        ({"breathing_mm": (1.0, 1.0)}, "breathing_mm: a value stands there twice"),
        ({"tissue": ("jelly",)}, "tissue"),
        ({"effects": {"shaft_friction": (1.0,)}}, "write EFFECT.PARAMETER"),
        ({"effects": {"shaft_friction.colour": (1.0,)}}, "colour"),
        ({"effects": {"nothing.at_all": (1.0,)}}, "nothing"),
        ({"effects": {"shaft_friction.presliding_stiffness": ()}}, "one value at least"),
        ({"seeds": 10**8}, "at most 10000000"),
    ],
)
def test_a_grid_that_cannot_be_is_refused_in_one_line(axes, reason):
    with pytest.raises(CohortError) as refused:
        SweepGrid.given(exercise=EXERCISE, **axes)
    assert reason in str(refused.value)
    assert "\n" not in str(refused.value)


def test_an_axis_of_an_effect_that_the_exercise_does_not_ask_for_is_refused(tmp_path):
    wanted = SweepGrid.given(exercise=EXERCISE, effects={"breathing.period": (3.0, 4.0)})
    with pytest.raises(CohortError, match="does not ask for the effect breathing"):
        sweep(wanted, tmp_path / "a.parquet", crew_of())


def test_only_parquet_is_written_and_a_file_in_the_place_of_a_folder_is_named(
    exercise_file, tmp_path
):
    with pytest.raises(CohortError, match=r"only \.parquet"):
        sweep(grid(exercise_file), tmp_path / "a.csv", crew_of())
    (tmp_path / "b.parquet.parts").write_text("in the way")
    with pytest.raises(CohortError, match=r"b.parquet.parts cannot be written"):
        sweep(grid(exercise_file), tmp_path / "b.parquet", crew_of())
