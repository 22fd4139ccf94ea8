"""Targets to be touched: how an exercise gives them, and what is refused."""

import numpy as np
import pytest

from app.core import paths
from app.core.configuration import parse
from app.core.errors import AcusError, ConfigurationError
from app.exercises.library import library, load_exercise, read_exercise
from app.exercises.scene import device_of, placed_plan_of
from app.exercises.schema import Exercise
from app.exercises.touching import check_touch
from app.exercises.writing import exercise_text

PLAN = {"entry_mm": [-70.9, -109.4, 180.1], "target_mm": [-73.3, -42.0, 184.2]}


def exercise(touch, **more):
    document = {"id": "own", "title": "Own", "plan": PLAN, "touch": touch} | more
    return parse(document, Exercise, "own")


def task_of(chosen):
    return chosen.touch_task(placed_plan_of(chosen, device_of(chosen)))


def test_the_shipped_exercise_can_be_used_and_reads_back_equal(tmp_path):
    shipped = load_exercise("laparoscopic-tool")
    path = tmp_path / "copy.yaml"
    path.write_text(exercise_text(shipped, tmp_path), encoding="utf-8")
    assert read_exercise(path) == shipped
    check_touch(task_of(shipped), device_of(shipped))
    assert not library().broken


def test_exercises_without_targets_say_nothing_of_them():
    said = load_exercise("first-insertion").model_dump(mode="json", exclude_defaults=True)
    assert "touch" not in said


def test_drawn_targets_lie_about_the_path_apart_and_the_same_every_time():
    pattern = {"count": 8, "depth_mm": [40, 90], "within_deg": 20}
    chosen = exercise({"pattern": pattern, "radius_mm": 3}, seed=4)
    points, again = task_of(chosen).points_mm, task_of(chosen).points_mm
    np.testing.assert_array_equal(points, again)
    ways = points - PLAN["entry_mm"]
    depths = np.linalg.norm(ways, axis=1)
    path = np.subtract(PLAN["target_mm"], PLAN["entry_mm"])
    angles = np.degrees(np.arccos(ways @ path / depths / np.linalg.norm(path)))
    assert (depths > 39.8).all()
    assert (depths < 90.2).all()
    assert (angles < 20.3).all()
    assert (np.linalg.norm(np.diff(points, axis=0), axis=1) >= 9.0 - 1e-9).all()
    other = task_of(exercise({"pattern": pattern, "radius_mm": 3}, seed=5)).points_mm
    assert np.abs(other - points).max() > 1.0


def test_each_target_is_a_plan_from_the_trocar_to_it():
    chosen = exercise({"targets_mm": [[-73, -42, 184], [-60, -50, 190]], "radius_mm": 5})
    task = task_of(chosen)
    placed = placed_plan_of(chosen, device_of(chosen))
    assert len(task) == 2
    assert task.radius == 0.005
    for point, plan in zip(chosen.touch.targets_mm, task.plans, strict=True):
        np.testing.assert_array_equal(plan.p_entry, placed.p_entry)
        np.testing.assert_allclose(
            plan.p_target, placed.T_world_patient @ (np.array(point) * 1e-3), atol=1e-12
        )


@pytest.mark.parametrize(
    ("touch", "more", "words"),
    [
        ({}, {}, "either targets_mm"),
        ({"targets_mm": [[0, 0, 0]], "pattern": {"count": 1, "depth_mm": [40, 50],
          "within_deg": 5}}, {}, "either targets_mm"),
        ({"targets_mm": []}, {}, "at least 1"),
        ({"pattern": {"count": 99, "depth_mm": [40, 50], "within_deg": 5}}, {}, "12"),
        ({"pattern": {"count": 3, "depth_mm": [50, 40], "within_deg": 5}}, {}, "smaller one first"),
        ({"targets_mm": [[0, 0, 0]], "radius_mm": 0}, {}, "radius_mm"),
        ({"targets_mm": [[0, 0, 0]], "dwell_s": float("nan")}, {}, "dwell_s"),
        ({"targets_mm": [[0, 0, 0]]}, {"plan": "phantom_default"}, "entry_mm and target_mm"),
        ({"targets_mm": [[0, 0, 0]]}, {"guidance": {"mode": "control_ct"}}, "by sight"),
        ({"targets_mm": [[0, 0, 0]]}, {"purpose": "assessment"}, "by sight"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused_by_its_name(touch, more, words):
    with pytest.raises(ConfigurationError, match=words):
        exercise(touch, **more)


@pytest.mark.parametrize(
    ("target", "words"),
    [
        ([-73, 60, 184], r"target 2 at \[-73, 60, 184\] mm .*mm.*Reachable are targets 10 to 120"),
        ([60, -60, 184], r"target 2 .*leans at most 39°"),
        ([-70.9, -105.0, 180.1], r"target 2 .*from the trocar"),
    ],
)
def test_a_target_out_of_reach_is_named_when_the_file_is_read(tmp_path, target, words):
    near = [-73.0, -42.0, 184.0]
    text = exercise_text(exercise({"targets_mm": [near, near]}))
    changed = text.replace(
        "- [-73.0, -42.0, 184.0]\n  - [-73.0, -42.0, 184.0]", f"- {near}\n  - {target}"
    )
    assert changed != text
    path = tmp_path / "far.yaml"
    path.write_text(changed, encoding="utf-8")
    with pytest.raises(ConfigurationError, match=words):
        read_exercise(path)


@pytest.mark.parametrize(
    ("targets", "radius", "words"),
    [
        ([[-73, -96, 182]], 20, r"target 1 at \[-73, -96, 182\] mm .* within its own radius of 20"),
        (
            [[-73, -42, 184], [-73, -42, 184]],
            4,
            r"targets 1 and 2 lie 0.0 mm apart.*more than 8 mm",
        ),
        (
            [[-73, -42, 184], [-73, -49, 184]],
            4,
            r"targets 1 and 2 lie 7.0 mm apart.*more than 8 mm",
        ),
        ([[-73, -42, 184], PLAN["entry_mm"]], 4, r"touch: target 2: .* 0 mm apart"),
    ],
    ids=["at the trocar", "the same", "overlapping", "the entry"],
)
def test_what_a_tip_at_rest_would_touch_is_refused_when_the_file_is_read(
    tmp_path, targets, radius, words
):
    path = tmp_path / "still.yaml"
    path.write_text(exercise_text(exercise({"targets_mm": targets, "radius_mm": radius})), "utf-8")
    with pytest.raises(ConfigurationError, match=words):
        read_exercise(path)


def test_a_pattern_without_room_is_refused():
    crowded = exercise(
        {"pattern": {"count": 12, "depth_mm": [40, 41], "within_deg": 1}, "radius_mm": 20}
    )
    with pytest.raises(AcusError, match="give more room"):
        task_of(crowded)


def test_the_shipped_file_names_its_sources():
    text = (paths.resources() / "exercises" / "laparoscopic-tool.yaml").read_text()
    assert "Ritter and Scott 2007" in text
    assert "this project's own" in text
