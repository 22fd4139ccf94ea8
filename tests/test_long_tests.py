"""What `make test` leaves out is marked with its kind, listed on a page, and run all the same."""

import pytest

from tools.long_tests import PAGE, ROOT, long_tests, written


@pytest.mark.long("journey")
def test_the_page_of_tests_is_what_they_are_marked_with():
    assert PAGE.read_text(encoding="utf-8") == written(long_tests()), "write it: make tests-page"


def test_the_two_halves_leave_nothing_out_and_integration_runs_of_the_long_what_its_time_allows():
    recipes = (ROOT / "Makefile").read_text(encoding="utf-8")
    assert "\ntest: setup" in recipes
    assert '-m "not long" $(TEST)' in recipes
    assert "$(PYTEST) -m long $(TEST)" in recipes
    steps = (ROOT / ".ci/run").read_text(encoding="utf-8").splitlines()
    left = steps.index("left=$((2760 - SECONDS))")  # of the hour, less what a last test may take
    limited = steps.index("export ACUS_TESTS_SECONDS=$((left > 120 ? left : 120))")
    assert steps.index("make test") < left < limited < steps.index("make test-long")
    assert "export ACUS_TESTS_TURN" in steps
    assert "as many as an\nhour leaves time for" in PAGE.read_text(encoding="utf-8")


@pytest.mark.parametrize("mark", ["long", "long()", "long('slow')", "long(1)"])
def test_a_mark_without_a_kind_is_refused(tmp_path, mark):
    (tmp_path / "test_a.py").write_text(f"import pytest\n@pytest.mark.{mark}\ndef test_a(): ...\n")
    with pytest.raises(
        ValueError, match=r"test_a.py: test_a is marked as long by none of statistics"
    ):
        long_tests(tmp_path)
