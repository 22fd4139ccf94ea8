"""A sweep's table, whole or growing: means with intervals, what it costs, what is none."""

import json

import numpy as np
import pytest
from scipy.stats import ttest_1samp

from app.cohort.cost import Spent
from app.cohort.sweeping import columns
from app.cohort.table import join_parts, write_part
from app.studies.errors import StudyError
from app.studies.sweep_table import SweepTable, read_sweep

PARAMETER = "puncture.force_scale"


def rows(skill, error, totals, mark=60.0):
    """Attempts of one condition; a total of None is an attempt that could not be judged."""
    return [
        {
            "exercise": "liver-01", "version": 2, "skill": skill, "device": "icube",
            "tissue": "field", "registration_error_mm": error, "tracking_noise": 1.0,
            "breathing_mm": 0.0, "assistance": 0.0, PARAMETER: 1.0, "seed": seed, "total": total,
            "passed": total is not None and total >= mark, "duration_s": 20.0 + seed,
            "void_reason": "" if total is not None else "nobody saw the needle",
            "value_lateral_error": None if total is None else 3.0 - 0.02 * total,
        }
        for seed, total in enumerate(totals)
    ]  # fmt: skip


PARTS = [
    rows("expert", 0.0, [90.0, 80.0, 85.0]),
    rows("expert", 5.0, [70.0, 50.0, 55.0]),
    rows("novice", 0.0, [60.0, 40.0, None]),
    rows("novice", 5.0, [20.0, 10.0, 30.0]),
]


def written(folder, finished, parts=PARTS):
    out, there = folder / "sweep.parquet", folder / "sweep.parquet.parts"
    there.mkdir()
    names = columns((PARAMETER,))
    files = [there / f"{number}.parquet" for number in range(len(parts))]
    for file, some in zip(files, parts, strict=True):
        write_part(file, names, some, Spent(len(some), 2.0, 1.5 * len(some)))
    (there / "run.json").write_text(json.dumps({"rows": 12, "parts": 4}))
    if finished:
        join_parts(files, names, out)
    return out


@pytest.mark.parametrize("finished", [True, False])
def test_a_sweep_is_the_same_by_its_table_and_by_its_parts(tmp_path, finished):
    sweep = read_sweep(written(tmp_path, finished))
    assert (sweep.attempts, sweep.unjudged, sweep.wanted) == (12, 1, 12)
    assert sweep.finished is finished
    assert sweep.exercise == "liver-01, v2"
    assert sweep.conditions == ("skill", "registration_error_mm")
    assert sweep.measures == ("total", "passed", "duration_s", "value_lateral_error")
    assert sweep.attempt_s == pytest.approx(1.5)
    means = sweep.means("total", "registration_error_mm", "skill")
    told = [(one.series, one.at, one.attempts, one.mean) for one in means]
    assert told == [
        ("expert", 0.0, 3, 85.0),
        ("expert", 5.0, 3, pytest.approx(175.0 / 3)),
        ("novice", 0.0, 2, 50.0),
        ("novice", 5.0, 3, 20.0),
    ]
    every = sweep.means("total", "registration_error_mm")
    assert [one.mean for one in every] == [71.0, pytest.approx(235.0 / 6)]


def test_a_sweep_that_grows_says_how_much_is_wanted(tmp_path):
    sweep = read_sweep(written(tmp_path, False, PARTS[:2]))
    assert (sweep.attempts, sweep.wanted, sweep.finished) == (6, 12, False)


def test_the_interval_of_a_mean_is_that_of_scipy(tmp_path):
    sweep = read_sweep(written(tmp_path, True))
    first = sweep.means("value_lateral_error", "registration_error_mm")[0]
    values = [3.0 - 0.02 * total for total in (90.0, 80.0, 85.0, 60.0, 40.0)]
    wanted = ttest_1samp(values, 0.0).confidence_interval(0.95)
    assert (first.lower, first.upper) == pytest.approx(tuple(wanted))


@pytest.mark.parametrize(
    ("passed", "of", "lower", "upper"),
    [(81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611),
     (1, 29, 0.0061, 0.1718)],
)  # fmt: skip
def test_the_interval_of_a_share_is_that_of_newcombes_table(passed, of, lower, upper):
    """Newcombe, R. G. (1998), Statistics in Medicine 17, 857-872, table I, method 3 (Wilson)."""
    some = rows("expert", 0.0, [100.0] * passed + [0.0] * (of - passed))
    table = SweepTable({name: [row.get(name) for row in some] for name in columns()}, True)
    (share,) = table.means("passed", "skill")
    assert share.mean == pytest.approx(passed / of)
    assert (share.lower, share.upper) == pytest.approx((lower, upper), abs=5e-5)


def test_what_is_no_sweep_is_one_line_that_says_what_to_choose(tmp_path):
    with pytest.raises(StudyError, match="no part of one lies beside it: choose what"):
        read_sweep(tmp_path / "sweep.parquet")
    garbage = tmp_path / "garbage.parquet"
    garbage.write_bytes(np.random.default_rng(1).bytes(200))
    with pytest.raises(StudyError, match="is no table of a sweep, or is damaged"):
        read_sweep(garbage)
    other = tmp_path / "other.parquet"
    join_parts([], {"seed": int, "total": float}, other)
    with pytest.raises(StudyError, match="no duration_s, exercise, passed, version"):
        read_sweep(other)
