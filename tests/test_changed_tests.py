"""`make test-changed` runs what a change can reach, and leaves out what it cannot."""

import pytest

from tools import changed_tests
from tools.changed_tests import ALWAYS, PAGES, ROOT, changed_files


@pytest.mark.long("journey")
def test_a_module_reaches_the_tests_of_its_layer_and_above_only():
    picked = set(changed_tests.tests_for(["app/imaging/window.py"]))
    assert "tests/imaging/test_imaging_window.py" in picked
    assert "tests/views/test_views_window.py" in picked
    assert "tests/mechanisms/test_mechanisms_contract.py" not in picked
    assert "tests/core/test_core_transform.py" not in picked


@pytest.mark.parametrize(
    ("changed", "reached"),
    [
        ("app/scoring/metrics/path_ratio.py", "tests/scoring/test_scoring_metrics.py"),
        ("app/commands/ct.py", "tests/test_command_line.py"),
        ("app/simulation/effects/bevel.py", "tests/simulation/test_simulation_compiler.py"),
        ("app/arm/hard_cases/hand.py", "tests/hard/test_hard_register.py"),
        ("app/arm/studies/grasp.py", "tests/studies/test_studies_rule.py"),
        ("app/arm/features/arm.py", "tests/views/test_views_window.py"),
        ("app/arm/comparisons/arm.py", "tests/studies/test_studies_machines.py"),
        ("tests/arm/defects/hand.py", "tests/hard/test_hard_register.py"),
    ],
)
def test_what_is_found_by_being_there_reaches_who_looks_for_it(changed, reached):
    assert reached in changed_tests.tests_for([changed])


@pytest.mark.parametrize(
    ("changed", "reached"),
    [
        ("tests/machine_records.py", "tests/test_replay_machines.py"),
        ("tests/session/session_fakes.py", "tests/session/test_session_under_way.py"),
        ("tests/views/conftest.py", "tests/views/test_views_accuracy.py"),
        ("app/views/shell/message_bar.py", "tests/views/test_views_notices.py"),
        ("app/session/tries.py", "tests/commands/test_commands_output.py"),
        ("app/mechanisms/pantograph/dynamics.py", "tests/device/test_device_force_path.py"),
        ("app/tracking/markers/model_fit.py", "tests/studies/test_studies_tracking.py"),
        (
            "tests/simulation/test_simulation_bent_needle.py",
            "tests/simulation/test_simulation_dragged_needle.py",
        ),
        ("tools/structure.py", "tests/test_structure.py"),
        ("app/scoring/__init__.py", "tests/scoring/test_scoring_metrics.py"),
    ],
)
def test_what_a_helper_or_a_fixture_brings_reaches_the_tests_that_use_it(changed, reached):
    assert reached in changed_tests.tests_for([changed])


def test_a_page_reaches_its_own_tests_and_a_resource_every_one():
    assert set(changed_tests.tests_for(["docs/json.md"])) == {*PAGES, *ALWAYS}
    every = {str(path.relative_to(ROOT)) for path in (ROOT / "tests").rglob("test_*.py")}
    assert set(changed_tests.tests_for(["resources/exercises/first-insertion.yaml"])) == every


def test_a_commit_that_git_does_not_know_is_named():
    with pytest.raises(ValueError, match="git knows no commit no-such-commit"):
        changed_files("no-such-commit")
