"""Every shipped exercise has one place in the map of skills."""

from app.exercises.library import library
from app.exercises.practised_skill import PractisedSkill, is_lesson, practised_skill
from app.exercises.schema import Exercise

PLACES = {
    PractisedSkill.HAND: {"first-insertion", "thick-tissue", "with-less-help", "against-repulsion"},
    PractisedSkill.BREATH: {"breathing-liver", "kidney", "hold-the-breath", "lung-between-ribs"},
    PractisedSkill.PROCEDURE: {
        "lung-biopsy",
        "lung-biopsy-complications",
        "liver-ablation",
    },
    PractisedSkill.CLEARANCE: {"past-the-vessel", "beside-the-vein"},
    PractisedSkill.PLAN: {"plan-it-yourself", "scans-only"},
    PractisedSkill.MACHINE: {"tensegrity-liver", "laparoscopic-tool"},
}


def test_the_shipped_exercises_stand_where_their_descriptions_say():
    found = {}
    for exercise in library():
        found.setdefault(practised_skill(exercise), set()).add(exercise.id)
    assert found == PLACES


def test_a_machine_of_somebodys_own_stands_with_the_research_machines(tmp_path):
    profile = tmp_path / "mine.yaml"
    profile.write_text("kind: delta\n", encoding="utf-8")
    mine = Exercise(id="mine", title="Mine", device=str(profile))
    assert not is_lesson(mine)
    assert is_lesson(Exercise(id="usual", title="Usual"))
    assert is_lesson(Exercise(id="usual", title="Usual", device=str(tmp_path / "lost.yaml")))
